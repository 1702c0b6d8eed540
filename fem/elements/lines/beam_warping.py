"""CBEAM whose ends hold the warping of its section: CW of PBEAM with SA and SB.

Each end has one more freedom, component 1 of the grid or scalar point SA or SB: the
rate of twist, -dθ/dx. Torsion is that of Saint-Venant on linear twist and, beside it,
that of Vlasov, E Cw θ'''', whose equations are those of a beam in bending (CW varies
linearly from end to end; its flexibility is integrated along the element):

    K = GJ/L [θ] + Φᵀ F⁻¹ Φ,   F = ∫ hᵀ h / (E Cw) dx,   h = [L - x, 1]

for the warping torque and the bimoment of end B; prismatic elements have 12 E Cw / L³.
With linear twist in the first part only, elements must be short against √(E Cw / GJ);
the error falls with the square of their length. So does MSC Nastran: displacements and
torques of two elements come out in single precision, where the exact solution differs
by 8e-5, and the sign is that of its files (decks `api3` and `ofprand1` of pyNastran).
The warping freedoms have no mass there. The warping torque is what the second part
carries; the bimoment shows as force of constraint at SA or SB. Stresses leave warping
out, as there.

With neither SA nor SB the ends warp freely and CW does nothing; the end without one of
them is free to warp (an assumption).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fem.arrays import Float64, Int64
from fem.elements.lines.beam import Beam
from fem.elements.lines.line_geometry import congruence

# θx of A, its rate, θx of B, its rate among the freedoms of the ends.
_TWIST = np.array([3, 12, 9, 13])
_SIGN = np.array([1.0, -1.0, 1.0, -1.0])  # the freedom is -dθ/dx


@dataclass(frozen=True, kw_only=True)
class WarpingBeam(Beam):
    """CBEAM elements with warping freedoms: 12 of the grids, 3 each of SA and SB.

    Those of a scalar point are itself and twice ground. The ends have 14 freedoms, the
    warping of A and of B last.

    Attributes:
        towards: (e, 2, 3) direction of the warping freedom among the three; zero where
            there is no point.
    """

    towards: Float64

    @property
    def grid_dof(self) -> Int64:
        return self.dof[:, :12]

    def expansion(self) -> Float64:
        return _with_zeros(super().expansion(), self.dof.shape[1])

    def bent(self, gradient: Float64) -> Float64:
        return _with_zeros(super().bent(gradient), self.dof.shape[1])

    def _widened(self, matrix: Float64) -> Float64:
        """(e, 14, 14) with zeros for the warping of the ends."""
        wide = np.zeros((len(matrix), 14, 14))
        wide[:, :12, :12] = matrix
        return wide

    @cached_property
    def _map(self) -> Float64:
        map_ = np.zeros((len(self.id), 14, 18))
        map_[:, :12, :12] = self.geometry.grid_to_end()
        map_[:, 12, 12:15], map_[:, 13, 15:] = self.towards.transpose(1, 0, 2)
        return map_

    @cached_property
    def _of_warping(self) -> Float64:
        """(e, 14, 14) the part of Vlasov's torsion."""
        s = self.section
        stiffness = self.material.e[:, None] * s.values["cw"]
        small = warping_stiffness(self.geometry.length, s.x, s.weight, stiffness)
        matrix = np.zeros((len(self.id), 14, 14))
        matrix[:, _TWIST[:, None], _TWIST] = small * np.outer(_SIGN, _SIGN)
        return matrix

    def _stiffness_at_ends(self) -> Float64:
        return self._widened(super()._stiffness_at_ends()) + self._of_warping

    @cached_property
    def _warping_torque(self) -> Float64:
        """(e, 1, 18) the same along the element."""
        torque = -self._of_warping[:, 3:4] @ self._condensed[1]
        return torque @ self._map


def warping_stiffness(
    length: Float64, x: Float64, weight: Float64, stiffness: Float64
) -> Float64:
    """(e, 4, 4) of θ and dθ/dx at A, then at B.

    Args:
        length: (e,).
        x, weight: (e, q) points as fractions of the length, weights of sum 1.
        stiffness: (e, q) E Cw there, positive.
    """
    rest = length[:, None] * (1.0 - x)
    moment = np.stack([rest, np.ones_like(rest)], axis=2)
    step = length[:, None] * weight / stiffness
    flexibility = np.einsum("eq,eqi,eqj->eij", step, moment, moment)
    one, zero = np.ones_like(length), np.zeros_like(length)
    relative = np.array([[-one, -length, one, zero], [zero, -one, zero, one]])
    return congruence(relative.transpose(2, 0, 1), np.linalg.inv(flexibility))


def _with_zeros(motion: Float64, size: int) -> Float64:
    return np.pad(motion, ((0, 0), (0, size - motion.shape[1])))
