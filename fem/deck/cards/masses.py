"""Non-structural mass sets: NSM, NSM1 (per length or area), NSML, NSML1 (lumped);
combinations of masses: MASSSET.
"""

from typing import Any

import numpy as np

from fem.deck.text.fields import Fields
from fem.deck.text.values import Malformed

Rows = list[dict[str, Any]]

ALL = -1  # stands for all ids of the type


def _pairs(f: Fields) -> tuple[np.ndarray, np.ndarray]:
    """(id, value) pairs of NSM and NSML."""
    pairs = [(f.integer(k, "ID"), f.real(k + 1, "VALUE")) for k in f.groups(3, 2)]
    if not pairs:
        raise Malformed("field ID is blank, expected an integer")
    ids, values = zip(*pairs)
    return np.array(ids, dtype=np.int64), np.array(values)


def _ids(f: Fields) -> np.ndarray:
    """Ids of NSM1 and NSML1."""
    if f.text(4) == "ALL":
        return np.array([ALL])
    written, between = f.ids(4, "ID")
    return np.array(sorted({*written, *between}), dtype=np.int64)


def nsm(f: Fields) -> Rows:
    ids, values = _pairs(f)
    row = {"sid": f.integer(1, "SID"), "type": f.word(2, "TYPE")}
    return [{**row, "ids": ids, "values": values}]


def nsm1(f: Fields) -> Rows:
    ids, value = _ids(f), f.real(3, "VALUE")
    row = {"sid": f.integer(1, "SID"), "type": f.word(2, "TYPE")}
    return [{**row, "ids": ids, "values": np.full(len(ids), value)}]


def nsml(f: Fields) -> Rows:
    ids, values = _pairs(f)
    row = {"sid": f.integer(1, "SID"), "type": f.word(2, "TYPE")}
    return [
        {**row, "ids": np.array([i]), "value": float(v)} for i, v in zip(ids, values)
    ]


def nsml1(f: Fields) -> Rows:
    row = {"sid": f.integer(1, "SID"), "type": f.word(2, "TYPE")}
    return [{**row, "ids": _ids(f), "value": f.real(3, "VALUE")}]


def massset(f: Fields) -> Rows:
    """MASSSET; Nastran's default of S0 is 0, which would leave no mass at all."""
    pairs = [(f.real(k, "S", 0.0), f.integer(k + 1, "ID")) for k in f.groups(3, 2)]
    if not pairs:
        raise Malformed("field ID1 is blank, expected an integer")
    factors, ids = zip(*pairs)
    row = {"sid": f.integer(1, "ID"), "s0": f.real(2, "S0")}
    if min(row["s0"], *factors) < 0.0:
        raise Malformed("expected factors >= 0")
    return [{**row, "factors": factors, "massids": ids}]
