"""CQUAD4 and CQUADR: four-node shells, free of locking, warped or flat.

Compatible linear displacements and rotations on the mean plane; hybrid resultants
(`shell_hybrid`), edge-sampled transverse shear with MacNeal's residual bending
flexibility (`shell_shear`), drilling penalty (`shell_drilling`), offset and warp
(`shell_geometry`). CQUADR has true drilling freedoms instead of the penalty
(`drilling_membrane`) and less flexibility in shear. On rectangles the nodal forces of
CQUAD4 are those of MSC and NX Nastran, of CQUADR those of MSC.
"""

from typing import TYPE_CHECKING

from fem.elements.shells.shell import Shell
from fem.elements.shells.shell_reader import read_shells
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def read_cquad4(deck: "Deck", points: Points) -> list[Shell]:
    """The CQUAD4 blocks of a deck: with PSHELL, with PCOMP; see `read_shells`."""
    return read_shells(deck, points, "CQUAD4", 4)


def read_cquadr(deck: "Deck", points: Points) -> list[Shell]:
    """The CQUADR blocks of a deck: with PSHELL, with PCOMP; see `read_shells`."""
    return read_shells(deck, points, "CQUADR", 4)
