"""Bulk data lines to cards: small, large and free fields, continuations, markers.

The fields of a card are a flat list of texts in capitals: index 0 is the name, index k
the k-th data field, eight per row; so `fields[9]` is the first field of the first
continuation, whatever format the lines have.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass

from fem.deck.source import Line

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
        return self.fields[0]

    @property
    def place(self) -> str:
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
    bulk = Bulk([], [], [], has_enddata=False)
    open_markers: dict[str, RawCard] = {}
    card: RawCard | None = None
    after_end = 0
    for line in lines:
        if line.missing:
            bulk.problems.append(
                f"{line.file}:{line.number}: the file of {line.text} is not there"
            )
            continue
        text = line.text
        if "$" in text:
            text = text[: text.index("$")]
        if not text or text.isspace():
            continue
        if bulk.has_enddata:
            after_end += 1
            continue
        text = text.upper()
        head, data, marker, large = split_line(text)
        place = f"{line.file}:{line.number}"
        if len(data) > (4 if large else 8):
            bulk.problems.append(
                f"{place}: {len(data)} data fields in a free-field line, expected at "
                f"most {4 if large else 8} and a continuation: {text.strip()}"
            )
            data = data[: 4 if large else 8]
        if head and head[0] not in "+*":
            if head == "ENDDATA":
                bulk.has_enddata = True
                continue
            name = head.rstrip("*").rstrip()
            if not _NAME.match(name):
                bulk.problems.append(
                    f"{place}: cannot be read, expected a card: {text.strip()[:60]}"
                )
                card = None
                continue
            fields, end = [name, *data], 4 if large else 8
            card = RawCard(fields, line.file, line.number, marker, end)
            bulk.cards.append(card)
        else:
            owner = _owner(head.lstrip("+*").strip(), card, open_markers)
            if owner is None:
                bulk.problems.append(
                    f"{place}: a continuation without a card: {text.strip()[:60]}"
                )
                continue
            _extend(owner, data, large)
            open_markers.pop(owner.marker, None)
            card, card.marker = owner, marker
        if marker:
            open_markers[marker] = card
    if after_end:
        bulk.notices.append(f"{after_end} lines after ENDDATA are not read")
    return bulk


def split_line(text: str) -> tuple[str, list[str], str, bool]:
    """Name or continuation mark, data fields, marker for what follows, large field?"""
    if "," in text:
        return _split_free(text)
    head = text[:8].strip()
    if head[-1:] == "*" or head[:1] == "*":
        data = [text[i : i + 16].strip() for i in (8, 24, 40, 56)]
        large = True
    else:
        stop = min(len(text), 72)
        data = [text[i : i + 8].strip() for i in range(8, stop, 8)]
        large = False
    marker = text[72:80].strip().lstrip("+*") if len(text) > 72 else ""
    while data and not data[-1]:
        data.pop()
    return head, data, marker, large


def _split_free(text: str) -> tuple[str, list[str], str, bool]:
    parts = [part.strip() for part in text.split(",")]
    head = parts[0]
    large = head[-1:] == "*" or head[:1] == "*"
    last = 5 if large else 9
    data, marker = parts[1:last], ""
    if len(parts) > last:
        rest = parts[last:]
        if not rest[0] or rest[0][0] in "+*":
            marker = rest[0].lstrip("+*")
            rest = rest[1:]
        if any(rest):
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


def _extend(card: RawCard, data: list[str], large: bool) -> None:
    """Append a continuation line; it begins a row (a half row in large fields)."""
    start = card.end if large else -(-card.end // 8) * 8
    card.fields.extend([""] * (start + 1 - len(card.fields)))
    card.fields.extend(data)
    card.end = start + (4 if large else 8)
