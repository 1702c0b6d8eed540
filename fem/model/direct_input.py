"""Direct input of matrices: DMIG selected by K2GG, M2GG, B2GG, P2G in case control."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
import scipy.sparse as sp

from fem.arrays import Float64
from fem.deck.references import table, where
from fem.deck.text.values import Malformed, real
from fem.errors import InputError, nearest
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck

SQUARE, SYMMETRIC, RECTANGULAR = 1, 6, 9
LARGEST = 1e100  # of an entry: products of three stay within double precision


@dataclass(frozen=True, kw_only=True)
class DirectMatrices:
    """Matrices to add to the g-set, None where nothing is selected.

    Attributes:
        external_mass: what of the mass is of external superelements.
    """

    stiffness: sp.csr_matrix | None = None
    mass: sp.csr_matrix | None = None
    damping: sp.csr_matrix | None = None
    external_mass: sp.csr_matrix | None = None


NONE = DirectMatrices()


def read_direct(
    deck: "Deck", points: Points, *, k2gg: str = "", m2gg: str = "", b2gg: str = ""
) -> DirectMatrices:
    """Selected matrices with the factors PARAM CK2, CM2 and CB2.

    Those of external superelements are added as they are.

    Raises:
        InputError: unknown names, freedoms that do not exist, matrices that are not
            symmetric.
    """

    def external(kind: str) -> list[sp.csr_matrix]:
        own = (name for which, name in deck.external if which == kind)
        return [dmig(deck, points, name) for name in own]

    def chosen(name: str, factor: str, kind: str) -> sp.csr_matrix | None:
        terms = external(kind)
        if name:
            scale = deck.number(factor)
            terms += [scale * f * dmig(deck, points, t) for f, t in combination(name)]
        if not terms:
            return None
        total = sp.csr_matrix(sum(terms))
        if len(points.extra_dof) and total[points.extra_dof].nnz:
            raise InputError(
                f"{deck.path}: {name} joins extra points (EPOINT), which have no place "
                f"in the {kind} of the structure; expected it with K2PP, M2PP or B2PP"
            )
        return total

    mass = external("mass")
    return DirectMatrices(
        stiffness=chosen(k2gg, "CK2", "stiffness"),
        mass=chosen(m2gg, "CM2", "mass"),
        damping=chosen(b2gg, "CB2", "damping"),
        external_mass=sp.csr_matrix(sum(mass)) if mass else None,
    )


def combination(text: str) -> list[tuple[float, str]]:
    """Factors and names of a sum of matrices: "KA, 0.5*KB" as case control writes it.

    Raises:
        InputError: a term that is no name and no factor times a name.
    """
    terms = []
    for term in text.replace("(", "").replace(")", "").split(","):
        factor, star, name = (part.strip() for part in term.rpartition("*"))
        try:
            terms.append((real(factor) if star else 1.0, name))
        except Malformed:
            raise InputError(
                f"'{term.strip()}' in {text}: expected NAME or FACTOR*NAME"
            ) from None
    return terms


def dmig(
    deck: "Deck", points: Points, name: str, *, square: bool = False
) -> sp.csr_matrix:
    """(g, g) matrix of a DMIG, real and symmetric.

    Args:
        deck, points: the model.
        name: of the matrix.
        square: it need not be symmetric, and may be complex.

    Raises:
        InputError: see `read_direct`.
    """
    card = _card(deck, name)
    place = where("DMIG", card)
    form, values = int(card["form"]), np.asarray(card["values"])
    if form not in ((SQUARE, SYMMETRIC) if square else (SYMMETRIC,)):
        expected = "1 (square) or 6 (symmetric)" if square else "6 (symmetric)"
        raise InputError(f"{place}: form {form}, expected {expected}")
    if np.iscomplexobj(values) and not square:
        raise InputError(f"{place}: it is complex (TIN), expected a real matrix")
    try:
        row = points.dof(card["rowids"], card["rowcs"])
        column = points.dof(card["colids"], card["colcs"])
    except InputError as error:
        raise InputError(f"{place}: {p}" for p in error.problems) from None
    matrix = sp.csr_matrix((values, (row, column)), shape=(points.size, points.size))
    size = abs(matrix).max() if matrix.nnz else 0.0
    if size > LARGEST:
        raise InputError(f"{place}: found {size:g}, expected no more than {LARGEST:g}")
    if form == SYMMETRIC and abs(matrix - matrix.T).max() > 1e-12 * size:
        raise InputError(f"{place}: the two triangles differ, expected symmetry")
    return matrix


def direct_load(deck: "Deck", points: Points, text: str, number: int) -> Float64:
    """(g,) load of a subcase that P2G gives, with the factor PARAM CP2.

    Args:
        deck, points: the model.
        text: of P2G, a name or a sum.
        number: of the subcase among all, from 1: its column, where there are several.

    Raises:
        InputError: unknown names, freedoms that do not exist, no such column.
    """
    total = np.zeros(points.size)
    for factor, name in combination(text):
        card = _card(deck, name)
        place = where("DMIG", card)
        if int(card["form"]) != RECTANGULAR:
            raise InputError(
                f"{place}: form {card['form']}, expected 9 (rectangular) for P2G"
            )
        if np.iscomplexobj(card["values"]):
            raise InputError(f"{place}: it is complex (TIN), expected a real matrix")
        columns = np.asarray(card["colids"])
        wanted = number if columns.max(initial=1) > 1 else 1
        if wanted not in columns and len(columns):
            raise InputError(
                f"{place}: P2G = {name} in the subcase {number} of the deck: expected "
                f"one column, or column {number} for it"
            )
        own = columns == wanted
        try:
            dof = points.dof(
                np.asarray(card["rowids"])[own], np.asarray(card["rowcs"])[own]
            )
        except InputError as error:
            raise InputError(f"{place}: {p}" for p in error.problems) from None
        np.add.at(total, dof, factor * np.asarray(card["values"], float)[own])
    return deck.number("CP2") * total


def _card(deck: "Deck", name: str) -> pd.Series:
    """The row of a DMIG.

    Raises:
        InputError: there is none.
    """
    rows = table(deck, "DMIG")
    chosen = rows[rows["name"].str.upper() == name.upper()] if len(rows) else rows
    if chosen.empty:
        known = sorted(rows["name"].tolist()) if len(rows) else []
        raise InputError(
            f"DMIG {name} is not in the deck; it has {known or 'none'}"
            + nearest(name, known)
        )
    return chosen.iloc[0]
