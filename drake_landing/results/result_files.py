"""Result files: `results.h5` and the CSV tables, each written aside and then renamed.

Layout of `results.h5`: attribute `case` (YAML) and `versions`; groups

    /provenance         how the run was made: attributes; files with checksums; gears
    /attachment_loads   time, node_id, load (t, k, 6) as given to the full model, basic
    /multibody/<kind>/<name>   time and value (t, c) with attributes columns, units;
                        kinds: attachment, tyre, strut, bending (elastic legs),
                        monitoring, motion, energy
    /multibody/modal_amplitudes (t, n); /multibody/bodies/<name> (t, 7) pose in W
    /fe/monitoring/<point>   as above, direct transient
    /parts/sections/<beam>   station (m, along `axis`), point (n, 3) that moments refer
                        to (m), value (t, n, 6): section loads; attributes outward,
                        axis, and the directions (3,) of shear, bending and torsion; B
    /parts/acceleration/<grid>   (t, 3), B; /parts/time
    /parts/stress       id, equivalent, time, largest, smallest of each element;
                        with axial_only these leave out bending
    /envelope/element_force, element_stress/<type>   id, min, max, time_of_min,
                        time_of_max; attribute columns of the group, Nastran's names
    /airframe           frequency_hz, mass, cg and inertia (axes A: aft, starboard, up,
                        origin of the deck), node_id; R_AB from the deck's axes to A
    /comparison, /gears   one dataset per column of the CSV tables

Each dataset has an attribute `unit`, or `units`, one per column.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import h5py
import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.csv_tables import write_csv
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.landing.history import LandingHistory
from drake_landing.parts.cuts import COMPONENTS, NAMED
from drake_landing.results.units import (
    element_unit,
    quantity_units,
    unit_of,
    with_units,
)
from drake_landing.versions import versions
from fem.files.atomic_hdf5 import written_hdf5
from fem.files.escaping import group_name
from fem.recovery.envelope import Envelope
from systems.airframe.modal_body import ModalBody

if TYPE_CHECKING:
    from drake_landing.parts.observers import PartsFound
    from drake_landing.results.provenance import Provenance

# What a run writes.
FILES = (
    "report.html",
    "histories.html",
    "landing.html",
    "results.h5",
    "landing_sol109.bdf",
    "tables (CSV)",
    "pictures",
)


def write_history_csv(path: Path, tables: Mapping[str, pd.DataFrame]) -> None:
    """Several tables over the same time, side by side: columns `<name>_<column>`."""
    joined = pd.concat(
        [t.add_prefix(f"{name}_") for name, t in tables.items()], axis="columns"
    )
    write_csv(path, with_units(joined.rename_axis("time")), index=True)


def write_results(
    path: Path,
    *,
    case: str,
    body: ModalBody,
    R_AB: np.ndarray,
    history: LandingHistory,
    loads: AttachmentLoads,
    response: Mapping[str, pd.DataFrame],
    envelopes: Sequence[Envelope],
    comparison: pd.DataFrame,
    gears: pd.DataFrame,
    parts: "PartsFound",
    provenance: "Provenance",
    seconds: float,
) -> None:
    """Writes `results.h5`.

    Args:
        path: of the file.
        case: YAML of the case, defaults written out.
        body: the modal body of the run.
        R_AB: (3, 3) from the deck's axes to the aircraft's, aft, starboard, up.
        history: the multibody run.
        loads: on the grid of the transient.
        response: acceleration of the monitoring points in the direct transient.
        envelopes: extremes of the element results in the direct transient.
        comparison, gears: the tables of the same names.
        parts: what the parts see.
        provenance: how the run was made.
        seconds: that it has taken so far.
    """
    with written_hdf5(path) as file:
        file.attrs["case"] = case
        for name, version in versions().items():
            file.require_group("versions").attrs[name] = version
        provenance.write(file, seconds)
        _write_loads(file.create_group("attachment_loads"), loads)
        _write_history(file.create_group("multibody"), history)
        for point, table in response.items():
            _write_series(file, f"fe/monitoring/{group_name(point)}", table)
        for envelope in envelopes:
            envelope.write(file)
        _name_units(file)
        _write_parts(file.create_group("parts"), parts)
        _write_airframe(file.create_group("airframe"), body, R_AB)
        _write_table(file.create_group("comparison"), comparison)
        peaks = gears.assign(unit=quantity_units(gears))
        _write_table(file.create_group("gears"), peaks)


def _dataset(group: h5py.Group, name: str, values: npt.ArrayLike, unit: str) -> None:
    """Values of one unit, which is an attribute."""
    group[name] = values
    group[name].attrs["unit"] = unit


def _name_units(file: h5py.File) -> None:
    """Units of the extremes of element results, one per column."""
    if "envelope" not in file:
        return
    for table in file["envelope"].values():
        result = table.name.rsplit("_", 1)[-1]
        for kind, group in table.items():
            columns = [str(c) for c in group.attrs["columns"]]
            units = [element_unit(result, kind, c) for c in columns]
            group["id"].attrs["unit"] = "1"
            for name in ("min", "max"):
                group[name].attrs["units"] = units
                group[f"time_of_{name}"].attrs["unit"] = "s"


def _write_loads(group: h5py.Group, loads: AttachmentLoads) -> None:
    _dataset(group, "time", loads.time, "s")
    _dataset(group, "node_id", loads.node_id, "1")
    group["load"] = loads.load
    group["load"].attrs["columns"] = ["fx", "fy", "fz", "mx", "my", "mz"]
    group["load"].attrs["units"] = ["N"] * 3 + ["N m"] * 3


def _write_history(group: h5py.Group, history: LandingHistory) -> None:
    kinds = {
        "attachment": history.attachment,
        "tyre": history.tire,
        "strut": history.strut,
        "bending": history.bending,
        "monitoring": history.monitoring,
    }
    for kind, tables in kinds.items():
        for name, table in tables.items():
            _write_series(group, f"{kind}/{group_name(name)}", table)
    _write_series(group, "motion", history.motion)
    _write_series(group, "energy", history.energy, unit="J")
    _dataset(group, "modal_amplitudes", history.amplitudes, "1")
    for name, poses in history.bodies.items():
        group[f"bodies/{name}"] = poses
        group[f"bodies/{name}"].attrs["columns"] = list(history.motion.columns)
        group[f"bodies/{name}"].attrs["units"] = ["1"] * 4 + ["m"] * 3


def _write_series(
    group: h5py.Group, name: str, table: pd.DataFrame, unit: str = ""
) -> None:
    """Time and values; `unit` is that of columns without one of their own."""
    at = group.create_group(name)
    _dataset(at, "time", table.index.to_numpy(), "s")
    at["value"] = table.to_numpy()
    at["value"].attrs["columns"] = [str(c) for c in table.columns]
    at["value"].attrs["units"] = [unit_of(str(c)) or unit for c in table.columns]


def _write_parts(group: h5py.Group, parts: "PartsFound") -> None:
    _dataset(group, "time", parts.time, "s")
    for name, cuts in parts.cuts.items():
        at = group.create_group(f"sections/{group_name(name)}")
        _dataset(at, "station", cuts.beam.stations, "m")
        _dataset(at, "point", cuts.point, "m")
        at["value"] = parts.landing.sections[name]
        at["value"].attrs["columns"] = list(COMPONENTS)
        at["value"].attrs["units"] = ["N"] * 3 + ["N m"] * 3
        beam = cuts.beam
        at.attrs["outward"], at.attrs["axis"] = beam.outward, beam.axis
        for quantity, axis in zip(NAMED, (beam.lift, beam.across, beam.direction)):
            at.attrs[quantity] = axis
    for station in parts.stations:
        at = group.create_group(f"monitor_points/{group_name(station.name)}")
        at["value"] = parts.landing.monitors[station.name]
        at["value"].attrs["columns"] = station.quantities
        at["value"].attrs["units"] = [unit_of(q) for q in station.quantities]
        _dataset(at, "point", station.point.point, "m")
        _dataset(at, "rotation", station.point.rotation, "1")
        for key in ("card", "label", "frame"):
            at.attrs[key] = getattr(station.point, key)
    for grid, values in parts.landing.acceleration.items():
        _dataset(group, f"acceleration/{grid}", values, "m/s²")
    stress = group.create_group("stress")
    table = parts.landing.stress
    # None where there is no element.
    _dataset(stress, "id", table["id"].to_numpy(np.int64), "1")
    for column in ("equivalent", "time", "largest", "smallest"):
        _dataset(stress, column, table[column].to_numpy(float), unit_of(column))
    _dataset(stress, "axial_only", table.axial_only.to_numpy(bool), "1")


def _write_airframe(group: h5py.Group, body: ModalBody, R_AB: np.ndarray) -> None:
    _dataset(group, "R_AB", R_AB, "1")
    _dataset(group, "frequency_hz", body.frequency, "Hz")
    _dataset(group, "modal_mass", body.modal_mass, "kg")
    _dataset(group, "modal_damping", body.modal_damping, "kg/s")
    _dataset(group, "mass", body.mass, "kg")
    _dataset(group, "cg", body.p_BG, "m")
    _dataset(group, "inertia", body.inertia_G, "kg m²")
    _dataset(group, "node_id", body.node_id, "1")


def _write_table(group: h5py.Group, table: pd.DataFrame) -> None:
    for column in table.columns:
        values = table[column].to_numpy()
        if values.dtype == object:
            values = np.array([str(v) for v in values], dtype=h5py.string_dtype())
        unit = unit_of(str(column))
        by_row = "by the dataset unit" if column in ("peak", "value") else "1"
        _dataset(group, str(column), values, unit or by_row)
