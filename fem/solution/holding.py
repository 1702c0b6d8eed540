"""Dynamics of structures with motions that have neither stiffness nor mass.

Bars that turn about their own axis between lumped masses, grids at the ends of rods:
such motions take no part in the answer, and are held where they spoil a factorisation.
"""

from collections.abc import Callable
from typing import TypeVar

from fem.model.structure import Structure
from fem.solution.options import Console

Answer = TypeVar("Answer")


def solve_or_hold(
    model: Structure,
    solve: Callable[[Structure], Answer],
    console: Console,
    error: type[Exception] | tuple[type[Exception], ...],
) -> Answer:
    """The answer of a structure, or of the same with such motions held, and said.

    Args:
        model: the structure.
        solve: may be called twice.
        console: told what is held.
        error: what a failed factorisation raises.

    Raises:
        InputError: it failed for another reason; the message names what moves freely.
    """

    def attempt() -> Answer:
        try:
            return solve(model)
        except error:
            held, notices = model.without_massless_motions()
            if held is model:
                raise
            for notice in notices:
                console.say(f"notice: {notice}")
            return solve(held)

    return model.guarded(attempt, dynamic=True, error=error)
