"""Tables of a study: measures, budgets, convergence."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.comparison import NEGLIGIBLE, agreement
from drake_landing.relevance import modal_accelerations
from drake_landing.studies.airframes import StudyAirframe
from drake_landing.studies.budget import at_points, modal_forces, rms_share

if TYPE_CHECKING:
    from drake_landing.studies.study import StudyRun

Float64 = npt.NDArray[np.float64]

BUDGET = ("truncation", "formulation", "integration", "rest")
_COUNTS = (5, 10, 15, 19, 25, 30, 36, 45, 55, 65, 73, 85, 95, 120, 150, 192, 210, 270)
_COUNTS += (350, 450, 600)


def study_table(points: Sequence[str], runs: Sequence["StudyRun"]) -> pd.DataFrame:
    """Peak, its time, rms, correlation, Sprague-Geers of every run, point and axis."""
    rows = []
    for run in runs:
        floor = NEGLIGIBLE * np.abs(run.transient).max()
        for p, point in enumerate(points):
            for a, axis in enumerate("xyz"):
                fe, mbs = run.transient[:, p, a], run.landing.acceleration[:, p, a]
                if np.abs(fe).max() <= floor:
                    continue
                found = agreement(run.time, fe, mbs)
                rows.append(
                    {
                        "topology": run.name.topology,
                        "modes": run.choice.count,
                        "selection": run.name.selection,
                        "point": point,
                        "axis": axis,
                        "peak_fe": found.peak_reference.value,
                        "time_fe": found.peak_reference.time,
                        "peak_mbs": found.peak.value,
                        "time_mbs": found.peak.time,
                        "peak_error": found.peak_error,
                        "rms_error": found.rms_error,
                        "correlation": found.correlation,
                        "sg_magnitude": found.sprague_geers.magnitude,
                        "sg_phase": found.sprague_geers.phase,
                        "sprague_geers": found.sprague_geers.combined,
                    }
                )
    return pd.DataFrame(rows)


def budget_table(points: Sequence[str], runs: Sequence["StudyRun"]) -> pd.DataFrame:
    """Parts of the difference of the vertical acceleration, rms over rms of the FE.

    `feedback` compares full-model responses: under the loads of this run and under
    those of the topology's run with most relevant modes, which has the best loads.
    `expected` and `truncated` are the truncation error of the acceleration vector,
    estimated before the run and found after it.
    """
    rows = []
    for run in runs:
        of_topology = [r for r in runs if r.name.topology == run.name.topology]
        best = min(of_topology, key=lambda r: float(_truncated(r).max()))
        shares = {
            name: rms_share(getattr(run.budget, name), run.transient)
            for name in (*BUDGET, "total")
        }
        feedback = rms_share(run.transient - best.transient, best.transient)
        truncated = _truncated(run)
        for p, point in enumerate(points):
            rows.append(
                {
                    "topology": run.name.topology,
                    "modes": run.choice.count,
                    "selection": run.name.selection,
                    "point": point,
                    **{name: float(share[p, 2]) for name, share in shares.items()},
                    "feedback": float(feedback[p, 2]),
                    "expected": float(run.choice.expected[p]),
                    "truncated": float(truncated[p]),
                }
            )
    return pd.DataFrame(rows)


def _truncated(run: "StudyRun") -> Float64:
    """(p,) true truncation error of the acceleration vector: modes against full FE."""
    lost = run.budget.truncation + run.budget.integration + run.budget.rest
    size = (run.transient**2).sum(axis=2).mean(axis=0)
    return np.sqrt((lost**2).sum(axis=2).mean(axis=0) / size)


def convergence_table(
    airframes: Mapping[str, StudyAirframe], runs: Sequence["StudyRun"]
) -> pd.DataFrame:
    """Modal truncation error (vertical) over the number of modes, both orders.

    Loads are those of each topology's last run; the reference has all candidates.
    """
    rows = []
    for topology, airframe in airframes.items():
        loads = [r for r in runs if r.name.topology == topology][-1].landing.loads
        model = airframe.candidates.model
        q = modal_accelerations(
            model.frequency_hz, model.damping, modal_forces(model, loads), loads.step
        )
        every = at_points(model, q)
        orders = {
            "lowest": airframe.candidates.relevance.elastic,
            "relevance": airframe.candidates.relevance.order,
        }
        for order, modes in orders.items():
            for count in [c for c in _COUNTS if c < len(modes)]:
                lost = np.zeros(len(model.frequency_hz), bool)
                lost[modes[count:]] = True
                share = rms_share(at_points(model, q, lost), every)
                for p, point in enumerate(airframe.aircraft.monitoring):
                    rows.append([topology, order, count, point, float(share[p, 2])])
    return pd.DataFrame(
        rows, columns=["topology", "order", "modes", "point", "rms_error"]
    )
