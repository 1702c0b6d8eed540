"""RBE3 against the constraint matrices GM that NX Nastran wrote."""

from pathlib import Path

import numpy as np
import pytest
import scipy.io

from fem.constraints.rbe3 import read_rbe3
from fem.deck.reader import read_deck
from fem.model.points import read_points


@pytest.mark.parametrize("name", ["1", "2", "3", "4", "um_1", "um_2"])
def test_constraint_matrix_equals_nx(references: Path, name: str):
    stem = references / f"rbe3/make_gm_nx9_rbe3_{name}"
    # The DMAP files that the executive control includes are not needed.
    deck = read_deck(stem.with_suffix(".dat"))
    points = read_points(deck)
    (equations,) = read_rbe3(deck, points)
    ours = np.zeros((points.size, points.size))
    ours[equations.dependent[equations.row], equations.column] = equations.value
    m = np.sort(equations.dependent)
    n = np.setdiff1d(np.arange(points.size), m)
    gm = scipy.io.loadmat(stem.with_suffix(".mat"))["gm"][0, 0]
    theirs = np.asarray(gm[gm.dtype.names[0]] if gm.dtype.names else gm)
    # NX wrote the matrices in single precision.
    assert np.abs(ours[np.ix_(m, n)] - theirs).max() < 1e-7 * np.abs(theirs).max()
