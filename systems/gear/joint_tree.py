"""Motion of some bodies of a plant from its state, compiled.

Drake computes the same; but asking it from Python for place, axis and velocity of each
wheel, and for what their loads do on each joint, costs some hundred small calls, far
more than the arithmetic. The joints are taken from the finalised plant, so that there
is one description of the gears. Tests hold every number against Drake's.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    Joint,
    PrismaticJoint,
    RevoluteJoint,
    RigidBody,
    WeldJoint,
)

from systems.tools.compiled import compiled
from systems.tools.vectors import rotation_matrix

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_KINDS = {"quaternion_floating": 0, "weld": 1, "prismatic": 2, "revolute": 3}


@dataclass(frozen=True, slots=True)
class _Link:
    """A joint and its child body."""

    kind: int
    parent: int
    position: int
    velocity: int
    axis: Float64
    frame: Float64
    child: Float64


class JointTree:
    """The joints between the world and some bodies.

    Args:
        plant: finalised.
        bodies: whose motion is wanted.
        sliding: joints whose axes are wanted, too.

    Raises:
        ValueError: a joint on the way is neither floating (with a quaternion), weld,
            prismatic nor revolute.
    """

    def __init__(
        self,
        plant: MultibodyPlant,
        bodies: Sequence[RigidBody],
        sliding: Sequence[PrismaticJoint] = (),
    ) -> None:
        inboard = {
            joint.child_body().index(): joint
            for joint in map(plant.get_joint, plant.GetJointIndices())
        }
        self._links: list[_Link] = []
        places: dict = {plant.world_body().index(): -1}
        moved = [joint.child_body() for joint in sliding]
        for body in (*bodies, *moved):
            self._add(plant, body, inboard, places)
        self._nq, self.nv = plant.num_positions(), plant.num_velocities()
        self._bodies, self._sliding = (
            np.array([places[b.index()] for b in group], dtype=np.int64)
            for group in (bodies, moved)
        )
        links = self._links
        self._integers = np.array(
            [(k.kind, k.parent, k.position, k.velocity) for k in links], dtype=np.int64
        ).reshape(-1, 4)
        fixed = [np.stack([k.frame[:3], k.child[:3]]) for k in links]
        self._fixed = np.array(fixed, dtype=float).reshape(-1, 2, 3, 4)
        self._axes = np.array([k.axis for k in links], dtype=float).reshape(-1, 3)

    def _add(self, plant, body, inboard, places) -> None:
        if body.index() in places:
            return
        joint: Joint = inboard[body.index()]
        self._add(plant, joint.parent_body(), inboard, places)
        kind = _KINDS.get(joint.type_name())
        if kind is None:
            raise ValueError(
                f"joint tree: {joint.name()} is of the type {joint.type_name()}, "
                f"expected one of {', '.join(_KINDS)}"
            )
        axis = np.zeros(3)
        if isinstance(joint, PrismaticJoint):
            axis = joint.translation_axis()
        elif isinstance(joint, RevoluteJoint):
            axis = joint.revolute_axis()
        on_parent = joint.frame_on_parent().GetFixedPoseInBodyFrame()
        if isinstance(joint, WeldJoint):
            on_parent = on_parent.multiply(joint.X_FM())
        on_child = joint.frame_on_child().GetFixedPoseInBodyFrame().inverse()
        moves = kind != _KINDS["weld"]
        link = _Link(
            kind=kind,
            parent=places[joint.parent_body().index()],
            position=joint.position_start() if moves else 0,
            velocity=joint.velocity_start() if moves else 0,
            axis=axis,
            frame=on_parent.GetAsMatrix34(),
            child=on_child.GetAsMatrix34(),
        )
        places[body.index()] = len(self._links)
        self._links.append(link)

    def motion(self, state: Float64) -> tuple[Float64, Float64, Float64]:
        """Bodies' motion, and how it depends on the velocities of the plant.

        Args:
            state: (nq + nv,) positions and velocities of the plant.

        Returns:
            (k, 12) per body: origin p_WB (m), its y axis, v_WB (m/s), ω_WB (rad/s);
            (6 k, nv) their [angular; linear] velocities per velocity of the plant;
            (s, 3) axes of the sliding joints. All in W.
        """
        return _motion(
            state,
            self._integers,
            self._fixed,
            self._axes,
            self._bodies,
            self._sliding,
            self._nq,
            self.nv,
        )


@compiled
def _turn_about(axis: Float64, angle: float) -> Float64:
    """(3, 3) rotation about a unit vector."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, z = axis[0], axis[1], axis[2]
    R = np.empty((3, 3))
    R[0, 0], R[0, 1], R[0, 2] = (
        c + x * x * (1 - c),
        x * y * (1 - c) - z * s,
        x * z * (1 - c) + y * s,
    )
    R[1, 0], R[1, 1], R[1, 2] = (
        y * x * (1 - c) + z * s,
        c + y * y * (1 - c),
        y * z * (1 - c) - x * s,
    )
    R[2, 0], R[2, 1], R[2, 2] = (
        z * x * (1 - c) - y * s,
        z * y * (1 - c) + x * s,
        c + z * z * (1 - c),
    )
    return R


@compiled
def _times(X: Float64, Y: Float64, out: Float64) -> None:
    """out = X Y of poses (3, 4)."""
    for i in range(3):
        for j in range(4):
            out[i, j] = X[i, 0] * Y[0, j] + X[i, 1] * Y[1, j] + X[i, 2] * Y[2, j]
        out[i, 3] += X[i, 3]


@compiled
def _add_cross(a: Float64, b: Float64, out: Float64) -> None:
    out[0] += a[1] * b[2] - a[2] * b[1]
    out[1] += a[2] * b[0] - a[0] * b[2]
    out[2] += a[0] * b[1] - a[1] * b[0]


@compiled
def _joint_pose(kind: int, axis: Float64, state: Float64, q: int) -> Float64:
    """(3, 4) pose of the moving frame in the fixed one."""
    X = np.zeros((3, 4))
    X[0, 0] = X[1, 1] = X[2, 2] = 1.0
    if kind == 0:
        X[:, :3] = rotation_matrix(state[q], state[q + 1], state[q + 2], state[q + 3])
        X[:, 3] = state[q + 4 : q + 7]
    elif kind == 2:
        for i in range(3):
            X[i, 3] = axis[i] * state[q]
    elif kind == 3:
        X[:, :3] = _turn_about(axis, state[q])
    return X


@compiled
def _motion(
    state: Float64,
    links: Int64,
    fixed: Float64,
    axes: Float64,
    bodies: Int64,
    sliding: Int64,
    nq: int,
    nv: int,
) -> tuple[Float64, Float64, Float64]:
    """See `JointTree.motion`."""
    n = len(links)
    pose, joint = np.zeros((n, 3, 4)), np.zeros((n, 3, 4))
    axis_W, velocity = np.zeros((n, 3)), np.zeros((n, 2, 3))
    world, moved = np.zeros((3, 4)), np.zeros((3, 4))
    world[0, 0] = world[1, 1] = world[2, 2] = 1.0
    arm = np.empty(3)
    for i in range(n):
        kind, parent, q, v = links[i, 0], links[i, 1], links[i, 2], nq + links[i, 3]
        before = world if parent < 0 else pose[parent]
        _times(before, fixed[i, 0], joint[i])
        _times(joint[i], _joint_pose(kind, axes[i], state, q), moved)
        _times(moved, fixed[i, 1], pose[i])
        if kind == 0:
            # Velocities of a floating joint are those of the child's frame, in W.
            velocity[i, 0], velocity[i, 1] = state[v : v + 3], state[v + 3 : v + 6]
            continue
        if parent >= 0:
            velocity[i] = velocity[parent]
            arm[:] = pose[i, :, 3] - before[:, 3]
            _add_cross(velocity[parent, 0], arm, velocity[i, 1])
        if kind == 1:
            continue
        for c in range(3):
            axis_W[i, c] = (
                joint[i, c, 0] * axes[i, 0]
                + joint[i, c, 1] * axes[i, 1]
                + joint[i, c, 2] * axes[i, 2]
            )
        if kind == 2:
            velocity[i, 1] += axis_W[i] * state[v]
        else:
            velocity[i, 0] += axis_W[i] * state[v]
            arm[:] = pose[i, :, 3] - joint[i, :, 3]
            _add_cross(axis_W[i] * state[v], arm, velocity[i, 1])
    out, jacobian = np.empty((len(bodies), 12)), np.zeros((6 * len(bodies), nv))
    for b in range(len(bodies)):
        i = bodies[b]
        out[b, :3], out[b, 3:6] = pose[i, :, 3], pose[i, :, 1]
        out[b, 6:9], out[b, 9:] = velocity[i, 1], velocity[i, 0]
        rows = jacobian[6 * b : 6 * b + 6]
        place = pose[i, :, 3]
        while i >= 0:
            kind, v = links[i, 0], links[i, 3]
            if kind == 0:
                arm[:] = place - pose[i, :, 3]
                for c in range(3):
                    rows[c, v + c] = rows[3 + c, v + 3 + c] = 1.0
                    unit = np.zeros(3)
                    unit[c] = 1.0
                    _add_cross(unit, arm, rows[3:, v + c])
            elif kind == 2:
                rows[3:, v] = axis_W[i]
            elif kind == 3:
                rows[:3, v] = axis_W[i]
                arm[:] = place - joint[i, :, 3]
                _add_cross(axis_W[i], arm, rows[3:, v])
            i = links[i, 1]
    return out, jacobian, axis_W[sliding]
