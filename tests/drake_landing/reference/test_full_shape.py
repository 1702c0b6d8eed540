"""DLR-D150-FULL: shells that are well shaped and do not cross each other."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from fem.elements.quality import quad_measures

OVERLAP = 0.02  # m
LIFTING = ("wing_right", "wing_left", "tailplane_right", "tailplane_left", "fin")


@pytest.fixture(scope="module")
def shells(full):
    """Corners (e, 4, 3) of all shells, a triangle's last one twice, and their parts."""
    cards = full.structure.deck.cards
    quads = cards["CQUAD4"][["g1", "g2", "g3", "g4"]].to_numpy(int)
    trias = cards["CTRIA3"][["g1", "g2", "g3", "g3"]].to_numpy(int)
    grids = np.concatenate([quads, trias])
    rows = np.searchsorted(full.model.grid_id, grids)
    owner = {i: part for part, ids in full.model.parts.items() for i in ids}
    lifting = np.array([any(owner[i] in LIFTING for i in g) for g in grids])
    return full.model.position[rows], lifting


def test_quadrilaterals_are_well_shaped(full, shells):
    count = len(full.structure.deck.cards["CQUAD4"])
    corners = shells[0][:count]
    measures = quad_measures(corners)
    aspect, warp = measures["aspect"], measures["warp"]
    assert np.percentile(aspect, 99) < 5.0
    assert aspect.max() < 8.0
    assert warp.max() < 0.02
    edges = np.roll(corners, -1, axis=1) - corners
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    turn = np.cross(np.roll(edges, 1, axis=1), edges)
    assert np.einsum("ekc,ec->ek", turn, normal).min() > 0.0


def test_wing_and_tails_do_not_cross_the_fuselage(shells):
    """No edge of a lifting surface goes through a sheet of the fuselage, nor back.

    Where one stands on the other they may overlap by 20 mm, as the spars lean by the
    wing's incidence against the upright frames.
    """
    corners, lifting = shells
    one, other = corners[lifting], corners[~lifting]
    assert _crossings(one, other) == 0
    assert _crossings(other, one) == 0


def test_the_search_finds_a_wing_that_is_moved(shells):
    corners, lifting = shells
    moved = corners[lifting] + [0.0, 0.0, 0.35]
    assert _crossings(moved, corners[~lifting]) > 20


def _crossings(one, other):
    """Number of pairs of an edge of `one` and a triangle of `other` that cross."""
    start = one.reshape(-1, 3)
    along = (np.roll(one, -1, axis=1) - one).reshape(-1, 3)
    a, b, c = (
        np.concatenate([other[:, 0], other[:, 0]]),
        np.concatenate([other[:, 1], other[:, 2]]),
        np.concatenate([other[:, 2], other[:, 3]]),
    )
    middle = (a + b + c) / 3
    near = cKDTree(start + along / 2).query_ball_tree(cKDTree(middle), 0.5)
    e = np.repeat(np.arange(len(start)), [len(n) for n in near])
    t = np.concatenate([np.array(n, int) for n in near])
    # Moeller and Trumbore: point a + u (b - a) + v (c - a) of the triangle.
    u_axis, v_axis = (b - a)[t], (c - a)[t]
    p = np.cross(along[e], v_axis)
    det = np.einsum("ij,ij->i", u_axis, p)
    flat = np.abs(det) < 1e-12
    det = np.where(flat, 1.0, det)
    arm = start[e] - a[t]
    u = np.einsum("ij,ij->i", arm, p) / det
    q = np.cross(arm, u_axis)
    v = np.einsum("ij,ij->i", along[e], q) / det
    s = np.einsum("ij,ij->i", v_axis, q) / det
    area = np.linalg.norm(np.cross(u_axis, v_axis), axis=1)
    sides = [np.linalg.norm(x, axis=1) for x in (v_axis, u_axis, u_axis - v_axis)]
    with np.errstate(divide="ignore", invalid="ignore"):
        depth = [share * area / side for share, side in zip((u, v, 1 - u - v), sides)]
        through = (
            np.abs(np.einsum("ij,ij->i", along[e], np.cross(u_axis, v_axis))) / area
        )
    inside = np.min([*depth, s * through, (1 - s) * through], axis=0)
    return int(np.sum((inside > OVERLAP) & ~flat))
