"""Temperatures and initial deformations of elements as static loads.

An element that nothing hinders moves by u_0 and has no stress. Its load on the grids
is K_e u_0, its forces and stresses are those of u - u_0: exact for uniform temperature,
for bars also for gradients that are linear along them. An element takes the mean
temperature of its grids (CQUAD4 its slope, too), or what TEMPRB and TEMPP1 say of it.
Laminates whose plies
expand differently bend, and keep stresses in their plies (`shell_expansion`); with a
gradient over the thickness (TEMPP1) shells bend, too. The strain is alpha (T - TREF),
as in Nastran's linear statics; where TREF is blank it counts from TEMPERATURE(INITIAL),
without that from 0 (from memory of the guide, which asks for a blank TREF then).
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
from fem.elements.shells.shell import Shell
from fem.errors import InputError, Problems
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.control.subcase import Subcase
    from fem.deck.deck import Deck
    from fem.elements.block import ElementBlock

TEMPERATURES = ("TEMP", "TEMPD", "TEMPRB", "TEMPP1")


@dataclass(frozen=True)
class FreeMotions:
    """Displacements of elements that nothing hinders, in the axes of their blocks.

    Attributes:
        blocks: elements that expand.
        motions: (e, n) for each block.
        heats: (e, 2) for each block: degrees beyond TREF or the initial temperature,
            and degrees per length over the thickness of shells.
    """

    blocks: tuple["ElementBlock", ...]
    motions: tuple[Float64, ...]
    heats: tuple[Float64, ...]

    def of(self, block: "ElementBlock") -> Float64 | None:
        """(e, n) of a block, None where it does not expand."""
        found = (u for own, u in zip(self.blocks, self.motions) if own is block)
        return next(found, None)

    def heat_of(self, block: "ElementBlock") -> Float64:
        """(e, 2) of a block that expands."""
        return next(h for own, h in zip(self.blocks, self.heats) if own is block)

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
    total: dict[int, tuple[ElementBlock, Float64, Float64]] = {}
    for factor, part in parts:
        if part is None:
            continue
        for block, motion, heat in zip(part.blocks, part.motions, part.heats):
            _, u, h = total.get(id(block), (block, np.zeros(1), np.zeros(1)))
            total[id(block)] = block, u + factor * motion, h + factor * heat
    if not total:
        return None
    return FreeMotions(*zip(*total.values()))


def free_motions(
    deck: "Deck", points: Points, blocks: Sequence["ElementBlock"], subcase: "Subcase"
) -> FreeMotions | None:
    """Free strains of elements under temperatures and deformations of a subcase.

    Raises:
        InputError: a set that is not there, grids without temperature, elements with
            mid-sides that bend, deformed elements that are no rods or bars; all.
    """
    moved: dict[int, tuple[Float64, Float64]] = {}
    problems = Problems()
    if subcase.temperature:
        given = _Temperatures(deck, points, "LOAD", subcase.temperature)
        before, first = None, subcase.initial_temperature
        if first:
            before = _Temperatures(deck, points, "INITIAL", first)
        for k, block in enumerate(blocks):
            expanded = _expanded(deck, given, before, block, problems)
            if expanded is not None:
                moved[k] = expanded
    if subcase.deform:
        for k, motion in _deformed(deck, blocks, subcase.deform, problems):
            heated = moved.get(k, (0.0, np.zeros((len(motion), 2))))
            moved[k] = heated[0] + motion, heated[1]
    problems.report()
    if not moved:
        return None
    motions, heats = zip(*moved.values())
    return FreeMotions(tuple(blocks[k] for k in moved), motions, heats)


class _Temperatures:
    """Temperatures of a set at the grids, and those of line elements.

    Raises:
        InputError: the set is not there.
    """

    def __init__(self, deck: "Deck", points: Points, kind: str, sid: int) -> None:
        own = {name: _of(deck, name, sid) for name in TEMPERATURES}
        if all(rows.empty for rows in own.values()):
            raise InputError(
                f"{deck.path}: TEMPERATURE({kind}) = {sid}: no "
                f"{', '.join(TEMPERATURES)} of this set in the deck"
            )
        everywhere = own["TEMPD"]["t"].to_numpy(float)
        self.at = np.full(points.size, everywhere[0] if len(everywhere) else np.nan)
        ids = own["TEMP"]["g"].to_numpy(np.int64)
        on_grid = np.isin(ids, points.grid_id)
        values = own["TEMP"]["t"].to_numpy(float)[on_grid]
        first = 6 * points.rows(ids[on_grid])
        self.at[first[:, None] + np.arange(6)] = values[:, None]
        self.lines, self._shells = own["TEMPRB"], own["TEMPP1"]

    def of(self, block: "ElementBlock") -> Float64:
        """(e,) mean of the grids."""
        return self.at[block.grid_dof].mean(axis=1)

    def of_grids(self, block: "ElementBlock") -> Float64:
        """(e, n) of the grids."""
        return self.at[block.dof[:, ::6]]

    def of_shells(self, block: "ElementBlock") -> tuple[Int64, Float64, Float64]:
        """Positions in a block, mean temperatures and gradients (k,) over z."""
        rows = self._shells[self._shells["eid"].isin(block.id)]
        at = np.searchsorted(block.id, rows["eid"].to_numpy(np.int64))
        return at, rows["tbar"].to_numpy(float), rows["tprime"].to_numpy(float)

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
    deck: "Deck",
    given: _Temperatures,
    before: _Temperatures | None,
    block: "ElementBlock",
    problems: list[str],
) -> tuple[Float64, Float64] | None:
    """(e, n) motions of a block under the temperatures, and (e, 2) these.

    Args:
        before: initial temperatures, which count where the material has no TREF.
    """
    per_degree = block.expansion() if isinstance(block, DenseBlock) else None
    if per_degree is None:
        return None
    reference = np.broadcast_to(getattr(block, "tref", 0.0), len(block.id))
    temperature, gradient, bent = _felt(given, block, per_degree)
    blank = np.isnan(reference)
    temperature = temperature - np.where(blank, 0.0, reference)
    if before is not None and blank.any():
        cold, slope, curved = _felt(before, block, per_degree)
        temperature = temperature - np.where(blank, cold, 0.0)
        gradient = gradient - np.where(blank, slope, 0.0)
        bent = bent - np.where(blank[:, None], curved, 0.0)
    moves = np.any(per_degree, axis=1)
    if not moves.any() and not np.any(bent):
        return None
    curled = np.flatnonzero(
        np.isnan(per_degree).any(axis=1) | np.isnan(bent).any(axis=1)
    )
    problems += [
        f"{deck.path}: {block.card} {block.id[k]}: temperatures bend it (its plies "
        "expand differently, or TEMPP1), which elements with mid-sides do not model "
        "here; expected CQUAD4 or CTRIA3"
        for k in curled[:20]
    ]
    unknown = np.flatnonzero(np.isnan(temperature) & moves)
    problems += [
        f"{deck.path}: {block.card} {block.id[k]}: a grid of it has no temperature, "
        "expected TEMP for it or TEMPD for all"
        for k in unknown[:20]
    ]
    change = np.where(moves, temperature, 0.0)
    heat = np.stack([change, gradient], axis=1)
    return change[:, None] * per_degree + bent, heat


def _felt(
    given: _Temperatures, block: "ElementBlock", per_degree: Float64
) -> tuple[Float64, Float64, Float64]:
    """(e,) temperatures, (e,) gradients over z, (e, n) motions of uneven heat."""
    temperature, bent = given.of(block), np.zeros_like(per_degree)
    gradient = np.zeros(len(temperature))
    if isinstance(block, LineBlock):
        at, mean, slopes = given.of_lines(block)
        temperature[at] = mean
        whole = np.zeros((len(block.id), 2, 2))
        whole[at] = slopes
        bent = block.bent(whole)
    elif isinstance(block, Shell):
        at, mean, slopes = given.of_shells(block)
        temperature[at], gradient[at] = mean, slopes
        bent = block.uneven(given.of_grids(block))
        bent[at] = 0.0
        hot = gradient != 0.0
        bent[hot] = gradient[hot, None] * block.bent()[hot]
    else:
        at, mean, _ = given.of_lines(block)
        temperature[at] = mean
    return temperature, gradient, bent


def _deformed(
    deck: "Deck", blocks: Sequence["ElementBlock"], sid: int, problems: list[str]
) -> list[tuple[int, Float64]]:
    """Blocks and the motions (e, n) of elements that DEFORM makes longer."""
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
            motion = np.zeros(block.dof.shape)
            motion[:, :12] = stretched(block.axis, longer)
            found.append((k, motion))
    problems += [
        f"{where('DEFORM', row)}: element {row['eid']} is no rod, bar or beam"
        for _, row in rows.iterrows()
        if row["eid"] not in known
    ]
    return found
