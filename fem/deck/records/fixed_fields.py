"""Cards whose fields stand at fixed places, see `fem.deck.records.field`."""

import math
from collections.abc import Sequence

from fem.deck.records.field import Field, Layout, layout
from fem.deck.text.lexer import RawCard
from fem.deck.text.values import CONVERTERS, Malformed

_EXPECTED = {
    "i": "an integer",
    "f": "a real number",
    "c": "component digits",
    "s": "a word",
    "u": "an integer or a real number",
}


def read_regular(
    cards: Sequence[RawCard], text: str, problems: list[str], notices: list[str]
) -> dict[str, list]:
    """Columns of all cards of one name.

    Args:
        cards: the cards.
        text: description of their fields.
        problems: what is wrong in fields is appended, with its place.
        notices: unused fields are appended.

    Returns:
        Lists by column name, with `file` and `line`; rows of faulty cards hold 0 or
        NaN in the faulty fields and must not be used.
    """
    shape = layout(text)
    rows = _expand(cards, shape, problems) if shape.repeated else None
    if rows is None:
        rows = [(card, card.fields) for card in cards]
        _report_unused(cards, len(shape.fixed), notices)
    columns: dict[str, list] = {
        "file": [card.file for card, _ in rows],
        "line": [card.line for card, _ in rows],
    }
    for index, item in enumerate((*shape.fixed, *shape.repeated), start=1):
        if item.kind != "-":
            columns[item.name] = _column(rows, index, item, columns, problems)
    return columns


def _column(
    rows: Sequence[tuple[RawCard, list[str]]],
    index: int,
    item: Field,
    columns: dict[str, list],
    problems: list[str],
) -> list:
    convert, default = CONVERTERS[item.kind], item.default
    inherited = columns[default[0]] if isinstance(default, tuple) else None
    filler = {"f": math.nan, "u": math.nan, "i": 0}.get(item.kind, "")
    values = []
    for number, (card, fields) in enumerate(rows):
        text = fields[index] if index < len(fields) else ""
        if text:
            try:
                values.append(convert(text))
            except Malformed as error:
                problems.append(
                    f"{card.place}: {card.name} field {item.name.upper()}: found "
                    f"'{text}', expected {error}: {card}"
                )
                values.append(filler)
        elif inherited is not None:
            values.append(inherited[number])
        elif default is None:
            problems.append(
                f"{card.place}: {card.name} field {item.name.upper()} is blank, "
                f"expected {_EXPECTED[item.kind]}: {card}"
            )
            values.append(filler)
        else:
            values.append(default)
    return values


def _expand(
    cards: Sequence[RawCard], shape: Layout, problems: list[str]
) -> list[tuple[RawCard, list[str]]]:
    """One row of texts per group of repeated fields that is not blank."""
    head, size = 1 + len(shape.fixed), len(shape.repeated)
    rows = []
    for card in cards:
        before = len(rows)
        prefix = (card.fields + [""] * head)[:head]
        for start in range(head, len(card.fields), size):
            group = card.fields[start : start + size]
            if any(group):
                rows.append((card, prefix + group))
        if len(rows) == before:
            name = shape.repeated[0].name.upper()
            problems.append(f"{card.place}: {card.name} field {name} is blank: {card}")
    return rows


def _report_unused(cards: Sequence[RawCard], used: int, notices: list[str]) -> None:
    longer = [card for card in cards if any(card.fields[used + 1 :])]
    if longer:
        notices.append(
            f"{longer[0].place}: {longer[0].name}: fields after number {used} are not "
            f"used ({len(longer)} cards)"
        )
