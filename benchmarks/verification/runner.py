"""Decks run as a user runs them: text or file in, datasets of the result file out."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import h5py
import numpy as np

from fem.deck.reader import read_deck
from fem.deck.text.source import include_reach
from fem.solution import Options, run_deck


class Results(Mapping[str, np.ndarray]):
    """All datasets of a result file by name, and the columns of its tables."""

    def __init__(self, path: Path) -> None:
        self._arrays: dict[str, np.ndarray] = {}
        self._columns: dict[str, list[str]] = {}
        with h5py.File(path) as file:
            file.visititems(self._keep)

    def _keep(self, name: str, item: h5py.Group | h5py.Dataset) -> None:
        if isinstance(item, h5py.Dataset):
            self._arrays[name] = np.asarray(item[()])
        if "columns" in item.attrs:
            self._columns[name] = [str(c) for c in np.asarray(item.attrs["columns"])]

    def __getitem__(self, name: str) -> np.ndarray:
        return self._arrays[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    def column(self, table: str, column: str) -> np.ndarray:
        """(..., e) one column of a table of element results."""
        at = self._columns[table].index(column)
        return self._arrays[f"{table}/value"][..., at]

    def grid(self, name: str, grid: int) -> np.ndarray:
        """(..., 6) values of a grid in a dataset of all grids."""
        at = int(np.searchsorted(self["grid_id"], grid))
        return self._arrays[name][..., at, :]


def run(
    deck: str | Path, *, ignore: Sequence[str] = (), options: Options | None = None
) -> Results:
    """Run a deck.

    Args:
        deck: its text, or the path of its file.
        ignore: unsupported cards to go on without.
        options: as for `fem.run_deck`.
    """
    with TemporaryDirectory() as folder:
        path = deck if isinstance(deck, Path) else Path(folder) / "model.bdf"
        if isinstance(deck, str):
            path.write_text(deck)
        out = Path(folder) / "model.h5"
        with include_reach(trust=True):  # reference decks include each other
            model = read_deck(path, ignore=ignore)
        run_deck(model, out, options)
        return Results(out)
