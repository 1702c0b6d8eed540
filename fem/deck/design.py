"""SOL 200: the initial values of design variables set properties, as in Nastran.

A linear relation (DVPREL1, DVMREL1, DVCREL1) gives a field of a property, material or
element the value C0 + sum of COEF times variable; DLINK makes a variable depend on
others. The fields are set in the text of the cards, so that all that follows reads them
as if they stood there. Shapes (DVGRID, DVBSHAP) begin as the grids stand.
"""

import re
from collections.abc import Collection, Iterator, Sequence

from fem.deck.fields import Fields
from fem.deck.lexer import RawCard
from fem.deck.records import CARDS
from fem.deck.records.field import layout
from fem.deck.values import Malformed, integer

_LINEAR = ("DVPREL1", "DVMREL1", "DVCREL1")
_EQUATIONS = ("DVPREL2", "DVMREL2", "DVCREL2")
# Names of fields that are not those of the columns here.
_OTHERWISE = {
    "PSHELL": {"12I/T**3": "BK", "TS/T": "TST"},
    "PTUBE": {"OD": "OD1"},
    "PBEAM": {name: k for k, name in enumerate("A I1 I2 I12 J NSM".split(), start=3)},
    "PCOMP": {"Z0": 2, "NSM": 3, "SB": 4, "TREF": 6, "GE": 7},
}


def set_initial_values(
    cards: Sequence[RawCard],
    ignore: Collection[str],
    problems: list[str],
    notices: list[str],
) -> None:
    """Put the initial values of design variables into the cards that they govern.

    Args:
        cards: all of the bulk data; fields are changed in place.
        ignore: names of relations that the user goes on without.
        problems: relations that cannot be followed are appended.
        notices: what was set is appended.
    """
    relations = [c for c in cards if c.name in _LINEAR and c.name not in ignore]
    problems += [
        f"{card.place}: {card.name} gives a property by an equation, which is not "
        f"followed here; set the property on its card and --ignore {card.name}"
        for card in cards
        if card.name in _EQUATIONS and card.name not in ignore
    ]
    count = 0
    try:
        values = _variables(cards)
    except Malformed as error:
        problems.append(f"design variables: {error}")
        return
    for card in relations:
        try:
            count += _follow(Fields(card), values, cards)
        except Malformed as error:
            problems.append(
                f"{card.place}: {card.name} {card.field(1)}: {error}; without it: "
                f"--ignore {card.name}"
            )
    if count:
        notices.append(
            f"SOL 200: {count} fields of properties, materials or elements have the "
            "values that the design variables begin with; nothing is optimised"
        )


def _variables(cards: Sequence[RawCard]) -> dict[int, float]:
    """Initial values of DESVAR by id, those of DLINK from the others."""
    values: dict[int, float] = {}
    for card in cards:
        if card.name == "DESVAR":
            f = Fields(card)
            values[f.integer(1, "ID")] = f.real(3, "XINIT")
    for card in cards:
        if card.name == "DLINK":
            f = Fields(card)
            total = sum(c * v for v, c in _terms(f, 5, values))
            factor = f.real(4, "CMULT", 1.0)
            values[f.integer(2, "DDVID")] = f.real(3, "C0", 0.0) + factor * total
    return values


def _terms(
    f: Fields, start: int, values: dict[int, float]
) -> Iterator[tuple[float, float]]:
    """Pairs of variable and coefficient from a field to the end of the card."""
    for k in f.groups(start, 2):
        number = f.integer(k, "DVID")
        if number not in values:
            raise Malformed(f"DESVAR {number} is not defined")
        yield values[number], f.real(k + 1, "COEF", 1.0)


def _follow(f: Fields, values: dict[int, float], cards: Sequence[RawCard]) -> int:
    """Set the field of one relation; how many cards have it."""
    kind, target, name = f.word(2, "TYPE"), f.integer(3, "ID"), f.word(4, "NAME")
    value = f.real(7, "C0", 0.0) + sum(c * v for v, c in _terms(f, 9, values))
    found = [c for c in cards if c.name == kind and _is(c.field(1), target)]
    if not found:
        raise Malformed(f"{kind} {target} is not in the deck")
    for card in found:
        index = _index(kind, name)
        card.fields.extend([""] * (index + 1 - len(card.fields)))
        card.fields[index] = repr(float(value)).upper()
    return len(found)


def _is(text: str, number: int) -> bool:
    return text.isdecimal() and int(text) == number


def _index(kind: str, name: str) -> int:
    """Index of a field by the name, or by the number, that a relation gives.

    Numbers count the fields of the card's lines with their first and tenth ones.
    """
    try:
        number = integer(name)
    except Malformed:
        pass
    else:
        if number < 3:
            raise Malformed(f"field {name} of {kind}, expected 3 or more")
        line, place = divmod(number - 1, 10)
        return 8 * line + place
    name = re.sub(r"\(A\)$", "", name)
    if kind in ("PBARL", "PBEAML") and (match := re.fullmatch(r"DIM(\d+)", name)):
        return 8 + int(match[1])
    if kind == "PCOMP" and (match := re.fullmatch(r"(T|THETA)(\d+)", name)):
        return 4 * int(match[2]) + (6 if match[1] == "T" else 7)
    other = _OTHERWISE.get(kind, {}).get(name, name)
    if isinstance(other, int):
        return other
    record = CARDS.get(kind)
    shape = layout(record.fields) if record is not None else None
    known = [item.name.upper() for item in shape.fixed] if shape else []
    if other not in known:
        raise Malformed(f"field {name} of {kind} is not known here")
    return 1 + known.index(other)
