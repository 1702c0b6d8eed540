"""Monitor points of a user's deck (MONPNT1, MONPNT3) as stations of a landing.

What MONPNT1 sums from outside, P - M ü - β M u̇, are linear maps of accelerations and of
the gears' loads; what MONPNT3 sums of elements is one of displacements.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import pandas as pd
import scipy.sparse as sp

from fem.arrays import Float64
from fem.model.structure import Structure
from fem.recovery.monitor_points import NAMES, MonitorPoint, monitor_points


@dataclass(frozen=True, kw_only=True, eq=False)
class Station:
    """A monitor point as linear maps.

    Attributes:
        point: of the deck.
        name: of the point, told apart from others.
        of_acceleration: (6, f) inertia, along CD; None for MONPNT3.
        of_displacement: (6, f) forces of elements; None for MONPNT1.
        of_load: (6, 6 k) of the loads on the loaded nodes, B.
    """

    point: MonitorPoint
    name: str
    of_acceleration: sp.csr_matrix | None = field(default=None, repr=False)
    of_displacement: sp.csr_matrix | None = field(default=None, repr=False)
    of_load: Float64 = field(repr=False)

    @property
    def quantities(self) -> list[str]:
        """Names of the components along its axes: F1 ... M3."""
        return [NAMES[a] for a in self.point.axes]

    def moved(self, displacement: Float64, acceleration: Float64) -> Float64:
        """(c, 6) what its map makes of load cases (f, c), see `values`."""
        if self.of_acceleration is not None:
            return np.asarray(self.of_acceleration @ acceleration).T
        assert self.of_displacement is not None
        return np.asarray(self.of_displacement @ displacement).T

    def values(self, moved: Float64, load: Float64) -> Float64:
        """(t, q) loads along the axes of the point.

        Args:
            moved: (t, 6) its map times accelerations, with the drag on masses, or
                displacements.
            load: (t, k, 6) on the loaded nodes, B.
        """
        total = moved
        if self.of_acceleration is not None:
            total = load.reshape(len(load), -1) @ self.of_load.T - moved
        return total[:, list(self.point.axes)]


def stations(
    structure: Structure, loaded: Sequence[int]
) -> tuple[tuple[Station, ...], tuple[str, ...]]:
    """All monitor points of the structure's deck, and notices of those left out.

    Args:
        structure: the full model.
        loaded: nodes that loads act on, in their order.
    """
    found = monitor_points(structure)
    T = structure.elimination.T
    dof = structure.points.dof(np.array(loaded)[:, None], np.arange(1, 7)[None, :])
    pattern = sp.csr_matrix(structure.points.basic_rotation()[dof.reshape(-1)]).T
    made = []
    for p, name in zip(found.points, _told_apart(found.points)):
        if p.outside is None:
            assert p.elastic is not None
            maps = {"of_displacement": sp.csr_matrix(p.elastic @ T)}
            of_load = np.zeros((6, 6 * len(loaded)))
        else:
            inertia = p.outside @ structure.matrices.mass @ T
            maps = {"of_acceleration": sp.csr_matrix(inertia)}
            of_load = (p.outside @ pattern).toarray()
        made.append(Station(point=p, name=name, of_load=of_load, **maps))
    return tuple(made), found.notices


def _told_apart(points: Sequence[MonitorPoint]) -> list[str]:
    """Names, with the card or a number where several points have one."""
    names = [p.name for p in points]
    for same in (lambda p: f"{p.name} ({p.card})", None):
        twice = {n for n in names if names.count(n) > 1}
        for name in twice:
            rows = [i for i, n in enumerate(names) if n == name]
            for k, i in enumerate(rows, 1):
                names[i] = same(points[i]) if same else f"{name} {k}"
    return names


def without_maps(station: Station) -> Station:
    """Names and places of a station, without its operators."""
    nothing = np.zeros(0, np.int64)
    point = replace(station.point, grids=nothing, outside=None, elastic=None)
    return Station(point=point, name=station.name, of_load=np.zeros((6, 0)))


def monitor_envelopes(
    found: Sequence[Station], time: Float64, values: Mapping[str, Float64]
) -> pd.DataFrame:
    """Extremes of all monitor points with their instants.

    Args:
        found: the points.
        time: (t,) s, or numbers of load cases.
        values: name -> (t, q).

    Returns:
        Rows `name, label, card, frame, point_x, point_y, point_z, quantity, min,
        time_of_min, max, time_of_max`; N, N m along the axes of `frame`.
    """
    rows = [row for s in found for row in _extremes(s, time, values[s.name])]
    heads = ["name", "label", "card", "frame", "point_x", "point_y", "point_z",
             "quantity", "min", "time_of_min", "max", "time_of_max"]  # fmt: skip
    return pd.DataFrame(rows, columns=heads)


def _extremes(s: Station, time: Float64, values: Float64) -> Iterator[list]:
    p = s.point
    for q, quantity in enumerate(s.quantities):
        a, b = values[:, q].argmin(), values[:, q].argmax()
        low, high = float(values[a, q]), float(values[b, q])
        place = [s.name, p.label, p.card, p.frame, *p.point.tolist()]
        yield [*place, quantity, low, float(time[a]), high, float(time[b])]


def monitor_histories(
    found: Sequence[Station], time: Float64, values: Mapping[str, Float64]
) -> pd.DataFrame:
    """Columns `<name> F1` and so on, index time."""
    columns = {
        f"{s.name} {quantity}": values[s.name][:, q]
        for s in found
        for q, quantity in enumerate(s.quantities)
    }
    return pd.DataFrame(columns, index=pd.Index(time, name="time"))
