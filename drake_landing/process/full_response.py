"""The chapter of the process on the full model: transient, parts, rival practices."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.body import AirframeModel
from drake_landing.cache import Arrays, Cache, content_key
from drake_landing.case.axes import rotation_AB
from drake_landing.case.schema import Case
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.parts.buckling import BuckledPanels, buckled_panels
from drake_landing.parts.case_places import places_of
from drake_landing.parts.cuts import Cutter
from drake_landing.parts.inventory import Inventory, inventory
from drake_landing.parts.observers import PartsFound, PartsWatch
from drake_landing.parts.slices import (
    Balanced,
    balanced,
    extreme_instants,
    slice_loads,
    static_slices,
)
from drake_landing.places import Places
from drake_landing.results.stages import Spent, Stages, Timed
from drake_landing.transient.cached import Response, kept_response, response_key
from drake_landing.transient.extremes import OfFirstCase, element_envelopes
from drake_landing.transient.practices import Practices, compare_practices
from drake_landing.transient.response import transient_response
from fem.errors import InputError, Problems
from fem.model.structure import Structure
from fem.recovery.envelope import Envelope
from fem.response.direct import TransientRun

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class FullResponse:
    """Response of the full model.

    Attributes:
        response: acceleration of the monitoring points, B.
        envelopes: extremes of all element forces and stresses.
        watch: what was looked at.
        parts: what was found there.
        practices: the three side by side, None: not asked for.
        buckled: panels that buckle first, None: not asked for.
    """

    response: dict[str, pd.DataFrame]
    envelopes: tuple[Envelope, ...]
    watch: PartsWatch
    parts: PartsFound
    practices: Practices | None
    buckled: BuckledPanels | None


def full_response(
    case: Case,
    aircraft: Aircraft,
    airframe: AirframeModel,
    loads: Sequence[AttachmentLoads],
    cache: Cache,
    stages: Stages,
) -> FullResponse:
    """Static cases, transient, parts and practices.

    Args:
        case, aircraft, airframe: of the run.
        loads: of the landing, and of one with a rigid airframe if practices are to be
            compared.
        cache: where static cases and transients may be found.
        stages: told and measured.
    """
    structure, landing = airframe.structure, loads[0]
    stages.begin("static cases")
    gears = {g.name: list(g.attachments.values()) for g in aircraft.gears}
    wanted = len(loads) > 1 or case.parts.buckling
    instants = extreme_instants(landing, gears) if wanted else {}
    steady, slices = _static(aircraft, structure, landing, instants, cache)
    buckled = None
    if slices is not None and case.parts.buckling:
        stages.begin("buckling", f"({len(instants)} static cases)")
        upon = slices.displacement
        buckled = buckled_panels(
            structure,
            inventory(structure, case.parts.allowables, case.parts.components),
            upon if steady is None else upon + steady[:, None],
            {float(landing.time[k]): text for k, text in instants.items()},
            case.parts.buckling,
            cache,
            lambda done, total: stages.progress.share(done / total, f"case {done}"),
        )

    stages.begin("maps of stresses and section loads")
    watch = parts_watch(case, aircraft, structure, landing.node_id, steady)
    envelopes = element_envelopes(structure)

    stages.begin("direct transient", f"({len(loads)} load cases)")
    scheme, points = case.transient.scheme, aircraft.monitoring
    response = kept_response(
        cache,
        response_key(structure, scheme, loads, points, watch, envelopes),
        points,
        watch,
        envelopes,
        lambda: _respond(case, aircraft, structure, loads, watch, envelopes, stages),
    )

    stages.begin("tables of the parts")
    parts = watch.collect(loads)
    practices = None
    if slices is not None and len(loads) > 1:
        at_rest = static_slices(
            structure,
            landing,
            instants,
            slices,
            watch.stresses,
            watch.cuts,
            watch.grids,
        )
        practices = compare_practices(parts, at_rest, loads[1], points)
    return FullResponse(
        response=response,
        envelopes=tuple(envelopes),
        watch=watch,
        parts=parts,
        practices=practices,
        buckled=buckled,
    )


def _static(
    aircraft: Aircraft,
    structure: Structure,
    loads: AttachmentLoads,
    instants: dict[int, str],
    cache: Cache,
) -> tuple[Float64 | None, Balanced | None]:
    """Displacements of steady flight where it is known, and the slices."""
    columns = []
    if aircraft.steady_load is not None:
        columns.append(aircraft.steady_load(structure))
    flights = len(columns)
    if instants:
        columns.append(slice_loads(structure, loads, instants))
    if not columns:
        return None, None
    load = np.concatenate(columns, axis=1)

    def build() -> Arrays:
        found = balanced(structure, load)
        return {"displacement": found.displacement, "motion": found.motion}

    key = content_key(structure.stiffness, structure.mass, load)
    still = Balanced(**cache.arrays("static", key, build))
    steady = still.displacement[:, 0] if flights else None
    return steady, still.take(slice(flights, None)) if instants else None


def parts_looked_at(
    case: Case, aircraft: Aircraft, structure: Structure, loaded: Int64
) -> tuple[Cutter, Inventory, Places]:
    """Components and places of a case, checked before anything is computed.

    Args:
        case, aircraft: of the run.
        structure: the full model.
        loaded: (k,) nodes that loads act on.

    Raises:
        InputError: components, cuts or grids that the deck does not have.
    """
    cutter, problems = Cutter(structure), Problems()
    try:
        elements = inventory(structure, case.parts.allowables, case.parts.components)
    except InputError as error:
        problems += error.problems
        elements = inventory(structure, {})
    try:
        places = places_of(
            cutter,
            case.parts,
            rotation_AB(case.airframe.axes),
            aircraft.monitoring,
            aircraft.known_places(structure),
            elements,
            loaded.tolist(),
        )
    except InputError as error:
        raise InputError([*problems, *error.problems]) from None
    problems.report()
    return cutter, elements, places


def parts_watch(
    case: Case,
    aircraft: Aircraft,
    structure: Structure,
    loaded: Int64,
    steady: Float64 | None,
) -> PartsWatch:
    """Observers of the parts in the transients of a case.

    Args:
        case, aircraft, structure, loaded: see `parts_looked_at`.
        steady: (f,) displacements of steady flight, None: not known.
    """
    cutter, elements, places = parts_looked_at(case, aircraft, structure, loaded)
    return PartsWatch(
        cutter,
        places,
        elements,
        list(aircraft.monitoring.values()),
        loaded,
        averaged=case.transient.scheme == "nastran",
        steady=steady,
    )


def _respond(
    case: Case,
    aircraft: Aircraft,
    structure: Structure,
    loads: Sequence[AttachmentLoads],
    watch: PartsWatch,
    envelopes: Sequence[Envelope],
    stages: Stages,
) -> Response:
    """The transient of all load cases; its parts are booked as stages of their own."""
    seen = [Timed(observer) for observer in watch.observers]
    extremes = Timed(OfFirstCase(envelopes))

    def book(run: TransientRun) -> None:
        factor = Spent(wall=run.factor_seconds, processor=run.factor_processor)
        stages.split(
            {
                "transient: factorisation": factor,
                "transient: stresses, section loads": sum(
                    (o.spent for o in seen), Spent()
                ),
                "transient: extremes of all results": extremes.spent,
            }
        )

    return transient_response(
        structure,
        loads[0],
        aircraft.monitoring,
        case.transient.scheme,
        stages.progress,
        [*seen, extremes],
        loads[1:],
        book,
    )
