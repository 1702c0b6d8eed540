"""The common part of all element blocks: what an element type has not, it omits."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from fem.arrays import Float64, Int64
from fem.elements.block import CENTER, Detail, Kind, Recovery


@dataclass(frozen=True, kw_only=True)
class DenseBlock:
    """An `ElementBlock` without stiffness, mass or damping, to be extended.

    Attributes:
        card: Nastran's name.
        id: (e,) element ids.
        dof: (e, n) rows of the g-set, -1 grounded.
        frame: axes of the element matrices, see `fem.elements.block`.
    """

    card: str
    id: Int64
    dof: Int64
    frame: Literal["basic", "displacement"] = "basic"

    @property
    def grid_dof(self) -> Int64:
        """(e, n) freedoms of the grids between which the element lies."""
        return self.dof

    def stiffness(self) -> Float64 | None:
        """(e, n, n), None: this element type has no stiffness."""
        return None

    def structural_damping(self) -> Float64 | None:
        """(e,) GE, None: no structural damping."""
        return None

    def mass(self, *, coupled: bool) -> Float64 | None:
        """(e, n, n), None: this element type has no mass."""
        return None

    def damping(self) -> Float64 | None:
        """(e, n, n), None: no viscous damping."""
        return None

    def differential_stiffness(
        self, motion: Float64, load: Float64 | None = None
    ) -> Float64 | None:
        """(e, n, n) what internal forces add to the stiffness; None: nothing.

        Args:
            motion: (e, n) displacements that strain the elements, of their freedoms.
            load: (e, n) loads that act on the elements between their grids (PLOAD1).
        """
        return None

    def expansion(self) -> Float64 | None:
        """(e, n) displacements of an element that expands freely, per degree.

        Of its freedoms, with which it has no stress; None: it does not expand.
        """
        return None

    def forces(self) -> Recovery | None:
        """No element forces."""
        return None

    def stresses(self) -> Recovery | None:
        """No element stresses."""
        return None

    def strains(self) -> Recovery | None:
        """No element strains."""
        return None

    def recovery(self, kind: Kind, detail: Detail = CENTER) -> Recovery | None:
        """`forces`, `stresses` or `strains`; most elements know one detail only."""
        if kind == "failure":
            return None
        if kind == "force":
            return self.forces()
        return self.stresses() if kind == "stress" else self.strains()

    def of_nodal_forces(self, kind: Kind, detail: Detail = CENTER) -> Float64 | None:
        """No loads between the grids."""
        return None


def some(values: Float64) -> Float64 | None:
    """The array, or None where all of it is zero."""
    return values if np.any(values) else None
