"""Where the wheels are and how the struts stand, read once from the plant's state.

Tires and shock absorbers then need no plant: they take short vectors, can be tested
alone and their inputs can be logged.
"""

from collections.abc import Mapping
from types import MethodType
from typing import Any

import numpy as np
from pydrake.common.value import Value
from pydrake.math import RigidTransform_
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    JacobianWrtVariable,
    Joint,
    PrismaticJoint,
    RevoluteJoint,
    RigidBody,
)
from pydrake.systems.framework import LeafSystem_, ValueProducer

from systems.gear.joint_tree import JointTree
from systems.gear.lever_strut import LeverGeometry, LeverStrut
from systems.tools.plant_context import declare_plant_context
from systems.tools.scalar import sqrt
from systems.tools.template import default_instantiation, for_scalars
from systems.tools.weak_methods import weakly

Strut = PrismaticJoint | LeverStrut


@for_scalars
def WheelKinematics_(T):
    class Impl(LeafSystem_[T]):
        """Kinematics of all wheels and struts of an aircraft.

        | port | size | unit | frame and sign |
        |---|---|---|---|
        | in `plant_state` | nq + nv | | positions and velocities of the plant |
        | out `wheel_<name>` | 12 | m, -, m/s, rad/s | p_WC of the wheel centre, axle
          direction (y axis of the wheel body), v_WC, ω_WH of the wheel body; all in W |
        | out `wheel_jacobian` | 6 k nv | | [angular; linear] velocity of each wheel
          body at its centre, W, per velocity of the plant, by rows |
        | out `strut_<name>` | 2 | m, m/s | stroke, rate; positive in compression |
        | out `strut_axis_<name>` | 3 | | direction of compression, W |
        | out `strut_ratio_<name>` | 1 | m/rad | stroke over angle, of lever struts |
        | out `spin_<name>` | 1 | rad/s | rate of the joints in `spins` |
        | out `pitch_<name>` | 2 | rad, rad/s | angle, rate of the joints in `pitches` |

        The plant is a model only. Floats follow the wheels by `joint_tree`; what else
        is asked of the plant, and all for AutoDiffXd, by a context in a cache entry,
        as in Drake's InverseDynamics.

        Args:
            plant: finalised, continuous.
            wheels: port name to wheel body, whose origin is the wheel centre.
            struts: port name to strut joint, whose translation is the stroke, or to
                the shock absorber of an arm.
            spins: port name to spin joint of each wheel whose spin is wanted.
            pitches: port name to joint of each bogie beam.
        """

        def _construct(
            self,
            plant: MultibodyPlant,
            wheels: Mapping[str, RigidBody],
            struts: Mapping[str, Strut],
            spins: Mapping[str, RevoluteJoint] | None = None,
            pitches: Mapping[str, RevoluteJoint] | None = None,
            converter=None,
        ):
            LeafSystem_[T].__init__(self, converter=converter)
            self._given = plant, dict(wheels), dict(struts), spins, pitches
            self._plant = plant if T is float else plant.ToAutoDiffXd()
            self._wheels = [body.index() for body in wheels.values()]
            sliding = [s for s in struts.values() if isinstance(s, PrismaticJoint)]
            self._sliding = [self._plant.get_joint(s.index()) for s in sliding]
            if T is float:
                self._tree = JointTree(plant, list(wheels.values()), sliding)
            self._state: Any = self.DeclareVectorInputPort(
                "plant_state", plant.num_multibody_states()
            )
            state = {self._state.ticket()}
            self._context = declare_plant_context(self, self._plant)
            self._motion: Any = self.DeclareCacheEntry(
                "motion",
                ValueProducer(
                    allocate=lambda: Value(object()), calc=weakly(self._calc_motion)
                ),
                state,
            )
            motion = {self._motion.ticket()}
            size = 6 * len(wheels) * plant.num_velocities()
            self._declare("wheel_jacobian", size, weakly(self._calc_jacobian), motion)
            for i, name in enumerate(wheels):
                self._declare(f"wheel_{name}", 12, self._motion_port(0, i), motion)
            for name, strut in struts.items():
                if isinstance(strut, LeverStrut):
                    self._declare_lever(name, strut, state)
                    continue
                rows = self._rows_port(_state_rows(plant, strut))
                axis = self._motion_port(2, sliding.index(strut))
                self._declare(f"strut_{name}", 2, rows, state)
                self._declare(f"strut_axis_{name}", 3, axis, motion)
            for name, joint in (spins or {}).items():
                port = self._rows_port(_state_rows(plant, joint)[1:])
                self._declare(f"spin_{name}", 1, port, state)
            for name, joint in (pitches or {}).items():
                port = self._rows_port(_state_rows(plant, joint))
                self._declare(f"pitch_{name}", 2, port, state)

        def _construct_copy(self, other, converter=None):
            Impl._construct(self, *other._given, converter=converter)

        def _declare(self, name: str, size: int, calc, tickets: set) -> None:
            self.DeclareVectorOutputPort(
                name, size, calc, prerequisites_of_calc=tickets
            )

        def _declare_lever(self, name: str, strut: LeverStrut, state: set) -> None:
            row, rate = _state_rows(self._given[0], strut.joint)
            geometry, pose = strut.geometry, {self._context.ticket()}
            stroke = self._lever_port(row, rate, geometry)
            self._declare(f"strut_{name}", 2, stroke, state)
            self._declare(f"strut_axis_{name}", 3, self._lever_axis_port(strut), pose)
            ratio = self._ratio_port(row, geometry)
            self._declare(f"strut_ratio_{name}", 1, ratio, state)

        def _motion_port(self, part: int, i: int):
            def calc(self, context, output):
                output.SetFromVector(self._motion.Eval(context)[part][i])

            return weakly(MethodType(calc, self))

        def _rows_port(self, rows: list[int]):
            def calc(self, context, output):
                output.SetFromVector(self._state.Eval(context)[rows])

            return weakly(MethodType(calc, self))

        def _lever_port(self, row: int, rate: int, geometry: LeverGeometry):
            def calc(self, context, output):
                state = self._state.Eval(context).tolist()
                ratio = geometry.ratio(state[row])
                stroke = geometry.stroke(state[row])
                output.SetFromVector([stroke, ratio * state[rate]])

            return weakly(MethodType(calc, self))

        def _ratio_port(self, row: int, geometry: LeverGeometry):
            def calc(self, context, output):
                angle = self._state.Eval(context).tolist()[row]
                output.SetAtIndex(0, geometry.ratio(angle))

            return weakly(MethodType(calc, self))

        def _lever_axis_port(self, strut: LeverStrut):
            joint = self._plant.get_joint(strut.joint.index())
            frames = joint.frame_on_parent(), joint.frame_on_child()
            ends = [
                RigidTransform_[T](np.array([T(x) for x in end]))
                for end in (strut.p_upper, strut.p_lower)
            ]

            def calc(self, context, output):
                of_plant = self._context.Eval(context)
                upper, lower = (
                    frame.CalcPoseInWorld(of_plant).multiply(end).translation()
                    for frame, end in zip(frames, ends)
                )
                x, y, z = (upper - lower).tolist()
                length = sqrt(x * x + y * y + z * z)
                output.SetFromVector([x / length, y / length, z / length])

            return weakly(MethodType(calc, self))

        def _calc_motion(self, context, value):
            """Wheels (k, 12), their Jacobian (6 k, nv), axes of struts (s, 3)."""
            if T is float:
                value.set_value(self._tree.motion(self._state.Eval(context)))
            else:
                found = _motion(
                    self._plant,
                    self._context.Eval(context),
                    self._wheels,
                    self._sliding,
                )
                value.set_value(found)

        def _calc_jacobian(self, context, output):
            output.SetFromVector(self._motion.Eval(context)[1].ravel())

    return Impl


def _motion(plant: Any, context: Any, wheels: Any, struts: Any) -> tuple[Any, Any, Any]:
    """What `JointTree.motion` gives, by the plant itself, of any scalar."""
    world, rows, jacobian = plant.world_frame(), [], []
    for index in wheels:
        body = plant.get_body(index)
        X, V = (
            plant.EvalBodyPoseInWorld(context, body),
            plant.EvalBodySpatialVelocityInWorld(context, body),
        )
        axle = X.rotation().matrix()[:, 1]
        parts = X.translation(), axle, V.translational(), V.rotational()
        rows.append(np.concatenate([np.ravel(part) for part in parts]))
        jacobian.append(
            plant.CalcJacobianSpatialVelocity(
                context,
                JacobianWrtVariable.kV,
                body.body_frame(),
                np.zeros(3),
                world,
                world,
            )
        )
    axes = [
        joint.frame_on_parent().CalcPoseInWorld(context).rotation().matrix()
        @ joint.translation_axis()
        for joint in struts
    ]
    return rows, np.concatenate(jacobian), axes


def _state_rows(plant: MultibodyPlant, joint: Joint) -> list[int]:
    """Rows of position and velocity of a joint with one freedom."""
    return [joint.position_start(), plant.num_positions() + joint.velocity_start()]


WheelKinematics = default_instantiation(WheelKinematics_)
