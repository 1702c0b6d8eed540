"""Where the feet of connectors stand: piercing points, from the words of the cards.

The piercing point of a side is its grid GA or GB, else GS or XS YS ZS, moved to the
closest point of the side's surface. A point whose closest one lies more than half the
diameter beside the surface pierces nothing.

One point P for both sides pierces surfaces that are not parallel in the middle of two
ways: A in the middle of its closest point to P, and that to the point of B closest to
P; B likewise. The guide does not say so; a commercial solver's displacements of its
feet show it: to 1e-6 of the gap on a plane surface, 2e-3 on a warped one across.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.references import where
from fem.elements.connectors.feet import (
    Foot,
    on_grid,
    square_about,
    through_element,
    through_square,
)
from fem.elements.connectors.surfaces import (
    Spots,
    Surfaces,
    natural_of,
    normals,
    read_surfaces,
)
from fem.errors import Problems, nearest
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_PROPERTIES, _PATCHES = ("PROP", "PARTPAT"), ("ELEM", "ELPAT")
_SHORT = 1e-6  # of the diameter: feet that coincide
_BESIDE = 1e-3  # of the diameter: as good as on the element


@dataclass(frozen=True, kw_only=True)
class Placed:
    """Connectors with their feet.

    Attributes:
        feet: one pair per card.
        surfaces: the shells of the deck.
        elements: (e, 2) positions of the shells that the feet stand on, -1: none.
    """

    feet: list[tuple[Foot, Foot]]
    surfaces: Surfaces
    elements: Int64


def place_connectors(
    deck: "Deck", points: Points, rows: pd.DataFrame, card: str, diameter: Float64
) -> Placed:
    """Feet of connectors.

    Args:
        deck: the deck.
        points: its points.
        rows: cards with form, gs, ga, gb, xs, ys, zs, ida, idb and, for GRIDID, gas and
            gbs.
        card: their name.
        diameter: (e,) their diameters.

    Raises:
        InputError: sides that are not there, points that pierce nothing; all of them.
    """
    surfaces = read_surfaces(deck, points)
    problems = Problems()
    start = np.stack([_starts(points, rows, side) for side in "ab"])
    lost = np.isnan(start).any(axis=(0, 2)) & (rows["form"] != "ALIGN").to_numpy()
    problems += [
        f"{where(card, rows.iloc[i])}: no place, expected GS, GA and GB, or XS YS ZS"
        for i in np.flatnonzero(lost)
    ]
    problems.report()
    spots = []
    for side in (0, 1):
        found = _pierced(
            surfaces, rows, "ab"[side], start[side], diameter, card, problems
        )
        far = (found.beside > 0.5 * diameter * (1.0 + 1e-9)) & (found.element >= 0)
        problems += [
            f"{where(card, rows.iloc[i])}: its point for side {'AB'[side]} lies "
            f"{found.beside[i]:.4g} beside the surface (closest is element "
            f"{surfaces.id[found.element[i]]}), expected at most half the diameter, "
            f"{0.5 * diameter[i]:.4g}"
            for i in np.flatnonzero(far)
        ]
        spots.append(found)
    problems.report()
    spots = _between(surfaces, rows, start, spots, diameter, card)
    squares = [_squares(surfaces, rows, spots, side, diameter) for side in (0, 1)]
    elements = np.stack([spot.element for spot in spots], axis=1)
    feet = []
    for i, row in enumerate(rows.to_dict("records")):
        a, b = (
            _on_element(surfaces, spots[side], squares[side], i)
            if elements[i, side] >= 0
            else _elsewhere(points, row, "ab"[side], start[side, i])
            for side in (0, 1)
        )
        feet.append((a, b))
    return Placed(feet=feet, surfaces=surfaces, elements=elements)


def _starts(points: Points, rows: pd.DataFrame, side: str) -> Float64:
    """(e, 3) the points that are moved to a side, NaN where the card gives none."""
    found = np.array(rows[["xs", "ys", "zs"]], dtype=float)
    other = "b" if side == "a" else "a"
    # The last one counts.
    for name in (f"g{other}", "gs", f"g{side}"):
        grid = rows[name].to_numpy(np.int64)
        given = grid > 0
        if name == f"g{other}":
            given &= np.isnan(found).any(axis=1)
        found[given] = points.xyz[points.rows(grid[given])]
    return found


def _pierced(
    surfaces: Surfaces,
    rows: pd.DataFrame,
    side: str,
    start: Float64,
    diameter: Float64,
    card: str,
    problems: list[str],
) -> Spots:
    """Closest spots of a side; element -1 where the card names no surface for it."""
    form = rows["form"].to_numpy()
    ids = rows[f"id{side}"].to_numpy(np.int64)
    found = Spots.nowhere(len(rows))
    by_property = np.isin(form, _PROPERTIES)
    by_element = np.isin(form, (*_PATCHES, "ELEMID")) & (ids > 0)
    for chosen, what, known in (
        (by_property, "property", surfaces.pid),
        (by_element, "element", surfaces.id),
    ):
        problems += [
            f"{where(card, rows.iloc[i])}: {what} {ids[i]} of side {side.upper()} is "
            "none of a shell" + nearest(str(ids[i]), list(map(str, np.unique(known))))
            for i in np.flatnonzero(chosen & ~np.isin(ids, known))
        ]
        chosen &= np.isin(ids, known)
    for pid in np.unique(ids[by_property]):
        own = np.flatnonzero(by_property & (ids == pid))
        found.put(own, surfaces.closest(start[own], surfaces.of_property(pid)))
    own = np.flatnonzero(by_element)
    at = np.searchsorted(surfaces.id, ids[own])
    found.put(own, surfaces.closest_of(start[own], at[:, None]))
    # A patch goes on beyond its element.
    goes_on = (form[own] != "ELEMID") & (found.beside[own] > _BESIDE * diameter[own])
    own, at = own[goes_on], at[goes_on]
    if len(own):
        found.put(own, surfaces.closest_of(start[own], surfaces.around(at)))
    return found


def _between(
    surfaces: Surfaces,
    rows: pd.DataFrame,
    start: Float64,
    spots: list[Spots],
    diameter: Float64,
    card: str,
) -> list[Spots]:
    """Spots of both sides, in the middle of the two ways from one point to them."""
    one = np.all(start[0] == start[1], axis=1)
    one &= (spots[0].element >= 0) & (spots[1].element >= 0)
    own = np.flatnonzero(one)
    if not len(own):
        return spots
    chosen, size = rows.iloc[own], diameter[own]
    places = [spots[side].place[own] for side in (0, 1)]
    for side in (0, 1):
        letter, other = "ab"[side], places[1 - side]
        through = _pierced(surfaces, chosen, letter, other, size, card, []).place
        middle = 0.5 * (places[side] + through)
        moved = _pierced(surfaces, chosen, letter, middle, size, card, [])
        spots[side].put(own, moved)
    return spots


def _squares(
    surfaces: Surfaces,
    rows: pd.DataFrame,
    spots: list[Spots],
    side: int,
    diameter: Float64,
) -> dict[int, Spots]:
    """The four spots of each foot that stands on a square, by its position."""
    form = rows["form"].to_numpy()
    chosen = np.flatnonzero(np.isin(form, (*_PROPERTIES, *_PATCHES)))
    if not len(chosen):
        return {}
    element, place = spots[side].element[chosen], spots[side].place[chosen]
    axis = spots[1].place[chosen] - spots[0].place[chosen]
    short = np.linalg.norm(axis, axis=1) < _SHORT * diameter[chosen]
    axis[short] = normals(surfaces.corners[element[short]])
    corners = [square_about(p, a, d) for p, a, d in zip(place, axis, diameter[chosen])]
    near = surfaces.around(element)
    # A square of a property stays on it.
    strange = surfaces.pid[near] != surfaces.pid[element][:, None]
    strange &= np.isin(form[chosen], _PROPERTIES)[:, None]
    near = np.where(strange, element[:, None], near)
    found = surfaces.closest_of(np.concatenate(corners), np.repeat(near, 4, axis=0))
    return {int(i): found.of(slice(4 * k, 4 * k + 4)) for k, i in enumerate(chosen)}


def _on_element(
    surfaces: Surfaces, spots: Spots, squares: dict[int, Spots], i: int
) -> Foot:
    """Foot i of those that stand on shells of the deck."""
    element = int(spots.element[i])
    square = squares.get(i)
    if square is not None:
        foot = through_square(
            surfaces, element, spots.place[i], square.element, square.natural
        )
        if foot is not None:
            return foot
    at, corners = surfaces.at[element], surfaces.corners[element]
    return through_element(at, corners, spots.natural[i])


def _elsewhere(points: Points, row: dict, side: str, start: Float64) -> Foot:
    """A foot on a grid (ALIGN, from a point to a patch), or on grids of the card."""
    grids = np.asarray(row[f"g{side}s"], np.int64)
    if not len(grids):
        other = row["gs"] or row[f"g{side}"]
        grid = row[f"g{side}"] if row["form"] == "ALIGN" else other
        return on_grid(int(points.rows(int(grid))), points.xyz)
    at = points.rows(grids[[0, 1, 2, -1]])
    natural, _ = natural_of(start, points.xyz[at])
    return through_element(at, points.xyz[at], natural)
