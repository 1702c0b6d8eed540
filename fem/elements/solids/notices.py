"""What PSOLID asks for and is not done."""

from typing import TYPE_CHECKING

from fem.deck.references import where
from fem.elements.solids.hexa import HEXA8, HEXA20
from fem.elements.solids.integration import integration_of
from fem.elements.solids.penta import PENTA6, PENTA15
from fem.elements.solids.solid import Shape

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def solid_notices(deck: "Deck") -> list[str]:
    """Ways to integrate that an element does not have; stresses at Gauss points."""
    used = [(s, _pids(deck, s)) for s in (HEXA8, HEXA20, PENTA6, PENTA15)]
    notices = []
    for _, row in deck.cards["PSOLID"].iterrows():
        here = where("PSOLID", row)
        for shape, pids in used:
            way = integration_of(shape, row["integ"], row["isop"])
            if row["pid"] in pids and way is None:
                notices.append(
                    f"{here}: IN '{row['integ']}' with ISOP '{row['isop']}' is not "
                    f"done for {shape.card} with {shape.nodes} nodes, the default "
                    "integration is taken"
                )
        if row["stress"].upper() in ("GAUSS", "1"):
            notices.append(
                f"{here}: STRESS '{row['stress']}' is not done, stresses stand at the "
                "center and the corners"
            )
    return notices


def _pids(deck: "Deck", shape: Shape) -> set[int]:
    cards = deck.cards[shape.card]
    pairs = zip(cards["pid"], cards["nodes"])
    return {int(pid) for pid, grids in pairs if len(grids) == shape.nodes}
