"""Kinematics of nodes of a flexible body: motion of its floating frame plus modes.

Node N lies at r = r_0 + φ_t η from the center of gravity G, in the axes of the floating
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

from systems.airframe.modal_body import ModalBody
from systems.tools.compiled import compiled
from systems.tools.vectors import (
    Vector,
    added,
    cross,
    product,
    rotation_kinematics,
    rotation_matrix,
    turned,
)

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
        p_GN: (k, 3) undeformed positions from the center of gravity, B axes, m.
        shape: (6 k, n) scaled modes, per node [rotation; translation], B axes.
        compliance: (6 k, 6 k) shape m⁻¹ shapeᵀ, accelerations per wrench through the
            modes alone, B axes.
    """

    p_GN: Float64
    shape: Float64
    compliance: Float64

    @classmethod
    def from_body(
        cls, body: ModalBody, node_id: npt.ArrayLike, scale: Float64
    ) -> "Nodes":
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
        return _node_acceleration(
            self.R_WB, self.rigid, self.turn, self.bias, nodes.shape, rigid, modes
        )

    def compliance(self, nodes: Nodes, inverse_mass: Float64) -> Float64:
        """(6 k, 6 k) accelerations per wrench at the nodes, W.

        Args:
            nodes: whose motion this is.
            inverse_mass: (6, 6) of [v_WG; ω_B].
        """
        return _node_compliance(
            self.R_WB, self.rigid, self.turn, nodes.compliance, inverse_mass
        )


def node_motion(nodes: Nodes, x: Float64) -> NodeMotion:
    """Motion of the nodes from the state of the body.

    Args:
        nodes: the nodes.
        x: (13 + 2 n,) p_WG (m), quaternion of R_WB, v_WG (m/s), ω_B (rad/s), scaled
            modal amplitudes η and their rates η'.
    """
    return NodeMotion(*_node_motion(x, nodes.shape, nodes.p_GN))


@compiled
def _elastic_motion(
    shape: Float64, x: Float64, row: int
) -> tuple[Vector, Vector, Vector, Vector]:
    """Rotation and translation by the modes, and their rates, of a node, B."""
    n = shape.shape[1]
    e = np.zeros((2, 6))
    for c in range(6):
        value = rate = 0.0
        for j in range(n):
            value += shape[row + c, j] * x[13 + j]
            rate += shape[row + c, j] * x[13 + n + j]
        e[0, c], e[1, c] = value, rate
    return (
        (e[0, 0], e[0, 1], e[0, 2]),
        (e[0, 3], e[0, 4], e[0, 5]),
        (e[1, 0], e[1, 1], e[1, 2]),
        (e[1, 3], e[1, 4], e[1, 5]),
    )


@compiled
def _node_motion(
    x: Float64, shape: Float64, p_GN: Float64
) -> tuple[Float64, Float64, Float64, Float64, Float64, Float64]:
    """Motion of nodes from the state of the body.

    Args:
        x: (13 + 2 n,) p_WG, quaternion, v_WG, ω_B, η, η'.
        shape: (6 k, n) modes, per node [rotation; translation], B.
        p_GN: (k, 3) undeformed places, B, m.

    Returns:
        R_WB (3, 3); pose (12 k,), R_WN by rows and p_WN; velocity (6 k,), W; bias
        (6 k,), acceleration at zero generalised accelerations; rigid (6 k, 6), velocity
        per [v_WG; ω_B]; turn (k, 3, 3), angular velocity per rate of rotation vector.
    """
    k = len(p_GN)
    R = rotation_matrix(x[3], x[4], x[5], x[6])
    v_G, w = (x[7], x[8], x[9]), (x[10], x[11], x[12])
    pose, velocity, bias = np.empty((k, 12)), np.empty((k, 6)), np.empty((k, 6))
    rigid, turn = np.zeros((6 * k, 6)), np.empty((k, 3, 3))
    for i in range(k):
        theta, shift, theta_rate, slide = _elastic_motion(shape, x, 6 * i)
        r = added((p_GN[i, 0], p_GN[i, 1], p_GN[i, 2]), shift)
        own, jacobian, spin, own_bias = rotation_kinematics(theta, theta_rate)
        R_WN = product(R, own)
        turn[i] = product(R, jacobian)
        carried = cross(w, r)
        place = turned(R, r)
        turning = turned(R, added(w, spin))
        going = added(v_G, turned(R, added(carried, slide)))
        turning_bias = turned(R, added(own_bias, cross(w, spin)))
        going_bias = turned(R, cross(w, added(carried, slide, 2.0)))
        for c in range(3):
            pose[i, 9 + c] = x[c] + place[c]
            velocity[i, c], velocity[i, 3 + c] = turning[c], going[c]
            bias[i, c], bias[i, 3 + c] = turning_bias[c], going_bias[c]
            rigid[6 * i + 3 + c, c] = 1.0
            across = cross(r, (R[c, 0], R[c, 1], R[c, 2]))  # row of R [-r]
            for d in range(3):
                pose[i, 3 * c + d] = R_WN[c, d]
                rigid[6 * i + c, 3 + d] = R[c, d]
                rigid[6 * i + 3 + c, 3 + d] = across[d]
    return R, pose.ravel(), velocity.ravel(), bias.ravel(), rigid, turn


@compiled
def _node_compliance(
    R: Float64,
    rigid: Float64,
    turn: Float64,
    elastic: Float64,
    inverse_mass: Float64,
) -> Float64:
    """(6 k, 6 k) acceleration of the nodes per wrench, W.

    Args:
        R, rigid, turn: of `NodeMotion`.
        elastic: (6 k, 6 k) that of the modes, B.
        inverse_mass: (6, 6) of [v_WG; ω_B].
    """
    m = len(rigid)
    mobile = np.empty((m, 6))
    for i in range(m):
        for j in range(6):
            total = 0.0
            for c in range(6):
                total += rigid[i, c] * inverse_mass[c, j]
            mobile[i, j] = total
    out = np.empty((m, m))
    half = np.empty((3, 3))
    for i in range(0, m, 3):
        left = turn[i // 6] if i % 6 == 0 else R
        for j in range(0, i + 1, 3):
            right = turn[j // 6] if j % 6 == 0 else R
            for c in range(3):
                for d in range(3):
                    total = 0.0
                    for f in range(3):
                        total += left[c, f] * elastic[i + f, j + d]
                    half[c, d] = total
            for c in range(3):
                for d in range(3):
                    total = 0.0
                    for f in range(3):
                        total += half[c, f] * right[d, f]
                    for f in range(6):
                        total += mobile[i + c, f] * rigid[j + d, f]
                    out[i + c, j + d] = total
                    out[j + d, i + c] = total
    return out


@compiled
def _node_acceleration(
    R: Float64,
    rigid: Float64,
    turn: Float64,
    bias: Float64,
    shape: Float64,
    of_rigid: Float64,
    of_modes: Float64,
) -> Float64:
    """(6 k,) accelerations of nodes, W, from the generalised ones.

    Args:
        R, rigid, turn, bias: of `NodeMotion`.
        shape: (6 k, n).
        of_rigid: (6,) [a_WG in W; ω' in B].
        of_modes: (n,).
    """
    m, n = shape.shape
    out, local = np.empty(m), np.empty(3)
    for i in range(0, m, 3):
        left = turn[i // 6] if i % 6 == 0 else R
        for c in range(3):
            total = 0.0
            for j in range(n):
                total += shape[i + c, j] * of_modes[j]
            local[c] = total
        for c in range(3):
            total = bias[i + c]
            for d in range(3):
                total += left[c, d] * local[d]
            for d in range(6):
                total += rigid[i + c, d] * of_rigid[d]
            out[i + c] = total
    return out
