"""One stress per element and instant: equivalent, largest and smallest direct stress.

    sheets      von Mises, the larger of both fibres. The stress is that of the sheet
                itself, from its strains: a skin with stringers smeared into its
                membrane has resultants that are not its own
    laminates   by the strengths of their plies, where MAT8 or SB give any
                (`ply_strength`); else von Mises of the isotropic plies that bear; where
                there are none (MAT8 faces on a soft core), the largest principal stress
                of any ply
    bars        largest magnitude of the direct stress at the stress points, or axial;
                where no stress points are given the axial stress is not the worst of a
                bar that bends: `axial_only`
    solids      von Mises at the centre

Largest and smallest are the principal or direct stresses. All of it is a sparse matrix
on displacements of the g-set, then a few array operations; during a transient a kernel
does both (`stress_extremes`).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.sparse as sp

from drake_landing.parts.inventory import (
    isotropic_sheets,
    ply_moduli,
    sheet_material,
)
from drake_landing.parts.ply_strength import LaminateLimit, laminate_limits
from fem.algebra.sparse_products import shape_of
from fem.elements.block import Detail, ElementBlock, Kind
from fem.elements.lines.bar import Bar
from fem.elements.lines.beam import Beam
from fem.elements.shells.shell import Shell
from fem.elements.shells.shell_recovery import PlyRecovery
from fem.elements.stress_measures import plane_von_mises
from fem.geometry.points import Points
from fem.model.structure import Structure
from fem.recovery.elements import ElementTable, TablePiece, element_tables

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]
Evaluate = Callable[[Float64], Float64]

MEASURES = ("equivalent", "largest", "smallest")
_PIECE = 512  # elements at once: their histories fit into a cache
_LARGEST = ("major", "smax", "axial")
_SMALLEST = ("minor", "smin", "axial")


@dataclass(frozen=True, kw_only=True)
class StressPiece:
    """Some elements of a part.

    Attributes:
        elements, rows: slices of the elements and linear quantities of the part.
        evaluate: from (..., n k) linear quantities to (..., n, 3) `MEASURES`.
    """

    elements: slice
    rows: slice
    evaluate: Evaluate


@dataclass(frozen=True, kw_only=True)
class StressPart:
    """Elements of one kind.

    Attributes:
        id: (e,) elements.
        operator: (e k, g) from displacements of the g-set to k linear quantities of
            each element.
        pieces: the elements in groups whose histories fit into a cache.
    """

    id: Int64
    operator: sp.csr_matrix
    pieces: tuple[StressPiece, ...]

    def of(self, displacement: Float64) -> Float64:
        """(c, e, 3) under displacements of the g-set (g, c)."""
        linear = np.asarray(self.operator @ displacement).T
        found = [piece.evaluate(linear[:, piece.rows]) for piece in self.pieces]
        return np.concatenate(found, axis=1)


@dataclass(frozen=True, kw_only=True)
class Stresses:
    """Stresses of all elements of a structure that have any.

    Attributes:
        parts: elements of one kind each.
        expand: (g, f) g-set from the free set.
        without_points: ids, see `without_stress_points`.
        limits: what laminates are measured against, in words.
    """

    parts: tuple[StressPart, ...]
    expand: sp.csr_matrix = field(repr=False)
    limits: str = ""
    without_points: Int64 = field(default_factory=lambda: np.zeros(0, np.int64))

    @cached_property
    def axial_only(self) -> npt.NDArray[np.bool_]:
        """(e,) bars that bend and of which the axial stress alone is known."""
        return np.isin(self.id, self.without_points)

    @cached_property
    def id(self) -> Int64:
        """(e,) elements, part by part."""
        ids = [part.id for part in self.parts]
        return np.concatenate(ids) if ids else np.zeros(0, np.int64)

    def of(self, displacement: Float64) -> Float64:
        """(c, e, 3) `MEASURES` under displacements (f, c)."""
        if not self.parts:
            return np.zeros((displacement.shape[1], 0, 3))
        moved = np.asarray(self.expand @ displacement)
        return np.concatenate([part.of(moved) for part in self.parts], axis=1)


def stresses(
    structure: Structure, allowables: Mapping[int, float] | None = None
) -> Stresses:
    """Linear maps of all elements with stresses.

    Args:
        structure: of the deck.
        allowables: material id -> Pa, of the case, before those of the deck.
    """
    limits = laminate_limits(structure.deck, allowables or {})
    found: list[StressPart] = []
    for block in structure.blocks:
        if isinstance(block, Shell) and block.property_card == "PCOMP":
            found += _laminated(structure, block, limits)
        elif isinstance(block, Shell):
            found.append(_sheets(structure, block))
        else:
            found += _printed(structure, block)
    return Stresses(
        parts=tuple(found),
        expand=structure.elimination.T,
        without_points=without_stress_points(structure),
        limits=repr(limits) if limits else "",
    )


def without_stress_points(structure: Structure) -> Int64:
    """Ids of bars that bend and whose property gives no stress points (C, D, E, F)."""
    found = [np.zeros(0, np.int64)]
    for block in structure.blocks:
        if isinstance(block, Bar | Beam):
            points = block.section.recovery.reshape(len(block.id), -1)
            bends = block.end_stiffness[:, (4, 5), (4, 5)].any(axis=1)
            found.append(block.id[bends & ~points.any(axis=1)])
    return np.concatenate(found)


def stress_point_notices(structure: Structure) -> list[str]:
    """A line that says of which bars the axial stress alone is known, if any."""
    count = len(without_stress_points(structure))
    if not count:
        return []
    return [
        f"{count} bar{'s' * (count > 1)} without stress recovery points: only the "
        "axial stress is known, which leaves out bending and is no part of the worst "
        "stresses; look at the section loads, or give C, D, E, F on PBAR (PBEAM), or "
        "shapes by PBARL (PBEAML)"
    ]


def _sheets(structure: Structure, block: Shell) -> StressPart:
    """Stresses at both fibres from the strains there, where the sheet is isotropic."""
    points, cards = structure.points, structure.deck.cards
    moduli = cards["MAT1"].set_index("mid")[["e", "g", "nu"]]
    of_property = {
        int(row["pid"]): sheet_material(row, moduli.e)
        for row in cards["PSHELL"].to_dict("records")
    }
    material = np.array([of_property[int(pid)] for pid in block.pid])
    known = material > 0
    strain = _table(points, block, "strain", Detail(fibre=True))
    stress = _table(points, block, "stress", Detail())
    elastic = np.zeros((len(material), 3, 3))
    for mid in np.unique(material[known]):
        elastic[material == mid] = _plane_stress(moduli.loc[mid])
    count = shape_of(strain.operator)[0] // (3 * len(material))  # fibres of all points
    taken = _diagonal(np.repeat(known, 3 * count).astype(float))
    left = _diagonal(np.repeat(~known, 3 * count).astype(float))
    operator = taken @ (_blocks(np.repeat(elastic, count, axis=0)) @ strain.operator)
    operator = operator + left @ stress.operator
    return _shell_part(block, operator, np.ones(len(material), bool))


def _laminated(
    structure: Structure, block: Shell, limits: Mapping[int, LaminateLimit]
) -> list[StressPart]:
    """Those with strengths of plies, and the others."""
    judged = np.isin(block.pid, list(limits))
    parts = []
    if judged.any():
        parts.append(
            _by_strength(structure, block.take(np.flatnonzero(judged)), limits)
        )
    if not judged.all():
        parts.append(_laminates(structure, block.take(np.flatnonzero(~judged))))
    return parts


def _by_strength(
    structure: Structure, block: Shell, limits: Mapping[int, LaminateLimit]
) -> StressPart:
    """Use of the strengths, from the stresses of all plies."""
    table = _table(structure.points, block, "stress", Detail())
    recovery = table.parts[0]
    assert isinstance(recovery, PlyRecovery)
    maps = np.nan_to_num(np.stack(recovery.maps))[recovery.laminate]
    pids = block.pid[np.unique(recovery.laminate, return_index=True)[1]]
    of_laminate = dict(zip(np.unique(recovery.laminate).tolist(), pids.tolist()))
    size, k = len(block.id), maps.shape[1]
    pieces = []
    for start in range(0, size, _PIECE):
        stop = min(start + _PIECE, size)
        own = recovery.laminate[start:stop]
        groups = [(limits[of_laminate[n]], own == n) for n in np.unique(own).tolist()]
        pieces.append(
            StressPiece(
                elements=slice(start, stop),
                rows=slice(start * k, stop * k),
                evaluate=partial(_use, groups=groups),
            )
        )
    operator = sp.csr_matrix(_blocks(maps) @ table.operator)
    return StressPart(id=block.id, operator=operator, pieces=tuple(pieces))


def _use(
    linear: Float64, groups: Sequence[tuple[LaminateLimit, npt.NDArray[np.bool_]]]
) -> Float64:
    """Measures from the ply stresses; the equivalent one by `LaminateLimit.use`."""
    count = len(groups[0][1])
    ply = linear.reshape(*linear.shape[:-1], count, -1, 5)
    xx, yy, xy = np.moveaxis(ply[..., :3], -1, 0)
    centre, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    equivalent = np.zeros(ply.shape[:-2])
    for limit, those in groups:
        of_one = limit.use(ply[..., those, :, :]) * limit.reference[1]
        equivalent[..., those] = of_one
    high, low = (centre + radius).max(axis=-1), (centre - radius).min(axis=-1)
    return np.stack([equivalent, high, low], axis=-1)


def _laminates(structure: Structure, block: Shell) -> StressPart:
    """Stresses of the isotropic plies that bear, or of all where there are none."""
    table = _table(structure.points, block, "stress", Detail())
    recovery = table.parts[0]
    assert isinstance(recovery, PlyRecovery)
    cards = structure.deck.cards
    moduli = ply_moduli(cards)
    mids = dict(zip(cards["PCOMP"].pid, cards["PCOMP"].mids))
    laminate = recovery.laminate
    chosen, pure = [], []
    for k, found in enumerate(recovery.maps):
        pid = int(block.pid[np.flatnonzero(laminate == k)[0]]) if k in laminate else 0
        plies = _plies(mids.get(pid, ()), found)
        bears = set(isotropic_sheets(plies, moduli))
        sheets = [i for i, mid in enumerate(plies) if mid in bears]
        pure.append(bool(sheets))
        chosen.append(sheets or list(range(len(plies))) or [0])
    most = max(map(len, chosen))
    maps = np.stack(
        [
            found.reshape(-1, 5, 8)[(plies * most)[:most], :3].reshape(3 * most, 8)
            for found, plies in zip(recovery.maps, chosen)
        ]
    )
    operator = _blocks(np.nan_to_num(maps[laminate])) @ table.operator
    return _shell_part(block, operator, np.array(pure)[laminate])


def _shell_part(
    block: Shell,
    operator: sp.spmatrix,
    isotropic: npt.NDArray[np.bool_],
) -> StressPart:
    """From xx yy xy of the points of each element."""
    rows, _ = shape_of(operator)
    size, k = len(block.id), rows // len(block.id)
    pieces = []
    for start in range(0, size, _PIECE):
        stop = min(start + _PIECE, size)
        pieces.append(
            StressPiece(
                elements=slice(start, stop),
                rows=slice(start * k, stop * k),
                evaluate=partial(_plane, isotropic=isotropic[start:stop]),
            )
        )
    return StressPart(
        id=block.id, operator=sp.csr_matrix(operator), pieces=tuple(pieces)
    )


def _plies(mids: Sequence[int], maps: Float64) -> list[int]:
    """Materials of the plies that have stresses; symmetric laminates list half."""
    count = int(np.isfinite(maps.reshape(-1, 40)[:, 0]).sum())
    given = [int(m) for m in mids]
    return (given + given[::-1])[:count] if len(given) < count else given[:count]


def _printed(structure: Structure, block: ElementBlock) -> list[StressPart]:
    """From Nastran's printed columns: bars, rods, solids."""
    found = []
    for table in element_tables(structure.points, [block], "stress"):
        if not any(n.startswith((*_LARGEST, "von_mises")) for n in table.columns):
            continue
        pieces, first = [], 0
        for piece in table.pieces:
            after = first + len(piece.place)
            pieces.append(
                StressPiece(
                    elements=slice(first, after),
                    rows=piece.rows,
                    evaluate=partial(_columns, table=table, piece=piece),
                )
            )
            first = after
        found.append(
            StressPart(
                id=table.id,
                operator=table.operator,
                pieces=tuple(pieces),
            )
        )
    return found


def _columns(linear: Float64, table: ElementTable, piece: TablePiece) -> Float64:
    """Measures from the printed columns of some elements."""
    shape = (*linear.shape[:-1], len(piece.place), -1)
    values = piece.recovery.derive(linear.reshape(shape))

    def those(prefixes: tuple[str, ...]) -> Float64:
        return values[
            ..., [k for k, n in enumerate(table.columns) if n.startswith(prefixes)]
        ]

    high, low = those(_LARGEST).max(axis=-1), those(_SMALLEST).min(axis=-1)
    equal = those(("von_mises",))
    if equal.shape[-1]:
        return np.stack([equal.max(axis=-1), high, low], axis=-1)
    return np.stack([np.maximum(np.abs(high), np.abs(low)), high, low], axis=-1)


def _plane(linear: Float64, isotropic: npt.NDArray[np.bool_]) -> Float64:
    """Measures from xx yy xy of the points of each element."""
    shape = (*linear.shape[:-1], len(isotropic), -1, 3)
    xx, yy, xy = np.moveaxis(linear.reshape(shape), -1, 0)
    centre, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    high = (centre + radius).max(axis=-1)
    low = (centre - radius).min(axis=-1)
    equivalent = plane_von_mises(xx, yy, xy).max(axis=-1)
    if not isotropic.all():
        equivalent = np.where(
            isotropic, equivalent, np.maximum(np.abs(high), np.abs(low))
        )
    return np.stack([equivalent, high, low], axis=-1)


def _table(
    points: Points, block: ElementBlock, kind: Kind, detail: Detail
) -> ElementTable:
    (table,) = element_tables(points, [block], kind, detail=detail)
    return table


def _plane_stress(row: pd.Series) -> Float64:
    """(3, 3) of E, G, nu of MAT1, two of which may do."""
    e, g, nu = (float(row[name]) for name in ("e", "g", "nu"))
    if nu != nu:
        nu = e / (2.0 * g) - 1.0
    if e != e:
        e = 2.0 * g * (1.0 + nu)
    g = g if g == g else e / (2.0 * (1.0 + nu))
    plane = e / (1.0 - nu * nu)
    return np.array([[plane, nu * plane, 0.0], [nu * plane, plane, 0.0], [0.0, 0.0, g]])


def _blocks(maps: Float64) -> sp.bsr_matrix:
    """Block-diagonal matrix of (b, r, c)."""
    b, r, c = maps.shape
    return sp.bsr_matrix((maps, np.arange(b), np.arange(b + 1)), shape=(b * r, b * c))


def _diagonal(values: Float64) -> sp.csr_matrix:
    n = len(values)
    return sp.csr_matrix((values, np.arange(n), np.arange(n + 1)), shape=(n, n))
