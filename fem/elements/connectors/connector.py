"""Connectors as springs between two feet, at the middle between them.

A fastener (CFAST) has the stiffness that PFAST gives. A weld (CWELD) is a beam of
circular section, A = π D²/4, I = π D⁴/64, J = 2 I, whose strains are constant along its
length L (Timoshenko's, integrated at its middle), six springs there that do not know
each other:

    E A / L, G A / L twice, G J / L, E I / L twice.

So does a commercial solver's weld: a lap joint of L = D moves as these springs do to
six digits, where the beam's bending by its shear force, L³/12 E I, and the shear area
0.9 A would add 62 %. Where the effective length L_e differs from L, E and G are
multiplied by L / L_e (guide: L within 0.2 D and 5 D; SPOT: the mean thickness), so that
welds of no length have stiffness, too. Welds have no mass: in a frequency response
of the same solver, of a free body, the sheets alone balance the load to five digits.
"""

from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64
from fem.deck.records.connectors import WELD_FORCE
from fem.deck.records.scalars import BUSH_FORCE
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock, some
from fem.elements.lines.line_geometry import congruence


@dataclass(frozen=True, kw_only=True)
class Connectors(DenseBlock):
    """Connectors with feet on one number of freedoms, basic axes.

    Attributes:
        motion: (e, 6, n) motion of foot B less that of foot A, at the middle between
            them, along the element axes.
        feet: (e, 6, n) the feet's translations, basic axes: A, then B.
        k: (e, 6) stiffness along and about the element axes.
        length: (e,) distance of the feet.
        m: (e,) mass, half at each foot.
        ge: (e,) structural damping.
    """

    motion: Float64
    feet: Float64
    k: Float64
    length: Float64
    m: Float64
    ge: Float64

    def stiffness(self) -> Float64:
        """(e, n, n) of six springs between the feet."""
        return congruence(self.motion, self.k[:, :, None] * np.eye(6))

    def structural_damping(self) -> Float64 | None:
        """(e,) GE."""
        return some(self.ge)

    def mass(self, *, coupled: bool) -> Float64 | None:
        """(e, n, n) half at each foot."""
        if not np.any(self.m):
            return None
        half = 0.5 * self.m[:, None, None] * np.eye(6)
        return congruence(self.feet, half)

    def forces(self) -> Recovery:
        """Forces of fasteners as of CBUSH, of welds as of CBAR."""
        middle = self.k[:, :, None] * self.motion
        if self.card == "CFAST":
            columns, matrix = BUSH_FORCE, middle
        else:
            columns, matrix = WELD_FORCE, _of_beam(self.length) @ middle
        return Recovery(table=self.card, columns=columns, matrix=matrix, id=self.id)


def _of_beam(length: Float64) -> Float64:
    """(e, 8, 6) M1a M2a M1b M2b V1 V2 N T from forces and moments at the middle."""
    matrix = np.zeros((len(length), 8, 6))
    for row, sign in ((0, 1.0), (2, -1.0)):
        matrix[:, row, 5], matrix[:, row, 1] = 1.0, sign * 0.5 * length
        matrix[:, row + 1, 4], matrix[:, row + 1, 2] = -1.0, sign * 0.5 * length
    for row, column in ((4, 1), (5, 2), (6, 0), (7, 3)):
        matrix[:, row, column] = 1.0
    return matrix


def weld_stiffness(
    e: Float64, g: Float64, diameter: Float64, effective: Float64
) -> Float64:
    """(e, 6) springs of welds at their middle, along and about the element axes.

    Args:
        e, g: (e,) moduli.
        diameter: (e,) of the section.
        effective: (e,) L_e > 0.
    """
    area = 0.25 * np.pi * diameter**2
    inertia = area * diameter**2 / 16.0
    bend, torsion = e * inertia / effective, 2.0 * g * inertia / effective
    axial, shear = e * area / effective, g * area / effective
    return np.stack([axial, shear, shear, torsion, bend, bend], axis=1)
