"""What bases give under the same loads, landing and all non-linearity set aside.

The modes of a reduced model are compared with those of the full one in number and in
shape, and the linear response of each basis with the direct transient, both under the
loads of one run: with the lowest modes, with all that it has, with static residual
vectors on top.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.airframe.basis import Basis, elastic_basis, with_residual_vectors
from drake_landing.airframe.selection import modal_model
from drake_landing.cache import Cache
from drake_landing.reference.studies.airframes import StudyAirframe
from drake_landing.reference.studies.budget import exact_response
from drake_landing.reference.studies.plan import FULL_MODES, NAMES, Plan

if TYPE_CHECKING:
    from drake_landing.reference.studies.runs import StudyRun

Float64 = npt.NDArray[np.float64]

BANDS = (10.0, 25.0, 50.0, 100.0, 150.0)  # Hz
_SAME_MODE = 0.9  # squared cosine of the angle between shapes, mass as the measure


def bases_of(
    plan: Plan, airframes: Mapping[str, StudyAirframe], cache: Cache
) -> dict[str, Basis]:
    """All bases of the first topology: full model, those of runs, further ones.

    Args:
        plan: names the further ones.
        airframes: topology -> airframe.
        cache: where modes of further ones may be found.
    """
    airframe = next(iter(airframes.values()))
    found = {FULL_MODES: airframe.candidates.basis}
    found |= {name: of.basis for name, of in airframe.reduced.items()}
    for name in plan.further_bases:
        settings = airframe.case.airframe.model_copy(update={"basis": name})
        found[name] = elastic_basis(
            airframe.structure, settings, list(airframe.aircraft.nodes), cache=cache
        )
    return {name: found[name] for name in NAMES if name in found}


def spectrum_table(
    airframes: Mapping[str, StudyAirframe], bases: Mapping[str, Basis]
) -> pd.DataFrame:
    """Number of modes below frequencies, and how many the full model has, too.

    Returns:
        Columns basis, freedoms, below_hz, modes; same: modes of the full model below
        that frequency for which the basis has one of (nearly) the same shape;
        too_high: largest excess of the frequency among these.
    """
    structure = next(iter(airframes.values())).structure
    full = bases[FULL_MODES]
    low = full.shape[:, full.frequency_hz < BANDS[-1]]
    weighted = structure.mass @ low
    rows = []
    for name, basis in bases.items():
        squared = (weighted.T @ basis.shape) ** 2
        best = squared.argmax(axis=1)
        same = squared.max(axis=1) >= _SAME_MODE
        own = full.frequency_hz[: len(best)]
        excess = np.where(same, basis.frequency_hz[best] / own - 1.0, 0.0)
        for limit in BANDS:
            rows.append(
                {
                    "basis": name,
                    "freedoms": basis.freedoms,
                    "below_hz": limit,
                    "modes": int((basis.frequency_hz < limit).sum()),
                    "same": int(same[own < limit].sum()),
                    "too_high": float(excess[own < limit].max(initial=0.0)),
                }
            )
    return pd.DataFrame(rows)


def bases_table(
    plan: Plan,
    airframes: Mapping[str, StudyAirframe],
    bases: Mapping[str, Basis],
    runs: Sequence["StudyRun"],
) -> pd.DataFrame:
    """Linear response of bases against the direct transient, vertical acceleration.

    Returns:
        Columns topology, basis, set, modes, highest_hz, point, rms_error; loads and
        transient are those of the last run of the first topology.
    """
    topology, airframe = next(iter(airframes.items()))
    last = [r for r in runs if r.name.topology == topology][-1]
    size = np.sqrt((last.transient[:, :, 2] ** 2).mean(axis=0))
    rows = []
    for name, label, basis in _sets(plan, airframe, bases):
        model = modal_model(airframe.structure, basis, airframe.aircraft)
        lost = exact_response(model, last.landing.loads) - last.transient
        error = np.sqrt((lost[:, :, 2] ** 2).mean(axis=0)) / size
        for p, point in enumerate(airframe.aircraft.monitoring):
            rows.append(
                {
                    "topology": topology,
                    "basis": name,
                    "set": label,
                    "modes": len(basis.frequency_hz),
                    "highest_hz": float(basis.frequency_hz.max()),
                    "point": point,
                    "rms_error": float(error[p]),
                }
            )
    return pd.DataFrame(rows)


def _sets(
    plan: Plan, airframe: StudyAirframe, bases: Mapping[str, Basis]
) -> Iterator[tuple[str, str, Basis]]:
    """Basis, label, modes."""
    for name, basis in bases.items():
        for count in plan.counts:
            yield name, f"lowest {count}", basis.chosen(np.arange(count))
        yield name, "all", basis
    for count in plan.counts:
        few = bases[FULL_MODES].chosen(np.arange(count))
        nodes = airframe.aircraft.attachment_nodes
        more = with_residual_vectors(airframe.structure, few, nodes)
        yield FULL_MODES, f"lowest {count}, residual vectors", more
