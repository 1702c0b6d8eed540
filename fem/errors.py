"""Errors that the user can mend, as opposed to bugs.

An `InputError` carries every problem that was found, not only the first, so that a
deck can be repaired in one pass. Command lines print it and exit with status 2.
"""

from collections.abc import Iterable, Sequence
from difflib import get_close_matches


class InputError(ValueError):
    """Bad input: each problem says where, what was found and what was expected.

    Args:
        problems: one line of text per problem, in the order of the input.
    """

    def __init__(self, problems: str | Iterable[str]) -> None:
        self.problems: tuple[str, ...] = (
            (problems,) if isinstance(problems, str) else tuple(problems)
        )
        super().__init__("\n".join(self.problems))


def nearest(name: str, known: Sequence[str]) -> str:
    """The clause `"; did you mean 'x'?"` for a misspelt name, or the empty string."""
    matches = get_close_matches(name, known, n=1)
    return f"; did you mean '{matches[0]}'?" if matches else ""
