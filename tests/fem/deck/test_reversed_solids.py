"""Solids whose base goes round the other way are turned, and that is said."""

import numpy as np
import pytest

from fem.deck.reader import read_deck
from fem.deck.records.solids import HEXA, PENTA, PYRAMID, TETRA
from fem.elements.solids.isoparametric import (
    HEX_CORNERS,
    PENTA_CORNERS,
    TETRA_CORNERS,
)

_PYRAMID = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1.0]])


def _with_middles(corners, edges):
    return np.vstack([corners, corners[np.array(edges)].mean(axis=1)])


POINTS = {
    "TETRA4": TETRA_CORNERS,
    "TETRA10": _with_middles(TETRA_CORNERS, TETRA.edges),
    "PYRAM5": _PYRAMID,
    "PYRAM13": _with_middles(_PYRAMID, PYRAMID.edges),
    "PENTA6": PENTA_CORNERS,
    "PENTA15": _with_middles(PENTA_CORNERS, PENTA.edges),
    "HEXA8": HEX_CORNERS,
    "HEXA20": _with_middles(HEX_CORNERS, HEXA.edges),
}
_BACKWARDS = {
    "TETRA4": [0, 2, 1, 3],
    "TETRA10": [0, 2, 1, 3, 6, 5, 4, 7, 9, 8],
    "PYRAM5": [0, 3, 2, 1, 4],
    "PYRAM13": [0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10],
    "PENTA6": [0, 2, 1, 3, 5, 4],
    "PENTA15": [0, 2, 1, 3, 5, 4, 8, 7, 6, 9, 11, 10, 14, 13, 12],
    "HEXA8": [0, 3, 2, 1, 4, 7, 6, 5],
    "HEXA20": [0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 12, 15, 14, 13, 19, 18, 17, 16],
}


@pytest.mark.parametrize("kind", sorted(_BACKWARDS))
def test_solids_that_go_round_the_other_way_are_turned(kind, tmp_path):
    """The same element, from the grids of its card in another order; that is said."""
    xyz, other = POINTS[kind], np.array(_BACKWARDS[kind])
    name = f"C{kind.rstrip('0123456789')}"
    decks = []
    for order in (np.arange(len(xyz)), other):
        grids = [f"GRID,{k + 1},,{x},{y},{z}" for k, (x, y, z) in enumerate(xyz)]
        nodes = [str(k + 1) for k in order]
        lines = [",".join(nodes[:6]), *(",".join(nodes[k : k + 8]) for k in (6, 14))]
        card = "\n,".join(line for line in lines if line)
        path = tmp_path / f"{order[1]}.bdf"
        bulk = "\n".join([*grids, f"{name},1,1,{card}", "PSOLID,1,1", "MAT1,1,1.,,.3"])
        path.write_text(f"SOL 101\nCEND\nBEGIN BULK\n{bulk}\nENDDATA\n")
        decks.append(read_deck(path))
    for deck in decks:
        assert np.array_equal(deck.cards[name]["nodes"][0], np.arange(len(xyz)) + 1)
    assert not decks[0].notices
    assert f"{name} 1: the base goes round away" in decks[1].notices[0]
