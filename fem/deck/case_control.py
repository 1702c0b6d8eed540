"""Case control: what each subcase selects and asks for, as plain dataclasses."""

import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Literal, NamedTuple, TypeAlias

from fem.deck.source import Line

Selection: TypeAlias = Literal["ALL", "NONE"] | frozenset[int]


@dataclass(frozen=True, kw_only=True)
class Subcase:
    """One subcase; set ids are 0 and names '' where the deck selects nothing.

    Attributes:
        outputs: quantity (DISPLACEMENT, VELOCITY, ACCELERATION, SPCFORCES, MPCFORCES,
            OLOAD, FORCE, STRESS, STRAIN, GPFORCE, ESE, EKE, EDE, GPKE) to the ids that
            are asked for.
        options: quantity to the words in its parentheses, capitals.
    """

    id: int = 1
    title: str = ""
    subtitle: str = ""
    label: str = ""
    analysis: str = ""
    spc: int = 0
    mpc: int = 0
    load: int = 0
    dload: int = 0
    loadset: int = 0
    ic: int = 0
    tstep: int = 0
    method: int = 0
    suport1: int = 0
    sdamping: int = 0
    nsm: int = 0
    statsub: int = 0
    superelement: int = 0
    resvec: str = ""
    k2gg: str = ""
    m2gg: str = ""
    b2gg: str = ""
    k2pp: str = ""
    m2pp: str = ""
    b2pp: str = ""
    p2g: str = ""
    outputs: dict[str, Selection] = field(default_factory=dict)
    options: dict[str, tuple[str, ...]] = field(default_factory=dict)


QUANTITIES = {
    "DISP": "DISPLACEMENT",
    "VECT": "DISPLACEMENT",
    "VELO": "VELOCITY",
    "ACCE": "ACCELERATION",
    "SPCF": "SPCFORCES",
    "MPCF": "MPCFORCES",
    "OLOA": "OLOAD",
    "FORC": "FORCE",
    "ELFO": "FORCE",
    "STRE": "STRESS",
    "ELST": "STRESS",
    "STRA": "STRAIN",
    "GPFO": "GPFORCE",
    "ESE": "ESE",
    "EKE": "EKE",
    "EDE": "EDE",
    "GPKE": "GPKE",
}
_NUMBERS = {
    "SPC": "spc",
    "MPC": "mpc",
    "LOAD": "load",
    "DLOAD": "dload",
    "LOADSET": "loadset",
    "IC": "ic",
    "TSTEP": "tstep",
    "METHOD": "method",
    "SUPORT1": "suport1",
    "SDAMPING": "sdamping",
    "SDAMP": "sdamping",
    "NSM": "nsm",
    "STATSUB": "statsub",
    "SUPER": "superelement",
}
_NAMES = {
    name.upper(): name
    for name in [
        "analysis",
        "k2gg",
        "m2gg",
        "b2gg",
        "k2pp",
        "m2pp",
        "b2pp",
        "p2g",
        "resvec",
    ]
}
_TITLES = {"TITL": "title", "SUBT": "subtitle", "LABE": "label"}
# Commands that would change the answer and that nothing here carries out.
_REFUSED = frozenset(
    """
    AEROF APRES AUXCASE BC BOLTLD CMETHOD DEFORM DESGLB DESSUB DIVERG DYNRED FMETHOD
    GUST MFLUID MODSEL NLPARM NLSTEP NONLINEAR RGYRO RSDAMP SUBCOM SUBSEQ SYM SYMCOM
    REPCASE TEMPERATURE TEMP TFL TRIM TSTRU TSTEPNL A2GG
    """.split()
)
_DIRECT = {
    "K2PP": "K2GG adds a symmetric matrix",
    "M2PP": "M2GG adds a symmetric matrix",
    "B2PP": "B2GG adds a symmetric matrix",
    "P2G": "loads are given by load cards",
    "STATSUB": "there is no stiffness from a preload",
    "SUPORT1": "SUPORT holds in all subcases",
}
# (Initial temperatures alone change nothing: materials are constant.)
_WHY = {
    "TEMP": ": no thermal loads, no materials that depend on temperature; "
    "--ignore CASE goes on without such commands"
}
_COMMAND = re.compile(r"\s*([A-Z0-9]+)\s*(\([^)]*\))?\s*[=,]?\s*(.*)$", re.S)


@dataclass
class CaseControl:
    """Result of reading the section."""

    subcases: tuple[Subcase, ...] = (Subcase(),)
    params: list[tuple[str, str, Line]] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    notices: list[str] = field(default_factory=list)


def read_case_control(lines: Iterable[Line], *, refuse: bool = True) -> CaseControl:
    """Subcases of case control lines.

    Args:
        lines: between CEND and BEGIN BULK.
        refuse: report commands that nothing here carries out as problems.
    """
    result = CaseControl(problems=[], notices=[])
    sets: dict[int, Selection] = {}
    default, subcases = Subcase(), []
    current, ignored = default, []
    for statement, line in _statements(lines):
        place = f"{line.file}:{line.number}"
        upper = statement.upper()
        match = _COMMAND.match(upper)
        if match is None:
            result.problems.append(f"{place}: cannot be read: {statement.strip()}")
            continue
        name, options, value = match.group(1), match.group(2), match.group(3).strip()
        try:
            if name == "OUTPUT":
                break  # plotter and curve requests follow
            if name == "PARAM":
                result.params.append(_parameter(upper, line))
            elif name == "SET":
                _define_set(upper, sets)
            elif name == "SUBCASE":
                current = _new_subcase(default, value, subcases)
                subcases.append(current)
                continue
            else:
                words = _Command(name, options, value, statement)
                found = _carry_out(words, current, sets, refuse=refuse)
                current = found or current
                if found is None:
                    ignored.append(name)
        except ValueError as error:
            result.problems.append(f"{place}: {statement.strip()}: {error}")
        if subcases:
            subcases[-1] = current
        else:
            default = current
    if ignored:
        result.notices.append(
            "case control commands without effect here: "
            + ", ".join(sorted(set(ignored)))
        )
    result.subcases = tuple(subcases) or (default,)
    return result


class _Command(NamedTuple):
    """A command as it stands: NAME(OPTIONS) = VALUE, and the whole statement."""

    name: str
    options: str | None
    value: str
    statement: str


def _new_subcase(default: Subcase, value: str, others: list[Subcase]) -> Subcase:
    """A subcase that begins with what stands above all subcases.

    Raises:
        ValueError: its number is none, or does not ascend.
    """
    number = _number(value)
    if any(number <= other.id for other in others):
        raise ValueError("ids of subcases must ascend")
    return replace(
        default,
        id=number,
        outputs=dict(default.outputs),
        options=dict(default.options),
    )


def _carry_out(
    command: _Command, current: Subcase, sets: dict[int, Selection], *, refuse: bool
) -> Subcase | None:
    """The subcase after a command; None: it has no effect here.

    Raises:
        ValueError: its value cannot be read; it would change the answer, and nothing
            here carries it out.
    """
    name, options, value, statement = command
    if name[:4] in _TITLES:
        return _set(current, _TITLES[name[:4]], statement.split("=", 1)[-1].strip())
    if name in _DIRECT and refuse and value:
        raise ValueError(
            f"{name} is not supported; {_DIRECT[name]}; --ignore CASE goes on "
            "without it"
        )
    if name in _NUMBERS:
        return _set(current, _NUMBERS[name], _number(value))
    if name in _NAMES:
        return _set(current, _NAMES[name], value)
    if (key := _quantity(name)) is not None:
        current.outputs[key] = _selection(value, sets)
        words = (options or "()")[1:-1].split(",")
        current.options[key] = tuple(w.strip() for w in words if w.strip())
        return current
    if name in _REFUSED and refuse and not _initial(name, options):
        raise ValueError(f"{name} is not supported{_WHY.get(name[:4], '')}")
    return None


def _initial(name: str, options: str | None) -> bool:
    """TEMPERATURE(INITIAL), which only matters together with thermal loads."""
    return name.startswith("TEMP") and (options or "").startswith("(INIT")


def _statements(lines: Iterable[Line]) -> Iterable[tuple[str, Line]]:
    """Statements with their continuations (a comma at the end of a line)."""
    pending, start = "", None
    for line in lines:
        text = line.text.split("$")[0].rstrip()
        if not text.strip():
            continue
        start = start or line
        pending += text.strip() if pending else text
        if text.endswith(","):
            continue
        yield pending, start
        pending, start = "", None
    if start is not None:
        yield pending.rstrip(","), start


def _set(subcase: Subcase, name: str, value: int | str) -> Subcase:
    return replace(subcase, **{name: value})


def _quantity(name: str) -> str | None:
    """Quantity of an output command; four letters are enough."""
    return QUANTITIES.get(name[:4]) if len(name) != 4 or name in QUANTITIES else None


def _number(text: str) -> int:
    first = (re.split(r"[\s,]+", text) or [""])[0]
    if not first.isascii() or not first.isdigit() or len(first) > 12:
        raise ValueError(f"found '{text}', expected an integer")
    return int(first)


def _parameter(text: str, line: Line) -> tuple[str, str, Line]:
    parts = [part.strip() for part in text.split(",")]
    if len(parts) < 3:
        raise ValueError("expected PARAM,NAME,VALUE")
    return parts[1], parts[2], line


def _selection(text: str, sets: dict[int, Selection]) -> Selection:
    word = text.split()[0] if text.split() else "ALL"
    if word in ("ALL", "YES"):
        return "ALL"
    if word in ("NONE", "NO"):
        return "NONE"
    number = _number(word)
    if number not in sets:
        raise ValueError(f"set {number} is not defined")
    return sets[number]


def _define_set(text: str, sets: dict[int, Selection]) -> None:
    """SET n = 1, 2, 5 THRU 10 EXCEPT 7, 8."""
    match = re.match(r"\s*SET\s+(\d{1,12})\s*=?\s*(.*)$", text, re.S)
    if match is None:
        # Sets of names and of real numbers (SET (SID)=...) serve other outputs.
        return
    number, body = int(match.group(1)), match.group(2)
    words = body.replace(",", " , ").split()
    if "ALL" in words:
        sets[number] = "ALL"
        return
    ids: set[int] = set()
    k, removing, largest = 0, False, 0
    words = [word for word in words if word != ","]
    while k < len(words):
        word = words[k]
        if word == "EXCEPT":
            removing = True
        elif word == "THRU":
            if k == 0 or k + 1 == len(words):
                raise ValueError("THRU needs a number on both sides")
            first, last = _number(words[k - 1]), _number(words[k + 1])
            if last < first or last - first > 10_000_000:
                raise ValueError(f"found {first} THRU {last}, expected ascending ids")
            ids.update(range(first, last + 1))
            removing, k = False, k + 1
            largest = last
        elif word.isdigit():
            # Beyond its range an EXCEPT is over.
            removing = removing and _number(word) <= largest
            (ids.discard if removing else ids.add)(_number(word))
        elif "." not in word:  # sets of real numbers serve other requests
            raise ValueError(f"found '{word}' in a set, expected ids")
        k += 1
    sets[number] = frozenset(ids)
