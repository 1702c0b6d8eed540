"""Statics on matrices: closed forms, singular structures, inertia relief."""

import numpy as np
import pytest
import scipy.sparse as sp
from plain_models import beam, rigid_beam

from fem.algebra.linear_solver import SingularMatrixError
from fem.algebra.statics import free_motions, inertia_relief, solve_static
from fem.model.mechanisms import describe, find_mechanisms


@pytest.mark.parametrize("solver", ["superlu", None])
def test_cantilever_under_tip_load(solver):
    stiffness, _ = beam(7, clamped=True)
    load = np.zeros((14, 2))
    load[-2, 0] = 3.0
    load[-1, 1] = 2.0
    u = solve_static(stiffness, load, solver=solver)
    np.testing.assert_allclose(u[-2:, 0], [1.0, 1.5], rtol=1e-10)  # PL³/3, PL²/2
    np.testing.assert_allclose(u[-2:, 1], [1.0, 2.0], rtol=1e-10)  # ML²/2, ML


@pytest.mark.parametrize("solver", ["superlu", None])
def test_singular_structure_is_refused_though_the_factor_may_exist(solver):
    stiffness, _ = beam(40, clamped=False)
    with pytest.raises(SingularMatrixError):
        solve_static(stiffness, np.ones(82), solver=solver)


@pytest.mark.parametrize("solver", ["superlu", None])
def test_long_slender_but_sound_structure_passes(solver):
    """A cantilever of 400 elements: its softest motion is no mechanism."""
    stiffness, _ = beam(400, clamped=True)
    load = np.zeros(800)
    load[-2] = 3.0
    u = solve_static(stiffness, load, solver=solver)
    assert u[-2] == pytest.approx(1.0, rel=1e-4)
    assert find_mechanisms(stiffness, solver=solver) == []


def test_mechanisms_are_named_piece_by_piece():
    """A free beam, a clamped one, and a clamped one with a hinge at its end."""
    free, _ = beam(3, clamped=False)
    held, _ = beam(4, clamped=True)
    hinge = sp.block_diag([held, sp.csr_matrix((1, 1))])
    whole = sp.csr_matrix(sp.block_diag([free, held, hinge]))
    found = find_mechanisms(whole)
    assert [m.motions.shape[1] for m in found] == [2, 1]
    np.testing.assert_array_equal(found[0].rows, np.arange(8))
    np.testing.assert_array_equal(found[1].rows, [24])
    lines = describe(found, lambda row: f"grid {row // 2} {('T3', 'R2')[row % 2]}")
    assert lines[0] == "1 freedoms without any stiffness: grid 12 T3"
    assert "2 motions" in lines[1]
    assert "grid 0 T3 R2, grid 1 T3 R2" in lines[1]


def test_mechanism_that_moves_mass_is_none_in_dynamics():
    free, mass = beam(3, clamped=False)
    assert find_mechanisms(free, mass=mass) == []
    loose = sp.csr_matrix(sp.block_diag([free, sp.csr_matrix((1, 1))]))
    heavy = sp.csr_matrix(sp.block_diag([mass, sp.csr_matrix((1, 1))]))
    assert [m.rows.tolist() for m in find_mechanisms(loose, mass=heavy)] == [[8]]


@pytest.mark.parametrize("support", [None, [0, 1], [0, 12]])
def test_inertia_relief_of_a_free_beam(support):
    """A force P at one end: rigid accelerations 4P/m there, and balanced loads."""
    elements = 6
    stiffness, mass = beam(elements, clamped=False)
    load = np.zeros((14, 1))
    load[0] = 2.0
    motions = rigid_beam(elements)
    result = inertia_relief(
        stiffness,
        mass,
        load,
        support=None if support is None else np.array(support),
        rigid_body=motions,
    )
    # Resultants of the balanced load vanish; elastic equilibrium holds everywhere.
    np.testing.assert_allclose(motions.T @ result.balanced, 0.0, atol=1e-12)
    np.testing.assert_allclose(
        stiffness @ result.displacement, result.balanced, atol=1e-8
    )
    if support is None:
        np.testing.assert_allclose(
            motions.T @ (mass @ result.displacement), 0.0, atol=1e-14
        )
    else:
        assert np.all(result.displacement[support] == 0.0)
        # Free rod with a force at its end: acceleration 4P/m at that end.
        assert result.acceleration[0, 0] == pytest.approx(8.0, rel=1e-9)


def test_inertia_relief_needs_a_determinate_support():
    stiffness, mass = beam(4, clamped=False)
    load = np.ones((10, 1))
    with pytest.raises(ValueError, match="determinately"):
        inertia_relief(stiffness, mass, load, support=np.array([0, 4, 8]))
    with pytest.raises(SingularMatrixError):
        inertia_relief(stiffness, mass, load, support=np.array([0]))
    held, m = beam(4, clamped=True)
    with pytest.raises(ValueError, match="held"):
        inertia_relief(held, m, np.ones((8, 1)), rigid_body=np.eye(8)[:, :2])


def test_partly_held_structure_keeps_its_free_motions_only():
    stiffness, _ = beam(5, clamped=False)
    pinned = sp.csr_matrix(stiffness + sp.csr_matrix(([50.0], ([0], [0])), (12, 12)))
    motions = free_motions(pinned, rigid_beam(5))
    assert motions.shape[1] == 1
    assert abs(motions[0, 0]) < 1e-12


def test_inertia_relief_of_masses_on_a_line():
    """No inertia in roll: of no account unless a load rolls them, which is refused."""
    stiffness = sp.csr_matrix(100.0 * np.array([[1.0, -1.0], [-1.0, 1.0]]))
    stiffness = sp.block_diag([stiffness, 0.0 * sp.eye(1)], format="csr")
    mass = sp.diags([1.0, 3.0, 0.0], format="csr")
    rigid = np.array([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    load = np.array([[8.0], [0.0], [0.0]])
    result = inertia_relief(stiffness, mass, load, rigid_body=rigid)
    spring = 100.0 * (result.displacement[0] - result.displacement[1])
    np.testing.assert_allclose(spring, 6.0)
    np.testing.assert_allclose(result.balanced, [[6.0], [-6.0], [0.0]], atol=1e-12)
    load[2] = 1e-3
    with pytest.raises(ValueError, match="no inertia"):
        inertia_relief(stiffness, mass, load, rigid_body=rigid)
