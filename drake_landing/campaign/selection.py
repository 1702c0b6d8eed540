"""Which landings are confirmed, and how good the screening is.

The screening's error is measured, not assumed: a random sample of the landings gets its
direct transient. Per component, the difference over the component's largest stress has
a quantile; a landing is within the screening's band of an element where its screened
stress, raised by this error, reaches the element's largest, lowered by it. All such
landings are confirmed, those that decide for most elements first.

Elements whose largest stress lies below a tenth of their component's play no part in
the choice: they are where no margin is small. Direct transients end when the last
element has peaked for which they are made; of elements that peak later the screened
stress counts.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
import pandas as pd

from drake_landing.campaign.confirm import confirmed_file
from drake_landing.campaign.task import case_file
from fem.arrays import Float64, Int64

MATTERS = 0.1  # of the component's largest stress


@dataclass(frozen=True, kw_only=True)
class Largest:
    """Largest equivalent stress of every element over all landings.

    Attributes:
        value: (e,) Pa; case: (e,) number of the landing, -1: none; time: (e,) s.
        high, low: (e,) extremes of the direct or principal stresses, Pa.
        confirmed: (e,) the value comes from a direct transient, which was long enough.
    """

    value: Float64
    case: Int64
    time: Float64
    high: Float64
    low: Float64
    confirmed: np.ndarray


def screened(folder: Path, numbers: Sequence[int]) -> Iterator[tuple[int, Float64]]:
    """Case and (e,) screened equivalent stress of each landing, Pa."""
    for number in numbers:
        with h5py.File(case_file(folder, number)) as file:
            yield number, np.asarray(file["stress/equivalent"], float)


@dataclass(frozen=True, kw_only=True)
class Known:
    """Best known stresses of a landing: of its direct transient as far as that went.

    Attributes:
        equivalent: (e,) largest equivalent stress, Pa; time: (e,) of it, s.
        high, low: (e,) extremes of direct or principal stresses, Pa; of elements that
            peak after the transient, the larger ones of both.
        confirmed: (e,) the equivalent stress is that of the transient.
    """

    equivalent: Float64
    time: Float64
    high: Float64
    low: Float64
    confirmed: np.ndarray


def known_stress(folder: Path, number: int) -> Known:
    """What is known of the stresses of a landing, from its one file or from both."""
    quick, exact, covered = _both(folder, number)
    if exact is None:
        return Known(**quick, confirmed=covered)
    late = ~covered & (quick["equivalent"] > exact["equivalent"])
    return Known(
        equivalent=np.where(late, quick["equivalent"], exact["equivalent"]),
        time=np.where(late, quick["time"], exact["time"]),
        high=np.where(covered, exact["high"], np.maximum(quick["high"], exact["high"])),
        low=np.where(covered, exact["low"], np.minimum(quick["low"], exact["low"])),
        confirmed=~late,
    )


def _both(
    folder: Path, number: int
) -> tuple[dict[str, Float64], dict[str, Float64] | None, np.ndarray]:
    """Screened stresses, those of the transient, and which elements it covers."""
    with h5py.File(case_file(folder, number)) as file:
        quick = {k: np.asarray(v, float) for k, v in file["stress"].items()}
    path = confirmed_file(folder, number)
    if not path.is_file():
        return quick, None, np.zeros(len(quick["time"]), bool)
    with h5py.File(path) as file:
        exact = {k: np.asarray(v, float) for k, v in file["stress"].items()}
        until = float(file.attrs["until"])
    return quick, exact, quick["time"] <= until


def largest(folder: Path, numbers: Sequence[int], elements: int) -> Largest:
    """Over all landings: confirmed values where there are any, else screened ones."""
    found = Largest(
        value=np.zeros(elements),
        case=np.full(elements, -1, np.int64),
        time=np.zeros(elements),
        high=np.zeros(elements),
        low=np.zeros(elements),
        confirmed=np.zeros(elements, bool),
    )
    for number in numbers:
        own = known_stress(folder, number)
        better = own.equivalent > found.value
        found.value[better] = own.equivalent[better]
        found.case[better] = number
        found.time[better] = own.time[better]
        found.confirmed[better] = own.confirmed[better]
        np.maximum(found.high, own.high, out=found.high)
        np.minimum(found.low, own.low, out=found.low)
    return found


def screening_errors(
    folder: Path, sample: Sequence[int], component: Sequence[str], confidence: float
) -> pd.DataFrame:
    """Error of the screening per component, from landings that have both.

    Args:
        folder: of the case files.
        sample: landings drawn at random and confirmed.
        component: (e,) of each element.
        confidence: quantile of `band`.

    Returns:
        Index component; columns `elements`, `landings`, `median`, `p99`, `band`,
        `worst` (of all elements and landings, over the component's largest stress in
        that landing; elements that peak after the transient are left out), `peak`
        (largest error of a component's largest stress, signed, over it), `next`
        (probability that the worst error of one more landing drawn likewise stays
        below `worst`: m/(m+1), whatever the distribution).
    """
    names = pd.Index(pd.unique(pd.Series(component)))
    codes = pd.Categorical(component, categories=names).codes
    errors, peaks = [], []
    for number in sample:
        quick, exact, covered = _both(folder, number)
        assert exact is not None
        own, found = (
            pd.Series(np.where(covered, s["equivalent"], np.nan))
            for s in (exact, quick)
        )
        top = own.groupby(codes).transform("max").clip(lower=np.finfo(float).tiny)
        errors.append((found - own) / top)
        peaks.append(found.groupby(codes).max() / top.groupby(codes).max() - 1.0)
    if not errors:
        return pd.DataFrame(index=pd.Index([], name="component"))
    every, peak = pd.concat(errors, axis=1).abs(), pd.concat(peaks, axis=1)
    rows = {}
    for k, name in enumerate(names):
        values = every[codes == k].to_numpy().ravel()
        values, own = values[np.isfinite(values)], peak.loc[k].dropna().to_numpy()
        if not len(values):
            continue
        rows[name] = {
            "elements": int((codes == k).sum()),
            "landings": len(sample),
            "median": float(np.median(values)),
            "p99": float(np.quantile(values, 0.99)),
            "band": float(np.quantile(values, confidence)),
            "worst": float(values.max()),
            "peak": float(own[np.abs(own).argmax()]),
            "next": len(sample) / (len(sample) + 1.0),
        }
    frame = pd.DataFrame(rows).T
    frame.index.name = "component"
    return frame


def last_peak(folder: Path, number: int, component: Sequence[str]) -> float:
    """When the last element has peaked that reaches a tenth of its component's, s."""
    with h5py.File(case_file(folder, number)) as file:
        value = pd.Series(np.asarray(file["stress/equivalent"], float))
        time = np.asarray(file["stress/time"], float)
    names = np.asarray(component, str)
    top = value.groupby(names).transform("max").to_numpy(float)
    return float(np.max(time[value.to_numpy() >= MATTERS * top], initial=0.0))


def to_confirm(
    folder: Path,
    numbers: Sequence[int],
    component: Sequence[str],
    band: Mapping[str, float],
) -> pd.DataFrame:
    """Landings within the screening's band of some element's largest stress.

    Args:
        folder: of the case files.
        numbers: landings that were screened.
        component: (e,) of each element.
        band: component -> error over its largest stress.

    Returns:
        Index case, those that are within the band of most elements first; columns
        `elements`, `last_peak` (s, of these elements in that landing).
    """
    first = None
    for _, value in screened(folder, numbers):
        first = value if first is None else np.maximum(first, value)
    if first is None:
        empty = pd.Index([], name="case", dtype=np.int64)
        return pd.DataFrame({"elements": [], "last_peak": []}, index=empty)
    names = pd.Series(component)
    top = pd.Series(first).groupby(names).transform("max").to_numpy()
    # Without a sample nothing is known of the error: the largest alone decides.
    error = names.map(dict(band)).fillna(0.0).to_numpy() * top
    needed = first - 2.0 * error
    matters = first >= MATTERS * top
    rows = {}
    for number, value in screened(folder, numbers):
        decides = (value >= needed) & matters
        if decides.any():
            with h5py.File(case_file(folder, number)) as file:
                time = np.asarray(file["stress/time"], float)
            rows[number] = int(decides.sum()), float(time[decides].max())
    found = pd.DataFrame.from_dict(
        rows, orient="index", columns=["elements", "last_peak"]
    )
    found.index.name = "case"
    return found.sort_values("elements", ascending=False, kind="stable")
