"""SET commands of case control: ids, ranges and exceptions."""

import re
from collections.abc import Callable
from typing import Literal, TypeAlias

from fem.arrays import Int64

Selection: TypeAlias = Literal["ALL", "NONE"] | frozenset[int]

# Ranges up to this size are unrolled; of larger ones the ids of the deck are kept.
_UNROLLED = 100_000
_HEAD = re.compile(r"\s*SET\s*\(?\s*(\d{1,12})\s*\)?\s*=?\s*(.*)$", re.S)


class SetReader:
    """Sets as they are defined, one after the other.

    Args:
        known: gives the ids that points and elements of the deck may have, ascending;
            asked once, where a range is too long to be unrolled.
    """

    def __init__(self, known: Callable[[], Int64]) -> None:
        self._ask = known
        self._known: Int64 | None = None
        self.sets: dict[int, Selection] = {}

    def define(self, text: str) -> bool:
        """Read SET n = 1, 2, 5 THRU 10 EXCEPT 7, 8; capitals.

        Returns:
            Whether it is a set of ids; those of names and of real numbers serve
            outputs that are not written here.

        Raises:
            ValueError: what is not a set.
        """
        match = _HEAD.match(text)
        if match is None:
            return False
        words = match.group(2).replace(",", " ").split()
        number = int(match.group(1))
        self.sets[number] = "ALL" if "ALL" in words else self._ids(words)
        return True

    def selection(self, text: str) -> Selection:
        """The ids that a request asks for: ALL, NONE or a set.

        Raises:
            ValueError: the set is not defined.
        """
        word = text.split()[0] if text.split() else "ALL"
        if word in ("ALL", "YES"):
            return "ALL"
        if word in ("NONE", "NO"):
            return "NONE"
        n = number(word)
        if n not in self.sets:
            raise ValueError(f"set {n} is not defined")
        return self.sets[n]

    def _ids(self, words: list[str]) -> frozenset[int]:
        ids: set[int] = set()
        k, removing, largest = 0, False, 0
        while k < len(words):
            word = words[k]
            if word == "EXCEPT":
                removing = True
            elif word == "THRU":
                if k == 0 or k + 1 == len(words):
                    raise ValueError("THRU needs a number on both sides")
                first, last = number(words[k - 1]), number(words[k + 1])
                if last < first:
                    raise ValueError(f"found {first} THRU {last}, expected ascending")
                # Beyond its range an EXCEPT is over.
                removing = removing and last <= largest
                inside = self._range(first, last)
                (ids.difference_update if removing else ids.update)(inside)
                largest, k = max(largest, last) if removing else last, k + 1
            elif word.isdigit():
                removing = removing and number(word) <= largest
                (ids.discard if removing else ids.add)(number(word))
            elif "." not in word:  # sets of real numbers serve other requests
                raise ValueError(f"found '{word}' in a set, expected ids")
            k += 1
        return frozenset(ids)

    def _range(self, first: int, last: int) -> range | list[int]:
        if last - first <= _UNROLLED:
            return range(first, last + 1)
        if self._known is None:
            self._known = self._ask()
        inside = (self._known >= first) & (self._known <= last)
        return self._known[inside].tolist()


def number(text: str) -> int:
    """The integer that a text begins with.

    Raises:
        ValueError: there is none.
    """
    first = (re.split(r"[\s,]+", text) or [""])[0]
    if not first.isascii() or not first.isdigit() or len(first) > 12:
        raise ValueError(f"found '{text}', expected an integer")
    return int(first)
