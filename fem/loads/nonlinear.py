"""NOLIN1 to NOLIN4: loads of transients that depend on the motion.

    NOLIN1  P = S T(x)          NOLIN3  P = S x^A for x > 0, else 0
    NOLIN2  P = S x y           NOLIN4  P = -S (-x)^A for x < 0, else 0

x and y are displacements, or velocities where the component is 10 and more: then
(u(n) - u(n-1)) / h. The load of the state at n acts in the step to n + 1, without the
mean over three steps that other loads have.

References: NASTRAN User's Manual (1986), cards NOLIN1 to NOLIN4; Theoretical Manual,
section 11.2.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.control.subcase import Subcase
from fem.deck.references import where
from fem.errors import InputError, Problems
from fem.geometry.points import Points
from fem.loads.time_tables import table_function

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_CARDS = ("NOLIN1", "NOLIN2", "NOLIN3", "NOLIN4")
_VELOCITY = 10  # components from here on


@dataclass(frozen=True)
class _Input:
    """A freedom that a load depends on: its position, and whether as a velocity."""

    at: int
    rate: bool

    def of(self, u: Float64, before: Float64, h: float) -> Float64:
        """(1,) its value from states (n,)."""
        now = u[[self.at]]
        return (now - before[[self.at]]) / h if self.rate else now


@dataclass(frozen=True, kw_only=True)
class _Term:
    """The load of one card."""

    case: int
    at: int
    scale: float
    inputs: Sequence[_Input]
    function: Callable[..., Float64]


@dataclass(frozen=True)
class NonlinearLoad:
    """NOLIN loads of load cases that are solved together; see `StateLoad`."""

    terms: Sequence[_Term]

    def __call__(self, u: Float64, before: Float64, h: float) -> Float64:
        """(c, n) loads from u(n) and u(n-1) (c, n), one step of h (s) apart."""
        load = np.zeros_like(u)
        for term in self.terms:
            case = term.case
            given = (x.of(u[case], before[case], h) for x in term.inputs)
            load[case, term.at] += term.scale * float(term.function(*given)[0])
        return load


def nonlinear_load(
    deck: "Deck", points: Points, subcases: Sequence[Subcase], rows: Int64
) -> NonlinearLoad | None:
    """Loads that NONLINEAR of subcases selects, one load case each; None: none.

    Args:
        deck, points: the model.
        subcases: solved together.
        rows: (k,) rows of the g-set that the first k freedoms of the solution are.

    Raises:
        InputError: no such set, freedoms that are not in the solution.
    """
    terms: list[_Term] = []
    problems = Problems()
    place = np.full(points.size, -1)
    place[rows] = np.arange(len(rows))
    for case, subcase in enumerate(subcases):
        if not subcase.nonlinear:
            continue
        before = len(terms) + len(problems)
        for name in _CARDS:
            cards = deck.cards[name]
            for _, row in cards[cards["sid"] == subcase.nonlinear].iterrows():
                with problems.gathered():
                    terms.append(_term(deck, points, name, row, place, case))
        if len(terms) + len(problems) == before:
            problems.append(
                f"{deck.path}: subcase {subcase.id}: NONLINEAR = {subcase.nonlinear}: "
                f"no {', '.join(_CARDS)} of that number"
            )
    problems.report()
    return NonlinearLoad(terms) if terms else None


def _term(
    deck: "Deck",
    points: Points,
    name: str,
    row: pd.Series,
    place: Int64,
    case: int,
) -> _Term:
    def freedom(point: str, component: str) -> tuple[int, bool]:
        c = int(row[component])
        dof = int(points.dof(row[point], c % _VELOCITY if c >= _VELOCITY else c))
        if place[dof] < 0:
            raise InputError(
                f"{where(name, row)}: {points.label(dof)} is not in the solution set; "
                "expected a free one that no reduction omits, or an extra point (TF "
                "gives one the motion of others); of modes, extra points only"
            )
        return int(place[dof]), c >= _VELOCITY

    def given(point: str, component: str) -> _Input:
        return _Input(*freedom(point, component))

    at, rate = freedom("gi", "ci")
    if rate:
        raise InputError(
            f"{where(name, row)}: CI {row['ci']}: a load has no rate, expected 0 to 6"
        )
    inputs, scale = [given("gj", "cj")], float(row["s"])
    if name == "NOLIN1":
        function = table_function(deck, int(row["tid"]))
    elif name == "NOLIN2":
        inputs.append(given("gk", "ck"))
        function = np.multiply
    else:
        sign = 1.0 if name == "NOLIN3" else -1.0
        function = _power(sign, float(row["a"]))
        scale *= sign
    return _Term(case=case, at=at, scale=scale, inputs=inputs, function=function)


def _power(sign: float, exponent: float) -> Callable[[Float64], Float64]:
    """x^A where sign times x is positive, else 0."""

    def function(x: Float64) -> Float64:
        positive = sign * x > 0.0
        return np.where(positive, np.where(positive, sign * x, 1.0) ** exponent, 0.0)

    return function
