"""Which landings are confirmed, and how good the screening is.

The screening's error is measured, not assumed: a random sample of the landings gets its
direct transient. Per component, the difference over the component's largest stress has
a quantile; a landing is within the screening's band of an element where its screened
stress, raised by this error, reaches the element's largest, lowered by it. All such
landings are confirmed, those that decide for most elements first.

Elements whose largest stress lies below a tenth of their component's play no part in
the choice: they are where no margin is small.
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
        confirmed: (e,) the value comes from a direct transient.
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


def stress_of(folder: Path, number: int) -> tuple[dict[str, Float64], bool]:
    """Best known stresses of a landing, and whether they are confirmed."""
    path, confirmed = confirmed_file(folder, number), True
    if not path.is_file():
        path, confirmed = case_file(folder, number), False
    with h5py.File(path) as file:
        return {k: np.asarray(v, float) for k, v in file["stress"].items()}, confirmed


def equivalent_of(folder: Path, number: int) -> Float64:
    """(e,) best known equivalent stress of a landing, Pa."""
    path = confirmed_file(folder, number)
    with h5py.File(path if path.is_file() else case_file(folder, number)) as file:
        return np.asarray(file["stress/equivalent"], float)


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
        own, confirmed = stress_of(folder, number)
        better = own["equivalent"] > found.value
        found.value[better] = own["equivalent"][better]
        found.case[better] = number
        found.time[better] = own["time"][better]
        found.confirmed[better] = confirmed
        np.maximum(found.high, own["high"], out=found.high)
        np.minimum(found.low, own["low"], out=found.low)
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
        that landing), `peak` (largest error of a component's largest stress, signed,
        over it), `next` (probability that the worst error of one more landing drawn
        likewise stays below `worst`: m/(m+1), whatever the distribution).
    """
    names = pd.Index(pd.unique(pd.Series(component)))
    codes = pd.Categorical(component, categories=names).codes
    errors, peaks = [], []
    for number in sample:
        with h5py.File(case_file(folder, number)) as file:
            quick = np.asarray(file["stress/equivalent"], float)
        with h5py.File(confirmed_file(folder, number)) as file:
            exact = np.asarray(file["stress/equivalent"], float)
        top = pd.Series(exact).groupby(codes).max()
        quick_top = pd.Series(quick).groupby(codes).max()
        scale = np.maximum(top.reindex(codes).to_numpy(), np.finfo(float).tiny)
        errors.append((quick - exact) / scale)
        peaks.append(quick_top / np.maximum(top, np.finfo(float).tiny) - 1.0)
    if not errors:
        return pd.DataFrame()
    every = pd.DataFrame(np.abs(np.array(errors)).T).groupby(codes)
    joined = {k: np.concatenate(list(v.to_numpy().T)) for k, v in every}
    peak = pd.concat(peaks, axis=1)
    rows = {}
    for k, values in joined.items():
        own = peak.loc[k].to_numpy()
        rows[names[int(k)]] = {
            "elements": len(values) // len(sample),
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
        Index case, those that are within the band of most elements first; column
        `elements`.
    """
    first = None
    for _, value in screened(folder, numbers):
        first = value if first is None else np.maximum(first, value)
    if first is None:
        return pd.DataFrame({"elements": []}, index=pd.Index([], name="case"))
    names = pd.Series(component)
    top = pd.Series(first).groupby(names).transform("max").to_numpy()
    # Without a sample nothing is known of the error: the largest alone decides.
    error = names.map(dict(band)).fillna(0.0).to_numpy() * top
    needed = first - 2.0 * error
    matters = first >= MATTERS * top
    counts = {
        number: int(((value >= needed) & matters).sum())
        for number, value in screened(folder, numbers)
    }
    found = pd.Series(counts, name="elements", dtype=np.int64)
    found.index.name = "case"
    found = found[found > 0].sort_values(ascending=False, kind="stable")
    return found.to_frame()
