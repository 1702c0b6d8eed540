"""Text of a Nastran bulk-data deck: fields, cards, named sections, sets.

Small fields of 8 characters where every value keeps its precision there, else large
fields of 16. Reals always carry a decimal point, as Nastran demands.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from fem.deck.text.values import real as value_of
from fem.files.escaping import comment

Value = int | float | str | None

RULE = "$" + "-" * 71


def real(value: float, width: int) -> str:
    """A real number in at most `width` characters, with as many digits as fit.

    Raises:
        ValueError: not a finite number.

    >>> real(150e6, 8), real(0.25, 8), real(-1 / 3, 16)
    ('1.5+8', '.25', '-.33333333333333')
    """
    if value - value != 0.0:
        raise ValueError(f"{value} cannot be written to a deck: not a finite number")
    if value == 0.0:
        return "0."
    for digits in range(min(width, 15), 0, -1):
        for text in (f"{value:.{digits}g}", f"{value:.{digits - 1}e}"):
            if len(_short(text)) <= width:
                return _short(text)
    raise ValueError(f"{value} does not fit {width} characters")


def _short(text: str) -> str:
    """1.5e+08 as 1.5+8, 0.25 as .25, 3 as 3., 1e-05 as 1.-5."""
    mantissa, _, exponent = text.partition("e")
    if exponent and "." in mantissa:
        mantissa = mantissa.rstrip("0")
    if "." not in mantissa:
        mantissa += "."
    if mantissa.startswith("0."):
        mantissa = mantissa[1:]
    elif mantissa.startswith("-0."):
        mantissa = "-" + mantissa[2:]
    return mantissa + (f"{int(exponent):+d}" if exponent else "")


def _field(value: Value, width: int) -> str:
    if value is None:
        return ""
    if isinstance(value, float):
        return real(value, width)
    return str(value)


def _fits(value: Value) -> bool:
    """Whether 8 characters keep six digits of the value."""
    if not isinstance(value, float) or value == 0.0:
        return True
    return abs(value_of(real(value, 8)) / value - 1) < 5e-7


def card(name: str, *values: Value, wide: bool | None = None) -> str:
    """One card with its continuation lines.

    Args:
        name: of the card, without the asterisk.
        values: its fields from the second on; None is blank.
        wide: fields of 16 characters; by default where a real needs them.
    """
    if wide is None:
        wide = not all(map(_fits, values))
    fields = list(values)
    while fields and fields[-1] is None:
        fields.pop()
    width, each = (16, 4) if wide else (8, 8)
    mark = "*" if wide else ""
    lines = []
    for start in range(0, max(len(fields), 1), each):
        head = (name if start == 0 else "") + mark
        body = "".join(
            f"{_field(v, width):<{width}}" for v in fields[start : start + each]
        )
        lines.append((f"{head:<8}" + body).rstrip())
    if wide and len(lines) % 2:
        lines.append("*")  # large-field cards have an even number of lines
    return "\n".join(lines)


def id_ranges(ids: Iterable[int]) -> list[str]:
    """Ascending ids as `a THRU b` and single numbers."""
    texts: list[str] = []
    run: list[int] = []
    for i in [*sorted(set(ids)), None]:
        if run and i != run[-1] + 1:
            texts += (
                [f"{run[0]} THRU {run[-1]}"] if len(run) > 2 else [str(r) for r in run]
            )
            run = []
        if i is not None:
            run.append(i)
    return texts


def case_set(sid: int, ids: Iterable[int]) -> str:
    """A case-control SET, lines of at most 72 characters."""
    lines, line = [], f"SET {sid} ="
    parts = id_ranges(ids)
    for k, part in enumerate(parts):
        piece = " " + part + ("," if k < len(parts) - 1 else "")
        if len(line) + len(piece) > 70:
            lines.append(line)
            line = "   "
        line += piece
    return "\n".join([*lines, line])


@dataclass
class Section:
    """A titled part of the bulk data."""

    title: str
    lines: list[str] = field(default_factory=list)

    def add(self, name: str, *values: Value, wide: bool | None = None) -> None:
        """Appends a card."""
        self.lines.append(card(name, *values, wide=wide))

    def comment(self, text: str) -> None:
        """Appends a comment line."""
        self.lines.append(f"$ {comment(text)}")


@dataclass
class DeckText:
    """Executive and case control, and the sections of the bulk data in order."""

    title: str
    executive: Sequence[str]
    case_control: Sequence[str]
    sections: list[Section]

    def text(self) -> str:
        """The whole deck."""
        parts = [
            f"$ {comment(self.title)}",
            *self.executive,
            "CEND",
            *self.case_control,
        ]
        parts.append("BEGIN BULK")
        for section in self.sections:
            if section.lines:
                parts += [RULE, f"$ {comment(section.title)}", RULE, *section.lines]
        return "\n".join([*parts, "ENDDATA", ""])
