"""States of rest: an aircraft that stands or rolls on its gears, or flies in trim.

Newton's method on the accelerations of the whole diagram, with all velocities zero.
Unknown are the modal amplitudes and the joints of the gears, and on the ground height,
roll and pitch of the airframe. Fittings follow their nodes, whatever the unknowns are.
"""

import numpy as np
import numpy.typing as npt
from pydrake.multibody.tree import PrismaticJoint, RevoluteJoint
from pydrake.systems.framework import Context

from drake_landing.gears.mounted import systems_of
from drake_landing.landing.diagram import LandingDiagram
from drake_landing.landing.initial_state import attitude, tire_clearances
from systems.tools.rotations import quaternion_from_rotation

Float64 = npt.NDArray[np.float64]

_ITERATIONS = 60
# Largest change of an unknown in one iteration: m, rad, or a modal amplitude that
# moves its largest node by 1 m.
_LARGEST_STEP = 0.05
_DIFFERENCE = 1e-7
# Height that takes all tires off any runway, m.
_WELL_CLEAR = 20.0
# Share of the stroke, and tire deflection over radius, to start from.
_STROKE_SHARE, _DEFLECTION_SHARE = 0.6, 0.1


def set_static_equilibrium(
    landing: LandingDiagram,
    context: Context,
    *,
    speed: float = 0.0,
    xy: npt.ArrayLike = (0.0, 0.0),
    heading: float = 0.0,
    tolerance: float = 1e-9,
) -> None:
    """The aircraft at rest on its gears, or rolling freely on even ground.

    Gravity must act. Airframe and struts are deformed as the weight, less a lift at
    time zero, wants them; wheels roll without slip. States of tires and of the energy
    budget, and parameters, are set to their defaults.

    Args:
        landing: the diagram and its parts.
        context: of the diagram.
        speed: m/s, in the direction of the nose.
        xy: (2,) airframe's center of gravity over ground, W, m.
        heading: rad, to starboard of -x.
        tolerance: largest acceleration that is left, m/s² and rad/s².

    Raises:
        ValueError: no gravity, or no state of rest is found: the center of gravity
            lies outside the wheels, or lift carries the aircraft.
    """
    if not landing.gravity > 0:
        raise ValueError(
            f"static equilibrium: gravity is {landing.gravity} m/s², expected > 0"
        )
    landing.diagram.SetDefaultContext(context)
    rest = _Rest(landing, context, np.asarray(xy, dtype=float), heading)
    rest.solve(tolerance)
    _roll(landing, context, speed, heading)


def set_flight_equilibrium(
    landing: LandingDiagram, context: Context, tolerance: float = 1e-9
) -> None:
    """Deforms airframe and gears as gravity and lift want them, in steady flight.

    Attitude and velocity of the airframe stay, and the clearance of the lowest tire;
    it must not turn. What the lift at time zero leaves of gravity accelerates the
    whole, and the deformation is that of such flight.

    Raises:
        ValueError: the airframe turns, or no state is found.
    """
    airframe = landing.airframe.GetMyMutableContextFromRoot(context)
    x = airframe.get_continuous_state_vector().CopyToVector()
    if np.any(x[10:13] != 0.0):
        raise ValueError(
            f"flight equilibrium: angular velocity {x[10:13]} rad/s, expected none"
        )
    velocity = x[7:10].copy()
    clearance = min(tire_clearances(landing, context).values())
    x[7:10] = 0.0
    x[2] += _WELL_CLEAR
    airframe.SetContinuousState(x)
    _Rest(landing, context, x[:2], None).solve(tolerance)
    x = airframe.get_continuous_state_vector().CopyToVector()
    x[7:10] = velocity
    x[2] += clearance - min(tire_clearances(landing, context).values())
    airframe.SetContinuousState(x)
    landing.attachment.place_fittings(context)


class _Rest:
    """Unknowns and residual of a state of rest."""

    def __init__(
        self,
        landing: LandingDiagram,
        context: Context,
        xy: Float64,
        heading: float | None,
    ) -> None:
        self._landing, self._context = landing, context
        self._xy, self._heading = xy, heading
        self._airframe = landing.airframe.GetMyMutableContextFromRoot(context)
        self._plant = landing.plant.GetMyMutableContextFromRoot(context)
        self._start = self._airframe.get_continuous_state_vector().CopyToVector()
        self._joints = [
            joint
            for gear in landing.gears
            for joint in landing.bodies[gear.name].joints.values()
        ]
        self._rigid = 0 if heading is None else 3
        self._n = landing.airframe.n
        self._scale = np.ones(self._rigid + self._n + len(self._joints))
        # Accelerations of modes over squared frequencies are their static errors.
        stiffness = (2.0 * np.pi * landing.body.frequency) ** 2
        self._scale[self._rigid : self._rigid + self._n] = 1.0 / np.maximum(
            stiffness, 1.0
        )

    def solve(self, tolerance: float) -> None:
        """Newton's method with steps cut in length, and halved where that helps."""
        u = self._guess()
        residual = self._residual(u)
        for _ in range(_ITERATIONS):
            if np.abs(residual).max() < tolerance:
                return
            step = self._step(u, residual)
            for _halving in range(12):
                trial = self._residual(u + step)
                if np.linalg.norm(trial) < np.linalg.norm(residual):
                    break
                step = 0.5 * step
            u, residual = u + step, trial
            if np.abs(step).max() < 1e-14:
                break
        if not np.abs(residual).max() < max(1e-6, tolerance):
            raise ValueError(
                "static equilibrium: no state of rest found, accelerations of "
                f"{np.abs(residual).max():.3g} m/s² or rad/s² are left; expected a "
                "center of gravity between the wheels, and lift below the weight"
            )

    def _step(self, u: Float64, residual: Float64) -> Float64:
        columns = [
            (self._residual(u + h) - self._residual(u - h)) / (2.0 * _DIFFERENCE)
            for h in _DIFFERENCE * np.eye(len(u))
        ]
        step = np.linalg.lstsq(np.array(columns).T, -residual, rcond=1e-14)[0]
        return step * min(1.0, _LARGEST_STEP / max(np.abs(step).max(), 1e-30))

    def _guess(self) -> Float64:
        u = np.zeros(len(self._scale))
        if not self._rigid:
            u[: self._n] = self._start[13 : 13 + self._n]
            u[self._n :] = [_position(j, self._plant) for j in self._joints]
            return u
        at = self._rigid + self._n
        for gear in self._landing.gears:
            joints = self._landing.bodies[gear.name].joints
            u[at] = _guessed_stroke(self._landing, gear.name, gear.shock_absorber)
            at += len(joints)
        self._set(u)
        clearance = tire_clearances(self._landing, self._context)
        deflection = {
            name: _DEFLECTION_SHARE * tire.parameters.radius
            for name, tire in self._landing.tires.items()
        }
        u[0] = -max(clearance[name] + deflection[name] for name in clearance)
        return u

    def _set(self, u: Float64) -> None:
        x = self._start.copy()
        if self._heading is not None:
            x[:2], x[2] = self._xy, u[0]
            turned = attitude(u[1], u[2], self._heading)
            x[3:7] = quaternion_from_rotation(turned)
        at = self._rigid + self._n
        x[13 : 13 + self._n] = u[self._rigid : at]
        x[13 + self._n :] = 0.0
        self._airframe.SetContinuousState(x)
        for joint, value in zip(self._joints, u[at:]):
            _set_position(joint, self._plant, float(value))
        self._landing.attachment.place_fittings(self._context)
        for absorber in systems_of(self._landing.shock_absorbers).values():
            absorber.settle(absorber.GetMyMutableContextFromRoot(self._context))

    def _residual(self, u: Float64) -> Float64:
        self._set(u)
        airframe = self._landing.airframe.EvalTimeDerivatives(self._airframe)
        x_dot = airframe.CopyToVector()
        plant = self._landing.plant.EvalTimeDerivatives(self._plant).CopyToVector()
        v_dot = plant[self._landing.plant.num_positions() :]
        rates = [v_dot[joint.velocity_start()] for joint in self._joints]
        x, y, _ = x_dot[10:13]
        rigid = [x_dot[9], -x, y][: self._rigid]
        # Joints move with the airframe where it is not in balance.
        elastic = x_dot[13 + self._n :]
        return self._scale * np.concatenate([rigid, elastic, rates])


def _guessed_stroke(landing: LandingDiagram, gear: str, absorber) -> float:
    stroke = _STROKE_SHARE * absorber.stroke
    strut = landing.bodies[gear].strut
    return stroke if isinstance(strut, PrismaticJoint) else strut.geometry.angle(stroke)


def _position(joint: PrismaticJoint | RevoluteJoint, context: Context) -> float:
    sliding = isinstance(joint, PrismaticJoint)
    return joint.get_translation(context) if sliding else joint.get_angle(context)


def _set_position(
    joint: PrismaticJoint | RevoluteJoint, context: Context, value: float
) -> None:
    if isinstance(joint, PrismaticJoint):
        joint.set_translation(context, value)
    else:
        joint.set_angle(context, value)


def _roll(
    landing: LandingDiagram, context: Context, speed: float, heading: float
) -> None:
    """All move with the given speed; wheels turn so that no tire slips."""
    if speed == 0.0:
        return
    airframe = landing.airframe.GetMyMutableContextFromRoot(context)
    x = airframe.get_continuous_state_vector().CopyToVector()
    forward = np.array([-np.cos(heading), np.sin(heading), 0.0])
    x[7:10] = speed * forward
    airframe.SetContinuousState(x)
    landing.attachment.place_fittings(context)
    plant = landing.plant.GetMyMutableContextFromRoot(context)
    kinematics = landing.wheel_kinematics
    for gear in landing.gears:
        for name, joint in landing.bodies[gear.name].spins.items():
            of_system = kinematics.GetMyContextFromRoot(context)
            wheel = kinematics.GetOutputPort(f"wheel_{name}").Eval(of_system)
            tire = landing.tires[name]
            deflection = float(tire.contact(context).deflection)
            radius = tire.rolling_radius(max(deflection, 0.0))
            # Along the wheel is axle × up; rolling forward turns it negatively.
            a_x, a_y = wheel[3:5]
            along = (a_y * wheel[6] - a_x * wheel[7]) / np.hypot(a_x, a_y)
            joint.set_angular_rate(plant, along / radius)
