"""Modes against dense solutions, with massless and free structures, counted."""

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from fem.algebra import eigenproblem
from fem.algebra.modes import ModesError, normal_modes, rigid_energy
from fem.algebra.sturm import SturmCount, count_below


def membrane(nx: int, ny: int, *, ground: float = 0.0, every_massless: int = 0):
    """Springs of 1e6 N/m on a grid of unit masses; free when ground is 0."""

    def line(n):
        matrix = sp.lil_matrix(sp.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(n, n)))
        matrix[0, 0] = matrix[-1, -1] = 1.0
        return matrix

    stiffness = 1e6 * (sp.kron(line(nx), sp.eye(ny)) + sp.kron(sp.eye(nx), line(ny)))
    stiffness = sp.csr_matrix(stiffness + ground * sp.eye(nx * ny))
    mass = np.ones(nx * ny)
    if every_massless:
        mass[::every_massless] = 0.0
    return stiffness, sp.csr_matrix(sp.diags(mass))


def dense_frequencies(stiffness, mass):
    """Hz, by static condensation of massless rows and a dense solver."""
    k, m = stiffness.toarray(), mass.diagonal()
    a, b = np.flatnonzero(m > 0), np.flatnonzero(m == 0)
    condensed = k[np.ix_(a, a)]
    if len(b):
        condensed = condensed - k[np.ix_(a, b)] @ np.linalg.solve(
            k[np.ix_(b, b)], k[np.ix_(b, a)]
        )
    values = scipy.linalg.eigvalsh(condensed, np.diag(m[a]))
    return np.sqrt(np.abs(values)) / (2 * np.pi)


def check_modes(modes, stiffness, mass, expected):
    assert modes.count == len(expected)
    elastic = modes.frequency_hz > 0
    np.testing.assert_allclose(
        modes.frequency_hz[elastic], expected[elastic], rtol=1e-9
    )
    x = modes.shape
    np.testing.assert_allclose(x.T @ (mass @ x), np.eye(modes.count), atol=1e-12)
    residual = stiffness @ x - (mass @ x) * modes.eigenvalue
    assert np.abs(residual).max() < 1e-7 * np.abs(stiffness.data).max()
    assert modes.sturm
    assert all(count.complete for count in modes.sturm)


@pytest.mark.parametrize("solver", ["superlu", None])
@pytest.mark.parametrize("every_massless", [0, 3])
@pytest.mark.parametrize("size", [(12, 9), (30, 26)])  # dense and Lanczos
@pytest.mark.parametrize(
    ("count", "band"),
    [(20, None), (None, (0.0, 60.0)), (None, (40.0, 70.0)), (5, (40.0, None))],
)
def test_free_membrane(solver, every_massless, size, count, band):
    stiffness, mass = membrane(*size, every_massless=every_massless)
    modes = normal_modes(stiffness, mass, count=count, band=band, solver=solver)
    low, high = band or (0.0, None)
    expected = dense_frequencies(stiffness, mass)
    expected = expected[(expected >= low) & (expected <= (high or np.inf))][:count]
    check_modes(modes, stiffness, mass, expected)
    assert modes.rigid == (1 if not low else 0)
    if not low:
        assert modes.frequency_hz[0] == 0.0


@pytest.mark.parametrize("solver", ["superlu", None])
def test_sliced_band_equals_one_piece(monkeypatch, solver):
    stiffness, mass = membrane(32, 25, every_massless=4)
    whole = normal_modes(stiffness, mass, band=(0.0, 170.0), solver=solver)
    monkeypatch.setattr(eigenproblem, "SLICE_MODES", 20)
    sliced = normal_modes(stiffness, mass, band=(0.0, 170.0), solver=solver)
    assert len(sliced.sturm) > 2
    check_modes(sliced, stiffness, mass, whole.frequency_hz)
    counted = normal_modes(stiffness, mass, count=50, solver=solver)
    check_modes(counted, stiffness, mass, whole.frequency_hz[:50])
    part = normal_modes(stiffness, mass, count=30, band=(60.0, None), solver=solver)
    expected = whole.frequency_hz[whole.frequency_hz > 60.0][:30]
    check_modes(part, stiffness, mass, expected)


def test_high_multiplicity_is_found_completely():
    """40 equal, unconnected membranes: every eigenvalue is 40-fold."""
    one_k, one_m = membrane(5, 3, ground=1e4)
    stiffness = sp.csr_matrix(sp.block_diag([one_k] * 40))
    mass = sp.csr_matrix(sp.block_diag([one_m] * 40))
    modes = normal_modes(stiffness, mass, count=60)
    expected = np.repeat(dense_frequencies(one_k, one_m), 40)[:60]
    check_modes(modes, stiffness, mass, expected)


def test_more_modes_than_masses_gives_all_that_there_are():
    stiffness, mass = membrane(40, 20, ground=1e3, every_massless=1)
    mass = sp.lil_matrix(mass)
    for row in (5, 300, 700):
        mass[row, row] = 2.0
    mass = sp.csr_matrix(mass)
    modes = normal_modes(stiffness, mass, count=10)
    check_modes(modes, stiffness, mass, dense_frequencies(stiffness, mass))
    assert modes.count == 3


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 10_000), n=st.integers(5, 60), limit=st.floats(0.05, 0.95))
def test_sturm_count_equals_dense_count(seed, n, limit):
    rng = np.random.default_rng(seed)
    root = sp.random(n, n, 0.3, random_state=seed)
    stiffness = sp.csr_matrix(root @ root.T + 0.1 * sp.eye(n))
    mass = sp.csr_matrix(sp.diags(rng.uniform(0.5, 2.0, n)))
    values = scipy.linalg.eigvalsh(stiffness.toarray(), mass.toarray())
    shift = float(values[0] + limit * (values[-1] - values[0]))
    assert count_below(stiffness, mass, shift) == np.sum(values < shift)


def test_known_rigid_body_shapes_take_their_place():
    stiffness, mass = membrane(25, 20)
    known = np.full((500, 1), 3.0)
    modes = normal_modes(stiffness, mass, count=5, rigid_body=known)
    np.testing.assert_allclose(modes.shape[:, 0], 1 / np.sqrt(500), rtol=1e-14)
    assert rigid_energy(stiffness, known)[0] < 1e-15


def test_structures_without_modes_are_refused():
    stiffness, mass = membrane(4, 4)
    with pytest.raises(ModesError, match="no mass"):
        normal_modes(stiffness, 0.0 * mass, count=3)
    with pytest.raises(ModesError, match="not positive definite"):
        normal_modes(-1.0 * stiffness, mass, count=3)
    with pytest.raises(ValueError, match="count"):
        normal_modes(stiffness, mass)


def test_count_says_what_is_missing():
    assert "none missed" in str(SturmCount(12.0, 4, 4))
    assert "MISSING" in str(SturmCount(12.0, 5, 4))


@pytest.mark.parametrize("count", [1, 3, 6, 7])
@pytest.mark.parametrize("size", [40, 300])
def test_fewer_modes_than_pieces_that_float(count, size):
    """Six free chains: the limit of the Sturm count never falls among the zeros."""
    chain = sp.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(size, size), format="lil")
    chain[0, 0] = chain[-1, -1] = 1.0
    stiffness = 1e7 * sp.block_diag([chain] * 6, format="csr")
    modes = normal_modes(stiffness, sp.identity(6 * size, format="csr"), count=count)
    assert modes.rigid == min(count, 6)
    assert all(c.counted == c.found for c in modes.sturm)
    assert modes.sturm[-1].counted == (6 if count <= 6 else 12)
