"""Whether an airframe flies: six rigid-body motions, mass, and nothing that is loose.

The stiffness is factorised once; motions that cost no energy are counted and those
that are no rigid-body motion are named by their grids, before any mode is solved.
"""

from collections import Counter

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.supports import supports_of
from fem.constraints.autospc import grouped
from fem.errors import InputError
from fem.model.mechanisms import Mechanism
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_RIGID = 6
_MOVES = 1e-3  # share of the largest displacement
_HOLDS = 1e-6  # share of the largest energy of a rigid motion
_SWEEPS = 30
_MANY, _ON_PLANE = 12, 1e-4  # grids; distance from a plane over the largest extent
_AXES = ("x", "y", "z", "rotation x", "rotation y", "rotation z")


def check_free_flight(structure: Structure) -> None:
    """Six motions without stiffness, those of a rigid body; one factorisation.

    Raises:
        InputError: the airframe has no mass, is held, or parts of it are loose.
    """
    problems = _mass_problems(structure)
    found = structure.mechanisms()
    loose = _loose(structure, found)
    count = sum(m.motions.shape[1] for m in found)
    rigid = count - sum(loose.values())
    if rigid < _RIGID:
        problems.append(f"{rigid} rigid-body modes, expected 6: {_held(structure)}")
    if rigid < _RIGID or loose:
        problems = [*half_model(structure.points.xyz), *problems]
    if loose:
        problems.append(
            f"{count} motions without stiffness, expected the 6 of a free-flying "
            "airframe: there are mechanisms or loose parts"
        )
    problems += [
        f"freely moves in {n} way{'s' * (n > 1)}: {t}" for t, n in loose.items()
    ]
    if problems:
        raise InputError(f"{structure.deck.path}: {text}" for text in problems)


def half_model(p: Float64) -> list[str]:
    """A sentence, if the grids look like one half of a symmetric aircraft.

    Many of them lie along a plane of the basic frame and none beyond it, and no other
    axis has as much on one side as on the other, as a whole aircraft of beams in one
    plane has.

    Args:
        p: (g, 3) basic positions.
    """
    if len(p) < _MANY:
        return []
    low, high = p.min(axis=0), p.max(axis=0)
    size = (high - low).max()
    if np.any((np.abs(low + high) < 0.02 * size) & (high - low > 0.3 * size)):
        return []
    for axis, name in enumerate("xyz"):
        near = np.abs(p[:, axis]) < _ON_PLANE * size
        along = near.sum() >= _MANY and np.ptp(p[near], axis=0).max() > 0.3 * size
        for side, inner, outer in (
            (">=", low[axis], high[axis]),
            ("<=", -high[axis], -low[axis]),
        ):
            if along and inner > -_ON_PLANE * size and outer > 0.1 * size:
                return [
                    f"all grids lie at {name} {side} 0 and {near.sum()} of them on "
                    f"{name} = 0: half a model; expected the whole aircraft: mirror "
                    "it, with what lies on the plane once, and take out the supports "
                    "there"
                ]
    return []


def check_mass(structure: Structure) -> None:
    """The airframe has mass, and inertia about every axis.

    Raises:
        InputError: it has not.
    """
    if problems := _mass_problems(structure):
        raise InputError(f"{structure.deck.path}: {text}" for text in problems)


def _held(structure: Structure) -> str:
    """In which directions something holds the airframe."""
    rigid = structure.rigid_body
    energy = np.einsum("fi,fi->i", rigid, structure.stiffness @ rigid)
    stiff = [a for a, e in zip(_AXES, energy) if e > _HOLDS * energy.max()]
    where = f"in {', '.join(stiff) or 'part'}"
    if supports := supports_of(structure):
        return (
            f"the airframe must fly freely, but is held {where}: {supports.story}; "
            f"{supports.remedy}"
        )
    return (
        f"the airframe must fly freely, but something holds it {where}; take out "
        "grounded springs, or elements that do not let it turn"
    )


def _mass_problems(structure: Structure) -> list[str]:
    total = structure.rigid_mass.total
    if not total > 0.0:
        return [
            f"the airframe has a mass of {total:g}, expected more than 0: densities "
            "(MAT1 RHO), NSM or CONM2"
        ]
    rigid = structure.rigid_body
    inertia = np.linalg.eigvalsh((rigid.T @ (structure.mass @ rigid))[3:, 3:])
    if inertia[0] < 1e-9 * max(inertia[2], 0.0) or inertia[2] <= 0.0:
        return [
            f"the principal moments of inertia are {inertia[0]:.3g}, {inertia[1]:.3g} "
            f"and {inertia[2]:.3g}, expected none of 0: all mass lies on one line; "
            "give inertia (CONM2) or masses off the line"
        ]
    return []


def _loose(structure: Structure, mechanisms: list[Mechanism]) -> Counter[str]:
    """What moves beyond the rigid-body motions, and in how many ways."""
    texts: list[str] = []
    airframe = max(mechanisms, key=lambda m: len(m.rows), default=None)
    # Generalised coordinates of a reduction have no place that a rigid motion moves.
    moved = int(structure.rigid_body.any(axis=1).sum())
    for mechanism in mechanisms:
        if mechanism is airframe and 2 * len(mechanism.rows) > moved:
            texts += [
                _names(structure, mechanism.rows[rows])
                for rows in _beyond_rigid(structure, mechanism)
            ]
        else:  # a part that nothing connects or holds
            names = _names(structure, mechanism.rows)
            texts += [names] * mechanism.motions.shape[1]
    return Counter(texts)


def _beyond_rigid(structure: Structure, mechanism: Mechanism) -> list[Int64]:
    """Positions in the rows of a piece that move, for each motion of its own."""
    rigid = structure.rigid_body[mechanism.rows].copy()
    # Rotations count as displacements at the radius of gyration.
    length = max(float(np.sqrt(np.mean(np.square(rigid[:, 3:])))), 1e-12)
    rigid[:, 3:] /= length
    motions = mechanism.motions[mechanism.rows]
    rest = motions - rigid @ np.linalg.lstsq(rigid, motions, rcond=None)[0]
    basis, share, _ = np.linalg.svd(rest, full_matrices=False)
    own = basis[:, share > _MOVES * np.linalg.norm(motions)]
    return [_moving(rigid, own[:, i]) for i in range(own.shape[1])]


def _moving(rigid: Float64, motion: Float64) -> Int64:
    """Rows that move when most of the structure rests.

    A motion is known up to rigid ones: that with the smallest sum of magnitudes leaves
    the larger part at rest (weighted least squares, repeated).
    """
    rest = motion
    for _ in range(_SWEEPS):
        weight = 1.0 / np.sqrt(np.maximum(np.abs(rest), 1e-9 * np.abs(motion).max()))
        fit = np.linalg.lstsq(weight[:, None] * rigid, weight * motion, rcond=None)[0]
        rest = motion - rigid @ fit
    return np.flatnonzero(np.abs(rest) > _MOVES * np.abs(rest).max())


def _names(structure: Structure, rows: Int64) -> str:
    return grouped([structure.label(int(row)) for row in rows], 12)
