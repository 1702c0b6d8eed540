"""Loaded models from a few lines of bulk data."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from fem.deck.deck import Deck
from fem.geometry.points import Points
from fem.loads import static_load


@dataclass(frozen=True)
class Loaded:
    """Load vector of set 1 with its points."""

    deck: Deck
    points: Points
    load: np.ndarray

    def at(self, grid: int) -> np.ndarray:
        """(6,) force and moment at a grid in its displacement frame."""
        return self.load[self.points.dof(grid, np.arange(1, 7))]

    def resultant(self) -> np.ndarray:
        """(6,) force, and moment about the origin, basic axes."""
        basic = self.points.basic_rotation() @ self.load
        parts = basic[: 6 * len(self.points.grid_id)].reshape(-1, 2, 3)
        moments = parts[:, 1] + np.cross(self.points.xyz, parts[:, 0])
        return np.concatenate([parts[:, 0].sum(axis=0), moments.sum(axis=0)])


@pytest.fixture
def loaded(model) -> Callable[..., Loaded]:
    """Function from bulk data with a load set 1 to Loaded."""

    def make(bulk: str, sid: int = 1) -> Loaded:
        m = model(bulk)
        load = static_load(m.deck, m.points, sid, m.matrices.mass)
        return Loaded(m.deck, m.points, load)

    return make
