"""What leaves a difference that more modes do not close.

The budget of a study's own runs may find truncation alone. Two practices make the
multibody model and the transient two different models, however many modes the former
has: modal damping that is not the projection of the transient's own damping, and a step
of the transient that is too long for the loads. Here each is put in, one at a time,
under the loads of one run; everything is linear and modal.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.airframe.relevance import ModalModel
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.reference.studies.airframes import StudyAirframe
from drake_landing.reference.studies.budget import (
    at_points,
    exact_response,
    modal_forces,
    nastran_accelerations,
)
from drake_landing.reference.studies.plan import Plan

if TYPE_CHECKING:
    from drake_landing.reference.studies.runs import StudyRun

Float64 = npt.NDArray[np.float64]

DAMPING = (0.01, 0.02)  # of critical, of every mode
STEPS = (1e-3, 2e-3, 5e-3)  # s


def gap_table(
    plan: Plan, airframes: Mapping[str, StudyAirframe], runs: Sequence["StudyRun"]
) -> pd.DataFrame:
    """The lowest modes against the direct transient, vertical acceleration.

    Returns:
        Columns topology, practice, modes, point, rms_error, for the first topology.
    """
    topology, airframe = next(iter(airframes.items()))
    last = [r for r in runs if r.name.topology == topology][-1]
    model, loads = airframe.candidates.model, last.landing.loads
    rows = []
    for count in plan.counts:
        few = model.of(np.arange(np.sum(~model.elastic) + count))
        for practice, found, reference in _practices(model, few, loads, last.transient):
            lost, size = (
                np.sqrt((x[:, :, 2] ** 2).mean(axis=0))
                for x in (found - reference, reference)
            )
            for p, point in enumerate(airframe.aircraft.monitoring):
                rows.append(
                    [topology, practice, count, point, float(lost[p] / size[p])]
                )
    return pd.DataFrame(
        rows, columns=["topology", "practice", "modes", "point", "rms_error"]
    )


def _practices(
    model: ModalModel, few: ModalModel, loads: AttachmentLoads, transient: Float64
) -> Iterator[tuple[str, Float64, Float64]]:
    """Name, response of the few modes, direct transient."""
    right = exact_response(few, loads)
    yield "as in this study", right, transient
    for ratio in DAMPING:
        damping = 4.0 * np.pi * ratio * few.frequency_hz
        other = exact_response(replace(few, damping=damping), loads)
        yield f"modal damping {ratio:.0%} of critical", other, transient
    force = modal_forces(model, loads)
    for step in STEPS:
        every = round(step / loads.step)
        coarse = nastran_accelerations(model, force[::every], every * loads.step)
        name = f"transient at {1e3 * step:g} ms"
        yield name, right[::every], at_points(model, coarse)
