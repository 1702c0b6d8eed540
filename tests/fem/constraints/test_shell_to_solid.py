"""RSSCON: rigid motion, a commercial code's relations, a plate clamped in a block."""

import numpy as np
import pytest

from fem.errors import InputError
from fem.model.structure import Structure
from fem.model.weight import rigid_modes

# A block of 1 x 1 x 0.2, a plate of 4 x 1 at half its height.
GRIDS = """\
GRID,1,,0.,0.,-.1
GRID,2,,1.,0.,-.1
GRID,3,,1.,1.,-.1
GRID,4,,0.,1.,-.1
GRID,5,,0.,0.,.1
GRID,6,,1.,0.,.1
GRID,7,,1.,1.,.1
GRID,8,,0.,1.,.1
GRID,12,,1.,0.,0.,{cd}
GRID,13,,1.,1.,0.,{cd}
GRID,14,,5.,0.,0.
GRID,15,,5.,1.,0.
CORD2R,9,,0.,0.,0.,1.,2.,3.
,3.,-1.,1.
CHEXA,1,1,1,2,3,4,5,6
,7,8
PSOLID,1,1
CQUAD4,2,2,12,14,15,13
PSHELL,2,1,.2,1,,1
MAT1,1,7.+10,,.0
SPC1,1,123,1,4,5,8
"""
BY_ELEMENTS = "RSSCON,7,ELEM,2,1\n"
BY_GRIDS = "RSSCON,7,GRID,12,2,6,13,3,7\n"


@pytest.mark.parametrize("ties", [BY_ELEMENTS, BY_GRIDS])
@pytest.mark.parametrize("cd", ["", "9"])
def test_rigid_motions_pass_through(model, ties, cd):
    made = model(GRIDS.format(cd=cd) + ties)
    elimination, motions = made.elimination, rigid_modes(made.points, np.zeros(3))
    assert len(elimination.m) == 10
    rest = motions[elimination.m] - elimination.dependence @ motions
    assert np.abs(rest).max() < 1e-12


def test_corner_grids_move_as_in_a_commercial_code(model):
    """MSC's rs321h: grids 1099, 1107 of the solid, 1112 of the shell (printed)."""
    text = """\
GRID,1,,0.,.1,3.
GRID,2,,0.,.2,3.
GRID,3,,0.,.1,3.
RSSCON,1,GRID,3,1,2
"""
    made = model(text)
    u = np.zeros(made.points.size)
    u[0:3] = 1.7700e-7, -6.8571e-3, -1.1702e-5
    u[6:9] = 1.9428e-5, -6.8592e-3, 4.5080e-4
    own = made.elimination
    found = dict(zip(own.m.tolist(), own.dependence @ u))
    expected = {12: 1.77e-7, 13: -6.8571e-3, 14: -1.1702e-5, 15: 4.625e-3}
    expected[17] = -1.9251e-4
    assert found == pytest.approx(expected, rel=1e-4)


def test_a_plate_in_a_block_bends_as_a_beam(model):
    """Tip of a cantilever of one height, nu = 0, in cylindrical bending."""
    made = Structure(model(GRIDS.format(cd="") + BY_ELEMENTS, "SPC = 1").deck)
    load = np.zeros(made.points.size)
    load[made.points.dof(np.array([14, 15]), np.array([3, 3]))] = 500.0
    u = made.displacement(np.linalg.solve(made.stiffness.toarray(), made.load(load)))
    tip = u[made.points.dof(np.array([14]), np.array([3]))][0]
    inertia, length = 0.2**3 / 12.0, 5.0
    assert tip == pytest.approx(1000.0 * length**3 / (3.0 * 7e10 * inertia), rel=0.02)


def test_a_grid_of_the_solid_turns_with_its_face(model):
    text = GRIDS.format(cd="").replace("CQUAD4,2,2,12,14,15,13", "CQUAD4,2,2,2,14,15,3")
    made = model(text + "RSSCON,7,ELEM,2,1\n")
    assert made.points.label(int(made.elimination.m[0])) == "grid 2 R1"
    assert len(made.elimination.m) == 4


@pytest.mark.parametrize(
    ("tie", "message"),
    [
        ("RSSCON,7,ELEM,5,1\n", "RSSCON 7: element .*CQUAD4.* 5 is not defined"),
        ("RSSCON,7,ELEM,2,5\n", "RSSCON 7: element .*CHEXA.* 5 is not defined"),
        ("RSSCON,7,NODE,12,2\n", "TYPE: found 'NODE', expected ELEM or GRID"),
        ("RSSCON,7,GRID,12,2\n", "ES1 12 needs EA1 and EB1"),
        ("RSSCON,7,GRID,12,2,2\n", "EA and EB of grid 12 coincide"),
    ],
)
def test_ties_that_cannot_be_are_named(model, tie, message):
    with pytest.raises(InputError, match=message):
        _ = model(GRIDS.format(cd="") + tie).elimination


def test_a_shell_beside_the_solid_is_named(model):
    text = GRIDS.format(cd="").replace("GRID,12,,1.,0.,0.", "GRID,12,,1.,0.,.4")
    text = text.replace("GRID,13,,1.,1.,0.", "GRID,13,,1.,1.,.4")
    with pytest.raises(InputError, match="no edge of the shell 2"):
        _ = model(text + BY_ELEMENTS).elimination
