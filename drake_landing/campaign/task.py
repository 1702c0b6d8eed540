"""One case of a campaign: it lands, is screened, and leaves one file.

The file holds everything that later stages need: loads, amplitudes, extremes of the
stresses of all elements and of the section loads, peaks of gears and points. It appears
when it is complete. A case that cannot be flown leaves a file that says why.
"""

import json
import traceback
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Literal

import h5py
import numpy as np
import pandas as pd

from drake_landing.cache import content_key
from drake_landing.campaign.basis import amplitudes
from drake_landing.campaign.engine import no_space
from drake_landing.campaign.hulls import hull_rows
from drake_landing.campaign.screening import Screened, screen
from drake_landing.campaign.setup import LandingSetup, SetupFile, read_landing_setup
from drake_landing.case.axes import rotation_AB
from drake_landing.case.reading import parse_case
from drake_landing.case.schema import Case
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.landing.diagram import LandingDiagram
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.landing.history import LandingHistory, gear_peaks
from drake_landing.landing.run import build_landing, fly
from drake_landing.parts.cuts import NAMED
from fem.arrays import Float64
from fem.errors import InputError
from fem.files.atomic import written_aside
from fem.files.atomic_hdf5 import written_hdf5
from fem.files.escaping import group_name

Status = Literal["done", "suspect", "failed"]

_ENERGY = 1e-3  # of the sink energy: a balance worse than this is suspect
_DIAGRAMS: dict[tuple[str, ...], LandingDiagram] = {}
_LARGE = 10_000  # values of a dataset that is worth packing
PAIRS = (("shear", "bending"), ("bending", "torsion"), ("shear", "torsion"))


@dataclass(frozen=True, kw_only=True)
class LandingTask:
    """What a worker needs for a case.

    Attributes:
        number: of the case, which names its file.
        text: the case as YAML, relative paths resolved.
        key: of everything that the result depends on.
        gears: of the aircraft, in the axes of the deck.
        monitoring: point -> grid id.
        lift_nodes: where the case has lift over nodes that the aircraft names.
        setup: of the airframe.
        folder: of the case files.
        step: of the transient's time grid, s.
        scheme: of the transient.
    """

    number: int
    text: str
    key: str
    gears: tuple[LandingGear, ...]
    monitoring: Mapping[str, int]
    lift_nodes: tuple[int, ...]
    setup: SetupFile
    folder: Path
    step: float
    scheme: str

    @property
    def transient_key(self) -> str:
        """Key of everything that the direct transient depends on."""
        return content_key("transient", self.key)


def case_file(folder: Path, number: int) -> Path:
    """Path of the result file of a flown case."""
    return folder / f"{number:06d}.h5"


def failure_file(folder: Path, number: int) -> Path:
    """Path of the file that says why a case could not be flown."""
    return folder / f"{number:06d}.failed.json"


def run_task(task: LandingTask) -> tuple[int, Status]:
    """Flies and screens a case; the status is in its file, too."""
    try:
        status = _run(task)
    except Exception as error:  # whatever it is: a case never ends a campaign
        if no_space(error):
            raise
        known = isinstance(error, InputError) or getattr(error, "for_users", False)
        write_failure(
            task.folder,
            task.number,
            task.key,
            str(error).strip() or type(error).__name__,
            None if known else traceback.format_exc(),
        )
        return task.number, "failed"
    return task.number, status


def write_failure(
    folder: Path, number: int, key: str, message: str, trace: str | None = None
) -> None:
    """Leaves word of a case that has no result."""
    found = {"case": number, "key": key, "message": message, "traceback": trace}
    with written_aside(failure_file(folder, number)) as part:
        part.write_text(json.dumps(found, indent=1), encoding="utf-8")
    case_file(folder, number).unlink(missing_ok=True)


def _run(task: LandingTask) -> Status:
    setup = read_landing_setup(task.setup)
    case = parse_case(task.text)
    R_AB, points = rotation_AB(case.airframe.axes), task.monitoring
    landing = _diagram(task, case)
    history = fly(landing, _scenario(case, task), case.simulation, points, R_AB)
    loads = _on_nodes(history, setup, case)
    z = amplitudes(setup.basis, history, loads)
    found = screen(setup.basis, setup.rows, z, setup.steady)
    status, remark = _judged(history, found)
    with written_hdf5(case_file(task.folder, task.number)) as file:
        file.attrs.update(
            case=task.number, key=task.key, status=status, remark=remark, yaml=task.text
        )
        _write_loads(file, loads, z, setup)
        _write_stresses(file, found, loads)
        _write_sections(file, setup, z, loads)
        _write_monitors(file, setup, z, loads)
        _write_peaks(file, case, history)
    failure_file(task.folder, task.number).unlink(missing_ok=True)
    return status


def _scenario(case: Case, task: LandingTask):
    lift = case.scenario.lift
    if isinstance(lift, str) or lift.nodes:
        return case.scenario
    lift = lift.model_copy(update={"nodes": task.lift_nodes})
    return case.scenario.model_copy(update={"lift": lift})


def _of_diagram(case: Case) -> str:
    """What of the scenario is wired into the diagram; the rest is in the context."""
    s = case.scenario
    parts = s.model_dump(mode="json", include={"lift", "runway"})
    return json.dumps([parts, s.braking > 0, case.simulation.slow_modes_above])


def _diagram(task: LandingTask, case: Case) -> LandingDiagram:
    """The diagram of a case: built once where airframe, gears and wiring are the same.

    Systems in Python live as long as the process, hence nothing is ever dropped.
    """
    gears = [gear.model_dump_json() for gear in task.gears]
    lift = case.scenario.lift if isinstance(case.scenario.lift, str) else "nodes"
    key = (task.setup.digest, *gears, _of_diagram(case), lift)
    if key not in _DIAGRAMS:
        _DIAGRAMS[key] = build_landing(
            read_landing_setup(task.setup).body,
            task.gears,
            task.monitoring,
            rotation_AB(case.airframe.axes),
            _scenario(case, task),
            case.simulation.slow_modes_above,
        )
    return _DIAGRAMS[key]


def _on_nodes(
    history: LandingHistory, setup: LandingSetup, case: Case
) -> AttachmentLoads:
    """The loads on the transient's grid, on all nodes of the setup."""
    own = history.attachment_loads()
    load = np.zeros((len(own.time), len(setup.node_id), 6))
    load[:, np.searchsorted(setup.node_id, own.node_id)] = own.load
    whole = AttachmentLoads(time=own.time, node_id=setup.node_id, load=load)
    return whole.resampled(case.transient.step, history.time[-1])


def _judged(history: LandingHistory, found: Screened) -> tuple[Status, str]:
    """Whether a result that was computed can be trusted."""
    remarks = []
    if "balance" in history.energy:
        sink = history.figures["sink_energy"]
        missed = float(np.abs(history.energy["balance"]).max()) / sink
        if missed > _ENERGY:
            remarks.append(f"the energy balance misses {missed:.1e} of the sink energy")
    if not all(np.isfinite(a).all() for a in (found.equivalent, found.high, found.low)):
        remarks.append("a stress is not finite")
    return ("suspect" if remarks else "done"), "; ".join(remarks)


def _dataset(
    group: h5py.Group, name: str, values: np.ndarray, units: str, **attributes: object
) -> None:
    # A fifth less on disk for 2 % of a landing's time.
    packed = {"compression": "gzip", "compression_opts": 1, "shuffle": True}
    large = packed if np.size(values) > _LARGE else {}
    data = group.create_dataset(name, data=values, **large)
    data.attrs["units"] = units
    for key, value in attributes.items():
        data.attrs[key] = value


def _write_loads(
    file: h5py.File, loads: AttachmentLoads, z: Float64, setup: LandingSetup
) -> None:
    group = file.create_group("loads")
    _dataset(group, "time", loads.time, "s")
    _dataset(group, "node_id", loads.node_id, "1")
    _dataset(
        group,
        "load",
        loads.load,
        "N, N m",
        columns="fx fy fz mx my mz, increments, deck's basic axes",
    )
    q = z[: setup.basis.modes].astype(np.float32)
    _dataset(group, "amplitudes", q, "mass-normalised modal amplitudes, increments")


def _write_stresses(file: h5py.File, found: Screened, loads: AttachmentLoads) -> None:
    group = file.create_group("stress")
    for name in ("equivalent", "high", "low"):
        _dataset(group, name, getattr(found, name).astype(np.float32), "Pa")
    _dataset(group, "time", loads.time[found.when].astype(np.float32), "s")


def _write_sections(
    file: h5py.File, setup: LandingSetup, z: Float64, loads: AttachmentLoads
) -> None:
    """Extremes of each cut, and the instants on its hulls."""
    group = file.create_group("sections")
    for beam, cuts in setup.cuts.items():
        named = cuts.named(setup.basis.section_loads(beam, z))
        own = group.create_group(group_name(beam))
        own.attrs["name"] = beam
        _dataset(own, "station", cuts.beam.stations, "m")
        _write_extremes(own, named, NAMED, PAIRS, loads)


def _write_monitors(
    file: h5py.File, setup: LandingSetup, z: Float64, loads: AttachmentLoads
) -> None:
    """The same of the monitor points, with hulls of all pairs of their loads."""
    group = file.create_group("monitor_points")
    for station in setup.stations:
        values = (setup.basis.monitors[station.name] @ z).T[:, None]
        own = group.create_group(group_name(station.name))
        own.attrs["name"] = station.name
        pairs = tuple(combinations(station.quantities, 2))
        _write_extremes(own, values, station.quantities, pairs, loads)


def _write_extremes(
    own: h5py.Group,
    named: Float64,
    quantities: Sequence[str],
    pairs: Sequence[tuple[str, str]],
    loads: AttachmentLoads,
) -> None:
    """Writes the extremes of loads (t, n, q) at n places."""
    units = ", ".join("N" if q[0] in "sF" else "N m" for q in quantities)
    low, high = named.argmin(axis=0), named.argmax(axis=0)
    for name, at in (("min", low), ("max", high)):
        value = np.take_along_axis(named, at[None], axis=0)[0]
        _dataset(own, name, value, units, columns=" ".join(quantities))
        _dataset(own, f"time_of_{name}", loads.time[at], "s")
    rows, points = [], []
    for cut in range(named.shape[1]):
        for pair, (a, b) in enumerate(pairs):
            i, j = quantities.index(a), quantities.index(b)
            for at in hull_rows(named[:, cut, [i, j]]):
                rows.append((cut, pair))
                points.append((loads.time[at], *named[at, cut, [i, j]]))
    _dataset(own, "hull_of", np.array(rows, np.int32).reshape(-1, 2), "cut, pair")
    _dataset(
        own,
        "hull",
        np.array(points, np.float64).reshape(-1, 3),
        "s, then N or N m",
        pairs="; ".join("-".join(p) for p in pairs),
    )


def _write_peaks(file: h5py.File, case: Case, history: LandingHistory) -> None:
    gears = gear_peaks(case.name, history)
    names = gears.gear + "." + gears.quantity
    points = {
        f"{point}.{axis}": float(table[axis].abs().max())
        for point, table in history.monitoring.items()
        for axis in table.columns
    }
    for name, labels, values, times, units in (
        ("gears", names.tolist(), gears.peak, gears.time, "SI, by quantity"),
        ("points", list(points), pd.Series(points, dtype=float), None, "m/s²"),
    ):
        group = file.create_group(name)
        group.create_dataset("name", data=labels, dtype=h5py.string_dtype())
        _dataset(group, "peak", np.asarray(values, float), units)
        if times is not None:
            _dataset(group, "time", np.asarray(times, float), "s")
