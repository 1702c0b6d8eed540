"""What two sets of result tables have in common, and how far they differ."""

from dataclasses import dataclass

import numpy as np

from benchmarks.suite.tables import Name, Table

# Columns that are compared by no one: angles jump, margins are no results, and which
# of the layers comes first is a matter of the file.
_UNEVEN = (
    "angle",
    "margin",
    "MS_",
    "SMa",
    "SMt",
    "fiber",
    "cos",
    "incline",
    "phi",
    "theta",
)


@dataclass(frozen=True)
class Difference:
    """The largest difference of a table over the peak of its column."""

    name: str
    subcase: int
    value: float
    rows: int


ROOTS = ("frequency", "load factor")
# Frequencies below are those of rigid motions, rounding in both, Hz.
_AT_REST = 1e-5
# A kind's scale is at least this share of what the other kind's peak does over the
# length of the model: rotations of translations, moments of forces.
_LINKED = 1e-3


def differences(
    ours: dict[Name, Table], theirs: dict[Name, Table], length: float = np.inf
) -> list[Difference]:
    """One for each table that both have; worst first.

    Args:
        ours, theirs: tables by name and subcase.
        length: diagonal of the model, which links rotations and translations.
    """
    cases = {name[1] for name in ours} & {name[1] for name in theirs}
    found = []
    for name in sorted(set(ours) & set(theirs)):
        modal = ("frequency", name[1]) in theirs
        real = not np.iscomplexobj(theirs[name].values)
        if modal and real and name[0] not in ROOTS:
            continue  # shapes have any sign, and turn within clusters
        pair = _common(ours[name], theirs[name])
        if pair is not None and name[1] in cases:
            if name[0] in ROOTS:
                value = _roots(*pair, at_rest=name[0] == "frequency")
            else:
                value = _worst(*pair, _arm(name[0], length))
            found.append(Difference(name[0], name[1], value, pair[0].shape[1]))
    return sorted(found, key=lambda d: -d.value)


def _common(ours: Table, theirs: Table) -> tuple[np.ndarray, np.ndarray] | None:
    """(t, n, c) of the rows and columns that both have."""
    at = {key: k for k, key in enumerate(ours.owner)}
    rows = [(at[key], k) for k, key in enumerate(theirs.owner) if key in at]
    columns = [
        (ours.columns.index(c), k)
        for k, c in enumerate(theirs.columns)
        if c in ours.columns and not any(word in c for word in _UNEVEN)
    ]
    same = len(ours.values) == len(theirs.values)
    alike = np.iscomplexobj(ours.values) == np.iscomplexobj(theirs.values)
    if not rows or not columns or not same or not alike:
        return None
    (own, other), (mine, its) = np.transpose(rows), np.transpose(columns)
    return ours.values[:, own][..., mine], theirs.values[:, other][..., its]


def _arm(name: str, length: float) -> float:
    """What peaks of the first three columns mean for the others; 0: nothing."""
    if not np.isfinite(length) or length <= 0.0:
        return 0.0
    moved = name in ("displacement", "velocity", "acceleration")
    return 1.0 / length if moved else length


def _worst(ours: np.ndarray, theirs: np.ndarray, arm: float = 0.0) -> float:
    """A column's scale is at least a hundredth of its kind's peak: noise lies below.

    Translations and rotations are of different kinds, linked by `arm`.
    """
    known = np.isfinite(ours) & np.isfinite(theirs)
    ours, theirs = np.where(known, ours, 0.0), np.where(known, theirs, 0.0)
    peak = np.abs(theirs).max(axis=(0, 1), initial=0.0)
    halves = [slice(0, 3), slice(3, 6)] if len(peak) == 6 else [slice(None)]
    scale = np.zeros_like(peak)
    for half in halves:
        scale[half] = np.maximum(peak[half], 1e-2 * peak[half].max(initial=0.0))
    if len(peak) == 6:
        first, second = (peak[half].max(initial=0.0) for half in halves)
        scale[halves[1]] = np.maximum(scale[halves[1]], _LINKED * arm * first)
        if arm:
            scale[halves[0]] = np.maximum(scale[halves[0]], _LINKED / arm * second)
    scale = np.maximum(scale, 1e-9 * peak.max(initial=0.0))
    difference = np.abs(ours - theirs).max(axis=(0, 1), initial=0.0)
    away = scale <= 1e-12 * max(1.0, peak.max(initial=0.0))
    ratio = difference / np.where(away, 1.0, scale)
    return float(np.where(away, 0.0, ratio).max(initial=0.0))


def _roots(ours: np.ndarray, theirs: np.ndarray, *, at_rest: bool) -> float:
    """Frequencies or load factors; `at_rest`: those of rigid motions are rounding."""
    scale = np.maximum(np.abs(theirs), 1e-2 * np.abs(theirs).max(initial=0.0))
    scale = np.where(scale > 0.0, scale, 1.0)
    # A negative eigenvalue is that of a rigid motion, by its size of rounding.
    noise = -2.0 * min(float(ours.min()), float(theirs.min()), 0.0)
    rest = max(_AT_REST, noise)
    still = at_rest & (np.abs(ours) < rest) & (np.abs(theirs) < rest)
    ratio = np.where(still, 0.0, np.abs(ours - theirs) / scale)
    return float(ratio.max(initial=0.0))
