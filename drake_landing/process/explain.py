"""What a case will do, in words, after a dry run of all that can go wrong early.

The deck is read, its matrices are assembled and factorised, the gears are built and put
just above the runway; modes and landing are left to `run`.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.body import rigid_airframe
from drake_landing.airframe.damping import damping_story
from drake_landing.airframe.free_flight import check_free_flight
from drake_landing.airframe.gear_places import clearances, pitch_of_all
from drake_landing.airframe.load_shapes import load_model
from drake_landing.airframe.mass_cases import loaded
from drake_landing.airframe.pulses import GearPulses
from drake_landing.airframe.relevance import ModalModel
from drake_landing.airframe.selection import expected_pulses
from drake_landing.airframe.truncation import WANTED, below, frequency_for, point_errors
from drake_landing.cache import Cache
from drake_landing.case.axes import gear_in_A, rotation_AB
from drake_landing.case.schema import Case
from drake_landing.conditions.build import on_ground
from drake_landing.conditions.peaks import landing_story
from drake_landing.conditions.rules import condition_figures
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.gears.leg_laws import leg_oscillators
from drake_landing.landing.compilation import compilation_remark
from drake_landing.landing.initial_state import attitude
from drake_landing.landing.settling import LIMIT
from drake_landing.parts.inventory import Inventory
from drake_landing.parts.stress import stress_point_notices
from drake_landing.process.aircraft import checked_aircraft
from drake_landing.process.full_response import parts_looked_at
from drake_landing.results.result_files import FILES
from drake_landing.transient.step_error import (
    StepError,
    StepRefused,
    expected_step_error,
)
from fem.algebra.linear_solver import factorize
from fem.errors import by_kind
from fem.model.structure import Structure

_AT_ONCE = 200_000  # freedoms that are factorised without being asked, some seconds
_HEAD = 12  # characters
_COMPONENTS = 8  # that are named
_USUAL = 1.2  # s, of a landing that ends by itself

# Processor seconds as measured: fixed ones, per second of landing, per mode of that,
# per step of the transient over a solution.
_START, _FLIGHT, _MODE, _STEP = 18.0, 1.0, 0.02, 2.5
# Tires that hardly roll are stiff: steps at 10, 1 and 0 m/s are 1.6, 9 and 34 times
# those at 70 m/s, about 1 + 8 / speed down to where the law of slip is viscous.
_ROLLING, _VISCOUS = 8.0, 0.25  # m/s


@dataclass(frozen=True, kw_only=True)
class Cost:
    """Processor time of a factorisation and of a solution with it, s."""

    factor: float
    solve: float


def explain(case: Case, out: Path | None = None, *, thorough: bool = False) -> str:
    """Text of a check: airframe, gears, scenario, run and files.

    Args:
        case: validated.
        out: folder that a run would write to; default out/<name>.
        thorough: factorise however large the airframe is.

    Raises:
        InputError: everything that is wrong with deck, gears and scenario, with the
            lines of the case.
        StepRefused: nothing but the transient's step, with the explanation.
    """
    with case.reading(), TemporaryDirectory() as folder:
        aircraft, structure, remarks = checked_aircraft(case, Path(folder))
        nodes = np.array(sorted(aircraft.attachment_nodes), dtype=np.int64)
        _, elements, _ = parts_looked_at(case, aircraft, structure, nodes)
        cost, step, truncated, refused = None, None, "", None
        if thorough or structure.size <= _AT_ONCE:
            check_free_flight(structure)
            cost = _cost(structure)
            shapes = load_model(structure, aircraft, Cache.of_user())
            pulses = expected_pulses(
                structure, case.airframe, aircraft, aircraft.scenario
            )
            try:
                step = expected_step_error(case, aircraft, structure, shapes, pulses)
            except StepRefused as error:  # said when all else has been said
                step, refused = error.found, error
            truncated = _truncated(case, shapes, pulses)
        _dry_run(case, aircraft, structure)
        conditions = list(_conditions(case, aircraft, structure))
    lines = [*_airframe(case, aircraft, structure, cost, truncated)]
    lines += [
        _components(elements),
        *_gears(aircraft, structure, rotation_AB(case.airframe.axes)),
        *_touchdown(case, aircraft),
    ]
    lines += [*_scenario(case, aircraft, structure), *_run(case, structure, cost, step)]
    lines += conditions
    lines.append(_line("files", f"{out or Path('out', case.name)}: {', '.join(FILES)}"))
    if step is not None:
        remarks = (*remarks, *step.remarks)
    remarks = (*remarks, *aircraft.scenario.remarks)
    notices = [*aircraft.notices, *map(case.places.named, remarks)]
    notices += [*structure.notices, *structure.damping_notices]
    notices = by_kind([*notices, *stress_point_notices(structure)])
    text = "\n".join([_head(case), *lines, *(f"note: {text}" for text in notices)])
    if refused is not None:
        raise StepRefused(map(case.places.named, refused.problems), refused.found, text)
    return text


def _cost(structure: Structure) -> Cost:
    """Cost of a factorization and a solution of the direct transient's matrix."""
    k, m = structure.stiffness, structure.mass
    shift = k.diagonal().sum() / m.diagonal().sum()
    times = [process_time()]
    with factorize(sp.csr_matrix(k + shift * m), kind="symmetric") as factor:
        times.append(process_time())
        factor.solve(np.ones(structure.size))
        times.append(process_time())
    return Cost(factor=times[1] - times[0], solve=times[2] - times[1])


def _dry_run(case: Case, aircraft: Aircraft, structure: Structure) -> None:
    """Gears on the rigid airframe, at the start of the scenario."""
    from drake_landing.landing.lifetime import used_once
    from drake_landing.landing.run import build_landing, start_state

    if any(_holds(gear) > 6 for gear in aircraft.gears):
        return  # only a flexible airframe can say how they share the load
    R_AB = rotation_AB(case.airframe.axes)
    landing = build_landing(
        rigid_airframe(structure, aircraft.multibody_nodes, R_AB),
        aircraft.gears,
        aircraft.monitoring,
        R_AB,
        aircraft.scenario,
        bushing=case.bushing,
    )
    with used_once(landing):
        context = landing.diagram.CreateDefaultContext()
        start_state(landing, context, aircraft.scenario, case.simulation.clearance)
        del context


def _holds(gear: LandingGear) -> int:
    """Directions in which the airframe holds a gear rigidly."""
    further = [h for h in gear.further_attachments if h.stiffness is None]
    own = 6 if gear.attachment == "rigid" else 3
    return own + sum(len(hold.directions) for hold in further)


def _head(case: Case) -> str:
    source = f" ({case.places.file})" * bool(case.places.file)
    return f"{case.name}{': ' * bool(case.title)}{case.title}{source}"


def _line(head: str, text: str) -> str:
    return f"  {head:<{_HEAD}}{text}"


def _truncated(case: Case, shapes: ModalModel, pulses: Sequence[GearPulses]) -> str:
    """What a selection by frequency is expected to cost, and what would cost little."""
    select = case.airframe.select
    if select.kind != "below" or case.airframe.basis != "full-modes":
        return ""
    errors = point_errors(shapes, below(shapes, select.value), pulses)
    text = f": accelerations expected to be up to {errors.max():.0%} off"
    if errors.max() <= WANTED:
        return text
    enough = frequency_for(shapes, pulses)
    return text + (f"; below {enough:.0f} Hz up to 5 %" if enough else "")


def _airframe(
    case: Case,
    aircraft: Aircraft,
    structure: Structure,
    cost: Cost | None,
    truncated: str,
) -> Iterator[str]:
    x, y, z = structure.rigid_mass.center
    name = aircraft.deck.name if case.airframe.deck else aircraft.name
    yield _line(
        "airframe",
        f"{name}: {len(structure.points.grid_id)} grids, {structure.size} free "
        f"freedoms, {structure.rigid_mass.total:,.1f} kg, center of gravity at "
        f"{x:z.3f}, {y:z.3f}, {z:z.3f} m",
    )
    yield _line(
        "",
        f"stiffness factorised in {cost.factor:.1f} s: 6 rigid-body motions, no "
        "mechanism"
        if cost
        else f"not factorised ({structure.size} freedoms): mechanisms are found by "
        "check --thorough, or by run",
    )
    axes = case.airframe.axes
    yield _line(
        "",
        f"flies toward {axes.forward}, up is {axes.up}, units {case.airframe.units}; "
        f"elastic modes '{case.airframe.select}', {case.airframe.basis}{truncated}",
    )
    yield _line("damping", damping_story(structure))
    points = ", ".join(f"{n} ({grid})" for n, grid in aircraft.monitoring.items())
    yield _line("points", f"{points}: accelerations of both models")


def _components(elements: Inventory) -> str:
    """For which components stresses will be told, and how to name them otherwise."""
    counts = elements.elements.component.value_counts()
    said = [
        f"{name} ({count} elements)" for name, count in counts.head(_COMPONENTS).items()
    ]
    said += [f"{len(counts) - _COMPONENTS} more"] * (len(counts) > _COMPONENTS)
    named = ", ".join(said) or "no elements with stresses"
    return _line("components", f"{named}; parts.components names others")


def _gears(
    aircraft: Aircraft, structure: Structure, R_AB: npt.NDArray[np.float64]
) -> Iterator[str]:
    width = max(len(gear.name) for gear in aircraft.gears)
    for i, gear in enumerate(aircraft.gears):
        wheels = len(gear.wheel_names)
        held = ", ".join(map(str, gear.attachments.values()))
        yield _line(
            "" if i else "gears",
            f"{gear.name:<{width}}  {gear.kind}, {wheels} wheel{'s' * (wheels > 1)}, "
            f"{gear.mass:,.1f} kg, stroke {gear.shock_absorber.stroke:g} m, at grid "
            f"{held}",
        )
    for gear in aircraft.gears:
        if gear.leg is not None:
            yield _line("", f"{gear.name:<{width}}  {_leg(gear, structure, R_AB)}")


def _leg(gear: LandingGear, structure: Structure, R_AB: npt.NDArray[np.float64]) -> str:
    """Frequencies of the extended leg, by which its data are seen at a glance."""
    at = structure.points.rows([gear.attachment_node])[0]
    place = R_AB @ structure.points.xyz[at]
    found = leg_oscillators(gear_in_A(gear, R_AB), place)
    told = ", ".join(
        f"{kind.replace('_', ' and ')} {rate / (2.0 * np.pi):.3g} Hz "
        f"({100.0 * ratio:.2g} %)"
        for kind, (rate, ratio) in found.items()
    )
    return f"elastic leg, extended: {told}"


def _touchdown(case: Case, aircraft: Aircraft) -> Iterator[str]:
    """Which gears touch first, and at which pitch all would."""
    s = aircraft.scenario
    if s.start != "touchdown":
        return
    gears = [
        gear_in_A(gear, rotation_AB(case.airframe.axes)) for gear in aircraft.gears
    ]
    R_WB = attitude(*np.radians([s.roll, s.pitch, s.yaw]))
    above = ", ".join(
        f"{name} {height:.3f} m" for name, height in clearances(gears, R_WB).items()
    )
    yield _line("", f"at touchdown over the lowest wheel: {above}")
    pitch = pitch_of_all(gears)
    if pitch is not None:
        yield _line(
            "", f"all gears touch at once at a pitch of {np.degrees(pitch):z.2f}°"
        )


def _scenario(case: Case, aircraft: Aircraft, structure: Structure) -> Iterator[str]:
    s = aircraft.scenario
    mass = structure.rigid_mass.total + sum(gear.mass for gear in aircraft.gears)
    energy = 0.5 * mass * s.sink_rate**2
    yield _line("scenario", f"{s.story}; {s.lift_story}")
    sinks = f", sink energy {energy / 1e3:.1f} kJ" * (s.start == "touchdown")
    whole = loaded(structure, aircraft.gears)
    x, y, z = whole.center
    with_gears = f"center of gravity with gears at {x:z.3f}, {y:z.3f}, {z:z.3f} m"
    if case.airframe.mac is not None:
        R_AB = rotation_AB(case.airframe.axes)
        share = case.airframe.mac.percent(whole.center, R_AB)
        with_gears += f" ({share:.2f} % MAC)"
    yield _line("", f"{mass:,.1f} kg in all, {with_gears}{sinks}")
    with_gears, without = (
        " / ".join(f"{v:,.0f}" for v in np.diag(inertia))
        for inertia in (whole.inertia, structure.rigid_mass.inertia)
    )
    about = "about x / y / z through the own center of gravity"
    yield _line("", f"inertia {with_gears} kg m², without gears {without}, {about}")


def _run(
    case: Case, structure: Structure, cost: Cost | None, step: StepError | None
) -> Iterator[str]:
    duration, transient = case.simulation.duration, case.transient
    length = _USUAL if duration == "auto" else duration
    until = (
        f"until it settles (duration auto, at most {LIMIT:g} s)"
        if duration == "auto"
        else f"{duration:g} s"
    )
    steps = case.transient_duration(length) / transient.step
    as_long = duration == "auto" and transient.duration is None
    many = "steps" if as_long else f"{steps:.0f} steps"
    yield _line(
        "run",
        f"landing {until}, {case.simulation.integrator}; then {many} of "
        f"{transient.step:g} s of the full model",
    )
    yield _line("", str(step) if step else "error of the step: check --thorough")
    if cost:
        yield _line(
            "",
            f"about {_expected(case, cost, length, steps)} of processor "
            f"time{compilation_remark()}",
        )


def _conditions(case: Case, aircraft: Aircraft, structure: Structure) -> Iterator[str]:
    """Static cases of the rules and their largest loads, where the case has any."""
    if "conditions" not in case.model_fields_set:
        return
    R_AB = rotation_AB(case.airframe.axes)
    body = rigid_airframe(structure, aircraft.multibody_nodes, R_AB)
    ground = on_ground(body, aircraft.gears, R_AB, case.conditions)
    mass = loaded(structure, aircraft.gears).mass
    story = landing_story(case.conditions, mass)
    flown = not story.startswith("none")
    rows = condition_figures(case.conditions, ground, landings=flown)
    known = set(case.conditions.vertical) >= {gear.name for gear in aircraft.gears}
    if not known:
        rows.insert(0, ("landings", story))
    for i, (number, text) in enumerate(rows):
        yield _line("" if i else "conditions", f"{number:<16}{text}")


def _expected(case: Case, cost: Cost, length: float, steps: float) -> str:
    """How long the run takes, one digit: modes unknown, so a guess of their number."""
    select = case.airframe.select
    modes = select.value if select.kind in ("count", "relevance", "pulses") else 80
    modal = 3 * (cost.factor + modes * cost.solve)
    rolling = 1.0 + _ROLLING / max(case.scenario.forward_speed, _VISCOUS)
    flight = length * (_FLIGHT + _MODE * modes) * rolling
    transient = cost.factor + _STEP * steps * cost.solve
    seconds = _START + modal + flight + transient
    digits = float(f"{seconds:.1g}")
    return f"{digits:.0f} s" if digits < 100 else f"{digits / 60:.0f} min"
