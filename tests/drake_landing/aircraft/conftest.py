"""Decks of the reference aircraft as pyNastran reads them, and their mirror images."""

from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from cpylog import SimpleLogger
from pyNastran.bdf.bdf import BDF

from drake_landing.aircraft import AircraftModel, build


@dataclass
class ReadDeck:
    """A deck in pyNastran's words, with what it complained about."""

    model: AircraftModel
    bdf: BDF
    complaints: list[str] = field(default_factory=list)

    @property
    def mirror(self) -> dict[int, int]:
        """Grid id -> id of the grid on the other side (itself on the centre plane)."""
        at = {
            tuple(p): int(i)
            for i, p in zip(self.model.grid_id, self.rounded, strict=True)
        }
        flip = np.array([1.0, -1.0, 1.0])
        return {i: at[tuple(np.array(p) * flip + 0.0)] for p, i in at.items()}

    @property
    def rounded(self) -> np.ndarray:
        return np.round(self.model.position, 6) + 0.0


def read_deck(model: AircraftModel, folder: Path) -> ReadDeck:
    path = folder / f"{model.level}_{model.topology}.bdf"
    path.write_text(model.deck, encoding="ascii")
    complaints: list[str] = []

    def listen(kind: str, _file: str, _line: int, text: str) -> None:
        if kind.strip().lower() in ("warning", "error", "critical"):
            complaints.append(text)

    bdf = BDF(log=SimpleLogger("debug", log_func=listen))
    bdf.read_bdf(str(path))
    return ReadDeck(model, bdf, complaints)


@cache
def _built(level: str, topology: str) -> AircraftModel:
    return build(level, topology)


@pytest.fixture(scope="session", params=["1", "2"])
def con(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory):
    folder = tmp_path_factory.mktemp("con")
    return read_deck(_built("con", request.param), folder)
