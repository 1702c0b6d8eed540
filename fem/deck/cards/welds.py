"""CWELD: its formats on one row."""

from typing import Any

import numpy as np

from fem.deck.text.fields import Fields
from fem.deck.text.values import Malformed

Rows = list[dict[str, Any]]

FORMS = ("PARTPAT", "ELPAT", "ELEMID", "GRIDID", "ALIGN")
_KINDS = ("QQ", "QT", "TQ", "TT", "Q", "T")


def cweld(f: Fields) -> Rows:
    """One row; sides A and B are properties, elements or grids by the form."""
    eid = f.integer(1, "EWID")
    form = f.word(4, "TYPE")
    if form not in FORMS:
        raise Malformed(
            f"field TYPE: found '{form}', expected one of {', '.join(FORMS)}"
        )
    row: dict[str, Any] = {"eid": eid, "pid": f.integer(2, "PWID", eid), "form": form}
    for k, name in ((3, "gs"), (5, "ga"), (6, "gb")):
        row[name] = f.integer(k, name.upper(), 0)
    nothing = np.zeros(0, np.int64)
    row.update(ida=0, idb=0, gas=nothing, gbs=nothing, mcid=f.integer(8, "MCID", -1))
    row.update({f"{axis}s": float("nan") for axis in "xyz"})
    if form == "GRIDID":
        kind = f.word(7, "SPTYP", "")
        row["gas"], row["gbs"] = _patch(f, 9, "GA"), _patch(f, 17, "GB")
        if kind not in (*_KINDS, ""):
            raise Malformed(
                f"field SPTYP: found '{kind}', expected one of {', '.join(_KINDS)}"
            )
        for side, letter in zip(("gas", "gbs"), kind):
            row[side] = row[side][: 3 if letter == "T" else 4]
    elif form != "ALIGN":
        row["ida"], row["idb"] = f.integer(9, "IDA"), f.integer(10, "IDB", 0)
    if form in ("PARTPAT", "ELPAT"):
        if not row["idb"]:
            raise Malformed("field IDB is blank, expected an integer")
        for k, axis in enumerate("xyz"):
            row[f"{axis}s"] = f.real(17 + k, f"{axis.upper()}S", float("nan"))
    return [row]


def _patch(f: Fields, start: int, name: str) -> np.ndarray:
    """Corner grids of a side: three or four, none where it is blank."""
    grids = [f.integer(start + k, f"{name}{k + 1}", 0) for k in range(4)]
    found = [grid for grid in grids if grid]
    if found and (len(found) < 3 or found != grids[: len(found)]):
        raise Malformed(f"field {name}1: found {found}, expected three corner grids")
    return np.array(found, dtype=np.int64)
