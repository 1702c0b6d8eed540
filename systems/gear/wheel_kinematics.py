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
        | out `wheels` | 12 k | m, -, m/s, rad/s | of each wheel p_WC of its center,
          axle direction (y axis of the wheel body), v_WC, ω_WH of the wheel body; W |
        | out `wheel_<name>` | 12 | | the same of one |
        | out `wheel_jacobian` | 6 k nv | | [angular; linear] velocity of each wheel
          body at its center, W, per velocity of the plant, by rows |
        | out `struts` | 2 s | m, m/s | stroke, rate of each; positive in compression |
        | out `strut_<name>` | 2 | | the same of one |
        | out `strut_axes` | 3 s | | direction of compression of each, W |
        | out `strut_ratio_<name>` | 1 | m/rad | stroke over angle, of lever struts |
        | out `spin_<name>` | 1 | rad/s | rate of the joints in `spins` |
        | out `pitch_<name>` | 2 | rad, rad/s | angle, rate of the joints in `pitches` |

        The plant is a model only. Floats follow the wheels by `joint_tree`; what else
        is asked of the plant, and all for AutoDiffXd, by a context in a cache entry,
        as in Drake's InverseDynamics.

        Args:
            plant: finalised, continuous.
            wheels: port name to wheel body, whose origin is the wheel center.
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
            k, declare = len(wheels), self._declare
            declare("wheels", 12 * k, weakly(self._calc_wheels), motion)
            size = 6 * k * plant.num_velocities()
            declare("wheel_jacobian", size, weakly(self._calc_jacobian), motion)
            for i, name in enumerate(wheels):
                declare(f"wheel_{name}", 12, self._wheel_port(i), motion)
            self._declare_struts(struts, state, motion)
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

        def _declare_struts(self, struts, state: set, motion: set) -> None:
            self._struts = [
                (*_state_rows(self._given[0], _joint(strut)), _lever(strut))
                for strut in struts.values()
            ]
            self._slides = all(lever is None for *_, lever in self._struts)
            self._strut_rows = [row for *rows, _ in self._struts for row in rows]
            self._lever_ends = [
                None if lever is None else self._ends(strut)
                for strut, (*_, lever) in zip(struts.values(), self._struts)
            ]
            s = len(struts)
            poses = motion if self._slides else motion | {self._context.ticket()}
            self._declare("struts", 2 * s, weakly(self._calc_struts), state)
            self._declare("strut_axes", 3 * s, weakly(self._calc_axes), poses)
            for i, (name, (row, _, lever)) in enumerate(zip(struts, self._struts)):
                self._declare(f"strut_{name}", 2, self._strut_port(i), state)
                if lever is not None:
                    ratio = self._ratio_port(row, lever)
                    self._declare(f"strut_ratio_{name}", 1, ratio, state)

        def _wheel_port(self, i: int):
            def calc(self, context, output):
                output.SetFromVector(self._motion.Eval(context)[0][i])

            return weakly(MethodType(calc, self))

        def _rows_port(self, rows: list[int]):
            def calc(self, context, output):
                output.SetFromVector(self._state.Eval(context)[rows])

            return weakly(MethodType(calc, self))

        def _strut(self, state, i: int):
            row, rate, lever = self._struts[i]
            if lever is None:
                return state[row], state[rate]
            return lever.stroke(state[row]), lever.ratio(state[row]) * state[rate]

        def _strut_port(self, i: int):
            def calc(self, context, output):
                output.SetFromVector(self._strut(self._state.Eval(context), i))

            return weakly(MethodType(calc, self))

        def _calc_struts(self, context, output):
            state = self._state.Eval(context)
            if self._slides:
                output.SetFromVector(state[self._strut_rows])
                return
            each = [self._strut(state, i) for i in range(len(self._struts))]
            output.SetFromVector([value for strut in each for value in strut])

        def _ratio_port(self, row: int, geometry: LeverGeometry):
            def calc(self, context, output):
                angle = self._state.Eval(context).tolist()[row]
                output.SetAtIndex(0, geometry.ratio(angle))

            return weakly(MethodType(calc, self))

        def _ends(self, strut: LeverStrut):
            """Frames on fitting and arm, and the absorber's ends in them."""
            joint = self._plant.get_joint(strut.joint.index())
            frames = joint.frame_on_parent(), joint.frame_on_child()
            ends = [
                RigidTransform_[T](np.array([T(x) for x in end]))
                for end in (strut.p_upper, strut.p_lower)
            ]
            return list(zip(frames, ends))

        def _lever_axis(self, context, ends):
            of_plant = self._context.Eval(context)
            upper, lower = (
                frame.CalcPoseInWorld(of_plant).multiply(end).translation()
                for frame, end in ends
            )
            x, y, z = (upper - lower).tolist()
            length = sqrt(x * x + y * y + z * z)
            return [x / length, y / length, z / length]

        def _calc_axes(self, context, output):
            sliding = iter(self._motion.Eval(context)[2])
            axes = [
                next(sliding) if ends is None else self._lever_axis(context, ends)
                for ends in self._lever_ends
            ]
            output.SetFromVector(np.concatenate(axes))

        def _calc_wheels(self, context, output):
            output.SetFromVector(np.ravel(self._motion.Eval(context)[0]))

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


def _joint(strut: Strut) -> Joint:
    return strut.joint if isinstance(strut, LeverStrut) else strut


def _lever(strut: Strut) -> LeverGeometry | None:
    return strut.geometry if isinstance(strut, LeverStrut) else None


def _state_rows(plant: MultibodyPlant, joint: Joint) -> list[int]:
    """Rows of position and velocity of a joint with one freedom."""
    return [joint.position_start(), plant.num_positions() + joint.velocity_start()]


WheelKinematics = default_instantiation(WheelKinematics_)
