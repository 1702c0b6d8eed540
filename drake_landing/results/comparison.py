"""How well two histories of one quantity agree: the measures of the trade.

All functions take two series on the same, evenly spaced instants; the first is the
reference (the direct transient), the second the candidate (the multibody run).

Sources: M. A. Sprague, T. L. Geers, "Spectral elements and field separation for an
acoustic fluid subject to cavitation", J. Comput. Phys. 184 (2003) for magnitude, phase
and combined error; D. O. Smallwood, "An improved recursive formula for calculating
shock response spectra", Shock and Vibration Bulletin 51 (1981) for the spectra.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pandas as pd
from scipy.signal import lfilter

Float64 = npt.NDArray[np.float64]

COLUMNS = [
    *("run", "aircraft", "topology", "basis", "modes", "highest_hz", "point", "axis"),
    *("peak_fe", "peak_mbs", "peak_error", "rms_error", "correlation"),
    "sprague_geers",
]

# Below this share of the largest peak of a run, a component is zero by symmetry or
# nearly so: relative errors would compare what does not matter.
NEGLIGIBLE = 1e-3


@dataclass(frozen=True, kw_only=True)
class Peak:
    """Largest magnitude of a history."""

    value: float  # with its sign
    time: float  # s


@dataclass(frozen=True, kw_only=True)
class SpragueGeers:
    """Errors of magnitude (signed), phase (0 to 1) and both combined."""

    magnitude: float
    phase: float

    @property
    def combined(self) -> float:
        """Root of the sum of the squares."""
        return float(np.hypot(self.magnitude, self.phase))


@dataclass(frozen=True, kw_only=True)
class Agreement:
    """All measures of one pair of histories; NaN where the reference vanishes.

    Attributes:
        peak_reference, peak: of each history.
        peak_error: |peak| / |peak_reference| - 1.
        rms_error: rms of the difference over rms of the reference.
        correlation: Pearson's coefficient.
        sprague_geers: of the candidate against the reference.
    """

    peak_reference: Peak
    peak: Peak
    peak_error: float
    rms_error: float
    correlation: float
    sprague_geers: SpragueGeers


def peak(time: Float64, values: Float64) -> Peak:
    """The value of largest magnitude and its instant."""
    i = int(np.argmax(np.abs(values)))
    return Peak(value=float(values[i]), time=float(time[i]))


def rms_error(reference: Float64, candidate: Float64) -> float:
    """Root-mean-square of the difference over that of the reference."""
    size = float(np.sum(reference**2))
    if size == 0:
        return float("nan")
    return float(np.sqrt(np.sum((candidate - reference) ** 2) / size))


def correlation(reference: Float64, candidate: Float64) -> float:
    """Pearson's correlation coefficient; NaN if one of the two is constant."""
    a, b = reference - reference.mean(), candidate - candidate.mean()
    size = float(np.sqrt(np.sum(a**2) * np.sum(b**2)))
    return float(np.sum(a * b) / size) if size > 0 else float("nan")


def sprague_geers(reference: Float64, candidate: Float64) -> SpragueGeers:
    """M = sqrt(cc/rr) - 1 and P = acos(rc/sqrt(rr cc))/pi, with rc = sum of r c.

    >>> sprague_geers(np.array([0.0, 1.0]), np.array([0.0, 1.5]))
    SpragueGeers(magnitude=0.5, phase=0.0)
    """
    rr, cc = float(np.sum(reference**2)), float(np.sum(candidate**2))
    rc = float(np.sum(reference * candidate))
    if rr == 0 or cc == 0:
        return SpragueGeers(magnitude=float("nan"), phase=float("nan"))
    cosine = np.clip(rc / np.sqrt(rr * cc), -1.0, 1.0)
    return SpragueGeers(
        magnitude=float(np.sqrt(cc / rr) - 1), phase=float(np.arccos(cosine) / np.pi)
    )


def agreement(time: Float64, reference: Float64, candidate: Float64) -> Agreement:
    """All measures at once.

    Args:
        time: (t,) s.
        reference: (t,) the history to compare with.
        candidate: (t,) the history that is judged.
    """
    of_reference, of_candidate = peak(time, reference), peak(time, candidate)
    size = abs(of_reference.value)
    return Agreement(
        peak_reference=of_reference,
        peak=of_candidate,
        peak_error=abs(of_candidate.value) / size - 1 if size > 0 else float("nan"),
        rms_error=rms_error(reference, candidate),
        correlation=correlation(reference, candidate),
        sprague_geers=sprague_geers(reference, candidate),
    )


def shock_response_spectrum(
    acceleration: Float64, step: float, frequency: Float64, *, quality: float = 10.0
) -> Float64:
    """Largest absolute acceleration of damped oscillators on a shaken base.

    Ramp-invariant recursive filter: exact for a base acceleration that is linear
    between samples. The oscillators ring on for a period of the lowest frequency.

    Args:
        acceleration: (t,) of the base, m/s².
        step: s between samples.
        frequency: (f,) natural frequencies of the oscillators, Hz, > 0.
        quality: 1/(2 zeta), > 0.5.

    Returns:
        (f,) m/s².
    """
    if quality <= 0.5:
        raise ValueError(f"quality {quality}, expected more than 0.5 (underdamped)")
    rest = int(np.ceil(1 / (np.min(frequency) * step)))
    base = np.concatenate([acceleration, np.zeros(rest)])
    return np.array(
        [np.abs(lfilter(*_smallwood(f, step, quality), base)).max() for f in frequency]
    )


def _smallwood(
    frequency: float, step: float, quality: float
) -> tuple[list[float], list[float]]:
    """Coefficients (numerator, denominator) of the ramp-invariant filter."""
    zeta = 1 / (2 * quality)
    omega = 2 * np.pi * frequency
    damped = omega * np.sqrt(1 - zeta**2)
    decay = np.exp(-zeta * omega * step)
    c, s = decay * np.cos(damped * step), decay * np.sin(damped * step)
    s_over = s / (damped * step)
    numerator = [1 - s_over, 2 * (s_over - c), decay**2 - s_over]
    return numerator, [1.0, -2 * c, decay**2]


@dataclass(frozen=True, kw_only=True)
class RunLabel:
    """What a row of `comparison.csv` says of its run, beside the figures."""

    run: str
    aircraft: str
    topology: str
    basis: str
    modes: int
    highest_hz: float


def comparison_table(
    label: RunLabel,
    time: Float64,
    reference: dict[str, Float64],
    candidate: dict[str, Float64],
) -> pd.DataFrame:
    """One row per monitoring point and axis, columns `COLUMNS`.

    Args:
        label: of the run.
        time: (t,) s, of both.
        reference: acceleration (t, 3) of each monitoring point, direct transient, m/s².
        candidate: same points, multibody.

    Returns:
        peak_fe and peak_mbs are magnitudes. Relative measures are NaN for components
        that vanish by symmetry (`NEGLIGIBLE`).
    """
    floor = NEGLIGIBLE * max((np.abs(a).max() for a in reference.values()), default=0.0)
    rows = []
    for point, fe in reference.items():
        for i, axis in enumerate("xyz"):
            a = agreement(time, fe[:, i], candidate[point][:, i])
            counts = abs(a.peak_reference.value) > floor
            figures = (
                a.peak_error,
                a.rms_error,
                a.correlation,
                a.sprague_geers.combined,
            )
            rows.append(
                [
                    *(label.run, label.aircraft, label.topology, label.basis),
                    *(label.modes, label.highest_hz, point, axis),
                    *(abs(a.peak_reference.value), abs(a.peak.value)),
                    *(figures if counts else [float("nan")] * 4),
                ]
            )
    return pd.DataFrame(rows, columns=COLUMNS)
