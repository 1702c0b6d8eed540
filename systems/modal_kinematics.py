"""Kinematics of nodes of a flexible body: motion of its floating frame plus modes.

Node N lies at r = r_0 + φ_t η from the centre of gravity G, in the axes of the floating
frame B, and is turned against B by the rotation vector θ = φ_r η. Hence, with J_l the
left Jacobian of θ,

    R_WN = R_WB exp([θ])              p_WN = p_WG + R_WB r
    w_N = R_WB (ω_B + J_l φ_r η')     v_N = v_G + R_WB (ω_B × r + φ_t η').

The same Jacobian carries loads back to the generalised forces, so that loads do on the
generalised coordinates exactly the work that they do on the nodes. A vector "per node"
is [angular; linear], three components each, node after node, in the world frame W.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from systems import kernels
from systems.modal_body import ModalBody

Float64 = npt.NDArray[np.float64]


def mode_scales(body: ModalBody) -> Float64:
    """(n,) factors that make each mode's largest nodal displacement 1 m or 1 rad.

    Drake's integrators bound the error of every state by one absolute accuracy; with
    such shapes a modal amplitude is a displacement in metres like the other states. A
    mode that no node sees is scaled to unit modal mass.
    """
    shapes = np.concatenate([body.translation, body.rotation], axis=1)
    largest = np.abs(shapes).max(axis=(0, 1), initial=0.0)
    seen = largest > 0
    return np.where(
        seen, 1.0 / np.where(seen, largest, 1.0), 1.0 / np.sqrt(body.modal_mass)
    )


@dataclass(frozen=True, slots=True)
class Nodes:
    """Some nodes of a flexible body, in scaled modal coordinates.

    Attributes:
        p_GN: (k, 3) undeformed positions from the centre of gravity, B axes, m.
        shape: (6 k, n) scaled modes, per node [rotation; translation], B axes.
        compliance: (6 k, 6 k) shape m⁻¹ shapeᵀ, accelerations per wrench through the
            modes alone, B axes.
    """

    p_GN: Float64
    shape: Float64
    compliance: Float64

    @classmethod
    def of(cls, body: ModalBody, node_id: npt.ArrayLike, scale: Float64) -> "Nodes":
        """The given grids, in the given order; ValueError names those not there."""
        rows = body.rows(np.asarray(node_id, dtype=np.int64))
        shape = np.stack([body.rotation[rows], body.translation[rows]], axis=1)
        shape = np.ascontiguousarray(shape.reshape(6 * len(rows), body.n) * scale)
        compliance = (shape / (body.modal_mass * scale**2)) @ shape.T
        return cls(body.p_BN[rows] - body.p_BG, shape, compliance)

    def __len__(self) -> int:
        return len(self.p_GN)


@dataclass(frozen=True, slots=True)
class NodeMotion:
    """Where k nodes are and how they move; world frame W.

    The columns of `rigid` and the blocks `turn` and R_WB (of rotations and of
    translations of each node) are the Jacobian: velocity = rigid [v_WG; ω_B] +
    diag(turn, R_WB, ...) shape η'.

    Attributes:
        R_WB: (3, 3) orientation of the floating frame.
        pose: (12 k,) per node R_WN by rows and p_WN, m.
        velocity: (6 k,) per node, rad/s and m/s.
        bias: (6 k,) accelerations at zero generalised accelerations.
        rigid: (6 k, 6) velocity per [v_WG in W; ω_B in B].
        turn: (k, 3, 3) R_WB J_l.
    """

    R_WB: Float64
    pose: Float64
    velocity: Float64
    bias: Float64
    rigid: Float64
    turn: Float64

    def acceleration(self, nodes: Nodes, rigid: Float64, modes: Float64) -> Float64:
        """(6 k,) accelerations, W.

        Args:
            nodes: whose motion this is.
            rigid: (6,) [a_WG in W; ω' in B].
            modes: (n,) scaled η".
        """
        return kernels.node_acceleration(
            self.R_WB, self.rigid, self.turn, self.bias, nodes.shape, rigid, modes
        )

    def compliance(self, nodes: Nodes, inverse_mass: Float64) -> Float64:
        """(6 k, 6 k) accelerations per wrench at the nodes, W.

        Args:
            nodes: whose motion this is.
            inverse_mass: (6, 6) of [v_WG; ω_B].
        """
        return kernels.node_compliance(
            self.R_WB, self.rigid, self.turn, nodes.compliance, inverse_mass
        )


def node_motion(nodes: Nodes, x: Float64) -> NodeMotion:
    """Motion of the nodes from the state of the body.

    Args:
        nodes: the nodes.
        x: (13 + 2 n,) p_WG (m), quaternion of R_WB, v_WG (m/s), ω_B (rad/s), scaled
            modal amplitudes η and their rates η'.
    """
    return NodeMotion(*kernels.node_motion(x, nodes.shape, nodes.p_GN))
