"""Decks of the reference aircraft as two readers see them, and their mirror images."""

from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path

import numpy as np
import pytest
from cpylog import SimpleLogger
from pyNastran.bdf.bdf import BDF
from pyNastran.bdf.mesh_utils.mass_properties import mass_properties

from drake_landing.reference.d150 import AircraftModel, build
from drake_landing.reference.d150.masses import gear_mass_center
from fem.deck.reader import read_deck
from fem.model.structure import Structure

FLIP = np.array([1.0, -1.0, 1.0])


@dataclass
class ReadDeck:
    """A deck in pyNastran's words, with what it complained about."""

    model: AircraftModel
    path: Path
    complaints: list[str] = field(default_factory=list)

    @cached_property
    def bdf(self) -> BDF:
        def listen(kind: str, _file: str, _line: int, text: str) -> None:
            if kind.strip().lower() in ("warning", "error", "critical"):
                self.complaints.append(text)

        bdf = BDF(log=SimpleLogger("debug", log_func=listen))
        bdf.read_bdf(str(self.path))
        return bdf

    @cached_property
    def structure(self) -> Structure:
        """The deck as this project's own solver sees it."""
        return Structure.from_deck(read_deck(self.path))

    @cached_property
    def mirror(self) -> dict[int, int]:
        """Grid id -> id of the grid on the other side (itself on the center plane)."""
        points = np.round(self.model.position, 5) + 0.0
        at = {tuple(p): int(i) for i, p in zip(self.model.grid_id, points)}
        return {i: at[tuple(np.array(p) * FLIP + 0.0)] for p, i in at.items()}

    def whole_aircraft(self):
        """Mass, center and inertia of the deck with the extended gears."""
        mass, cg, six = mass_properties(self.bdf)
        ixx, iyy, izz, ixy, ixz, iyz = six
        inertia = np.array([[ixx, -ixy, -ixz], [-ixy, iyy, -iyz], [-ixz, -iyz, izz]])
        bodies = [(mass, cg, inertia)]
        bodies += [(*gear_mass_center(g), np.zeros((3, 3))) for g in self.model.gears]
        total = sum(m for m, _, _ in bodies)
        center = np.sum([m * c for m, c, _ in bodies], axis=0) / total
        whole = np.zeros((3, 3))
        for m, c, own in bodies:
            arm = c - center
            whole += own + m * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        return total, center, whole


@cache
def _built(level: str, topology: str) -> AircraftModel:
    return build(level, topology)


def _read(level: str, topology: str, folder: Path) -> ReadDeck:
    model = _built(level, topology)
    path = folder / f"{level}_{topology}.bdf"
    path.write_text(model.deck, encoding="ascii")
    return ReadDeck(model, path)


@pytest.fixture(scope="session", params=["1", "2"])
def con(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory):
    return _read("con", request.param, tmp_path_factory.mktemp("con"))


@pytest.fixture(scope="session")
def pre(tmp_path_factory: pytest.TempPathFactory):
    return _read("pre", "2", tmp_path_factory.mktemp("pre"))


@pytest.fixture(scope="session")
def full(tmp_path_factory: pytest.TempPathFactory):
    return _read("full", "distributed", tmp_path_factory.mktemp("full"))
