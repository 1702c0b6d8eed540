"""PCOMP and PCOMPG, and PCOMP1, PCOMP2 (plies of one material), as rows of PCOMP.

PCOMPS, of solids, has a table of its own.

With LAM SYM, SYMEM, SYBEND or SYSMEAR the plies are the lower half; the bottom lies
half of the whole thickness below the reference surface then, where Z0 is blank.
"""

import math
from typing import Any

import numpy as np

from fem.deck.text.fields import Fields
from fem.deck.text.values import Malformed

Rows = list[dict[str, Any]]


def pcomp(f: Fields) -> Rows:
    """Four fields a ply; blank MID and T are those of the ply before."""
    return _plies(f, list(f.groups(9, 4)))


def pcompg(f: Fields) -> Rows:
    """A line of eight fields a ply, the number of the ply first."""
    first = list(f.groups(9, 8))
    numbers = [f.integer(k, "GPLYID") for k in first]
    return _plies(f, [k + 1 for k in first], numbers)


def pcomps(f: Fields) -> Rows:
    """Plies of solids: a line of eight fields each; thicknesses count by their ratios.

    Raises:
        Malformed: some are given relative to the element, others are not.
    """
    first = list(f.groups(9, 8))
    flags = {f.word(k + 7, "TFLAG", "REL") for k in first}
    if len(flags) > 1:
        raise Malformed(
            f"fields TFLAG: found {' and '.join(sorted(flags))}, expected one"
        )
    mids = np.array([f.integer(k + 1, "MID") for k in first], np.int64)
    ts = np.array([f.real(k + 2, "T") for k in first], float)
    if not len(first) or ts.min() <= 0.0:
        raise Malformed("ply thickness T: expected positive numbers, at least one")
    psdir = f.components(3, "PSDIR", "13")
    if len(psdir) != 2 or not {*psdir} < {*"123"}:
        raise Malformed(f"field PSDIR: found '{psdir}', expected two of 1, 2 and 3")
    return [
        {
            "pid": f.integer(1, "PID"),
            "cordm": f.integer(2, "CORDM", 0),
            "psdir": psdir,
            "tref": f.real(6, "TREF", math.nan),
            "ge": f.real(7, "GE", 0.0),
            "mids": mids,
            "ts": ts,
            "thetas": np.array([f.real(k + 3, "THETA", 0.0) for k in first]),
            "plies": np.array([f.integer(k, "GPLYID") for k in first], np.int64),
        }
    ]


def _plies(f: Fields, first: list[int], numbers: list[int] | None = None) -> Rows:
    mids: list[int] = []
    ts: list[float] = []
    for k in first:
        mids.append(f.integer(k, "MID", mids[-1] if mids else None))
        ts.append(f.real(k + 1, "T", ts[-1] if ts else None))
    thetas = [f.real(k + 2, "THETA", 0.0) for k in first]
    souts = tuple(f.word(k + 3, "SOUT", "NO") for k in first)
    row = _laminate(f, ts, thetas, f.text(8))[0]
    row["tref"], row["ge"] = f.real(6, "TREF", math.nan), f.real(7, "GE", 0.0)
    row["mids"], row["souts"] = np.array(mids, dtype=np.int64), souts
    if numbers:
        row["plies"] = np.array(numbers, dtype=np.int64)
    return [row]


def pcomp1(f: Fields) -> Rows:
    """Plies of one thickness."""
    angles = [f.real(k, "THETA") for k in f.groups(9, 1)]
    thickness = f.real(7, "T")
    return _uniform(f, [thickness] * len(angles), angles, f.text(8))


def pcomp2(f: Fields) -> Rows:
    """Plies of any thickness."""
    plies = [(f.real(k, "T"), f.real(k + 1, "THETA", 0.0)) for k in f.groups(9, 2)]
    return _uniform(f, [t for t, _ in plies], [a for _, a in plies], f.text(7))


def _uniform(f: Fields, ts: list[float], thetas: list[float], lam: str) -> Rows:
    row = _laminate(f, ts, thetas, lam)[0]
    return [{**row, "mids": np.full(len(ts), f.integer(6, "MID"), dtype=np.int64)}]


def _laminate(f: Fields, ts: list[float], thetas: list[float], lam: str) -> Rows:
    if not ts:
        raise Malformed("no plies, expected at least one")
    if min(ts) <= 0.0:
        raise Malformed("ply thickness T: expected positive numbers")
    count = len(ts)
    mirrored = 2.0 if lam.startswith("SY") else 1.0
    return [
        {
            "pid": f.integer(1, "PID"),
            "z0": f.real(2, "Z0", -0.5 * mirrored * sum(ts)),
            "nsm": f.real(3, "NSM", 0.0),
            "sb": f.real(4, "SB", 0.0),
            "ft": f.text(5),
            "tref": math.nan,
            "ge": 0.0,
            "lam": lam,
            "ts": np.array(ts),
            "thetas": np.array(thetas),
            "souts": ("YES",) * count,
            "plies": np.arange(1, count + 1),
        }
    ]
