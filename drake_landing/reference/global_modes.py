"""Names for the global modes of a reference aircraft: what moves in them.

Each name stands for simple motions of the reference nodes: a cantilever's bending line
along the wing, a beam's along the fuselage, a turn of the engines. A mode's
participation in a name is the share of its kinetic energy in the span of these motions,
rigid-body motions taken out and what another name stands for first. Names are given so
that the sum of the participations is largest.
"""

from collections.abc import Callable, Mapping

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.optimize

from drake_landing.reduced.model import ReducedModel
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.reference_axis import (
    SIDES,
    Reference,
    reference_nodes,
)
from fem.algebra.modes import Modes

Float64 = npt.NDArray[np.float64]
Motion = dict[int, Float64]  # grid -> three displacements, three rotations

_HIGHEST = 60.0  # Hz: named modes lie below
_RIGID = 0.01  # Hz
# Roots of the frequency equations of beams: clamped and free, free and free.
_CANTILEVER = (1.8751041, 4.6940911)
_FREE = 4.7300407


def named_modes(model: ReducedModel, modes: Modes) -> pd.DataFrame:
    """The modes with names, one row each.

    Args:
        model: a reference aircraft reduced to its reference nodes.
        modes: of it.

    Returns:
        Columns name, mode (number among the elastic ones, from 1), hz, participation,
        lowest, highest (Hz, of the band), inside.
    """
    elastic = (modes.frequency_hz > _RIGID) & (modes.frequency_hz < _HIGHEST)
    shape, hertz = modes.shape[:, elastic], modes.frequency_hz[elastic]
    bands = facts("global_modes")
    share = participations(model, shape)
    names = [name for name in bands if name in share]
    table = np.array([share[name] for name in names])
    rows, columns = scipy.optimize.linear_sum_assignment(-table)
    found = pd.DataFrame(
        {
            "name": [names[k] for k in rows],
            "mode": columns + 1,
            "hz": hertz[columns],
            "participation": table[rows, columns],
            "lowest": [bands[names[k]][0] for k in rows],
            "highest": [bands[names[k]][1] for k in rows],
        }
    )
    found["inside"] = found.hz.between(found.lowest, found.highest)
    return found


def participations(model: ReducedModel, shape: Float64) -> dict[str, Float64]:
    """Name -> (m,) share of the kinetic energy of each mode.

    Args:
        model: see `named_modes`.
        shape: (a, m) mass-normalised modes.
    """
    mass, rigid = model.mass, model.rigid_body()
    result = {}
    for name, (motions, without) in patterns(reference_nodes()).items():
        basis = _columns(model, motions)
        taken = np.hstack([rigid, _columns(model, without)])
        basis = (
            basis
            - taken
            @ np.linalg.lstsq(
                taken.T @ mass @ taken, taken.T @ mass @ basis, rcond=None
            )[0]
        )
        gram = basis.T @ mass @ basis
        onto = basis.T @ mass @ shape
        result[name] = np.einsum("pm,pm->m", onto, np.linalg.solve(gram, onto))
    return result


def patterns(reference: Reference) -> dict[str, tuple[list[Motion], list[Motion]]]:
    """Name -> the motions that it stands for, and those that do not count for it."""
    first, second = (_wing_bending(reference, n) for n in (0, 1))
    upright = _fuselage(reference, 2)
    bending = [_both(first, 1.0), _both(second, 1.0)]
    engines = _engines(reference, (0, 2, 4))
    return {
        "wing bending 1": ([_both(first, 1.0)], []),
        "wing bending 1 antisymmetric": ([_both(first, -1.0)], []),
        "engine pitch": (engines, [_both(first, 1.0)]),
        "engine yaw": (_engines(reference, (5,)), []),
        "fuselage bending vertical": ([upright], []),
        "fuselage bending lateral": ([_fuselage(reference, 1)], []),
        "fin bending": ([_fin(reference)], []),
        "tailplane bending": ([_both(_tailplane(reference), 1.0)], [upright]),
        "wing bending 2": ([_both(second, 1.0)], [_both(first, 1.0), *engines]),
        "wing torsion": ([_both(_wing_torsion(reference), 1.0)], bending),
    }


def _columns(model: ReducedModel, motions: list[Motion]) -> Float64:
    """(a, k) the motions as columns of the model's freedoms."""
    rows = model.labels
    result = np.zeros((len(rows), len(motions)))
    for k, motion in enumerate(motions):
        for i, (grid, component) in enumerate(rows):
            if component and int(grid) in motion:
                result[i, k] = motion[int(grid)][component - 1]
    return result


def _both(halves: Mapping[str, Motion], sign: float) -> Motion:
    return {
        **halves["right"],
        **{grid: sign * motion for grid, motion in halves["left"].items()},
    }


def _moving(reference: Reference, parts: tuple[str, ...], side: str) -> dict:
    names = [f"{part}_{side}" for part in parts]
    return {
        grid: p
        for name in names
        for grid, p in zip(reference[name].ids, reference[name].p)
    }


def _wing(reference: Reference, side: str) -> tuple[dict, Float64, Float64, float]:
    """Nodes of a half wing; root, direction and length of its axis."""
    parts = ("wing", "inner_flap", "outer_flap", "aileron", "monitor_wing_tip")
    nodes = _moving(reference, parts, side)
    axis = reference[f"wing_{side}"].p
    root = axis[np.argmin(np.abs(np.abs(axis[:, 1]) - facts("wing")["side_of_body"]))]
    along = reference[f"monitor_wing_tip_{side}"].p[0] - root
    length = float(np.linalg.norm(along))
    return nodes, root, along / length, length


def _wing_bending(reference: Reference, order: int) -> dict[str, Motion]:
    """The cantilever's line along the swept axis, outside of the fuselage."""
    result = {}
    for side, _ in SIDES:
        nodes, root, along, length = _wing(reference, side)
        nodes = nodes | _moving(reference, ("engine", "gear_main"), side)
        line, slope = _cantilever(order)
        result[side] = {}
        for grid, p in nodes.items():
            s = np.clip((p - root) @ along / length, 0.0, 1.0)
            turn = slope(s) / length * np.cross(along, [0.0, 0.0, 1.0])
            result[side][grid] = np.array([0.0, 0.0, line(s), *turn])
    return result


def _wing_torsion(reference: Reference) -> dict[str, Motion]:
    """A quarter wave of turn about the axis, the leading edge up at both tips."""
    result = {}
    for side, sign in SIDES:
        nodes, root, along, length = _wing(reference, side)
        result[side] = {}
        for grid, p in nodes.items():
            s = np.clip((p - root) @ along / length, 0.0, 1.0)
            turn = sign * np.sin(np.pi / 2 * s) * along
            foot = root + (p - root) @ along * along
            result[side][grid] = np.concatenate([np.cross(turn, p - foot), turn])
    return result


def _engines(reference: Reference, components: tuple[int, ...]) -> list[Motion]:
    """Single motions of both engines, mirrored."""
    mirror = (1.0, -1.0, 1.0, -1.0, 1.0, -1.0)
    right, left = (reference[f"engine_{side}"].ids[0] for side, _ in SIDES)
    unit = np.eye(6)
    return [{right: unit[c], left: mirror[c] * unit[c]} for c in components]


def _fuselage(reference: Reference, axis: int) -> Motion:
    """First bending of a free beam; what hangs on it follows rigidly.

    Args:
        reference: the reference nodes.
        axis: 1 lateral, 2 vertical.
    """
    fuselage = reference["fuselage"].p[:, 0]
    start, length = fuselage.min(), float(np.ptp(fuselage))
    line, slope = _free_beam()
    anchors = {"wing": 0.43, "engine": 0.43, "tailplane": 0.9, "elevator": 0.9}
    anchors |= {"inner_flap": 0.43, "outer_flap": 0.43, "aileron": 0.43}
    anchors |= {"fin": 0.88, "rudder": 0.88, "monitor_wing": 0.43, "monitor_fin": 0.88}
    anchors |= {"gear_main": 0.43}
    result = {}
    for name, group in reference.items():
        fixed = next((v for k, v in anchors.items() if name.startswith(k)), None)
        for grid, p in zip(group.ids, group.p):
            s = np.clip((p[0] - start) / length, 0.0, 1.0) if fixed is None else fixed
            turn = np.zeros(3)
            turn[1 if axis == 2 else 2] = slope(s) / length * (-1.0 if axis == 2 else 1)
            motion = np.zeros(3)
            motion[axis] = line(s)
            arm = p - np.array([start + s * length, 0.0, 0.0])
            result[grid] = np.concatenate([motion + np.cross(turn, arm), turn])
    return result


def _tailplane(reference: Reference) -> dict[str, Motion]:
    line, slope = _cantilever(0)
    result = {}
    for side, sign in SIDES:
        nodes = _moving(reference, ("tailplane", "elevator"), side)
        tip = max(abs(p[1]) for p in nodes.values())
        result[side] = {}
        for grid, p in nodes.items():
            s = abs(p[1]) / tip
            turn = sign * slope(s) / tip
            result[side][grid] = np.array([0.0, 0.0, line(s), turn, 0.0, 0.0])
    return result


def _fin(reference: Reference) -> Motion:
    line, slope = _cantilever(0)
    groups = [reference[name] for name in ("fin", "rudder", "monitor_fin_tip")]
    nodes = {grid: p for group in groups for grid, p in zip(group.ids, group.p)}
    heights = [p[2] for p in nodes.values()]
    root, span = min(heights), float(np.ptp(heights))
    result = {}
    for grid, p in nodes.items():
        s = (p[2] - root) / span
        result[grid] = np.array([0.0, line(s), 0.0, -slope(s) / span, 0.0, 0.0])
    return result


Curve = Callable[[float], float]


def _cantilever(order: int) -> tuple[Curve, Curve]:
    """Deflection and slope of a clamped beam's mode over s in 0 ... 1."""
    b = _CANTILEVER[order]
    k = (np.cosh(b) + np.cos(b)) / (np.sinh(b) + np.sin(b))

    def line(s: float) -> float:
        x = b * s
        return float(np.cosh(x) - np.cos(x) - k * (np.sinh(x) - np.sin(x)))

    def slope(s: float) -> float:
        x = b * s
        return float(b * (np.sinh(x) + np.sin(x) - k * (np.cosh(x) - np.cos(x))))

    return line, slope


def _free_beam() -> tuple[Curve, Curve]:
    """Deflection and slope of the first mode of a free beam over s in 0 ... 1."""
    b = _FREE
    k = (np.cosh(b) - np.cos(b)) / (np.sinh(b) - np.sin(b))

    def line(s: float) -> float:
        x = b * s
        return float(np.cosh(x) + np.cos(x) - k * (np.sinh(x) + np.sin(x)))

    def slope(s: float) -> float:
        x = b * s
        return float(b * (np.sinh(x) - np.sin(x) - k * (np.cosh(x) + np.cos(x))))

    return line, slope
