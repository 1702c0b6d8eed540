"""Cards that hold lists: sets of ids, element nodes, combinations, time steps.

Each function takes the fields of one card and returns its rows, columns by name.
"""

from typing import Any

import numpy as np

from fem.deck.text.fields import Fields, IdRange
from fem.deck.text.values import Malformed

Row = dict[str, Any]
Rows = list[Row]


_MOST_STEPS = 50_000_000  # their times alone fill 0.4 GB
_STEPS = (1e-15, 1e15)  # s; beyond, powers of them leave no digits of stiffness or mass


def spoint(f: Fields) -> Rows:
    written, between = f.ids(1, "ID")
    return [{"id": i} for i in (*written, *between)]


def spc1(f: Fields) -> Rows:
    sid, c = f.integer(1, "SID"), f.components(2, "C", "0")
    written, ranges = f.ranges(3, "G")
    row: Row = {"sid": sid, "c": c, "d": 0.0}
    rows = [{**row, "g": g, "thru": None} for g in written]
    # Points that a range skips over need not exist: it is unrolled when they are known.
    return rows + [{**row, "g": part.first, "thru": part} for part in ranges]


def tf(f: Fields) -> Rows:
    """A transfer function, from its second line on a line for each other freedom."""
    groups = list(f.groups(9, 5, 8))
    return [
        {
            "sid": f.integer(1, "SID"),
            "gd": f.integer(2, "GD"),
            "cd": f.integer(3, "CD", 0),
            **{f"b{k}": f.real(4 + k, f"B{k}", 0.0) for k in range(3)},
            "grids": np.array([f.integer(k, "G") for k in groups], np.int64),
            "comps": np.array([f.integer(k + 1, "C", 0) for k in groups], np.int64),
            "factors": np.array(
                [[f.real(k + 2 + j, f"A{j}", 0.0) for j in range(3)] for k in groups],
                float,
            ).reshape(-1, 3),
        }
    ]


def freedoms(f: Fields) -> Rows:
    """ASET1, BSET1, CSET1, OMIT1 and QSET1."""
    c = f.components(1, "C", "0")
    written, ranges = f.ranges(2, "ID")
    rows = [{"id": i, "c": c, "thru": None} for i in written]
    return rows + [{"id": part.first, "c": c, "thru": part} for part in ranges]


def seset(f: Fields) -> Rows:
    """Interior points of a superelement."""
    seid = f.integer(1, "SEID")
    written, ranges = f.ranges(2, "G1")
    rows = [{"seid": seid, "id": i, "thru": None} for i in written]
    return rows + [{"seid": seid, "id": r.first, "thru": r} for r in ranges]


def se_set(f: Fields) -> Rows:
    """SEBSET, SECSET and SEQSET: pairs of point and components."""
    seid = f.integer(1, "SEID")
    return [
        {
            "seid": seid,
            "id": f.integer(k, "ID"),
            "c": f.components(k + 1, "C", "0"),
            "thru": None,
        }
        for k in f.groups(2, 2)
    ]


def se_set1(f: Fields) -> Rows:
    """SEBSET1, SECSET1 and SEQSET1: points with like components."""
    row = {"seid": f.integer(1, "SEID"), "c": f.components(2, "C", "0")}
    written, ranges = f.ranges(3, "ID1")
    rows = [{**row, "id": i, "thru": None} for i in written]
    return rows + [{**row, "id": r.first, "thru": r} for r in ranges]


def add(f: Fields) -> Rows:
    """SPCADD, MPCADD, NSMADD."""
    written, between = f.ids(2, "S1")
    return [{"sid": f.integer(1, "SID"), "sets": (*written, *between)}]


def set1(f: Fields) -> Rows:
    """SET1: ids and ranges; SKIN and the like are no ids."""
    written, between = f.ids(2, "ID1")
    return [{"sid": f.integer(1, "SID"), "ids": tuple(sorted({*written, *between}))}]


def load(f: Fields) -> Rows:
    """LOAD and DLOAD."""
    pairs = [(f.real(k, "SCALE"), f.integer(k + 1, "LID")) for k in f.groups(3, 2)]
    if not pairs:
        raise Malformed("field L1 is blank, expected an integer")
    scales, lids = zip(*pairs)
    row = {"sid": f.integer(1, "SID"), "s": f.real(2, "S", 1.0)}
    return [{**row, "scales": scales, "lids": lids}]


def rbe2(f: Fields) -> Rows:
    texts = [text for text in f.card.fields[4:] if text]
    # ALPHA and TREF may follow the grids; they act with temperatures only.
    while texts and "." in texts[-1]:
        texts.pop()
    grids = Fields(type(f.card)(["RBE2", *texts], f.card.file, f.card.line))
    written, between = grids.ids(1, "GM1")
    row = {"eid": f.integer(1, "EID"), "gn": f.integer(2, "GN")}
    row["cm"] = f.components(3, "CM")
    return [{**row, "gms": np.array(sorted({*written, *between}), dtype=np.int64)}]


def mpc(f: Fields) -> Rows:
    terms = []
    for row in range(1, len(f), 8):
        for k in (row + 1, row + 4):
            if any(f.card.fields[k : k + 3]):
                number = len(terms) + 1
                c = f.components(k + 1, f"C{number}", "0")
                if len(c) > 1:
                    raise Malformed(f"field C{number}: found '{c}', expected one digit")
                g = f.integer(k, f"G{number}")
                terms.append((g, int(c), f.real(k + 2, f"A{number}", 0.0)))
    if not terms or terms[0][2] == 0.0:
        raise Malformed("field A1: expected a number that is not 0")
    grids, comps, coefficients = (np.array(column) for column in zip(*terms))
    row = {"sid": f.integer(1, "SID"), "grids": grids, "comps": comps}
    return [{**row, "coefficients": coefficients}]


def pload2(f: Fields) -> Rows:
    written, ranges = f.ranges(3, "EID1")
    row: Row = {"sid": f.integer(1, "SID"), "p": f.real(2, "P")}
    return [{**row, "eids": np.array(written, np.int64), "thru": tuple(ranges)}]


def pload4(f: Fields) -> Rows:
    p1 = f.real(3, "P1", 0.0)
    row: Row = {"sid": f.integer(1, "SID"), "p1": p1, "g1": 0, "g34": 0}
    row.update({f"p{k}": f.real(2 + k, f"P{k}", p1) for k in (2, 3, 4)})
    eids, ranges = [f.integer(2, "EID")], ()
    if f.text(7) == "THRU":
        last = f.integer(8, "EID2")
        if last < eids[0]:
            raise Malformed("field EID2: expected an ascending range")
        eids, ranges = [], (IdRange(eids[0], last),)
    else:
        row["g1"], row["g34"] = f.integer(7, "G1", 0), f.integer(8, "G34", 0)
    row["cid"] = f.integer(9, "CID", 0)
    row.update({f"n{k}": f.real(9 + k, f"N{k}", 0.0) for k in (1, 2, 3)})
    row["sorl"], row["ldir"] = f.word(13, "SORL", "SURF"), f.word(14, "LDIR", "NORM")
    return [{**row, "eids": np.array(eids, dtype=np.int64), "thru": ranges}]


def accel(f: Fields) -> Rows:
    """ACCEL: a vector, the axis along which it varies, places and factors."""
    row: Row = {"sid": f.integer(1, "SID"), "cid": f.integer(2, "CID", 0)}
    row.update({f"n{k}": f.real(2 + k, f"N{k}", 0.0) for k in (1, 2, 3)})
    row["dir"] = f.word(6, "DIR")
    if row["dir"] not in ("X", "Y", "Z"):
        raise Malformed(f"field DIR: found '{row['dir']}', expected X, Y or Z")
    pairs = [(f.real(k, "LOC"), f.real(k + 1, "VAL")) for k in f.groups(9, 2)]
    if len({place for place, _ in pairs}) < max(2, len(pairs)):
        raise Malformed("expected two or more different places LOC with their VAL")
    places, factors = zip(*sorted(pairs))
    return [{**row, "locs": np.array(places), "vals": np.array(factors)}]


def accel1(f: Fields) -> Rows:
    row: Row = {"sid": f.integer(1, "SID"), "cid": f.integer(2, "CID", 0)}
    row["a"] = f.real(3, "A")
    row.update({f"n{k}": f.real(3 + k, f"N{k}", 0.0) for k in (1, 2, 3)})
    written, between = f.ids(9, "GRIDID")
    return [{**row, "grids": np.array(sorted({*written, *between}), dtype=np.int64)}]


def freq(f: Fields) -> Rows:
    """FREQ: frequencies (Hz) as they come."""
    found = [f.real(k, "F") for k in f.groups(2, 1)]
    if not found or min(found) < 0.0:
        raise Malformed(f"found {found}, expected frequencies of 0 Hz or more")
    return [{"sid": f.integer(1, "SID"), "fs": np.unique(found)}]


def freq5(f: Fields) -> Rows:
    """FREQ5: fractions of natural frequencies between F1 and F2."""
    found = [f.real(k, "FR") for k in f.groups(4, 1)]
    if not found or min(found) <= 0.0:
        raise Malformed(f"found {found}, expected fractions above 0")
    row = {"sid": f.integer(1, "SID"), "f1": f.real(2, "F1", 0.0)}
    return [{**row, "f2": f.real(3, "F2", 1e20), "frs": np.unique(found)}]


def tstep(f: Fields) -> Rows:
    steps = []
    for k in f.groups(2, 3, row=8):
        count, step = f.integer(k, "N"), f.real(k + 1, "DT")
        output = f.integer(k + 2, "NO", 1)
        if count < 1 or not step > 0.0 or output < 1:
            raise Malformed(
                f"found N {count}, DT {step}, NO {output}, expected positive numbers"
            )
        if count > _MOST_STEPS or not _STEPS[0] <= step <= _STEPS[1]:
            raise Malformed(
                f"found N {count}, DT {step:g}, expected at most {_MOST_STEPS} steps "
                f"of {_STEPS[0]:g} to {_STEPS[1]:g} s"
            )
        steps.append((count, step, output))
    if not steps:
        raise Malformed("field N1 is blank, expected an integer")
    counts, sizes, outputs = zip(*steps)
    row = {"sid": f.integer(1, "SID"), "counts": counts}
    return [{**row, "steps": sizes, "outputs": outputs}]


def seconct(f: Fields) -> Rows:
    """Pairs of points that two superelements share; SEIDB 0 is the residual one.

    Each line has pairs, or GIDA1 THRU GIDA2 GIDB1 THRU GIDB2.
    """
    first: list[int] = []
    second: list[int] = []
    for line in range(9, len(f), 8):
        if "THRU" in (f.text(line + 1), f.text(line + 4)):
            a, b = _range(f, line, "GIDA"), _range(f, line + 3, "GIDB")
            if len(a) != len(b):
                raise Malformed(
                    "expected GIDA1 THRU GIDA2 GIDB1 THRU GIDB2, equally long"
                )
        else:
            at = [k for k in range(line, line + 8, 2) if f.text(k) or f.text(k + 1)]
            a = [f.integer(k, "GIDA") for k in at]
            b = [f.integer(k + 1, "GIDB") for k in at]
        first += a
        second += b
    row = {"sea": f.integer(1, "SEIDA"), "seb": f.integer(2, "SEIDB")}
    columns = (np.array(ids, dtype=np.int64) for ids in (first, second))
    return [{**row, **dict(zip(("gidas", "gidbs"), columns))}]


def _range(f: Fields, at: int, name: str) -> list[int]:
    """Ids of FIRST THRU LAST."""
    if f.text(at + 1) != "THRU":
        raise Malformed(f"expected {name}1 THRU {name}2")
    return list(range(f.integer(at, f"{name}1"), f.integer(at + 2, f"{name}2") + 1))


def tabled2(f: Fields) -> Rows:
    """TABLED2: pairs whose x counts from X1."""
    xs, ys = _pairs_to_end(f)
    return [_shifted_table(f, 2, 1.0, xs, ys, f.integer(3, "EXTRAP", 0))]


def tabled3(f: Fields) -> Rows:
    """TABLED3: pairs over (x - X1) / X2."""
    scale = f.real(3, "X2")
    if scale == 0.0:
        raise Malformed("X2 is 0, expected another number")
    xs, ys = _pairs_to_end(f)
    return [_shifted_table(f, 3, scale, xs, ys, f.integer(4, "EXTRAP", 0))]


def tabled4(f: Fields) -> Rows:
    """TABLED4: coefficients of a power series in (x - X1) / X2; X3, X4 its limits."""
    scale = f.real(3, "X2")
    if scale == 0.0:
        raise Malformed("X2 is 0, expected another number")
    limits = np.array([f.real(4, "X3"), f.real(5, "X4")])
    terms = []
    for k in range(9, len(f)):
        if f.text(k) == "ENDT":
            break
        terms.append(f.real(k, "A", 0.0))
    return [_shifted_table(f, 4, scale, limits, np.array(terms), 0)]


def _shifted_table(
    f: Fields, kind: int, scale: float, xs: np.ndarray, ys: np.ndarray, extrap: int
) -> Row:
    row = {"tid": f.integer(1, "TID"), "x1": f.real(2, "X1", 0.0), "x2": scale}
    return {**row, "kind": kind, "xs": xs, "ys": ys, "extrap": extrap}


def _pairs_to_end(f: Fields) -> tuple[np.ndarray, np.ndarray]:
    """Pairs x, y from the second line to ENDT; SKIP leaves one out."""
    pairs = []
    for k in range(9, len(f), 2):
        if "ENDT" in (f.text(k), f.text(k + 1)):
            break
        if "SKIP" in (f.text(k), f.text(k + 1)) or not f.text(k):
            continue
        pairs.append((f.real(k, "X"), f.real(k + 1, "Y")))
    if len(pairs) < 2:
        raise Malformed("expected at least two points")
    xs, ys = np.array(pairs).T
    if xs[0] > xs[-1]:
        xs, ys = xs[::-1], ys[::-1]
    if (np.diff(xs) < 0.0).any():
        raise Malformed("X must ascend")
    return xs, ys


def temprb(f: Fields) -> Rows:
    """Temperatures of line elements: EID1 with the fields, further ones below."""
    row: Row = {"sid": f.integer(1, "SID")}
    for k, name in enumerate(("ta", "tb", "tp1a", "tp1b", "tp2a", "tp2b")):
        row[name] = f.real(3 + k, name.upper(), 0.0)
    written, between = f.ids(17, "EID2") if len(f) > 17 else ([], [])
    return [{**row, "eid": e} for e in (f.integer(2, "EID1"), *written, *between)]


def tempp1(f: Fields) -> Rows:
    """Temperatures of shells: EID1 with the fields, further ones below."""
    row: Row = {"sid": f.integer(1, "SID")}
    row["tbar"], row["tprime"] = f.real(3, "TBAR"), f.real(4, "TPRIME", 0.0)
    written, between = f.ids(9, "EID2") if len(f) > 9 else ([], [])
    return [{**row, "eid": e} for e in (f.integer(2, "EID1"), *written, *between)]


def pbusht(f: Fields) -> Rows:
    """PBUSHT: tables of K, B and GE in rows of eight fields, in any order.

    KN, force over deflection, is for nonlinear solutions.
    """
    tables = {name: np.zeros(6, np.int64) for name in ("K", "B", "GE", "KN")}
    for start in range(2, len(f), 8):
        name = f.word(start, "TYPE", "")
        if not name:
            continue
        if name not in tables:
            raise Malformed(f"field TYPE: found {name}, expected K, B, GE or KN")
        tables[name] = np.array([f.integer(start + k, "TID", 0) for k in range(1, 7)])
    row = {"pid": f.integer(1, "PID"), "ks": np.ones(6), "bs": np.ones(6)}
    given = {f"{name.lower()}tables": tables[name] for name in ("K", "B", "GE")}
    return [{**row, **given}]


def pelast(f: Fields) -> Rows:
    """PELAST: tables of K and GE; that of force over elongation is not linear."""
    k, ge = f.integer(2, "TKID", 0), f.integer(3, "TGEID", 0)
    return [{"pid": f.integer(1, "PID"), "ktable": k, "getable": ge, "k": 1.0}]


def pdampt(f: Fields) -> Rows:
    """PDAMPT: the table of B."""
    return [{"pid": f.integer(1, "PID1"), "btable": f.integer(2, "TBID1", 0), "b": 1.0}]
