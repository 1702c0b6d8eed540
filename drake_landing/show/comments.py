"""Names of a deck's components, from what people and programs leave in it.

In this order, element by element:

    1. HyperMesh ($HMNAME PROP, COMP; $HMMOVE), Femap ($ Femap Property) and Patran
       ($ Elements and Element Properties for region) name properties or elements
    2. a banner, a title between two lines of dashes, names all cards up to the next one
    3. where the elements come from several files, the name of the file (`file_names`)
    4. their kind: sheets, laminates, bars, ...

Names that only number properties (pcomp.1, PBAR 2) are no names.
"""

import re
from bisect import bisect_right
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from drake_landing.show.file_names import names_of_files

_RULE = re.compile(r"^\$\s*[-=*#_]{8,}\s*$")
_BY_PROPERTY = (
    re.compile(r'^\$HMNAME\s+(?:PROP|COMP)\s+(\d+)\s*"([^"]+)"'),
    re.compile(r"^\$\s*(?:\w+ )*Femap(?: \w+)* Property\s+(\d+)\s*:\s*(.+?)\s*$"),
)
_PATRAN = re.compile(
    r"^\$\s*Elements and Element Properties for region\s*:\s*(.+?)\s*$"
)
# HyperMesh: a component's elements by their ids, eight columns each (form from memory).
_COMPONENT = re.compile(r'^\$HMNAME\s+COMP\s+(\d+)\s*"([^"]+)"')
_MOVE = re.compile(r"^\$HMMOVE\s+(\d+)\s*$")
_NUMBERED = re.compile(
    r"(p(shell|compg?|solid|barl?|beaml?|rod|tube|shear|bush|elas|bend)"
    r"|property|prop|pid|untitled)[ ._-]*\d*",
    re.I,
)
_CARD = re.compile(r"^(P[A-Z0-9]+)\*?[\s,]+(\d+)")
_LONG = 40  # characters: of longer titles the text before the first comma
# What elements are called that nothing in the deck names.
KINDS = {
    "CBAR": "bars",
    "CBEAM": "beams",
    "CROD": "rods",
    "CONROD": "rods",
    "CTUBE": "tubes",
    "CQUAD4": "sheets",
    "CTRIA3": "sheets",
    **dict.fromkeys(("CQUADR", "CTRIAR", "CQUAD8", "CTRIA6", "CQUAD"), "sheets"),
    "CSHEAR": "shear panels",
    **dict.fromkeys(("CHEXA", "CPENTA", "CTETRA", "CPYRAM"), "solids"),
}


def kind_of(card: str) -> str:
    """Name of a component whose elements nothing in the deck names, by their card."""
    return KINDS.get(card, f"{card} elements")


@dataclass(frozen=True, kw_only=True)
class Names:
    """Names of properties and elements in the comments of a deck's files.

    Attributes:
        banners: file -> (lines, titles) in order.
        properties: property id -> name.
        elements: element id -> name.
    """

    banners: Mapping[str, tuple[list[int], list[str]]] = field(default_factory=dict)
    properties: Mapping[int, str] = field(default_factory=dict)
    elements: Mapping[int, str] = field(default_factory=dict)

    def at(self, file: str, line: int) -> str | None:
        """Title of the section that a line belongs to."""
        lines, titles = self.banners.get(file, ([], []))
        k = bisect_right(lines, line)
        return titles[k - 1] if k else None


def read_names(files: Iterable[str]) -> Names:
    """Reads the comments of a deck's files."""
    banners: dict[str, tuple[list[int], list[str]]] = {}
    properties: dict[int, str] = {}
    elements: dict[int, str] = {}
    for file in files:
        text = Path(file).read_text(encoding="utf-8", errors="replace").splitlines()
        if found := _banners(text):
            banners[file] = ([line for line, _ in found], [t for _, t in found])
        properties |= _properties(text)
        elements |= _moved(text)
    return Names(banners=banners, properties=properties, elements=elements)


def component_names(names: Names, elements: pd.DataFrame) -> list[str]:
    """Component of each element.

    Args:
        names: of the deck.
        elements: columns `card`, `pid`, `file` and `line`, `id` where known.
    """
    of_file = names_of_files(elements.file) if elements.file.nunique() > 1 else {}
    ids = elements.id if "id" in elements else [0] * len(elements)
    rows = zip(ids, elements.card, elements.pid, elements.file, elements.line)
    result = []
    for eid, card, pid, file, line in rows:
        name = names.elements.get(eid) or names.properties.get(pid)
        name = name or names.at(file, line)
        result.append(plain(name) if name else of_file.get(file) or kind_of(card))
    return result


def plain(title: str) -> str:
    """Both sides of a component under one name, without its explanations."""
    if len(title) > _LONG:
        title = title.split(",")[0]
    return re.sub(r"[ _](left|right|port|starboard)\b", "", title).replace("_", " ")


def _banners(text: list[str]) -> list[tuple[int, str]]:
    """(line, title), lines counted from 1."""
    return [
        (k + 1, text[k][1:].strip())
        for k in range(1, len(text) - 1)
        if text[k].startswith("$")
        and _RULE.match(text[k - 1])
        and _RULE.match(text[k + 1])
        and text[k][1:].strip()
        and not _RULE.match(text[k])
    ]


def _properties(text: list[str]) -> dict[int, str]:
    found: dict[int, str] = {}
    region = ""
    for line in text:
        if line.startswith("$"):
            for pattern in _BY_PROPERTY:
                if match := pattern.match(line):
                    found.setdefault(int(match[1]), match[2].strip())
            if match := _PATRAN.match(line):
                region = match[1]
        elif region and (match := _CARD.match(line)):
            found.setdefault(int(match[2]), region)
            region = ""
    return {pid: name for pid, name in found.items() if not _NUMBERED.fullmatch(name)}


def _moved(text: list[str]) -> dict[int, str]:
    """Element id -> name of the component that HyperMesh holds it in."""
    names = {int(m[1]): m[2].strip() for m in map(_COMPONENT.match, text) if m}
    found: dict[int, str] = {}
    name = ""
    for line in text:
        if match := _MOVE.match(line):
            name = names.get(int(match[1]), "")
        elif name and re.match(r"^\$[\sTHRU\d]+$", line):
            ids = _ids(line[1:])
            found.update(dict.fromkeys(ids, name))
        else:
            name = ""
    return found


def _ids(text: str) -> list[int]:
    """Ids and ranges: 1 2THRU 5."""
    words = text.replace("THRU", " THRU ").split()
    found: list[int] = []
    for k, word in enumerate(words):
        if word != "THRU" and word.isdigit():
            first = int(word)
            if k > 1 and words[k - 1] == "THRU":
                first = found[-1] + 1
            found += range(first, int(word) + 1)
    return found
