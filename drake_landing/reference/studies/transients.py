"""Direct transients of all runs of a study: one factorisation, one block of columns.

Runs whose airframes have the same matrices are load cases of one transient, whatever
nodes their gears hold.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from drake_landing.cache import Cache, content_key, source_key
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.reference.studies.airframes import StudyAirframe
from drake_landing.transient.response import SCHEMES
from fem.algebra.linear_solver import SingularMatrixError
from fem.response.direct import direct_transient
from fem.response.observation import Observation
from fem.response.system import sampled_load

Float64 = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class TransientTask:
    """Loads on an airframe."""

    airframe: StudyAirframe
    loads: AttachmentLoads

    @property
    def key(self) -> str:
        """Hash of everything that the response depends on."""
        a, loads = self.airframe, self.loads
        return content_key(
            source_key("fem", "drake_landing.transient"),
            a.matrix_key,
            a.case.transient.scheme,
            [loads.time, loads.load, loads.node_id],
            a.structure.operator(loads.node_id, frame="basic"),
            _watched(a),
        )


def respond_all(
    tasks: Sequence[TransientTask],
    cache: Cache,
    told: Callable[[float, str], None],
    announce: Callable[[str], None],
) -> list[Float64]:
    """Accelerations (t, p, 3) of all monitoring points, basic axes, m/s².

    Args:
        tasks: all with the same time grid.
        cache: where results are looked for and kept.
        told: hears the share of steps and a remark.
        announce: hears a line about the size of each block.
    """
    keys = [task.key for task in tasks]
    found = {}
    for key in set(keys):
        entry = cache.find("transient", key)
        if entry is not None:
            found[key] = entry["acceleration"]
    missing: dict[str, dict[str, TransientTask]] = {}
    for key, task in zip(keys, tasks):
        if key not in found:
            missing.setdefault(task.airframe.matrix_key, {})[key] = task
    for block in missing.values():
        for key, values in zip(block, _respond(list(block.values()), told, announce)):
            cache.keep("transient", key, {"acceleration": values})
            found[key] = values
    return [found[key] for key in keys]


def _watched(airframe: StudyAirframe) -> sp.csr_matrix:
    points = list(airframe.aircraft.monitoring.values())
    return airframe.structure.operator(points, (1, 2, 3), frame="basic")


def _respond(
    tasks: Sequence[TransientTask],
    told: Callable[[float, str], None],
    announce: Callable[[str], None],
) -> list[Float64]:
    """Responses to loads on one and the same set of matrices."""
    first = tasks[0].airframe
    structure, step = first.structure, tasks[0].loads.step
    count = len(tasks[0].loads.time) - 1
    time, _ = tasks[0].loads.held()
    pattern, factors = _loads(tasks, len(time))
    # One for each airframe, not for each task: it sees all load cases.
    watched = {
        id(t.airframe): Observation("acceleration", _watched(t.airframe)) for t in tasks
    }

    def integrate() -> None:
        direct_transient(
            structure.stiffness,
            structure.mass,
            structure.damping,
            steps=[(count, step)],
            load=sampled_load(pattern, time, factors),
            observers=list(watched.values()),
            mass_product=structure.mass_product,
            scheme=SCHEMES[first.case.transient.scheme](),
            progress=lambda done, wanted: told(done / wanted, f"step {done}"),
            inform=announce,
        )

    structure.guarded(integrate, dynamic=True, error=SingularMatrixError)
    return [
        watched[id(task.airframe)].values[:, i].reshape(count + 1, -1, 3)
        for i, task in enumerate(tasks)
    ]


def _loads(
    tasks: Sequence[TransientTask], instants: int
) -> tuple[sp.csr_matrix, Float64]:
    """Patterns (f, k), those of the same nodes once, and factors (tasks, k, t)."""
    patterns, place, width = {}, [], 0
    for task in tasks:
        nodes = task.loads.node_id
        key = id(task.airframe), tuple(nodes.tolist())
        if key not in patterns:
            rows = task.airframe.structure.operator(nodes, frame="basic")
            patterns[key] = width, rows.T
            width += 6 * len(nodes)
        place.append(patterns[key][0])
    factors = np.zeros((len(tasks), width, instants))
    for i, (task, at) in enumerate(zip(tasks, place)):
        load = task.loads.held()[1].reshape(instants, -1)
        factors[i, at : at + load.shape[1]] = load.T
    return sp.csr_matrix(sp.hstack([p for _, p in patterns.values()])), factors
