"""Last touches on the columns of regular cards: fields of two meanings, spellings.

Each function takes the columns of one card name and changes them in place; what is
wrong is appended to `problems`.
"""

import math
from collections.abc import Sequence
from typing import Any

from fem.deck.text.values import Malformed, real

Columns = dict[str, list]
Problems = list[str]

_LOAD_TYPES = {
    **dict.fromkeys(("0", "L", "LO", "LOA", "LOAD"), "LOAD"),
    **dict.fromkeys(("1", "D", "DI", "DIS", "DISP"), "DISP"),
    **dict.fromkeys(("2", "V", "VE", "VEL", "VELO"), "VELO"),
    **dict.fromkeys(("3", "A", "AC", "ACC", "ACCE"), "ACCE"),
}


def _place(columns: Columns, row: int) -> str:
    return f"{columns['file'][row]}:{columns['line'][row]}"


def orientation(columns: Columns, problems: Problems) -> None:
    """X1 is a grid where it is an integer (CBAR, CBEAM, CBUSH)."""
    x1 = columns["x1"]
    columns["g0"] = [x if isinstance(x, int) else 0 for x in x1]
    columns["x1"] = [float("nan") if isinstance(x, int) else x for x in x1]
    for x2 in ("x2", "x3"):  # a vector's blank components are zero
        columns[x2] = [
            0.0 if b != b and a == a else b for a, b in zip(columns["x1"], columns[x2])
        ]


def bend(columns: Columns, problems: Problems) -> None:
    """GEOM says how the arc is given."""
    orientation(columns, problems)
    for row, geom in enumerate(columns["geom"]):
        if geom not in (1, 2, 3, 4):
            problems.append(
                f"{_place(columns, row)}: CBEND {columns['eid'][row]} field GEOM: "
                f"found {geom}, expected 1, 2, 3 or 4"
            )


def pbend(columns: Columns, problems: Problems) -> None:
    """An integer in place of A (FSI) makes it a pipe: mean radius, wall, pressure.

    Its section is the annulus, with Timoshenko's shear factor I b / (A S), b the
    width and S the first moment of half of it; other fields stand elsewhere.
    """
    names = ("fsi", "rm", "wall", "pressure")
    for name in names:
        columns[name] = [0] * len(columns["a"]) if name == "fsi" else []
    for row, a in enumerate(columns["a"]):
        r, t, p = (columns[name][row] for name in ("i1", "i2", "j"))
        pipe = isinstance(a, int) and a in (1, 2)
        for name, value in zip(names[1:], (r, t, p)):
            columns[name].append(value if pipe else 0.0)
        if pipe and 0.0 < t < 2.0 * r:
            columns["fsi"][row] = a
            _pipe(columns, row, r + 0.5 * t, r - 0.5 * t)
        elif pipe:
            problems.append(
                f"{_place(columns, row)}: PBEND {columns['pid'][row]}: found RM {r:g}, "
                f"T {t:g}, expected T above 0 and below twice RM"
            )
        elif isinstance(a, int) or not a > 0.0:
            problems.append(
                f"{_place(columns, row)}: PBEND {columns['pid'][row]} field A: found "
                f"{a}, expected a positive real number, or FSI 1 or 2 of a pipe (3, "
                "Welding Research Council Bulletin 179, is not supported)"
            )
    columns["a"] = [float(a) for a in columns["a"]]


def _pipe(columns: Columns, row: int, outer: float, inner: float) -> None:
    """Section and moved fields of a pipe by its radii."""
    area = math.pi * (outer**2 - inner**2)
    second = math.pi / 4.0 * (outer**4 - inner**4)
    first = 2.0 / 3.0 * (outer**3 - inner**3)
    shear = second * 2.0 * (outer - inner) / (area * first)
    moved = {"nsm": "d1", "rc": "d2", "zc": "e1"}
    moved = {name: columns[other][row] for name, other in moved.items()}
    points = dict.fromkeys(("c1", "c2", "d1", "d2", "e1", "e2", "f1", "f2"), 0.0)
    values = {"a": area, "i1": second, "i2": second, "j": 2.0 * second}
    values |= {"k1": shear, "k2": shear, "deltan": math.nan, **points, **moved}
    for name, value in values.items():
        columns[name][row] = value


def fastener(columns: Columns, problems: Problems) -> None:
    """The sides are properties or elements; a diameter is needed to find them."""
    for row, form in enumerate(columns["form"]):
        if form not in ("PROP", "ELEM"):
            problems.append(
                f"{_place(columns, row)}: CFAST {columns['eid'][row]} field TYPE: "
                f"found '{form}', expected PROP or ELEM"
            )


def rsscon(columns: Columns, problems: Problems) -> None:
    """Ids of elements and of grids apart."""
    count = len(columns["type"])
    names = ("s1", "a1", "b1", "s2", "a2", "b2")
    for name in ("shell", "solid", *names):
        columns[name] = [0] * count
    for row, kind in enumerate(columns["type"]):
        if kind == "ELEM":
            columns["shell"][row] = columns["es1"][row]
            columns["solid"][row] = columns["ea1"][row]
        elif kind == "GRID":
            for name in names:
                columns[name][row] = columns[f"e{name}"][row]
        else:
            problems.append(
                f"{_place(columns, row)}: RSSCON {columns['eid'][row]} field TYPE: "
                f"found '{kind}', expected ELEM or GRID"
            )


def diameter(columns: Columns, problems: Problems, card: str) -> None:
    """A fastener or a weld is round, and has a size."""
    for row, d in enumerate(columns["d"]):
        if not d > 0.0:
            problems.append(
                f"{_place(columns, row)}: {card} {columns['pid'][row]} field D: found "
                f"{d:g}, expected a positive number"
            )


def beam(columns: Columns, problems: Problems) -> None:
    """OFFT is a name; a real number there is BIT, which belongs to p-elements.

    Old decks have a flag there: 1 for a vector, 2 for a grid in the fields before it.
    """
    orientation(columns, problems)
    columns["offt"] = ["GGG" if o in ("1", "2") else o for o in columns["offt"]]
    for row, offt in enumerate(columns["offt"]):
        try:
            real(offt)
        except Malformed:
            if len(offt) == 3 and not set(offt) - set("GOEB"):
                continue
        problems.append(
            f"{_place(columns, row)}: element {columns['eid'][row]} field OFFT: found "
            f"'{offt}', expected GGG, GGO, GOG, GOO or another of three letters"
        )


def shell(columns: Columns, problems: Problems) -> None:
    """THETA is a coordinate system where it is an integer."""
    theta = columns["theta"]
    columns["mcid"] = [t if isinstance(t, int) else -1 for t in theta]
    columns["theta"] = [0.0 if isinstance(t, int) else t for t in theta]


def tload(columns: Columns, problems: Problems) -> None:
    delay = columns["delay"]
    columns["delayid"] = [d if isinstance(d, int) else 0 for d in delay]
    columns["delay"] = [0.0 if isinstance(d, int) else d for d in delay]
    _named_type(columns, problems)


def tload1(columns: Columns, problems: Problems) -> None:
    tload(columns, problems)
    for row, tid in enumerate(columns["tid"]):
        if not isinstance(tid, int):
            problems.append(
                f"{_place(columns, row)}: TLOAD1 field TID: found {tid}, expected the "
                "id of a TABLED1"
            )
    columns["tid"] = [t if isinstance(t, int) else 0 for t in columns["tid"]]


def rload1(columns: Columns, problems: Problems) -> None:
    _rload(columns, problems, ("tc", "td"))


def rload2(columns: Columns, problems: Problems) -> None:
    _rload(columns, problems, ("tb", "tp"))


def _rload(columns: Columns, problems: Problems, functions: Sequence[str]) -> None:
    """Integers are ids of sets and tables, reals the values themselves."""
    for name in ("delay", "phase", *functions):
        given = columns[name]
        columns[f"{name}id"] = [v if isinstance(v, int) else 0 for v in given]
        columns[name] = [0.0 if isinstance(v, int) else v for v in given]
    _named_type(columns, problems)


def _named_type(columns: Columns, problems: Problems) -> None:
    types = columns["type"]
    for row, name in enumerate(types):
        if name not in _LOAD_TYPES:
            problems.append(
                f"{_place(columns, row)}: field TYPE: found '{name}', expected LOAD, "
                "DISP, VELO or ACCE"
            )
    columns["type"] = [_LOAD_TYPES.get(name, "LOAD") for name in types]


def scalar(columns: Columns, problems: Problems) -> None:
    """CELAS3 and its like connect scalar points: component 0."""
    count = len(columns["eid"])
    columns["c1"], columns["c2"] = [0] * count, [0] * count


def celas4(columns: Columns, problems: Problems) -> None:
    scalar(columns, problems)
    count = len(columns["eid"])
    columns["ge"], columns["s"] = [0.0] * count, [0.0] * count


def crod(columns: Columns, problems: Problems) -> None:
    count = len(columns["eid"])
    columns.update(
        mid=[0] * count, **{k: [0.0] * count for k in ("a", "j", "c", "nsm")}
    )


def conrod(columns: Columns, problems: Problems) -> None:
    columns["pid"] = [0] * len(columns["eid"])


def ptube(columns: Columns, problems: Problems) -> None:
    columns["t"] = [
        t if t == t and t else d / 2 for t, d in _pairs(columns, "t", "od1")
    ]


def _pairs(columns: Columns, a: str, b: str) -> list[tuple[Any, Any]]:
    return list(zip(columns[a], columns[b]))


def eigr(columns: Columns, problems: Problems) -> None:
    """EIGR asks for the same modes as EIGRL; the method is ours to choose."""
    count = len(columns["sid"])
    columns.update(v1=columns.pop("f1"), v2=columns.pop("f2"))
    columns.update(msglvl=[0] * count, maxset=[0] * count, shfscl=[0.0] * count)
    eigrl(columns, problems)


def pbar(columns: Columns, problems: Problems) -> None:
    for row, (i1, i2) in enumerate(_pairs(columns, "i1", "i2")):
        if min(i1, i2, columns["a"][row], columns["j"][row]) < 0.0:
            problems.append(
                f"{_place(columns, row)}: PBAR {columns['pid'][row]}: A, I1, I2 and J "
                "must not be negative"
            )


def frame(kind: str, form: int, columns: Columns, problems: Problems) -> None:
    """CORD1R to CORD2S share a table."""
    count = len(columns["cid"])
    columns["type"], columns["form"] = [kind] * count, [form] * count
    for key in ("g1", "g2", "g3", "rid"):
        columns.setdefault(key, [0] * count)
    for key in (f"{p}{k}" for p in "abc" for k in "123"):
        columns.setdefault(key, [float("nan")] * count)


_HIGHEST = 1e15  # Hz; its square still leaves room for stiffness


def eigrl(columns: Columns, problems: Problems) -> None:
    """Numbers of modes and limits that a solution can have."""
    for row, nd in enumerate(columns["nd"]):
        name = f"{_place(columns, row)}: EIGRL {columns['sid'][row]}"
        if nd < 0:
            problems.append(f"{name}: ND {nd}, expected a positive number or blank")
        for limit in ("v1", "v2"):
            if abs(columns[limit][row]) > _HIGHEST:
                problems.append(
                    f"{name}: {limit.upper()} {columns[limit][row]:g} Hz, expected at "
                    f"most {_HIGHEST:g} Hz, or blank for no limit"
                )


def freq3(columns: Columns, problems: Problems) -> None:
    """Checks FREQ3: frequencies that are not negative, at least both ends wanted."""
    for row, f1 in enumerate(columns["f1"]):
        f2, nef = columns["f2"][row], columns["nef"][row]
        kind, cluster = columns["type"][row], columns["cluster"][row]
        if (
            not f1 >= 0.0
            or (f1 == 0.0 and kind == "LOG")
            or f2 < f1
            or nef < 2
            or not cluster > 0.0
            or kind not in ("LINEAR", "LOG")
        ):
            problems.append(
                f"{_place(columns, row)}: FREQ3 {columns['sid'][row]}: found F1 {f1}, "
                f"F2 {f2}, TYPE {kind}, NEF {nef}, CLUSTER {cluster}; expected F2 "
                "above F1, F1 0 (LINEAR) or above, LINEAR or LOG, NEF 2 or more, "
                "CLUSTER above 0"
            )


def freq4(columns: Columns, problems: Problems) -> None:
    """A spread below one, an odd number of frequencies (else the mode is left out)."""
    for row, spread in enumerate(columns["fspd"]):
        if not 0.0 < spread < 1.0 or columns["nfm"][row] < 1:
            problems.append(
                f"{_place(columns, row)}: FREQ4 {columns['sid'][row]}: found FSPD "
                f"{spread}, NFM {columns['nfm'][row]}, expected between 0 and 1, and 1 "
                "or more"
            )
        if columns["nfm"][row] % 2 == 0:
            columns["nfm"][row] += 1
