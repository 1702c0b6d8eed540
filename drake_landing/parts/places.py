"""Where one looks: cuts, panels, equipment."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from drake_landing.parts.cuts import Beam

Float64 = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Panel:
    """A point in the middle of a panel, and its neighbours that are held by frames."""

    name: str
    grid: int
    beside: tuple[int, ...]


@dataclass(frozen=True, kw_only=True)
class Places:
    """Where the parts are looked at.

    Attributes:
        beams: cut at stations.
        panels: middles of panels.
        equipment: name -> grid id of places that carry equipment.
    """

    beams: tuple[Beam, ...] = ()
    panels: tuple[Panel, ...] = ()
    equipment: Mapping[str, int]

    @property
    def grids(self) -> dict[int, str]:
        """Grid -> what it is for."""
        found = {g: f"parts.panels: {p.name}" for p in self.panels for g in p.beside}
        found |= {p.grid: f"parts.panels: {p.name}" for p in self.panels}
        return found | {g: f"parts.equipment: {n}" for n, g in self.equipment.items()}
