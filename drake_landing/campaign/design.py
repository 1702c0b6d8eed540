"""From axes to cases: every combination of values, times samples of distributions."""

import io
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd

from drake_landing.campaign.schema import (
    Axis,
    Campaign,
    Distribution,
    Range,
    Scale,
    Value,
)
from fem.arrays import Float64
from fem.errors import InputError, nearest
from fem.input_files import given_text


def design(campaign: Campaign) -> pd.DataFrame:
    """One row per case, one column per field that varies, in a fixed order.

    Values of a column that `Scale` gives are factors: see `cases.case_of`. The same
    campaign has the same rows, whatever the machine.

    Raises:
        InputError: the table of measured values has not the columns that are asked for.
    """
    fixed = {p: _values(a) for p, a in campaign.axes.items() if _listed(a)}
    drawn = {p: a for p, a in campaign.axes.items() if isinstance(a, Distribution)}
    rows: list[dict[str, Value]] = []
    rng = np.random.default_rng(campaign.seed)
    measured = _measured(campaign)
    for combination in product(*fixed.values()):
        known = dict(zip(fixed, combination))
        rows += [known | extra for extra in _samples(campaign, drawn, measured, rng)]
    columns = [*campaign.axes, *measured.columns]
    frame = pd.DataFrame(rows, columns=pd.Index(columns), dtype=object)
    frame.index = pd.RangeIndex(len(frame), name="case")
    return frame


def _listed(axis: Axis) -> bool:
    return not isinstance(axis, Distribution)


def _values(axis: Axis) -> list[Value]:
    if isinstance(axis, Range):
        return [float(x) for x in np.linspace(axis.start, axis.stop, axis.count)]
    if isinstance(axis, Scale):
        return list(axis.scale)
    assert not isinstance(axis, Distribution)
    return list(axis)


def _samples(
    campaign: Campaign,
    drawn: Mapping[str, Distribution],
    measured: pd.DataFrame,
    rng: np.random.Generator,
) -> Iterator[dict[str, Value]]:
    if not campaign.samples:
        yield {}
        return
    columns: dict[str, Sequence[Value]] = {}
    if drawn:
        from scipy.stats import qmc

        cube = qmc.LatinHypercube(len(drawn), seed=rng).random(campaign.samples)
        for (path, axis), share in zip(drawn.items(), cube.T):
            columns[path] = quantiles(axis, share).tolist()
    if len(measured):
        picked = measured.iloc[rng.integers(len(measured), size=campaign.samples)]
        columns |= {str(name): picked[name].tolist() for name in measured.columns}
    for values in zip(*columns.values()):
        yield dict(zip(columns, values))


def quantiles(axis: Distribution, share: Float64) -> Float64:
    """Values of a truncated distribution at shares (n,) of its probability."""
    import scipy.stats

    law = getattr(scipy.stats, axis.distribution)(**axis.values)
    low = 0.0 if axis.low is None else law.cdf(axis.low)
    high = 1.0 if axis.high is None else law.cdf(axis.high)
    return np.asarray(law.ppf(low + share * (high - low)))


def _read_csv(path: Path) -> pd.DataFrame:
    """Raises an InputError where it is no table."""
    text = given_text(path, "CSV table")
    try:
        return pd.read_csv(io.StringIO(text))
    except (ValueError, pd.errors.ParserError) as error:
        raise InputError(f"{path}: no CSV table: {error}") from None


def _measured(campaign: Campaign) -> pd.DataFrame:
    """The table's rows under the names of fields; empty without one."""
    if campaign.table is None:
        return pd.DataFrame()
    found = _read_csv(campaign.table.file)
    wanted = campaign.table.columns
    missing = [name for name in wanted if name not in found.columns]
    if missing or found.empty:
        known = [str(c) for c in found.columns]
        raise InputError(
            f"table.columns.{name}: found no such column in {campaign.table.file}, "
            f"expected one of {', '.join(known)}{nearest(name, known)}"
            for name in missing or ["(rows)"]
        )
    return found[list(wanted)].rename(columns=wanted)
