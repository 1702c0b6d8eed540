"""Sections of CBEAM along the element, from PBEAM.

Values vary linearly between the stations of the property; the flexibility and the mass
are integrated with Gauss points between them.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.references import column
from fem.elements.lines.beam_stations import Stations, inner_stations

# Prismatic: the flexibility is quadratic, the mass of degree six. With taper the
# integrand is rational; ten points per segment integrate 1:10 in depth to 1e-9.
_GAUSS_UNIFORM, _GAUSS_TAPERED = 4, 10
_VARYING = ("a", "i1", "i2", "i12", "j", "nsm")


@dataclass(frozen=True, kw_only=True)
class BeamSection:
    """Sections of e beams at q integration points and at both ends.

    Attributes:
        x, weight: (e, q) integration points as fraction of the length, weights.
        values: a i1 i2 i12 j nsm, y z (neutral axis), my mz (non-structural mass), nsi
            (its moment of inertia per length), cw (warping), each (e, q).
        ends: a i1 i2 i12 y z, each (e, 2).
        recovery: (e, 2, 4, 2) y and z of points C, D, E, F at both ends.
        k1, k2: (e,) shear factors, 0 for no shear flexibility.
    """

    x: Float64
    weight: Float64
    values: dict[str, Float64]
    ends: dict[str, Float64]
    recovery: Float64
    k1: Float64
    k2: Float64


def is_uniform(row: pd.Series) -> bool:
    """Whether a PBEAM is the same at all its stations."""
    sequences = [np.asarray(row[f"{name}s"], float) for name in _VARYING]
    offsets = [f"{p}{i}" for p in "mn" for i in (1, 2)]
    ends = [(row[f"{o}a"], row[f"{o}b"]) for o in offsets]
    ends += [(row["nsia"], row["nsib"]), (row["cwa"], row["cwb"])]
    return all(np.all(s == s[0]) for s in sequences) and all(
        np.nan_to_num(a) == np.nan_to_num(b) for a, b in ends
    )


def read_sections(pbeam: pd.DataFrame) -> BeamSection:
    """Sections per element; each property is evaluated once."""
    _, first, index = np.unique(
        pbeam["pid"].to_numpy(np.int64), return_index=True, return_inverse=True
    )
    properties = [pbeam.iloc[k] for k in first]
    segments = max(len(p["xxbs"]) - 1 for p in properties)
    uniform = all(is_uniform(p) for p in properties)
    count = _GAUSS_UNIFORM if uniform else _GAUSS_TAPERED
    points = [_integration(p, 1 if uniform else segments, count) for p in properties]
    x, weight = (np.stack([p[k] for p in points])[index] for k in (0, 1))
    values = [_values_at(p, q[0]) for p, q in zip(properties, points)]
    ends = [_values_at(p, np.array([0.0, 1.0])) for p in properties]
    return BeamSection(
        x=x,
        weight=weight,
        values={k: np.stack([v[k] for v in values])[index] for k in values[0]},
        ends={k: np.stack([v[k] for v in ends])[index] for k in ends[0]},
        recovery=np.stack([_recovery(p) for p in properties])[index],
        k1=column(pbeam, "k1"),
        k2=column(pbeam, "k2"),
    )


def _integration(row: pd.Series, segments: int, count: int) -> tuple[Float64, Float64]:
    """Gauss points and weights per segment between stations; missing ones are empty."""
    stations = np.sort(np.asarray(row["xxbs"], float))
    if segments == 1:
        stations = np.array([0.0, 1.0])
    stations = np.concatenate([stations, np.ones(segments + 1 - len(stations))])
    xi, weight = np.polynomial.legendre.leggauss(count)
    start, size = stations[:-1, None], np.diff(stations)[:, None]
    return (
        (start + size * 0.5 * (xi + 1.0)).reshape(-1),
        (size * 0.5 * weight).reshape(-1),
    )


def _values_at(row: pd.Series, x: Float64) -> dict[str, Float64]:
    """Section values by linear interpolation between the stations."""
    order = np.argsort(row["xxbs"])
    stations = np.asarray(row["xxbs"], float)[order]

    def between_stations(values: Sequence[float]) -> Float64:
        return np.interp(x, stations, np.nan_to_num(np.asarray(values, float)[order]))

    def between_ends(a: float, b: float) -> Float64:
        return np.interp(x, [0.0, 1.0], np.nan_to_num([a, b]))

    values = {name: between_stations(row[f"{name}s"]) for name in _VARYING}
    pairs = {"y": "n1", "z": "n2", "my": "m1", "mz": "m2", "nsi": "nsi", "cw": "cw"}
    for name, field in pairs.items():
        values[name] = between_ends(row[f"{field}a"], row[f"{field}b"])
    return values


def _recovery(row: pd.Series) -> Float64:
    """(2, 4, 2) stress points of both ends."""
    order = np.argsort(row["xxbs"])
    table_ = [
        [np.asarray(row[f"{p}{i}s"], float)[order] for i in (1, 2)] for p in "cdef"
    ]
    points = np.nan_to_num(np.asarray(table_))
    return points[:, :, [0, -1]].transpose(2, 0, 1)


def read_stations(pbeam: pd.DataFrame) -> Stations | None:
    """Inner stations with output per element; None where no property has one."""
    _, first, index = np.unique(
        pbeam["pid"].to_numpy(np.int64), return_index=True, return_inverse=True
    )
    properties = [pbeam.iloc[k] for k in first]
    found = [inner_stations(p) for p in properties]
    most = max(len(x) for x, _ in found)
    if most == 0:
        return None
    x = np.full((len(found), most), np.nan)
    recovery = np.zeros((len(found), most, 4, 2))
    for k, (own, points) in enumerate(found):
        x[k, : len(own)], recovery[k, : len(own)] = own, points
    each = [_values_at(p, np.nan_to_num(own)) for p, own in zip(properties, x)]
    names = ("a", "i1", "i2", "i12", "y", "z")
    return Stations(
        x=x[index],
        values={name: np.stack([v[name] for v in each])[index] for name in names},
        recovery=recovery[index],
    )
