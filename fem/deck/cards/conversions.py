"""Conversions of units that are no mere factor of a column.

Each changes the table of a card in place. Units of a consistent deck follow from
length, mass and the second: force is mass times length over s².
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.errors import InputError


@dataclass(frozen=True)
class Units:
    """Units of a deck in SI.

    Attributes:
        length: m.
        mass: kg.
    """

    length: float
    mass: float

    @property
    def force(self) -> float:
        """N."""
        return self.mass * self.length

    @property
    def moment(self) -> float:
        """N m."""
        return self.force * self.length

    def factor(self, dimension: str) -> float:
        """Factor to SI of a dimension of a record.

        >>> f"{Units(length=0.001, mass=1000.0).factor('M/L3'):g}"  # t/mm³ in kg/m³
        '1e+12'
        """
        above, _, below = dimension.partition("/")
        return self._product(above) / self._product(below)

    def _product(self, text: str) -> float:
        size = {"M": self.mass, "L": self.length}
        factors = re.findall(r"([ML])(\d*)", text)
        return float(np.prod([size[unit] ** int(n or 1) for unit, n in factors]))


@dataclass(frozen=True)
class Context:
    """Facts of the deck that the conversion of a card may need.

    Attributes:
        card: its name.
        frames: coordinate system -> R, C or S.
        tables: all of the deck.
        extents: property card -> "length", "area" or "".
    """

    card: str
    frames: Mapping[int, str]
    tables: Mapping[str, pd.DataFrame]
    extents: Mapping[str, str]


Convert = Callable[[pd.DataFrame, Units, Context], None]


def grid(table: pd.DataFrame, units: Units, context: Context) -> None:
    """Coordinates in the frame CP."""
    _place(table, ("x1", "x2", "x3"), table["cp"], units, context)


def frame(table: pd.DataFrame, units: Units, context: Context) -> None:
    """Points of a coordinate system in the frame RID."""
    for p in "abc":
        _place(table, (f"{p}1", f"{p}2", f"{p}3"), table["rid"], units, context)


def _place(
    table: pd.DataFrame,
    columns: tuple[str, str, str],
    frame: pd.Series,
    units: Units,
    context: Context,
) -> None:
    """Coordinates: angles of cylindrical and spherical frames stay."""
    kind = frame.map(lambda cid: context.frames.get(cid, "R"))
    for column, lengths in zip(columns, ("RCS", "R", "RC")):
        table[column] *= np.where(kind.isin(list(lengths)), units.length, 1.0)


def corners(table: pd.DataFrame, units: Units, _: Context) -> None:
    """Thickness at corners; with TFLAG 1 it is a factor on that of the property."""
    factor = np.where(table["tflag"] == 1, 1.0, units.length)
    for column in ("t1", "t2", "t3", "t4"):
        if column in table:
            table[column] *= factor


def direct(table: pd.DataFrame, units: Units, context: Context, *, column: str) -> None:
    """CELAS2, CDAMP2, CMASS2."""
    table[column] *= _between(table, units)


def by_use(
    table: pd.DataFrame, units: Units, context: Context, *, column: str, user: str
) -> None:
    """PELAS, PDAMP, PMASS: the dimension is that of the elements that use them.

    Raises:
        InputError: elements between translations and between rotations share one.
    """
    used = context.tables[user]
    factor = pd.Series(_between(used, units), used["pid"]).groupby(level=0)
    kinds = factor.nunique()
    if mixed := kinds[kinds > 1].index.tolist():
        raise InputError(
            f"{context.card} {pid}: elements between translations and between "
            "rotations share it, so that its unit is not unique; give each its own"
            for pid in mixed
        )
    table[column] *= table["pid"].map(factor.first()).fillna(1.0)


def _between(table: pd.DataFrame, units: Units) -> Float64:
    """Factors of springs, dampers and masses by the freedoms at their ends.

    Raises:
        InputError: between a translation and a rotation, in no unit the same element.
    """
    first, second = (_rotation(table[c]) for c in ("c1", "c2"))
    first = np.where(table["g1"] == 0, second, first)  # ground is as the other end
    second = np.where(table["g2"] == 0, first, second)
    mixed = table[first != second]
    if len(mixed):
        raise InputError(
            f"{card} {eid}: between a translation (or a scalar point) and a rotation: "
            "its unit cannot be converted; give the deck in SI"
            for card, eid in zip(mixed["card"], mixed["eid"])
        )
    return units.mass * units.length ** (2.0 * first)


def _rotation(components: object) -> Float64:
    """1 where a component is a rotation, else 0; scalar points have component 0."""
    return (np.asarray(components, dtype=int) > 3).astype(float)


def bush(table: pd.DataFrame, units: Units, _: Context) -> None:
    """PBUSH: three translations, three rotations."""
    six = units.mass * np.repeat([1.0, units.length**2], 3)
    for column in ("ks", "bs"):
        table[column] = listed(table, [np.asarray(v) * six for v in table[column]])


def mass_matrix(table: pd.DataFrame, units: Units, _: Context) -> None:
    """CONM1, likewise."""
    six = np.repeat([1.0, units.length], 3)
    factor = units.mass * np.outer(six, six)
    table["ms"] = listed(table, [np.asarray(m) * factor for m in table["ms"]])


def general(table: pd.DataFrame, units: Units, _: Context) -> None:
    """GENEL: stiffness with a length for each rotation; S by the lengths of its sides.

    Scalar points count as translations.
    """
    stiffness, carried = [], []
    for k, s, comps in zip(table["k"], table["s"], table["comps"]):
        size = units.length ** _rotation(comps)
        own, other = size[: len(k)], size[len(k) :]
        stiffness.append(np.asarray(k) * units.mass * np.outer(own, own))
        shape = np.outer(1.0 / own, other)
        carried.append(np.asarray(s) * shape if np.size(s) else s)
    table["k"], table["s"] = listed(table, stiffness), listed(table, carried)


def equation(table: pd.DataFrame, units: Units, _: Context) -> None:
    """MPC: rotations count in lengths."""
    rows = zip(table["coefficients"], table["comps"])
    scaled = [np.asarray(a) * units.length ** _rotation(c) for a, c in rows]
    table["coefficients"] = listed(table, scaled)


def enforced(table: pd.DataFrame, units: Units, _: Context) -> None:
    """SPC: rotations have no dimension."""
    turned = table["c"].str.contains("[456]", regex=True)
    table["d"] = np.where(turned, table["d"], units.length * table["d"])


def matrix(table: pd.DataFrame, units: Units, _: Context) -> None:
    """DMIG: mass, times a length for each rotation among row and column.

    Scalar points count as translations. Rectangular ones (form 9, P2G) are forces.
    """
    rows = zip(table["values"], table["rowcs"], table["colcs"], table["form"])
    scaled = [
        np.asarray(v)
        * units.mass
        * units.length ** (_rotation(r) + (_rotation(c) if form != 9 else 1))
        for v, r, c, form in rows
    ]
    table["values"] = listed(table, scaled)


def strengths(table: pd.DataFrame, units: Units, _: Context) -> None:
    """MAT8: stresses, or with STRN 1 strains."""
    factor = np.where(table["strn"] == 1.0, 1.0, units.factor("M/L"))
    for column in ("xt", "xc", "yt", "yc", "s"):
        table[column] *= factor


def nonstructural(table: pd.DataFrame, units: Units, context: Context) -> None:
    """NSM: per area of surfaces, per length of lines.

    Raises:
        InputError: by ELEMENT, which may be either.
    """
    extent = table["type"].map(lambda kind: context.extents.get(kind, ""))
    unclear = table[extent == ""]
    if len(unclear):
        raise InputError(
            f"NSM {sid}: type {kind} may be per area or per length; give PSHELL, PBAR, "
            "... so that its unit is known"
            for sid, kind in zip(unclear["sid"], unclear["type"])
        )
    power = np.where(extent == "area", -2.0, -1.0)
    factor = units.mass * units.length**power
    scaled = [np.asarray(v) * f for v, f in zip(table["values"], factor)]
    table["values"] = listed(table, scaled)


def listed(table: pd.DataFrame | pd.Series, values: list) -> pd.Series:
    """A column of arrays."""
    column = np.empty(len(values), dtype=object)
    for i, value in enumerate(values):
        column[i] = value
    return pd.Series(column, table.index)
