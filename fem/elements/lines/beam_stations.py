"""Results of CBEAM at the stations between its ends for which PBEAM says SO = YES.

Without loads between the grids, moments vary linearly along the element x axis and the
other forces are constant: the forces at a station lie between those of the ends, and
the stresses follow with the section of the station.
"""

from dataclasses import dataclass

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.elements.block import Recovery
from fem.elements.lines.bar import bending_stress

TABLE = "CBEAM_STATIONS"


@dataclass(frozen=True, kw_only=True)
class Stations:
    """The s stations of e beams; those with fewer have NaN at the end.

    Attributes:
        x: (e, s) over the length.
        values: a i1 i2 i12 y z, each (e, s).
        recovery: (e, s, 4, 2) y and z of the points C, D, E, F.
    """

    x: Float64
    values: dict[str, Float64]
    recovery: Float64

    def forces(self, ends: Float64) -> Float64:
        """(e, s, 6, n) M1 M2 V1 V2 N T from those of both ends (e, 2, 6, n)."""
        x = np.nan_to_num(self.x)[:, :, None, None]
        return (1.0 - x) * ends[:, None, 0] + x * ends[:, None, 1]

    def stresses(self, ends: Float64) -> Float64:
        """(e, s, 4, n) stresses at the points, likewise."""
        e, s = self.x.shape
        flat = {name: value.reshape(e * s) for name, value in self.values.items()}
        matrix = stress_rows(flat, self.recovery.reshape(e * s, 4, 2))
        return matrix.reshape(e, s, 4, 6) @ self.forces(ends)


def stress_rows(values: dict[str, Float64], recovery: Float64) -> Float64:
    """(n, 4, 6) stresses at four points per unit of M1 M2 V1 V2 N T.

    The moments of the shear center are moved to the neutral axis first: there M1 is
    M1 + y N, and M2 is M2 + z N.

    Args:
        values: a i1 i2 i12 y z of the sections, each (n,).
        recovery: (n, 4, 2) y and z of the points.
    """
    a, y, z = (values[name] for name in ("a", "y", "z"))
    at = recovery - np.stack([y, z], axis=-1)[:, None, :]
    per_m1, per_m2 = bending_stress(*(values[k] for k in ("i1", "i2", "i12")), at)
    area = np.divide(1.0, a, out=np.zeros_like(a), where=a != 0.0)
    matrix = np.zeros((len(a), 4, 6))
    matrix[:, :, 0], matrix[:, :, 1] = per_m1, per_m2
    matrix[:, :, 4] = area[:, None] + per_m1 * y[:, None] + per_m2 * z[:, None]
    return matrix


def inner_stations(row: pd.Series) -> tuple[Float64, Float64]:
    """Places of a PBEAM's inner stations with output (s,), their points (s, 4, 2)."""
    x = np.asarray(row["xxbs"], float)
    wanted = [
        k
        for k in np.argsort(x)
        if 0.0 < x[k] < 1.0 and str(row["sos"][k]).upper().startswith("YES")
    ]
    points = np.array(
        [
            [np.asarray(row[f"{p}{i}s"], float) for i in (1, 2)]
            for p in "cdef"
        ]
    )  # fmt: skip
    first = int(np.argmin(x))
    same = [first if str(row["sos"][k]).upper() == "YESA" else k for k in wanted]
    return x[wanted], np.nan_to_num(points[:, :, same]).transpose(2, 0, 1)


@dataclass(frozen=True, kw_only=True)
class StationRecovery(Recovery):
    """Results at stations.

    Attributes:
        x: (e, s) printed first column, NaN where there is no station.
        extremes: add the largest and the smallest.
    """

    x: Float64
    extremes: bool = False

    def derive(self, linear: Float64) -> Float64:
        """(..., e, c) from (..., e, s q)."""
        values = linear.reshape(*linear.shape[:-1], self.x.shape[1], -1)
        parts = [np.broadcast_to(self.x, values.shape[:-1])[..., None], values]
        if self.extremes:
            parts.append(values.max(axis=-1, keepdims=True))
            parts.append(values.min(axis=-1, keepdims=True))
        printed = np.concatenate(parts, axis=-1)
        printed[..., np.isnan(self.x), :] = np.nan
        return printed.reshape(*linear.shape[:-1], -1)
