"""Stresses of shells: sheets from strains at both fibres, laminates from plies."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.sparse as sp

from drake_landing.parts.inventory import (
    isotropic_sheets,
    ply_moduli,
    sheet_material,
)
from drake_landing.parts.ply_strength import LaminateLimit
from drake_landing.parts.stress_maps import Evaluate, Float64, StressPart, StressPiece
from fem.algebra.sparse_products import shape_of
from fem.elements.block import Detail, ElementBlock, Kind
from fem.elements.shells.shell import Shell
from fem.elements.shells.shell_recovery import PlyRecovery
from fem.elements.stress_measures import plane_von_mises
from fem.geometry.points import Points
from fem.model.structure import Structure
from fem.recovery.elements import ElementTable, element_tables

_PIECE = 512  # elements at once: their histories fit into a cache


def sheets(structure: Structure, block: Shell) -> StressPart:
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


def laminated(
    structure: Structure, block: Shell, limits: Mapping[int, LaminateLimit]
) -> list[StressPart]:
    """Laminates with strengths of plies, and all other shells."""
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

    def evaluate(part: slice) -> Evaluate:
        own = recovery.laminate[part]
        groups = [(limits[of_laminate[n]], own == n) for n in np.unique(own).tolist()]
        return partial(_strength_measures, groups=groups)

    pieces = _pieces(len(block.id), maps.shape[1], evaluate)
    operator = sp.csr_matrix(_blocks(maps) @ table.operator)
    return StressPart(id=block.id, operator=operator, pieces=pieces)


def _strength_measures(
    linear: Float64, groups: Sequence[tuple[LaminateLimit, npt.NDArray[np.bool_]]]
) -> Float64:
    """Measures from the ply stresses; the equivalent one by `LaminateLimit.use`."""
    count = len(groups[0][1])
    ply = linear.reshape(*linear.shape[:-1], count, -1, 5)
    xx, yy, xy = np.moveaxis(ply[..., :3], -1, 0)
    center, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    equivalent = np.zeros(ply.shape[:-2])
    for limit, those in groups:
        of_one = limit.use(ply[..., those, :, :]) * limit.reference[1]
        equivalent[..., those] = of_one
    high, low = (center + radius).max(axis=-1), (center - radius).min(axis=-1)
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
    size = len(block.id)

    def evaluate(part: slice) -> Evaluate:
        return partial(_plane_measures, isotropic=isotropic[part])

    return StressPart(
        id=block.id,
        operator=sp.csr_matrix(operator),
        pieces=_pieces(size, rows // size, evaluate),
    )


def _pieces(
    size: int, k: int, evaluate: Callable[[slice], Evaluate]
) -> tuple[StressPiece, ...]:
    """Groups of elements with k quantities each, whose histories fit into a cache."""
    parts = [slice(i, min(i + _PIECE, size)) for i in range(0, size, _PIECE)]
    return tuple(
        StressPiece(
            elements=part,
            rows=slice(part.start * k, part.stop * k),
            evaluate=evaluate(part),
        )
        for part in parts
    )


def _plies(mids: Sequence[int], maps: Float64) -> list[int]:
    """Materials of the plies that have stresses; symmetric laminates list half."""
    count = int(np.isfinite(maps.reshape(-1, 40)[:, 0]).sum())
    given = [int(m) for m in mids]
    return (given + given[::-1])[:count] if len(given) < count else given[:count]


def _plane_measures(linear: Float64, isotropic: npt.NDArray[np.bool_]) -> Float64:
    """Measures from xx yy xy of the points of each element."""
    shape = (*linear.shape[:-1], len(isotropic), -1, 3)
    xx, yy, xy = np.moveaxis(linear.reshape(shape), -1, 0)
    center, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    high = (center + radius).max(axis=-1)
    low = (center - radius).min(axis=-1)
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
