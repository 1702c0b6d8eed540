"""Cards of solids and slices, and small symmetric matrices given by their triangle.

Each function takes the fields of one card and returns its rows, columns by name.
"""

import math
from typing import Any

import numpy as np

from fem.deck.text.fields import Fields
from fem.deck.text.values import Malformed

Row = dict[str, Any]
Rows = list[Row]


def solid(f: Fields, *, most: int, corners: int) -> Rows:
    """CHEXA, CPENTA, CTETRA, CPYRAM."""
    if any(f.card.fields[3 + most :]):
        raise Malformed(f"more than {most} grids")
    nodes = np.array(
        [f.integer(3 + k, f"G{k + 1}", 0) for k in range(most)], dtype=np.int64
    )
    if (nodes[:corners] <= 0).any():
        raise Malformed(f"expected {corners} corner grids")
    if not nodes[corners:].any():
        nodes = nodes[:corners]
    eid = f.integer(1, "EID")
    return [{"eid": eid, "pid": f.integer(2, "PID", eid), "nodes": nodes}]


def plane(f: Fields, count: int) -> Rows:
    """Elements of plane strain and plane stress: grids, then THETA, which isotropic
    materials do not need.

    Raises:
        Malformed: fields beyond, thicknesses at grids.
    """
    nodes = [f.integer(k + 3, f"G{k + 1}") for k in range(count)]
    given = [k for k in range(count + 3, len(f)) if f.text(k)]
    for k in given[:1]:
        f.real(k, "THETA")
    if len(given) > 1:
        raise Malformed(
            f"found {f.text(given[1])} after THETA, expected nothing: thicknesses at "
            "grids are not supported"
        )
    row: Row = {"eid": f.integer(1, "EID"), "pid": f.integer(2, "PID")}
    return [{**row, "nodes": np.array(nodes, np.int64)}]


def _symmetric(f: Fields, start: int, name: str, *, lower: bool) -> np.ndarray:
    """(6, 6) symmetric matrix of 21 fields, row by row of one triangle."""
    triangle = np.tril_indices(6) if lower else np.triu_indices(6)
    matrix = np.zeros((6, 6))
    matrix[triangle] = f.reals(start, 21, name, 0.0)
    return matrix + matrix.T - np.diag(np.diag(matrix))


def conm1(f: Fields) -> Rows:
    row = {"eid": f.integer(1, "EID"), "g": f.integer(2, "G")}
    row["cid"] = f.integer(3, "CID", 0)
    return [{**row, "ms": _symmetric(f, 4, "M", lower=True)}]


def mat9(f: Fields) -> Rows:
    row: Row = {"mid": f.integer(1, "MID")}
    row["gs"] = _symmetric(f, 2, "G", lower=False)
    row["alphas"] = np.array([f.real(24 + k, f"A{k + 1}", 0.0) for k in range(6)])
    row["tref"] = f.real(30, "TREF", math.nan)
    return [{**row, "rho": f.real(23, "RHO", 0.0), "ge": f.real(31, "GE", 0.0)}]


def mat11(f: Fields) -> Rows:
    """A solid of three planes of symmetry as a MAT9.

    Raises:
        Malformed: moduli that are not positive, ratios that no solid has.
    """
    e1, e2, e3 = (f.real(k + 2, f"E{k + 1}") for k in range(3))
    nu12, nu13, nu23 = (f.real(k + 5, f"NU{n}") for k, n in enumerate((12, 13, 23)))
    g12, g13, g23 = (f.real(k + 8, f"G{n}") for k, n in enumerate((12, 13, 23)))
    if min(e1, e2, e3, g12, g13, g23) <= 0.0:
        raise Malformed("moduli E and G: expected positive numbers")
    compliance = np.diag(1.0 / np.array([e1, e2, e3, g12, g23, g13]))
    for i, j, value in ((0, 1, nu12 / e1), (0, 2, nu13 / e1), (1, 2, nu23 / e2)):
        compliance[i, j] = compliance[j, i] = -value
    if np.linalg.eigvalsh(compliance)[0] <= 0.0:
        raise Malformed(
            f"NU12 {nu12:g}, NU13 {nu13:g}, NU23 {nu23:g}: with these E the material "
            "would give energy away; expected smaller ratios"
        )
    alphas = np.array([f.real(12 + k, f"A{k + 1}", 0.0) for k in range(3)] + [0.0] * 3)
    row: Row = {"mid": f.integer(1, "MID"), "gs": np.linalg.inv(compliance)}
    row.update(alphas=alphas, tref=f.real(15, "TREF", math.nan))
    return [{**row, "rho": f.real(11, "RHO", 0.0), "ge": f.real(16, "GE", 0.0)}]
