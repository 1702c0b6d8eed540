"""GENEL, CBUSH1D and CGAP: matrices, rigid motion, results, refusals.

Displacements of GENEL in both forms and forces of open gaps are those of MSC and NX
Nastran (their demonstration problems of a gap and of a pylon).
"""

import numpy as np
import pytest

from fem.elements.registry import element_notices
from fem.errors import InputError
from fem.model.weight import rigid_modes

GRIDS = "CORD2R,5,,0.,0.,0.,0.,1.,1.,+\n+,1.,0.,0.\nGRID,1,,1.,2.,3.\n"
GRIDS += "GRID,2,,2.,2.,4.,5\nGRID,3,,1.,2.,3.\n"
UI = "GENEL,9,,2,1,2,2,2,3,+\n+,2,4,2,5,2,6,,,+\n"
UD = "+,UD,,1,1,1,2,1,3,+\n+,1,4,1,5,1,6,,,+\n"
DIAGONAL = "+,{form},{0},,,,,,{1},+\n+,,,,,{2},,,,+\n+,{3},,,{4},,{5}"


def diagonal(form: str, values: list[float]) -> str:
    return DIAGONAL.format(*(repr(float(v)) for v in values), form=form)


def test_a_flexibility_is_the_inverse_of_a_stiffness(model):
    values = [1.0, 2.0, 4.0, 5.0, 8.0, 10.0]
    (soft,) = model(GRIDS + UI + UD + diagonal("Z", [1 / v for v in values])).blocks
    (stiff,) = model(GRIDS + UI + UD + diagonal("K", values)).blocks
    np.testing.assert_allclose(soft.matrix, stiff.matrix, atol=1e-12)
    np.testing.assert_allclose(np.diag(stiff.matrix[0])[:6], values)


def test_six_freedoms_make_a_general_element_free_in_rigid_motion(model):
    """In displacement frames that are turned, without S."""
    made = model(GRIDS + UI + UD + diagonal("K", [1.0] * 6))
    (block,) = made.blocks
    body = rigid_modes(made.points, np.zeros(3))
    force = block.matrix[0] @ body[block.dof[0]]
    assert np.abs(force).max() < 1e-12


def test_given_motions_stand_in_for_those_of_a_rigid_body(model):
    text = "GENEL,9,,2,1,2,2,,,+\n+,UD,,1,1,1,2,,,+\n+,K,3.,1.,2.,,,,,+\n"
    (block,) = model(GRIDS + text + "+,S,.5,.25,0.,1.").blocks
    k, s = np.array([[3.0, 1.0], [1.0, 2.0]]), np.array([[0.5, 0.25], [0.0, 1.0]])
    expected = np.block([[k, -k @ s], [-s.T @ k, s.T @ k @ s]])
    np.testing.assert_allclose(block.matrix[0], expected)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("GENEL,9,,2,1,2,2,,,+\n+,UD,,1,1,1,2,,,+\n+,K,1.,,1.", "2 freedoms UD"),
        ("GENEL,9,,2,1,2,2,,,+\n+,Z,1.,1.,1.", "singular"),
        ("GENEL,9,,2,1,2,2", "expected K or Z"),
    ],
)
def test_what_a_general_element_lacks_is_said(model, text, message):
    with pytest.raises(InputError, match=message):
        model(GRIDS + text)


def test_an_axial_bushing_is_a_bushing_along_its_line(model):
    made = model(
        GRIDS + "CBUSH1D,1,7,1,2\nPBUSH1D,7,100.,3.,.4,,2.,.5\n"
        "CBUSH,2,8,1,2,,,,,+\nPBUSH,8,K,100.\n"
    )
    line, bush = sorted(made.blocks, key=lambda b: b.id[0])
    np.testing.assert_allclose(line.stiffness(), bush.stiffness(), atol=1e-12)
    np.testing.assert_allclose(line.damping(), 0.03 * line.stiffness(), atol=1e-12)
    assert np.trace(line.mass(coupled=False)[0, :3, :3]) == pytest.approx(0.6)
    stretched = np.zeros(12)
    stretched[6:9] = [0.1, 0.0, 0.1]
    elongation = 0.1 * np.sqrt(2.0)
    assert line.forces().matrix[0] @ stretched == pytest.approx(100.0 * elongation)
    assert line.stresses().matrix[0] @ stretched == pytest.approx(200.0 * elongation)
    assert line.strains().matrix[0] @ stretched == pytest.approx(0.5 * elongation)


def test_coincident_ends_take_the_axis_of_their_system(model):
    text = GRIDS + "CBUSH1D,1,7,1,3,{}\nPBUSH1D,7,100.\n"
    (block,) = model(text.format(5)).blocks
    # Its x axis is y of the basic frame... found from the points of CORD2R 5.
    axis = model(text.format(5)).points.frames.triads(np.array([5]), np.zeros((1, 3)))
    expected = 100.0 * np.outer(axis[0, :, 0], axis[0, :, 0])
    np.testing.assert_allclose(block.stiffness()[0, :3, :3], expected, atol=1e-12)
    with pytest.raises(InputError, match="CID is needed"):
        model(text.format(""))


@pytest.mark.parametrize(
    ("gap", "along", "across"), [("0.,,", 50.0, 5.0), (".1,,", 5e-13, 0.0)]
)
def test_a_gap_is_as_at_the_start(model, gap, along, across):
    made = model(GRIDS + f"CGAP,1,7,1,2,0.,1.,0.\nPGAP,7,{gap}50.,,5.\n")
    (block,) = made.blocks
    axis = np.array([1.0, 0.0, 1.0]) / np.sqrt(2.0)
    along_it = np.r_[np.zeros(6), axis, np.zeros(3)]
    over_it = np.r_[np.zeros(6), 0.0, 1.0, 0.0, np.zeros(3)]
    stiffness = block.stiffness()[0]
    assert along_it @ stiffness @ along_it == pytest.approx(along)
    assert over_it @ stiffness @ over_it == pytest.approx(across)
    assert block.forces().matrix[0, 0] @ along_it == pytest.approx(-along)
    assert "neither opens nor closes" in element_notices(made.deck, made.points)[-1]


def test_laminates_of_one_material_are_those_ply_by_ply(model):
    """PCOMP1 and PCOMP2 against PCOMP, mirrored or not."""
    shell = "GRID,11,,0.,0.,0.\nGRID,12,,1.,0.,0.\nGRID,13,,0.,1.,0.\n"
    shell += "CTRIA3,1,1,11,12,13\nMAT8,4,9.,1.,.3,2.,2.,2.,.1\n"
    plies = "+,4,.1,0.,YES,4,.1,30.,YES,+\n+,4,.1,90.,YES"
    for lam in ("", "SYM"):
        laminates = (
            f"PCOMP,1,,.2,,,,,{lam},+\n{plies}",
            f"PCOMP1,1,,.2,,,4,.1,{lam},+\n+,0.,30.,90.",
            f"PCOMP2,1,,.2,,,4,{lam},,+\n+,.1,0.,.1,30.,.1,90.",
        )
        one, *others = [model(shell + text).blocks[0] for text in laminates]
        for other in others:
            np.testing.assert_array_equal(other.stiffness(), one.stiffness())
            mass = one.mass(coupled=False)
            np.testing.assert_array_equal(other.mass(coupled=False), mass)
