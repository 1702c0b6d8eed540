"""Participation of modes in rigid motions: factors and effective masses.

γ = φᵀ M R / φᵀ M φ and m_eff = γ² φᵀ M φ of each mode φ and rigid motion R; the
effective masses of all modes add up to the diagonal of Rᵀ M R.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.arrays import Float64


@dataclass(frozen=True, kw_only=True)
class Participation:
    """Participation of m modes in r rigid motions.

    Attributes:
        factor: (m, r) γ.
        effective: (m, r) effective masses.
        rigid: (r, r) Rᵀ M R.
    """

    factor: Float64
    effective: Float64
    rigid: Float64


def participation(
    mass: sp.csr_matrix, shapes: Float64, motions: Float64
) -> Participation:
    """Participation factors and effective masses.

    Args:
        mass: (n, n) M.
        shapes: (n, m) modes, of any scale.
        motions: (n, r) rigid motions.
    """
    heavy = mass @ motions
    modal = np.einsum("nm,nm->m", shapes, mass @ shapes)
    factor = (shapes.T @ heavy) / np.where(modal > 0.0, modal, np.inf)[:, None]
    return Participation(
        factor=factor,
        effective=factor**2 * modal[:, None],
        rigid=motions.T @ heavy,
    )
