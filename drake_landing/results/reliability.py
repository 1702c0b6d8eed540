"""How far the numbers of a run carry, one line per reason for doubt."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult


def reliability(result: "ProcessResult") -> list[tuple[str, str]]:
    """What, and what is known of it."""
    return [("time step", str(result.step))]
