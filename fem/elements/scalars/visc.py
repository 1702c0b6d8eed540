"""CVISC: axial and torsional dashpots along a line."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Float64
from fem.deck.records.lines import ROD
from fem.deck.references import column, refer, table
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock
from fem.elements.lines.rod import line_springs, unit_axes
from fem.geometry.points import Points, grid_freedoms

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class Viscous(DenseBlock):
    """All CVISC elements; 12 freedoms, basic axes.

    Attributes:
        axis: (e, 3) unit vectors.
        axial, torsional: (e,) force per velocity, moment per angular velocity.
    """

    axis: Float64
    axial: Float64
    torsional: Float64

    def damping(self) -> Float64:
        """(e, 12, 12) of an axial and a torsional dashpot."""
        return line_springs(self.axis, self.axial, self.torsional)

    def forces(self) -> Recovery:
        """Axial force and torque from velocities."""
        rate = np.zeros((len(self.id), 2, 12))
        for row, value in enumerate((self.axial, self.torsional)):
            along = value[:, None] * self.axis
            rate[:, row, 3 * row : 3 * row + 3] = -along
            rate[:, row, 6 + 3 * row : 9 + 3 * row] = along
        return Recovery(
            table=self.card,
            columns=ROD,
            matrix=np.zeros_like(rate),
            rate=rate,
            id=self.id,
        )


def read_cvisc(deck: "Deck", points: Points) -> list[Viscous]:
    """The CVISC block of a deck, or none.

    Raises:
        InputError: undefined references, elements without length.
    """
    rows = table(deck, "CVISC").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    values = refer(rows, "CVISC", "pid", table(deck, "PVISC"), "PVISC")
    ends = points.rows(rows[["g1", "g2"]].to_numpy(np.int64))
    between = points.xyz[ends[:, 1]] - points.xyz[ends[:, 0]]
    return [
        Viscous(
            card="CVISC",
            id=rows["eid"].to_numpy(np.int64),
            dof=grid_freedoms(ends),
            axis=unit_axes(rows, "CVISC", between)[0],
            axial=column(values, "ce"),
            torsional=column(values, "cr"),
        )
    ]
