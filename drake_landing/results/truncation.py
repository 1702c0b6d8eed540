"""One line on the modes that are left out, and peaks without what lies above them."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd
from scipy.signal import butter, sosfiltfilt

from drake_landing.airframe.truncation import WANTED

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult

Float64 = npt.NDArray[np.float64]

_ORDER = 4  # of the Butterworth filter, run forward and back


@dataclass(frozen=True, kw_only=True)
class Truncation:
    """Error of the modes that are left out.

    Attributes:
        gears: gear that touches the ground -> expected error of its load.
        enough_hz: all modes below it would keep the expected error at the points below
            5 %; None: not known.
    """

    gears: dict[str, float]
    enough_hz: float | None


def point_errors(result: "ProcessResult") -> dict[str, float]:
    """Multibody against transient: rms of the difference of the vectors over rms."""
    multibody = result.multibody_on_grid
    errors = {}
    for point, table in result.response.items():
        missing = multibody[point].to_numpy() - table.to_numpy()
        size = float((table.to_numpy() ** 2).sum())
        errors[point] = float(np.sqrt((missing**2).sum() / size)) if size else 0.0
    return errors


def truncation_line(result: "ProcessResult") -> str:
    """Modes, their errors, what choice would do, in one sentence."""
    n, hz = result.airframe.body.n, result.airframe.highest_hz
    errors, gears = point_errors(result), result.truncation.gears
    text = (
        f"{n} elastic mode{'s' * (n > 1)} up to {hz:.0f} Hz" if n else "rigid airframe"
    )
    text += f": accelerations of the multibody model {_worst(errors, 'point')}"
    text += f", vertical gear loads expected to be {_worst(gears, 'gear')}"
    in_the_air = [g.name for g in result.aircraft.gears if g.name not in gears]
    if in_the_air:
        named = ", ".join(in_the_air).replace("_", " ")
        text += f" ({named}: never on the ground)"
    if max([*errors.values(), *gears.values()], default=0.0) <= WANTED:
        return f"{text}; both below 5 %"
    enough = result.truncation.enough_hz
    choices = [f"select: below {enough:.0f} Hz"] if enough and enough > hz else []
    choices.append("select: relevance error <= 5 %")
    return f"{text}; for less than 5 %: {', or '.join(choices)}"


def low_passed(values: Float64, step: float, hz: float) -> Float64:
    """(t, k) without what lies above a frequency, phase kept.

    Args:
        values: (t, k) on an even grid.
        step: s.
        hz: where the amplitude has fallen by half; at or above the grid's limit
            nothing is taken away.
    """
    if hz <= 0.0 or hz >= 0.5 / step or len(values) < 40:
        return values
    filtered = sosfiltfilt(butter(_ORDER, hz, fs=1.0 / step, output="sos"), values, 0)
    return np.asarray(filtered)


def peaks_below(result: "ProcessResult") -> pd.DataFrame:
    """Columns point, axis, peak_low: peaks of the transient up to the last mode, m/s².

    The cut-off is the frequency of the highest mode of the multibody model.
    """
    hz, step = result.airframe.highest_hz, result.loads.step
    rows = []
    for point, table in result.response.items():
        peaks = np.abs(low_passed(table.to_numpy(), step, hz)).max(axis=0)
        rows += [[point, axis, float(p)] for axis, p in zip("xyz", peaks)]
    return pd.DataFrame(rows, columns=["point", "axis", "peak_low"])


def _worst(errors: dict[str, float], what: str) -> str:
    """The largest error and where it is; above 1 a first-order estimate is none."""
    if not errors:
        return "right: none is loaded"
    name = max(errors, key=errors.__getitem__)
    size = f"{errors[name]:.1%}" if errors[name] <= 1.0 else "more than 100 %"
    return f"{size} off at the worst {what} ({name.replace('_', ' ')})"
