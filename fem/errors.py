"""Errors that the user can mend, as opposed to bugs.

An `InputError` carries every problem that was found, not only the first, so that a
deck can be repaired in one pass. Command lines print it and exit with status 2.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from difflib import get_close_matches

_FEW = 3  # notices of one kind that are listed one by one
_PLACES = re.compile(r"[^\s(]+:\d+")
_NUMBERS = re.compile(r"\d+(?:\.\d+)?(?:[eE][+-]?\d+)?")
_MOST_SHOWN = 200  # problems
_LONGEST = 2000  # characters of a problem


class InputError(ValueError):
    """Bad input: each problem says where, what was found and what was expected.

    Args:
        problems: one line of text per problem, in the order of the input; what several
            readers have found is listed once.
    """

    def __init__(self, problems: str | Iterable[str]) -> None:
        self.problems: tuple[str, ...] = (
            (problems,) if isinstance(problems, str) else tuple(dict.fromkeys(problems))
        )
        shown = list(map(_printable, self.problems[:_MOST_SHOWN]))
        if more := len(self.problems) - len(shown):
            shown.append(f"... and {more:,} more problems")
        super().__init__("\n".join(shown))


class Problems(list[str]):
    """Problems of several readers, gathered so that all are reported at once.

    problems = Problems()
    for row in rows:
        with problems.gathered(where("MPC", row)):
            equations.append(read(row))
    problems.report()
    """

    @contextmanager
    def gathered(self, place: str = "") -> Iterator[None]:
        """Append the problems of an `InputError`, each after "place: ", and go on.

        What follows the faulty line of the block is passed over.
        """
        try:
            yield
        except InputError as error:
            self += (
                [f"{place}: {p}" for p in error.problems] if place else error.problems
            )

    def report(self) -> None:
        """Raise an InputError of all of them, if there are any."""
        if self:
            raise InputError(self)


def _printable(text: str) -> str:
    """Without what a terminal would take for a command, and not without end."""
    if len(text) > _LONGEST:
        text = f"{text[:_LONGEST]}... ({len(text):,} characters)"
    return visible(text)


def visible(text: str) -> str:
    """For a terminal: characters that would move, color or erase its lines as \\x1b.

    Line ends and tabs stay; what turns the direction of text does not.
    """
    if text.isprintable():
        return text
    return "".join(
        c if c.isprintable() or c in "\n\t\u00a0\u3000" else ascii(c)[1:-1]
        for c in text
    )


def nearest(name: str, known: Sequence[str], cutoff: float = 0.6) -> str:
    """The clause `"; did you mean 'x'?"` for a misspelt name, or the empty string.

    Args:
        name: as it was found.
        known: what it may be.
        cutoff: how alike they must be, 0 to 1.
    """
    matches = get_close_matches(name, known, n=1, cutoff=cutoff)
    return f"; did you mean '{matches[0]}'?" if matches else ""


def by_kind(notices: Iterable[str]) -> list[str]:
    """Notices with those of one kind in one line, in the order of the first of each.

    Of one kind are texts that differ in numbers, or in files and lines, alone.
    """
    kinds: dict[str, list[str]] = {}
    for text in dict.fromkeys(notices):
        kinds.setdefault(_NUMBERS.sub("#", _PLACES.sub("@", text)), []).append(text)
    lines = []
    for texts in kinds.values():
        if len(texts) <= _FEW:
            lines += texts
        else:
            lines.append(f"{texts[0]} (and {len(texts) - 1} more of this kind)")
    return lines
