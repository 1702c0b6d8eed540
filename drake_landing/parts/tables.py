"""Tables of what the parts see: by component, worst elements, section loads, panels."""

import numpy as np
import pandas as pd

from drake_landing.parts.cuts import NAMED, envelope_table
from drake_landing.parts.monitors import monitor_envelopes, monitor_histories
from drake_landing.parts.observers import PartsFound

WORST = ["component", "rank", "id", "card", "material", "equivalent", "time",
         "largest", "smallest", "x", "y", "z", "allowed", "margin",
         "measure"]  # fmt: skip
AXIAL = "axial stress only"


def with_margin(stress: pd.DataFrame, ultimate: float) -> pd.DataFrame:
    """Adds the margin of safety, allowed over (ultimate × stress) less 1, or NaN.

    Where the axial stress alone is known there is none.
    """
    factored = ultimate * stress.equivalent.to_numpy(float)
    allowed = stress.allowed.to_numpy(float)
    known = (factored > 0.0) & ~stress.axial_only.to_numpy(bool)
    with np.errstate(divide="ignore", invalid="ignore"):
        margin = allowed / factored - 1.0
    return stress.assign(margin=np.where(known, margin, np.nan))


def worst_elements(
    stress: pd.DataFrame, ultimate: float, count: int = 10
) -> pd.DataFrame:
    """The elements of each component with the highest stress over its allowable.

    Components with known margins first, the smallest ahead. Where no allowable is
    known the stress itself decides. Bars of which the axial stress alone is known are
    left out: see `axial_elements`.

    Args:
        stress: of a load case, see `CaseFound.stress`.
        ultimate: factor of safety.
        count: elements per component.

    Returns:
        Columns `WORST`; Pa, s, m.
    """
    return _ranked(
        with_margin(pd.DataFrame(stress[~stress.axial_only]), ultimate), count
    )


def axial_elements(stress: pd.DataFrame, count: int = 10) -> pd.DataFrame:
    """Bars of which the axial stress alone is known, as `worst_elements`."""
    return _ranked(with_margin(pd.DataFrame(stress[stress.axial_only]), 1.0), count)


def _ranked(rows: pd.DataFrame, count: int) -> pd.DataFrame:
    rows = pd.DataFrame(rows[rows.equivalent > 0.0])
    measure = np.where(rows.axial_only, AXIAL, "equivalent stress")
    rows = rows.assign(measure=measure)
    use = rows.equivalent / rows.allowed
    rows = rows.assign(use=use.fillna(-1.0))
    rows = rows.sort_values(["use", "equivalent"], ascending=False, kind="stable")
    rows["rank"] = rows.groupby("component").cumcount() + 1
    order = {name: k for k, name in enumerate(dict.fromkeys(rows.component))}
    rows = rows.assign(order=rows.component.map(order))
    first = rows[rows["rank"] <= count].sort_values(["order", "rank"])
    return pd.DataFrame(first, columns=WORST).reset_index(drop=True)


def stacked(*tables: pd.DataFrame) -> pd.DataFrame:
    """Tables of like columns under each other; empty ones do not change the types."""
    rows = [table for table in tables if len(table)]
    return pd.concat(rows, ignore_index=True) if rows else tables[0]


def component_table(stress: pd.DataFrame, ultimate: float) -> pd.DataFrame:
    """The worst element of each component, and the number of its elements."""
    worst = worst_elements(stress, ultimate, 1)
    counts = stress[~stress.axial_only].component.value_counts()
    return worst.assign(elements=counts.loc[worst.component].to_numpy())


def section_envelopes(found: PartsFound) -> pd.DataFrame:
    """Extremes along all beams, see `cuts.envelope_table`."""
    tables = [
        envelope_table(cuts, found.time, found.landing.sections[name])
        for name, cuts in found.cuts.items()
    ]
    return pd.concat(tables, ignore_index=True) if tables else pd.DataFrame()


def monitor_extremes(found: PartsFound) -> pd.DataFrame:
    """Extremes of the deck's monitor points, see `monitor_envelopes`."""
    return monitor_envelopes(found.stations, found.time, found.landing.monitors)


def monitors_over_time(found: PartsFound) -> pd.DataFrame:
    """Loads of the monitor points over time."""
    return monitor_histories(found.stations, found.time, found.landing.monitors)


def root_histories(found: PartsFound) -> pd.DataFrame:
    """Shear, bending and torsion over time at the cut that is looked at."""
    columns = {}
    for name, cuts in found.cuts.items():
        at = found.looked_at[name]
        named = cuts.named(found.landing.sections[name][:, at])
        for q, quantity in enumerate(NAMED):
            columns[f"{name} {quantity}"] = named[:, q]
    return pd.DataFrame(columns, index=pd.Index(found.time, name="time"))


def panel_table(found: PartsFound) -> pd.DataFrame:
    """Peaks of the middles of panels beside those of their frames.

    Rows `panel, axis, middle, beside, relative, ratio`: magnitudes, m/s²; `beside` is
    that of the mean of the neighbours, `relative` of the difference.
    """
    rows = []
    for panel in found.places.panels:
        middle = found.landing.acceleration[panel.grid]
        beside = np.mean([found.landing.acceleration[g] for g in panel.beside], axis=0)
        for i, axis in enumerate("xyz"):
            a, b = np.abs(middle[:, i]).max(), np.abs(beside[:, i]).max()
            relative = np.abs(middle[:, i] - beside[:, i]).max()
            rows.append([panel.name, axis, a, b, relative, a / b if b else np.nan])
    heads = ["panel", "axis", "middle", "beside", "relative", "ratio"]
    return pd.DataFrame(rows, columns=heads)


def equipment_histories(found: PartsFound) -> dict[str, pd.DataFrame]:
    """Acceleration of the places of equipment, columns x, y, z."""
    index = pd.Index(found.time, name="time")
    return {
        name: pd.DataFrame(
            found.landing.acceleration[grid], columns=["x", "y", "z"], index=index
        )
        for name, grid in found.places.equipment.items()
    }
