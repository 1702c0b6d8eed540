"""One line of the verification table, and how ours and theirs are compared."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

LINES = 5e-5  # five digits: bars, rods, masses, constraints, reduction, integration
SURFACES = 0.01  # shells and solids


@dataclass(frozen=True, kw_only=True)
class Row:
    """A result beside its reference.

    Attributes:
        case: name of the case.
        quantity: what is compared, with its unit where it has one.
        mesh: mesh of a convergence study, '' otherwise.
        ours, theirs: the figures.
        difference: relative; of histories and fields the largest one over the peak.
        target: largest difference that is accepted; None: a record only.
        source: where theirs come from.
    """

    case: str
    quantity: str
    mesh: str = ""
    ours: float
    theirs: float
    difference: float
    target: float | None
    source: str

    @property
    def ok(self) -> bool:
        """Whether the target is met."""
        return self.target is None or abs(self.difference) <= self.target


def figure(
    case: str,
    quantity: str,
    ours: float,
    theirs: float,
    source: str,
    *,
    target: float | None = LINES,
    mesh: str = "",
) -> Row:
    """A single figure; where theirs is zero the difference is absolute."""
    difference = (ours - theirs) / abs(theirs) if theirs else ours
    return Row(
        case=case,
        quantity=quantity,
        mesh=mesh,
        ours=float(ours),
        theirs=float(theirs),
        difference=float(difference),
        target=target,
        source=source,
    )


def listed(
    case: str,
    quantity: str,
    ours: npt.ArrayLike,
    theirs: npt.ArrayLike,
    source: str,
    *,
    target: float | None = LINES,
) -> Row:
    """Many figures of one kind (frequencies): the one that differs most."""
    a, b = np.asarray(ours, float), np.asarray(theirs, float)
    if a.shape != b.shape:
        raise ValueError(f"{case}: {a.shape} figures against {b.shape}")
    relative = (a - b) / np.abs(b)
    worst = int(np.argmax(np.abs(relative)))
    text = f"{quantity}, {len(b)} of them; worst: number {worst + 1}"
    return figure(case, text, a[worst], b[worst], source, target=target)


def field(
    case: str,
    quantity: str,
    ours: npt.ArrayLike,
    theirs: npt.ArrayLike,
    source: str,
    *,
    target: float | None = LINES,
) -> Row:
    """A field or a history: peaks, and the largest difference over the peak."""
    a, b = np.asarray(ours, float), np.asarray(theirs, float)
    if a.shape != b.shape:
        raise ValueError(f"{case}, {quantity}: {a.shape} figures against {b.shape}")
    at = np.unravel_index(int(np.argmax(np.abs(b))), b.shape)
    peak = abs(b[at])
    return Row(
        case=case,
        quantity=quantity,
        ours=float(a[at]),
        theirs=float(b[at]),
        difference=float(np.abs(a - b).max() / peak),
        target=target,
        source=source,
    )


def convergence(
    case: str,
    quantity: str,
    found: Sequence[tuple[str, float]],
    reference: float,
    source: str,
    *,
    target: float = SURFACES,
) -> list[Row]:
    """One quantity on finer and finer meshes; the target holds for the finest."""
    return [
        figure(
            case,
            quantity,
            value,
            reference,
            source,
            mesh=mesh,
            target=target if mesh == found[-1][0] else None,
        )
        for mesh, value in found
    ]
