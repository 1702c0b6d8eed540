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

from drake_landing.parts.element_maps import DenseRows
from drake_landing.parts.stress import Stresses
from drake_landing.parts.stress_kernels import of_displacements, of_rows
from drake_landing.parts.stress_maps import StressPart
from fem.algebra.extension import Extension
from fem.algebra.sparse_products import shape_of
from fem.arrays import Bool, Float64, Int64

Kind = Literal["sheet", "line", "other"]
Map = DenseRows | sp.csr_matrix
_SAME = 1e-9  # of the largest: two ways to one stress


@dataclass(frozen=True, kw_only=True)
class StressRows:
    """Elements of one kind.

    Attributes:
        kind: which measure their rows have.
        part: where they come from.
        isotropic: (e,) von Mises is the equivalent stress of sheets.
        per_element: rows of each element.
    """

    kind: Kind
    part: StressPart = field(repr=False)
    isotropic: Bool
    per_element: int

    @property
    def size(self) -> int:
        """Elements."""
        return len(self.part.id)

    @property
    def points(self) -> int:
        """Number of points at which an element of a known kind has a stress."""
        return self.per_element // (3 if self.kind == "sheet" else 1)

    def of_rows(
        self, sigma: Float64, elements: slice, first: int, state: "Extremes", at: int
    ) -> None:
        """Takes the stresses of some elements into running extremes of one load case.

        Args:
            sigma: (e per_element, t) rows of these elements.
            elements: which of the part; whole pieces of a part of another kind.
            first: number of the first instant.
            state: extremes of all parts.
            at: position of the first element of the part in it.
        """
        own = state.take(slice(at + elements.start, at + elements.stop))
        if self.kind == "other":
            _other(self, sigma, elements, first, own)
            return
        of_rows(
            self.kind == "sheet",
            sigma,
            self.points,
            self.isotropic[elements],
            first,
            own.square,
            own.when,
            own.high,
            own.low,
        )

    def of_displacements(
        self,
        maps: Map,
        offset: Float64,
        share: Float64,
        u: Float64,
        first: int,
        state: "Extremes",
        at: int,
    ) -> None:
        """Takes the stresses of all elements under displacements; see `of_rows`.

        Args:
            maps: of this part.
            offset: (e per_element,) stresses that come to those of a lane with its
            share: (lanes,).
            u: (f + d, lanes) extended vectors, cases of an instant side by side.
            first, state, at: as there.
        """
        own = state.take(slice(at, at + self.size))
        if isinstance(maps, DenseRows):
            of_displacements(
                self.kind == "sheet",
                maps.pointer,
                maps.column,
                maps.coefficient,
                offset,
                share,
                u,
                self.points,
                self.isotropic,
                first,
                own.square,
                own.when,
                own.high,
                own.low,
            )
            return
        sigma = maps @ u + np.outer(offset, share)
        cases = own.square.shape[1]
        for case in range(cases):
            alone = own.take(slice(None), slice(case, case + 1))
            lanes = sigma[:, case::cases]
            _other(self, lanes, slice(0, self.size), first, alone)


@dataclass(frozen=True, kw_only=True)
class Extremes:
    """Running extremes of all elements, in the order of `Stresses.id`.

    Attributes:
        square: (e, c) square of the largest equivalent stress of each load case, Pa².
        when: (e, c) number of its instant.
        high, low: (e, c) largest and smallest direct or principal stress, Pa; they
            count from zero, as the stresses of an aircraft at rest do.
    """

    square: Float64
    when: npt.NDArray[np.int32]
    high: Float64
    low: Float64

    @classmethod
    def zero(cls, elements: int, cases: int = 1) -> "Extremes":
        """Extremes before the first instant."""
        shape = (elements, cases)
        return cls(
            square=np.zeros(shape),
            when=np.zeros(shape, np.int32),
            high=np.zeros(shape),
            low=np.zeros(shape),
        )

    @property
    def equivalent(self) -> Float64:
        """(e, c) largest equivalent stress, Pa."""
        return np.sqrt(self.square)

    def take(self, elements: slice, cases: slice = slice(None)) -> "Extremes":
        """Views of some elements and load cases."""
        return Extremes(
            square=self.square[elements, cases],
            when=self.when[elements, cases],
            high=self.high[elements, cases],
            low=self.low[elements, cases],
        )


@dataclass(frozen=True, kw_only=True)
class StressMaps:
    """How stresses follow from displacements.

    Attributes:
        rows: all parts.
        maps: of each, its rows on extended vectors.
        extension: of vectors of the free set.
    """

    rows: tuple[StressRows, ...]
    operators: tuple[sp.csr_matrix, ...] = field(repr=False)
    extension: Extension = field(repr=False)

    def of(self, displacement: Float64) -> list[Float64]:
        """Per part, (e per_element, ...) rows under displacements (f, ...)."""
        extended = self.extension.extended(displacement)
        return [np.asarray(operator @ extended) for operator in self.operators]

    def maps(self) -> tuple[Map, ...]:
        """The operators as kernels take them."""
        return tuple(
            operator
            if rows.kind == "other"
            else DenseRows.from_sparse(operator, rows.size)
            for rows, operator in zip(self.rows, self.operators)
        )


def stress_maps(stresses: Stresses) -> StressMaps:
    """All parts, those that are sheets or lines recognised as such."""
    extension = Extension.from_expansion(stresses.expand)
    found = [_recognised(part) for part in stresses.parts]
    return StressMaps(
        rows=tuple(rows for rows, _ in found),
        operators=tuple(extension.rows(operator) for _, operator in found),
        extension=extension,
    )


def starts(rows: Sequence[StressRows]) -> Int64:
    """(p,) position of the first element of each part."""
    return np.cumsum([0, *(r.size for r in rows)])[:-1]


def _recognised(part: StressPart) -> tuple[StressRows, sp.csr_matrix]:
    """Its kind, and its rows on the g-set."""
    total, _ = shape_of(part.operator)
    per_element = total // max(len(part.id), 1)
    for kind, turn, isotropic in _candidates(part, per_element):
        rows = StressRows(
            kind=kind,
            part=part,
            isotropic=isotropic,
            per_element=per_element if turn is None else len(turn),
        )
        if _agrees(rows, per_element, turn):
            if turn is None:
                return rows, part.operator
            every = sp.kron(sp.identity(len(part.id)), sp.csr_matrix(turn))
            return rows, sp.csr_matrix(every @ part.operator)
    every = np.ones(len(part.id), bool)
    rows = StressRows(kind="other", part=part, isotropic=every, per_element=per_element)
    return rows, part.operator


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
    yield "line", None, np.ones(e, bool)


def _agrees(rows: StressRows, k: int, turn: Float64 | None) -> bool:
    """Whether the kernel finds what the part's own functions find."""
    rng = np.random.default_rng(0)
    part, state = rows.part, Extremes.zero(rows.size)
    linear = rng.standard_normal((rows.size, k, 3))
    given = linear if turn is None else np.einsum("pk,ekt->ept", turn, linear)
    sigma = np.ascontiguousarray(given.reshape(-1, 3))
    rows.of_rows(sigma, slice(0, rows.size), 0, state, 0)
    flat = linear.reshape(-1, 3).T
    own = [np.asarray(p.evaluate(flat[:, p.rows])) for p in part.pieces]
    expected = np.concatenate(own, axis=1) if own else np.zeros((3, 0, 3))
    found = state.equivalent[:, 0]
    wanted = expected[..., 0].max(axis=0)
    scale = np.abs(wanted).max(initial=1.0)
    same = np.abs(found - wanted).max(initial=0.0) <= _SAME * scale
    high = np.maximum(expected[..., 1].max(axis=0), 0.0)
    missed = np.abs(state.high[:, 0] - high).max(initial=0.0)
    return bool(same and missed <= _SAME * scale)


def _other(
    rows: StressRows, sigma: Float64, elements: slice, first: int, own: Extremes
) -> None:
    """Extremes of one load case by the part's own functions, of whole pieces."""
    found = []
    offset = elements.start * rows.per_element
    for piece in rows.part.pieces:
        if elements.start <= piece.elements.start < elements.stop:
            at = slice(piece.rows.start - offset, piece.rows.stop - offset)
            found.append(piece.evaluate(np.asarray(sigma[at].T, float)))
    values = np.concatenate(found, axis=1)
    best = values[..., 0].argmax(axis=0)
    equivalent = np.take_along_axis(values[..., 0], best[None], axis=0).T ** 2
    better = equivalent > own.square
    np.copyto(own.square, equivalent, where=better)
    np.copyto(own.when, first + best[:, None], where=better, casting="unsafe")
    np.maximum(own.high, values[..., 1].max(axis=0)[:, None], out=own.high)
    np.minimum(own.low, values[..., 2].min(axis=0)[:, None], out=own.low)
