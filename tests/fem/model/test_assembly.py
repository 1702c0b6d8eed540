"""Assembly: frames, numbering, grounded and repeated freedoms, direct input, NSM."""

from dataclasses import dataclass

import numpy as np
import pytest

from fem.elements.dense import DenseBlock
from fem.errors import InputError
from fem.geometry.points import Points
from fem.model.assembly import assemble
from fem.model.weight import rigid_modes

FRAME = """
CORD2R,1,,1.,2.,3.,2.,3.,5.
,4.,1.,2.
CORD2C,2,,-1.,-2.,.5,.3,-2.2,4.
,3.,1.,1.
MAT1,1,7.+10,,.33,2700.,,,.02
PBAR,1,1,2.-3,3.-6,5.-6,4.-6
"""
XYZ = np.array([[0, 0, 0], [1, 0.2, 0], [1, 1, 0.3], [2, 1, 1.0]])


def _bars(ids: list[int], cd: list[int], order: list[int]) -> str:
    lines = [
        f"GRID,{i},,{x[0]:.3f},{x[1]:.3f},{x[2]:.3f},{c}"
        for i, c, x in zip(ids, cd, XYZ)
    ]
    for k in order:
        # Orientation by a grid, so that it does not depend on frames.
        lines.append(f"CBAR,{k + 1},1,{ids[k]},{ids[k + 1]},{ids[(k + 2) % 4]}")
    lines.append(f"CONM2,9,{ids[3]},-1,5.,2.5,1.,1.\n,.1,.02,.2,.01,.03,.3")
    return FRAME + "\n".join(lines)


def _eigenvalues(built) -> np.ndarray:
    k = built.matrices.stiffness.toarray()
    m = built.matrices.mass.toarray() + 1e-3 * np.eye(len(k))
    return np.sort(np.linalg.eigvals(np.linalg.solve(m, k)).real)[6:]


def test_results_depend_neither_on_displacement_frames_nor_on_numbering(model):
    plain = model(_bars([1, 2, 3, 4], [0, 0, 0, 0], [0, 1, 2]))
    turned = model(_bars([1, 2, 3, 4], [1, 2, 2, 1], [0, 1, 2]))
    numbered = model(_bars([40, 7, 300, 2], [2, 0, 1, 1], [2, 0, 1]))
    expected = _eigenvalues(plain)
    for other in (turned, numbered):
        assert _eigenvalues(other) == pytest.approx(expected, rel=1e-7)
        assert abs(other.matrices.stiffness - other.matrices.stiffness.T).max() == 0


def test_turned_matrix_is_the_rotated_one(model):
    plain = model(_bars([1, 2, 3, 4], [0, 0, 0, 0], [0, 1, 2]))
    turned = model(_bars([1, 2, 3, 4], [1, 2, 2, 1], [0, 1, 2]))
    rotation = turned.points.basic_rotation()
    for name in ("stiffness", "mass", "structural_damping"):
        expected = rotation.T @ getattr(plain.matrices, name) @ rotation
        difference = abs(getattr(turned.matrices, name) - expected).max()
        assert difference < 1e-14 * abs(expected).max()


def test_structural_damping_is_ge_times_stiffness(model):
    built = model(_bars([1, 2, 3, 4], [1, 0, 0, 2], [0, 1, 2]))
    difference = built.matrices.structural_damping - 0.02 * built.matrices.stiffness
    assert abs(difference).max() < 1e-12 * abs(built.matrices.stiffness).max()


@dataclass(frozen=True, kw_only=True)
class _Given(DenseBlock):
    """Elements with matrices as given."""

    k: np.ndarray

    def stiffness(self) -> np.ndarray:
        return self.k


def _three_scalars() -> Points:
    return Points(
        grid_id=np.zeros(0, np.int64),
        xyz=np.zeros((0, 3)),
        rotation=np.zeros((0, 3, 3)),
        ps=np.zeros((0, 6), bool),
        spoint_id=np.array([1, 2, 3]),
    )


def test_a_freedom_named_twice_and_ground():
    """The element matrix is summed onto the freedoms: aᵀ K a with a the incidence."""
    rng = np.random.default_rng(0)
    half = rng.normal(size=(2, 3, 3))
    k = half + half.transpose(0, 2, 1)
    dof = np.array([[2, 0, 2], [-1, 1, 0]])
    block = _Given(card="X", id=np.array([1, 2]), dof=dof, frame="displacement", k=k)
    total = assemble(_three_scalars(), [block]).stiffness.toarray()
    expected = np.zeros((3, 3))
    for matrix, rows in zip(k, dof):
        for i, a in enumerate(rows):
            for j, b in enumerate(rows):
                if a >= 0 and b >= 0:
                    expected[a, b] += matrix[i, j]
    assert total == pytest.approx(expected, rel=1e-14)


def test_pieces_give_the_whole(monkeypatch, model):
    built = model(_bars([1, 2, 3, 4], [1, 0, 0, 2], [0, 1, 2]))
    monkeypatch.setattr("fem.model.assembly._PIECE", 100)
    pieces = assemble(built.points, built.blocks).stiffness
    assert abs(pieces - built.matrices.stiffness).max() <= 1e-15 * abs(pieces).max()


def test_wtmass_multiplies_elements_and_not_direct_input(model):
    bulk = "SPOINT,1,2\nCMASS2,1,3.,1\nDMIG,MA,0,6,1\nDMIG,MA,2,0,,2,0,5.\n"
    built = model(bulk + "PARAM,WTMASS,.1\nPARAM,CM2,2.", "M2GG=MA")
    assert built.matrices.mass.diagonal() == pytest.approx([0.3, 10.0])


def test_direct_input_of_stiffness_and_damping(model):
    built = model(
        "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nDMIG,KA,0,6,1\nDMIG,KA,1,2,,1,2,5.\n"
        ",2,3,-4.\nDMIG,BA,0,6,1\nDMIG,BA,2,6,,2,6,.5",
        "K2GG=KA\nB2GG=BA",
    )
    k = built.matrices.stiffness
    assert (k[1, 1], k[8, 1], k[1, 8]) == (5.0, -4.0, -4.0)
    assert built.matrices.damping[11, 11] == 0.5


def test_direct_input_that_is_not_there_is_named(model):
    with pytest.raises(InputError, match="KB"):
        model("SPOINT,1\nDMIG,KA,0,6,1\nDMIG,KA,1,0,,1,0,5.", "K2GG=KB")


ROD_AND_BAR = """
MAT1,1,7.+10,,.33,0.
PBAR,1,1,2.-3,3.-6,5.-6,4.-6
PBAR,2,1,2.-3,3.-6,5.-6,4.-6
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,4.,0.,0.
CBAR,1,1,1,2,0.,1.,0.
CBAR,2,2,2,3,0.,1.,0.
CONROD,3,1,3,1,.01
"""


@pytest.mark.parametrize(
    ("cards", "total"),
    [
        ("NSM1,5,PBAR,.5,ALL", 0.5 * 4),
        ("NSM1,5,PBAR,.5,2", 0.5 * 3),
        ("NSM1,5,ELEMENT,.5,1,3", 0.5 * 5),
        ("NSML1,5,ELEMENT,.5,1,THRU,3", 0.5),
        ("NSML1,5,PBAR,.7,1,2", 0.7),
        ("NSML,5,PBAR,1,.7,2,.2", 0.9),
        ("NSM,1,PBAR,1,.7\nNSML1,2,ELEMENT,.3,3\nNSMADD,5,1,2", 1.0),
    ],
)
def test_nonstructural_mass(model, cards, total):
    built = model(ROD_AND_BAR + cards, "NSM=5")
    translations = built.matrices.mass.diagonal().reshape(-1, 6)[:, :3].sum(axis=0)
    assert translations == pytest.approx(np.full(3, total), rel=1e-12)


def test_nonstructural_mass_without_elements_is_refused(model):
    with pytest.raises(InputError, match="no element of PBAR"):
        model(ROD_AND_BAR + "NSML1,5,PBAR,.7,77", "NSM=5")


def test_undefined_references_are_reported_together(model):
    bulk = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nMAT1,1,1.,,.3\n"
    with pytest.raises(InputError) as error:
        model(
            bulk + "CBAR,1,7,1,2,0.,1.,0.\nPBAR,8,1,1.\nCELAS1,2,9,1,1\n"
            "CROD,3,4,1,2\nPROD,4,77,1."
        )
    text = str(error.value)
    for expected in ("CBAR 1", "PBAR 7", "PELAS 9", "MAT1 77"):
        assert expected in text


@pytest.mark.parametrize(
    ("card", "message"),
    [
        ("CBAR,1,1,1,3,0.,1.,0.", "no length"),
        ("CBAR,1,1,1,2,1.,0.,0.", "orientation vector"),
        ("CONROD,1,1,3,1,1.", "no length"),
        ("CBUSH,1,1,1,3", "CID is needed"),
        ("CBUSH,1,1,1,2", "needs axes"),
        ("CTUBE,1,5,1,2", "do not make a tube"),
    ],
)
def test_impossible_elements_are_refused(model, card, message):
    bulk = (
        "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,0.,0.\nMAT1,1,1.,,.3\n"
        "PBAR,1,1,1.\nPBUSH,1,K,1.,2.\nPTUBE,5,1,.1,.2\n"
    )
    with pytest.raises(InputError, match=message):
        model(bulk + card)


def _brick(far: str) -> str:
    """A unit cube, and one whose corner 4 lies far away along x."""
    return f"""\
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,,0.,0.,1.
GRID,6,,1.,0.,1.
GRID,7,,1.,1.,1.
GRID,8,,0.,1.,1.
GRID,13,,{far},1.,0.
CHEXA,1,3,1,2,3,4,5,6,
,7,8
CHEXA,6,3,1,2,13,4,5,6,
,7,8
PSOLID,3,1
MAT1,1,7.+10,,.3
"""


def test_rigid_motion_meets_no_force_of_a_slender_solid(model):
    """Σ K R, a sum of some twenty numbers, is rounding of the largest of K."""
    built = model(_brick("30."))
    k = built.matrices.stiffness
    forces = k @ rigid_modes(built.points, np.zeros(3))[:, :3]
    assert abs(forces).max() < 100 * np.finfo(float).eps * abs(k).max()


def test_elements_without_stiffness_are_named(model):
    with pytest.raises(InputError, match="CHEXA 6: no stiffness can be computed"):
        _ = model(_brick("4.+14")).matrices
