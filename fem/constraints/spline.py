"""RSPLINE: dependent freedoms of grids along a line follow it as an elastic beam.

A thin tube of the mean diameter D, the given share of the length L of the whole line,
joins the grids in turn; freedoms that are named depend on those that are not, as under
no load: K_dd u_d + K_di u_i = 0. Only ratios of stiffness count: with D = 1, E = 1 and
Poisson's ratio 0.3 the tube of wall t has E A = π D t, E I = E A D²/8, G J = 2 G I (the
guide's tube; ν from memory).
"""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.constraints.equations import (
    Equations,
    components,
    dense_equations,
    equations_of_rows,
)
from fem.elements.lines.bar import BarSection, bar_stiffness
from fem.elements.lines.line_geometry import LineGeometry, axes_about, congruence
from fem.errors import InputError
from fem.geometry.points import Points, grid_freedoms
from fem.properties.materials import Isotropic

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_NU = 0.3


def read_splines(deck: "Deck", points: Points) -> list[Equations]:
    """Equations of all RSPLINE.

    Raises:
        InputError: undefined grids, neighbours that coincide; all of them.
    """
    return equations_of_rows(deck, points, {"RSPLINE": _equations})


def _equations(row: pd.Series, points: Points, source: str) -> Equations:
    at = points.rows(np.asarray(row["grids"], np.int64))
    lines = np.diff(points.xyz[at], axis=0)
    length = np.linalg.norm(lines, axis=1)
    if not length.all():
        raise InputError("neighbours coincide, expected grids along a line")
    k = _beam(lines, length, float(row["ratio"]) * float(length.sum()))
    turn = np.zeros((6 * len(at), 6 * len(at)))
    for i, rotation in enumerate(points.rotation[at]):
        for j in (0, 3):
            rows = slice(6 * i + j, 6 * i + j + 3)
            turn[rows, rows] = rotation
    k = turn.T @ k @ turn
    own = [6 * i + components(c) for i, c in enumerate(row["comps"])]
    d = np.concatenate(own)
    rest = np.setdiff1d(np.arange(6 * len(at)), d)
    # Translations and rotations differ by lengths.
    scale = 1.0 / np.sqrt(np.diag(k)[d])
    square = k[np.ix_(d, d)] * np.outer(scale, scale)
    matrix = -scale[:, None] * np.linalg.solve(square, scale[:, None] * k[d][:, rest])
    matrix[np.abs(matrix) < 1e-13 * np.abs(matrix).max()] = 0.0
    dof = grid_freedoms(at)
    return dense_equations(dof[d], dof[rest], matrix, source)


def _beam(lines: Float64, length: Float64, diameter: float) -> Float64:
    """(6 n, 6 n) of the tube through n grids, basic axes."""
    count = len(length)

    def all_of(value: float) -> Float64:
        return np.full(count, value)

    inertia = diameter**2 / 8.0  # of the area 1
    section = BarSection(
        a=all_of(1.0),
        i1=all_of(inertia),
        i2=all_of(inertia),
        i12=all_of(0.0),
        j=all_of(2.0 * inertia),
        k1=all_of(0.0),
        k2=all_of(0.0),
        nsm=all_of(0.0),
        recovery=np.zeros((count, 4, 2)),
    )
    material = Isotropic(
        e=all_of(1.0),
        g=all_of(0.5 / (1.0 + _NU)),
        nu=all_of(_NU),
        **{name: all_of(0.0) for name in ("rho", "ge", "alpha", "tref")},
    )
    zero = np.zeros((count, 3))
    place = LineGeometry(
        length=length, R_BE=axes_about(lines), offset_a=zero, offset_b=zero
    )
    local = congruence(place.grid_to_end(), bar_stiffness(length, section, material))
    k = np.zeros((6 * count + 6, 6 * count + 6))
    for i, own in enumerate(local):
        k[6 * i : 6 * i + 12, 6 * i : 6 * i + 12] += own
    return k
