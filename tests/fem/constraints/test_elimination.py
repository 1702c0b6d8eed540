"""Elimination: rigid motion passes, chains, cycles, conflicts, forces, AUTOSPC."""

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve

from fem.constraints.autospc import find_singularities
from fem.errors import InputError
from fem.model.weight import rigid_modes

FRAMES = """
CORD2R,1,,1.,2.,3.,2.,3.,5.
,4.,1.,2.
CORD2C,2,,-1.,-2.,.5,.3,-2.2,4.
,3.,1.,1.
GRID,1,,0.,0.,0.,1
GRID,2,,2.,0.3,0.1,2
GRID,3,,.1,2.,.2,2
GRID,4,,1.,2.,3.,1
GRID,5,,-1.,.5,.7
"""
RIGID = {
    "RBE2": "RBE2,1,1,123456,2,3,4",
    "RBE2 partly": "RBE2,1,1,135,2,3",
    "RBAR": "RBAR,1,1,2,123456,,,123456",
    "RBAR shared": "RBAR,1,1,2,1234,56",
    "RBE3": "RBE3,1,,1,123456,1.,123,2,3,\n,4,2.,1456,5",
    "RBE3 UM": "RBE3,1,,1,123456,1.,123,2,3,\n,4,2.,1456,5\n,UM,2,123,3,12,5,4",
    "MPC": "MPC,7,4,1,1.,4,2,2.,\n,,4,3,-1.",
    "chain": "RBE2,1,1,123456,2\nRBE2,2,2,123456,3\nRBAR,3,3,4,123456\n"
    "RBE3,4,,5,123,1.,123,2,3\n,4",
}


@pytest.mark.parametrize("name", [n for n in RIGID if n != "MPC"])
def test_rigid_motion_satisfies_rigid_elements(model, name):
    built = model(FRAMES + RIGID[name])
    e = built.elimination
    modes = rigid_modes(built.points, [0.3, 0.2, 0.1])
    assert np.abs(e.T @ modes[e.f] - modes).max() < 1e-12
    assert len(e.f) + len(e.m) + len(e.s) == built.points.size


def test_mpc_holds_and_its_first_freedom_depends(model):
    built = model(FRAMES + RIGID["MPC"], "MPC=7")
    e = built.elimination
    u = e.T @ np.arange(1.0, len(e.f) + 1)
    a, b, c = u[built.points.dof([4, 4, 4], [1, 2, 3])]
    assert e.m == pytest.approx(built.points.dof([4], [1]))
    assert a + 2 * b - c == pytest.approx(0.0, abs=1e-12)


def test_mpcadd_spcadd_scalar_points_and_enforced_displacements(model):
    built = model(
        "GRID,1,,0.,0.,0.,,456\nSPOINT,7,8,9\nMPC,1,7,0,1.,8,0,-2.\nMPC,2,9,0,1.,7,0,1.\n"
        "MPCADD,5,1,2\nSPC,1,1,12,.5\nSPC1,2,,8\nSPCADD,6,1,2",
        "MPC=5\nSPC=6",
    )
    e = built.elimination
    assert [built.points.label(d) for d in e.m] == ["scalar point 7", "scalar point 9"]
    assert e.u_0[[0, 1]] == pytest.approx([0.5, 0.5])
    assert [built.points.label(d) for d in e.f] == ["grid 1 T3"]
    moved = e.with_enforced(built.points.dof([8], [0]), np.array([3.0]))
    assert moved.u_0[6:] == pytest.approx([6.0, 3.0, -6.0])
    with pytest.raises(InputError, match="no SPC constrains"):
        e.with_enforced(built.points.dof([1], [3]), np.array([3.0]))


def test_a_loop_of_dependences_is_solved(model):
    """u1 = u2/2 + u3, u2 = u1/2: u1 = 4/3 u3."""
    built = model(
        "SPOINT,1,2,3,4\nMPC,1,1,0,1.,2,0,-.5,\n,,3,0,-1.\nMPC,1,2,0,1.,1,0,-.5\n"
        "MPC,1,4,0,1.,1,0,-3.",
        "MPC=1",
    )
    u = built.elimination.T @ np.array([3.0])
    assert u == pytest.approx([4.0, 2.0, 3.0, 12.0])


@pytest.mark.parametrize(
    ("bulk", "case", "message"),
    [
        ("RBE2,1,1,123,2\nRBE2,2,3,123,2", "", "grid 2 T1 is dependent in RBE2 1 and"),
        ("RBE2,1,1,123,2\nSPC1,5,2,2", "SPC=5", "grid 2 T2 .* RBE2 1 .* SPC 5"),
        ("RBE2,1,1,1,2\nGRID,9,,1.,1.,1.,,1\nRBE2,2,1,1,9", "", "GRID PS"),
        ("RBE2,1,1,123456,2\nRBE2,2,2,123456,1", "", "cycle without a solution"),
        ("RBE2,1,1,123456,1", "", "both GN and GM"),
        ("RBAR,1,1,2,1235,2", "", "5 independent components"),
        ("RBAR,1,1,5,123,123", "", "do not determine a rigid motion"),
        ("RBE3,1,,1,123456,1.,123,2", "", "do not determine the motion"),
        (
            "RBE3,1,,1,123,1.,123,2,3\n,4\n,UM,2,12",
            "",
            "UM names 2 freedoms, expected 3",
        ),
        ("MPC,7,4,1,1.,4,1,-1.", "MPC=7", "first coefficient"),
    ],
)
def test_conflicts_are_named(model, bulk, case, message):
    with pytest.raises(InputError, match=message):
        model(FRAMES + bulk, case)


FRAME_OF_BARS = """
CORD2R,1,,1.,2.,3.,2.,3.,5.
,4.,1.,2.
MAT1,1,7.+10,,.33,2700.
PBAR,1,1,2.-3,3.-6,5.-6,4.-6
GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.,1
GRID,3,,2.,1.,0.
GRID,4,,3.,1.,0.,1
GRID,5,,3.5,.5,.4
CBAR,1,1,1,2,0.,0.,1.
CBAR,2,1,3,4,0.,0.,1.
RBE2,3,2,123456,3
RBE3,4,,5,123456,1.,123456,3,4
SPC1,1,123456,1
"""


def test_constraint_forces_balance_the_load(model):
    """The reaction holds load and moment; MPC forces balance by themselves."""
    built = model(FRAME_OF_BARS, "SPC=1")
    e, k = built.elimination, built.matrices.stiffness
    load = np.zeros(built.points.size)
    load[-6:] = [100.0, 20.0, -300.0, 4.0, 5.0, -6.0]
    u = e.T @ spsolve(e.reduce(k).tocsc(), e.T.T @ load)
    residual = k @ u - load
    spc, mpc = e.spc_force(residual), e.mpc_force(residual)
    assert residual == pytest.approx(spc + mpc, abs=1e-6)
    rigid = rigid_modes(built.points, [0.0, 0.0, 0.0])
    assert rigid.T @ mpc == pytest.approx(np.zeros(6), abs=1e-6)
    assert rigid.T @ (spc + load) == pytest.approx(np.zeros(6), abs=1e-6)
    assert np.flatnonzero(spc).max() < 6


def test_reduced_matrix_is_exactly_symmetric(model):
    built = model(FRAME_OF_BARS, "SPC=1")
    reduced = built.elimination.reduce(built.matrices.stiffness)
    assert abs(reduced - reduced.T).max() == 0.0


def test_autospc_finds_the_free_freedoms_of_a_skew_truss(model):
    """One rod along (1, 2, 2)/3 in turned frames: 5 of 6 freedoms are loose."""
    built = model(
        "CORD2R,1,,1.,2.,3.,2.,3.,5.\n,4.,1.,2.\nMAT1,1,7.+10,,.33\n"
        "GRID,1,,0.,0.,0.,1,1\nGRID,2,,1.,2.,2.\nSPOINT,9\nCONROD,1,1,2,1,.01"
    )
    e = built.elimination
    found = find_singularities(e.reduce(built.matrices.stiffness), e, built.points)
    fixed = e.with_fixed(found.dof)
    k = fixed.reduce(built.matrices.stiffness).toarray()
    # Grid 1 has lost T1 to PS; what is left of each grid is one stiff direction.
    assert [built.points.label(d) for d in found.dof if d >= 12] == ["scalar point 9"]
    assert k.shape == (2, 2)
    assert np.all(np.diag(k) > 1e-3 * abs(built.matrices.stiffness).max())
    assert found.lines(built.points)[0].startswith("grid 1 T")


def test_autospc_leaves_a_sound_structure_alone(model):
    built = model(FRAME_OF_BARS, "SPC=1")
    e = built.elimination
    found = find_singularities(e.reduce(built.matrices.stiffness), e, built.points)
    assert len(found.dof) == 0


def test_autospc_takes_the_drilling_direction_in_any_frame(model):
    """A block singular about one skew axis loses exactly one freedom, the nearest."""
    built = model("GRID,1,,0.,0.,0.")
    axis = np.array([0.6, 0.0, 0.8])
    block = 5.0 * (np.eye(3) - np.outer(axis, axis))
    k = sp.csr_matrix(sp.block_diag([np.eye(3), block]))
    found = find_singularities(k, built.elimination, built.points)
    assert found.dof.tolist() == [5]
