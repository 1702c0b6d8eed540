"""Load pulses of the landing gears on the airframe, expected before any landing is run.

Each gear is dropped on its own (`drop`) with its share of the aircraft, at the sink
rate and the speed of the scenario; drag and side force act at the axle. Side force
comes from drift, and, on gears off the center plane, from an airframe that bends and
swings its wheels sideways: a share of the drag, as sudden, stands for it. A leg that
bends hands both on as spring and damper of a mass at the axle do (root clamped, the
other motions locked): the drag swings back. Where aircraft and scenario are symmetric,
gears of a pair act together: antisymmetric modes are then known to be idle.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.drop import DropPulse, drop_pulse
from drake_landing.airframe.oscillators import modal_accelerations
from drake_landing.case.scenario import Scenario
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.gears.leg_laws import leg_oscillators
from drake_landing.gears.parameters import tire_parameters
from drake_landing.landing.lift import STANDARD_GRAVITY
from systems.runway.runway import Runway
from systems.tire.tire_law import TireLaw

Float64 = npt.NDArray[np.float64]

STEP, DURATION = 5e-4, 0.6  # s: ten periods of the first bending, of 2 Hz: one
# Side force over drag where the airframe swings the wheels while they spin up: 0.08 to
# 0.16 in landings of the reference aircraft without drift.
_SWING = 0.1
_CENTER = 0.1  # m, within which a gear stands in the center plane
_LEAST_SHARE = 0.02  # of the aircraft: a gear that would unload in a level landing


@dataclass(frozen=True, kw_only=True)
class GearPulses:
    """Loads of gears that touch down together, in axes B.

    Attributes:
        names: of the gears.
        node_id: (k,) their attachment nodes.
        step: s.
        load: (k, t, 6) force (N) and moment (N m) on the airframe at the nodes.
    """

    names: tuple[str, ...]
    node_id: npt.NDArray[np.int64]
    step: float
    load: Float64


def touchdown_pulses(
    gears: Sequence[LandingGear],
    scenario: Scenario,
    *,
    p_AN: dict[int, Float64],
    mass: float,
    p_AG: Float64,
    R_AB: Float64,
) -> list[GearPulses]:
    """Pulses of all gears, one element for gears that act together.

    Args:
        gears: in A.
        scenario: sink rate, speeds and angles.
        p_AN: attachment node -> position in A, m.
        mass, p_AG: of the airframe, kg, m.
        R_AB: (3, 3); the loads come out in B.
    """
    shares = _shares(gears, mass, p_AG)
    groups = _groups(gears, scenario)
    ground = scenario.runway
    friction = Runway(
        surface=ground.surface, friction_factor=ground.friction_factor
    ).friction
    pulses = []
    for group in groups:
        loads, nodes = [], []
        for i in group:
            pulse = drop_pulse(
                gears[i],
                shares[i],
                scenario.sink_rate,
                scenario.forward_speed,
                friction=friction,
                step=STEP,
                duration=DURATION,
            )
            node = gears[i].attachment_node
            arm = np.mean(gears[i].axles, axis=0) - p_AN[node]
            side = friction * _side_ratio(gears[i], scenario, shares[i])
            side = side * pulse.vertical
            side = side + _swing(gears[i], p_AG) * pulse.drag
            legs = leg_oscillators(gears[i], p_AN[node])
            drag = through_leg(pulse.drag, STEP, legs.get("fore_aft"))
            side = through_leg(side, STEP, legs.get("lateral"))
            load = _at_node(drag, side, pulse, arm)
            loads.append((load.reshape(-1, 2, 3) @ R_AB).reshape(-1, 6))
            nodes.append(node)
        pulses.append(
            GearPulses(
                names=tuple(gears[i].name for i in group),
                node_id=np.array(nodes, dtype=np.int64),
                step=STEP,
                load=np.array(loads),
            )
        )
    return pulses


def is_symmetric(scenario: Scenario) -> bool:
    """Whether a symmetric aircraft stays symmetric."""
    s = scenario
    return not any((s.roll, s.yaw, s.side_speed, s.roll_rate, s.yaw_rate))


def _groups(gears: Sequence[LandingGear], scenario: Scenario) -> list[list[int]]:
    """Gears that act together: mirror images in a symmetric scenario."""
    groups: list[list[int]] = []
    for i, gear in enumerate(gears):
        twin = next(
            (
                g
                for g in groups
                if is_symmetric(scenario) and _mirror(gears[g[0]], gear)
            ),
            None,
        )
        if twin is None:
            groups.append([i])
        else:
            twin.append(i)
    return groups


def _mirror(a: LandingGear, b: LandingGear) -> bool:
    """Whether two gears stand on opposite sides and are alike."""
    p, q = np.mean(a.axles, axis=0), np.mean(b.axles, axis=0)
    alike = a.tyre == b.tyre and a.shock_absorber == b.shock_absorber
    return alike and bool(np.allclose(p * [1, -1, 1], q, atol=1e-3))


def _shares(gears: Sequence[LandingGear], mass: float, p_AG: Float64) -> Float64:
    """(k,) masses that the gears carry at rest on the ground, smallest in norm."""
    places = np.array([np.mean(gear.axles, axis=0) for gear in gears])
    arms = places[:, :2] - p_AG[:2]
    balance = np.vstack([np.ones(len(gears)), arms.T])
    shares = np.linalg.lstsq(balance, np.array([mass, 0.0, 0.0]), rcond=None)[0]
    return np.maximum(shares, _LEAST_SHARE * mass)


def _side_ratio(gear: LandingGear, scenario: Scenario, share: float) -> float:
    """Side force over vertical force of wheels that drift, to starboard > 0."""
    if scenario.forward_speed <= 0.0:
        return 0.0
    drift = np.radians(scenario.yaw) + np.arctan2(
        -scenario.side_speed, scenario.forward_speed
    )
    if drift == 0.0:
        return 0.0
    tangent = float(np.tan(drift))
    law = TireLaw(tire_parameters(gear.tyre), Runway())
    load = STANDARD_GRAVITY * share / len(gear.wheel_names)
    return float(law.ratios(law.deflection_under(load), 0.0, -tangent)[1])


def _swing(gear: LandingGear, p_AG: Float64) -> float:
    """Side force over drag of a gear that hangs from a wing."""
    offset = float(np.mean(gear.axles, axis=0)[1] - p_AG[1])
    return _SWING * float(np.sign(offset)) if abs(offset) > _CENTER else 0.0


def through_leg(
    force: Float64, step: float, leg: tuple[float, float] | None
) -> Float64:
    """(t,) what spring and damper of a leg hand on of a force at the axle, N.

    Exact for forces that are linear between samples.

    Args:
        force: (t,) N, at even times, from rest.
        step: s.
        leg: rad/s and damping ratio; None for a rigid leg, which hands all on.
    """
    if leg is None:
        return force
    rate, ratio = leg
    frequency, damping = (
        np.array([rate / (2.0 * np.pi)]),
        np.array([2.0 * ratio * rate]),
    )
    # Of a unit mass: what does not accelerate it.
    mass = modal_accelerations(frequency, damping, force[:, None], step)
    return force - mass[:, 0]


def _at_node(drag: Float64, side: Float64, pulse: DropPulse, arm: Float64) -> Float64:
    """(t, 6) force and moment about the node in A; the axle carries the force."""
    force = np.column_stack([drag, side, pulse.vertical])
    axle = arm + np.outer(pulse.stroke, [0.0, 0.0, 1.0])
    return np.hstack([force, np.cross(axle, force)])
