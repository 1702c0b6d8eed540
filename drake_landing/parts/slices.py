"""Equivalent static slices: the loads of an instant, balanced by rigid inertia.

The practice of static load cases: at the instants when a gear's load is extreme, the
loads of all gears act at rest, and the airframe's masses resist with the accelerations
that they would have, were it rigid (inertia relief). Nothing answers dynamically.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from drake_landing.landing.handover import AttachmentLoads
from drake_landing.parts.cuts import BeamCuts
from drake_landing.parts.stress import Stresses
from fem.algebra.statics import inertia_relief
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_SAME = 2e-3  # s: extremes nearer than this are one instant
_SMALL = 0.02  # of a gear's largest load: components below give no instant


@dataclass(frozen=True, kw_only=True)
class Slices:
    """Static load cases.

    Attributes:
        time: (s,) instants, s.
        reason: what is extreme at each.
        sections: beam -> (s, n, 6), columns `COMPONENTS`, B.
        acceleration: grid -> (s, 3), B, m/s².
        stress: (s, e, 3) `MEASURES` of the elements of `Stresses`.
    """

    time: Float64
    reason: tuple[str, ...]
    sections: Mapping[str, Float64]
    acceleration: Mapping[int, Float64]
    stress: Float64


def extreme_instants(
    loads: AttachmentLoads, gears: Mapping[str, Sequence[int]]
) -> dict[int, str]:
    """Rows of the loads where a force of a gear is extreme, and which.

    Args:
        loads: over time.
        gears: gear -> its attachment nodes.
    """
    found: dict[int, str] = {}
    apart = max(1, round(_SAME / loads.step))
    for gear, nodes in gears.items():
        force = loads.load[:, np.isin(loads.node_id, list(nodes)), :3].sum(axis=1)
        size = np.abs(force).max()
        for axis, values in zip("xyz", force.T):
            for at, word in ((values.argmax(), "largest"), (values.argmin(), "least")):
                row, small = int(at), abs(values[at]) <= _SMALL * size
                if small or any(abs(row - other) <= apart for other in found):
                    continue
                found[row] = f"{gear.replace('_', ' ')}: {word} F{axis}"
    return dict(sorted(found.items()))


@dataclass(frozen=True, kw_only=True)
class Balanced:
    """Static answers of the free airframe, balanced by rigid inertia.

    Attributes:
        displacement: (f, c) in mean axes.
        motion: (f, c) accelerations as a rigid body.
    """

    displacement: Float64
    motion: Float64

    def take(self, which: slice) -> "Balanced":
        """Some of the load cases."""
        return Balanced(
            displacement=self.displacement[:, which], motion=self.motion[:, which]
        )


def balanced(structure: Structure, load: Float64) -> Balanced:
    """Solves load cases (f, c) on the free set with inertia relief, all at once."""
    found = inertia_relief(
        structure.stiffness, structure.mass, load, rigid_body=structure.rigid_body
    )
    return Balanced(
        displacement=found.displacement, motion=found.motions @ found.acceleration
    )


def slice_loads(
    structure: Structure, loads: AttachmentLoads, instants: Mapping[int, str]
) -> Float64:
    """(f, s) loads on the free set at instants: rows of the loads."""
    pattern = structure.operator(loads.node_id, frame="basic")
    load = loads.load[list(instants)]
    return np.asarray(pattern.T @ load.reshape(len(load), -1).T)


def static_slices(
    structure: Structure,
    loads: AttachmentLoads,
    instants: Mapping[int, str],
    still: Balanced,
    stresses: Stresses,
    cuts: Mapping[str, BeamCuts],
    grids: Int64,
) -> Slices:
    """Stresses, section loads and accelerations of the static cases.

    Args:
        structure: the full model, free.
        loads: over time.
        instants: row of the loads -> what is extreme there.
        still: answers to `slice_loads`.
        stresses, cuts: what is looked at.
        grids: whose accelerations are wanted.
    """
    rows = list(instants)
    moved = structure.operator(grids, (1, 2, 3), frame="basic") @ still.motion
    moved = moved.T.reshape(len(rows), -1, 3)
    return Slices(
        time=loads.time[rows],
        reason=tuple(instants.values()),
        sections={
            name: c.loads(
                (c.of_acceleration @ still.motion).T, loads.node_id, loads.load[rows]
            )
            for name, c in cuts.items()
        },
        acceleration={int(g): moved[:, i] for i, g in enumerate(grids)},
        stress=stresses.of(still.displacement),
    )
