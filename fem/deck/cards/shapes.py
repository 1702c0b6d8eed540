"""PBARL and PBEAML: dimensions of a cross-section to rows of PBAR and PBEAM."""

from typing import Any

import numpy as np

from fem.cross_sections.library import Section, section
from fem.cross_sections.shapes import DIMENSIONS
from fem.deck.text.fields import Fields
from fem.deck.text.values import Malformed

Row = dict[str, Any]
Rows = list[Row]

_POINTS = ("c", "d", "e", "f")


def _kind(f: Fields) -> str:
    kind = f.word(4, "TYPE")
    if kind not in DIMENSIONS:
        raise Malformed(
            f"field TYPE: found '{kind}', expected one of {', '.join(DIMENSIONS)}"
        )
    return kind


def _dimensions(
    f: Fields, kind: str, start: int, first: list[float] | None = None
) -> list[float]:
    """Dimensions from index `start` on; `first` holds the defaults of end A."""
    dims: list[float] = []
    for k in range(DIMENSIONS[kind]):
        default = first[k] if first else None
        if kind == "DBOX" and k >= 4 and default is None:
            default = dims[3] if k < 8 else dims[5]
        dims.append(f.real(start + k, f"DIM{k + 1}", default))
    return dims


def _section(kind: str, dims: list[float]) -> Section:
    try:
        return section(kind, dims)
    except ValueError as error:
        raise Malformed(str(error)) from None


def pbarl(f: Fields) -> Rows:
    kind = _kind(f)
    shape = _section(kind, _dimensions(f, kind, 9))
    c = shape.constants
    row: Row = {"pid": f.integer(1, "PID"), "mid": f.integer(2, "MID")}
    row.update(a=c.area, i1=c.i1, i2=c.i2, i12=c.i12, j=c.j, k1=c.k1, k2=c.k2)
    for name, (y, z) in zip(_POINTS, shape.stress_points):
        row[f"{name}1"], row[f"{name}2"] = float(y), float(z)
    return [{**row, "nsm": f.real(9 + DIMENSIONS[kind], "NSM", 0.0)}]


def pbeaml(f: Fields) -> Rows:
    kind = _kind(f)
    stations = _stations(f, kind)
    shapes = [_section(kind, dims) for _, _, dims, _ in stations]
    row: Row = {"pid": f.integer(1, "PID"), "mid": f.integer(2, "MID")}
    row["xxbs"] = np.array([x for x, _, _, _ in stations])
    row["sos"] = tuple(so for _, so, _, _ in stations)
    row["nsms"] = np.array([nsm for _, _, _, nsm in stations])
    for key, name in (("as", "area"), ("js", "j"), ("i1s", "i1"), ("i2s", "i2")):
        row[key] = np.array([getattr(s.constants, name) for s in shapes])
    row["i12s"] = np.array([s.constants.i12 for s in shapes])
    # Stress points of a beam are measured from its shear center.
    points = np.array([s.stress_points - s.constants.shear_center for s in shapes])
    for k, name in enumerate(_POINTS):
        row[f"{name}1s"], row[f"{name}2s"] = points[:, k, 0], points[:, k, 1]
    row.update(dict.fromkeys("s1 s2 nsia nsib cwa cwb m1a m2a m1b m2b".split(), 0.0))
    row["k1"] = float(np.mean([s.constants.k1 for s in shapes]))
    row["k2"] = float(np.mean([s.constants.k2 for s in shapes]))
    for end, shape in (("a", shapes[0]), ("b", shapes[-1])):
        y, z = -shape.constants.shear_center
        row[f"n1{end}"], row[f"n2{end}"] = float(y), float(z)
    return [row]


def _stations(f: Fields, kind: str) -> list[tuple[float, str, list[float], float]]:
    """(x/xb, SO, dimensions, NSM) in ascending order, both ends included.

    Blank fields of end B take the values of end A; those between are interpolated.
    """
    count = DIMENSIONS[kind]
    first = _dimensions(f, kind, 9)
    nsm = f.real(9 + count, "NSM", 0.0)
    starts = list(f.groups(10 + count, count + 3))
    ends = [k for k in starts if f.real(k + 1, "X/XB", 1.0) == 1.0]
    last = _dimensions(f, kind, ends[0] + 2, first) if ends else first
    last_nsm = f.real(ends[0] + 2 + count, "NSM", nsm) if ends else nsm
    stations = [(0.0, "YES", first, nsm)]
    for k in starts:
        x, so = f.real(k + 1, "X/XB", 1.0), f.word(k, "SO", "YES")
        if not 0.0 < x <= 1.0:
            raise Malformed(f"field X/XB: found {x:g}, expected a number from 0 to 1")
        between = [a + x * (b - a) for a, b in zip(first, last)]
        dims = _dimensions(f, kind, k + 2, between)
        default = nsm + x * (last_nsm - nsm)
        stations.append((x, so, dims, f.real(k + 2 + count, "NSM", default)))
    if not ends:
        stations.append((1.0, "YES", first, nsm))
    stations.sort(key=lambda station: station[0])
    positions = [station[0] for station in stations]
    if len(set(positions)) < len(positions):
        raise Malformed("field X/XB: a station is given twice")
    return stations
