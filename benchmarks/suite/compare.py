"""What two sets of result tables have in common, and how far they differ."""

from dataclasses import dataclass

import numpy as np

from benchmarks.suite.tables import Name, Table

# Columns that are compared by no one: angles jump, margins are no results, and which
# of the layers comes first is a matter of the file.
_UNEVEN = ("angle", "margin", "MS_", "SMa", "fiber", "cos", "incline", "phi", "theta")


@dataclass(frozen=True)
class Difference:
    """The largest difference of a table over the peak of its column."""

    name: str
    subcase: int
    value: float
    rows: int


def differences(ours: dict[Name, Table], theirs: dict[Name, Table]) -> list[Difference]:
    """One for each table that both have; worst first."""
    cases = {name[1] for name in ours} & {name[1] for name in theirs}
    found = []
    for name in sorted(set(ours) & set(theirs)):
        modal = ("frequency", name[1]) in theirs
        if modal and name[0] != "frequency":
            continue  # shapes have any sign, and turn within clusters
        pair = _common(ours[name], theirs[name])
        if pair is not None and name[1] in cases:
            value = _frequency(*pair) if name[0] == "frequency" else _worst(*pair)
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
    states = len(ours.values), len(theirs.values)
    if not rows or not columns or states[0] != states[1]:
        return None
    (own, other), (mine, its) = np.transpose(rows), np.transpose(columns)
    return ours.values[:, own][..., mine], theirs.values[:, other][..., its]


def _worst(ours: np.ndarray, theirs: np.ndarray) -> float:
    """A column's scale is at least a hundredth of its kind's peak: noise lies below.

    Translations and rotations are of different kinds.
    """
    known = np.isfinite(ours) & np.isfinite(theirs)
    ours, theirs = np.where(known, ours, 0.0), np.where(known, theirs, 0.0)
    peak = np.abs(theirs).max(axis=(0, 1), initial=0.0)
    halves = (slice(0, 3), slice(3, 6)) if len(peak) == 6 else (slice(None),)
    scale = np.zeros_like(peak)
    for half in halves:
        scale[half] = np.maximum(peak[half], 1e-2 * peak[half].max(initial=0.0))
    scale = np.maximum(scale, 1e-9 * peak.max(initial=0.0))
    difference = np.abs(ours - theirs).max(axis=(0, 1), initial=0.0)
    away = scale <= 1e-12 * max(1.0, peak.max(initial=0.0))
    ratio = difference / np.where(away, 1.0, scale)
    return float(np.where(away, 0.0, ratio).max(initial=0.0))


def _frequency(ours: np.ndarray, theirs: np.ndarray) -> float:
    """Motions as a rigid body are zero but for rounding."""
    scale = np.maximum(np.abs(theirs), 1e-2 * np.abs(theirs).max(initial=0.0))
    scale = np.where(scale > 0.0, scale, 1.0)
    return float((np.abs(ours - theirs) / scale).max(initial=0.0))
