"""Free expansion of shell sections: what temperatures do that nothing hinders.

Uniform temperature and a gradient over the thickness make the resultants

    N_T = int C alpha theta dz,  M_T = int C alpha theta z dz,  theta = 1 or z,

and, without forces, the strains and curvatures of which [A B; B D] makes these. Plies
that expand differently keep stresses in them (residual), C (e + z k - alpha theta).
"""

from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64
from fem.properties.laminate import Laminate
from fem.properties.shell_section import strain_rotation


@dataclass(frozen=True, kw_only=True)
class ShellExpansion:
    """Thermal expansion of one property in material axes, at its nominal thickness.

    Attributes:
        strain: (2, 3) of the reference surface, per degree and per gradient.
        curvature: (2, 3) likewise.
        plies: (p, 2, 3) strains of the plies beyond their own expansion, in their own
            axes at their middles; None: no plies.
    """

    strain: Float64
    curvature: Float64
    plies: Float64 | None = None


NO_EXPANSION = ShellExpansion(strain=np.zeros((2, 3)), curvature=np.zeros((2, 3)))


def of_section(
    matrices: tuple[Float64, Float64, Float64], alpha: Float64, alpha_bent: Float64
) -> ShellExpansion:
    """PSHELL: A and B expand by alpha of MID1, B and D under gradients by that of MID2.

    Args:
        matrices: A, B, D (3, 3).
        alpha, alpha_bent: (3,) strain per degree.
    """
    a, b, d = matrices
    uniform = np.concatenate([a @ alpha, b @ alpha])
    bent = np.concatenate([b @ alpha_bent, d @ alpha_bent])
    free = _free(matrices, np.stack([uniform, bent], axis=1))
    # A surface that is not there takes part in nothing.
    return ShellExpansion(strain=free[:3].T, curvature=free[3:].T)


def of_laminate(
    laminate: Laminate, matrices: tuple[Float64, Float64, Float64], alpha: Float64
) -> ShellExpansion:
    """PCOMP; A, B, D as its LAM has them.

    Args:
        laminate: the plies.
        matrices: A, B, D (3, 3); where a part is zero its resultants count for nothing.
        alpha: (p, 3) strain per degree of the plies in their own axes.
    """
    turn = strain_rotation(-laminate.angle)
    own = np.einsum("pij,pj->pi", turn, alpha)
    stress = np.einsum("pij,pj->pi", laminate.turned, own)
    z = laminate.interfaces
    moment = [(z[1:] ** k - z[:-1] ** k) / k @ stress for k in (1, 2, 3)]
    resultant = np.stack(
        [np.concatenate(moment[:2]), np.concatenate(moment[1:])], axis=1
    )
    a, b, d = matrices
    if not b.any() and laminate.stiffness()[1].any():
        resultant[3:, 0] = resultant[:3, 1] = 0.0  # SMEAR: no plies above each other
    there = np.repeat([a.any(), d.any()], 3)
    free = _free(matrices, resultant * there[:, None])
    strain, curvature = free[:3].T, free[3:].T
    height = np.stack([np.ones_like(laminate.middle), laminate.middle], axis=1)
    total = strain + laminate.middle[:, None, None] * curvature
    back = strain_rotation(laminate.angle)
    plies = np.einsum("pij,pkj->pki", back, total)
    plies = plies - height[:, :, None] * alpha[:, None, :]
    return ShellExpansion(strain=strain, curvature=curvature, plies=plies)


def _free(matrices: tuple[Float64, Float64, Float64], resultant: Float64) -> Float64:
    """(6, k) strains and curvatures that need resultants (6, k)."""
    a, b, d = matrices
    joined = np.block([[a, b], [b, d]])
    scale = np.sqrt(np.diag(joined))
    scale = np.where(scale > 0.0, scale, 1.0)
    inverse = np.linalg.pinv(joined / np.outer(scale, scale), rcond=1e-12)
    return (inverse @ (resultant / scale[:, None])) / scale[:, None]


def residual_map(laminate: Laminate, plies: Float64, *, strain: bool) -> Float64:
    """(p, 5, 2) what degree and gradient leave in plies: stresses, or their strains."""
    found = np.zeros((len(plies), 5, 2))
    own = plies.transpose(0, 2, 1)
    found[:, :3] = own if strain else laminate.plane @ own
    return found
