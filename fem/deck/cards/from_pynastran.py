"""Rows of the card tables from pyNastran's card objects.

pyNastran knows the shapes, defaults and interpolations of these cards; only attributes
are read here, nothing is imported.
"""

from typing import Any

import numpy as np

from fem.deck.text.values import Malformed

Rows = list[dict[str, Any]]

_STATIONS = {
    "xxbs": "xxb",
    "as": "A",
    "i1s": "i1",
    "i2s": "i2",
    "i12s": "i12",
    "js": "j",
    "nsms": "nsm",
    **{f"{p}{k}s": f"{p}{k}" for p in "cdef" for k in (1, 2)},
}
_ENDS = """
    k1 k2 s1 s2 nsia nsib cwa cwb m1a m2a m1b m2b n1a n2a n1b n2b
""".split()


def pbeam(card: Any) -> Rows:
    row: dict[str, Any] = {"pid": card.pid, "mid": card.mid, "sos": tuple(card.so)}
    row.update({k: np.asarray(getattr(card, v), float) for k, v in _STATIONS.items()})
    row.update({name: float(getattr(card, name)) for name in _ENDS})
    if len(card.xxb) == 1:  # a uniform beam: its end B is like its end A
        row.update({name: np.repeat(row[name], 2) for name in _STATIONS})
        row["xxbs"], row["sos"] = np.array([0.0, 1.0]), ("YES", "YES")
    if row["xxbs"][0] != 0.0 or row["xxbs"][-1] != 1.0:
        raise Malformed(f"stations X/XB {row['xxbs'].tolist()}, expected 0 and 1")
    return [row]


def pbush(card: Any) -> Rows:
    def six(values: list) -> np.ndarray:
        padded = [v or 0.0 for v in values or ()]
        return np.array((padded + [0.0] * 6)[:6])

    row: dict[str, Any] = {"pid": card.pid, "mass": card.mass or 0.0}
    for name in ("sa", "st", "ea", "et"):
        value = getattr(card, name)
        row[name] = 1.0 if value is None else float(value)
    return [{**row, "ks": six(card.Ki), "bs": six(card.Bi), "ges": six(card.GEi)}]


def rbe3(card: Any) -> Rows:
    terms = [
        (float(weight), comps, grid)
        for weight, comps, grids in zip(card.weights, card.comps, card.Gijs)
        for grid in (grids if isinstance(grids, list) else [grids])
    ]
    if not terms:
        raise Malformed("no weights and grids")
    if not card.refc:
        raise Malformed("field REFC is blank, expected component digits")
    weights, comps, grids = zip(*terms)
    return [
        {
            "eid": card.eid,
            "refgrid": card.refgrid,
            "refc": str(card.refc),
            "weights": np.array(weights),
            "comps": tuple(str(c) for c in comps),
            "grids": np.array(grids, dtype=np.int64),
            "umgrids": np.array(card.Gmi, dtype=np.int64),
            "umcomps": tuple(str(c) for c in card.Cmi),
        }
    ]


def tabled1(card: Any) -> Rows:
    xs, ys = _table(card)
    row = {"tid": card.tid, "xaxis": card.xaxis, "yaxis": card.yaxis, "xs": xs}
    return [{**row, "ys": ys, "extrap": card.extrap}]


def tabdmp1(card: Any) -> Rows:
    fs, gs = _table(card)
    return [{"tid": card.tid, "type": card.Type or "G", "fs": fs, "gs": gs}]


def _table(card: Any) -> tuple[np.ndarray, np.ndarray]:
    x, y = np.asarray(card.x, float), np.asarray(card.y, float)
    if len(x) < 2:
        raise Malformed("expected at least two points")
    if (np.diff(x) < 0.0).any() and (np.diff(x) > 0.0).any():
        raise Malformed("X must ascend")
    if x[0] > x[-1]:
        x, y = x[::-1], y[::-1]
    return x, y
