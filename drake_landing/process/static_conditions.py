"""`drake-landing conditions`: the rules' static load cases on the full model of a case.

Landings give the largest vertical loads; every paragraph makes its cases; each is
balanced by inertia, and the airframe answers: attachment loads, stresses, section
loads, and one SOL 101 deck.
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pandas as pd

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.body import load_airframe
from drake_landing.cache import Cache
from drake_landing.case.axes import rotation_AB
from drake_landing.case.schema import Case
from drake_landing.conditions.balance import RigidBalance, holds, rigid_balance
from drake_landing.conditions.build import OnGround, on_ground
from drake_landing.conditions.labels import labels
from drake_landing.conditions.load_pictures import load_pictures
from drake_landing.conditions.peaks import landing_peaks, sink_rate
from drake_landing.conditions.rules import RULES
from drake_landing.csv_tables import write_csv
from drake_landing.process.aircraft import checked_aircraft
from drake_landing.process.condition_answers import (
    Answers,
    monitor_extremes,
    section_extremes,
    worst_over_cases,
)
from drake_landing.process.condition_readme import README, write_readme
from drake_landing.process.condition_tables import (
    attachment_table,
    case_table,
    gear_table,
    named_cases,
    place_table,
    standing,
    with_headings,
)
from drake_landing.process.full_response import parts_watch
from drake_landing.progress import Reporter, Silent
from drake_landing.results.stages import Stages
from drake_landing.results.units import quantity_units
from drake_landing.transient.static_deck import (
    LABEL_WIDTH,
    StaticCase,
    write_static_deck,
)
from fem.arrays import Float64
from fem.errors import InputError
from fem.model.structure import Structure

DECK = "conditions_sol101.bdf"


@dataclass(frozen=True, kw_only=True)
class ConditionsResult:
    """Static cases of the rules, and the answers of the airframe to them.

    Attributes:
        ground: the aircraft.
        applied: paragraph -> its number of cases.
        left_out: paragraph -> why it has none.
        balances: of all cases.
        places: of the gears in every pose, table, SI.
        cases, gear_loads, attachment_loads, worst, sections: tables, SI.
        monitors: extremes at the deck's monitor points; empty: it has none.
        error: of the equilibrium, largest of all cases, over the largest load.
        notices: what the user should know.
    """

    ground: OnGround
    applied: dict[str, int]
    left_out: dict[str, str]
    balances: tuple[RigidBalance, ...] = field(repr=False)
    places: pd.DataFrame = field(repr=False)
    cases: pd.DataFrame = field(repr=False)
    gear_loads: pd.DataFrame = field(repr=False)
    attachment_loads: pd.DataFrame = field(repr=False)
    worst: pd.DataFrame = field(repr=False)
    sections: pd.DataFrame = field(repr=False)
    monitors: pd.DataFrame = field(repr=False)
    error: float
    notices: tuple[str, ...] = ()


def run_conditions(
    case: Case, out: Path, progress: Reporter | None = None
) -> ConditionsResult:
    """Builds, solves and writes the static cases of the rules.

    Args:
        case: validated; its `conditions` say which rules and weight.
        out: folder for tables, pictures and the deck.
        progress: told the stages.

    Raises:
        InputError: everything that is wrong with deck, gears and conditions.
    """
    with case.reading():
        return _run(case, out, Stages(progress or Silent()))


def _run(case: Case, out: Path, stages: Stages) -> ConditionsResult:
    out.mkdir(parents=True, exist_ok=True)
    stages.begin("reading the deck")
    aircraft, structure, remarks = checked_aircraft(case, out)
    R_AB = rotation_AB(case.airframe.axes)
    stages.begin("eigenmodes")
    airframe = load_airframe(
        case.airframe,
        aircraft,
        stages.progress,
        case.scenario,
        Cache.of_user(),
        structure,
    )
    peaks = None
    if set(case.conditions.vertical) < {gear.name for gear in aircraft.gears}:
        # What cannot stand on the ground is named before anything is flown.
        on_ground(airframe.body, aircraft.gears, R_AB, case.conditions)
        stages.begin("landings for the largest vertical loads")
        mass = airframe.body.mass + sum(gear.mass for gear in aircraft.gears)
        sink = sink_rate(case.conditions, mass)
        peaks = landing_peaks(
            airframe.body, aircraft.gears, R_AB, case.conditions, sink
        )
    ground = on_ground(airframe.body, aircraft.gears, R_AB, case.conditions, peaks)
    stages.begin("static cases")
    result = solve(case, aircraft, structure, ground, out)
    stages.begin("tables and pictures")
    write_tables(result, out)
    load_pictures(result.balances, ground, out / "pictures", airframe.skeleton)
    write_readme(out)
    stages.end()
    notices = (*aircraft.notices, *map(case.places.named, remarks))
    notices += _steady_notices(aircraft)
    return ConditionsResult(**{**vars(result), "notices": (*notices, *result.notices)})


def _steady_notices(aircraft: Aircraft) -> tuple[str, ...]:
    """What stresses and section loads of landing conditions are."""
    if aircraft.steady_load is None:
        return (
            "landing conditions: stresses and section loads are increments to steady "
            "flight, which is not known (airframe.steady)",
        )
    return (
        "landing conditions: stresses contain steady flight at 1 g, section loads are "
        "increments to it",
    )


def solve(
    case: Case,
    aircraft: Aircraft,
    structure: Structure,
    ground: OnGround,
    out: Path,
) -> ConditionsResult:
    """All cases on the full model, and the deck.

    Raises:
        InputError: no paragraph applies.
    """
    R_AB = rotation_AB(case.airframe.axes)
    applied, left_out, balances, texts = {}, {}, [], []
    for paragraph in RULES[case.conditions.rules]:
        if paragraph.cases is None:
            continue
        if missing := paragraph.missing(ground.aircraft):
            left_out[paragraph.number] = missing
            continue
        found = [rigid_balance(ground, c) for c in paragraph.cases(ground.aircraft)]
        applied[paragraph.number] = len(found)
        balances += found
        texts += [paragraph.text] * len(found)
    if not balances:
        raise InputError(
            "conditions: no paragraph applies: "
            + "; ".join(f"{number} {why}" for number, why in left_out.items())
        )
    held = holds(structure, aircraft.gears)
    split = np.array([held.split(_in_B(b.handed, R_AB)) for b in balances]).T
    answers = Answers(aircraft, structure, held, split, balances)
    watch = parts_watch(case, aircraft, structure, held.node_id, None)
    error = max(*(b.error for b in balances), answers.error(structure))
    _write_deck(out / DECK, case, aircraft, structure, answers, balances)
    return ConditionsResult(
        ground=ground,
        applied=applied,
        left_out=left_out,
        balances=tuple(balances),
        places=place_table(ground, R_AB),
        cases=case_table(balances).assign(text=texts),
        gear_loads=gear_table(balances),
        attachment_loads=attachment_table(held, split, balances),
        worst=named_cases(worst_over_cases(case, watch, answers), balances),
        sections=named_cases(section_extremes(watch, answers), balances),
        monitors=named_cases(monitor_extremes(watch, answers), balances),
        error=error,
        notices=watch.notices,
    )


def _in_B(handed, R_AB: Float64) -> dict[str, Float64]:
    """Loads (6,) of gears turned from A to the deck's axes."""
    return {n: np.r_[R_AB.T @ v[:3], R_AB.T @ v[3:]] for n, v in handed.items()}


def _write_deck(
    path: Path,
    case: Case,
    aircraft: Aircraft,
    structure: Structure,
    answers: Answers,
    balances: list[RigidBalance],
) -> None:
    operator = structure.operator(answers.held.node_id, frame="basic")
    loads = np.asarray(operator.T @ (answers.held.pattern @ answers.split))
    if answers.steady_load is not None:
        loads = loads + answers.steady_load @ answers.lift[None]
    full = np.zeros((structure.points.size, loads.shape[1]))
    full[structure.elimination.f] = loads
    names = labels([b.case.name for b in balances], LABEL_WIDTH)
    subcases = [
        StaticCase(
            subtitle=f"case {k + 1}: {b.case.paragraph}",
            label=name,
            load=full[:, k],
        )
        for k, (b, name) in enumerate(zip(balances, names, strict=True))
    ]
    write_static_deck(
        path,
        structure,
        aircraft.deck,
        aircraft.units,
        subcases,
        title=f"{case.name}: ground-load conditions of {case.conditions.rules}",
        relief=True,
        head=[
            f"Ground loads of {case.conditions.rules} on '{case.name}': loads of the "
            "gears on the airframe, balanced by its inertia (PARAM,INREL,-2)",
        ],
    )


def write_tables(result: ConditionsResult, out: Path) -> None:
    """CSV tables."""
    tables = {
        "conditions": result.cases,
        "gear_places": result.places,
        "gear_loads": result.gear_loads,
        "attachment_loads": result.attachment_loads,
        "worst_stresses": result.worst,
        "section_loads": result.sections,
        "monitor_points": result.monitors,
    }
    for name, table in tables.items():
        if name != "monitor_points" or len(table):
            units = quantity_units(table)
            own = table.assign(unit=units) if len(units) else table
            write_csv(out / f"{name}.csv", with_headings(own))


def summary(result: ConditionsResult, case: Case, out: Path) -> str:
    """Lines for the terminal."""
    aircraft = result.ground.aircraft
    lines = [
        f"{case.name}: {case.conditions.rules}, {len(result.balances)} static cases at "
        f"{aircraft.mass:,.0f} kg ({aircraft.design.replace('_', '-')} weight)",
        "",
    ]
    lines += [
        f"  {number:<16}{count} case{'s' * (count != 1)}"
        for number, count in result.applied.items()
    ]
    lines += [f"  {number:<16}none: {why}" for number, why in result.left_out.items()]
    lines += [
        "",
        *(f"  {line}" for line in standing(result.places)),
        "",
        f"  equilibrium of loads and inertia: {result.error:.0e} of the largest load",
        *(f"note: {text}" for text in result.notices),
        "",
        f"tables: {out / 'conditions.csv'}, {README}; deck: {out / DECK}",
    ]
    return "\n".join(lines)
