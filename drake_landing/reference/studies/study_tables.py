"""Tables of a study: measures, budgets, convergence."""

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.airframe.oscillators import modal_accelerations
from drake_landing.airframe.selection import Candidates
from drake_landing.case.mode_selection import Selection
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.reference.studies.airframes import StudyAirframe
from drake_landing.reference.studies.budget import (
    at_points,
    exact_response,
    modal_forces,
    rms_share,
)
from drake_landing.results.comparison import NEGLIGIBLE, agreement

if TYPE_CHECKING:
    from drake_landing.reference.studies.runs import StudyRun

Float64 = npt.NDArray[np.float64]

BUDGET = ("truncation", "reduction", "formulation", "integration", "rest")
_COUNTS = (5, 10, 15, 19, 25, 30, 36, 45, 55, 65, 73, 85, 95, 120, 150, 192, 210, 270)
_COUNTS += (350, 450, 600)
_PULSES = (10, 19, 36, 47, 60, 73, 95, 120)  # beyond there is nothing to gain


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
    `expected` and `truncated` are the error of the acceleration vector because modes
    are left out or a reduction lies before, estimated before the run and found
    after it.
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
    """(p,) true error of the acceleration vector: linear modes against full FE."""
    lost = run.budget.omitted
    size = (run.transient**2).sum(axis=2).mean(axis=0)
    return np.sqrt((lost**2).sum(axis=2).mean(axis=0) / size)


def convergence_table(
    airframes: Mapping[str, StudyAirframe], runs: Sequence["StudyRun"]
) -> pd.DataFrame:
    """Linear modal response (vertical) over the number of modes, in several orders.

    `lowest` and `relevance` pick modes of the full model, `pulses` combines them, a
    basis (`guyan`) picks the lowest modes of a reduced model. Loads and direct
    transient are those of each topology's last run.
    """
    rows = []
    for topology, airframe in airframes.items():
        last = [r for r in runs if r.name.topology == topology][-1]
        size = np.sqrt((last.transient[:, :, 2] ** 2).mean(axis=0))
        orders: dict[str, tuple[Candidates, str]] = {
            "lowest": (airframe.candidates, "count"),
            "relevance": (airframe.candidates, "relevance"),
            "pulses": (airframe.candidates, "pulses"),
            **{name: (of, "count") for name, of in airframe.reduced.items()},
        }
        for order, (candidates, kind) in orders.items():
            most = len(candidates.basis.frequency_hz)
            wanted = _PULSES if kind == "pulses" else _COUNTS
            counts = [n for n in wanted if n < most]
            for count, errors in zip(
                counts, _errors(candidates, kind, counts, last.landing.loads, last)
            ):
                for p, point in enumerate(airframe.aircraft.monitoring):
                    share = float(errors[p] / size[p])
                    rows.append([topology, order, count, point, share])
    return pd.DataFrame(
        rows, columns=["topology", "order", "modes", "point", "rms_error"]
    )


def _errors(
    candidates: Candidates,
    kind: str,
    counts: Sequence[int],
    loads: AttachmentLoads,
    run: "StudyRun",
) -> Iterator[Float64]:
    """(p,) rms of linear response less direct transient, vertical, for each count."""
    if kind == "pulses":
        for count in counts:
            choice = candidates.choose(Selection(kind="pulses", value=count))
            found = exact_response(choice.model, loads)
            yield _vertical_rms(found - run.transient)
        return
    model = candidates.model
    force = modal_forces(model, loads)
    q = modal_accelerations(model.frequency_hz, model.damping, force, loads.step)
    relevance = candidates.relevance
    modes = relevance.order if kind == "relevance" else relevance.elastic
    for count in counts:
        keep = ~model.elastic
        keep[modes[:count]] = True
        yield _vertical_rms(at_points(model, q, keep) - run.transient)


def _vertical_rms(difference: Float64) -> Float64:
    return np.sqrt((difference[:, :, 2] ** 2).mean(axis=0))
