"""What a reduction to the interface costs before any mode is left out."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from drake_landing.basis import elastic_basis
from drake_landing.cache import Cache
from drake_landing.selection import modal_model
from drake_landing.studies.airframes import StudyAirframe
from drake_landing.studies.budget import exact_response, rms_share
from drake_landing.studies.plan import Plan

if TYPE_CHECKING:
    from drake_landing.studies.study import StudyRun

COLUMNS = ["topology", "basis", "modes", "freedoms", "point", "axis", "rms_error"]


def reduction_errors(
    plan: Plan,
    airframes: Mapping[str, StudyAirframe],
    runs: Sequence["StudyRun"],
    cache: Cache,
) -> pd.DataFrame:
    """Reduced against full model, both with all modes below the candidates' limit.

    The loads are those of the topology's last run. Both responses are modal and exact.

    Args:
        plan: names the bases.
        airframes: topology -> airframe; the first is used.
        runs: of the study.
        cache: where reduced modes may be found.

    Returns:
        Columns `COLUMNS`.
    """
    topology, airframe = next(iter(airframes.items()))
    loads = [r for r in runs if r.name.topology == topology][-1].landing.loads
    full = exact_response(airframe.candidates.model, loads)
    rows = []
    for basis_name in plan.reductions:
        settings = airframe.case.airframe.model_copy(update={"basis": basis_name})
        basis = elastic_basis(
            airframe.structure, settings, list(airframe.aircraft.nodes), cache=cache
        )
        reduced = modal_model(airframe.structure, basis, airframe.aircraft)
        error = rms_share(exact_response(reduced, loads) - full, full)
        for p, point in enumerate(airframe.aircraft.monitoring):
            if point not in plan.points:
                continue
            for a, axis in enumerate("xyz"):
                count, freedoms = len(basis.frequency_hz), basis.freedoms
                share = float(error[p, a]) if _moves(full, p, a) else float("nan")
                rows.append([topology, basis_name, count, freedoms, point, axis, share])
    return pd.DataFrame(rows, columns=COLUMNS)


def _moves(response: np.ndarray, p: int, a: int) -> bool:
    return bool(np.abs(response[:, p, a]).max() > 1e-3 * np.abs(response).max())
