"""Where the wheels are and how the struts stand, read once from the plant's state.

Tires and shock absorbers then need no plant: they take short vectors, can be tested
alone and their inputs can be logged.
"""

import math
from collections.abc import Mapping
from typing import Any

from pydrake.common.value import Value
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import Joint, PrismaticJoint, RevoluteJoint, RigidBody
from pydrake.systems.framework import LeafSystem, ValueProducer

from systems.gear.joint_tree import JointTree
from systems.gear.lever_strut import LeverGeometry, LeverStrut

Strut = PrismaticJoint | LeverStrut


class WheelKinematics(LeafSystem):
    """Kinematics of all wheels and struts of an aircraft.

    | port | size | unit | frame and sign |
    |---|---|---|---|
    | in `plant_state` | nq + nv | | positions and velocities of the plant |
    | out `wheel_<name>` | 12 | m, -, m/s, rad/s | p_WC of the wheel centre, axle
      direction (y axis of the wheel body), v_WC, ω_WH of the wheel body; all in W |
    | out `wheel_jacobian` | 6 k nv | | [angular; linear] velocity of each wheel body
      at its centre, W, per velocity of the plant, by rows |
    | out `strut_<name>` | 2 | m, m/s | stroke and rate, positive in compression |
    | out `strut_axis_<name>` | 3 | | direction of compression, W |
    | out `strut_ratio_<name>` | 1 | m/rad | stroke over angle, of lever struts only |
    | out `spin_<name>` | 1 | rad/s | rate of the joints in `spins` |
    | out `pitch_<name>` | 2 | rad, rad/s | angle and rate of the joints in `pitches` |

    The plant is a model only: wheels are followed by `joint_tree`, and what else is
    asked of the plant by a context in a cache entry, as in Drake's InverseDynamics.

    Args:
        plant: finalised, continuous.
        wheels: port name to wheel body, whose origin is the wheel centre.
        struts: port name to strut joint, whose translation is the stroke, or to the
            shock absorber of an arm.
        spins: port name to spin joint of each wheel whose spin is wanted.
        pitches: port name to joint of each bogie beam.
    """

    def __init__(
        self,
        plant: MultibodyPlant,
        wheels: Mapping[str, RigidBody],
        struts: Mapping[str, Strut],
        spins: Mapping[str, RevoluteJoint] | None = None,
        pitches: Mapping[str, RevoluteJoint] | None = None,
    ) -> None:
        super().__init__()
        self._plant = plant
        self._tree = JointTree(plant, list(wheels.values()))
        self._state = self.DeclareVectorInputPort(
            "plant_state", plant.num_multibody_states()
        )
        state = {self._state.ticket()}
        self._context: Any = self.DeclareCacheEntry(
            "plant_context",
            ValueProducer(
                allocate=lambda: Value(plant.CreateDefaultContext()),
                calc=self._calc_context,
            ),
            state,
        )
        self._motion: Any = self.DeclareCacheEntry(
            "wheels",
            ValueProducer(allocate=lambda: Value(object()), calc=self._calc_wheels),
            state,
        )
        self.DeclareVectorOutputPort(
            "wheel_jacobian",
            6 * len(wheels) * plant.num_velocities(),
            self._calc_jacobian,
            {self._motion.ticket()},
        )
        for i, name in enumerate(wheels):
            self.DeclareVectorOutputPort(
                f"wheel_{name}", 12, self._wheel_port(i), {self._motion.ticket()}
            )
        for name, strut in struts.items():
            self._declare_strut(name, strut, state)
        for name, joint in (spins or {}).items():
            port = self._rows_port(_state_rows(plant, joint)[1:])
            self.DeclareVectorOutputPort(f"spin_{name}", 1, port, state)
        for name, joint in (pitches or {}).items():
            port = self._rows_port(_state_rows(plant, joint))
            self.DeclareVectorOutputPort(f"pitch_{name}", 2, port, state)

    def _declare_strut(self, name: str, strut: Strut, state: set) -> None:
        declare, pose = self.DeclareVectorOutputPort, {self._context.ticket()}
        if isinstance(strut, LeverStrut):
            row, rate = _state_rows(self._plant, strut.joint)
            geometry = strut.geometry
            stroke = self._lever_port(row, rate, geometry)
            declare(f"strut_{name}", 2, stroke, state)
            declare(f"strut_axis_{name}", 3, self._lever_axis_port(strut), pose)
            ratio = self._ratio_port(row, geometry)
            declare(f"strut_ratio_{name}", 1, ratio, state)
        else:
            rows = self._rows_port(_state_rows(self._plant, strut))
            declare(f"strut_{name}", 2, rows, state)
            declare(f"strut_axis_{name}", 3, self._axis_port(strut), pose)

    def _wheel_port(self, i: int):
        def calc(context, output):
            output.SetFromVector(self._motion.Eval(context)[0][i])

        return calc

    def _rows_port(self, rows: list[int]):
        def calc(context, output):
            output.SetFromVector(self._state.Eval(context)[rows])

        return calc

    def _lever_port(self, row: int, rate: int, geometry: LeverGeometry):
        def calc(context, output):
            state = self._state.Eval(context)
            angle = float(state[row])
            ratio = geometry.ratio(angle)
            output.SetFromVector([geometry.stroke(angle), ratio * state[rate]])

        return calc

    def _ratio_port(self, row: int, geometry: LeverGeometry):
        def calc(context, output):
            angle = float(self._state.Eval(context)[row])
            output.SetAtIndex(0, geometry.ratio(angle))

        return calc

    def _lever_axis_port(self, strut: LeverStrut):
        parent = strut.joint.frame_on_parent()
        child = strut.joint.frame_on_child()

        def calc(context, output):
            plant_context = self._context.Eval(context)
            upper = parent.CalcPoseInWorld(plant_context).multiply(strut.p_upper)
            lower = child.CalcPoseInWorld(plant_context).multiply(strut.p_lower)
            span = upper - lower
            output.SetFromVector(span / math.sqrt(span @ span))

        return calc

    def _axis_port(self, joint: PrismaticJoint):
        frame, axis = joint.frame_on_parent(), joint.translation_axis()

        def calc(context, output):
            X_WJ = frame.CalcPoseInWorld(self._context.Eval(context))
            output.SetFromVector(X_WJ.rotation().multiply(axis))

        return calc

    def _calc_context(self, context, value) -> None:
        state = self._state.Eval(context)
        self._plant.SetPositionsAndVelocities(value.get_mutable_value(), state)

    def _calc_wheels(self, context, value) -> None:
        value.set_value(self._tree.motion(self._state.Eval(context)))

    def _calc_jacobian(self, context, output) -> None:
        output.SetFromVector(self._motion.Eval(context)[1].ravel())


def _state_rows(plant: MultibodyPlant, joint: Joint) -> list[int]:
    """Rows of position and velocity of a joint with one freedom."""
    return [joint.position_start(), plant.num_positions() + joint.velocity_start()]
