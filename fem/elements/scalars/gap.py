"""CGAP as Nastran's linear solutions have it: the springs of its state at the start.

Closed (U0 <= 0): KA along the line, KT across it; open: KB along the line. It pulls as
it pushes; `gap_notices` says so.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Float64
from fem.deck.records.connectors import GAP_FORCE
from fem.deck.references import column, refer, table
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock
from fem.elements.lines.line_geometry import congruence
from fem.elements.scalars.bush import place_between
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_OPEN = 1e-14  # default of KB over KA


@dataclass(frozen=True, kw_only=True)
class Gaps(DenseBlock):
    """All CGAP elements; 12 freedoms, basic axes.

    Attributes:
        motion: (e, 3, 12) motion of GB relative to GA along the element axes.
        k: (e, 3) stiffness along them.
    """

    motion: Float64
    k: Float64

    def stiffness(self) -> Float64:
        """(e, 12, 12) of a gap as it is at the start."""
        return congruence(self.motion, self.k[:, :, None] * np.eye(3))

    def forces(self) -> Recovery:
        """Pressing force, shear forces, shortening and slips, as Nastran prints."""
        shortening = -self.motion
        force = self.k[:, :, None] * shortening
        matrix = np.concatenate([force, shortening], axis=1)
        return Recovery(table=self.card, columns=GAP_FORCE, matrix=matrix, id=self.id)


def read_cgap(deck: "Deck", points: Points) -> list[Gaps]:
    """The CGAP block of a deck, or none.

    Raises:
        InputError: undefined references, element axes that are not defined.
    """
    rows = table(deck, "CGAP").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    values = refer(rows, "CGAP", "pid", table(deck, "PGAP"), "PGAP")
    dof, motion = place_between(rows.assign(s=0.5), "CGAP", points)
    ka = column(values, "ka")
    kb, kt = values["kb"].to_numpy(float), values["kt"].to_numpy(float)
    closed = column(values, "u0") <= 0.0
    along = np.where(closed, ka, np.where(np.isnan(kb), _OPEN * ka, kb))
    across = np.where(np.isnan(kt), column(values, "mu1") * ka, kt)
    across = np.where(closed, across, 0.0)
    return [
        Gaps(
            card="CGAP",
            id=rows["eid"].to_numpy(np.int64),
            dof=dof,
            motion=motion[:, :3],
            k=np.stack([along, across, across], axis=1),
        )
    ]


def gap_notices(deck: "Deck") -> list[str]:
    """Notice that gaps stay as they are at the start."""
    count = len(table(deck, "CGAP"))
    if not count:
        return []
    return [
        f"CGAP ({count}): linear, as at the start: closed (U0 <= 0) with KA and KT, "
        "else open with KB; neither opens nor closes"
    ]
