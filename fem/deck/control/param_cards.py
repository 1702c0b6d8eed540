"""PARAM cards of bulk data and case control to a dictionary."""

from collections.abc import Iterable, Sequence

from fem.deck.control.param_names import DEFAULTS, WITHOUT_EFFECT, Value, convert
from fem.deck.text.lexer import RawCard
from fem.deck.text.source import Line
from fem.deck.text.values import Malformed, integer, real


def read_parameters(
    cards: Sequence[RawCard],
    in_case_control: Iterable[tuple[str, str, Line]],
    problems: list[str],
    notices: list[str],
) -> dict[str, Value]:
    """Parameters by name; case control overrides bulk data, the last one counts."""
    given = [(card.field(1), card.field(2), card.place) for card in cards]
    given += [
        (name, text, f"{line.file}:{line.number}")
        for name, text, line in in_case_control
    ]
    params: dict[str, Value] = {}
    for name, text, place in given:
        if not name:
            problems.append(f"{place}: PARAM field N is blank, expected a name")
            continue
        value = _value(text)
        try:
            value = convert(name, value)
        except ValueError as error:
            problems.append(f"{place}: PARAM {name}: found '{text}', expected {error}")
        if params.get(name, value) != value:
            notices.append(f"{place}: PARAM {name} is given twice; {value} counts")
        params[name] = value
    unknown = sorted(params.keys() - DEFAULTS.keys() - WITHOUT_EFFECT)
    if unknown:
        notices.append(f"parameters without effect here: {', '.join(unknown)}")
    return params


def _value(text: str) -> Value:
    for converter in (integer, real):
        try:
            return converter(text)
        except Malformed:
            pass
    return text
