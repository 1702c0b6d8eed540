"""Both solvers solve, count negative eigenvalues and name zero pivots."""

import numpy as np
import pytest
import scipy.sparse as sp

from fem.algebra.linear_solver import (
    SingularMatrixError,
    factorize,
    pardiso_is_available,
)

SOLVERS = [
    pytest.param(
        "pardiso",
        marks=pytest.mark.skipif(not pardiso_is_available(), reason="MKL is absent"),
    ),
    "superlu",
]


def random_symmetric(n: int, seed: int) -> sp.csr_matrix:
    matrix = sp.random(n, n, 0.03, random_state=seed)
    return sp.csr_matrix(matrix + matrix.T + 0.5 * sp.eye(n))


def chain(n: int) -> sp.csr_matrix:
    """Stiffness of n unit masses in a row, free at both ends."""
    matrix = sp.lil_matrix(sp.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(n, n)))
    matrix[0, 0] = matrix[-1, -1] = 1.0
    return sp.csr_matrix(matrix)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("kind", ["spd", "symmetric"])
def test_solves_vectors_and_blocks(solver, kind):
    matrix = random_symmetric(200, 1)
    if kind == "spd":
        matrix = sp.csr_matrix(matrix @ matrix.T + sp.eye(200))
    right = np.random.default_rng(2).normal(size=(200, 7))
    with factorize(matrix, kind=kind, solver=solver) as factor:
        block = factor.solve(right)
        assert block.flags.f_contiguous
        np.testing.assert_allclose(matrix @ block, right, atol=1e-9)
        for column in range(7):
            np.testing.assert_allclose(
                factor.solve(right[:, column]), block[:, column], rtol=1e-9, atol=1e-12
            )
        assert factor.nnz_factor > 0
        assert factor.memory_bytes > 8 * factor.nnz_factor


def plate(n: int) -> sp.csr_matrix:
    """Five-point stencil on a square of n by n points."""
    line = sp.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(n, n))
    return sp.csr_matrix(sp.kronsum(line, line))


@pytest.mark.parametrize("solver", SOLVERS)
def test_pardiso_finds_a_smaller_factor_for_few_columns(solver):
    matrix = plate(60)
    right = np.random.default_rng(0).normal(size=3600)
    with (
        factorize(matrix, solver=solver) as many,
        factorize(matrix, solver=solver, columns=1) as few,
    ):
        if solver == "pardiso":
            assert few.nnz_factor < 0.9 * many.nnz_factor
        np.testing.assert_allclose(few.solve(right), many.solve(right), rtol=1e-9)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("seed", range(5))
def test_inertia_is_the_number_of_negative_eigenvalues(solver, seed):
    matrix = random_symmetric(120, seed)
    expected = int(np.sum(np.linalg.eigvalsh(matrix.toarray()) < 0))
    assert expected > 0
    with factorize(matrix, kind="symmetric", solver=solver) as factor:
        assert factor.inertia == expected


@pytest.mark.parametrize("solver", SOLVERS)
def test_indefinite_matrix_is_refused_as_positive_definite(solver):
    matrix = sp.csr_matrix(np.diag([1.0, 2.0, -1.0, 3.0]))
    with pytest.raises(SingularMatrixError) as caught:
        factorize(matrix, kind="spd", solver=solver)
    assert caught.value.row == 2


@pytest.mark.parametrize("solver", SOLVERS)
def test_empty_row_is_singular(solver):
    with pytest.raises(SingularMatrixError):
        factorize(
            sp.block_diag([chain(5) + sp.eye(5), sp.csr_matrix((1, 1))]), solver=solver
        )


@pytest.mark.parametrize("solver", SOLVERS)
def test_closed_factorisation_refuses_to_solve(solver):
    factor = factorize(sp.csr_matrix(sp.eye(3)), solver=solver)
    factor.close()
    with pytest.raises(ValueError, match="closed"):
        factor.solve(np.ones(3))


@pytest.mark.skipif(not pardiso_is_available(), reason="MKL is absent")
def test_both_solvers_agree():
    matrix = chain(300) + 1e-3 * sp.eye(300)
    right = np.random.default_rng(3).normal(size=(300, 4))
    with (
        factorize(matrix, solver="pardiso") as one,
        factorize(matrix, solver="superlu") as other,
    ):
        np.testing.assert_allclose(one.solve(right), other.solve(right), rtol=1e-9)


def test_bad_arguments_are_named():
    with pytest.raises(ValueError, match="square"):
        factorize(sp.csr_matrix((2, 3)))
    with pytest.raises(ValueError, match="NaN"):
        factorize(sp.csr_matrix(np.array([[np.nan]])))
    with (
        factorize(sp.csr_matrix(sp.eye(3))) as factor,
        pytest.raises(ValueError, match="shape"),
    ):
        factor.solve(np.ones(4))
