"""Three practices side by side for the same landing: what each makes of it.

    rigid loads     gear loads of a landing with a rigid airframe, applied to the
                    flexible model: dynamic response, but the gears never felt it yield
    static slices   the hybrid loads frozen at the instants of their extremes, balanced
                    by the inertia of the rigid aircraft: no dynamic response at all
    hybrid          flexible landing, loads handed over, dynamic response

Quantities: peak vertical acceleration of monitoring points, peak loads through
sections. Section loads of static slices need no solution: with rigid accelerations they
follow from equilibrium.
"""

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.handover import AttachmentLoads
from drake_landing.inputs import Aircraft
from drake_landing.parts import (
    COMPONENTS,
    Section,
    SectionOperator,
    section_load,
    section_operator,
)
from drake_landing.response import transient_response
from fem.observation import Observation
from fem.structure import Structure

Float64 = npt.NDArray[np.float64]

COLUMNS = ["practice", "quantity", "peak", "time", "error"]
BENDING = {"wing_root_right": "mx", "fuselage_front": "my", "fuselage_rear": "my"}


def compare_practices(
    structure: Structure,
    aircraft: Aircraft,
    rigid: AttachmentLoads,
    hybrid: AttachmentLoads,
    sections: Sequence[Section],
    scheme: str = "nastran",
) -> pd.DataFrame:
    """Table of the three practices, columns `COLUMNS`; errors against the hybrid one.

    Args:
        structure: the full model.
        aircraft: monitoring points.
        rigid, hybrid: loads of landings with rigid and with flexible airframe, on one
            even grid.
        sections: where loads are wanted.
        scheme: of the transients.
    """
    points = structure.points
    places = {int(n): points.xyz[points.rows(int(n))] for n in hybrid.node_id}
    operators = {s.name: section_operator(structure, s, places) for s in sections}
    found = {
        "rigid loads": _dynamic(structure, aircraft, rigid, operators, scheme),
        "static slices": _slices(structure, aircraft, hybrid, operators),
        "hybrid": _dynamic(structure, aircraft, hybrid, operators, scheme),
    }
    rows = []
    for practice, histories in found.items():
        for quantity, (time, values) in histories.items():
            at = int(np.argmax(np.abs(values)))
            true = np.abs(found["hybrid"][quantity][1]).max()
            error = abs(values[at]) / true - 1.0 if true > 0.0 else float("nan")
            rows.append([practice, quantity, float(values[at]), float(time[at]), error])
    return pd.DataFrame(rows, columns=COLUMNS)


Histories = dict[str, tuple[Float64, Float64]]


def _dynamic(
    structure: Structure,
    aircraft: Aircraft,
    loads: AttachmentLoads,
    operators: Mapping[str, SectionOperator],
    scheme: str,
) -> Histories:
    watched = {
        name: Observation("acceleration", op.of_acceleration)
        for name, op in operators.items()
    }
    response = transient_response(
        structure,
        loads,
        aircraft.monitoring,
        scheme,
        observers=list(watched.values()),
    )
    found: Histories = {
        f"{point} z": (loads.time, table["z"].to_numpy())
        for point, table in response.items()
    }
    for name, op in operators.items():
        passed = section_load(op, watched[name].history, loads.node_id, loads.load)
        found |= _bending(name, loads.time, passed)
    return found


def _slices(
    structure: Structure,
    aircraft: Aircraft,
    loads: AttachmentLoads,
    operators: Mapping[str, SectionOperator],
) -> Histories:
    """Rigid accelerations at the instants of extreme loads."""
    flat = loads.load.reshape(len(loads.time), -1)
    instants = np.unique(np.concatenate([flat.argmax(axis=0), flat.argmin(axis=0)]))
    time, load = loads.time[instants], loads.load[instants]
    rigid = structure.rigid_body
    pattern = structure.operator(loads.node_id, frame="basic")
    mass = rigid.T @ (structure.mass @ rigid)
    force = flat[instants] @ (pattern @ rigid)
    motion = np.linalg.solve(mass, force.T)
    rows = structure.operator(list(aircraft.monitoring.values()), (3,), frame="basic")
    vertical = (rows @ rigid) @ motion
    found: Histories = {
        f"{point} z": (time, vertical[i]) for i, point in enumerate(aircraft.monitoring)
    }
    for name, op in operators.items():
        inertia = ((op.of_acceleration @ rigid) @ motion).T
        found |= _bending(name, time, section_load(op, inertia, loads.node_id, load))
    return found


def _bending(name: str, time: Float64, passed: Float64) -> Histories:
    component = BENDING.get(name, "fz")
    wanted = ("fz", component) if component != "fz" else ("fz",)
    return {f"{name} {c}": (time, passed[:, COMPONENTS.index(c)]) for c in wanted}
