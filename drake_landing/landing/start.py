"""From a scenario to a diagram that fits it, and to the state that it starts from."""

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from pydrake.systems.framework import Context

from drake_landing.case.lift import Following, ReverseThrust
from drake_landing.case.lift import Lift as LiftSection
from drake_landing.case.runway import (
    AnyProfile,
    Bump,
    Measured,
    Ramp,
    Roughness,
    RunwaySection,
    WaveTrain,
)
from drake_landing.case.scenario import Scenario
from drake_landing.gears.bodies import wheel_centers
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.landing.diagram import LandingDiagram, MakeLandingDiagram
from drake_landing.landing.equilibrium import (
    set_flight_equilibrium,
    set_static_equilibrium,
)
from drake_landing.landing.initial_state import (
    angular_velocity,
    attitude,
    set_initial_state,
)
from drake_landing.landing.lift import STANDARD_GRAVITY, Lift, Motion, decaying
from fem.errors import InputError
from systems.airframe.modal_body import ModalBody
from systems.airframe.quasi_steady_lift import QuasiSteadyLift, Surface
from systems.runway.roughness import rough_tracks
from systems.runway.runway import Runway
from systems.runway.runway_profile import (
    CosineBump,
    Profile,
    Step,
    Waves,
)
from systems.tools.table import Table

Float64 = npt.NDArray[np.float64]


def make_scenario_diagram(
    body: ModalBody,
    gears: Sequence[LandingGear],
    scenario: Scenario,
    monitor_nodes: Sequence[int] = (),
    **options,
) -> LandingDiagram:
    """A diagram with the runway, gravity, lift and brakes of a scenario.

    It serves all scenarios that have these in common.

    Args:
        body, gears, monitor_nodes: as in MakeLandingDiagram.
        scenario: what is to be run.
        options: further arguments of MakeLandingDiagram, whose `together` is True here.

    Raises:
        InputError: brakes are to be applied and no gear has any, or nodes that carry
            the lift are not given, or the profile is too sharp for the tires.
        ValueError: as MakeLandingDiagram.
    """
    if scenario.braking and not any(gear.brake for gear in gears):
        raise InputError(
            f"scenario.braking: found {scenario.braking:g}, but no gear has a brake"
        )
    ahead = min(p[0] for gear in gears for p in wheel_centers(gear).values())
    runway = runway_of(scenario.runway, origin=(ahead - body.p_BG[0], 0.0))
    _require_rollable(runway, gears, scenario.runway.profile)
    return MakeLandingDiagram(
        body,
        gears,
        runway,
        monitor_nodes=monitor_nodes,
        gravity=STANDARD_GRAVITY if scenario.gravity else 0.0,
        lift=_lift(scenario.lift) if isinstance(scenario.lift, LiftSection) else None,
        brakes=scenario.braking > 0,
        **{"together": True, **options},
    )


def set_scenario_state(
    landing: LandingDiagram,
    context: Context,
    scenario: Scenario,
    clearance: float = 1e-3,
) -> None:
    """The state that the scenario starts from.

    Args:
        landing: of `make_scenario_diagram`.
        context: of the diagram.
        scenario: attitude, velocities, brakes.
        clearance: of the lowest tire at touchdown, m.

    Raises:
        ValueError: no state of rest is found.
    """
    s, rad = scenario, math.radians
    if s.start == "rolling":
        set_static_equilibrium(landing, context, speed=s.forward_speed)
    else:
        turning = (rad(s.roll_rate), rad(s.pitch_rate), rad(s.yaw_rate))
        set_initial_state(
            landing,
            context,
            v_WG=[-s.forward_speed, s.side_speed, -s.sink_rate],
            R_WB=attitude(rad(s.roll), rad(s.pitch), rad(s.yaw)),
            w_B=angular_velocity(*turning),
            clearance=clearance,
        )
        if s.gravity and not any(turning):
            set_flight_equilibrium(landing, context)
    if isinstance(landing.lift, QuasiSteadyLift) and s.forward_speed > 0:
        landing.lift.set_reference(landing.lift.GetMyMutableContextFromRoot(context))
    for brake in landing.brakes.values():
        brake.set_factor(brake.GetMyMutableContextFromRoot(context), s.braking)


def reference_energy(landing: LandingDiagram, scenario: Scenario) -> float:
    """Energy of the sinking aircraft, J; for rolling the reference that stands in."""
    mass = landing.body.mass + sum(gear.mass for gear in landing.gears)
    return 0.5 * mass * scenario.sink_rate**2


def _lift(section: LiftSection) -> Lift:
    if not section.nodes:
        raise InputError("scenario.lift: no nodes, expected those of the wing")
    factor = section.factor
    if section.decay_duration is not None:
        factor = decaying(
            section.factor,
            start=section.decay_start,
            duration=section.decay_duration,
            remaining=section.remaining,
        )
    return Lift(
        nodes=section.nodes,
        factor=factor,
        shares=section.shares,
        motion=section.follows and _motion(section.follows),
        reverse_thrust=_reverse_thrust(section.reverse_thrust),
    )


def _motion(section: Following) -> Motion:
    data = section.model_dump(exclude={"tail"})
    tail = section.tail
    if tail is None:
        return Motion(**data)
    equal = [1.0 / len(tail.nodes)] * len(tail.nodes)
    surface = Surface(nodes=tail.nodes, shares=equal, area=tail.area, slope=tail.slope)
    return Motion(**data, tail=surface, downwash=tail.downwash, lag=tail.lag)


def _reverse_thrust(section: ReverseThrust | None):
    if section is None:
        return None
    return section.nodes, Table(*zip(*section.table))


def _require_rollable(
    runway: Runway, gears: Sequence[LandingGear], profile: AnyProfile | None
) -> None:
    """Hollows are wider than the tires, those of a file in its unit, too."""
    try:
        for gear in gears:
            runway.require_rollable(gear.tyre.radius)
    except ValueError as error:
        text = str(error).removeprefix("runway: ")
        if isinstance(profile, Measured):
            text = (
                f"{profile.file.name}: {text.split(': make')[0]}: are distances and "
                f"heights in {profile.unit}, the points far enough apart?"
            )
        raise InputError(f"scenario.runway.profile: {text}") from None


def runway_of(section: RunwaySection, origin: tuple[float, float] = (0, 0)) -> Runway:
    """The runway of a scenario.

    Args:
        section: of the case.
        origin: point of zero distance, W, m.

    Raises:
        ValueError: a value is out of range.
    """
    left, right, spacing = _tracks(section.profile)
    x, y = origin
    return Runway(
        profile=left,
        right=right,
        track_spacing=spacing or _SPACING,
        crown=section.crown,
        surface=section.surface,
        friction_factor=section.friction_factor,
        # The aircraft flies toward -x, starboard is +y.
        origin=(x, y - section.offset),
    )


_SPACING = 7.6  # m, of the main gears of a medium transport; where it has no effect


def _tracks(
    data: AnyProfile | None,
) -> tuple[Profile | None, Profile | None, float | None]:
    """Left and right track and their spacing (m); one track is for all wheels."""
    if isinstance(data, Roughness):
        tracks = rough_tracks(
            data.density,
            seed=data.seed,
            length=data.length,
            start=data.start,
            wavelengths=data.wavelengths,
            run_in=data.run_in,
            track_spacing=data.track_spacing,
        )
        if not data.track_spacing:
            return tracks[0], None, None
        return *tracks, data.track_spacing
    if isinstance(data, Measured):
        found = data.tracks
        return found[0], found[1] if len(found) == 2 else None, data.track_spacing
    return _profile(data) if data else None, None, None


def _profile(data: Bump | WaveTrain | Ramp) -> Profile:
    if isinstance(data, Bump):
        return CosineBump(height=data.height, length=data.length, start=data.start)
    if isinstance(data, WaveTrain):
        return Waves(
            amplitude=data.amplitude, wavelength=data.wavelength, start=data.start
        )
    return Step(height=data.height, ramp=data.ramp, start=data.start)
