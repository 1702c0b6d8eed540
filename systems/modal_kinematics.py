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

from systems.modal_body import ModalBody
from systems.rotations import rotation_kinematics, skew

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
            modes alone.
        diagonal_blocks: (18 k,) places of the 3 by 3 blocks on the diagonal of a
            flattened (6 k, 6 k) matrix.
    """

    p_GN: Float64
    shape: Float64
    compliance: Float64
    diagonal_blocks: npt.NDArray[np.int64]

    @classmethod
    def of(cls, body: ModalBody, node_id: npt.ArrayLike, scale: Float64) -> "Nodes":
        """The given grids, in the given order; ValueError names those not there."""
        rows = body.rows(np.asarray(node_id, dtype=np.int64))
        shape = np.stack([body.rotation[rows], body.translation[rows]], axis=1)
        shape = np.ascontiguousarray(shape.reshape(6 * len(rows), body.n) * scale)
        compliance = (shape / (body.modal_mass * scale**2)) @ shape.T
        k = len(rows)
        places = np.arange(36 * k * k).reshape(2 * k, 3, 2 * k, 3)
        i = np.arange(2 * k)
        blocks = places[i, :, i, :].ravel()
        return cls(body.p_BN[rows] - body.p_BG, shape, compliance, blocks)

    def __len__(self) -> int:
        return len(self.p_GN)


@dataclass(frozen=True, slots=True)
class NodeMotion:
    """Where k nodes are and how they move; world frame W.

    Attributes:
        R: (k, 3, 3) orientations R_WN.
        p: (k, 3) positions p_WN, m.
        velocity: (6 k,) per node [angular; linear], rad/s and m/s.
        bias: (6 k,) accelerations at zero generalised accelerations.
        rigid: (6 k, 6) velocity per [v_WG in W; ω_B in B].
        elastic: (6 k, 6 k) velocity per shape @ η'; block diagonal.
    """

    R: Float64
    p: Float64
    velocity: Float64
    bias: Float64
    rigid: Float64
    elastic: Float64


def node_motion(
    nodes: Nodes,
    R_WB: Float64,
    p_WG: Float64,
    rigid_velocity: Float64,
    amplitudes: Float64,
) -> NodeMotion:
    """Motion of the nodes from the state of the body.

    Args:
        nodes: the nodes.
        R_WB: (3, 3) orientation of the floating frame.
        p_WG: (3,) position of the centre of gravity, m.
        rigid_velocity: (6,) [v_WG in W, m/s; ω_B in B, rad/s].
        amplitudes: (2, n) scaled modal amplitudes η and their rates η'.
    """
    k = len(nodes)
    elastic_B = amplitudes @ nodes.shape.T
    (theta, shift), (theta_rate, shift_rate) = elastic_B.reshape(2, k, 2, 3).swapaxes(
        1, 2
    )
    turn, jacobian, jacobian_rate = rotation_kinematics(theta, theta_rate)
    r = nodes.p_GN + shift
    R_BW = R_WB.T

    rigid = np.zeros((k, 2, 3, 6))
    rigid[:, 0, :, 3:] = R_WB
    rigid[:, 1, :, :3] = _ONE
    rigid[:, 1, :, 3:] = R_WB @ skew(-r)
    rigid = rigid.reshape(6 * k, 6)
    blocks = np.empty((k, 2, 3, 3))
    blocks[:, 0] = R_WB @ jacobian
    blocks[:, 1] = R_WB
    elastic = np.zeros(36 * k * k)
    elastic[nodes.diagonal_blocks] = blocks.ravel()
    elastic = elastic.reshape(6 * k, 6 * k)

    spin = skew(-rigid_velocity[3:])  # acts from the right on rows
    bias = np.empty((k, 2, 3))
    bias[:, 0] = (jacobian @ theta_rate[:, :, None])[:, :, 0] @ spin + jacobian_rate
    bias[:, 1] = (r @ spin + 2.0 * shift_rate) @ spin
    return NodeMotion(
        R=R_WB @ turn,
        p=p_WG + r @ R_BW,
        velocity=rigid @ rigid_velocity + elastic @ elastic_B[1],
        bias=(bias @ R_BW).ravel(),
        rigid=rigid,
        elastic=elastic,
    )


_ONE = np.eye(3)
