"""Generalised dynamic reduction: Guyan and Ritz vectors from inverse iteration.

Nastran's dynamic reduction adds approximate modes of the o-set to the static ones. They
come from a block Krylov sequence of the interior, V_1 = K_oo⁻¹ P,
V_k+1 = K_oo⁻¹ M_oo V_k, started from inertia forces P of rigid motions and of a few
random ones (which both sides of a symmetric model need), and cost a few solutions with
K_oo instead of an eigenvalue problem. A Rayleigh-Ritz step makes them M-orthonormal and
diagonal in K; its lowest values approach the frequencies of the fixed-interface modes
from above.

Reference: MSC Nastran Theoretical Manual, "Generalized dynamic reduction".
"""

import numpy as np
import scipy.linalg
import scipy.sparse as sp

from fem.algebra.linear_solver import SolverName, factorize
from fem.algebra.modes import Modes
from fem.arrays import Float64

_RANDOM = 12
_DEPENDENT = 1e-10  # of the largest: M-norm at which a direction is round-off


def ritz_modes(
    k_oo: sp.csr_matrix,
    m_oo: sp.csr_matrix,
    load: Float64,
    count: int,
    *,
    solver: SolverName | None = None,
) -> Modes:
    """Approximate fixed-interface modes.

    Args:
        k_oo, m_oo: (o, o) interior K and M.
        load: (o, r) inertia forces that the sequence starts from.
        count: at most this many.
        solver: as in `fem.algebra.linear_solver.factorize`.

    Returns:
        The lowest of the Ritz vectors, mass-normalised.
    """
    basis = np.zeros((len(load), 0))
    random = np.random.default_rng(3).normal(size=(len(load), _RANDOM))
    block = np.hstack([load, m_oo @ random])
    wanted = min(2 * count, len(load))
    with factorize(k_oo, solver=solver) as factor:
        while basis.shape[1] < wanted:
            block = _orthonormal(m_oo, basis, factor.solve(np.asfortranarray(block)))
            if block.shape[1] == 0:
                break
            basis = np.hstack([basis, block])
            block = m_oo @ block
    inner = basis.T @ (k_oo @ basis)
    values, vectors = scipy.linalg.eigh(0.5 * (inner + inner.T))
    return Modes(
        frequency_hz=np.sqrt(np.maximum(values[:count], 0.0)) / (2.0 * np.pi),
        shape=basis @ vectors[:, :count],
        rigid=0,
        sturm=(),
    )


def _orthonormal(m_oo: sp.csr_matrix, basis: Float64, block: Float64) -> Float64:
    """Independent part of a block, M-orthonormal to itself and to a basis."""
    block = block / np.maximum(np.linalg.norm(block, axis=0), np.finfo(float).tiny)
    for _ in range(2):
        block = block - basis @ (basis.T @ (m_oo @ block))
        gram = block.T @ (m_oo @ block)
        size, turn = scipy.linalg.eigh(0.5 * (gram + gram.T))
        keep = size > _DEPENDENT * max(size.max(initial=0.0), np.finfo(float).tiny)
        block = block @ (turn[:, keep] / np.sqrt(size[keep]))
    return block
