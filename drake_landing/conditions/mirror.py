"""Cases that are mirror images of each other about the plane of symmetry."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from drake_landing.conditions.ground import BookCase, GearPlace, PoseName
from drake_landing.conditions.statics import point
from fem.arrays import Float64

_PLACE = 0.01  # m, within which places are one
_LOAD = 1e-4  # of the largest load
_MIRROR = np.array([1.0, -1.0, 1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0])

Places = Mapping[PoseName, Mapping[str, GearPlace]]


def without_mirror_images(
    cases: Iterable[tuple[int, BookCase]], poses: Places
) -> Iterator[tuple[str, BookCase]]:
    """Cases of which neither they nor a mirror image stand before, by number and name.

    Args:
        cases: with their numbers.
        poses: pose -> gear -> where it is.

    Yields:
        Its title, in which those left out are named, and the case.
    """
    kept: list[_Kept] = []
    for number, case in cases:
        for one in kept:
            if are_alike(one.case, case, poses):
                one.same.append(str(number))
                break
            if are_alike(one.case, case, poses, mirrored=True):
                one.mirrored.append(str(number))
                break
        else:
            kept.append(_Kept(number=number, case=case))
    for one in kept:
        yield one.title, one.case


def are_alike(
    first: BookCase, second: BookCase, poses: Places, *, mirrored: bool = False
) -> bool:
    """Whether the loads of two cases, or of one and the other's image, are the same."""
    if first.pose != second.pose or len(first.loads) != len(second.loads):
        return False
    scale = max(float(np.abs(one.force).max()) for one in first.loads)
    mine, other = _rows(first, poses, scale), _rows(second, poses, scale)
    if mirrored:
        other = [(what, values * _MIRROR) for what, values in other]
    for what, values in mine:
        for k, (kind, found) in enumerate(other):
            if kind == what and np.abs(values - found).max() < 1.0:
                del other[k]
                break
        else:
            return False
    return True


def _rows(case: BookCase, poses: Places, scale: float) -> list[tuple[str, Float64]]:
    """Kind of each load; its place, force and moment over what is no difference."""
    return [
        (
            one.what,
            np.concatenate(
                (
                    point(poses[case.pose][one.gear], one.at) / _PLACE,
                    one.force / (_LOAD * scale),
                    one.moment / (_LOAD * scale),
                )
            ),
        )
        for one in case.loads
    ]


@dataclass(kw_only=True)
class _Kept:
    number: int
    case: BookCase
    same: list[str] = field(default_factory=list)
    mirrored: list[str] = field(default_factory=list)

    @property
    def title(self) -> str:
        title = f"case {self.number}: {self.case.name}"
        for word, cases in (("same", self.same), ("mirrored", self.mirrored)):
            title += f" ({word}: case {', '.join(cases)})" * bool(cases)
        return title
