"""`drake-landing conditions`: the rules' static load cases on the full model of a case.

Landings give the largest vertical loads; every paragraph makes its cases; each is
balanced by inertia, and the airframe answers: attachment loads, stresses, section
loads, and one SOL 101 deck.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pandas as pd

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.body import load_airframe
from drake_landing.cache import Cache
from drake_landing.case.axes import rotation_AB
from drake_landing.case.conditions import Conditions
from drake_landing.case.schema import Case
from drake_landing.conditions.balance import Holds, RigidBalance, holds, rigid_balance
from drake_landing.conditions.build import OnGround, on_ground
from drake_landing.conditions.cs23 import CS23
from drake_landing.conditions.cs25 import CS25
from drake_landing.conditions.ground import STATES, BookCase
from drake_landing.conditions.paragraph import (
    LARGEST_UNKNOWN,
    TAIL_DOWN_UNKNOWN,
    Paragraph,
)
from drake_landing.conditions.peaks import landing_peaks, sink_rate
from drake_landing.conditions.pictures import load_pictures
from drake_landing.files import write_csv
from drake_landing.parts.cuts import envelope_table
from drake_landing.parts.monitors import monitor_envelopes
from drake_landing.parts.observers import PartsWatch
from drake_landing.parts.slices import balanced
from drake_landing.parts.tables import worst_elements
from drake_landing.process.aircraft import checked_aircraft
from drake_landing.process.full_response import parts_watch
from drake_landing.progress import Reporter, Silent
from drake_landing.results.stages import Stages
from drake_landing.transient.static_deck import StaticCase, write_static_deck
from fem.arrays import Float64
from fem.errors import InputError
from fem.model.structure import Structure

RULES: dict[str, tuple[Paragraph, ...]] = {"CS-25": CS25, "CS-23": CS23}
_OF_LANDING = (LARGEST_UNKNOWN, TAIL_DOWN_UNKNOWN)
_AT_ONCE = 16  # cases whose stresses are in memory together
DECK = "conditions_sol101.bdf"


@dataclass(frozen=True, kw_only=True)
class ConditionsResult:
    """What was found.

    Attributes:
        ground: the aircraft.
        applied: paragraph -> its number of cases.
        left_out: paragraph -> why it has none.
        balances: of all cases.
        cases, gear_loads, attachment_loads, worst, sections: tables, SI.
        monitors: extremes at the deck's monitor points; empty: it has none.
        error: of the equilibrium, largest of all cases, over the largest load.
        notices: what the user should know.
    """

    ground: OnGround
    applied: dict[str, int]
    left_out: dict[str, str]
    balances: tuple[RigidBalance, ...] = field(repr=False)
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


def condition_figures(
    conditions: Conditions, ground: OnGround
) -> list[tuple[str, str]]:
    """Each paragraph with static cases: its largest loads, or why it has none.

    Args:
        conditions: of the case.
        ground: the aircraft; where the largest vertical loads are not known, that is
            said instead of their figures.
    """
    rows = []
    for paragraph in RULES[conditions.rules]:
        if paragraph.cases is None:
            continue
        missing = paragraph.missing(ground.aircraft)
        if missing in _OF_LANDING:
            rows.append(
                (paragraph.number, "loads of the landing: conditions finds them")
            )
        elif missing:
            rows.append((paragraph.number, f"none: {missing}"))
        else:
            cases = list(paragraph.cases(ground.aircraft))
            rows.append((paragraph.number, _largest_loads(cases)))
    return rows


def _largest_loads(cases: Sequence[BookCase]) -> str:
    """Number of cases, and the largest sums on a gear."""
    sums = []
    for case in cases:
        of_gear: dict[str, Float64] = {}
        for one in case.loads:
            before = of_gear.get(one.gear, np.zeros(3))
            of_gear[one.gear] = before + one.force
        sums += [(gear, *force) for gear, force in of_gear.items()]
    texts = []
    for column, word in enumerate(("drag", "side", "vertical"), 1):
        gear, *force = max(sums, key=lambda row: abs(row[column]))
        if abs(force[column - 1]) > 1.0:
            texts.append(f"{word} {force[column - 1] / 1e3:.1f} kN ({gear})")
    many = f"{len(cases)} case{'s' * (len(cases) > 1)}"
    return f"{many}: largest {', '.join(texts)}"


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
    answers = _Answers(aircraft, structure, held, split, balances)
    watch = parts_watch(case, aircraft, structure, held.node_id, None)
    error = max(*(b.error for b in balances), answers.error(structure))
    _write_deck(out / DECK, case, aircraft, structure, answers, balances)
    return ConditionsResult(
        ground=ground,
        applied=applied,
        left_out=left_out,
        balances=tuple(balances),
        cases=_case_table(balances).assign(text=texts),
        gear_loads=_gear_table(balances),
        attachment_loads=_attachment_table(held, split),
        worst=_worst(case, watch, answers),
        sections=_sections(watch, answers),
        monitors=_monitors(watch, answers),
        error=error,
        notices=watch.notices,
    )


def _in_B(handed, R_AB: Float64) -> dict[str, Float64]:
    """Loads (6,) of gears turned from A to the deck's axes."""
    return {n: np.r_[R_AB.T @ v[:3], R_AB.T @ v[3:]] for n, v in handed.items()}


class _Answers:
    """Displacements and accelerations of the cases, superposed from unit loads."""

    def __init__(
        self,
        aircraft: Aircraft,
        structure: Structure,
        held: Holds,
        split: Float64,
        balances: list[RigidBalance],
    ) -> None:
        self.held, self.split = held, split
        self.lift = np.array([b.case.lift for b in balances])
        self.steady_load = self.steady = None
        if aircraft.steady_load is not None and self.lift.any():
            self.steady_load = aircraft.steady_load(structure)
            self.steady = balanced(structure, self.steady_load)

    @property
    def count(self) -> int:
        """Of the cases."""
        return self.split.shape[1]

    def displacement(self, which: slice) -> Float64:
        """(f, c)"""
        found = self.held.displacement @ self.split[:, which]
        if self.steady is not None:
            found = found + self.steady.displacement @ self.lift[None, which]
        return found

    def motion(self) -> Float64:
        """(f, c) accelerations by what the gears hand over."""
        return self.held.motion @ self.split

    @property
    def node_loads(self) -> Float64:
        """(c, k, 6) of the gears on the nodes, B."""
        return (self.held.pattern @ self.split).T.reshape(self.count, -1, 6)

    def error(self, structure: Structure) -> float:
        """What forces and moments of loads and inertia leave, over the largest."""
        rigid = structure.rigid_body
        operator = structure.operator(self.held.node_id, frame="basic")
        given = rigid.T @ (operator.T @ (self.held.pattern @ self.split))
        inertia = rigid.T @ (structure.mass @ self.motion())
        size = np.repeat([np.abs(given[:3]).max(), np.abs(given[3:]).max()], 3)
        return float(np.abs((given - inertia) / np.maximum(size, 1e-30)[:, None]).max())


def _case_table(balances: list[RigidBalance]) -> pd.DataFrame:
    rows = []
    for number, b in enumerate(balances, 1):
        aft, side, up = np.where(np.abs(b.factors) < 1e-9, 0.0, b.factors)
        rows.append(
            {
                "case": number,
                "paragraph": b.case.paragraph,
                "name": b.case.name,
                "pose": b.case.pose,
                "state": STATES[b.case.pose],
                "lift": b.case.lift,
                "n_aft": aft,
                "n_starboard": side,
                "n_up": up,
                "roll_acceleration": b.acceleration[3],
                "pitch_acceleration": b.acceleration[4],
                "yaw_acceleration": b.acceleration[5],
                "imbalance": b.error,
                "note": b.case.note,
            }
        )
    return pd.DataFrame(rows)


def _gear_table(balances: list[RigidBalance]) -> pd.DataFrame:
    rows = [
        [number, one.gear, one.at, *one.force, *one.moment]
        for number, b in enumerate(balances, 1)
        for one in b.case.loads
    ]
    columns = ["case", "gear", "at", "drag", "side", "vertical"]
    columns += ["moment_aft", "moment_starboard", "moment_up"]
    return pd.DataFrame(rows, columns=columns)


def _attachment_table(held: Holds, split: Float64) -> pd.DataFrame:
    rows = []
    for number, loads in enumerate(
        (held.pattern @ split).T.reshape(-1, len(held.node_id), 6), 1
    ):
        rows += [[number, int(n), *load] for n, load in zip(held.node_id, loads)]
    columns = ["case", "node", "fx", "fy", "fz", "mx", "my", "mz"]
    return pd.DataFrame(rows, columns=columns)


def _worst(case: Case, watch: PartsWatch, answers: _Answers) -> pd.DataFrame:
    """Per component the worst elements over all cases; `case` tells which."""
    best = None
    for start in range(0, answers.count, _AT_ONCE):
        which = slice(start, min(start + _AT_ONCE, answers.count))
        stress = watch.stresses.of(answers.displacement(which))  # (c, e, 3)
        row = stress[..., 0].argmax(axis=0)
        own = np.take_along_axis(stress, row[None, :, None], axis=0)[0]
        number = start + row + 1.0
        if best is None:
            best = own, number
            continue
        larger = own[:, 0] > best[0][:, 0]
        best = (
            np.where(larger[:, None], own, best[0]),
            np.where(larger, number, best[1]),
        )
    assert best is not None
    (value, number) = best
    table = watch.stress_table(value[:, 0], number, value[:, 1], value[:, 2])
    worst = worst_elements(table, case.parts.ultimate_factor)
    worst = worst.rename(columns={"time": "case"})
    return worst.assign(case=worst.case.astype(int))


def _sections(watch: PartsWatch, answers: _Answers) -> pd.DataFrame:
    """Extremes of section loads over all cases; `case` in place of a time."""
    motion, numbers = answers.motion(), np.arange(1, answers.count + 1)
    tables = []
    for cuts in watch.cuts.values():
        inertia = np.asarray(cuts.of_acceleration @ motion).T
        loads = cuts.loads(inertia, answers.held.node_id, answers.node_loads)
        tables.append(envelope_table(cuts, numbers, loads))
    if not tables:
        return pd.DataFrame()
    table = pd.concat(tables, ignore_index=True)
    return table.rename(
        columns={"time_of_min": "case_of_min", "time_of_max": "case_of_max"}
    )


def _monitors(watch: PartsWatch, answers: _Answers) -> pd.DataFrame:
    """Extremes at the deck's monitor points over all cases, without steady flight."""
    motion, numbers = answers.motion(), np.arange(1, answers.count + 1)
    strained = answers.held.displacement @ answers.split
    values = {
        s.name: s.values(s.moved(strained, motion), answers.node_loads)
        for s in watch.stations
    }
    table = monitor_envelopes(watch.stations, numbers, values)
    return table.rename(
        columns={"time_of_min": "case_of_min", "time_of_max": "case_of_max"}
    )


def _write_deck(
    path: Path,
    case: Case,
    aircraft: Aircraft,
    structure: Structure,
    answers: _Answers,
    balances: list[RigidBalance],
) -> None:
    operator = structure.operator(answers.held.node_id, frame="basic")
    loads = np.asarray(operator.T @ (answers.held.pattern @ answers.split))
    if answers.steady_load is not None:
        loads = loads + answers.steady_load @ answers.lift[None]
    full = np.zeros((structure.points.size, loads.shape[1]))
    full[structure.elimination.f] = loads
    subcases = [
        StaticCase(
            subtitle=f"case {k + 1}: {b.case.paragraph}",
            label=b.case.name,
            load=full[:, k],
        )
        for k, b in enumerate(balances)
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
    write_csv(out / "conditions.csv", result.cases)
    write_csv(out / "gear_loads.csv", result.gear_loads)
    write_csv(out / "attachment_loads.csv", result.attachment_loads)
    write_csv(out / "worst_stresses.csv", result.worst)
    write_csv(out / "section_loads.csv", result.sections)
    if len(result.monitors):
        write_csv(out / "monitor_points.csv", result.monitors)


def summary(result: ConditionsResult, case: Case, out: Path) -> str:
    """For the terminal."""
    aircraft = result.ground.aircraft
    lines = [
        f"{case.name}: {case.conditions.rules}, {len(result.balances)} static cases at "
        f"{aircraft.mass:,.0f} kg ({aircraft.design.replace('_', '-')} weight)",
        "",
    ]
    lines += [
        f"  {number:<16}{count} cases" for number, count in result.applied.items()
    ]
    lines += [f"  {number:<16}none: {why}" for number, why in result.left_out.items()]
    lines += [
        "",
        f"  equilibrium of loads and inertia: {result.error:.0e} of the largest load",
        *(f"note: {text}" for text in result.notices),
        "",
        f"tables: {out / 'conditions.csv'}; deck: {out / DECK}",
    ]
    return "\n".join(lines)
