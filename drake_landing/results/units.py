"""Units of columns: in the headings of CSV tables and as attributes in results.h5."""

import pandas as pd

from drake_landing.landing.history import UNITS

_COLUMNS = {
    **UNITS,
    **dict.fromkeys(("qw", "qx", "qy", "qz"), "1"),
    **dict.fromkeys(("px", "py", "pz"), "m"),
    **dict.fromkeys(("time", "time_of_min", "time_of_max", "wall", "processor"), "s"),
    **dict.fromkeys(("station", "point_x", "point_y", "point_z"), "m"),
    **dict.fromkeys(("equivalent", "largest", "smallest", "allowed"), "Pa"),
    **{"memory_gb": "GB", "shear": "N", "bending": "N m", "torsion": "N m"},
    **dict.fromkeys(("peak_fe", "peak_mbs"), "m/s²"),
    "highest_hz": "Hz",
    **dict.fromkeys(("F1", "F2", "F3"), "N"),  # monitor points, along their frame
    **dict.fromkeys(("M1", "M2", "M3"), "N m"),
}
_QUANTITIES = {
    **dict.fromkeys(("F1", "F2", "F3"), "N"),
    **dict.fromkeys(("M1", "M2", "M3"), "N m"),
    **dict.fromkeys(("tyre_vertical", "tyre_drag", "shear"), "N"),
    **dict.fromkeys((f"attachment_f{a}" for a in "xyz"), "N"),
    **dict.fromkeys((f"attachment_m{a}" for a in "xyz"), "N m"),
    **dict.fromkeys(("bending", "torsion"), "N m"),
    "stroke": "m",
}


def unit_of(column: str) -> str:
    """Unit of a column or of a quantity by its name; empty where it has none.

    Columns of several things side by side have the name of the thing ahead of theirs:
    `nose_fx`, `wing shear`.
    """
    for name in (column, column.rsplit("_", 1)[-1], column.rsplit(" ", 1)[-1]):
        if name in _COLUMNS:
            return _COLUMNS[name]
    two = "_".join(column.rsplit("_", 2)[-2:])  # slip_angle, fore_aft
    return _COLUMNS.get(two, "")


def with_units(table: pd.DataFrame) -> pd.DataFrame:
    """The table with units in its headings, `time [s]`, index included.

    Columns x, y, z are places here; histories of accelerations have their own headings.
    """
    names = {c: _heading(str(c)) for c in table.columns}
    names |= {c: f"{c} [m]" for c in ("x", "y", "z") if c in names}
    renamed = table.rename(columns=names)
    if table.index.name:
        renamed = renamed.rename_axis(_heading(str(table.index.name)))
    return renamed


def _heading(column: str) -> str:
    two = "_".join(column.rsplit("_", 2)[-2:])
    unit = _COLUMNS.get(two) or unit_of(column)
    return f"{column} [{unit}]" if unit and unit != "1" else column


def quantity_units(table: pd.DataFrame) -> pd.Series:
    """Unit of each row of a table by its column `quantity`, if it has rows."""
    if "quantity" not in table:
        return pd.Series(dtype=object)
    units = [_QUANTITIES.get(str(quantity), "") for quantity in table["quantity"]]
    return pd.Series(units, index=table.index, dtype=object)


def element_result_units(table: pd.DataFrame) -> pd.Series:
    """Unit of each row of a table with `result`, `type`, `column` (Nastran's names)."""
    rows = zip(table["result"], table["type"], table["column"])
    units = [element_unit(result, kind, column) for result, kind, column in rows]
    return pd.Series(units, index=table.index, dtype=object)


def element_unit(result: str, kind: str, column: str) -> str:
    """Unit of one of Nastran's columns of element results.

    Args:
        result: force or stress.
        kind: element type.
        column: of its table.
    """
    name = column.split("_")[0]
    if name in ("fibre", "angle", "x"):
        return {"fibre": "m", "angle": "deg", "x": "1"}[name]
    if column.endswith("_index"):
        return "1"
    if kind.startswith(("CELAS", "CDAMP")):
        # The unit depends on the freedoms that the element joins.
        return "N or N m" if result == "force" else "by the card"
    if result == "stress":
        return "by the card" if kind.startswith("CBUSH") else "Pa"
    if kind.startswith(("CQUAD", "CTRIA")):
        return "N m/m" if name in ("mx", "my", "mxy") else "N/m"
    if kind.startswith("CSHEAR"):
        return "N/m" if name.startswith("shear") else "N"
    turning = ("bending", "torque", "total", "warping", "torsion", "mx", "my", "mz")
    return "N m" if name in turning else "N"
