"""How far the numbers of a run carry, one line per reason for doubt."""

from typing import TYPE_CHECKING

from drake_landing.airframe.damping import damping_story
from drake_landing.results.truncation import truncation_line

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult

_NAMED = 4  # late extremes that are named


def reliability(result: "ProcessResult") -> list[tuple[str, str]]:
    """What, and what is known of it."""
    return [
        ("modes", truncation_line(result)),
        ("time step", str(result.step)),
        ("duration", _duration(result)),
        ("deck of the transient", result.deck_checked),
        ("damping", damping_story(result.airframe.structure)),
    ]


def _duration(result: "ProcessResult") -> str:
    end, late = result.loads.time[-1], result.late
    how = "auto" if result.case.simulation.duration == "auto" else "as given"
    text = f"{end:.3g} s ({how})"
    if late.empty:
        return f"{text}: no extreme in the last swing of {result.swing:.2g} s"
    names = ", ".join(late.quantity[:_NAMED]) + ", ..." * (len(late) > _NAMED)
    return (
        f"{text}: {len(late)} extreme{'s' * (len(late) > 1)} in the last swing of "
        f"{result.swing:.2g} s, a longer run may find more: {names}"
    )
