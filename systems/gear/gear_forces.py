"""All forces on the landing gears but those of the attachments, gathered once.

The plant and the attachment both need every one of them: a force that reached the plant
alone would not be felt by the attachment load. One system with one pair of outputs,
wired to both, makes that impossible.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from pydrake.common.value import Value
from pydrake.multibody.math import SpatialForce_
from pydrake.multibody.plant import ExternallyAppliedSpatialForce_, MultibodyPlant
from pydrake.multibody.tree import PrismaticJoint, RevoluteJoint, RigidBody
from pydrake.systems.framework import LeafSystem_

from systems.gear.lever_strut import LeverStrut
from systems.tools.template import default_instantiation, for_scalars
from systems.tools.weak_methods import weakly


@for_scalars
def GearForces_(T):
    class Impl(LeafSystem_[T]):
        """Tire wrenches, strut forces, brake and pitch torques in the plant's own form.

        | port | size | unit | frame and sign |
        |---|---|---|---|
        | in `wrench` | 6 k | N m, N | [torque; force] on each wheel, center, W |
        | in `strut_force` | s | N | along each strut, positive apart |
        | in `ratio_<gear>` (for lever struts) | 1 | m/rad | stroke over angle |
        | in `pitch_<gear>` (for bogies) | 1 | N m | torque on the beam about its joint;
          the opposite torque acts on the piston |
        | in `brake_<wheel>` (for braked wheels) | 1 | N m | torque on the wheel about
          its joint axis; the opposite torque acts on the axle |
        | in `elastic_legs` (where there are such) | nv | N, N m | of ElasticLegs |
        | in `wheel_jacobian` (for all_generalized_force) | 6 k nv | | of the wheels,
          from WheelKinematics |
        | out `spatial_forces` | abstract | | list of ExternallyAppliedSpatialForce |
        | out `generalized_force` | nv | N, N m | of struts, brakes, dampers, legs |
        | out `all_generalized_force` | nv | N, N m | the same and the tires |

        Plant and attachment get either the first two outputs or the last one, which
        takes less time.

        Args:
            plant: finalised.
            wheels: name to wheel body.
            struts: name to strut joint, whose translation is the stroke, or to the
                shock absorber of an arm.
            brakes: name to spin joint of each braked wheel.
            pitches: name to joint of each bogie beam.
            elastic_legs: some leg is elastic.
        """

        def _construct(
            self,
            plant: MultibodyPlant,
            wheels: Mapping[str, RigidBody],
            struts: Mapping[str, PrismaticJoint | LeverStrut],
            brakes: Mapping[str, RevoluteJoint] | None = None,
            pitches: Mapping[str, RevoluteJoint] | None = None,
            elastic_legs: bool = False,
            converter=None,
        ):
            LeafSystem_[T].__init__(self, converter=converter)
            self._given = plant, dict(wheels), dict(struts), brakes, pitches
            brakes, pitches = brakes or {}, pitches or {}
            self._nv = plant.num_velocities()
            self._bodies = tuple(wheel.index() for wheel in wheels.values())
            self._wrench: Any = self.DeclareVectorInputPort("wrench", 6 * len(wheels))
            self._strut: Any = self.DeclareVectorInputPort("strut_force", len(struts))
            self._joints = (
                *self._inputs("brake", brakes, 1),
                *self._inputs("pitch", pitches, 1),
            )
            self._elastic = self._inputs("elastic", ["legs"] * elastic_legs, self._nv)
            levers = {
                n: s.joint for n, s in struts.items() if isinstance(s, LeverStrut)
            }
            self._ratios = self._inputs("ratio", levers, 1)
            self._jacobian: Any = self.DeclareVectorInputPort(
                "wheel_jacobian", 6 * len(wheels) * self._nv
            )
            self._levers = [i for i, name in enumerate(struts) if name in levers]
            sliding = [levers.get(name, strut) for name, strut in struts.items()]
            joints: list[Any] = [*sliding, *brakes.values(), *pitches.values()]
            self._rows = [joint.velocity_start() for joint in joints]
            self._strut_rows = self._rows[: len(struts)]
            self._rows = self._rows[len(struts) :]
            self._zero = np.array([T(0.0)] * self._nv)
            self._declare_outputs()

        def _construct_copy(self, other, converter=None):
            legs = bool(other._elastic)
            Impl._construct(self, *other._given, elastic_legs=legs, converter=converter)

        def _declare_outputs(self) -> None:
            self.DeclareAbstractOutputPort(
                "spatial_forces",
                lambda: Value([ExternallyAppliedSpatialForce_[T]()]),
                weakly(self._calc_spatial_forces),
                prerequisites_of_calc={self._wrench.ticket()},
            )
            joint_loads = {
                port.ticket()
                for port in (self._strut, *self._joints, *self._ratios, *self._elastic)
            }
            self.DeclareVectorOutputPort(
                "generalized_force",
                self._nv,
                weakly(self._calc_generalized_force),
                prerequisites_of_calc=joint_loads,
            )
            tires = {self._wrench.ticket(), self._jacobian.ticket()}
            self.DeclareVectorOutputPort(
                "all_generalized_force",
                self._nv,
                weakly(self._calc_all_generalized_force),
                prerequisites_of_calc=joint_loads | tires,
            )

        def _inputs(self, kind: str, names: Iterable[str], size: int) -> tuple:
            declare = self.DeclareVectorInputPort
            return tuple(declare(f"{kind}_{name}", size) for name in names)

        def _calc_spatial_forces(self, context, output):
            wrenches = self._wrench.Eval(context).reshape(-1, 6)
            output.set_value(spatial_forces(self._bodies, wrenches, T))

        def _calc_generalized_force(self, context, output):
            output.SetFromVector(self._joint_loads(context))

        def _calc_all_generalized_force(self, context, output):
            wrenches = self._wrench.Eval(context)
            jacobian = self._jacobian.Eval(context).reshape(len(wrenches), self._nv)
            output.SetFromVector(self._joint_loads(context) + wrenches @ jacobian)

        def _joint_loads(self, context):
            out = self._zero.copy()
            force = self._strut.Eval(context)
            if self._levers:
                force = force.copy()
                for i, port in zip(self._levers, self._ratios):
                    force[i] = force[i] * port.Eval(context)[0]
            out[self._strut_rows] = -force
            for row, port in zip(self._rows, self._joints):
                out[row] = port.Eval(context)[0]
            for port in self._elastic:
                out += port.Eval(context)
            return out

    return Impl


def spatial_forces(bodies: Sequence, wrenches: Sequence, T: Any = float) -> list[Any]:
    """Forces at body origins as the plant takes them: ExternallyAppliedSpatialForce.

    Args:
        bodies: BodyIndex of each.
        wrenches: [torque, N m; force, N] (6,) of each, in W.
        T: their scalar.
    """
    forces = []
    for body, wrench in zip(bodies, wrenches):
        force = ExternallyAppliedSpatialForce_[T]()
        force.body_index = body
        force.F_Bq_W = SpatialForce_[T](wrench)
        forces.append(force)
    return forces


GearForces = default_instantiation(GearForces_)
