"""Extremes that fall in the last swing of a run: a longer one might find more."""

from collections.abc import Iterator, Mapping

import numpy as np
import pandas as pd

from drake_landing.landing.settling import late
from drake_landing.parts.observers import PartsFound
from drake_landing.parts.tables import component_table, root_histories

COLUMNS = ["kind", "quantity", "value", "unit", "time"]
LATE = "last_swing"


def late_extremes(
    parts: PartsFound, response: Mapping[str, pd.DataFrame], swing: float
) -> pd.DataFrame:
    """Accelerations, section loads and worst stresses that may not be the last word.

    Args:
        parts: what the parts see.
        response: accelerations of the monitoring points.
        swing: s.

    Returns:
        Rows `COLUMNS`: the extreme in the last swing, its unit, s. Histories
        must exceed by 1 % what came before; of a stress only its instant is known.
    """
    accelerations = [t.add_prefix(f"{point} ") for point, t in response.items()]
    sections = root_histories(parts)
    forces = [c for c in sections if str(c).endswith("shear")]
    moments = [c for c in sections if c not in forces]
    rows = [
        *_of("acceleration", "m/s²", pd.concat(accelerations, axis="columns"), swing),
        *_of("section load", "N", sections[forces], swing),
        *_of("section load", "N m", sections[moments], swing),
        *_stresses(parts, swing),
    ]
    return pd.DataFrame(rows, columns=COLUMNS)


def flagged(table: pd.DataFrame, end: float, swing: float) -> pd.DataFrame:
    """A table of extremes with the column `LATE` beside their instants."""
    times = [c for c in table.columns if c == "time" or str(c).startswith("time_of_")]
    if not times:
        return table
    return table.assign(**{LATE: (table[times] > end - swing).any(axis="columns")})


def _of(kind: str, unit: str, table: pd.DataFrame, swing: float) -> Iterator[list]:
    time, values = table.index.to_numpy(), table.to_numpy()
    if not values.size:
        return
    last = time > time[-1] - swing
    for i in np.flatnonzero(late(time, values, swing)):
        at = int(np.argmax(np.abs(np.where(last, values[:, i], 0.0))))
        name = str(table.columns[i]).replace("_", " ")
        yield [kind, name, float(values[at, i]), unit, float(time[at])]


def _stresses(parts: PartsFound, swing: float) -> Iterator[list]:
    if parts.judged.empty:
        return
    worst = component_table(parts.judged, 1.0)
    for row in worst[worst.time > parts.time[-1] - swing].itertuples():
        name = f"{row.component}, element {row.id}"
        yield ["stress", name, row.equivalent, "Pa", row.time]
