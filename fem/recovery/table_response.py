"""Results of a table of elements along a transient, chunk by chunk."""

from collections.abc import Callable

import scipy.sparse as sp

from fem.arrays import Float64
from fem.recovery.elements import ElementTable
from fem.response.observation import Chunk

Factors = Callable[[Float64], Float64]


class TableResponse:
    """A table turned to the freedoms of a transient.

    Args:
        table: which elements and results.
        expand: (g, n) g-set from the freedoms of the transient.
        case: load case.
        factors: factors (c, k, t) of loads on elements at times (t,); None: the table
            has none.
    """

    def __init__(
        self,
        table: ElementTable,
        expand: sp.csr_matrix,
        case: int = 0,
        factors: Factors | None = None,
    ) -> None:
        self.table, self._case = table, case
        self._factors = factors if table.of_loads is not None else None
        self._operator = sp.csr_matrix(table.operator @ expand)
        self._rate = None if table.rate is None else sp.csr_matrix(table.rate @ expand)

    def values(self, chunk: Chunk) -> Float64:
        """(m, e, c) results at the times of a chunk."""
        return self.table.evaluate(self.linear(chunk))

    def linear(self, chunk: Chunk) -> Float64:
        """(m, r) linear quantities at the times of a chunk."""
        linear = chunk.get("displacement", self._operator)[:, self._case]
        if self._rate is not None:
            linear = linear + chunk.get("velocity", self._rate)[:, self._case]
        if self._factors is not None and self.table.of_loads is not None:
            factors = self._factors(chunk.time)
            case = self._case if len(factors) > 1 else 0
            linear = linear + (self.table.of_loads @ factors[case]).T
        return linear
