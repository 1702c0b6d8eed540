"""All elements of a deck with what is told of them: component, place, material."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.case import parts as settings
from drake_landing.parts.components import members
from drake_landing.parts.ply_strength import laminate_limits
from drake_landing.show.comments import KINDS, component_names, read_names
from fem.deck.grids import grids_of
from fem.deck.records import CARDS, TABLES, topologies
from fem.errors import Problems, nearest
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
        allowables: material id -> Pa, as the case gives them.
        kinds: components that are kinds of elements, where a deck names none.
    """

    elements: pd.DataFrame
    allowables: Mapping[int, float] = field(default_factory=dict)
    kinds: ClassVar[frozenset[str]] = frozenset(KINDS.values()) | {LAMINATES}

    @property
    def components(self) -> list[str]:
        """Names of the components, those with most elements first."""
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
        allowables: material id -> Pa; for others ST of MAT1 and, in laminates, the
            strengths of MAT8 and SB, where they are given (`ply_strength`).

    Raises:
        InputError: allowables and components of what the deck does not have.
    """
    cards = structure.deck.cards
    problems = Problems(_unknown_materials(cards, allowables))
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
    limits = laminate_limits(structure.deck, allowables)
    references = {pid: limit.reference for pid, limit in limits.items()}
    of_property = _materials(cards) | {pid: mid for pid, (mid, _) in references.items()}
    elements["material"] = [of_property.get(pid, 0) for pid in elements.pid]
    with problems.gathered():
        for name, own in members(structure, elements, components or {}).items():
            elements.loc[own, "component"] = name
    problems.report()
    known = _strengths(cards) | dict(allowables)
    elements["allowed"] = [
        references[pid][1] if pid in references else known.get(mid, np.nan)
        for pid, mid in zip(elements.pid, elements.material)
    ]
    elements = elements.drop(columns=["file", "line"]).sort_values("id")
    elements = elements.reset_index(drop=True)
    return Inventory(elements=elements, allowables=dict(allowables))


def _unknown_materials(
    cards: Mapping[str, pd.DataFrame], allowables: Mapping[int, float]
) -> list[str]:
    """Allowables of materials that are not there."""
    names = [name for name in cards if name.startswith("MAT") and "mid" in cards[name]]
    known = {int(mid) for name in names for mid in cards[name].mid}
    return [
        f"parts.allowables.{mid}: the deck has no material {mid}"
        + nearest(str(mid), [str(k) for k in sorted(known)])
        for mid in allowables
        if mid not in known
    ]


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


_SOFT = 0.1  # of the stiffest ply: modulus below which a ply fills and does not bear


def ply_moduli(cards: Mapping[str, pd.DataFrame]) -> dict[int, tuple[float, bool]]:
    """Material id -> its largest modulus (Pa), and whether it is isotropic."""
    found: dict[int, tuple[float, bool]] = {}
    for name, columns in (("MAT2", ["g11", "g22"]), ("MAT8", ["e1", "e2"])):
        if name in cards:
            card = cards[name]
            largest = card[columns].max(axis=1)
            found |= {int(m): (float(e), False) for m, e in zip(card.mid, largest)}
    card = cards["MAT1"]
    return found | {int(m): (float(e), True) for m, e in zip(card.mid, card.e)}


def isotropic_sheets(
    mids: Iterable[float], moduli: Mapping[int, tuple[float, bool]]
) -> list[int]:
    """Isotropic materials of a laminate that bear; a soft core is none of them."""
    plies = [int(mid) for mid in mids]
    stiffest = max((moduli[m][0] for m in plies if m in moduli), default=0.0)
    return [
        m
        for m in plies
        if m in moduli and moduli[m][1] and moduli[m][0] >= _SOFT * stiffest
    ]


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
        moduli = ply_moduli(cards)
        for row in cards["PCOMP"].to_dict("records"):
            sheets = isotropic_sheets(row["mids"], moduli)
            found[int(row["pid"])] = sheets[0] if sheets else int(row["mids"][0])
    return found


def _strengths(cards: Mapping[str, pd.DataFrame]) -> dict[int, float]:
    table = cards["MAT1"]
    return {
        int(mid): float(st)
        for mid, st in zip(table.mid, table.st)
        if st == st and float(st) > 0.0
    }
