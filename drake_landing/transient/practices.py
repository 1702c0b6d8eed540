"""Three practices side by side for the same landing: what each makes of it.

    rigid gear loads    gear loads of a landing with a rigid airframe, applied to the
                        flexible model: dynamic response, but the gears never felt the
                        airframe yield
    static slices       the hybrid loads frozen at the instants of their extremes,
                        balanced by the inertia of the rigid aircraft: no dynamic
                        response at all
    hybrid              flexible landing, loads handed over, dynamic response

The two dynamic ones are load cases of one transient: one factorisation, one block of
right-hand sides.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.landing.handover import AttachmentLoads
from drake_landing.parts.cuts import NAMED
from drake_landing.parts.observers import PartsFound
from drake_landing.parts.slices import Slices
from systems.airframe.modal_body import ModalBody

Float64 = npt.NDArray[np.float64]

HYBRID, RIGID, STATIC = "hybrid", "rigid gear loads", "static slices"
COLUMNS = ["kind", "quantity", "unit", "practice", "value", "time", "error"]
KINDS = ("acceleration", "section load", "stress")
# Quantities below this share of the largest of their kind are left out: by symmetry.
_SMALL = 0.02


@dataclass(frozen=True, kw_only=True)
class Practices:
    """Results of the three practices.

    Attributes:
        table: rows with columns `COLUMNS`; `value` is the extreme of largest magnitude
            (of a section load and an acceleration with its sign), `error` its magnitude
            over that of the hybrid process, less one.
        rigid_loads: of the landing with a rigid airframe.
        slices: the static cases.
    """

    table: pd.DataFrame
    rigid_loads: AttachmentLoads
    slices: Slices


def rigid(body: ModalBody) -> ModalBody:
    """Copy of the airframe without elastic modes."""
    return replace(
        body,
        frequency=body.frequency[:0],
        modal_mass=body.modal_mass[:0],
        modal_damping=body.modal_damping[:0, :0],
        translation=body.translation[..., :0],
        rotation=body.rotation[..., :0],
    )


def compare_practices(
    found: PartsFound,
    slices: Slices,
    rigid_loads: AttachmentLoads,
    monitoring: Mapping[str, int],
) -> Practices:
    """Peaks of the three practices.

    Args:
        found: of the transient with two load cases, hybrid and rigid gear loads.
        slices: static cases.
        rigid_loads: of the landing with a rigid airframe.
        monitoring: point -> grid id.
    """
    if len(found.cases) != 2:
        raise ValueError(f"{len(found.cases)} load cases, expected hybrid and rigid")
    rows = [
        *_accelerations(found, slices, monitoring),
        *_sections(found, slices),
        *_stresses(found, slices),
    ]
    table = pd.DataFrame(rows, columns=COLUMNS[:-1])
    reference = table[table.practice == HYBRID].set_index(["kind", "quantity"]).value
    of_hybrid = np.array(
        [reference.loc[(k, q)] for k, q in zip(table.kind, table.quantity)]
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        error = np.abs(table.value.to_numpy()) / np.abs(of_hybrid) - 1.0
    table["error"] = np.where(of_hybrid == 0.0, np.nan, error)
    largest = table.assign(size=np.abs(of_hybrid)).groupby("kind")["size"]
    counts = np.abs(of_hybrid) >= _SMALL * largest.transform("max").to_numpy()
    return Practices(
        table=table[counts | (table.kind == "stress")].reset_index(drop=True),
        rigid_loads=rigid_loads,
        slices=slices,
    )


Row = list[str | float]


def _peaks(
    kind: str,
    quantity: str,
    unit: str,
    series: Mapping[str, tuple[Float64, Float64]],
) -> Iterator[Row]:
    for practice, (time, values) in series.items():
        at = int(np.argmax(np.abs(values)))
        yield [kind, quantity, unit, practice, float(values[at]), float(time[at])]


def _accelerations(
    found: PartsFound, slices: Slices, monitoring: Mapping[str, int]
) -> Iterator[Row]:
    hybrid, rigid_case = found.cases
    for point, grid in monitoring.items():
        series = {
            HYBRID: (found.time, hybrid.acceleration[grid][:, 2]),
            RIGID: (found.time, rigid_case.acceleration[grid][:, 2]),
            STATIC: (slices.time, slices.acceleration[grid][:, 2]),
        }
        quantity = f"{point.replace('_', ' ')}, z"
        yield from _peaks("acceleration", quantity, "m/s²", series)


def _sections(found: PartsFound, slices: Slices) -> Iterator[Row]:
    """Shear, bending and torsion at the cut of each beam that is looked at."""
    hybrid, rigid_case = found.cases
    for name, cuts in found.cuts.items():
        at = found.looked_at[name]
        series = {
            HYBRID: (found.time, cuts.named(hybrid.sections[name][:, at])),
            RIGID: (found.time, cuts.named(rigid_case.sections[name][:, at])),
            STATIC: (slices.time, cuts.named(slices.sections[name][:, at])),
        }
        for q, quantity in enumerate(NAMED):
            of = {practice: (t, v[:, q]) for practice, (t, v) in series.items()}
            unit = "N" if quantity == "shear" else "N m"
            yield from _peaks("section load", f"{name}: {quantity}", unit, of)


def _stresses(found: PartsFound, slices: Slices) -> Iterator[Row]:
    """The largest equivalent stress of each component."""
    hybrid, rigid_case = found.cases
    equivalent = slices.stress[..., 0]
    component = hybrid.stress.component.to_numpy()
    tables = {
        HYBRID: (hybrid.stress.equivalent, hybrid.stress.time),
        RIGID: (rigid_case.stress.equivalent, rigid_case.stress.time),
        STATIC: (
            pd.Series(equivalent.max(axis=0)),
            pd.Series(slices.time[equivalent.argmax(axis=0)]),
        ),
    }
    known = ~hybrid.stress.axial_only.to_numpy(bool)
    for name in hybrid.stress.component[known].value_counts().index:
        own = np.flatnonzero((component == name) & known)
        for practice, (stress, time) in tables.items():
            at = own[int(np.argmax(stress.to_numpy()[own]))]
            value, when = float(stress.iloc[at]), float(time.iloc[at])
            yield ["stress", str(name), "Pa", practice, value, when]
