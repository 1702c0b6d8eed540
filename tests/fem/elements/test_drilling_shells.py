"""CQUADR and CTRIAR: rank, rigid motion, bending in the plane, drilling, laminates.

Patch tests and Cook's membrane: benchmarks/verification/drilling_shells.py.
"""

import numpy as np
import pytest

from fem.model.weight import rigid_modes

STEEL = "MAT1,1,200.,,.3,7.8-9\n"
WARPED = "GRID,1,,0.,0.,0.\nGRID,2,,1.,.1,.1\nGRID,3,,1.2,.9,.3\nGRID,4,,-.1,1.,.1\n"
PLY = "MAT8,8,140.,9.,.3,5.,4.,3.,1.5-9\n"
LAMINATE = PLY + "PCOMP,1,,,,,,,,+\n+,8,.1,0.,YES,8,.1,45.,YES\n"
ELEMENTS = {"CQUADR": "1,2,3,4,20.,.05", "CTRIAR": "1,2,3,20.,.05"}
cards = pytest.mark.parametrize("card", list(ELEMENTS))
properties = pytest.mark.parametrize(
    "section", ["PSHELL,1,1,.2,1,,1\n" + STEEL, LAMINATE], ids=["sheet", "laminate"]
)


@cards
@properties
def test_six_motions_without_energy_and_no_other(model, card, section):
    """Warped, offset; the rotation about the normal is stiff without K6ROT."""
    element = f"{card},1,1,{ELEMENTS[card]}\n"
    made = model(WARPED + element + section + "PARAM,K6ROT,0.\n")
    (block,) = made.blocks
    stiffness = block.stiffness()[0]
    value = np.linalg.eigvalsh(stiffness)
    assert np.abs(value[:6]).max() < 1e-13 * value[-1]
    assert value[6] > 1e-5 * value[-1]
    rigid = rigid_modes(made.points, np.zeros(3))[block.dof[0]]
    assert np.abs(stiffness @ rigid).max() < 1e-12 * value[-1]
    for kind in ("force", "stress", "strain"):
        matrix = block.recovery(kind).matrix[0]
        assert np.abs(matrix @ rigid).max() < 1e-10 * np.abs(matrix).max()


@pytest.mark.parametrize("length", [0.5, 1.0, 10.0])
def test_rectangles_bend_in_their_plane_exactly(model, length):
    """One element along and one across, at any aspect ratio: M = E I / R."""
    grids = [(0, 0), (length, 0), (length, 1), (0, 1)]
    bulk = "".join(f"GRID,{k + 1},,{x},{y},0.\n" for k, (x, y) in enumerate(grids))
    made = model(bulk + "CQUADR,1,1,1,2,3,4\nPSHELL,1,1,.2\n" + STEEL)
    x, y = np.array(grids, float).T - np.array([[length / 2], [0.5]])
    u = np.zeros((4, 6))
    u[:, 0], u[:, 1], u[:, 5] = -x * y, 0.5 * (x * x + 0.3 * y * y), x
    (block,) = made.blocks
    moved = u.ravel()[block.dof[0]]
    energy = moved @ block.stiffness()[0] @ moved
    assert energy == pytest.approx(200.0 * 0.2 / 12.0 * length, rel=1e-9)


# Displacements and grid point forces of MSC Nastran (static_elements of pyNastran's
# models), elements of the side of a box: thickness 1, E 2.9e7, nu 0.32.
BOX = "MAT1,1,2.9+7,1.1+7,.32\nPSHELL,1,1,1.,1,,1\n"
RIGHT_TRIANGLE = (
    "GRID,1,,1.,0.,-2.\nGRID,2,,1.,0.,-3.\nGRID,3,,1.,1.,-2.\nCTRIAR,1,1,1,2,3\n",
    """-1.416994492e-3 9.647306288e-4 8.910967153e-4 -9.972613771e-4 -1.338503323e-3
    5.537824472e-4 0 0 0 0 0 0 -2.173993271e-3 9.159695473e-4 4.428036427e-4
    -6.058436120e-4 -1.520713791e-3 4.747330386e-4""",
    """2027.032 20.377592 -7896.7163 -1147.66357 486.989014 63.764355 -3219.79248
    3992.9519 11795.12012 474.233612 -3377.713135 1002.799255 1192.76038 -4013.32935
    -3898.40332 578.881470 -329.068359 126.196785""",
)
SQUARE = (
    "GRID,1,,0.,0.,-2.\nGRID,2,,0.,1.,-2.\nGRID,3,,0.,1.,-3.\nGRID,4,,0.,0.,-3.\n"
    "CQUADR,1,1,1,2,3,4\n",
    """-1.187934307e-3 4.954097094e-4 -1.815055438e-4 -5.504430155e-4 -1.417779247e-3
    6.741603720e-4 -1.990247518e-3 5.500577390e-4 -6.113479030e-4 -7.970611332e-4
    -1.417710679e-3 4.141707323e-4 0 0 0 0 0 0 0 0 0 0 0 0""",
    """2028.6012 -3494.08105 6651.29297 630.687439 246.717270 470.846832 4624.36328
    -62.684040 5422.606934 -755.941223 131.889160 -283.962952 -3648.783447 3729.929443
    -8628.390625 594.592163 -3573.168701 -99.721321 -3004.181152 -173.164398
    -3445.509521 -820.320130 -3458.402344 888.417419""",
)


@pytest.mark.parametrize("case", [RIGHT_TRIANGLE, SQUARE], ids=["CTRIAR", "CQUADR"])
def test_grid_point_forces_are_those_of_msc(model, case):
    bulk, displacement, force = case
    (block,) = model(bulk + BOX).blocks
    moved, theirs = (np.array(text.split(), float) for text in (displacement, force))
    ours = -block.stiffness()[0] @ moved
    np.testing.assert_allclose(ours, theirs, atol=1e-5 * np.abs(theirs).max())


def test_an_isosceles_triangle_under_temperature_moves_as_in_msc(model):
    """Deck cqra00366 of pyNastran's models: held at its base, rotations free there."""
    bulk = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,.5,1.,0.\nCTRIAR,1,1,1,2,3\n"
    (block,) = model(bulk + "PSHELL,1,1,.1\nMAT1,1,1.,,.1\n").blocks
    x, y = np.array([[0.0, 1.0, 0.5], [0.0, 0.0, 1.0]])
    grown = np.zeros((3, 6))
    grown[:, 0], grown[:, 1] = 0.01 * x, 0.01 * y
    stiffness = block.stiffness()[0]
    free = np.array([5, 11, 12, 13])
    load = stiffness @ grown.ravel()
    found = np.linalg.solve(stiffness[np.ix_(free, free)], load[free])
    theirs = [0.02235927, -0.02125483, 0.00016162, 0.01572486]
    np.testing.assert_allclose(found, theirs, rtol=1e-6, atol=1e-8)


@pytest.mark.parametrize(
    ("material", "plate", "xyz", "load", "theirs"),
    [
        # Elements 7001, 7002 and 7051 of api3 and cqra00366: w, R1, R2 of the last.
        (
            "MAT1,1,1.+7,,.25\n",
            ".05,1",
            ((0, 0), (1, 0), (0, 1), (1, 1)),
            2.0,
            (4.557673e-3, 5.890158e-3, -5.890158e-3),
        ),
        (
            "MAT1,1,1.,.8,.1\n",
            ".1,1,1000.,1,1.",
            ((0, 0), (1, 0), (0.5, 1)),
            1.0,
            (31.93, 11.88, 0.0),
        ),
    ],
    ids=["square of two", "isosceles"],
)
def test_triangles_deflect_as_in_msc(model, material, plate, xyz, load, theirs):
    bulk = "".join(f"GRID,{k + 1},,{x},{y},0.\n" for k, (x, y) in enumerate(xyz))
    bulk += "CTRIAR,1,1,1,2,3\n" if len(xyz) == 3 else "CTRIAR,1,1,1,2,4\n"
    bulk += "" if len(xyz) == 3 else "CTRIAR,2,1,4,3,1\n"
    (block,) = model(bulk + f"PSHELL,1,1,{plate}\n" + material).blocks
    whole = np.zeros((6 * len(xyz),) * 2)
    for dof, own in zip(block.dof, block.stiffness()):
        whole[np.ix_(dof, dof)] += own
    free = whole[-4:-1, -4:-1]
    found = np.linalg.solve(free, [load, 0.0, 0.0])
    np.testing.assert_allclose(found, theirs, rtol=1e-6, atol=1e-9)


@cards
def test_a_moment_about_the_normal_turns_the_corner(model, card):
    """A couple on a corner does work on the membrane: no penalty stands in between."""
    square = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n"
    element = f"{card},1,1,{ELEMENTS[card].split(',20')[0]}\n"
    (block,) = model(square + element + "PSHELL,1,1,.2\n" + STEEL).blocks
    stiffness = block.stiffness()[0][5, 5]
    shear = 200.0 / 2.6 * 0.2
    assert 0.01 * shear < stiffness < shear


@cards
def test_uniform_strain_of_a_laminate_gives_its_resultants(model, card):
    """Membrane and coupling: N = A e, M = B e, as of CQUAD4 and CTRIA3."""
    plain = {"CQUADR": "CQUAD4", "CTRIAR": "CTRIA3"}[card]
    flat = WARPED.replace(",.1\n", ",0.\n").replace(",.3\n", ",0.\n")
    strain = np.zeros((4, 6))
    xy = np.array([[0, 0], [1, 0.1], [1.2, 0.9], [-0.1, 1.0]])
    strain[:, :2] = xy @ np.array([[1.0, 0.4], [0.2, -0.5]])
    strain[:, 5] = 0.5 * (0.4 - 0.2)
    found = []
    for name in (card, plain):
        text = flat + f"{name},1,1,{ELEMENTS[card].split(',.05')[0]}\n" + LAMINATE
        (block,) = model(text).blocks
        u = strain.ravel()[block.dof[0]]
        found.append((block.resultants()[0, 0] @ u, u @ block.stiffness()[0] @ u))
    (forces, energy), (theirs, their_energy) = found
    np.testing.assert_allclose(forces, theirs, atol=1e-12 * np.abs(theirs).max())
    assert energy == pytest.approx(their_energy, rel=1e-5)
