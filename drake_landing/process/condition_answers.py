"""How the airframe answers static cases, superposed from unit loads at its gears."""

import numpy as np
import pandas as pd

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.case.schema import Case
from drake_landing.conditions.balance import Holds, RigidBalance
from drake_landing.parts.cuts import envelope_table
from drake_landing.parts.monitors import monitor_envelopes
from drake_landing.parts.observers import PartsWatch
from drake_landing.parts.slices import balanced
from drake_landing.parts.tables import worst_elements
from fem.arrays import Float64
from fem.model.structure import Structure

_AT_ONCE = 16  # cases whose stresses are in memory together


class Answers:
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
        """Number of the cases."""
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
        """Rest of forces and moments of loads and inertia, over the largest."""
        rigid = structure.rigid_body
        operator = structure.operator(self.held.node_id, frame="basic")
        given = rigid.T @ (operator.T @ (self.held.pattern @ self.split))
        inertia = rigid.T @ (structure.mass @ self.motion())
        size = np.repeat([np.abs(given[:3]).max(), np.abs(given[3:]).max()], 3)
        return float(np.abs((given - inertia) / np.maximum(size, 1e-30)[:, None]).max())


def worst_over_cases(case: Case, watch: PartsWatch, answers: Answers) -> pd.DataFrame:
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


def section_extremes(watch: PartsWatch, answers: Answers) -> pd.DataFrame:
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


def monitor_extremes(watch: PartsWatch, answers: Answers) -> pd.DataFrame:
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
