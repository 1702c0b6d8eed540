"""Non-structural mass by NSM, NSM1, NSML, NSML1 and NSMADD (case control NSM).

NSM and NSM1 give mass per length or area, NSML and NSML1 a total that is spread evenly
over the lengths or areas of their elements. It is added to what the properties have.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol, Self, TypeVar, cast, runtime_checkable

import numpy as np
import pandas as pd

from fem.arrays import Bool, Float64, Int64
from fem.deck.references import table, where
from fem.errors import InputError, Problems

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@runtime_checkable
class TakesNonstructuralMass(Protocol):
    """An element block whose elements have a length or an area.

    Attributes:
        id: (e,) element ids.
        pid: (e,) property ids.
        property_card: "PBAR", "PSHELL", ...
        extent: (e,) lengths or areas.
    """

    @property
    def id(self) -> Int64: ...
    @property
    def pid(self) -> Int64: ...
    @property
    def property_card(self) -> str: ...
    @property
    def extent(self) -> Float64: ...

    def with_nonstructural_mass(
        self, per_extent: Float64
    ) -> "TakesNonstructuralMass": ...


class MassInSection:
    """A block whose section has the nonstructural mass per length, `nsm` (e,)."""

    section: Any

    def with_nonstructural_mass(self, per_extent: Float64) -> Self:
        """Copy with additional mass per length (e,)."""
        section = replace(self.section, nsm=self.section.nsm + per_extent)
        return cast(Self, replace(cast(Any, self), section=section))


# Spellings of one property.
_SAME = {"PBARL": "PBAR", "PBEAML": "PBEAM", "PCOMPG": "PCOMP"}

Block = TypeVar("Block")


def add_nonstructural_mass(
    deck: "Deck", blocks: Sequence[Block], sid: int
) -> list[Block]:
    """The blocks with the mass of NSM set `sid` (0: unchanged).

    Raises:
        InputError: unknown set, or a lumped mass without elements.
    """
    if sid == 0:
        return list(blocks)
    sets = _members(deck, sid)
    takers = [b for b in blocks if isinstance(b, TakesNonstructuralMass)]
    added = [np.zeros(len(b.id)) for b in takers]
    problems = Problems()
    for card in ("NSM", "NSML"):
        rows = table(deck, card)
        for _, row in rows[rows["sid"].isin(sets)].iterrows():
            problems += _spread(row, card, takers, added)
    problems.report()
    heavier = {
        id(b): b.with_nonstructural_mass(a) for b, a in zip(takers, added) if a.any()
    }
    return [heavier.get(id(b), b) for b in blocks]


def _spread(
    row: pd.Series,
    card: str,
    takers: Sequence[TakesNonstructuralMass],
    added: Sequence[Float64],
) -> list[str]:
    """Adds one card's mass to `added`; returns what is wrong with it."""
    values = row["values"] if card == "NSM" else [row["value"]]
    if card == "NSM":
        for one, value in zip(row["ids"], values):
            chosen = [_chosen(b, row["type"], [one]) for b in takers]
            for part, at in zip(added, chosen):
                part[at] += value
        return []
    chosen = [_chosen(b, row["type"], row["ids"]) for b in takers]
    total = sum(float(b.extent[at].sum()) for b, at in zip(takers, chosen))
    if total == 0.0:
        return [f"{where(card, row)}: no element of {row['type']} {list(row['ids'])}"]
    for part, at in zip(added, chosen):
        part[at] += values[0] / total
    return []


def _chosen(block: TakesNonstructuralMass, kind: str, ids: Sequence[int]) -> Bool:
    """(e,) which elements a card means; id -1 (the word ALL) stands for every one."""
    if kind == "ELEMENT":
        numbers = block.id
    elif _SAME.get(kind, kind) == block.property_card:
        numbers = block.pid
    else:
        return np.zeros(len(block.id), bool)
    if -1 in ids:
        return np.ones(len(numbers), bool)
    return np.isin(numbers, ids)


def _members(deck: "Deck", sid: int) -> list[int]:
    unions = table(deck, "NSMADD")
    chosen = unions[unions["sid"] == sid]
    sets = [int(s) for members in chosen["sets"] for s in members] or [sid]
    known = {int(s) for card in ("NSM", "NSML") for s in table(deck, card)["sid"]}
    absent = [s for s in sets if s not in known]
    if absent:
        raise InputError(
            f"NSM set {s} is not in the deck; it has {sorted(known) or 'none'}"
            for s in absent
        )
    return sets
