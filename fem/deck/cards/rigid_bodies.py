"""Rigid bodies of a few grids as rows of one table, and splines.

A row has the independent freedoms (ns, cns: grids and components) and the dependent
ones (ms, cms); none of these: all others of its grids.
"""

from typing import Any

import numpy as np

from fem.deck.text.fields import Fields
from fem.deck.text.values import Malformed

Rows = list[dict[str, Any]]
Freedoms = list[tuple[int, str]]

ALL = "123456"


def _row(f: Fields, n: Freedoms, m: Freedoms, *also: int) -> Rows:
    """Grids without a component count for nothing; `also` are part of the body."""
    n, m = ([(g, c) for g, c in part if g and c.strip("0")] for part in (n, m))
    grids = np.array([*(g for g, _ in (*n, *m)), *also], np.int64)
    row: dict[str, Any] = {"eid": f.integer(1, "EID"), "card": f.card.fields[0]}
    for name, part in (("n", n), ("m", m)):
        row[f"{name}s"] = np.array([g for g, _ in part], np.int64)
        row[f"c{name}s"] = tuple(c for _, c in part)
    return [{**row, "grids": np.unique(grids)}]


def rbe1(f: Fields) -> Rows:
    """Three pairs of grid and components on a line, the dependent ones from UM on."""
    parts: dict[str, Freedoms] = {"GN": [], "GM": []}
    name = "GN"
    for line in range(1, len(f), 8):
        name = "GM" if f.text(line) == "UM" else name
        for k in range(line + 1, line + 7, 2):
            if f.text(k) and "." not in f.text(k):  # ALPHA
                pair = f.integer(k, name), f.components(k + 1, f"{name} component")
                parts[name].append(pair)
    if not parts["GM"]:
        raise Malformed("expected UM and the dependent grids")
    return _row(f, parts["GN"], parts["GM"])


def _grids(f: Fields, count: int) -> list[int]:
    return [f.integer(2 + k, f"G{'ABC'[k]}") for k in range(count)]


def rbar1(f: Fields) -> Rows:
    """RBAR1 and RJOINT: GA moves the components CB of GB."""
    ga, gb = _grids(f, 2)
    return _row(f, [(ga, ALL)], [(gb, f.components(4, "CB", ALL))])


def rtrplt(f: Fields) -> Rows:
    grids = _grids(f, 3)
    n = [(g, f.components(5 + k, "CN", "0")) for k, g in enumerate(grids)]
    m = [(g, f.components(9 + k, "CM", "0")) for k, g in enumerate(grids)]
    return _row(f, n, m, *grids)


def rtrplt1(f: Fields) -> Rows:
    ga, *others = _grids(f, 3)
    m = [(g, f.components(5 + k, "CM", ALL)) for k, g in enumerate(others)]
    return _row(f, [(ga, ALL)], m)


def rspline(f: Fields) -> Rows:
    """Grids along a line, blank components: independent."""
    grids, comps = [f.integer(3, "G1")], [""]
    for k in range(4, len(f), 2):
        if f.text(k):
            grids.append(f.integer(k, "G"))
            comps.append(f.components(k + 1, "C", "0").strip("0"))
    if len(grids) < 3 or comps[-1]:
        raise Malformed("expected at least three grids, the last without components")
    ratio = f.real(2, "D/L", 0.1)
    if not ratio > 0.0:
        raise Malformed(f"field D/L: found {ratio:g}, expected a positive number")
    row = {"eid": f.integer(1, "EID"), "ratio": ratio}
    return [{**row, "grids": np.array(grids, np.int64), "comps": tuple(comps)}]
