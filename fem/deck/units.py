"""A deck in SI: every field times the units that its dimension is made of.

Units of a consistent deck follow from length, mass and the second: force is mass times
length over s². Only what makes the model is converted: loads are left out, since they
belong to solutions of the deck's own.

Dimensions are written m/n for mass^m length^n: "1/1" is mass times length. Columns that
are not named have none. Entries between freedoms (DMIG) have mass, times one length for
each rotation among the two; scalar points count as translations throughout.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.deck import Deck
from fem.errors import InputError, nearest

Frames = Mapping[int, str]


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
        """Of a dimension "m/n", mass^m length^n."""
        mass, length = map(int, dimension.split("/"))
        return self.mass**mass * self.length**length


_POUND_FORCE = 4.4482216152605  # N
_INCH = 0.0254  # m

SYSTEMS: dict[str, Units] = {
    "SI": Units(1.0, 1.0),
    "mm-t-N": Units(1e-3, 1e3),
    "in-lbf": Units(_INCH, _POUND_FORCE / _INCH),  # mass in lbf s²/in
}

_L, _A, _I = "0/1", "0/2", "0/4"
_MASS, _INERTIA = "1/0", "1/2"
_MODULUS, _DENSITY = "1/-1", "1/-3"
_PER_LENGTH, _PER_AREA = "1/-1", "1/-2"


def _dimensions(text: str) -> dict[str, str]:
    """ "a b: 0/2; c: 0/1" as column -> dimension."""
    parts = (part.split(":") for part in text.split(";") if part)
    return {name: dim.strip() for names, dim in parts for name in names.split()}


_OFFSETS = f"w1a w2a w3a w1b w2b w3b: {_L}"
_RECOVERY = f"c1 c2 d1 d2 e1 e2 f1 f2: {_L}"
# card -> columns with a dimension; "" where none has one.
_PLAIN: dict[str, str] = {
    "CBAR": _OFFSETS,
    "CBEAM": _OFFSETS,
    "CROD": f"a: {_A}; j: {_I}; c: {_L}; nsm: {_PER_LENGTH}",
    "PBAR": f"a: {_A}; i1 i2 j i12: {_I}; nsm: {_PER_LENGTH}; {_RECOVERY}",
    "PBEAM": f"as: {_A}; i1s i2s i12s js: {_I}; nsms: {_PER_LENGTH}; c1s c2s d1s d2s "
    f"e1s e2s f1s f2s m1a m2a m1b m2b n1a n2a n1b n2b: {_L}; nsia nsib: 1/1; "
    "cwa cwb: 0/6",
    "PROD": f"a: {_A}; j: {_I}; c: {_L}; nsm: {_PER_LENGTH}",
    "PTUBE": f"od1 t od2: {_L}; nsm: {_PER_LENGTH}",
    "PVISC": f"ce: {_MASS}; cr: {_INERTIA}",
    "CBUSH": f"s1 s2 s3: {_L}",
    "PBUSH": f"mass: {_MASS}",
    "CONM2": f"m: {_MASS}; x1 x2 x3: {_L}; i11 i21 i22 i31 i32 i33: {_INERTIA}",
    "CQUAD4": f"zoffs: {_L}",
    "CTRIA3": f"zoffs: {_L}",
    "PSHELL": f"t z1 z2: {_L}; nsm: {_PER_AREA}",
    "PCOMP": f"z0 ts: {_L}; nsm: {_PER_AREA}; sb: {_MODULUS}",
    "PSHEAR": f"t: {_L}; nsm: {_PER_AREA}",
    "MAT1": f"e g st sc ss: {_MODULUS}; rho: {_DENSITY}",
    "MAT2": f"g11 g12 g13 g22 g23 g33 st sc ss: {_MODULUS}; rho: {_DENSITY}",
    "MAT8": f"e1 e2 g12 g1z g2z s: {_MODULUS}; rho: {_DENSITY}; f12: -2/2",
    "MAT9": f"gs: {_MODULUS}; rho: {_DENSITY}",
    "NSML": f"value: {_MASS}",
}
_WITHOUT = frozenset(
    """
    SPOINT CTUBE CELAS1 CDAMP1 CMASS1 CVISC CSHEAR CHEXA CPENTA CTETRA CPYRAM PSOLID
    NSMADD RBE2 RBE3 RBAR MPCADD SPCADD SUPORT ASET QSET EIGRL TABDMP1 SEBULK SECONCT
    PLOTEL
    """.split()
)
# Loads and what selects them in time: not part of the model.
_LOADS = frozenset(
    """
    FORCE MOMENT FORCE1 MOMENT1 FORCE2 MOMENT2 SLOAD PLOAD PLOAD1 PLOAD2 PLOAD4 GRAV
    ACCEL1 RFORCE SPCD LOAD DAREA LSEQ DLOAD TLOAD1 TLOAD2 DELAY TABLED1 TIC TSTEP
    """.split()
)
_SURFACES = ("PSHELL", "PCOMP", "PSHEAR")
_LINES = ("PBAR", "PBEAM", "PBARL", "PBEAML", "PROD", "CONROD", "PTUBE", "PBEND")


def units_of(name: str) -> Units:
    """A system of units by its name.

    Raises:
        InputError: no such system.
    """
    if name not in SYSTEMS:
        raise InputError(
            f"units: found '{name}', expected one of {', '.join(SYSTEMS)}"
            + nearest(name, list(SYSTEMS))
        )
    return SYSTEMS[name]


def in_si(deck: Deck, units: Units) -> Deck:
    """The deck in SI, without its loads.

    Raises:
        InputError: cards whose dimension depends on what they are used for, and here
            is not unique; all of them.
    """
    if units == SYSTEMS["SI"]:
        return deck
    problems: list[str] = []
    cord = deck.cards["CORD"]
    frames = dict(zip(cord["cid"], cord["type"]))
    cards: dict[str, pd.DataFrame] = {}
    for name, table in deck.cards.items():
        try:
            cards[name] = _converted(name, table, units, frames, deck)
        except InputError as error:
            problems += error.problems
    if problems:
        raise InputError(problems)
    parts = {n: in_si(part, units) for n, part in deck.superelements.items()}
    return replace(deck, cards=cards, superelements=parts)


def _converted(
    name: str, table: pd.DataFrame, units: Units, frames: Frames, deck: Deck
) -> pd.DataFrame:
    if table.empty or name in _WITHOUT:
        return table
    if name in _LOADS:
        return table.iloc[:0]
    if name not in _PLAIN and name not in _SPECIAL:
        raise InputError(f"{name}: has no conversion of units; give the deck in SI")
    table = table.copy()
    for column, dimension in _dimensions(_PLAIN.get(name, "")).items():
        table[column] = _times(table[column], units.factor(dimension))
    if name in _SPECIAL:
        _SPECIAL[name](table, units, _Context(name, frames, deck))
    return table


def _times(column: pd.Series, factor: float) -> pd.Series:
    if column.dtype != object:
        return column * factor
    return _listed(column, [np.asarray(v, float) * factor for v in column])


@dataclass(frozen=True)
class _Context:
    """What the conversion of a card may need to know.

    Attributes:
        card: its name.
        frames: coordinate system -> R, C or S.
        deck: all of it.
    """

    card: str
    frames: Frames
    deck: Deck


def _grid(table: pd.DataFrame, units: Units, context: _Context) -> None:
    _place(table, ("x1", "x2", "x3"), table["cp"], units, context)


def _frame(table: pd.DataFrame, units: Units, context: _Context) -> None:
    for p in "abc":
        _place(table, (f"{p}1", f"{p}2", f"{p}3"), table["rid"], units, context)


def _place(
    table: pd.DataFrame,
    columns: tuple[str, str, str],
    frame: pd.Series,
    units: Units,
    context: _Context,
) -> None:
    """Coordinates: angles of cylindrical and spherical frames stay."""
    kind = frame.map(lambda cid: context.frames.get(cid, "R"))
    for column, lengths in zip(columns, ("RCS", "R", "RC")):
        table[column] *= np.where(kind.isin(list(lengths)), units.length, 1.0)


def _corners(table: pd.DataFrame, units: Units, _: _Context) -> None:
    """Thickness at corners; with TFLAG 1 it is a factor on that of the property."""
    factor = np.where(table["tflag"] == 1, 1.0, units.length)
    for column in ("t1", "t2", "t3", "t4"):
        if column in table:
            table[column] *= factor


def _direct(table: pd.DataFrame, units: Units, context: _Context) -> None:
    """CELAS2, CDAMP2, CMASS2."""
    table[_VALUE[context.card]] *= _between(table, units)


def _by_use(table: pd.DataFrame, units: Units, context: _Context) -> None:
    """PELAS, PDAMP, PMASS: the dimension is that of the elements that use them.

    Raises:
        InputError: elements between translations and between rotations share one.
    """
    used = context.deck.cards[_USER[context.card]]
    factor = pd.Series(_between(used, units), used["pid"]).groupby(level=0)
    kinds = factor.nunique()
    if mixed := kinds[kinds > 1].index.tolist():
        raise InputError(
            f"{context.card} {pid}: elements between translations and between "
            "rotations share it, so that its unit is not unique; give each its own"
            for pid in mixed
        )
    table[_VALUE[context.card]] *= table["pid"].map(factor.first()).fillna(1.0)


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


def _bush(table: pd.DataFrame, units: Units, _: _Context) -> None:
    six = units.mass * np.repeat([1.0, units.length**2], 3)
    for column in ("ks", "bs"):
        table[column] = _listed(table, [np.asarray(v) * six for v in table[column]])


def _mass_matrix(table: pd.DataFrame, units: Units, _: _Context) -> None:
    six = np.repeat([1.0, units.length], 3)
    factor = units.mass * np.outer(six, six)
    table["ms"] = _listed(table, [np.asarray(m) * factor for m in table["ms"]])


def _equation(table: pd.DataFrame, units: Units, _: _Context) -> None:
    """MPC: rotations count in lengths."""
    rows = zip(table["coefficients"], table["comps"])
    scaled = [np.asarray(a) * units.length ** _rotation(c) for a, c in rows]
    table["coefficients"] = _listed(table, scaled)


def _enforced(table: pd.DataFrame, units: Units, _: _Context) -> None:
    turned = table["c"].str.contains("[456]", regex=True)
    table["d"] = np.where(turned, table["d"], units.length * table["d"])


def _matrix(table: pd.DataFrame, units: Units, _: _Context) -> None:
    rows = zip(table["values"], table["rowcs"], table["colcs"])
    scaled = [
        np.asarray(v) * units.mass * units.length ** (_rotation(r) + _rotation(c))
        for v, r, c in rows
    ]
    table["values"] = _listed(table, scaled)


def _nonstructural(table: pd.DataFrame, units: Units, _: _Context) -> None:
    """NSM: per area of surfaces, per length of lines.

    Raises:
        InputError: by ELEMENT, which may be either.
    """
    unclear = table[~table["type"].isin(_SURFACES + _LINES)]
    if len(unclear):
        raise InputError(
            f"NSM {sid}: type {kind} may be per area or per length; give PSHELL, PBAR, "
            "... so that its unit is known"
            for sid, kind in zip(unclear["sid"], unclear["type"])
        )
    power = np.where(table["type"].isin(_SURFACES), -2.0, -1.0)
    factor = units.mass * units.length**power
    scaled = [np.asarray(v) * f for v, f in zip(table["values"], factor)]
    table["values"] = _listed(table, scaled)


def _listed(table: pd.DataFrame | pd.Series, values: list) -> pd.Series:
    """A column of arrays."""
    column = np.empty(len(values), dtype=object)
    for i, value in enumerate(values):
        column[i] = value
    return pd.Series(column, table.index)


_VALUE = {"CELAS2": "k", "CDAMP2": "b", "CMASS2": "m"}
_VALUE |= {"PELAS": "k", "PDAMP": "b", "PMASS": "m"}
_USER = {"PELAS": "CELAS1", "PDAMP": "CDAMP1", "PMASS": "CMASS1"}
_SPECIAL: dict[str, Callable[[pd.DataFrame, Units, _Context], None]] = {
    "GRID": _grid,
    "CORD": _frame,
    **dict.fromkeys(("CQUAD4", "CTRIA3"), _corners),
    **dict.fromkeys(("CELAS2", "CDAMP2", "CMASS2"), _direct),
    **dict.fromkeys(("PELAS", "PDAMP", "PMASS"), _by_use),
    "PBUSH": _bush,
    "CONM1": _mass_matrix,
    "MPC": _equation,
    "SPC": _enforced,
    "DMIG": _matrix,
    "NSM": _nonstructural,
}
