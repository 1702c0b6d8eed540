"""The sections of a deck: executive control, case control, bulk data, superelements,
mass increments.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from fem.deck.text.source import Line
from fem.errors import InputError

_CEND = re.compile(r"\s*CEND\b", re.I)
_BEGIN = re.compile(r"\s*BEGIN\b\s*(?:BULK)?\s*(.*)$", re.I)
# What a section is for, where it is not the main bulk data.
_PART = re.compile(
    r"(SUPER|MASSID)\s*=?\s*(\d{1,9})(?:\s*,?\s*MASSID\s*=?\s*(\d{1,9}))?"
    r"(?:\s*,?\s*LABEL\s*=?\s*('[^']*'|[^\s$]+))?\s*(.*)$",
    re.I,
)
_SOL = re.compile(r"\s*SOL\b", re.I)


@dataclass
class Increment:
    """Bulk data of BEGIN MASSID = n, or SUPER = s MASSID = n, with its LABEL."""

    label: str = ""
    lines: list[Line] = field(default_factory=list)


@dataclass
class Sections:
    """Lines of a deck by section; `has_control`: there is more than bulk data.

    `of_parts`: mass increments of superelements, by superelement and increment.
    """

    executive: list[Line] = field(default_factory=list)
    case_control: list[Line] = field(default_factory=list)
    bulk: list[Line] = field(default_factory=list)
    superelements: dict[int, list[Line]] = field(default_factory=dict)
    increments: dict[int, Increment] = field(default_factory=dict)
    of_parts: dict[tuple[int, int], Increment] = field(default_factory=dict)
    problems: list[str] = field(default_factory=list)
    has_control: bool = False

    @property
    def in_parts(self) -> bool:
        """There are sections after the main bulk data."""
        return bool(self.superelements or self.increments or self.of_parts)

    def parts(self) -> Iterator[tuple[str, list[Line]]]:
        """How each section after the main bulk data begins, and its lines."""
        for number, lines in self.superelements.items():
            yield f"BEGIN SUPER={number}", lines
        for number, increment in self.increments.items():
            label = f" LABEL='{increment.label}'" if increment.label else ""
            yield f"BEGIN MASSID={number}{label}", increment.lines
        for (part, number), increment in self.of_parts.items():
            yield f"BEGIN SUPER={part} MASSID={number}", increment.lines


def split_sections(lines: Sequence[Line], shown: str) -> Sections:
    """Lines by section; without CEND and BEGIN BULK everything is bulk data.

    Raises:
        InputError: there is nothing but comments, or the deck ends before its bulk
            data.
    """
    if not any(_statement(line) for line in lines):
        raise InputError(f"{shown}: the deck is empty")
    cend = next((k for k, line in enumerate(lines) if _CEND.match(line.text)), -1)
    begin = next(
        (k for k, x in enumerate(lines) if k > cend and _BEGIN.match(x.text)), -1
    )
    sections = Sections(has_control=cend >= 0 or begin >= 0)
    if begin >= 0 and cend < 0 and _of_part(lines[begin]):  # bulk data alone, parts
        sections.has_control = False
    if not sections.has_control:
        _split_bulk(lines, sections)
        return sections
    if begin < 0:
        raise InputError(
            f"{shown}: the deck ends before BEGIN BULK, line {lines[-1].number}"
        )
    if cend >= 0:
        sections.executive = list(lines[:cend])
        sections.case_control = list(lines[cend + 1 : begin])
    else:
        for line in lines[:begin]:
            target = sections.executive if _SOL.match(line.text) else None
            (sections.case_control if target is None else target).append(line)
    for line in sections.case_control:
        if line.missing:
            sections.problems.append(
                f"{line.file}:{line.number}: the file of {line.text} is not there"
            )
    sections.case_control = [x for x in sections.case_control if not x.missing]
    _split_bulk(lines[begin:], sections)
    return sections


def _split_bulk(lines: Sequence[Line], sections: Sections) -> None:
    target = sections.bulk
    for line in lines:
        match = _BEGIN.match(line.text)
        if match is None:
            target.append(line)
        else:
            target = _section_of(match[1].strip(), line, sections)


def _section_of(text: str, line: Line, sections: Sections) -> list[Line]:
    """Where lines go after BEGIN with that text; what is not known is a problem."""
    part = _PART.match(text)
    none = "", "0", None, None, text
    kind, number, massid, label, rest = part.groups() if part else none
    if rest.strip() and not rest.strip().startswith("$"):
        sections.problems.append(
            f"{line.file}:{line.number}: {line.text.strip()} is not supported"
        )
    if kind.upper() == "SUPER" and massid and int(massid):
        if int(number):
            key = int(number), int(massid)
            return sections.of_parts.setdefault(key, Increment()).lines
        kind, number = "MASSID", massid
    if kind.upper() == "MASSID":
        if not int(number):
            sections.problems.append(
                f"{line.file}:{line.number}: MASSID = 0 is the main bulk data, "
                "expected a positive number"
            )
        increment = sections.increments.setdefault(int(number), Increment())
        increment.label = (label or increment.label).strip("' ")
        return increment.lines
    if int(number):
        return sections.superelements.setdefault(int(number), [])
    return sections.bulk


def _of_part(line: Line) -> bool:
    """Whether a line begins a superelement or a mass increment."""
    match = _BEGIN.match(line.text)
    return match is not None and _PART.match(match[1].strip()) is not None


def _statement(line: Line) -> bool:
    return line.missing or bool(line.text.split("$")[0].strip())
