"""Constraints of a subcase with what AUTOSPC adds, and the stiffness that is left."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from fem.arrays import Int64
from fem.constraints.autospc import Singularities, find_singularities
from fem.constraints.elimination import Elimination, eliminate
from fem.errors import InputError
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class Support:
    """How a structure is held.

    Attributes:
        elimination: constraints, AUTOSPC included: u_g = T u_f + u_0.
        stiffness: (f, f) K.
        autospc: freedoms that AUTOSPC constrained; None where it is switched off.
    """

    elimination: Elimination
    stiffness: sp.csr_matrix
    autospc: Singularities | None


def support(
    deck: "Deck",
    points: Points,
    stiffness: sp.csr_matrix,
    *,
    spc: int,
    mpc: int,
    generalised: Int64,
) -> Support:
    """Constraints of a subcase after AUTOSPC.

    Args:
        deck: the deck.
        points: numbering.
        stiffness: (g, g) K.
        spc, mpc: sets of constraints, 0: none.
        generalised: rows of the g-set of generalised coordinates (QSET), which have no
            stiffness before a reduction gives them one; they are held here.

    Raises:
        InputError: constraints that contradict each other; no freedom is left although
            AUTOSPC could constrain some.
    """
    elimination = eliminate(deck, points, spc=spc, mpc=mpc)
    elimination = elimination.with_fixed(np.setdiff1d(generalised, elimination.s))
    reduced = elimination.reduce(stiffness)
    if str(deck.param("AUTOSPC")).upper().startswith("N"):
        return Support(elimination=elimination, stiffness=reduced, autospc=None)
    found = find_singularities(
        reduced, elimination, points, epzero=deck.number("EPZERO")
    )
    if len(found.dof):
        keep = ~np.isin(elimination.f, found.dof)
        elimination = elimination.with_fixed(found.dof)
        reduced = sp.csr_matrix(reduced[keep][:, keep])
    # All of it constrained by the user is fine: enforced motion, loads on elements.
    if not len(elimination.f) and len(found.dof):
        raise InputError(
            f"no free freedom is left: {len(found.dof)} have no stiffness "
            "(AUTOSPC), the others are constrained; expected elements that hold "
            "the grids, with a modulus above 0"
        )
    return Support(elimination=elimination, stiffness=reduced, autospc=found)
