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
from fem.deck.records import topologies
from fem.deck.references import table, where
from fem.elements.shells.shell_geometry import element_normals
from fem.geometry.points import Points
from fem.properties.shells import read_shell_properties

if TYPE_CHECKING:
    from fem.deck.deck import Deck

# Sine of the angle between x axis and normal: rounding; what is said.
_ROUNDING = 1e-12
_STEEP = 1e-3


def without_projection(direction: Float64, normal: Float64) -> Bool:
    """(e,) whether directions (e, 3) are along unit normals (e, 3); NaN is not."""
    return _sine(direction, normal) <= _ROUNDING


def _sine(direction: Float64, normal: Float64) -> Float64:
    across = np.linalg.norm(np.cross(direction, normal), axis=-1)
    return across / np.linalg.norm(direction, axis=-1)


def steep_systems(deck: "Deck", points: Points) -> list[str]:
    """Notices of elements whose material axis is almost normal to them, and counts."""
    found = [
        place
        for card, shape in topologies("surface").items()
        if "mcid" in deck.cards[card]
        for place in _steep(deck, points, card, shape.corners)
    ]
    if not found:
        return []
    least, first = min(found)
    return [
        f"the x axis of the material system (MCID) is almost normal to {len(found)} "
        f"elements ({first}: {least:.1e} rad off the normal, ...); its projection is "
        "taken, as Nastran does"
    ]


def _steep(
    deck: "Deck", points: Points, card: str, count: int
) -> Iterator[tuple[float, str]]:
    """Angle and place of such elements of one card, of so many corners, that are not
    isotropic.
    """
    rows = table(deck, card)
    rows = rows[rows["mcid"] >= 0]
    if rows.empty:
        return
    grids = rows[[f"g{k + 1}" for k in range(count)]].to_numpy(np.int64)
    corners = points.xyz[points.rows(grids)]
    mcid = rows["mcid"].to_numpy(np.int64)
    direction = points.frames.triads(mcid, corners.mean(axis=1))[:, :, 0]
    sine = _sine(direction, element_normals(corners))
    steep = (sine <= _STEEP) & (sine > _ROUNDING)
    rows, sine = rows[steep], sine[steep]
    properties = read_shell_properties(deck, rows["pid"].unique().tolist())
    for k, pid in enumerate(rows["pid"].tolist()):
        if not properties[pid].isotropic:
            yield float(sine[k]), where(card, rows.iloc[k])
