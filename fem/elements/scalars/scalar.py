"""CELAS, CDAMP and CMASS: springs, dashpots and masses between two freedoms.

They act on freedoms of the displacement frames; an absent grid is ground. The matrix
of each is c [[1, -1], [-1, 1]].
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.records.scalars import DAMPER, SPRING
from fem.deck.references import column, refer, table
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock, some
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_PAIR = np.array([[1.0, -1.0], [-1.0, 1.0]])


@dataclass(frozen=True, kw_only=True)
class Springs(DenseBlock):
    """All CELAS elements of one card.

    Attributes:
        k: (e,) force per displacement.
        ge: (e,) structural damping.
        s: (e,) stress per force.
    """

    k: Float64
    ge: Float64
    s: Float64

    def stiffness(self) -> Float64:
        """(e, 2, 2)."""
        return self.k[:, None, None] * _PAIR

    def structural_damping(self) -> Float64 | None:
        """(e,) GE."""
        return some(self.ge)

    def forces(self) -> Recovery:
        """K times the elongation."""
        return self._recovery(SPRING[0], self.k)

    def stresses(self) -> Recovery:
        """S times the force."""
        return self._recovery(SPRING[1], self.k * self.s)

    def strains(self) -> Recovery:
        """Stress coefficient times elongation, as NX has it."""
        return self._recovery(SPRING[2], self.s)

    def _recovery(self, column: str, factor: Float64) -> Recovery:
        """Elongation times factors (e,); in harmonic motion with what GE adds."""
        matrix = factor[:, None, None] * _PAIR[:1]
        return Recovery(
            table=self.card,
            columns=(column,),
            matrix=matrix,
            loss=self.ge[:, None, None] * matrix if self.ge.any() else None,
            id=self.id,
        )


@dataclass(frozen=True, kw_only=True)
class Dashpots(DenseBlock):
    """All CDAMP elements of one card; b: (e,) force per velocity."""

    b: Float64

    def damping(self) -> Float64:
        """(e, 2, 2)."""
        return self.b[:, None, None] * _PAIR

    def forces(self) -> Recovery:
        """Force from velocities."""
        rate = self.b[:, None, None] * _PAIR[:1]
        return Recovery(
            table=self.card,
            columns=DAMPER,
            matrix=np.zeros_like(rate),
            rate=rate,
            id=self.id,
        )


@dataclass(frozen=True, kw_only=True)
class ScalarMasses(DenseBlock):
    """All CMASS elements of one card; m: (e,) mass."""

    m: Float64

    def mass(self, *, coupled: bool) -> Float64:
        """(e, 2, 2)."""
        return self.m[:, None, None] * _PAIR


def read_celas1(deck: "Deck", points: Points) -> list[Springs]:
    """CELAS1 and CELAS3.

    Raises:
        InputError: undefined properties or freedoms.
    """
    rows = _rows(deck, "CELAS1")
    if rows.empty:
        return []
    values = refer(rows, "CELAS1", "pid", table(deck, "PELAS"), "PELAS")
    return [_springs(*part, points) for part in _by_card(rows, values)]


def read_celas2(deck: "Deck", points: Points) -> list[Springs]:
    """CELAS2 and CELAS4.

    Raises:
        InputError: undefined freedoms.
    """
    rows = _rows(deck, "CELAS2")
    return [_springs(*part, points) for part in _by_card(rows, rows)]


def read_cdamp(deck: "Deck", points: Points) -> list[Dashpots]:
    """CDAMP1 to CDAMP4.

    Raises:
        InputError: undefined properties or freedoms.
    """
    return [
        Dashpots(card=card, b=column(values, "b"), **_frame(rows, points))
        for card, rows, values in _pairs(deck, "CDAMP", "PDAMP")
    ]


def read_cmass(deck: "Deck", points: Points) -> list[ScalarMasses]:
    """CMASS1 to CMASS4.

    Raises:
        InputError: undefined properties or freedoms.
    """
    return [
        ScalarMasses(card=card, m=column(values, "m"), **_frame(rows, points))
        for card, rows, values in _pairs(deck, "CMASS", "PMASS")
    ]


def _pairs(deck: "Deck", stem: str, property_card: str):
    """(card, its rows, rows with the values) for both spellings of an element."""
    rows = _rows(deck, f"{stem}1")
    if not rows.empty:
        values = refer(
            rows, f"{stem}1", "pid", table(deck, property_card), property_card
        )
        yield from _by_card(rows, values)
    rows = _rows(deck, f"{stem}2")
    yield from _by_card(rows, rows)


def _by_card(rows: pd.DataFrame, values: pd.DataFrame):
    """(card, its rows, rows with the values) for each spelling, CELAS1 and CELAS3."""
    for card in sorted(rows["card"].unique()):
        own = (rows["card"] == card).to_numpy()
        yield (
            card,
            rows[own].reset_index(drop=True),
            values[own].reset_index(drop=True),
        )


def _springs(
    card: str, rows: pd.DataFrame, values: pd.DataFrame, points: Points
) -> Springs:
    return Springs(
        card=card,
        k=column(values, "k"),
        ge=column(values, "ge"),
        s=column(values, "s"),
        **_frame(rows, points),
    )


def _rows(deck: "Deck", card: str) -> pd.DataFrame:
    return table(deck, card).sort_values("eid", ignore_index=True)


def _frame(rows: pd.DataFrame, points: Points) -> dict:
    """Ids and freedoms of scalar elements."""
    dof = points.dof(
        rows[["g1", "g2"]].to_numpy(np.int64), rows[["c1", "c2"]].to_numpy(np.int64)
    )
    return {
        "id": rows["eid"].to_numpy(np.int64),
        "dof": dof,
        "frame": "displacement",
    }
