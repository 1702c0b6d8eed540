"""CBUSH1D: a spring and a dashpot along a line; their linear part K and C.

The line runs from GA to GB, or along the x axis of CID. SHOCKA, SPRING, DAMPER and
GENER describe nonlinear solutions; linear ones take K and C, as Nastran does.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Float64
from fem.deck.records.connectors import AXIAL_FORCE, AXIAL_STRESS
from fem.deck.references import column, refer, table
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock
from fem.elements.lines.line_geometry import congruence
from fem.elements.scalars.bush import place_between
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class AxialBushings(DenseBlock):
    """All CBUSH1D elements; 12 freedoms, basic axes, -1 for the side of ground.

    Attributes:
        motion: (e, 1, 12) elongation.
        k, c: (e,) force per elongation and per its rate.
        m: (e,) mass, half to each grid.
        coefficients: (e, 2) SA, SE: stress per force, strain per elongation.
    """

    motion: Float64
    k: Float64
    c: Float64
    m: Float64
    coefficients: Float64

    def stiffness(self) -> Float64:
        """(e, 12, 12) of a spring along the line."""
        return congruence(self.motion, self.k[:, None, None])

    def damping(self) -> Float64 | None:
        """(e, 12, 12) of a dashpot along the line."""
        if not np.any(self.c):
            return None
        return congruence(self.motion, self.c[:, None, None])

    def mass(self, *, coupled: bool) -> Float64 | None:
        """(e, 12, 12) half of M at each end, translations."""
        if not np.any(self.m):
            return None
        translations = np.tile(np.repeat([1.0, 0.0], 3), 2)
        return 0.5 * self.m[:, None, None] * np.diag(translations)

    def forces(self) -> Recovery:
        """Force of the spring and, in transients, of the dashpot."""
        return self._recovery(AXIAL_FORCE, self.k, self.c)

    def stresses(self) -> Recovery:
        """Force times SA."""
        sa = self.coefficients[:, 0]
        return self._recovery(AXIAL_STRESS, sa * self.k, sa * self.c)

    def strains(self) -> Recovery:
        """Elongation times SE."""
        se = self.coefficients[:, 1]
        return self._recovery(AXIAL_STRESS, se, np.zeros_like(se))

    def _recovery(
        self, columns: tuple[str, ...], of_motion: Float64, of_rate: Float64
    ) -> Recovery:
        rate = of_rate[:, None, None] * self.motion if np.any(of_rate) else None
        return Recovery(
            table=self.card,
            columns=columns,
            matrix=of_motion[:, None, None] * self.motion,
            rate=rate,
            id=self.id,
        )


def read_cbush1d(deck: "Deck", points: Points) -> list[AxialBushings]:
    """The CBUSH1D block of a deck, or none.

    Raises:
        InputError: undefined references, element axes that are not defined.
    """
    rows = table(deck, "CBUSH1D").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    values = refer(rows, "CBUSH1D", "pid", table(deck, "PBUSH1D"), "PBUSH1D")
    unoriented = rows.assign(g0=0, x1=np.nan, x2=np.nan, x3=np.nan, s=0.5)
    dof, motion = place_between(unoriented, "CBUSH1D", points)
    return [
        AxialBushings(
            card="CBUSH1D",
            id=rows["eid"].to_numpy(np.int64),
            dof=dof,
            motion=motion[:, :1],
            k=column(values, "k"),
            c=column(values, "c"),
            m=column(values, "m"),
            coefficients=np.stack([column(values, n) for n in ("sa", "se")], axis=1),
        )
    ]
