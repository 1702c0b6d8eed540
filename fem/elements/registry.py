"""Card names and the functions that read them into element blocks.

A further element type is one module and one line here.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING

from fem.elements.block import ElementBlock
from fem.elements.lines.bar import read_cbar
from fem.elements.lines.beam import beam_notices, read_cbeam
from fem.elements.lines.rod import read_crod, read_ctube
from fem.elements.nonstructural_mass import add_nonstructural_mass
from fem.elements.scalars.bush import read_cbush
from fem.elements.scalars.concentrated_mass import read_conm1, read_conm2
from fem.elements.scalars.scalar import read_cdamp, read_celas1, read_celas2, read_cmass
from fem.elements.scalars.visc import read_cvisc
from fem.elements.shells.quad4 import read_cquad4
from fem.elements.shells.shear_panel import read_cshear
from fem.elements.shells.tria3 import read_ctria3
from fem.elements.solids.hexa import read_chexa
from fem.elements.solids.penta import read_cpenta
from fem.elements.solids.pyramid import read_cpyram
from fem.elements.solids.tetra import read_ctetra
from fem.errors import InputError
from fem.geometry.points import Points
from fem.properties.shells import strength_notices

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fem.deck.deck import Deck

Reader = Callable[["Deck", Points], "Sequence[ElementBlock]"]

# Each reader stands under the card that it begins with; CONROD comes with CROD, the
# scalar elements 1 and 2 with their first, 3 and 4 share their tables.
READERS: dict[str, Reader] = {
    "CBAR": read_cbar,
    "CBEAM": read_cbeam,
    "CBUSH": read_cbush,
    "CDAMP1": read_cdamp,
    "CELAS1": read_celas1,
    "CELAS2": read_celas2,
    "CHEXA": read_chexa,
    "CMASS1": read_cmass,
    "CONM1": read_conm1,
    "CONM2": read_conm2,
    "CPENTA": read_cpenta,
    "CPYRAM": read_cpyram,
    "CQUAD4": read_cquad4,
    "CROD": read_crod,
    "CSHEAR": read_cshear,
    "CTETRA": read_ctetra,
    "CTRIA3": read_ctria3,
    "CTUBE": read_ctube,
    "CVISC": read_cvisc,
}


def read_elements(deck: "Deck", points: Points, *, nsm: int = 0) -> list[ElementBlock]:
    """All elements of a deck.

    Args:
        deck: the deck.
        points: its points.
        nsm: set of non-structural mass that case control selects, 0 for none.

    Raises:
        InputError: what is wrong with any element, of all types together.
    """
    blocks: list[ElementBlock] = []
    problems: list[str] = []
    for reader in READERS.values():
        try:
            blocks += reader(deck, points)
        except InputError as error:
            problems += error.problems
    if problems:
        raise InputError(problems)
    return add_nonstructural_mass(deck, blocks, nsm)


def element_notices(deck: "Deck") -> list[str]:
    """What the cards ask for and the elements do not model."""
    return [*beam_notices(deck), *strength_notices(deck)]
