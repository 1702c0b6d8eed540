"""Material systems of shells (MCID): the x axis projected onto the element.

Nastran projects whatever the angle: under the displacements of a foreign airframe whose
laminates have a system 6e-8 rad off their normal, in MSC's and in NX's file, the grids
of those elements are in balance with the projection of these digits and not with
another direction. Only an axis that is normal but for rounding has no projection.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Bool, Float64
from fem.deck.references import table, where
from fem.elements.shells.shell_geometry import element_normals
from fem.geometry.points import Points
from fem.properties.shells import read_shell_properties

if TYPE_CHECKING:
    from fem.deck.deck import Deck

# Sine of the angle between x axis and normal: rounding; what is said.
_ROUNDING = 1e-12
_STEEP = 1e-3
_CORNERS = {"CQUAD4": 4, "CTRIA3": 3, "CQUADR": 4, "CTRIAR": 3,
            "CQUAD8": 4, "CTRIA6": 3}  # fmt: skip


def without_projection(direction: Float64, normal: Float64) -> Bool:
    """(e,) whether directions (e, 3) are along unit normals (e, 3); NaN is not."""
    return _sine(direction, normal) <= _ROUNDING


def _sine(direction: Float64, normal: Float64) -> Float64:
    across = np.linalg.norm(np.cross(direction, normal), axis=-1)
    return across / np.linalg.norm(direction, axis=-1)


def steep_systems(deck: "Deck", points: Points) -> list[str]:
    """Notices of elements whose material axis is almost normal to them, and counts."""
    found = [place for card in _CORNERS for place in _steep(deck, points, card)]
    if not found:
        return []
    least, first = min(found)
    return [
        f"the x axis of the material system (MCID) is almost normal to {len(found)} "
        f"elements ({first}: {least:.1e} rad off the normal, ...); its projection is "
        "taken, as Nastran does"
    ]


def _steep(deck: "Deck", points: Points, card: str) -> Iterator[tuple[float, str]]:
    """Angle and place of such elements of one card that are not isotropic."""
    rows = table(deck, card)
    rows = rows[rows["mcid"] >= 0]
    if rows.empty:
        return
    grids = rows[[f"g{k + 1}" for k in range(_CORNERS[card])]].to_numpy(np.int64)
    corners = points.xyz[points.rows(grids)]
    mcid = rows["mcid"].to_numpy(np.int64)
    direction = points.frames.triads(mcid, corners.mean(axis=1))[:, :, 0]
    sine = _sine(direction, element_normals(corners))
    for i in np.flatnonzero((sine <= _STEEP) & (sine > _ROUNDING)):
        row = rows.iloc[i]
        pid = int(row["pid"])
        if not read_shell_properties(deck, [pid])[pid].isotropic:
            yield float(sine[i]), where(card, row)
