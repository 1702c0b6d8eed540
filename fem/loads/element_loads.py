"""Loads on elements between their grids, as far as results of elements need them.

The forces of such an element are K_e u_e less the load that was brought to its grids:
the end forces of a clamped beam are added, as beam theory has it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64, Int64


@dataclass(frozen=True, kw_only=True)
class ElementLoads:
    """Loads of elements at their grids; an element may appear more than once.

    Attributes:
        id: (n,) elements.
        dof: (n, d) rows of the g-set.
        value: (n, d, k) loads of k patterns, displacement frames.
    """

    id: Int64
    dof: Int64
    value: Float64

    @property
    def patterns(self) -> int:
        """Number k of patterns."""
        return self.value.shape[2]

    def times(self, factor: float | Float64) -> "ElementLoads":
        """Multiplied by a number, or by an array that fits `value`."""
        return ElementLoads(id=self.id, dof=self.dof, value=factor * self.value)


def side_by_side(parts: Sequence[tuple[ElementLoads | None, int]]) -> ElementLoads:
    """Loads whose patterns follow each other.

    Args:
        parts: loads, or None for no such loads, and the number of their patterns.
    """
    total, start = sum(count for _, count in parts), 0
    pieces = [_NOTHING.times(np.zeros((1, 1, total)))]
    for loads, count in parts:
        if loads is not None:
            value = np.zeros((*loads.dof.shape, total))
            value[:, :, start : start + count] = loads.value
            pieces.append(ElementLoads(id=loads.id, dof=loads.dof, value=value))
        start += count
    return below_each_other(pieces)


def below_each_other(parts: Sequence[ElementLoads]) -> ElementLoads:
    """All loads of the same patterns."""
    return ElementLoads(
        id=np.concatenate([part.id for part in parts]),
        dof=np.concatenate([part.dof for part in parts]),
        value=np.concatenate([part.value for part in parts]),
    )


_NOTHING = ElementLoads(
    id=np.zeros(0, np.int64),
    dof=np.zeros((0, 12), np.int64),
    value=np.zeros((0, 12, 1)),
)
