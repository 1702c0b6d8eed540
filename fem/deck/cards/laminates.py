"""PCOMP1 and PCOMP2: plies of one material, as rows of PCOMP."""

from typing import Any

import numpy as np

from fem.deck.fields import Fields
from fem.deck.values import Malformed

Rows = list[dict[str, Any]]


def pcomp1(f: Fields) -> Rows:
    """Plies of one thickness."""
    angles = [f.real(k, "THETA") for k in f.groups(9, 1)]
    thickness = f.real(7, "T")
    return _laminate(f, [thickness] * len(angles), angles, f.text(8))


def pcomp2(f: Fields) -> Rows:
    """Plies of any thickness."""
    plies = [(f.real(k, "T"), f.real(k + 1, "THETA", 0.0)) for k in f.groups(9, 2)]
    return _laminate(f, [t for t, _ in plies], [a for _, a in plies], f.text(7))


def _laminate(f: Fields, ts: list[float], thetas: list[float], lam: str) -> Rows:
    if not ts:
        raise Malformed("no plies, expected at least one THETA")
    if min(ts) <= 0.0:
        raise Malformed("ply thickness T: expected positive numbers")
    count, mid = len(ts), f.integer(6, "MID")
    mirrored = 2.0 if lam.startswith("SYM") else 1.0
    return [
        {
            "pid": f.integer(1, "PID"),
            "z0": f.real(2, "Z0", -0.5 * mirrored * sum(ts)),
            "nsm": f.real(3, "NSM", 0.0),
            "sb": f.real(4, "SB", 0.0),
            "ft": f.text(5),
            "tref": 0.0,
            "ge": 0.0,
            "lam": lam,
            "mids": np.full(count, mid, dtype=np.int64),
            "ts": np.array(ts),
            "thetas": np.array(thetas),
            "souts": ("YES",) * count,
            "plies": np.arange(1, count + 1),
        }
    ]
