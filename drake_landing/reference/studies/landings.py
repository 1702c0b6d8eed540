"""The multibody runs of a study: independent of each other, kept as they end."""

import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.cache import Arrays, Cache, content_key, source_key
from drake_landing.case.axes import rotation_AB
from drake_landing.case.schema import Case
from drake_landing.landing.handover import AttachmentLoads, smooth_curve
from drake_landing.landing.history import gear_peaks
from drake_landing.landing.lifetime import used_once
from drake_landing.landing.run import build_landing, fly
from systems.airframe.modal_body import ModalBody

Float64 = npt.NDArray[np.float64]

# Rooms whose program a run depends on.
_ROOMS = ("drake_landing.case", "drake_landing.gears", "drake_landing.landing")


@dataclass(frozen=True, kw_only=True)
class LandingResult:
    """What a study keeps of a multibody run.

    Attributes:
        loads: attachment loads on the grid of the transient.
        acceleration: (t, p, 3) of all monitoring points on that grid, B, m/s².
        gears: table as in `gears.csv`, without the column `run`.
        seconds: processor time of the simulation.
        steps: of the integrator.
    """

    loads: AttachmentLoads
    acceleration: Float64
    gears: pd.DataFrame
    seconds: float
    steps: int


@dataclass(frozen=True, kw_only=True)
class LandingTask:
    """One run, complete."""

    body: ModalBody
    case: Case
    aircraft: Aircraft

    @property
    def duration(self) -> float:
        """Duration of the transient, s."""
        landing = self.case.simulation.duration
        assert landing != "auto"  # runs are compared over the same time
        return self.case.transient_duration(landing)

    @property
    def key(self) -> str:
        """Hash of everything that the run depends on, the program's text included."""
        gears = [gear.model_dump_json() for gear in self.aircraft.gears]
        case = self.case
        return content_key(
            source_key("systems", *_ROOMS),
            dict(vars(self.body)),
            gears,
            dict(self.aircraft.monitoring),
            case.scenario.model_dump_json(),
            case.simulation.model_dump_json(),
            [case.transient.step, self.duration],
            case.airframe.axes.model_dump_json(),
        )


def fly_all(
    tasks: Sequence[LandingTask], cache: Cache, told: Callable[[int, int], None]
) -> list[LandingResult]:
    """Runs what is not in the cache, two at a time where there are two processors.

    Args:
        tasks: the runs.
        cache: where results are looked for and kept, each as soon as it is there.
        told: hears (done, all).
    """
    found: dict[int, Arrays] = {}
    missing = []
    for i, task in enumerate(tasks):
        entry = cache.find("landing", task.key)
        if entry is None:
            missing.append(i)
        else:
            found[i] = entry

    def keep(i: int, arrays: Arrays) -> None:
        found[i] = arrays
        cache.keep("landing", tasks[i].key, arrays)
        told(len(found), len(tasks))

    workers = min(2, len(missing), os.cpu_count() or 1)
    if workers < 2:
        for i in missing:
            keep(i, _fly(tasks[i]))
    else:
        with _processes(workers) as pool:
            futures = {pool.submit(_fly, tasks[i]): i for i in missing}
            for future in as_completed(futures):
                keep(futures[future], future.result())
    return [_result(found[i]) for i in range(len(tasks))]


@contextmanager
def _processes(count: int) -> Iterator[ProcessPoolExecutor]:
    """Processes that end with the work, also where it is interrupted."""
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(count, context, initializer=_leave_interrupts)
    try:
        yield pool
    except BaseException:
        for process in list(pool._processes.values()):
            process.terminate()
        pool.shutdown(wait=False, cancel_futures=True)
        raise
    pool.shutdown()


def _leave_interrupts() -> None:
    """Ctrl-C reaches all processes of a terminal; the one that waits for us acts."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _fly(task: LandingTask) -> Arrays:
    case, aircraft = task.case, task.aircraft
    R_AB, points = rotation_AB(case.airframe.axes), aircraft.monitoring
    slow = case.simulation.slow_modes_above
    landing = build_landing(
        task.body, aircraft.gears, points, R_AB, case.scenario, slow
    )
    with used_once(landing):
        history = fly(landing, case.scenario, case.simulation, points, R_AB)
    loads = history.attachment_loads().resampled(case.transient.step, task.duration)
    inside = np.minimum(loads.time, history.time[-1])
    acceleration = [
        smooth_curve(history.time, table.to_numpy())(inside)
        for table in history.monitoring.values()
    ]
    gears = gear_peaks("", history)
    return {
        "time": loads.time,
        "node_id": loads.node_id,
        "load": loads.load,
        "acceleration": np.stack(acceleration, axis=1),
        "gear": gears["gear"].to_numpy(str),
        "quantity": gears["quantity"].to_numpy(str),
        "peak": gears["peak"].to_numpy(float),
        "peak_time": gears["time"].to_numpy(float),
        "cost": np.array(
            [history.figures["processor_seconds"], history.figures["steps"]]
        ),
    }


def _result(arrays: Arrays) -> LandingResult:
    return LandingResult(
        loads=AttachmentLoads(
            time=arrays["time"], node_id=arrays["node_id"], load=arrays["load"]
        ),
        acceleration=arrays["acceleration"],
        gears=pd.DataFrame(
            {
                "gear": arrays["gear"],
                "quantity": arrays["quantity"],
                "peak": arrays["peak"],
                "time": arrays["peak_time"],
            }
        ),
        seconds=float(arrays["cost"][0]),
        steps=int(arrays["cost"][1]),
    )
