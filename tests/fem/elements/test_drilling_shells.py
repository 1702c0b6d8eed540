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
@pytest.mark.parametrize(
    "elements", ["CQUADR,1,1,1,2,3,4", "CTRIAR,1,1,1,2,3|CTRIAR,2,1,1,3,4"]
)
def test_rectangles_bend_in_their_plane_exactly(model, length, elements):
    """One element along and one across, at any aspect ratio: M = E I / R."""
    grids = [(0, 0), (length, 0), (length, 1), (0, 1)]
    bulk = "".join(f"GRID,{k + 1},,{x},{y},0.\n" for k, (x, y) in enumerate(grids))
    made = model(bulk + elements.replace("|", "\n") + "\nPSHELL,1,1,.2\n" + STEEL)
    x, y = np.array(grids, float).T - np.array([[length / 2], [0.5]])
    u = np.zeros((4, 6))
    u[:, 0], u[:, 1], u[:, 5] = -x * y, 0.5 * (x * x + 0.3 * y * y), x
    energy = 0.0
    for block in made.blocks:
        moved = u.ravel()[block.dof]
        energy += np.einsum("ei,eij,ej->", moved, block.stiffness(), moved)
    assert energy == pytest.approx(200.0 * 0.2 / 12.0 * length, rel=1e-9)


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
