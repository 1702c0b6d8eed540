"""A deck's own case control, executed: its SOL and subcases to a result file."""

from fem.solution.options import Console, Options, Quiet
from fem.solution.run import declared_solution, run_deck, solution_problems

__all__ = [
    "Console",
    "Options",
    "Quiet",
    "declared_solution",
    "run_deck",
    "solution_problems",
]
