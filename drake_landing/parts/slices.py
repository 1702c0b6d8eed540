"""Equivalent static slices: the loads of an instant, balanced by rigid inertia.

The practice of static load cases: at the instants when a gear's load is extreme, the
loads of all gears act at rest, and the airframe's masses resist with the accelerations
that they would have, were it rigid (inertia relief). Nothing answers dynamically.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from drake_landing.handover import AttachmentLoads
from drake_landing.parts.cuts import BeamCuts
from drake_landing.parts.stress import Stresses
from fem.statics import inertia_relief
from fem.structure import Structure

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
        sections: beam -> (s, n, 6), columns `COMPONENTS`, axes A.
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


def static_slices(
    structure: Structure,
    loads: AttachmentLoads,
    instants: Mapping[int, str],
    stresses: Stresses,
    cuts: Mapping[str, BeamCuts],
    grids: Int64,
) -> Slices:
    """Solves the static cases, all at once.

    Args:
        structure: the full model, free.
        loads: over time.
        instants: row of the loads -> what is extreme there.
        stresses, cuts: what is looked at.
        grids: whose accelerations are wanted.
    """
    rows = list(instants)
    load = loads.load[rows]
    pattern = structure.operator(loads.node_id, frame="basic")
    found = inertia_relief(
        structure.stiffness,
        structure.mass,
        pattern.T @ load.reshape(len(rows), -1).T,
        rigid_body=structure.rigid_body,
    )
    motion = found.motions @ found.acceleration
    moved = structure.operator(grids, (1, 2, 3), frame="basic") @ motion
    moved = moved.T.reshape(len(rows), -1, 3)
    return Slices(
        time=loads.time[rows],
        reason=tuple(instants.values()),
        sections={
            name: c.loads((c.of_acceleration @ motion).T, loads.node_id, load)
            for name, c in cuts.items()
        },
        acceleration={int(g): moved[:, i] for i, g in enumerate(grids)},
        stress=stresses.of(found.displacement),
    )
