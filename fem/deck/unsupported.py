"""Cards that are not supported: ignored on request, without effect, or refused."""

from collections.abc import Collection, Sequence

from fem.deck.catalogue import PROPERTY_OF, WITHOUT_EFFECT, reason
from fem.deck.records import CARDS
from fem.deck.text.lexer import RawCard

_READABLE = frozenset(name for name, card in CARDS.items() if card.readable)
SUPPORTED: tuple[str, ...] = tuple(sorted({*_READABLE, "PARAM"}))


def take_unsupported(
    groups: dict[str, list[RawCard]],
    ignore: Collection[str],
    problems: list[str],
    notices: list[str],
) -> list[RawCard]:
    """Take cards that are not supported out of `groups`.

    Returns:
        Those that the user wants ignored.
    """
    ignore = {*ignore, *(PROPERTY_OF[name] for name in ignore if name in PROPERTY_OF)}
    absent = sorted(ignore - groups.keys() - set(PROPERTY_OF.values()) - {"CASE"})
    if absent:
        notices.append(f"to be ignored, but not in the deck: {', '.join(absent)}")
    unused: list[str] = []
    present = frozenset(groups)
    ignored: list[RawCard] = []
    unsupported: list[str] = []
    for name in sorted(groups):
        if name in ignore:
            cards = groups.pop(name)
            ignored += cards
            notices.append(f"{_lines(name, cards)} ignored on request")
        elif name not in _READABLE:
            cards = groups.pop(name)
            users = [card for card, prop in PROPERTY_OF.items() if prop == name]
            if name in WITHOUT_EFFECT or (users and not present.intersection(users)):
                unused.append(f"{name} ({len(cards)})")
            else:
                unsupported.append(name)
                problems.append(
                    f"{_lines(name, cards)} not supported{reason(name) or _hint(name)}"
                )
    if unused:
        notices.append(f"cards without effect here: {', '.join(unused)}")
    if unsupported:
        problems.append(
            f"to go on without them: --ignore {','.join(unsupported)} "
            "of python -m fem, or airframe.ignore of a case"
        )
    return ignored


def _hint(name: str) -> str:
    """A card that the name may be a slip of: one letter, or two that changed places."""
    near = [card for card in SUPPORTED if _is_slip(name, card)]
    return f"; did you mean '{near[0]}'?" if near else ""


def _is_slip(name: str, card: str) -> bool:
    """Whether a name is a card's but for one letter more, less, wrong, or a swap.

    Digits are no slips: CBUSH2D is not a misspelt CBUSH.
    """
    if sorted(name) == sorted(card) and len(name) > 3:
        return sum(a != b for a, b in zip(name, card)) == 2
    short, long = sorted((name, card), key=len)
    if len(long) < 4 or len(long) - len(short) > 1:
        return False
    at = next((i for i, (a, b) in enumerate(zip(short, long)) if a != b), len(short))
    same = len(short) == len(long)
    letters = {long[at : at + 1], short[at : at + 1] if same else ""}
    return short[at + same :] == long[at + 1 :] and "".join(letters).isalpha()


def _lines(name: str, cards: Sequence[RawCard]) -> str:
    """Where the cards of one name are: "CBEND (2 cards; a.bdf:12, a.bdf:13)"."""
    places = ", ".join(card.place for card in cards[:5])
    more = ", ..." if len(cards) > 5 else ""
    plural = "cards" if len(cards) > 1 else "card"
    return f"{name} ({len(cards)} {plural}; {places}{more})"
