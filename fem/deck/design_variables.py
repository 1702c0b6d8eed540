"""SOL 200: the initial values of design variables set properties, as in Nastran.

A linear relation (DVPREL1, DVMREL1, DVCREL1) gives a field of a property, material or
element the value C0 + sum of COEF times variable; DLINK makes a variable depend on
others. An equation (DVPREL2 and its like) gives the value of a DEQATN for variables and
constants of DTABLE. The fields are set in the text of the cards, so that all that
follows reads them as if they stood there. Shapes (DVGRID, DVBSHAP) begin as the grids
stand.
"""

import re
from collections.abc import Collection, Iterator, Sequence

from fem.deck.equations import evaluate
from fem.deck.records import CARDS
from fem.deck.records.field import layout
from fem.deck.text.fields import Fields
from fem.deck.text.lexer import RawCard
from fem.deck.text.values import Malformed, integer, real

_LINEAR = ("DVPREL1", "DVMREL1", "DVCREL1")
_RELATIONS = frozenset((*_LINEAR, "DVPREL2", "DVMREL2", "DVCREL2"))
# Names of fields that are not those of the columns here.
_OTHERWISE = {
    "PSHELL": {"12I/T**3": "BK", "TS/T": "TST"},
    "PTUBE": {"OD": "OD1"},
    "PBEAM": {name: k for k, name in enumerate("A I1 I2 I12 J NSM".split(), start=3)},
    "PCOMP": {"Z0": 2, "NSM": 3, "SB": 4, "TREF": 6, "GE": 7},
}
# Words of the record of a PBEAM: 5, then 16 for each of eleven stations.
_OF_BEAM = {
    first + k: f"{name}({end})"
    for first, end in ((8, "A"), (168, "B"))
    for k, name in enumerate("A I1 I2 I12 J NSM".split())
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
    relations = [c for c in cards if c.name in _RELATIONS and c.name not in ignore]
    count = 0
    try:
        values = _variables(cards)
        constants = _constants(cards)
    except Malformed as error:
        problems.append(f"design variables: {error}")
        return
    for card in relations:
        f = Fields(card)
        try:
            if card.name in _LINEAR:
                value = _linear(f, values)
            else:
                value = _by_equation(f, values, constants, cards)
            count += _set(f, value, cards)
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


def _constants(cards: Sequence[RawCard]) -> dict[str, float]:
    """Constants of DTABLE by their names."""
    values: dict[str, float] = {}
    for card in cards:
        if card.name == "DTABLE":
            f = Fields(card)
            for k in f.groups(1, 2):
                values[f.word(k, "LABL")] = f.real(k + 1, "VALU")
    return values


def _linear(f: Fields, values: dict[int, float]) -> float:
    """What a linear relation gives."""
    return f.real(7, "C0", 0.0) + sum(c * v for v, c in _terms(f, 9, values))


def _by_equation(
    f: Fields,
    values: dict[int, float],
    constants: dict[str, float],
    cards: Sequence[RawCard],
) -> float:
    """What a DEQATN gives for the variables and the constants of a relation."""
    number = f.integer(7, "EQID")
    found = [c for c in cards if c.name == "DEQATN" and _is(c.field(1), number)]
    if not found:
        raise Malformed(f"DEQATN {number} is not defined")
    arguments: list[float] = []
    kind = ""
    for start in range(9, len(f), 8):
        kind = f.text(start) or kind
        for name in filter(None, f.card.fields[start + 1 : start + 8]):
            if kind == "DESVAR" and integer(name) in values:
                arguments.append(values[integer(name)])
            elif kind == "DTABLE" and name in constants:
                arguments.append(constants[name])
            else:
                raise Malformed(
                    f"{kind or 'DESVAR'} {name} is not defined"
                    if kind in ("DESVAR", "DTABLE")
                    else f"'{kind}' among the arguments, expected DESVAR or DTABLE"
                )
    return evaluate("".join(found[0].fields[2:]), arguments)


def _set(f: Fields, value: float, cards: Sequence[RawCard]) -> int:
    """Set the field of one relation; how many cards have it."""
    kind, target, name = f.word(2, "TYPE"), f.integer(3, "ID"), f.word(4, "NAME")
    found = [c for c in cards if c.name == kind and _is(c.field(1), target)]
    if not found:
        raise Malformed(f"{kind} {target} is not in the deck")
    for card in found:
        index = _index(kind, name, card)
        card.fields.extend([""] * (index + 1 - len(card.fields)))
        card.fields[index] = repr(float(value)).upper()
    return len(found)


def _is(text: str, number: int) -> bool:
    return text.isdecimal() and int(text) == number


def _end_of_beam(name: str, card: RawCard) -> int:
    """Index of a section's field at end B: in the row of the station at X/XB = 1."""
    column = ("SO", "X/XB", "A", "I1", "I2", "I12", "J", "NSM").index(name)
    for start in range(9, len(card.fields), 8):
        if card.field(start)[:1] in ("Y", "N") and real(card.field(start + 1)) == 1.0:
            return start + column
    raise Malformed(f"field {name}(B): the card has no station at X/XB = 1")


def _index(kind: str, name: str, card: RawCard) -> int:
    """Index of a field by the name, or by the number, that a relation gives.

    Numbers count the fields of the card's lines with their first and tenth ones; those
    below zero are words of the property's record (of beams: end A, end B).
    """
    try:
        number = integer(name)
    except Malformed:
        pass
    else:
        if kind == "PBEAM" and -number in _OF_BEAM:
            return _index(kind, _OF_BEAM[-number], card)
        if number < 3:
            raise Malformed(f"field {name} of {kind}, expected 3 or more")
        line, place = divmod(number - 1, 10)
        return 8 * line + place
    if kind == "PBEAM" and re.fullmatch(r"(A|I1|I2|I12|J|NSM)\(B\)", name):
        return _end_of_beam(name[:-3], card)
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
