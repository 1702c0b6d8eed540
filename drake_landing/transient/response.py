"""Direct transient response of the full model to the attachment loads.

The airframe flies freely and starts at rest: the response is the increment to steady
flight, as the loads are.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.landing.handover import AttachmentLoads
from drake_landing.landing.history import POINT
from drake_landing.progress import Reporter, Silent
from fem.algebra.linear_solver import SingularMatrixError
from fem.model.structure import Structure
from fem.response.direct import TransientRun, direct_transient
from fem.response.generalized_alpha import GeneralizedAlpha
from fem.response.nastran_scheme import NastranScheme
from fem.response.observation import Observation, Observer
from fem.response.system import TransientLoad, sampled_load

Float64 = npt.NDArray[np.float64]

SCHEMES = {"nastran": NastranScheme, "generalised-alpha": GeneralizedAlpha}


def transient_load(structure: Structure, *cases: AttachmentLoads) -> TransientLoad:
    """The loads as patterns on the free set times functions of time.

    Args:
        structure: the full model.
        cases: load cases on the same nodes and instants.

    Raises:
        ValueError: nodes or instants differ.
    """
    first = cases[0]
    for other in cases[1:]:
        if not np.array_equal(first.node_id, other.node_id) or not np.array_equal(
            first.time, other.time
        ):
            raise ValueError("load cases differ in their nodes or instants")
    time, _ = first.held()
    factors = [loads.held()[1].reshape(len(time), -1).T for loads in cases]
    pattern = structure.operator(first.node_id, frame="basic").T
    return sampled_load(pattern, time, np.stack(factors))


def transient_response(
    structure: Structure,
    loads: AttachmentLoads,
    points: Mapping[str, int],
    scheme: str = "nastran",
    progress: Reporter | None = None,
    observers: Sequence[Observer] = (),
    further: Sequence[AttachmentLoads] = (),
    done: Callable[[TransientRun], None] | None = None,
) -> dict[str, pd.DataFrame]:
    """Accelerations of monitoring points, basic axes.

    Args:
        structure: the full model.
        loads: on an even grid, whose step is that of the integration.
        points: name -> grid id.
        scheme: a key of `SCHEMES`.
        progress: told the share of steps.
        observers: further takers of the response: envelopes, stresses.
        further: load cases beside the first, integrated together with it.
        done: hears how the transient went.

    Returns:
        Point -> table with columns x, y, z, m/s², over time, under `loads`.

    Raises:
        InputError: a motion without mass and stiffness, with the grids that move.
    """
    tell = progress or Silent()
    watched = Observation(
        "acceleration",
        structure.operator(list(points.values()), (1, 2, 3), frame="basic"),
    )

    def integrate() -> None:
        run = direct_transient(
            structure.stiffness,
            structure.mass,
            structure.damping,
            steps=[(len(loads.time) - 1, loads.step)],
            load=transient_load(structure, loads, *further),
            observers=[watched, *observers],
            scheme=SCHEMES[scheme](),
            mass_product=structure.mass_product,
            progress=lambda step, wanted: tell.share(step / wanted, f"step {step}"),
        )
        if done is not None:
            done(run)

    structure.guarded(integrate, dynamic=True, error=SingularMatrixError)
    index = pd.Index(loads.time, name="time")
    values = watched.values[:, 0].reshape(len(index), len(points), 3)
    return {
        point: pd.DataFrame(values[:, i], columns=list(POINT), index=index)
        for i, point in enumerate(points)
    }
