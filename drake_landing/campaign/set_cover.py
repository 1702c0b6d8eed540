"""A short list of landings that holds the extremes of (nearly) all elements.

A landing covers an element where its stress comes within a tolerance of the largest of
all landings. Finding the shortest list is hard (set cover); the greedy choice, always
the landing that covers most of what is left, is at most 1 + ln(e) times as long, and
usually the shortest or one more.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64, Int64


@dataclass(frozen=True, kw_only=True)
class Cover:
    """A list of landings.

    Attributes:
        case: numbers, in the order of their use.
        added: elements that each adds.
        share: of all elements that are covered up to and with each, weighted equally.
    """

    case: tuple[int, ...]
    added: tuple[int, ...]
    share: tuple[float, ...]


def candidates(
    stresses: Iterable[tuple[int, Float64]], largest: Float64, tolerance: float
) -> dict[int, Int64]:
    """Case -> elements whose largest stress it comes near.

    Args:
        stresses: case and (e,) stress of each landing.
        largest: (e,) of all landings; elements without any stress are left out.
        tolerance: share of the largest that may be missed.
    """
    needed = (1.0 - tolerance) * largest
    found = {}
    for number, value in stresses:
        own = np.flatnonzero((value >= needed) & (largest > 0.0))
        if len(own):
            found[number] = own
    return found


def greedy_cover(candidates: dict[int, Int64], wanted: float = 1.0) -> Cover:
    """Greedy set cover.

    Args:
        candidates: case -> elements that it covers.
        wanted: share of the elements at which the list may end.

    Returns:
        The list; of equal gains the lower case number goes first, so that the result
        does not depend on any order.
    """
    every = np.unique(np.concatenate([*candidates.values(), np.zeros(0, np.int64)]))
    total, open_ = len(every), np.zeros(every.max(initial=-1) + 1, bool)
    open_[every] = True
    left = dict(sorted(candidates.items()))
    cases, added, share, done = [], [], [], 0
    # Gains only fall: an old gain bounds the new one, so few are looked at again.
    gain = {number: len(own) for number, own in left.items()}
    while left and done < wanted * total - 1e-9:
        best = _best(left, gain, open_)
        new = left.pop(best)[open_[candidates[best]]]
        if len(new) == 0:
            break
        open_[new] = False
        done += len(new)
        cases.append(best)
        added.append(len(new))
        share.append(done / total)
    return Cover(case=tuple(cases), added=tuple(added), share=tuple(share))


def _best(left: dict[int, Int64], gain: dict[int, int], open_: np.ndarray) -> int:
    best, most = -1, -1
    for number in sorted(left, key=lambda n: (-gain[n], n)):
        if gain[number] < most or (gain[number] == most and number > best):
            break
        gain[number] = int(open_[left[number]].sum())
        if gain[number] > most or (gain[number] == most and number < best):
            best, most = number, gain[number]
    return best
