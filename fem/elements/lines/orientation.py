"""Placing CBAR and CBEAM: orientation vector, OFFT, offsets."""

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.references import where
from fem.elements.lines.line_geometry import LineGeometry, axes_from_vector
from fem.errors import InputError
from fem.geometry.points import Points


def place_lines(rows: pd.DataFrame, card: str, points: Points) -> LineGeometry:
    """Ends and axes of CBAR or CBEAM cards.

    OFFT has three letters: the orientation vector is given in the displacement frame
    of grid A (G) or in the basic frame (B); the offsets of ends A and B in the
    displacement frame of their grid (G) or in the offset frame (O), which is the
    element frame of the line from grid to grid.

    Args:
        rows: table CBAR or CBEAM.
        card: its name.
        points: grids.

    Raises:
        InputError: elements of zero length or without a plane, unknown OFFT; all.
    """
    at_a, at_b = (points.rows(rows[g].to_numpy(np.int64)) for g in ("ga", "gb"))
    xyz_a, xyz_b = points.xyz[at_a], points.xyz[at_b]
    letters = _letters(rows, card)
    v = orientation_vectors(rows, points, letters[:, 0] == "B")
    between = axes_from_vector_or_unit(xyz_b - xyz_a, v, letters[:, 1:] == "O")
    offsets = []
    for end, rotation, letter in (
        ("a", points.rotation[at_a], letters[:, 1]),
        ("b", points.rotation[at_b], letters[:, 2]),
    ):
        w = rows[[f"w{i}{end}" for i in (1, 2, 3)]].to_numpy(float)
        frame = np.where((letter == "O")[:, None, None], between, rotation)
        offsets.append(np.einsum("eij,ej->ei", frame, np.nan_to_num(w)))
    x = xyz_b + offsets[1] - xyz_a - offsets[0]
    length = np.linalg.norm(x, axis=1)
    # A length below rounding of the positions has no direction.
    size = np.linalg.norm(np.abs(xyz_a) + np.abs(xyz_b), axis=1)
    short = ~(length > 1e-12 * size)
    with np.errstate(invalid="ignore", divide="ignore"):
        axes = axes_from_vector(x, v)
    _refuse(rows, card, short, np.isnan(axes).any(axis=(1, 2)) & ~short)
    return LineGeometry(
        length=length, R_BE=axes, offset_a=offsets[0], offset_b=offsets[1]
    )


def orientation_vectors(
    rows: pd.DataFrame, points: Points, basic: np.ndarray
) -> Float64:
    """(e, 3) vectors v in basic axes, by G0 or by X1 X2 X3.

    Args:
        rows: cards with columns ga, g0, x1, x2, x3.
        points: grids.
        basic: (e,) True where X is in the basic frame, else in GA's displacement frame.
    """
    at_a = points.rows(rows["ga"].to_numpy(np.int64))
    given = np.nan_to_num(rows[["x1", "x2", "x3"]].to_numpy(float))
    turned = np.einsum("eij,ej->ei", points.rotation[at_a], given)
    v = np.where(basic[:, None], given, turned)
    g0 = rows["g0"].to_numpy(np.int64)
    by_grid = g0 > 0
    v[by_grid] = points.xyz[points.rows(g0[by_grid])] - points.xyz[at_a[by_grid]]
    return v


def axes_from_vector_or_unit(x: Float64, v: Float64, needed: np.ndarray) -> Float64:
    """Offset frames, the identity for elements that do not need one."""
    axes = np.tile(np.eye(3), (len(x), 1, 1))
    use = needed.any(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        axes[use] = axes_from_vector(x[use], v[use])
    return axes


def _letters(rows: pd.DataFrame, card: str) -> np.ndarray:
    """(e, 3) letters of OFFT, GGG where blank."""
    texts = [str(t).strip().upper() for t in rows["offt"]]
    texts = [
        t if len(t) == 3 else "GGG" if t in ("", "NAN", "NONE") else t for t in texts
    ]
    bad = [
        i
        for i, t in enumerate(texts)
        if len(t) != 3 or t[0] not in "GB" or t[1] not in "GO" or t[2] not in "GO"
    ]
    if bad:
        raise InputError(
            f"{where(card, rows.iloc[i])}: OFFT is {texts[i]!r}, expected G or B, then "
            "G or O twice (GGG)"
            for i in bad
        )
    return np.array([list(t) for t in texts], dtype="U1").reshape(-1, 3)


def _refuse(rows: pd.DataFrame, card: str, short: np.ndarray, flat: np.ndarray) -> None:
    problems = [
        f"{where(card, rows.iloc[i])}: its ends coincide, the element has no length"
        for i in np.flatnonzero(short)
    ] + [
        f"{where(card, rows.iloc[i])}: the orientation vector is zero or parallel to "
        "the element"
        for i in np.flatnonzero(flat)
    ]
    if problems:
        raise InputError(problems)
