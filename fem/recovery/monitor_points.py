"""Monitor points of a deck: loads summed about a point, along the axes of a frame.

MONPNT1 sums what acts from outside on the grids of a component (AECOMP, AECOMPL of
SET1): applied loads, inertia, damping of the masses. With all grids outboard of a
station it is the section load there.

MONPNT3 sums grid point forces. At the grids of GRIDSET the forces A of the elements
of ELEMSET, C of all other elements, and B of everything else balance, A + B + C = 0.
A blank XFLAG gives A + B = -C, XFLAG SMAD gives A (MSC Nastran's guide).
Forces of elements are elastic ones, -K u, as there.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
import scipy.sparse as sp

from fem.arrays import Float64, Int64
from fem.elements.block import ElementBlock
from fem.errors import InputError
from fem.geometry.points import Points, grid_freedoms
from fem.model.structure import Structure
from fem.recovery.grid_forces import grid_balance

NAMES = ("F1", "F2", "F3", "M1", "M2", "M3")
_ELASTIC = frozenset("SMAD")  # XFLAG that leaves the elements of ELEMSET alone


@dataclass(frozen=True, kw_only=True, eq=False)
class MonitorPoint:
    """A monitor point.

    Attributes:
        card: MONPNT1 or MONPNT3.
        name, label: of the card.
        point: (3,) that moments refer to, basic frame.
        frame: CD.
        rotation: (3, 3) axes of CD there, as columns, basic frame.
        axes: 0 to 5, which of force and moment along these axes are wanted.
        grids: (g,) rows of the grids that are summed.
        outside: (6, g) force and moment along CD of forces on the g-set (MONPNT1).
        elastic: (6, g) the same of displacements of the g-set (MONPNT3).
    """

    card: str
    name: str
    label: str
    point: Float64
    frame: int
    rotation: Float64
    axes: tuple[int, ...]
    grids: Int64 = field(repr=False)
    outside: sp.csr_matrix | None = field(default=None, repr=False)
    elastic: sp.csr_matrix | None = field(default=None, repr=False)


@dataclass(frozen=True)
class MonitorPoints:
    """Monitor points of a deck, and why some cannot be summed."""

    points: tuple[MonitorPoint, ...] = ()
    notices: tuple[str, ...] = ()


def monitor_points(structure: Structure) -> MonitorPoints:
    """All monitor points of a deck, in its order."""
    found, notices = [], []
    for card, build in (("MONPNT1", _of_component), ("MONPNT3", _of_elements)):
        for row in structure.deck.cards[card].to_dict("records"):
            place = f"{row['file']}:{row['line']}: {card} {row['name']}"
            try:
                found.append(build(structure, row))
            except InputError as error:
                notices += [f"{place}: not summed: {text}" for text in error.problems]
    return MonitorPoints(tuple(found), tuple(notices))


def _of_component(structure: Structure, row: Mapping) -> MonitorPoint:
    """MONPNT1."""
    points = structure.points
    ids = _component(structure, row["comp"], ())
    rows = _known(points, ids)
    head = _head(structure, "MONPNT1", row, rows)
    outside = _resultant(points, rows, head["point"], head["rotation"])
    return MonitorPoint(**head, outside=outside)


def _of_elements(structure: Structure, row: Mapping) -> MonitorPoint:
    """MONPNT3."""
    points, flags = structure.points, frozenset(row["xflag"].upper())
    if flags and (missing := _ELASTIC - {"A" if f in "LP" else f for f in flags}):
        raise InputError(
            f"XFLAG {row['xflag']} leaves some kinds of forces ({''.join(missing)}) "
            "and not others; expected blank or SMAD"
        )
    rows = _known(points, _set(structure, row["gridset"]))
    inside = _set(structure, row["elemset"]) if row["elemset"] else np.zeros(0, int)
    head = _head(structure, "MONPNT3", row, rows)
    resultant = _resultant(points, rows, head["point"], head["rotation"])
    elastic = _forces(points, structure.blocks, points.grid_id[rows], inside, flags)
    return MonitorPoint(**head, elastic=sp.csr_matrix(resultant @ elastic))


def _forces(
    points: Points,
    blocks: list[ElementBlock],
    grids: Int64,
    inside: Int64,
    flags: frozenset[str],
) -> sp.csr_matrix:
    """(g, g) forces on the grids by displacements: A of `inside`, or -C of the rest."""
    none = np.zeros(len(points.grid_id), bool)
    balance = grid_balance(
        points, blocks, loaded=none, spc=none, mpc=none, wanted=grids
    )
    of_elements = balance.element_id > 0
    chosen = of_elements & (np.isin(balance.element_id, inside) == bool(flags))
    own = np.flatnonzero(chosen)
    entries = grid_freedoms(own)
    to = grid_freedoms(balance.at[own])
    gather = sp.csr_matrix(
        (np.full(len(to), 1.0 if flags else -1.0), (to, np.arange(len(to)))),
        shape=(points.size, len(to)),
    )
    return sp.csr_matrix(gather @ balance.elements[entries])


def _head(structure: Structure, card: str, row: Mapping, rows: Int64) -> dict:
    frames = structure.points.frames
    given = np.array([[row["x1"], row["x2"], row["x3"]]], float)
    point = frames.to_basic(np.array([row["cp"]]), given)
    rotation = frames.triads(np.array([row["cd"]]), point)[0]
    return {
        "card": card,
        "name": row["name"],
        "label": row["label"],
        "point": point[0],
        "frame": int(row["cd"]),
        "rotation": rotation,
        "axes": tuple(sorted({int(c) - 1 for c in row["axes"] if c != "0"})),
        "grids": rows,
    }


def _component(
    structure: Structure, name: str, within: tuple[str, ...]
) -> Iterator[int]:
    """Grids of an AECOMP, or of the components of an AECOMPL.

    Raises:
        InputError: it is not there, is aerodynamic, or refers to itself.
    """
    table = structure.deck.cards["AECOMP"]
    found = table[table["name"] == name]
    if found.empty or name in within:
        what = "refers to itself" if name in within else "is not in the deck"
        raise InputError(f"AECOMP {name} {what}")
    row = found.iloc[0]
    if row["type"] == "AECOMPL":
        for member in row["lists"]:
            yield from _component(structure, member, (*within, name))
    elif row["type"] == "SET1":
        for text in row["lists"]:
            yield from _set(structure, int(text))
    else:
        raise InputError(
            f"AECOMP {name} is of {row['type']}: there are no aerodynamic loads here; "
            "expected SET1"
        )


def _set(structure: Structure, number: int) -> Int64:
    """(n,) ids of a SET1.

    Raises:
        InputError: it is not there.
    """
    table = structure.deck.cards["SET1"]
    found = table[table["sid"] == number]
    if found.empty:
        raise InputError(f"SET1 {number} is not in the deck")
    return np.unique(np.concatenate([np.array(ids, int) for ids in found["ids"]]))


def _known(points: Points, ids: Iterator[int] | Int64) -> Int64:
    """Rows of those ids that are grids; others count for nothing, as in Nastran.

    Raises:
        InputError: none is.
    """
    rows = np.flatnonzero(np.isin(points.grid_id, list(ids)))
    if not len(rows):
        raise InputError("none of its grids is in the model")
    return rows


def _resultant(
    points: Points, rows: Int64, point: Float64, rotation: Float64
) -> sp.csr_matrix:
    """(6, g) force and moment about a point, along axes, of forces on the g-set."""
    arm = points.xyz[rows] - point
    maps = np.zeros((len(rows), 6, 6))
    maps[:] = np.eye(6)
    maps[:, 3:, :3] = np.cross(np.eye(3), arm[:, None, :]).transpose(0, 2, 1) * -1.0
    turn = np.zeros((6, 6))
    turn[:3, :3] = turn[3:, 3:] = rotation.T
    own = np.zeros_like(maps)
    own[:, :3, :3] = own[:, 3:, 3:] = points.rotation[rows]
    values = turn @ maps @ own
    column = 6 * rows[:, None, None] + np.arange(6)
    row, column = np.broadcast_arrays(np.arange(6)[:, None], column)
    return sp.csr_matrix(
        (values.ravel(), (row.ravel(), column.ravel())), shape=(6, points.size)
    )
