"""CTRIA3: three-node shell with constant membrane strain and curvature; CTRIAR.

Its transverse shear is sampled along the sides, with MacNeal's residual bending
flexibility (`shell_shear`), so that it bends without locking; drilling penalty as for
the quadrilateral, true drilling of CTRIAR (`drilling_membrane`). On right triangles the
nodal forces of CTRIA3 are those of MSC and NX Nastran, of CTRIAR those of MSC.
"""

from typing import TYPE_CHECKING

from fem.elements.shells.shell import Shell
from fem.elements.shells.shell_reader import read_shells
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def read_ctria3(deck: "Deck", points: Points) -> list[Shell]:
    """The CTRIA3 blocks of a deck: with PSHELL, with PCOMP; see `read_shells`."""
    return read_shells(deck, points, "CTRIA3", 3)


def read_ctriar(deck: "Deck", points: Points) -> list[Shell]:
    """The CTRIAR blocks of a deck: with PSHELL, with PCOMP; see `read_shells`."""
    return read_shells(deck, points, "CTRIAR", 3)
