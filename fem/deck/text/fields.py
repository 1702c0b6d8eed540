"""Typed access to the fields of one card, for cards of irregular shape."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from fem.arrays import Int64
from fem.deck.text.lexer import RawCard
from fem.deck.text.values import Malformed, components, integer, real, word

T = TypeVar("T")

_MOST_IDS = 10_000_000  # in one THRU


@dataclass(frozen=True)
class IdRange:
    """first THRU last BY step EXCEPT some: of these ids those that exist."""

    first: int
    last: int
    step: int = 1
    excepted: frozenset[int] = frozenset()

    def among(self, known: Int64) -> Int64:
        """The members among ids (n,), which ascend."""
        start, stop = np.searchsorted(known, (self.first, self.last + 1))
        inside = known[start:stop]
        inside = inside[(inside - self.first) % self.step == 0]
        return inside[~np.isin(inside, list(self.excepted))]


class Fields:
    """Fields of a card by index (0 is the name).

    Every reader raises `Malformed`, whose text names field, finding and expectation.
    """

    def __init__(self, card: RawCard) -> None:
        self.card = card

    def __len__(self) -> int:
        return len(self.card.fields)

    def text(self, index: int) -> str:
        """Text of a field, '' where it is blank."""
        return self.card.field(index)

    def integer(self, index: int, name: str, default: int | None = None) -> int:
        """An integer; `default` where the field is blank. `Malformed` names it."""
        return self._value(index, name, default, integer, "an integer")

    def real(self, index: int, name: str, default: float | None = None) -> float:
        """A real number, see `integer`."""
        return self._value(index, name, default, real, "a real number")

    def components(self, index: int, name: str, default: str | None = None) -> str:
        """Digits of components, see `integer`."""
        return self._value(index, name, default, components, "component digits")

    def word(self, index: int, name: str, default: str | None = None) -> str:
        """A word in capitals, see `integer`."""
        return self._value(index, name, default, word, "a word")

    def reals(self, start: int, count: int, name: str, default: float) -> list[float]:
        """Consecutive real numbers."""
        return [self.real(start + k, f"{name}{k + 1}", default) for k in range(count)]

    def groups(self, start: int, size: int, row: int = 0) -> Iterator[int]:
        """Indices where groups of `size` fields begin that are not blank.

        Args:
            start: index of the first group.
            size: fields of a group.
            row: fields from one group to the next, `size` by default.
        """
        for index in range(start, len(self), row or size):
            if any(self.card.fields[index : index + size]):
                yield index

    def ids(self, start: int, name: str) -> tuple[list[int], list[int]]:
        """Ids to the end of the card: those written, and those between THRU and BY."""
        single, ranges = self.ranges(start, name)
        between: list[int] = []
        for part in ranges:
            if part.last - part.first > _MOST_IDS * part.step:
                raise Malformed(
                    f"field {name}: found {part.first} THRU {part.last}, expected a "
                    f"range of at most {_MOST_IDS} ids"
                )
            inside = range(part.first, part.last + 1, part.step)
            single.append(part.first)
            if (part.last - part.first) % part.step == 0 and len(inside) > 1:
                single.append(part.last)
            between += (i for i in inside[1:] if i != part.last)
        excepted = {i for part in ranges for i in part.excepted}
        return (
            [i for i in dict.fromkeys(single) if i not in excepted],
            [i for i in between if i not in excepted],
        )

    def ranges(self, start: int, name: str) -> tuple[list[int], list["IdRange"]]:
        """Ids to the end of the card that stand alone, and ranges by THRU and BY."""
        written: list[int] = []
        ranges: list[IdRange] = []
        texts = [text for text in self.card.fields[start:] if text]
        k = 0
        while k < len(texts):
            if texts[k] == "THRU":
                if not written or k + 1 == len(texts):
                    raise Malformed(f"field {name}: THRU needs a number on both sides")
                first, last = written.pop(), self._id(texts[k + 1], name)
                step, k = 1, k + 2
                if k < len(texts) and texts[k] == "BY":
                    if k + 1 == len(texts):
                        raise Malformed(f"field {name}: BY needs a number")
                    step, k = self._id(texts[k + 1], name), k + 2
                if last < first or step < 1:
                    raise Malformed(
                        f"field {name}: found {first} THRU {last} BY {step}, expected "
                        "an ascending range"
                    )
                ranges.append(IdRange(first, last, step))
            elif texts[k] == "EXCEPT":
                excepted = frozenset(self._id(text, name) for text in texts[k + 1 :])
                written = [i for i in written if i not in excepted]
                ranges = [replace(part, excepted=excepted) for part in ranges]
                k = len(texts)
            else:
                written.append(self._id(texts[k], name))
                k += 1
        if not written and not ranges:
            raise Malformed(f"field {name} is blank, expected an integer")
        return written, ranges

    def _id(self, text: str, name: str) -> int:
        try:
            return integer(text)
        except Malformed as error:
            raise Malformed(f"field {name}: found '{text}', expected {error}") from None

    def _value(
        self,
        index: int,
        name: str,
        default: T | None,
        convert: Callable[[str], T],
        expected: str,
    ) -> T:
        text = self.card.field(index)
        if not text:
            if default is None:
                raise Malformed(f"field {name} is blank, expected {expected}")
            return default
        try:
            return convert(text)
        except Malformed as error:
            raise Malformed(f"field {name}: found '{text}', expected {error}") from None
