"""Stresses of all elements as rows that kernels can take extremes of.

`Stresses` gives one measure of stress for each element by functions of its linear
quantities. Nearly all elements are sheets (xx, yy, xy at some points) or lines (direct
stresses at some points): for these the functions are known to the kernels of
`stress_kernels`. Whether a part is one of them is found by trying, not by its name; the
rest keeps its own function.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from drake_landing.parts.stress import Stresses, StressPart
from drake_landing.parts.stress_kernels import line_extremes, sheet_extremes
from fem.algebra.sparse_products import shape_of
from fem.arrays import Bool, Float64, Int64

Kind = Literal["sheet", "line", "other"]
_SAME = 1e-9  # of the largest: two ways to one stress
_KERNELS = {"sheet": sheet_extremes, "line": line_extremes}


@dataclass(frozen=True, kw_only=True)
class StressRows:
    """Elements of one kind.

    Attributes:
        kind: which measure their rows have.
        part: where they come from.
        isotropic: (e,) von Mises is the equivalent stress of sheets.
        per_element: rows of each element.
        operator: (e per_element, f) from displacements of the free set to the rows.
    """

    kind: Kind
    part: StressPart = field(repr=False)
    isotropic: Bool
    per_element: int
    operator: sp.csr_matrix = field(repr=False)

    @property
    def size(self) -> int:
        """Elements."""
        return len(self.part.id)

    def extremes(
        self, sigma: Float64, elements: slice, first: int, state: "Extremes", at: int
    ) -> None:
        """Takes the stresses of some elements into running extremes.

        Args:
            sigma: (e per_element, t) rows of these elements.
            elements: which of the part.
            first: number of the first instant.
            state: extremes of all parts.
            at: position of the first element of the part in it.
        """
        own = slice(at + elements.start, at + elements.stop)
        if self.kind == "other":
            _other(self, sigma, elements, first, state, own)
            return
        points = self.per_element // (3 if self.kind == "sheet" else 1)
        _KERNELS[self.kind](
            sigma,
            points,
            self.isotropic[elements],
            first,
            state.square[own],
            state.when[own],
            state.high[own],
            state.low[own],
        )


@dataclass(frozen=True, kw_only=True)
class Extremes:
    """Running extremes of all elements, in the order of `Stresses.id`.

    Attributes:
        square: (e,) square of the largest equivalent stress, Pa².
        when: (e,) number of its instant.
        high, low: (e,) largest and smallest direct or principal stress, Pa; they count
            from zero, as the stresses of an aircraft at rest do.
    """

    square: Float64
    when: npt.NDArray[np.int32]
    high: Float64
    low: Float64

    @classmethod
    def zero(cls, elements: int) -> "Extremes":
        """Before the first instant."""
        return cls(
            square=np.zeros(elements),
            when=np.zeros(elements, np.int32),
            high=np.zeros(elements),
            low=np.zeros(elements),
        )

    @property
    def equivalent(self) -> Float64:
        """(e,) largest equivalent stress, Pa."""
        return np.sqrt(self.square)


def stress_rows(stresses: Stresses) -> tuple[StressRows, ...]:
    """All parts, those that are sheets or lines recognised as such."""
    return tuple(_recognised(part) for part in stresses.parts)


def starts(rows: Sequence[StressRows]) -> Int64:
    """(p,) position of the first element of each part."""
    return np.cumsum([0, *(r.size for r in rows)])[:-1]


def _recognised(part: StressPart) -> StressRows:
    total, _ = shape_of(part.operator)
    per_element = total // max(len(part.id), 1)
    for kind, turn, isotropic in _candidates(part, per_element):
        operator = part.operator
        if turn is not None:
            every = sp.kron(sp.identity(len(part.id)), sp.csr_matrix(turn))
            operator = sp.csr_matrix(every @ operator)
        rows = StressRows(
            kind=kind,
            part=part,
            isotropic=isotropic,
            per_element=per_element if turn is None else len(turn),
            operator=operator,
        )
        if _agrees(rows, per_element, turn):
            return rows
    return StressRows(
        kind="other",
        part=part,
        isotropic=np.ones(len(part.id), bool),
        per_element=per_element,
        operator=part.operator,
    )


def _candidates(part: StressPart, k: int):
    """Kind, (p, k) turn of the linear quantities, (e,) isotropic: what it may be."""
    e = len(part.id)
    if k % 3 == 0:
        flags = [getattr(p.evaluate, "keywords", {}) for p in part.pieces]
        given = [f["isotropic"] for f in flags if "isotropic" in f]
        isotropic = np.concatenate(given) if len(given) == len(flags) else None
        yield "sheet", None, np.ones(e, bool) if isotropic is None else isotropic
    if k == 9:
        # CBAR: bending at four points of end A, axial, bending at four points of B.
        bar = np.eye(9)
        bar[:, 4] = 1.0
        yield "line", bar, np.ones(e, bool)
    yield "line", np.eye(k)[:1], np.ones(e, bool)
    yield "line", np.eye(k), np.ones(e, bool)


def _agrees(rows: StressRows, k: int, turn: Float64 | None) -> bool:
    """Whether the kernel finds what the part's own functions find."""
    rng = np.random.default_rng(0)
    part, state = rows.part, Extremes.zero(rows.size)
    linear = rng.standard_normal((rows.size, k, 3))
    given = linear if turn is None else np.einsum("pk,ekt->ept", turn, linear)
    sigma = np.ascontiguousarray(given.reshape(-1, 3))
    rows.extremes(sigma, slice(0, rows.size), 0, state, 0)
    flat = linear.reshape(-1, 3).T
    own = [np.asarray(p.evaluate(flat[:, p.rows])) for p in part.pieces]
    expected = np.concatenate(own, axis=1) if own else np.zeros((3, 0, 3))
    found = state.equivalent
    wanted = expected[..., 0].max(axis=0)
    scale = np.abs(wanted).max(initial=1.0)
    same = np.abs(found - wanted).max(initial=0.0) <= _SAME * scale
    high = np.maximum(expected[..., 1].max(axis=0), 0.0)
    return bool(same and np.abs(state.high - high).max(initial=0.0) <= _SAME * scale)


def _other(
    rows: StressRows,
    sigma: Float64,
    elements: slice,
    first: int,
    state: Extremes,
    own: slice,
) -> None:
    """Extremes by the part's own functions; `elements` are whole pieces."""
    found = []
    offset = elements.start * rows.per_element
    for piece in rows.part.pieces:
        if elements.start <= piece.elements.start < elements.stop:
            at = slice(piece.rows.start - offset, piece.rows.stop - offset)
            found.append(piece.evaluate(np.asarray(sigma[at].T, float)))
    values = np.concatenate(found, axis=1)
    best = values[..., 0].argmax(axis=0)
    equivalent = np.take_along_axis(values[..., 0], best[None], axis=0)[0] ** 2
    better = equivalent > state.square[own]
    state.square[own] = np.where(better, equivalent, state.square[own])
    state.when[own] = np.where(better, first + best, state.when[own])
    state.high[own] = np.maximum(state.high[own], values[..., 1].max(axis=0))
    state.low[own] = np.minimum(state.low[own], values[..., 2].min(axis=0))
