"""The place that talks to pyNastran's classes of cards."""

import warnings
from collections.abc import Callable
from typing import Any

from pyNastran.bdf.bdf_interface.bdf_card import BDFCard
from pyNastran.bdf.cards.bdf_tables import TABDMP1, TABLED1
from pyNastran.bdf.cards.elements.rigid import RBE3
from pyNastran.bdf.cards.properties.beam import PBEAM
from pyNastran.bdf.cards.properties.bush import PBUSH

from fem.deck.text.lexer import RawCard
from fem.deck.text.values import Malformed

_CLASSES: dict[str, Any] = {
    "PBEAM": PBEAM,
    "PBUSH": PBUSH,
    "RBE3": RBE3,
    "TABLED1": TABLED1,
    "TABDMP1": TABDMP1,
}


def rows_from_pynastran(
    card: RawCard, extract: Callable[[Any], list[dict[str, Any]]]
) -> list[dict[str, Any]]:
    """Rows of a card from pyNastran's object.

    Raises:
        Malformed: what pyNastran says of the card, in one line.
    """
    fields = [field or None for field in card.fields]
    while fields[-1] is None:
        fields.pop()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # it warns of what it raises, too
            own = _CLASSES[card.name].add_card(BDFCard(fields, has_none=False))
        return extract(own)
    except Malformed:
        raise
    # pyNastran raises whatever its card classes meet in a faulty card.
    except Exception as error:
        text = " ".join(str(error).split("\n")[0].split())
        raise Malformed(text or "is incomplete") from None
