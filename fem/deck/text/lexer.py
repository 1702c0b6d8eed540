"""Bulk data lines to cards: small, large and free fields, continuations, markers.

The fields of a card are a flat list of texts in capitals: index 0 is the name, index k
the k-th data field, eight per row; so `fields[9]` is the first field of the first
continuation, whatever format the lines have.
"""

import re
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass

from fem.deck.text.replication import repetitions, replicate
from fem.deck.text.source import Line
from fem.deck.text.values import Malformed

_MOST_UNREAD = 20  # lines that are listed
_SEPARATOR = re.compile(r"\s*,\s*|\s+")
_MNEMONIC = re.compile(r"(?!THRU|BY|EXCEPT|ENDT|SKIP)[A-Z][A-Z0-9]*$")
_LABELLED = frozenset({"MONPNT1", "MONPNT3"})  # the rest of their first line is a text
_EQUATION = "DEQATN"  # text from its third field on, with commas
# A line whose fields end with commas although its name does not.
_LATE_COMMA = re.compile(r"([A-Z][A-Z0-9]*)\s+([^\s,]+\s*,.*)")
_NAME = re.compile(r"[A-Z][A-Z0-9_]{0,15}$")


@dataclass(slots=True)
class RawCard:
    """One card as text.

    Attributes:
        fields: name and data fields, see the module's text.
        file, line: where it begins.
        marker: continuation mnemonic of its last line, without + or *.
        end: number of data fields that its lines have room for so far.
    """

    fields: list[str]
    file: str
    line: int
    marker: str = ""
    end: int = 8

    @property
    def name(self) -> str:
        """Name of the card, capitals."""
        return self.fields[0]

    @property
    def place(self) -> str:
        """File and line where it begins."""
        return f"{self.file}:{self.line}"

    def field(self, index: int) -> str:
        """Text of a field, '' where the card ends before it."""
        return self.fields[index] if index < len(self.fields) else ""

    def __str__(self) -> str:
        text = " ".join(f or "_" for f in self.fields).rstrip(" _")
        return text if len(text) <= 100 else text[:97] + "..."


@dataclass
class Bulk:
    """Cards of a bulk data section and the lines that are none."""

    cards: list[RawCard]
    problems: list[str]
    notices: list[str]
    has_enddata: bool


def read_cards(lines: Iterable[Line]) -> Bulk:
    """Cards of bulk data lines, up to ENDDATA."""
    return _Reader().read(lines)


def without_cards(
    lines: Iterable[Line], unwanted: Callable[[RawCard], bool]
) -> list[Line]:
    """Lines up to ENDDATA without those of some cards; comments stay."""
    reader = _Reader()
    owned: list[tuple[Line, RawCard | None]] = []
    for line in lines:
        text = line.text.split("$")[0]
        if not text or text.isspace():
            owned.append((line, None))
            continue
        reader.take(line, text.upper())
        if reader.bulk.has_enddata:
            break
        owned.append((line, reader.card))
    return [line for line, card in owned if card is None or not unwanted(card)]


class _Reader:
    """State while lines are read: the card that is open, marks that wait."""

    def __init__(self) -> None:
        self.bulk = Bulk([], [], [], has_enddata=False)
        self.card: RawCard | None = None
        self.open_markers: dict[str, RawCard] = {}
        self.rule: list[str] = []
        self.goes_on = False  # the last line ended with a comma
        self.unread: list[tuple[Line, str, str]] = []

    def read(self, lines: Iterable[Line]) -> Bulk:
        after_end = 0
        for line in lines:
            if line.missing:
                self.problem(line, f"the file of {line.text} is not there")
                continue
            text = line.text
            if "$" in text:
                text = text[: text.index("$")]
            if not text or text.isspace():
                continue
            if self.bulk.has_enddata:
                after_end += bool(text.strip(" *+"))
                continue
            self.take(line, text.upper())
        if after_end:
            self.bulk.notices.append(f"lines after ENDDATA are not read: {after_end}")
        self.tell_unread()
        return self.bulk

    def tell_unread(self) -> None:
        """Lines that are none; those of a file without any card are not shown."""
        decks = {card.file for card in self.bulk.cards}
        told = [unread for unread in self.unread if unread[0].file in decks]
        for line, text, what in told[:_MOST_UNREAD]:
            self.problem(line, f"{what}: {text.strip()[:60]}")
        if more := len(told[_MOST_UNREAD:]):
            self.bulk.problems.append(f"... and {more} more lines cannot be read")
        for file in dict.fromkeys(x.file for x, _, _ in self.unread):
            if file not in decks:
                self.bulk.problems.append(f"{file}: holds no card")

    def problem(self, line: Line, text: str) -> None:
        self.bulk.problems.append(f"{line.file}:{line.number}: {text}")

    def take(self, line: Line, text: str) -> None:
        if self.goes_on and text.lstrip()[:1].isdigit() and "," in text[:10]:
            text = f",{text.lstrip()}"
        self.goes_on = "," in text[:10] and text.rstrip()[-1:] == ","
        card = self.card
        if card is not None and card.name == _EQUATION and text[0] in " +*,":
            card.fields.append(_more_of_equation(text))
            return
        head, data, marker, large = split_line(text)
        width = 4 if large else 8
        # A free-field line with more fields goes on as if it were continued.
        width *= max(1, -(-len(data) // width))
        if not head or head[0] in "+*":
            self.continuation(line, text, head, data, marker, width)
        elif head.rstrip("*") == "ENDDATA":
            self.bulk.has_enddata = True
        elif head[0] == "=":
            self.replication(line, text, head, data)
        elif _NAME.match(name := head.rstrip("*").rstrip()):
            fields = [name, *data]
            if self.card is not None and name == self.card.name and "==" in data:
                with suppress(Malformed):
                    fields = replicate(self.card.fields, data)
            self.card = RawCard(fields, line.file, line.number, marker, width)
            self.bulk.cards.append(self.card)
            if marker:
                self.open_markers[marker] = self.card
        else:
            self.unreadable(line, text, "cannot be read, expected a card")
            self.card = None

    def continuation(
        self,
        line: Line,
        text: str,
        head: str,
        data: list[str],
        marker: str,
        width: int,
    ) -> None:
        owner = _owner(head.lstrip("+*").strip(), self.card, self.open_markers)
        if owner is None:
            self.unreadable(line, text, "a continuation without a card")
            return
        _extend(owner, data, width)
        self.open_markers.pop(owner.marker, None)
        self.card, owner.marker = owner, marker
        if marker:
            self.open_markers[marker] = owner

    def replication(self, line: Line, text: str, head: str, data: list[str]) -> None:
        count = repetitions(head)
        if count is None or self.card is None or (head != "=" and not self.rule):
            self.unreadable(line, text, "cannot be read, expected a card")
            return
        if head == "=":
            self.rule = data
        try:
            for _ in range(count):
                fields = replicate(self.card.fields, self.rule)
                self.card = RawCard(fields, line.file, line.number)
                self.bulk.cards.append(self.card)
        except Malformed as error:
            self.unreadable(line, text, str(error))

    def unreadable(self, line: Line, text: str, what: str) -> None:
        self.unread.append((line, text, what))


def split_line(text: str) -> tuple[str, list[str], str, bool]:
    """Name or continuation mark, data fields, marker for what follows, large field?"""
    head = text[:8].strip()
    if head.split(",")[0].rstrip("* ") == _EQUATION:
        return _EQUATION, _equation(text), "", False
    if "," in text[:10]:  # as Nastran recognises free fields
        return _split_free(text)
    if "," in text[8:16] and (late := _LATE_COMMA.fullmatch(text.strip())):
        return _split_free(f"{late[1]},{late[2]}")
    if head[-1:] == "*" or head[:1] == "*":
        data = [text[i : i + 16].strip() for i in (8, 24, 40, 56)]
        large = True
    else:
        stop = min(len(text), 72)
        data = [text[i : i + 8].strip() for i in range(8, stop, 8)]
        large = False
    marker = text[72:80].strip().lstrip("+*") if len(text) > 72 else ""
    if head in _LABELLED:
        data = [text[8:16].strip(), text[16:72].strip()]
    while data and not data[-1]:
        data.pop()
    return head, data, marker, large


def _equation(text: str) -> list[str]:
    """Id and first line of a DEQATN."""
    if "," in text[:10]:
        _, number, rest = (*text.split(",", 2), "", "")[:3]
        return [number.strip(), rest.strip()]
    if text[:8].rstrip()[-1:] == "*":
        return [text[8:24].strip(), text[24:72].strip()]
    return [text[8:16].strip(), text[16:72].strip()]


def _more_of_equation(text: str) -> str:
    """What a continuation adds to a DEQATN."""
    start, comma, rest = text[:9].partition(",")
    if comma and not start.strip(" +*"):
        return f"{rest}{text[9:]}".strip()
    return text[8:72].strip()


def _split_free(text: str) -> tuple[str, list[str], str, bool]:
    parts = _SEPARATOR.split(text.strip())
    head = parts[0]
    if head in _LABELLED:
        words = [part.strip() for part in text.split(",")]
        marks = [w for w in words[3:] if w.startswith("+")]
        label = ", ".join(w for w in words[2:] if w and w not in marks)
        return head, [words[1], label], (marks or ["+"])[0].lstrip("+"), False
    large = head[-1:] == "*" or head[:1] == "*"
    last = 5 if large else 9
    data, marker = parts[1:last], ""
    if len(parts) > last:
        rest = parts[last:]
        if not rest[0] or rest[0][0] in "+*":
            marker = rest[0].lstrip("+*")
            rest = rest[1:]
        if len(rest) == 1 and not marker and _MNEMONIC.match(rest[0]):
            marker = rest[0]
        elif any(rest):
            data = parts[1:]
    while data and not data[-1]:
        data.pop()
    return head, data, marker, large


def _owner(
    mark: str, current: RawCard | None, open_markers: dict[str, RawCard]
) -> RawCard | None:
    """The card that a continuation belongs to: by mnemonic, else by order."""
    if mark and (current is None or mark != current.marker):
        return open_markers.get(mark, current)
    return current


def _extend(card: RawCard, data: list[str], width: int) -> None:
    """Append a line of `width` fields; it begins a row (a half row in large fields)."""
    start = card.end if width % 8 else -(-card.end // 8) * 8
    card.fields.extend([""] * (start + 1 - len(card.fields)))
    card.fields.extend(data)
    card.end = start + width
