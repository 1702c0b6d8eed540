"""Executive control: the solution sequence, and the one system cell that is looked at.

The NASTRAN statement sets system cells by name or number. BARMASS, cell 398, gives CBAR
the mass of CBEAM; no other cell changes anything here.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass, field

from fem.deck.text.source import Line
from fem.errors import nearest

_SOL = re.compile(r"\s*SOL\s*[=,]?\s*'?([A-Z0-9_]+)", re.I)

SOLUTIONS: dict[str, int] = {
    "SESTATIC": 101,
    "SESTATICS": 101,
    "STATICS": 101,
    "SEMODES": 103,
    "MODES": 103,
    "SEBUCKL": 105,
    "NLSTATIC": 106,
    "SEDCEIG": 107,
    "SEDFREQ": 108,
    "SEDTRAN": 109,
    "SEMCEIG": 110,
    "SEMFREQ": 111,
    "SEMTRAN": 112,
    "NLTRAN": 129,
    "SEAEROSTAT": 144,
    "AESTAT": 144,
    "SEFLUTTR": 145,
    "SEAERO": 146,
    "DESOPT": 200,
}

# Numbers of old rigid formats and their superelement variants (from memory of MSC's
# and COSMIC's guides) and words of other dialects.
OLDER: dict[str, int] = {
    "STATIC": 101,
    "LINSTATIC": 101,
    "LINEARSTATIC": 101,
    "MODAL": 103,
    "BUCKLING": 105,
    "NONLINEAR": 106,
    "NLSTATICS": 106,
    **{"1": 101, "24": 101, "47": 101, "61": 101},
    **{"3": 103, "25": 103, "48": 103, "63": 103},
    **{"5": 105, "65": 105},
    **{"8": 108, "26": 108, "68": 108},
    **{"9": 109, "27": 109, "69": 109},
    **{"11": 111, "30": 111, "71": 111},
    **{"12": 112, "31": 112, "72": 112},
}

_DMAP = frozenset({"ALTER", "COMPILE", "ENDALTER", "MALTER", "LINK", "SUBDMAP"})


# System cells that change an answer, by all their names.
_CELLS = {"BARMASS": "BARMASS", "SYSTEM(398)": "BARMASS"}
_CELL = re.compile(r"([A-Z]\w*(?:\s*\(\s*\d+\s*\))?)\s*=\s*([^\s,=]+)", re.I)


@dataclass
class Executive:
    """Result of reading the section.

    Attributes:
        sol: number of the solution, 0 where there is none.
        statements: all, without comments.
        cells: system cells that are looked at, as parameters of the deck.
        problems, notices: what was wrong or is worth saying.
    """

    sol: int = 0
    cells: dict[str, int] = field(default_factory=dict)
    statements: tuple[str, ...] = ()
    problems: list[str] = field(default_factory=list)
    notices: list[str] = field(default_factory=list)


def read_executive(lines: Iterable[Line]) -> Executive:
    """Number of the solution and the statements of the section."""
    result = Executive()
    statements, dmap, missing = [], False, []
    unknown: tuple[str, str] | None = None
    for line in lines:
        text = line.text.split("$")[0].strip()
        if not text:
            continue
        statements.append(text)
        first = re.split(r"[\s,=(]", text.upper(), maxsplit=1)[0]
        dmap = dmap or first in _DMAP
        if line.missing:
            missing.append(text)
        if first == "NASTRAN":
            _read_cells(text, f"{line.file}:{line.number}", result)
        match = _SOL.match(text)
        if match is None or result.sol:
            continue
        name = match.group(1).upper()
        older = OLDER.get(name.lstrip("0"))
        if older is not None:
            result.sol = older
            result.notices.append(f"SOL {name} is carried out as SOL {older}")
        elif name.isdigit() and len(name) < 6:
            result.sol = int(name)
        elif name in SOLUTIONS:
            result.sol = SOLUTIONS[name]
        else:
            unknown = f"{line.file}:{line.number}: SOL {name}", name
    result.notices += [
        f"{text}: no such file; read as DMAP, without effect" for text in missing
    ]
    if unknown and not result.sol:
        result.problems.append(_unknown(*unknown, own=dmap))
    elif dmap:
        result.notices.append(
            "DMAP statements of the executive control are not executed"
        )
    result.statements = tuple(statements)
    return result


def _read_cells(text: str, place: str, result: Executive) -> None:
    """System cells of a NASTRAN statement."""
    unused = []
    for name, value in _CELL.findall(text):
        cell = _CELLS.get(re.sub(r"\s", "", name).upper())
        if cell is None:
            unused.append(f"{name}={value}")
        elif re.fullmatch(r"[+-]?\d+", value):
            result.cells[cell] = int(value)
        else:
            result.problems.append(
                f"{place}: NASTRAN {name}: found {value}, expected an integer"
            )
    if unused:
        result.notices.append(
            f"{place}: NASTRAN {', '.join(unused)}: system cells are passed over, but "
            "for BARMASS"
        )


def _unknown(place: str, name: str, *, own: bool) -> str:
    """What a SOL is that has no number here; `own`: the deck has DMAP statements."""
    if own:
        return f"{place}: a program of the deck's own in DMAP, which is not carried out"
    return (
        f"{place}: expected a number or a name such as SEMODES"
        f"{nearest(name, list(SOLUTIONS))}"
    )
