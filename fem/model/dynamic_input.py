"""What dynamic solutions add to the matrices: K2PP, M2PP, B2PP, transfer functions.

In modes and statics they do not count (nor do extra points, EPOINT). DMIG may be of any
square form, real or, for stiffness, complex: the imaginary part is structural damping,
in frequency responses. Terms of freedoms that SPC holds are left out, moved or not. A
TF adds the row

    (B0 + B1 p + B2 p²) u_d + Σ (A0i + A1i p + A2i p²) u_i = 0

to that of its freedom d: B0 and A0 to K, B1 and A1 to B, B2 and A2 to M, which lose
their symmetry. PARAM G does not act on any of it.

References: NASTRAN User's Manual (1986), cards TF, EPOINT, DMIG, case control
K2PP, TFL; Theoretical Manual, section 9.3.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
import scipy.sparse as sp

from fem.deck.references import table, where
from fem.errors import InputError, Problems
from fem.geometry.points import Points
from fem.model.direct_input import combination, dmig

if TYPE_CHECKING:
    from fem.deck.control.subcase import Subcase
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class DynamicInput:
    """Matrices to add, displacement frames; square, not always symmetric.

    Attributes:
        stiffness, damping, mass: K2, B2 and M2.
        structural: imaginary part of K2, which transients cannot have.
    """

    stiffness: sp.csr_matrix
    damping: sp.csr_matrix
    mass: sp.csr_matrix
    structural: sp.csr_matrix

    def on(self, expand: sp.csr_matrix) -> DynamicInput:
        """The matrices on freedoms that the g-set follows by u_g = expand u."""

        def reduced(matrix: sp.csr_matrix) -> sp.csr_matrix:
            return sp.csr_matrix(expand.T @ (matrix @ expand))

        return DynamicInput(
            stiffness=reduced(self.stiffness),
            damping=reduced(self.damping),
            mass=reduced(self.mass),
            structural=reduced(self.structural),
        )


def read_dynamic_input(
    deck: Deck, points: Points, subcase: Subcase
) -> DynamicInput | None:
    """Matrices that K2PP, M2PP, B2PP and TFL of a subcase select; None: none.

    Raises:
        InputError: unknown names and sets, freedoms that do not exist, matrices that
            are not square, complex ones other than K2PP.
    """
    if not (subcase.k2pp or subcase.m2pp or subcase.b2pp or subcase.tfl):
        return None
    size, problems = points.size, Problems()
    found = []
    for name in ("k2pp", "b2pp", "m2pp"):
        total = sp.csr_matrix((size, size), dtype=complex)
        with problems.gathered(str(deck.path)):
            for factor, one in _terms(getattr(subcase, name)):
                total = total + factor * dmig(deck, points, one, square=True)
            if name != "k2pp" and total.imag.count_nonzero():
                raise InputError(
                    f"{name.upper()} = {getattr(subcase, name)}: the matrix is "
                    "complex, expected a real one (K2PP may be complex)"
                )
        found.append(total)
    transfer: list[sp.csr_matrix] = []
    with problems.gathered():
        transfer = _transfer(deck, points, subcase.tfl)
    problems.report()
    k2, b2, m2 = (
        sp.csr_matrix(own.real + part)
        for own, part in zip(found, transfer, strict=True)
    )
    return DynamicInput(
        stiffness=k2, damping=b2, mass=m2, structural=sp.csr_matrix(found[0].imag)
    )


def _terms(text: str) -> list[tuple[float, str]]:
    return combination(text) if text else []


def _transfer(deck: Deck, points: Points, tfl: int) -> list[sp.csr_matrix]:
    """(g, g) parts of K, B and M of a set of TF; several of one freedom add up.

    Raises:
        InputError: no such set, freedoms that do not exist.
    """
    shape = points.size, points.size
    if not tfl:
        return [sp.csr_matrix(shape)] * 3
    rows = table(deck, "TF")
    rows = rows[rows["sid"] == tfl]
    if rows.empty:
        known = sorted({int(i) for i in table(deck, "TF")["sid"]}) or "none in the deck"
        raise InputError(f"{deck.path}: TFL = {tfl}: expected a set of TF: {known}")
    at, values, problems = [], [], Problems()
    for _, row in rows.iterrows():
        with problems.gathered(where("TF", row)):
            at.append(_places(points, row))
        own = [row[f"b{k}"] for k in range(3)]
        values.append(np.column_stack([own, *np.reshape(row["factors"], (-1, 3))]))
    problems.report()
    place, value = np.hstack(at), np.hstack(values)
    return [sp.csr_matrix((value[k], tuple(place)), shape=shape) for k in range(3)]


def _places(points: Points, row: pd.Series) -> np.ndarray:
    """(2, 1 + n) rows and columns of one TF."""
    d = points.dof(row["gd"], row["cd"])
    columns = np.append(d, points.dof(row["grids"], row["comps"]))
    return np.stack([np.full(len(columns), d), columns])
