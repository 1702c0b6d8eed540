"""Decks from a few lines."""

from collections.abc import Callable
from pathlib import Path

import pytest

from fem.deck.deck import Deck
from fem.deck.reader import read_deck

GOOD = """\
GRID,1
GRID,2,,1.
GRID,3,,2.
CBAR,1,1,1,2,0.,1.,0.
CBAR,2,1,2,3,0.,1.,0.
PBAR,1,1,.1,.01,.01,.01
MAT1,1,7.+10,,.3,2700.
SPC1,1,123456,1
FORCE,1,3,,10.,0.,0.,1.
"""


@pytest.fixture
def read(tmp_path: Path) -> Callable[..., Deck]:
    """Function from bulk data to a Deck; GOOD is put before unless `alone`."""

    def make(
        bulk: str = "", *, case: str | None = None, alone=False, **options
    ) -> Deck:
        path = tmp_path / "a.bdf"
        text = bulk if alone else GOOD + bulk
        if case is not None:
            text = f"SOL 101\nCEND\n{case}\nBEGIN BULK\n{text}\nENDDATA\n"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_deck(path, **options)

    return make
