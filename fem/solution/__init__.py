"""A deck's own case control, executed: SOL 101, 103, 109 and 112 to a result file."""

from fem.solution.options import Console, Options, Quiet
from fem.solution.run import run_deck, solution_problems

__all__ = ["Console", "Options", "Quiet", "run_deck", "solution_problems"]
