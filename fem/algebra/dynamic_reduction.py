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
from fem.algebra.orthonormal import orthonormal_rest
from fem.arrays import Float64

_RANDOM = 12
_DEPENDENT = 1e-5  # share of a vector that inverse iteration leaves as round-off


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
            solved = factor.solve(np.asfortranarray(block))
            block = orthonormal_rest(solved, basis, m_oo, _DEPENDENT)
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
