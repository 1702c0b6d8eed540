"""Guyan and Craig-Bampton: static exactness, convergence, MSC's figures."""

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sp
from plain_models import beam, rigid_beam

from fem.algebra.damping import Damping
from fem.algebra.linear_solver import SingularMatrixError
from fem.algebra.modes import normal_modes
from fem.algebra.reduction import reduce_craig_bampton, reduce_guyan
from fem.deck.reader import read_deck
from fem.model.structure import Structure

THREE_MODES_HZ = np.array(
    [349.7289, 2167.436, 6008.068, 11670.88, 19073.61, 28653.9, 43490.38, 104304.1]
)
KEPT = np.array([4, 5, 12, 13])


def hertz(stiffness, mass):
    values = scipy.linalg.eigvalsh(stiffness, mass)
    return np.sqrt(np.abs(values)) / (2 * np.pi)


@pytest.mark.parametrize("solver", ["superlu", None])
def test_guyan_is_exact_for_static_loads_on_the_interface(solver):
    stiffness, mass = beam(10, clamped=True)
    reduced = reduce_guyan(stiffness, mass, None, KEPT, solver=solver)
    load = np.array([1.0, -0.5, 2.0, 0.3])
    whole = np.zeros(20)
    whole[KEPT] = load
    exact = np.linalg.solve(stiffness.toarray(), whole)
    u = reduced.expand(np.linalg.solve(reduced.stiffness, load))
    np.testing.assert_allclose(u, exact, rtol=1e-8, atol=1e-12)
    np.testing.assert_allclose(reduced.load(whole), load)


def test_matrices_are_the_congruent_transformation():
    stiffness, mass = beam(10, clamped=True)
    damper = sp.csr_matrix(([3.0], ([7], [7])), (20, 20))
    damping = Damping(stiffness_factor=0.02, mass_factor=0.1, other=damper)
    reduced = reduce_craig_bampton(stiffness, mass, damping, KEPT, count=3)
    t = reduced.transform
    for ours, matrix in (
        (reduced.stiffness, stiffness),
        (reduced.mass, mass),
        (reduced.damping, damping.matrix(stiffness, mass)),
    ):
        expected = t.T @ (matrix @ t)
        np.testing.assert_allclose(ours, expected, atol=1e-8 * np.abs(expected).max())
    np.testing.assert_array_equal(reduced.kept, KEPT)
    np.testing.assert_allclose(t[KEPT, :4], np.eye(4))


def test_craig_bampton_converges_to_the_whole_from_above():
    stiffness, mass = beam(10, clamped=True)
    exact = hertz(stiffness.toarray(), mass.toarray())
    errors = []
    for count in (0, 2, 5, 16):
        reduced = reduce_craig_bampton(stiffness, mass, None, KEPT, count=count)
        assert len(reduced.interior_hz) == count
        found = hertz(reduced.stiffness, reduced.mass)
        errors.append(found[3] / exact[3] - 1)
    assert np.all(np.diff(errors) <= 1e-9)
    assert errors[0] > 1e-3
    assert abs(errors[-1]) < 1e-9


def test_modes_up_to_a_frequency_are_taken():
    stiffness, mass = beam(10, clamped=True)
    everything = reduce_craig_bampton(stiffness, mass, None, KEPT, count=16)
    limit = 0.5 * (everything.interior_hz[4] + everything.interior_hz[5])
    part = reduce_craig_bampton(stiffness, mass, None, KEPT, highest_hz=limit)
    np.testing.assert_allclose(part.interior_hz, everything.interior_hz[:5])


def test_rigid_body_motions_of_a_free_structure_survive():
    stiffness, mass = beam(10, clamped=False)
    motions = rigid_beam(10)
    kept = np.array([0, 1, 20])
    reduced = reduce_guyan(stiffness, mass, None, kept)
    a = motions[kept]
    np.testing.assert_allclose(reduced.expand(a), motions, atol=1e-10)
    np.testing.assert_allclose(reduced.stiffness @ a, 0.0, atol=1e-8)
    expected = motions.T @ (mass @ motions)
    np.testing.assert_allclose(a.T @ reduced.mass @ a, expected, rtol=1e-10)


def test_interior_that_moves_freely_is_refused_with_its_row():
    stiffness, mass = beam(4, clamped=True)
    loose = sp.csr_matrix(sp.block_diag([stiffness, sp.csr_matrix((1, 1))]))
    heavy = sp.csr_matrix(sp.block_diag([mass, sp.identity(1)]))
    with pytest.raises(SingularMatrixError):
        reduce_guyan(loose, heavy, None, np.array([6, 7]))
    with pytest.raises(ValueError, match="different"):
        reduce_guyan(stiffness, mass, None, np.array([1, 1]))


@pytest.mark.parametrize(
    ("deck", "modes", "expected"),
    [
        ("guyanReduction.dat", 0, [359.0738, 2934.1]),
        (
            "dynamicReduction.dat",
            3,
            [349.7303, 2168.717, 6015.472, 11974.12, 29336.18],
        ),
    ],
)
def test_reduction_against_msc(references, deck, modes, expected):
    structure = Structure.from_deck(
        read_deck(references / "reduction" / "cantilever_bar" / deck)
    )
    kept = structure.free_rows(structure.analysis_dof, "ASET")
    reduced = reduce_craig_bampton(
        structure.stiffness, structure.mass, None, kept, count=modes
    )
    np.testing.assert_allclose(
        hertz(reduced.stiffness, reduced.mass), expected, rtol=3e-6
    )


@pytest.mark.parametrize(
    ("modes", "expected"),
    [
        (1, [349.7555, 2182.49, 6733.634, 18222.0]),
        (2, [349.7299, 2168.126, 6011.365, 11851.45, 21809.58, 48160.41]),
        (
            3,
            THREE_MODES_HZ,
        ),
    ],
)
def test_two_superelements_against_msc(references, modes, expected):
    """The bar in two parts of which each is reduced onto grid 6, then assembled.

    Interior freedoms of both parts uncouple when grid 6 is held, so that one reduction
    with each part's modes is the same as two.
    """
    structure = Structure.from_deck(
        read_deck(references / "reduction" / "cantilever_bar" / "guyanReduction.dat")
    )
    kept = structure.free_rows(structure.analysis_dof, "ASET")
    k, m = structure.stiffness, structure.mass
    grid = structure.points.grid_id[structure.elimination.f // 6]
    interior = np.setdiff1d(np.arange(structure.size), kept)
    guyan = reduce_guyan(k, m, None, kept)
    columns = [guyan.transform]
    for part in (grid[interior] < 6, grid[interior] > 6):
        rows = interior[part]
        found = normal_modes(
            sp.csr_matrix(k[rows][:, rows]),
            sp.csr_matrix(m[rows][:, rows]),
            count=modes,
        )
        shapes = np.zeros((structure.size, modes))
        shapes[rows] = found.shape
        columns.append(shapes)
    t = np.hstack(columns)
    np.testing.assert_allclose(hertz(t.T @ (k @ t), t.T @ (m @ t)), expected, rtol=3e-6)
