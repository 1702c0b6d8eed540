"""Where the wheels are and how the struts stand, read once from the plant's state.

Tyres and shock absorbers then need no plant: they take short vectors, can be tested
alone and their inputs can be logged.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from pydrake.common.value import Value
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import PrismaticJoint, RigidBody
from pydrake.systems.framework import LeafSystem, ValueProducer


class WheelKinematics(LeafSystem):
    """Kinematics of all wheels and struts of an aircraft, about 70 µs for six wheels.

    | port | size | unit | |
    |---|---|---|---|
    | in `plant_state` | nq + nv | | positions and velocities of the plant |
    | out `wheel_<name>` | 12 | m, -, m/s, rad/s | p_WC of the wheel centre, axle
      direction (y axis of the wheel body), v_WC, ω_WH of the wheel body; all in W |
    | out `strut_<name>` | 2 | m, m/s | stroke and rate, positive in compression |
    | out `strut_axis_<name>` | 3 | | direction of compression, W |

    The plant is a model only: its context lives in a cache entry, as in Drake's
    InverseDynamics.

    Args:
        plant: finalised, continuous.
        wheels: port name to wheel body, whose origin is the wheel centre.
        struts: port name to strut joint, whose translation is the stroke.
    """

    def __init__(
        self,
        plant: MultibodyPlant,
        wheels: Mapping[str, RigidBody],
        struts: Mapping[str, PrismaticJoint],
    ) -> None:
        super().__init__()
        self._plant = plant
        self._wheels = tuple(wheels.values())
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
            {self._context.ticket()},
        )
        for i, name in enumerate(wheels):
            self.DeclareVectorOutputPort(
                f"wheel_{name}", 12, self._wheel_port(i), {self._motion.ticket()}
            )
        for name, joint in struts.items():
            rows = [
                joint.position_start(),
                plant.num_positions() + joint.velocity_start(),
            ]
            self.DeclareVectorOutputPort(
                f"strut_{name}", 2, self._strut_port(rows), state
            )
            self.DeclareVectorOutputPort(
                f"strut_axis_{name}",
                3,
                self._axis_port(joint),
                {self._context.ticket()},
            )

    def _wheel_port(self, i: int):
        def calc(context, output):
            output.SetFromVector(self._motion.Eval(context)[i])

        return calc

    def _strut_port(self, rows: list[int]):
        def calc(context, output):
            output.SetFromVector(self._state.Eval(context)[rows])

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
        plant_context = self._context.Eval(context)
        out = np.empty((len(self._wheels), 12))
        for row, wheel in zip(out, self._wheels):
            X_WH = wheel.EvalPoseInWorld(plant_context)
            V_WH = wheel.EvalSpatialVelocityInWorld(plant_context).get_coeffs()
            row[:3] = X_WH.translation()
            row[3:6] = X_WH.rotation().col(1)
            row[6:9] = V_WH[3:]
            row[9:] = V_WH[:3]
        value.set_value(out)
