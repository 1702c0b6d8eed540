"""`Card`: all that the program knows of a card, but for the formulas of its element.

Layouts of the tables, checks of references, conversion of units, faces that carry
pressure, cells of ParaView, words of OP2 files, pictures and the tables of the
documentation draw from here.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal

from fem.deck.cards.conversions import Convert
from fem.deck.records.field import Field, layout
from fem.deck.text.fields import Fields
from fem.deck.text.lexer import RawCard

Row = dict[str, Any]
Pair = tuple[int, int]

_POINT, _LINE, _TRIANGLE, _QUAD = 1, 3, 5, 9  # cell types of VTK
_FLAT = {1: _POINT, 2: _LINE, 3: _TRIANGLE, 4: _QUAD}


@dataclass(frozen=True, kw_only=True)
class Topology:
    """How the grids of an element lie, numbered from 0 in the order of the card.

    Attributes:
        kind: "spring" joins grids without being a member of the structure.
        grids: columns with the grids, the corners first; `("nodes",)`: one of
            sequences.
        corners: their number.
        edges: their corners; the mid-side of edge k, where there is one, is grid
            corners + k.
        faces: their corners in turn, outward from solids.
        triangles: which grids name a triangular face of a solid besides G1 (PLOAD4):
            none, one more of the face at the base, or the corner that is not on it.
        cells: number of grids -> cell type of VTK; those without mid-sides are known.
        order: number of grids -> their order in VTK, where it differs.
    """

    kind: Literal["point", "spring", "line", "surface", "solid"]
    grids: tuple[str, ...]
    corners: int
    edges: tuple[Pair, ...] = ()
    faces: tuple[tuple[int, ...], ...] = ()
    triangles: Literal["alone", "base", "opposite"] = "alone"
    cells: Mapping[int, int] = field(default_factory=dict)
    order: Mapping[int, Sequence[int]] = field(default_factory=dict)

    def cell(self, count: int) -> int | None:
        """VTK's type of an element with that many grids, None where there is none."""
        flat = None if self.kind == "solid" else _FLAT.get(count)
        return self.cells.get(count, flat)

    def middle(self, a: int, b: int) -> int:
        """Position of the mid-side between two corners."""
        edge = (a, b) if (a, b) in self.edges else (b, a)
        return self.corners + self.edges.index(edge)


@dataclass(frozen=True, kw_only=True)
class Op2:
    """The element in OP2 files; arrangements of words see `fem.files.op2_elements`.

    Attributes:
        type: Nastran's element type.
        corners: that of results with the corners, where it differs.
        plies: that of results of plies.
        force, stress: arrangement of the words; "" where there are no such results.
    """

    type: int
    corners: int = 0
    plies: int = 0
    force: str = ""
    stress: str = ""


@dataclass(frozen=True, kw_only=True)
class Result:
    """One table of results.

    Attributes:
        kinds: "force", "stress", ...; those after the first have like columns.
        columns: of one point, in Nastran's order.
        table: what its name has after that of the card.
        remark: at which points, when.
    """

    kinds: tuple[str, ...]
    columns: tuple[str, ...]
    table: str = ""
    remark: str = ""


@dataclass(frozen=True, kw_only=True)
class Element:
    """What an element of a card is.

    Attributes:
        reader: "module:function" below `fem.elements` that makes its blocks; "" where
            they come with those of another card.
        topology: None for elements of no shape.
        op2: None: not in OP2 files.
        results: tables of results.
    """

    reader: str = ""
    topology: Topology | None = None
    op2: Op2 | None = None
    results: tuple[Result, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Card:
    """One card.

    Attributes:
        name: as in the deck.
        group: of the documentation.
        fields: those at fixed places (see `field`); "" for cards that are read by one
            of the next three.
        read: rows from the fields of a card of irregular shape.
        extract: rows from pyNastran's object for it.
        gather: rows from all cards of that name.
        finish: last touches on the columns of regular cards, in place; problems are
            appended.
        more: columns of the table besides `fields`.
        table: the card whose table it joins; "": its own.
        ids: cards with the same word here share their ids, which must be unique;
            "own": they share them with none.
        load: a load, or what selects one in time: no part of the model.
        convert: conversion of units that is no mere factor.
        extent: what non-structural mass on a property counts per.
        fills: a card whose blank fields it fills, and their indices.
        element: None: no element.
    """

    name: str
    group: str
    fields: str = ""
    read: Callable[[Fields], list[Row]] | None = None
    extract: Callable[[Any], list[Row]] | None = None
    gather: Callable[[Sequence[RawCard], list[str]], list[Row]] | None = None
    finish: Callable[[dict[str, list], list[str]], None] | None = None
    more: str = ""
    table: str = ""
    ids: str = ""
    load: bool = False
    convert: Convert | None = None
    extent: Literal["", "length", "area"] = ""
    fills: tuple[str, tuple[int, ...]] | None = None
    element: Element | None = None

    @property
    def readable(self) -> bool:
        """A deck may have it (else it is a table that other cards join)."""
        return bool(self.fields or self.read or self.extract or self.gather)

    @property
    def has_table(self) -> bool:
        """It has a table of its own."""
        return not self.table and self.fills is None

    @cached_property
    def columns(self) -> dict[str, Field]:
        """Columns of its table but for `file` and `line`; those of an id first."""
        own, more = layout(self.fields), layout(self.more)
        every = (*own.fixed, *own.repeated, *more.fixed)
        return {item.name: item for item in every if item.kind != "-"}

    @property
    def topology(self) -> Topology | None:
        """Topology of its element; None: it is no element, or has no shape."""
        return self.element.topology if self.element else None
