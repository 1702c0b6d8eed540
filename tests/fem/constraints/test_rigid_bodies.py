"""RBAR1, RJOINT, RTRPLT, RTRPLT1, RBE1, RROD and RSPLINE against closed forms."""

import numpy as np
import pytest

from fem.errors import InputError
from fem.model.weight import rigid_modes

GRIDS = """\
CORD2R,5,,0.,0.,0.,1.,1.,1.,+
+,1.,0.,0.
GRID,1,,0.,0.,0.,5
GRID,2,,2.,0.,0.
GRID,3,,2.,1.5,.3,5
GRID,4,,0.,1.,1.
GRID,5,,2.,0.,0.,
"""
BODIES = {
    "RBAR1": ("RBAR1,9,1,3", 6),
    "RBAR1 in part": ("RBAR1,9,1,3,135", 3),
    "RJOINT": ("RJOINT,9,2,5,12346", 5),
    "RTRPLT": ("RTRPLT,9,1,2,4,123,23,2,,+\n+,456,1456,13456", 12),
    "RTRPLT1": ("RTRPLT1,9,1,2,3,123,456", 6),
    "RBE1": ("RBE1,9,1,123,2,23,4,2,,+\n+,UM,3,123456,2,1456,4,13456", 15),
    "RBE1, two lines": ("RBE1,9,1,123456,,,,,,+\n+,UM,2,1,3,2,4,3,,+\n+,,4,456", 6),
    "RROD": ("RROD,9,1,4,,3", 1),
    "RSPLINE": ("RSPLINE,9,.1,1,2,123456,4", 6),
    "RSPLINE in part": ("RSPLINE,9,.1,1,2,123,3,35,4", 5),
}


@pytest.mark.parametrize("name", BODIES)
def test_rigid_motion_obeys_the_equations(model, name):
    """In turned frames; as many freedoms depend as the card says."""
    card, count = BODIES[name]
    made = model(GRIDS + card)
    m = made.elimination
    assert len(m.m) == count
    body = rigid_modes(made.points, np.zeros(3))
    np.testing.assert_allclose(m.dependence @ body, body[m.m], atol=1e-10)


@pytest.mark.parametrize("name", ["RBAR1", "RTRPLT", "RTRPLT1", "RBE1"])
def test_bodies_are_as_rigid_as_rbe2(model, name):
    """What depends moves only with the body: six motions are left of its freedoms."""
    made = model(GRIDS + BODIES[name][0])
    m = made.elimination
    moving = np.unique(m.dependence.indices)
    body = rigid_modes(made.points, np.zeros(3))
    assert len(moving) <= 6
    assert np.linalg.matrix_rank(body[moving]) == len(moving)


def test_a_joint_lets_go_of_what_it_leaves_out(model):
    m = model(GRIDS + BODIES["RJOINT"][0]).elimination
    labels = {made for made in m.m % 6}
    assert labels == {0, 1, 2, 3, 5}


def test_a_rigid_rod_keeps_its_length(model):
    """(u_B - u_A) . e = 0 for any motion of the others."""
    made = model(GRIDS + BODIES["RROD"][0])
    m = made.elimination
    u = m.T @ np.random.default_rng(1).normal(size=m.T.shape[1])
    u = u.reshape(-1, 6)[:, :3]
    a, b = made.points.rows([1, 4])
    basic = [made.points.rotation[k] @ u[k] for k in (a, b)]
    line = made.points.xyz[b] - made.points.xyz[a]
    assert (basic[1] - basic[0]) @ line == pytest.approx(0.0, abs=1e-12)


def test_a_spline_is_a_cubic_across_and_linear_along(model):
    """Between ends that move: Hermite's cubic, its slope, mean stretch and twist."""
    grids = "".join(f"GRID,{k},,{x},0.,0.\n" for k, x in ((1, 0.0), (2, 1.0), (3, 4.0)))
    made = model(grids + "RSPLINE,9,.2,1,2,123456,3")
    m = made.elimination
    ends = np.random.default_rng(2).normal(size=(2, 6))
    free = np.zeros(18)
    free[:6], free[12:] = ends
    found = m.dependence @ free
    length, s = 4.0, 0.25
    h = np.array([1 - 3 * s**2 + 2 * s**3, 3 * s**2 - 2 * s**3])
    g = length * np.array([s - 2 * s**2 + s**3, s**3 - s**2])
    dh = np.array([-6 * s + 6 * s**2, 6 * s - 6 * s**2]) / length
    dg = np.array([1 - 4 * s + 3 * s**2, 3 * s**2 - 2 * s])
    share = np.array([1 - s, s])
    expected = [
        share @ ends[:, 0],
        h @ ends[:, 1] + g @ ends[:, 5],
        h @ ends[:, 2] - g @ ends[:, 4],
        share @ ends[:, 3],
        dg @ ends[:, 4] - dh @ ends[:, 2],
        dg @ ends[:, 5] + dh @ ends[:, 1],
    ]
    np.testing.assert_allclose(found, expected, atol=1e-12)


@pytest.mark.parametrize(
    ("card", "message"),
    [
        ("RBE1,9,1,123,2,13,,,,+\n+,UM,3,123456", "RBE1 9: 5 independent components"),
        ("RBE1,9,1,123456", "expected UM"),
        ("RTRPLT,9,1,2,4,123,13,2,,+\n+,456,2,1", "do not determine a rigid motion"),
        ("RROD,9,2,5,1", "its grids coincide"),
        ("RROD,9,2,4,3,3", "expected one of 1, 2, 3 in one of them"),
        ("RSPLINE,9,.1,1,2,123,3,123", "the last without components"),
        ("RBAR1,9,1,99", "RBE1 9: GRID 99|grid 99 is not defined"),
    ],
)
def test_what_cannot_be_is_said(model, card, message):
    with pytest.raises(InputError, match=message):
        model(GRIDS + card)
