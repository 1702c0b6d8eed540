"""Load factors of matrices: dense and iterated, held and free, counted."""

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sp

from fem.algebra import buckling
from fem.algebra.buckling import FreeMotions, buckling_factors
from fem.algebra.sturm import count_below

N = 40


def chain(held):
    """Springs in a row, held at its first point or free."""
    matrix = 2.0 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1)
    matrix[-1, -1] = 1.0
    matrix[0, 0] = 2.0 if held else 1.0
    return matrix


def indefinite():
    random = np.random.default_rng(11)
    matrix = random.normal(size=(N, N)) * np.exp(
        -0.3 * np.abs(np.subtract.outer(np.arange(N), np.arange(N)))
    )
    return matrix + matrix.T


MASS = np.diag(1.0 + np.arange(N) / N)


def expected(held):
    """All factors, smallest magnitude first."""
    k, kd = chain(held), indefinite()
    basis = np.eye(N)
    if not held:
        basis = scipy.linalg.null_space((MASS @ np.ones((N, 1))).T)
    mu = scipy.linalg.eigh(
        -basis.T @ kd @ basis, basis.T @ k @ basis, eigvals_only=True
    )
    factor = 1.0 / mu
    return factor[np.argsort(np.abs(factor))]


@pytest.mark.parametrize("limit", [0, 400])
@pytest.mark.parametrize("held", [True, False])
def test_factors_are_those_of_the_dense_problem(monkeypatch, held, limit):
    monkeypatch.setattr(buckling, "DENSE_LIMIT", limit)
    k, kd = sp.csr_matrix(chain(held)), sp.csr_matrix(indefinite())
    ones = np.ones((N, 1))
    free = None if held else FreeMotions(ones, MASS @ ones)
    known = expected(held)
    for count, band in ((5, (None, None)), (4, (0.0, None)), (None, (-0.2, 0.1))):
        found = buckling_factors(k, kd, count=count, band=band, free=free)
        low = -np.inf if band[0] is None else band[0]
        high = np.inf if band[1] is None else band[1]
        own = known[(known >= low) & (known <= high)][:count]
        assert found.factor == pytest.approx(own, rel=1e-8)
        assert all(c.complete for c in found.counts)
        left = k @ found.shape + (kd @ found.shape) * found.factor
        if free is not None:
            left -= free.heavy @ np.linalg.solve(
                free.motions.T @ free.heavy, free.motions.T @ left
            )
            assert np.abs(free.heavy.T @ found.shape).max() < 1e-9
        assert np.abs(left).max() < 1e-6 * np.abs(k @ found.shape).max()
        energy = found.shape.T @ (k @ found.shape)
        assert energy == pytest.approx(np.eye(len(own)), abs=1e-7)


def test_counts_know_constraints():
    k, kd, ones = chain(held=False), indefinite(), np.ones((N, 1))
    known = expected(held=False)
    for limit in (0.03, 0.1, 0.5, 3.0):
        counted = count_below(
            sp.csr_matrix(k),
            sp.csr_matrix(-kd),
            limit,
            constraint=MASS @ ones,
        )
        assert counted == np.sum((known > 0.0) & (known < limit))


def test_a_range_or_a_count_is_needed():
    k = sp.csr_matrix(chain(held=True))
    with pytest.raises(ValueError, match="count"):
        buckling_factors(k, k)
