"""Monitor points and the components that they sum over."""

from typing import Any

from fem.deck.text.fields import Fields
from fem.deck.text.values import Malformed

Rows = list[dict[str, Any]]


def _point(f: Fields, at: int) -> dict[str, Any]:
    """CP and coordinates, four fields."""
    row: dict[str, Any] = {"cp": f.integer(at, "CP", 0)}
    for k, name in enumerate(("x1", "x2", "x3")):
        row[name] = f.real(at + 1 + k, "XYZ"[k], 0.0)
    return row


def _axes(f: Fields) -> str:
    axes = f.components(9, "AXES")
    if not axes.strip("0"):
        raise Malformed("field AXES is blank, expected digits from 1 to 6")
    return axes


def monpnt1(f: Fields) -> Rows:
    """Loads of all grids of a component."""
    row = {"name": f.word(1, "NAME"), "label": f.text(2).strip(), "axes": _axes(f)}
    row |= {"comp": f.word(10, "COMP"), **_point(f, 11)}
    row["cd"] = f.integer(15, "CD", row["cp"])
    return [row]


def monpnt3(f: Fields) -> Rows:
    """Forces of elements on grids."""
    row = {"name": f.word(1, "NAME"), "label": f.text(2).strip(), "axes": _axes(f)}
    row |= {"gridset": f.integer(10, "GRIDSET"), "elemset": f.integer(11, "ELEMSET", 0)}
    row |= _point(f, 12)
    row["xflag"] = f.text(16).strip()
    row["cd"] = f.integer(17, "CD", row["cp"])
    return [row]


def aecomp(f: Fields) -> Rows:
    """Names of lists; words after LISTTYPE are ids, or other components (AECOMPL)."""
    row = {"name": f.word(1, "NAME"), "type": f.word(2, "LISTTYPE")}
    return [{**row, "lists": tuple(t for t in f.card.fields[3:] if t)}]


def aecompl(f: Fields) -> Rows:
    row = {"name": f.word(1, "NAME"), "type": "AECOMPL"}
    lists = tuple(t for t in f.card.fields[2:] if t)
    if not lists:
        raise Malformed("field LABEL1 is blank, expected the name of a component")
    return [{**row, "lists": lists}]
