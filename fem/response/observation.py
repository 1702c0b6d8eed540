"""What is kept of a transient: observers receive the response chunk by chunk.

A chunk knows displacements, velocities and accelerations of the free set at some
output times and gives them row-wise or through a sparse operator, so that an observer
of a few points never forms whole vectors, and an envelope never keeps a history.
"""

from collections.abc import Sequence
from typing import Literal, Protocol

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.algebra.sparse_products import shape_of
from fem.arrays import Float64

Quantity = Literal["displacement", "velocity", "acceleration"]
QUANTITIES: tuple[Quantity, ...] = ("displacement", "velocity", "acceleration")


class Chunk(Protocol):
    """Consecutive output times of a transient.

    Attributes:
        first: index of its first time among all output times.
        time: (m,) s.
    """

    @property
    def first(self) -> int: ...
    @property
    def time(self) -> Float64: ...

    def get(self, quantity: Quantity, operator: sp.csr_matrix | None = None) -> Float64:
        """Response (m, c, n) of c load cases, or (m, c, r) by an operator (r, n)."""
        ...


class Observer(Protocol):
    """Receives a transient."""

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Before the first chunk: all output times, load cases, order of the system."""
        ...

    def observe(self, chunk: Chunk) -> None:
        """Take from a chunk what is wanted; its arrays are reused afterwards.

        It is called in another thread than `begin`, one chunk after the other. What the
        chunk gives may be a view of its arrays: it must not be written to.
        """
        ...

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Memory that will be held at the end."""
        ...


class Observation:
    """History of one quantity of some rows, or of linear combinations of rows.

    Args:
        quantity: "displacement", "velocity" or "acceleration".
        operator: (r, n) sparse rows, see `Structure.operator`; None: all n freedoms.

    Attributes:
        time: (t,) s, output times.
        values: (t, c, r); `history` drops c where there is one load case.
    """

    def __init__(
        self, quantity: Quantity, operator: sp.spmatrix | sp.sparray | None = None
    ) -> None:
        if quantity not in QUANTITIES:
            raise ValueError(f"quantity '{quantity}' is unknown, expected {QUANTITIES}")
        self.quantity: Quantity = quantity
        self.operator = None if operator is None else sp.csr_matrix(operator)
        self.time: Float64 = np.zeros(0)
        self.values: Float64 = np.zeros((0, 0, 0))

    @property
    def history(self) -> Float64:
        """(t, r) of a single load case, (t, c, r) of several."""
        return self.values[:, 0] if self.values.shape[1] == 1 else self.values

    def _rows(self, size: int) -> int:
        return size if self.operator is None else len(self.operator.indptr) - 1

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Reserve memory; see `Observer`."""
        if self.operator is not None:
            _, columns = shape_of(self.operator)
            if columns != size:
                raise ValueError(f"operator has {columns} columns, expected {size}")
        self.time = time
        self.values = np.zeros((len(time), cases, self._rows(size)))

    def observe(self, chunk: Chunk) -> None:
        """Copy the rows of a chunk; see `Observer`."""
        part = chunk.get(self.quantity, self.operator)
        self.values[chunk.first : chunk.first + len(chunk.time)] = part

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Bytes of the history."""
        return 8 * times * cases * self._rows(size)


class StateChunk:
    """Chunk of an integrator that keeps u, v and a themselves.

    Args:
        first: index of the first time.
        time: (m,) s.
        arrays: (m, c, n) of each quantity.
    """

    def __init__(
        self, first: int, time: Float64, arrays: dict[Quantity, Float64]
    ) -> None:
        self.first = first
        self.time = time
        self._arrays = arrays

    def get(self, quantity: Quantity, operator: sp.csr_matrix | None = None) -> Float64:
        """Response through an operator; see `Chunk`."""
        return apply_operator(self._arrays[quantity], operator)


class DifferenceChunk:
    """Chunk of displacements at equal steps; the rest are central differences.

    Args:
        first: index of the first output time.
        time: (m,) s.
        window: (w, c, n) displacements at consecutive steps.
        at: (m,) positions of the output times in the window, inner ones.
        step: time step, s.
        initial_velocity: (c, n) velocity at the first time where it is given, not
            differenced.
        before: the chunk before, and how many rows at the end of its window are those
            at the begin of this one.
    """

    def __init__(
        self,
        first: int,
        time: Float64,
        window: Float64,
        at: npt.NDArray[np.intp],
        step: float,
        initial_velocity: Float64 | None,
        before: tuple["DifferenceChunk", int] | None = None,
    ) -> None:
        self.first = first
        self.time = time
        self._window = window
        self._at = at
        self._step = step
        self._initial_velocity = initial_velocity
        # By id, with the operator: a strong reference keeps its id from reuse.
        self._projected: _Projections = {}
        self._earlier: _Projections = {} if before is None else before[0]._projected
        self._shared = 0 if before is None else before[1]

    def _rows(self, operator: sp.csr_matrix | None) -> Float64:
        """The window through an operator; what the chunk before has is not repeated."""
        if operator is None:
            return self._window
        if len(operator.indptr) - 1 > self._window.shape[2]:
            return apply_operator(self._window, operator)  # too long to be kept
        if id(operator) not in self._projected:
            found = []
            if id(operator) in self._earlier:
                found.append(self._earlier[id(operator)][1][-self._shared :])
            new = self._window[self._shared if found else 0 :]
            found.append(apply_operator(new, operator))
            self._projected[id(operator)] = operator, np.concatenate(found)
        return self._projected[id(operator)][1]

    def get(self, quantity: Quantity, operator: sp.csr_matrix | None = None) -> Float64:
        """Response through an operator; see `Chunk`."""
        rows, at, h = self._rows(operator), self._at, self._step
        if quantity == "displacement":
            even = len(at) > 0 and at[-1] - at[0] == len(at) - 1
            return rows[at[0] : at[-1] + 1] if even else rows[at]
        if quantity == "acceleration":
            return (rows[at + 1] - 2.0 * rows[at] + rows[at - 1]) / (h * h)
        velocity = (rows[at + 1] - rows[at - 1]) / (2.0 * h)
        if self._initial_velocity is not None and len(velocity):
            velocity[0] = apply_operator(self._initial_velocity[None], operator)[0]
        return velocity


_Projections = dict[int, tuple[sp.csr_matrix, Float64]]
_TOGETHER = 32  # vectors that a matrix multiplies at a time
_TILE = 512  # of their entries that are turned at a time


def apply_operator(vectors: Float64, operator: sp.csr_matrix | None) -> Float64:
    """Rows (m, c, r) of an operator (r, n) on vectors (m, c, n)."""
    if operator is None:
        return vectors
    m, c, n = vectors.shape
    flat = vectors.reshape(m * c, n)
    if operator.nnz < n:
        # Few columns: gather them instead of copying whole vectors.
        columns = np.unique(operator.indices)
        compressed = operator[:, columns]
        return (compressed @ flat[:, columns].T).T.reshape(m, c, -1)
    out = np.empty((m * c, len(operator.indptr) - 1))
    for start in range(0, m * c, _TOGETHER):
        part = slice(start, min(start + _TOGETHER, m * c))
        out[part] = (operator @ _turned(flat[part])).T
    return out.reshape(m, c, -1)


def _turned(vectors: Float64) -> Float64:
    """(n, c) of (c, n), contiguous, by tiles that stay in the cache."""
    c, n = vectors.shape
    out = np.empty((n, c))
    for start in range(0, n, _TILE):
        out[start : start + _TILE] = vectors[:, start : start + _TILE].T
    return out


def total_memory(
    observers: Sequence[Observer], times: int, cases: int, size: int
) -> int:
    """Bytes that observers will hold at the end of a transient."""
    return sum(o.memory_bytes(times, cases, size) for o in observers)
