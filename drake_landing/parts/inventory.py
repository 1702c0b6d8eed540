"""All elements of a deck with what is told of them: component, place, material."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.case import parts as settings
from drake_landing.parts.components import members
from drake_landing.show.comments import KINDS, component_names, read_names
from fem.deck.grids import grids_of
from fem.deck.records import CARDS, TABLES, topologies
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

# Columns that name the material of a shell's sheet, the decisive one first.
_SHEET = ("mid2", "mid1")


LAMINATES = "laminates"


@dataclass(frozen=True, kw_only=True)
class Inventory:
    """Elements that can have stresses.

    Attributes:
        elements: one row each, ascending `id`; columns `card`, `pid`, `component`,
            `material` (0: none of its own), `x`, `y`, `z` (middle of its grids, B, m),
            `allowed` (stress, Pa; NaN where unknown).
        kinds: components that are kinds of elements, where a deck names none.
    """

    elements: pd.DataFrame
    kinds: ClassVar[frozenset[str]] = frozenset(KINDS.values()) | {LAMINATES}

    @property
    def components(self) -> list[str]:
        """Those with most elements first."""
        return self.elements.component.value_counts().index.tolist()

    def of(self, ids: Int64) -> pd.DataFrame:
        """Rows of elements, in their order."""
        return self._by_id.loc[ids]

    @cached_property
    def _by_id(self) -> pd.DataFrame:
        return self.elements.set_index("id")


def inventory(
    structure: Structure,
    allowables: Mapping[int, float],
    components: Mapping[str, settings.Component] | None = None,
) -> Inventory:
    """Elements of a structure.

    Args:
        structure: of the deck.
        components: by name, of the case; what they leave is named by the deck.
        allowables: material id -> Pa; for others ST of MAT1, where it is given.
    """
    cards = structure.deck.cards
    tables = [
        _table(card, cards[card], grids_of(cards[card], topology))
        for card, topology in topologies("line", "surface", "solid").items()
        if card in cards and len(cards[card]) and _has_stress(card)
    ]
    if not tables:
        heads = ["id", "card", "pid", "component", "material", "x", "y", "z", "allowed"]
        return Inventory(elements=pd.DataFrame(columns=heads))
    elements = pd.concat([_placed(structure, t) for t in tables], ignore_index=True)
    names = read_names(elements.file.unique())
    elements["component"] = component_names(names, elements)
    laminates = elements.pid.isin(cards["PCOMP"].pid) & elements.component.isin(
        Inventory.kinds
    )
    elements.loc[laminates, "component"] = LAMINATES
    of_property = _materials(cards)
    elements["material"] = [of_property.get(pid, 0) for pid in elements.pid]
    for name, own in members(structure, elements, components or {}).items():
        elements.loc[own, "component"] = name
    known = _strengths(cards) | dict(allowables)
    elements["allowed"] = [known.get(mid, np.nan) for mid in elements.material]
    elements = elements.drop(columns=["file", "line"]).sort_values("id")
    return Inventory(elements=elements.reset_index(drop=True))


def sheet_material(row: Mapping[str, float], isotropic: Mapping[int, object]) -> int:
    """The isotropic material of a PSHELL's sheet, 0: none.

    That of bending, where the membrane is made stiffer by stringers smeared into it.
    """
    for column in _SHEET:
        mid = row[column]
        if mid == mid and int(mid) in isotropic:
            return int(mid)
    return 0


def _table(card: str, rows: pd.DataFrame, nodes: Int64) -> pd.DataFrame:
    pid = rows.pid if "pid" in rows else np.zeros(len(rows), np.int64)
    found = {"id": rows.eid, "card": card, "pid": pid}
    table = pd.DataFrame({**found, "file": rows.file, "line": rows.line})
    # Mid-sides that are left out repeat the first grid.
    table["nodes"] = list(np.where(nodes > 0, nodes, nodes[:, :1]))
    return table


def _has_stress(card: str) -> bool:
    element = CARDS[card].element
    return any("stress" in r.kinds for r in element.results) if element else False


def _placed(structure: Structure, table: pd.DataFrame) -> pd.DataFrame:
    points = structure.points
    nodes = np.array(table["nodes"].tolist(), np.int64)
    table = table.drop(columns="nodes")
    known = np.isin(nodes, points.grid_id).all(axis=1)
    table, nodes = table.loc[known].copy(), nodes[known]
    middle = points.xyz[points.rows(nodes.ravel())].reshape(*nodes.shape, 3).mean(1)
    table["x"], table["y"], table["z"] = middle.T
    return table


def _materials(cards: Mapping[str, pd.DataFrame]) -> dict[int, int]:
    """Property id -> id of the material that bears."""
    isotropic = dict.fromkeys(cards["MAT1"].mid.tolist())
    found: dict[int, int] = {}
    for name, card in TABLES.items():
        if name in cards and {"pid", "mid"} <= card.columns.keys():
            found.update(zip(cards[name].pid.astype(int), cards[name].mid.astype(int)))
    for row in cards["PSHELL"].to_dict("records"):
        found[int(row["pid"])] = sheet_material(row, isotropic)
    if "PCOMP" in cards:
        for row in cards["PCOMP"].to_dict("records"):
            sheets = [int(m) for m in row["mids"] if int(m) in isotropic]
            found[int(row["pid"])] = sheets[0] if sheets else int(row["mids"][0])
    return found


def _strengths(cards: Mapping[str, pd.DataFrame]) -> dict[int, float]:
    table = cards["MAT1"]
    return {
        int(mid): float(st)
        for mid, st in zip(table.mid, table.st)
        if st == st and float(st) > 0.0
    }
