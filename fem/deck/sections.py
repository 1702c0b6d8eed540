"""The sections of a deck: executive control, case control, bulk data, superelements."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from fem.deck.source import Line
from fem.errors import InputError

_CEND = re.compile(r"\s*CEND\b", re.I)
_BEGIN = re.compile(r"\s*BEGIN\b\s*(?:BULK)?\s*(?:SUPER\s*=?\s*(\d{1,9}))?(.*)$", re.I)
_SOL = re.compile(r"\s*SOL\b", re.I)


@dataclass
class Sections:
    """Lines of a deck by section; `has_control`: there is more than bulk data."""

    executive: list[Line] = field(default_factory=list)
    case_control: list[Line] = field(default_factory=list)
    bulk: list[Line] = field(default_factory=list)
    superelements: dict[int, list[Line]] = field(default_factory=dict)
    problems: list[str] = field(default_factory=list)
    has_control: bool = False


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
    if not sections.has_control:
        sections.bulk = list(lines)
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
            continue
        number, rest = match.groups()
        if rest.strip() and not rest.strip().startswith("$"):
            sections.problems.append(
                f"{line.file}:{line.number}: {line.text.strip()} is not supported"
            )
        target = (
            sections.superelements.setdefault(int(number), [])
            if number and int(number)
            else sections.bulk
        )


def _statement(line: Line) -> bool:
    return line.missing or bool(line.text.split("$")[0].strip())
