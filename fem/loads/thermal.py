"""Temperatures and initial deformations of elements as static loads.

An element that nothing hinders moves by u_0 and has no stress. Its load on the grids
is K_e u_0, its forces and stresses are those of u - u_0: exact for uniform temperature,
for bars also for gradients that are linear along them. An element takes the mean
temperature of its grids. The strain is alpha (T - TREF), as in Nastran's linear statics
(from memory; there TEMPERATURE(INITIAL) chooses constants of materials only).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.references import where
from fem.elements.dense import DenseBlock
from fem.elements.lines.line_block import LineBlock
from fem.elements.lines.rod import Rod, stretched
from fem.errors import InputError
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.case_control import Subcase
    from fem.deck.deck import Deck
    from fem.elements.block import ElementBlock

TEMPERATURES = ("TEMP", "TEMPD", "TEMPRB")


@dataclass(frozen=True)
class FreeMotions:
    """Displacements of elements that nothing hinders, in the axes of their blocks.

    Attributes:
        blocks: elements that expand.
        motions: (e, n) for each block.
    """

    blocks: tuple["ElementBlock", ...]
    motions: tuple[Float64, ...]

    def of(self, block: "ElementBlock") -> Float64 | None:
        """(e, n) of a block, None where it does not expand."""
        found = (u for own, u in zip(self.blocks, self.motions) if own is block)
        return next(found, None)

    def load(self, points: Points) -> Float64:
        """(g,) the forces K_e u_0, displacement frames."""
        total = np.zeros(points.size)
        for block, motion in zip(self.blocks, self.motions):
            stiffness = block.stiffness()
            if stiffness is not None:
                force = np.einsum("eij,ej->ei", stiffness, motion)
                np.add.at(total, block.dof, force)
        return points.basic_rotation().T @ total


def summed(parts: Sequence[tuple[float, FreeMotions | None]]) -> FreeMotions | None:
    """A sum with factors; None: nothing expands."""
    total: dict[int, tuple[ElementBlock, Float64]] = {}
    for factor, part in parts:
        for block, motion in zip(part.blocks, part.motions) if part else ():
            before = total.get(id(block), (block, np.zeros(1)))[1]
            total[id(block)] = block, before + factor * motion
    if not total:
        return None
    blocks, motions = zip(*total.values())
    return FreeMotions(blocks, motions)


def free_motions(
    deck: "Deck", points: Points, blocks: Sequence["ElementBlock"], subcase: "Subcase"
) -> FreeMotions | None:
    """What the temperatures and the deformations of a subcase do to its elements.

    Raises:
        InputError: a set that is not there, grids without temperature, laminates whose
            plies expand differently, deformed elements that are no rods or bars; all.
    """
    moved: dict[int, Float64] = {}
    problems: list[str] = []
    if subcase.temperature:
        given = _Temperatures(deck, points, subcase.temperature)
        for k, block in enumerate(blocks):
            motion = _expanded(deck, given, block, problems)
            if motion is not None:
                moved[k] = motion
    if subcase.deform:
        for k, motion in _deformed(deck, blocks, subcase.deform, problems):
            moved[k] = moved.get(k, 0.0) + motion
    if problems:
        raise InputError(problems)
    if not moved:
        return None
    return FreeMotions(tuple(blocks[k] for k in moved), tuple(moved.values()))


class _Temperatures:
    """Temperatures of a set at the grids, and those of line elements.

    Raises:
        InputError: the set is not there.
    """

    def __init__(self, deck: "Deck", points: Points, sid: int) -> None:
        own = {name: _of(deck, name, sid) for name in TEMPERATURES}
        if all(rows.empty for rows in own.values()):
            raise InputError(
                f"{deck.path}: TEMPERATURE(LOAD) = {sid}: no {', '.join(TEMPERATURES)} "
                "of this set in the deck"
            )
        everywhere = own["TEMPD"]["t"].to_numpy(float)
        self.at = np.full(points.size, everywhere[0] if len(everywhere) else np.nan)
        ids = own["TEMP"]["g"].to_numpy(np.int64)
        on_grid = np.isin(ids, points.grid_id)
        values = own["TEMP"]["t"].to_numpy(float)[on_grid]
        first = 6 * points.rows(ids[on_grid])
        self.at[first[:, None] + np.arange(6)] = values[:, None]
        self.lines = own["TEMPRB"]

    def of(self, block: "ElementBlock") -> Float64:
        """(e,) mean of the grids."""
        return self.at[block.dof].mean(axis=1)

    def of_lines(self, block: "ElementBlock") -> tuple[Int64, Float64, Float64]:
        """Positions in a block, mean temperatures, and gradients (k, 2, 2)."""
        rows = self.lines[self.lines["eid"].isin(block.id)]
        at = np.searchsorted(block.id, rows["eid"].to_numpy(np.int64))
        gradient = rows[["tp1a", "tp1b", "tp2a", "tp2b"]].to_numpy(float)
        mean = rows[["ta", "tb"]].to_numpy(float).mean(axis=1)
        return at, mean, gradient.reshape(-1, 2, 2)


def _of(deck: "Deck", card: str, sid: int) -> pd.DataFrame:
    rows = deck.cards[card]
    return rows.loc[rows["sid"] == sid, :]


def _expanded(
    deck: "Deck", given: _Temperatures, block: "ElementBlock", problems: list[str]
) -> Float64 | None:
    """(e, n) motions of a block under the temperatures."""
    per_degree = block.expansion() if isinstance(block, DenseBlock) else None
    if per_degree is None or not np.any(per_degree):
        return None
    own = np.flatnonzero(np.isnan(per_degree).any(axis=1))
    problems += [
        f"{deck.path}: {block.card} {block.id[k]}: its plies or layers expand "
        "differently under temperatures, which is not supported here"
        for k in own[:20]
    ]
    temperature, bent = given.of(block), np.zeros_like(per_degree)
    at, mean, gradient = given.of_lines(block)
    if len(at):
        temperature[at] = mean
        if isinstance(block, LineBlock):
            whole = np.zeros((len(block.id), 2, 2))
            whole[at] = gradient
            bent = block.bent(whole)
    moves = np.any(per_degree, axis=1)
    unknown = np.flatnonzero(np.isnan(temperature) & moves)
    problems += [
        f"{deck.path}: {block.card} {block.id[k]}: a grid of it has no temperature, "
        "expected TEMP for it or TEMPD for all"
        for k in unknown[:20]
    ]
    change = np.where(moves, temperature - getattr(block, "tref", 0.0), 0.0)
    return change[:, None] * per_degree + bent


def _deformed(
    deck: "Deck", blocks: Sequence["ElementBlock"], sid: int, problems: list[str]
) -> list[tuple[int, Float64]]:
    """Blocks and the motions (e, 12) of elements that DEFORM makes longer."""
    rows = _of(deck, "DEFORM", sid)
    if rows.empty:
        problems.append(f"{deck.path}: DEFORM = {sid}: no DEFORM of this set")
    found, known = [], set()
    for k, block in enumerate(blocks):
        if not isinstance(block, Rod | LineBlock):
            continue
        own = rows[rows["eid"].isin(block.id)]
        known.update(own["eid"].tolist())
        if not own.empty:
            longer = np.zeros(len(block.id))
            at = np.searchsorted(block.id, own["eid"].to_numpy(np.int64))
            np.add.at(longer, at, own["d"].to_numpy(float))
            found.append((k, stretched(block.axis, longer)))
    problems += [
        f"{where('DEFORM', row)}: element {row['eid']} is no rod, bar or beam"
        for _, row in rows.iterrows()
        if row["eid"] not in known
    ]
    return found
