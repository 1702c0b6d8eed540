"""Which motion a time step is too large for, and what mends it."""

from dataclasses import dataclass

import numpy as np

from drake_landing.case.schema import Case
from drake_landing.parts.inventory import inventory
from fem.errors import InputError
from fem.model.structure import Structure


@dataclass(frozen=True, kw_only=True)
class StepCause:
    """The shape whose error is the largest share of that of an extreme.

    Attributes:
        frequency_hz: of the shape.
        steps: in a period of it.
        grid: that holds most of its kinetic energy.
        share: of the kinetic energy that it holds.
        slower: expected error of the extremes by slower shapes alone.
        component: at the grid, '' where it is not known.
    """

    frequency_hz: float
    steps: float
    grid: int
    share: float
    slower: float
    component: str = ""

    def __str__(self) -> str:
        where = f" ({self.component})" * bool(self.component)
        return (
            f"most of it by a motion at {self.frequency_hz:,.0f} Hz, of "
            f"{self.steps:.1f} steps a period, {self.share:.0%} of whose energy is at "
            f"grid {self.grid}{where}; by slower motions alone {self.slower:.1%}"
        )


def component_at(structure: Structure, case: Case, grid: int) -> str:
    """Component of the element that is next to a grid; '' without elements."""
    try:
        elements = inventory(structure, {}, case.parts.components).elements
    except InputError:  # said where components are looked at
        elements = inventory(structure, {}).elements
    if elements.empty:
        return ""
    at = structure.points.xyz[structure.points.rows([grid])[0]]
    away = np.linalg.norm(elements[["x", "y", "z"]].to_numpy(float) - at, axis=1)
    return str(elements.component.iloc[int(np.argmin(away))])
