"""From axes to cases: every combination of values, times samples of distributions."""

import io
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd

from drake_landing.campaign.axes import Distribution, Value, combined_values, quantiles
from drake_landing.campaign.schema import Campaign
from fem.errors import InputError, nearest
from fem.input_files import input_text


def case_rows(campaign: Campaign) -> pd.DataFrame:
    """One row per case, one column per field that varies, in a fixed order.

    Values of a column that `Scale` gives are factors: see `cases.case_of`. The same
    campaign has the same rows, whatever the machine.

    Raises:
        InputError: the table of measured values has not the columns that are asked for.
    """
    fixed = {p: v for p, a in campaign.axes.items() if (v := combined_values(a))}
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


def _read_csv(path: Path) -> pd.DataFrame:
    """Raises an InputError where it is no table."""
    text = input_text(path, "CSV table")
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
