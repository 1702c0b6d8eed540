"""Names of a deck's components, from the comments that people and programs leave in it.

Three habits are understood. A banner, a title between two lines of dashes, names all
cards up to the next banner. HyperMesh ($HMNAME), Femap ($ Femap Property) and Patran
($ Elements and Element Properties for region) name properties. Where none is found, a
component is a property, or an element type if there are too many of these.
"""

import re
from bisect import bisect_right
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

_RULE = re.compile(r"^\$\s*[-=*#_]{8,}\s*$")
_BY_PROPERTY = (
    re.compile(r'^\$HMNAME\s+(?:PROP|COMP)\s+(\d+)\s*"([^"]+)"'),
    re.compile(r"^\$\s*Femap Property\s+(\d+)\s*:\s*(.+?)\s*$"),
)
_PATRAN = re.compile(
    r"^\$\s*Elements and Element Properties for region\s*:\s*(.+?)\s*$"
)
_CARD = re.compile(r"^(P[A-Z0-9]+)\*?[\s,]+(\d+)")
_MOST_PROPERTIES = 24
# What elements are called that nothing in the deck names.
KINDS = {
    "CBAR": "bars",
    "CBEAM": "beams",
    "CROD": "rods",
    "CONROD": "rods",
    "CTUBE": "tubes",
    "CQUAD4": "sheets",
    "CTRIA3": "sheets",
    "CSHEAR": "shear panels",
    **dict.fromkeys(("CHEXA", "CPENTA", "CTETRA", "CPYRAM"), "solids"),
}


@dataclass(frozen=True, kw_only=True)
class Names:
    """What the comments of a deck's files say.

    Attributes:
        banners: file -> (lines, titles) in order.
        properties: property id -> name.
    """

    banners: Mapping[str, tuple[list[int], list[str]]] = field(default_factory=dict)
    properties: Mapping[int, str] = field(default_factory=dict)

    def at(self, file: str, line: int) -> str | None:
        """Title of the section that a line belongs to."""
        lines, titles = self.banners.get(file, ([], []))
        k = bisect_right(lines, line)
        return titles[k - 1] if k else None


def read_names(files: Iterable[str]) -> Names:
    """Reads the comments of a deck's files."""
    banners: dict[str, tuple[list[int], list[str]]] = {}
    properties: dict[int, str] = {}
    for file in files:
        text = Path(file).read_text(encoding="utf-8", errors="replace").splitlines()
        if found := _banners(text):
            banners[file] = ([line for line, _ in found], [t for _, t in found])
        properties |= _properties(text)
    return Names(banners=banners, properties=properties)


def component_names(names: Names, elements: pd.DataFrame) -> list[str]:
    """Component of each element.

    Args:
        names: of the deck.
        elements: columns `card`, `pid`, `file` and `line`.
    """
    found = [names.at(file, line) for file, line in zip(elements.file, elements.line)]
    few = elements.pid[elements.pid > 0].nunique() <= _MOST_PROPERTIES
    result = []
    for title, card, pid in zip(found, elements.card, elements.pid):
        if title is not None:
            result.append(plain(title))
        elif pid in names.properties:
            result.append(names.properties[pid])
        else:
            result.append(f"{card} property {pid}" if few and pid > 0 else str(card))
    return result


def plain(title: str) -> str:
    """Both sides of a component under one name."""
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
    return found
