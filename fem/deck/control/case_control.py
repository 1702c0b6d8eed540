"""Case control: its commands read, what nothing here carries out refused."""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from fem.arrays import Int64
from fem.deck.control import case_command_names as commands
from fem.deck.control.case_sets import SetReader, number
from fem.deck.control.subcase import Subcase
from fem.deck.text.source import Line
from fem.deck.text.values import Malformed, real
from fem.errors import nearest

_SKIP = re.compile(r"\s*SKIP[\s=]*(ON|OFF)\s*(?:\$|$)", re.I)
_COMMAND = re.compile(r"\s*([A-Z0-9]+)\s*(\([^)]*\))?\s*[=,]?\s*(.*)$", re.S)


@dataclass
class CaseControl:
    """Result of reading the section."""

    subcases: tuple[Subcase, ...] = (Subcase(),)
    params: list[tuple[str, str, Line]] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    notices: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class _Command:
    """A command as it stands: NAME(OPTIONS) = VALUE, and the whole statement."""

    name: str
    options: tuple[str, ...]
    value: str
    statement: str
    line: Line

    @property
    def place(self) -> str:
        return f"{self.line.file}:{self.line.number}"


def read_case_control(
    lines: Iterable[Line],
    *,
    refuse: bool = True,
    known: Callable[[], Int64] = lambda: np.zeros(0, np.int64),
) -> CaseControl:
    """Subcases of case control lines.

    Args:
        lines: between CEND and BEGIN BULK.
        refuse: report commands that nothing here carries out; else they are notices.
        known: ids that points and elements of the deck may have, ascending; asked for
            where a SET has a range without end.
    """
    return _Reader(refuse=refuse, known=known).read(lines)


class _Reader:
    """State while commands are read: the subcase that is open, sets, what is left."""

    def __init__(self, *, refuse: bool, known: Callable[[], Int64]) -> None:
        self.refuse = refuse
        self.sets = SetReader(known)
        self.result = CaseControl()
        self.default = Subcase()
        self.subcases: list[Subcase] = []
        self.plotting = False
        self.passed_over: dict[str, None] = {}
        self.plotted: dict[str, None] = {}
        self.unknown: dict[str, None] = {}

    @property
    def current(self) -> Subcase:
        return self.subcases[-1] if self.subcases else self.default

    def change(self, **values: object) -> None:
        """Change the open subcase."""
        changed = replace(self.current, **values)
        if self.subcases:
            self.subcases[-1] = changed
        else:
            self.default = changed

    def read(self, lines: Iterable[Line]) -> CaseControl:
        for statement, line in _statements(self.executed(lines)):
            match = _COMMAND.match(statement.upper())
            try:
                if match is None:
                    raise ValueError("cannot be read")
                word, options, value = match.groups()
                words = (w.strip() for w in (options or "()")[1:-1].split(","))
                name = commands.canonical(word) or word
                options = tuple(w for w in words if w)
                found = _Command(name, options, value.strip(), statement, line)
                self.take(found)
            except (ValueError, Malformed) as error:
                place = f"{line.file}:{line.number}"
                self.result.problems.append(f"{place}: {statement.strip()}: {error}")
        self.report()
        self.result.subcases = tuple(self.subcases) or (self.default,)
        return self.result

    def executed(self, lines: Iterable[Line]) -> Iterator[Line]:
        """Lines that do not stand between SKIPON and SKIPOFF (or the end)."""
        skipping: Line | None = None
        for line in lines:
            match = _SKIP.match(line.text)
            if match is not None:
                skipping = line if match[1].upper() == "ON" else None
                if skipping is not None:
                    place = f"{line.file}:{line.number}"
                    self.result.notices.append(f"{place}: skipped from here to SKIPOFF")
            elif skipping is None:
                yield line

    def report(self) -> None:
        """One notice for each kind of what was passed over."""
        for names, text in (
            (self.passed_over, "case control commands without effect here"),
            (self.plotted, "plot and curve requests after OUTPUT are passed over"),
            (self.unknown, "case control commands that are not known, passed over"),
        ):
            if names:
                self.result.notices.append(f"{text}: {', '.join(sorted(names))}")

    def take(self, command: _Command) -> None:
        """Carry a command out, or note why not.

        Raises:
            ValueError: its value cannot be read; it changes the model, and nothing
                here does it.
        """
        name = command.name
        if name in ("SUBCASE", "SUBCOM", "SYM", "SYMCOM", "REPCASE", "OUTPUT"):
            self.plotting = False
        if name == "OUTPUT":
            # Alone, or for grid point stresses, other commands follow as before.
            self.plotting = bool(command.options) and command.options[0] in _PLOTS
        elif self.plotting:
            self.plot(command)
        elif (action := getattr(self, f"do_{name.lower()}", None)) is not None:
            action(command)
        elif name in commands.TITLES:
            text = command.statement.split("=", 1)[-1].strip()
            self.change(**{commands.TITLES[name]: text})
        elif name in commands.MODEL_REFUSED and self.refuse and command.value:
            raise ValueError(
                f"{name} is not supported; {commands.MODEL_REFUSED[name]}; "
                "--ignore CASE goes on without it"
            )
        elif name in commands.SOLUTION_REFUSED:
            self.not_carried_out(command)
        elif name in commands.DYNAMIC_INPUT and not self.refuse:
            self.passed_over[name] = None
        elif name in commands.NUMBERS:
            self.number(command)
        elif name in commands.NAMES:
            self.change(**{commands.NAMES[name]: command.value})
        elif name in commands.QUANTITIES:
            self.request(command)
        elif name in commands.KNOWN:
            self.passed_over[name] = None
        elif self.refuse and (
            near := nearest(name, commands.SELECTIONS, commands.NEAR)
        ):
            raise ValueError(f"{name} is no case control command{near}")
        else:
            self.unknown[name] = None

    def number(self, command: _Command) -> None:
        """A selection by number; METHOD(FLUID) and its like are another model's."""
        if "FLUID" in command.options:
            self.passed_over[f"{command.name}(FLUID)"] = None
            return
        self.change(**{commands.NUMBERS[command.name]: number(command.value)})

    def plot(self, command: _Command) -> None:
        """A line of a plot section; a selection there would be lost.

        Raises:
            ValueError: it is one.
        """
        assigned = re.match(r"\s*\w+\s*(\([^)]*\))?\s*=", command.statement)
        if command.name in commands.NUMBERS and assigned and self.refuse:
            raise ValueError(
                "stands among the plot requests after OUTPUT(PLOT or XYPLOT), where "
                "Nastran reads no selections; expected it before"
            )
        word = re.split(r"[\s(=,]", command.statement.strip().upper())[0]
        self.plotted[word] = None

    def not_carried_out(self, command: _Command) -> None:
        name, case = command.name, self.current
        if not self.refuse or not command.value:
            self.passed_over[name] = None
            return
        text = (
            f"{command.place}: {command.statement.strip()}: {name} is not supported; "
            f"{commands.SOLUTION_REFUSED[name]}; --ignore CASE goes on without it"
        )
        self.change(not_carried_out=(*case.not_carried_out, text))
        if name in commands.NUMBERS:
            self.number(command)
        elif name in commands.NAMES:
            self.change(**{commands.NAMES[name]: command.value})

    def request(self, command: _Command) -> None:
        key, case = commands.QUANTITIES[command.name], self.current
        chosen = self.sets.selection(command.value)
        self.change(
            outputs={**case.outputs, key: chosen},
            options={**case.options, key: command.options},
        )

    # -- commands with rules of their own, called by name ---------------------------

    def do_resvec(self, command: _Command) -> None:
        options = {**self.current.options, "resvec": command.options}
        self.change(resvec=command.value, options=options)

    def do_param(self, command: _Command) -> None:
        parts = [x for x in re.split(r"[\s,=]+", command.statement.upper()) if x]
        if len(parts) < 3:
            raise ValueError("expected PARAM,NAME,VALUE")
        self.result.params.append((parts[1], parts[2], command.line))

    def do_autospc(self, command: _Command) -> None:
        """AUTOSPC(...) = NO says what PARAM,AUTOSPC says."""
        value = command.value or "YES"
        self.result.params.append(("AUTOSPC", value, command.line))

    def do_set(self, command: _Command) -> None:
        if not self.sets.define(command.statement.upper()):
            self.passed_over["SET of names"] = None

    def do_subcase(self, command: _Command) -> None:
        self.open(command)

    def do_sym(self, command: _Command) -> None:
        """A subcase that SYMCOM will add up."""
        self.open(command)

    def do_subcom(self, command: _Command) -> None:
        """The sum of the subcases before, with factors of SUBSEQ."""
        others = [case.id for case in self.subcases if not case.combination]
        if not others:
            raise ValueError("there is no subcase before that it could combine")
        self.open(command)
        self.change(combination=tuple((i, 1.0) for i in others), load=0)

    def do_symcom(self, command: _Command) -> None:
        self.do_subcom(command)

    def do_repcase(self, command: _Command) -> None:
        """Other output of the subcase before."""
        if not self.subcases:
            raise ValueError("there is no subcase before that it could repeat")
        before = self.subcases[-1]
        self.open(command)
        same = before.combination or ((before.id, 1.0),)
        self.change(combination=same, load=0)

    def do_subseq(self, command: _Command) -> None:
        """Factors of the last subcases before a SUBCOM, in their order."""
        members = [i for i, _ in self.current.combination]
        if not members:
            raise ValueError("belongs to a SUBCOM")
        words = [w for w in re.split(r"[\s,]+", command.value) if w]
        factors = [real(word) for word in words]
        if len(factors) > len(members):
            raise ValueError(
                f"{len(factors)} factors for the {len(members)} subcases before"
            )
        last = members[len(members) - len(factors) :]
        self.change(combination=tuple(zip(last, factors)))

    def do_symseq(self, command: _Command) -> None:
        self.do_subseq(command)

    def do_temperature(self, command: _Command) -> None:
        """TEMPERATURE(INITIAL, MATERIAL, LOAD or BOTH) = n; alone it is BOTH."""
        kind = command.options[0] if command.options else "BOTH"
        n = number(command.value)
        if kind.startswith("INIT"):
            self.change(initial_temperature=n)
        elif kind.startswith("MATE"):
            self.change(material_temperature=n)
        else:
            self.change(temperature=n)

    def do_meffmass(self, command: _Command) -> None:
        """MEFFMASS(GRID = n, ...) = YES or NO."""
        if command.value.startswith("NO"):
            self.change(meffmass=-1)
            return
        grids = [w.split("=")[1] for w in command.options if w.startswith("GRID")]
        self.change(meffmass=number(grids[0].strip()) if grids else 0)

    def do_statsub(self, command: _Command) -> None:
        """STATSUB(BUCKLING or PRELOAD) = static subcase; alone it is what buckles."""
        if not self.refuse:
            self.passed_over["STATSUB"] = None
            return
        kind = command.options[0] if command.options else "BUCKLING"
        name = "preload" if kind.startswith("PREL") else "statsub"
        self.change(**{name: number(command.value)})

    def do_super(self, command: _Command) -> None:
        """SUPER = ALL, a superelement, or a set of them; 0 is the residual structure.

        The load sequence number after it follows from the order of the subcases.
        """
        first = command.value.split(",")[0].strip()
        if first in ("", "ALL"):
            self.change(superelements=None)
            return
        n = number(first)
        members = self.sets.sets.get(n, frozenset({n}))
        alike = members if isinstance(members, frozenset) else None
        self.change(superelements=alike)

    def do_extseout(self, command: _Command) -> None:
        """EXTSEOUT(...): what it writes does not matter here, what it holds does."""
        self.change(extseout=True)

    def open(self, command: _Command) -> None:
        """A subcase that begins with what stands above all subcases.

        Raises:
            ValueError: its number is none, or does not ascend.
        """
        n = number(command.value)
        if any(n <= other.id for other in self.subcases):
            raise ValueError("ids of subcases must ascend")
        self.subcases.append(replace(self.default, id=n))


_PLOTS = ("PLOT", "XYPLOT", "XYOUT")


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
