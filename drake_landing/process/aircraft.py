"""The aircraft of a case: a user's deck with gears, or a built-in reference."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.body import check_nodes
from drake_landing.airframe.damping import with_damping
from drake_landing.airframe.deck_units import check_units
from drake_landing.airframe.free_flight import check_mass
from drake_landing.airframe.gear_checks import check_gears
from drake_landing.airframe.mass_cases import check_target, write_mass_case
from drake_landing.airframe.steady import steady_flight
from drake_landing.case.airframe import Airframe, Matrices
from drake_landing.case.axes import rotation_AB
from drake_landing.case.damping import AirframeDamping
from drake_landing.case.deck_file import deck_file
from drake_landing.case.lift import Lift
from drake_landing.case.mass_cases import mass_case_of
from drake_landing.case.scenario import Scenario
from drake_landing.case.schema import Case
from drake_landing.case.steady import Steady
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.landing.threads import single_threaded_blas
from drake_landing.parametric import WrittenAircraft, parametric_aircraft
from drake_landing.reduced.legs import with_read_legs
from drake_landing.reduced.model import ReducedModel
from fem.arrays import Float64
from fem.deck.cards.conversions import Units
from fem.deck.deck import Deck
from fem.deck.reader import read_deck
from fem.deck.units import in_si, units_of
from fem.errors import InputError
from fem.files.escaping import file_name
from fem.model.structure import Structure


def checked_aircraft(
    case: Case, out: Path
) -> tuple[Aircraft, Structure, tuple[str, ...]]:
    """The aircraft of a case, its full model, and remarks on how its gears sit.

    Raises:
        InputError: as `prepare_aircraft`; grids that are not there or do not move, no
            mass, units that cannot be meant, gears that cannot land.
    """
    aircraft = prepare_aircraft(case, out)
    structure = aircraft.structure()
    check_nodes(structure, aircraft)
    check_mass(structure)
    remarks = check_units(structure, aircraft)
    R_AB = rotation_AB(case.airframe.axes)
    return aircraft, structure, (*remarks, *check_gears(structure, aircraft, R_AB))


# The last digits of sums depend on the threads of BLAS. Those of a deck must not:
# what is kept of an earlier run is found by their content.
@single_threaded_blas()
def prepare_aircraft(case: Case, out: Path) -> Aircraft:
    """The aircraft of a case; a built-in one is written to `out/airframe.bdf`.

    Raises:
        InputError: the deck is not there, or the built-in model is unknown.
    """
    airframe = case.airframe
    read: Callable[[Path], Deck] = partial(
        _read, ignore=airframe.ignore, units=airframe.units
    )
    if airframe.model is None:
        deck = deck_file(airframe)
        if airframe.matrices is not None:
            deck, read = _matrices_deck(airframe, airframe.matrices, out)
        assert deck is not None  # the case sees to it
        assert not isinstance(case.gears, str)  # the case sees to it
        gears, notices = with_read_legs(case.gears)
        name = deck.stem
        deck = _with_mass_case(airframe, deck, out)
        return Aircraft(
            name=name,
            topology=airframe.topology or "",
            deck=deck,
            units=airframe.units,
            read=_damped(read, airframe.damping),
            gears=gears,
            notices=notices,
            monitoring=airframe.monitoring,
            scenario=_with_lift_nodes(case.scenario),
            interface=airframe.interface,
            steady=_steady(airframe, gears),
            check=_mass_check(airframe, gears),
        )
    model = parametric_aircraft(airframe.model)
    out.mkdir(parents=True, exist_ok=True)
    with _as_field("airframe.topology", "topology: "):
        written = model.write(out / "airframe.bdf", airframe.topology)
    gears, notices = with_read_legs(_gears(case, written))
    return Aircraft(
        name=written.name,
        topology=written.topology,
        deck=_with_mass_case(airframe, out / "airframe.bdf", out),
        gears=gears,
        notices=notices,
        monitoring={**written.monitoring, **airframe.monitoring},
        scenario=_with_lift_nodes(case.scenario, written.lift_nodes),
        interface=tuple(sorted({*written.interface, *airframe.interface})),
        parametric=model,
        read=_damped(read_deck, airframe.damping),
        check=_mass_check(airframe, gears),
        steady=_steady_of_mass_case(airframe, gears, written.lift_nodes),
    )


def _steady_of_mass_case(
    airframe: Airframe, gears: tuple[LandingGear, ...], nodes: tuple[int, ...]
) -> Callable[[Structure], Float64] | None:
    """Steady flight of a built-in model with another mass.

    The lift that it brings carries its own mass; one of the wing's nodes that balances
    the mass case takes its place.
    """
    if airframe.mass_case is None or not nodes:
        return None
    given, R_AB = Steady(nodes=nodes), rotation_AB(airframe.axes)
    return lambda structure: steady_flight(structure, gears, given, R_AB)


def _with_mass_case(airframe: Airframe, deck: Path, out: Path) -> Path:
    """The deck of the mass case, written to `out`, or the deck itself."""
    if airframe.mass_case is None:
        return deck
    given = mass_case_of(airframe.mass_case, airframe.mass_cases, deck)
    out.mkdir(parents=True, exist_ok=True)
    path = out / f"{deck.stem}_{file_name(airframe.mass_case)}.bdf"
    field = f"airframe.mass_cases.{airframe.mass_case}"
    write_mass_case(given.deck or deck, given, path, field)
    return path


def _mass_check(
    airframe: Airframe, gears: tuple[LandingGear, ...]
) -> Callable[[Structure], None] | None:
    """Whether the mass case weighs what it should."""
    given = airframe.mass_cases.get(airframe.mass_case or "")
    if given is None:
        return None
    field = f"airframe.mass_cases.{airframe.mass_case}"
    return partial(check_target, gears=gears, given=given, field=field)


def _steady(
    airframe: Airframe, gears: tuple[LandingGear, ...]
) -> Callable[[Structure], Float64] | None:
    """Steady flight that the case gives."""
    given, R_AB = airframe.steady, rotation_AB(airframe.axes)
    if given is None:
        return None
    return partial(
        steady_flight, gears=gears, given=given, R_AB=R_AB, units=airframe.units
    )


def _damped(
    read: Callable[[Path], Deck], damping: AirframeDamping | None
) -> Callable[[Path], Deck]:
    """Reading with the damping of the case; can be sent to another process."""
    return partial(_read_damped, read=read, damping=damping)


def _read_damped(
    path: Path, read: Callable[[Path], Deck], damping: AirframeDamping | None
) -> Deck:
    return with_damping(read(path), damping)


def _gears(case: Case, written: WrittenAircraft) -> tuple[LandingGear, ...]:
    """The case's own gears, or a set that the aircraft has by name."""
    if isinstance(case.gears, str):
        return written.gear_sets.get(case.gears, written.gears)
    return tuple(case.gears)


def _read(path: Path, ignore: tuple[str, ...], units: str) -> Deck:
    """A deck in SI."""
    return in_si(read_deck(path, ignore=ignore), units_of(units))


@contextmanager
def _as_field(field: str, begin: str) -> Iterator[None]:
    """Problems are those of a field of the case, instead of what they begin with."""
    try:
        yield
    except InputError as error:
        raise InputError(
            f"{field}: {text.removeprefix(begin)}" for text in error.problems
        ) from None


def _with_lift_nodes(scenario: Scenario, wing: tuple[int, ...] = ()) -> Scenario:
    """Those of the built-in model where the case has none."""
    lift = scenario.lift
    if not isinstance(lift, Lift) or lift.nodes:
        return scenario
    if not wing:
        raise InputError(
            "scenario.lift.nodes: found none, expected the grids of the deck that "
            "carry the lift, round the center of gravity"
        )
    return scenario.model_copy(update={"lift": lift.model_copy(update={"nodes": wing})})


def _matrices_deck(
    airframe: Airframe, matrices: Matrices, out: Path
) -> tuple[Path, Callable[[Path], Deck]]:
    """Grids of a user's matrices as `out/airframe.bdf`, and how to read it.

    Raises:
        InputError: the files do not fit together.
    """
    from drake_landing.reduced.as_deck import write_grids_deck
    from drake_landing.reduced.imported import read_reduced

    roles = ("stiffness", "mass", "damping", "recovery")
    names = {role: getattr(matrices, role) for role in roles}
    with _as_field("airframe.matrices", "matrices: "):
        model = read_reduced(matrices.files, matrices.grids, names)
    deck = out / "airframe.bdf"
    write_grids_deck(deck, model)
    units = units_of(airframe.units)
    return deck, partial(_read_with_matrices, model=model, units=units)


def _read_with_matrices(path: Path, model: ReducedModel, units: Units) -> Deck:
    from drake_landing.reduced.as_deck import deck_with_matrices

    return in_si(deck_with_matrices(path, model), units)
