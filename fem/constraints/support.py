"""Constraints of a subcase with what AUTOSPC adds, and the stiffness that is left."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
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
        inert: (n,) rows of the g-set that are held although AUTOSPC is off: they have
            no entry in any matrix, so nothing depends on them.
    """

    elimination: Elimination
    stiffness: sp.csr_matrix
    autospc: Singularities | None
    inert: Int64 = field(default_factory=lambda: np.zeros(0, np.int64))


def support(
    deck: "Deck",
    points: Points,
    stiffness: sp.csr_matrix,
    *,
    spc: int,
    mpc: int,
    generalised: Int64,
    moving: Sequence[sp.csr_matrix] = (),
) -> Support:
    """Constraints of a subcase after AUTOSPC.

    Args:
        deck: the deck.
        points: numbering.
        stiffness: (g, g) K.
        spc, mpc: sets of constraints, 0: none.
        generalised: rows of the g-set of generalised coordinates (QSET), which have no
            stiffness before a reduction gives them one; they are held here.
        moving: (g, g) mass and damping, where the solution has them.

    Raises:
        InputError: constraints that contradict each other; nothing has stiffness.
    """
    elimination = eliminate(deck, points, spc=spc, mpc=mpc)
    elimination = elimination.with_fixed(np.setdiff1d(generalised, elimination.s))
    reduced = elimination.reduce(stiffness)
    if str(deck.param("AUTOSPC")).upper().startswith("N"):
        return _without_inert(elimination, reduced, moving)
    found = find_singularities(
        reduced, elimination, points, epzero=deck.number("EPZERO")
    )
    if len(found.dof):
        keep = ~np.isin(elimination.f, found.dof)
        elimination = elimination.with_fixed(found.dof)
        reduced = sp.csr_matrix(reduced[keep][:, keep])
    # All that is stiff constrained by the user is fine: reactions to loads on elements.
    if not len(elimination.f) and len(found.dof) and not np.any(stiffness.data):
        raise InputError(
            f"{len(found.dof)} freedoms have no stiffness, the others are constrained; "
            "expected elements that hold the grids, with a modulus above 0"
        )
    return Support(elimination=elimination, stiffness=reduced, autospc=found)


def _without_inert(
    elimination: Elimination, stiffness: sp.csr_matrix, moving: Sequence[sp.csr_matrix]
) -> Support:
    """Freedoms without entry in any matrix held, as MSC Nastran does.

    Its results are zero there with AUTOSPC NO (pyNastran models, time_elements and
    buckling_solid_shell_bar).
    """
    used = _rows_used(stiffness)
    for matrix in moving:
        used |= _rows_used(elimination.reduce(matrix))
    inert = elimination.f[~used]
    if len(inert):
        elimination = elimination.with_fixed(inert)
        stiffness = sp.csr_matrix(stiffness[used][:, used])
    return Support(
        elimination=elimination, stiffness=stiffness, autospc=None, inert=inert
    )


def _rows_used(matrix: sp.csr_matrix) -> npt.NDArray[np.bool_]:
    """Which rows of a symmetric matrix have an entry that is not zero."""
    return np.asarray(abs(matrix).sum(axis=1)).ravel() > 0.0
