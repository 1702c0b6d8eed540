"""All elements of a deck with what is told of them: component, place, material."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.show.comments import component_names, read_names
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_NODES = {
    "CQUAD4": ("g1", "g2", "g3", "g4"),
    "CSHEAR": ("g1", "g2", "g3", "g4"),
    "CTRIA3": ("g1", "g2", "g3"),
    "CBAR": ("ga", "gb"),
    "CBEAM": ("ga", "gb"),
    "CROD": ("g1", "g2"),
    "CONROD": ("g1", "g2"),
    "CTUBE": ("g1", "g2"),
}
_SOLIDS = ("CHEXA", "CPENTA", "CTETRA", "CPYRAM")
# Property card -> columns that name its material, the decisive one first.
_MATERIAL = {
    "PSHELL": ("mid2", "mid1"),
    **dict.fromkeys(
        ("PBAR", "PBARL", "PBEAM", "PBEAML", "PROD", "PTUBE", "PSHEAR", "PSOLID"),
        ("mid",),
    ),
}


@dataclass(frozen=True, kw_only=True)
class Inventory:
    """Elements that can have stresses.

    Attributes:
        elements: one row each, ascending `id`; columns `card`, `pid`, `component`,
            `material` (0: none of its own), `x`, `y`, `z` (middle of its grids, B, m),
            `allowed` (stress, Pa; NaN where unknown).
    """

    elements: pd.DataFrame

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


def inventory(structure: Structure, allowables: Mapping[int, float]) -> Inventory:
    """Elements of a structure.

    Args:
        structure: of the deck.
        allowables: material id -> Pa; for others ST of MAT1, where it is given.
    """
    cards = structure.deck.cards
    tables = [
        _table(card, cards[card], [cards[card][c].to_numpy(np.int64) for c in columns])
        for card, columns in _NODES.items()
        if card in cards and len(cards[card])
    ]
    tables += [
        _table(card, cards[card], _padded(cards[card]))
        for card in _SOLIDS
        if card in cards and len(cards[card])
    ]
    if not tables:
        heads = ["id", "card", "pid", "component", "material", "x", "y", "z", "allowed"]
        return Inventory(elements=pd.DataFrame(columns=heads))
    elements = pd.concat([_placed(structure, t) for t in tables], ignore_index=True)
    names = read_names(elements.file.unique())
    elements["component"] = component_names(names, elements)
    of_property = _materials(cards)
    elements["material"] = [of_property.get(pid, 0) for pid in elements.pid]
    known = _strengths(cards) | dict(allowables)
    elements["allowed"] = [known.get(mid, np.nan) for mid in elements.material]
    elements = elements.drop(columns=["file", "line"]).sort_values("id")
    return Inventory(elements=elements.reset_index(drop=True))


def sheet_material(row: Mapping[str, float], isotropic: Mapping[int, object]) -> int:
    """The isotropic material of a PSHELL's sheet, 0: none.

    That of bending, where the membrane is made stiffer by stringers smeared into it.
    """
    for column in _MATERIAL["PSHELL"]:
        mid = row[column]
        if mid == mid and int(mid) in isotropic:
            return int(mid)
    return 0


def _table(card: str, rows: pd.DataFrame, nodes: list[Int64]) -> pd.DataFrame:
    pid = rows.pid if "pid" in rows else np.zeros(len(rows), np.int64)
    found = {"id": rows.eid, "card": card, "pid": pid}
    table = pd.DataFrame({**found, "file": rows.file, "line": rows.line})
    table["nodes"] = list(np.column_stack(nodes))
    return table


def _padded(rows: pd.DataFrame) -> list[Int64]:
    """Grids of solids; midside ones that are left out repeat the first."""
    longest = max(len(nodes) for nodes in rows.nodes)
    full = [
        [n or nodes[0] for n in [*nodes, *[0] * (longest - len(nodes))]]
        for nodes in rows.nodes
    ]
    return list(np.array(full, np.int64).T)


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
    for card, columns in _MATERIAL.items():
        if card not in cards:
            continue
        for row in cards[card].to_dict("records"):
            if card == "PSHELL":
                mid = sheet_material(row, isotropic)
            else:
                mid = row.get(columns[0], 0) or 0
            found[int(row["pid"])] = int(mid)
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
