"""Reduces a structure to interface grids."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.basis import interface_rows
from drake_landing.reduced.model import ReducedModel
from fem.algebra.linear_solver import SingularMatrixError
from fem.algebra.modes import ModesError
from fem.algebra.reduction import Reduction, reduce_craig_bampton
from fem.errors import InputError
from fem.model.structure import Structure

Method = Literal["guyan", "craig-bampton", "dynamic"]
METHODS: tuple[Method, ...] = ("guyan", "craig-bampton", "dynamic")
Float64 = npt.NDArray[np.float64]
_NOTHING = 1e-13  # of the largest: an entry of the recovery that is round-off


@dataclass(frozen=True, kw_only=True)
class Reduced:
    """The reduction in the freedoms of the structure, and as a model of its own."""

    reduction: Reduction
    model: ReducedModel


def reduce_structure(
    structure: Structure,
    grids: Sequence[int],
    method: Method,
    *,
    highest_hz: float = 150.0,
    count: int = 60,
) -> Reduced:
    """Condenses a structure onto grids.

    Args:
        structure: free or supported.
        grids: interface.
        method: `guyan`; `craig-bampton` with the fixed-interface modes below
            `highest_hz`; `dynamic` with `count` approximate ones.
        highest_hz: Hz.
        count: of generalised coordinates.

    Raises:
        InputError: grids that do not exist or do not move, a singular interior.
    """
    ids = _existing(structure, grids)
    rows, notices = interface_rows(structure, ids)
    if len(rows) == 0:
        raise InputError(
            "interface: none of its grids can be kept: " + "; ".join(notices)
        )
    arguments: dict = {"count": 0}
    if method == "craig-bampton":
        arguments = {"highest_hz": highest_hz}
    elif method == "dynamic":
        arguments = {"count": count, "motions": structure.rigid_body}

    def reduce() -> Reduction:
        return reduce_craig_bampton(
            structure.stiffness, structure.mass, structure.damping, rows, **arguments
        )

    errors = (SingularMatrixError, ModesError)
    reduction = structure.guarded(reduce, dynamic=False, error=errors)
    model = _model(structure, reduction, ids, notices, method)
    return Reduced(reduction=reduction, model=model)


def _existing(structure: Structure, grids: Sequence[int]) -> npt.NDArray[np.int64]:
    ids = np.unique(np.asarray(grids, dtype=np.int64))
    absent = np.setdiff1d(ids, structure.points.grid_id).tolist()
    if absent or len(ids) == 0:
        raise InputError(
            f"interface: grids {', '.join(map(str, absent[:10]))} are not in "
            f"{structure.deck.path}"
            if absent
            else "interface: no grid is given"
        )
    return ids


def _model(
    structure: Structure,
    reduction: Reduction,
    asked: npt.NDArray[np.int64],
    notices: tuple[str, ...],
    method: str,
) -> ReducedModel:
    points = structure.points
    g_rows = structure.elimination.f[reduction.kept]
    grid, component = np.divmod(g_rows, 6)
    ids = np.union1d(asked, points.grid_id[grid])
    at = points.rows(ids)
    kept = np.zeros((len(ids), 6), bool)
    kept[np.searchsorted(ids, points.grid_id[grid]), component] = True
    turn = _to_basic(points.rotation[at], kept, reduction.size, ids)
    # Components that are not kept are condensed, dependent, or constrained.
    partial = ~kept.all(axis=1)
    recovery = np.zeros((0, reduction.size))
    if partial.any():
        operator = structure.operator(ids[partial], frame="basic")
        recovery = np.asarray(operator @ reduction.transform) @ turn
        recovery = recovery[~kept[partial].ravel()]
        recovery[np.abs(recovery) < _NOTHING * np.abs(recovery).max()] = 0.0

    def turned(matrix: Float64) -> Float64:
        result = turn.T @ matrix @ turn
        return 0.5 * (result + result.T)

    return ReducedModel(
        grid_id=ids,
        p=points.xyz[at],
        kept=kept,
        stiffness=turned(reduction.stiffness),
        mass=turned(reduction.mass),
        damping=turned(reduction.damping),
        recovery=recovery,
        interior_hz=reduction.interior_hz,
        source=f"{structure.deck.path.name}, {method}",
        notices=notices,
    )


def _to_basic(
    rotation: Float64, kept: npt.NDArray[np.bool_], size: int, ids: npt.NDArray
) -> Float64:
    """(a + q, a + q) reduced freedoms by the same in basic axes, block-diagonal.

    Raises:
        InputError: a grid with axes of its own of which not all freedoms are kept.
    """
    turn = np.eye(size)
    turned = np.flatnonzero(~np.isclose(rotation, np.eye(3)).all(axis=(1, 2)))
    starts = np.concatenate([[0], np.cumsum(kept.sum(axis=1))])
    partial = [int(ids[k]) for k in turned if kept[k].any() and not kept[k].all()]
    if partial:
        raise InputError(
            f"interface: grid {g} has a displacement frame (CD) and keeps only part of "
            "its freedoms; give it the basic frame"
            for g in partial
        )
    for k in turned:
        for half in (0, 3) if kept[k].any() else ():
            at = slice(starts[k] + half, starts[k] + half + 3)
            turn[at, at] = rotation[k].T
    return turn
