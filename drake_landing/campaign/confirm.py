"""Direct transients of chosen landings, in blocks, with the stress of every element."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import h5py
import numpy as np

from drake_landing.campaign.setup import (
    SetupFile,
    TransientSetup,
    read_landing_setup,
    read_transient_setup,
)
from drake_landing.campaign.task import case_file
from drake_landing.parts.stress_extremes import Steady, StressExtremes
from drake_landing.transient.response import SCHEMES
from fem.arrays import Float64
from fem.files.atomic_hdf5 import written_hdf5
from fem.response.direct import direct_transient
from fem.response.system import sampled_load

# Of a step: work that a block does once, over that for each landing. Of the full D150
# the solve takes 103 ms for one column and 15.6 ms for each of 32, and all the rest
# some 20 ms a column: 90 ms and 33 ms for each (`benchmarks.transient_observers`).
SHARED_WORK = 2.7


@dataclass(frozen=True, kw_only=True)
class BlockTask:
    """Landings of one airframe, to be integrated together.

    Attributes:
        numbers: of the cases.
        ends: s, where each ends; what comes later is not in its extremes.
        landing, transient: setups of the airframe.
        folder: of the case files.
        scheme: a key of `SCHEMES`.
        keys: of the results, case by case.
    """

    numbers: tuple[int, ...]
    ends: tuple[float, ...]
    landing: SetupFile
    transient: SetupFile
    folder: Path
    scheme: str
    keys: tuple[str, ...]

    @property
    def each(self) -> "list[BlockTask]":
        """The landings of the block, each a block of its own."""
        return [self.part([k]) for k in range(len(self.numbers))]

    def part(self, chosen: Sequence[int]) -> "BlockTask":
        """Some of its landings, by their positions."""
        return replace(
            self,
            numbers=tuple(self.numbers[k] for k in chosen),
            ends=tuple(self.ends[k] for k in chosen),
            keys=tuple(self.keys[k] for k in chosen),
        )


def block_tasks(all_of_them: BlockTask, most: int) -> list[BlockTask]:
    """Landings cut into blocks of those that end at about the same time."""
    ends = all_of_them.ends
    order = sorted(range(len(ends)), key=ends.__getitem__)
    blocks = blocks_by_end([ends[k] for k in order], most)
    return [all_of_them.part(order[block]) for block in blocks]


def blocks_by_end(ends: Sequence[float], most: int) -> list[slice]:
    """Ends in ascending order cut into blocks that are integrated with least work.

    All landings of a block go on until the last of them ends, at the cost of a step of
    `SHARED_WORK` landings' worth of work beside that of each: reading the factor. Few
    large blocks share it, many small ones end when their landings do (dynamic
    programming).

    Args:
        ends: ascending, s.
        most: landings in a block.

    Example:
        >>> blocks_by_end([1.0, 1.0, 5.0], most=32)
        [slice(0, 2, None), slice(2, 3, None)]
    """
    least, start = [0.0], [0]
    for j in range(1, len(ends) + 1):
        work = {
            i: least[i] + ends[j - 1] * (SHARED_WORK + j - i)
            for i in range(max(0, j - most), j)
        }
        start.append(min(work, key=work.__getitem__))
        least.append(work[start[-1]])
    blocks, j = [], len(ends)
    while j:
        blocks.append(slice(start[j], j))
        j = start[j]
    return blocks[::-1]


def confirmed_file(folder: Path, number: int) -> Path:
    """Path of the direct transient's results of a case."""
    return folder / f"{number:06d}.confirmed.h5"


def run_block(task: BlockTask) -> tuple[int, ...]:
    """Integrates a block; every case leaves a file of its own."""
    setup = read_landing_setup(task.landing)
    full = read_transient_setup(task.transient)
    time, loads = _loads(task)
    steady = None if setup.steady is None else Steady(stress=setup.steady)
    watch = StressExtremes(
        setup.rows, full.maps, full.extension, steady, until=task.ends
    )
    _integrate(full, time, loads, watch, task.scheme)
    for case, (number, end, key) in enumerate(zip(task.numbers, task.ends, task.keys)):
        state = watch.state.take(slice(None), slice(case, case + 1))
        with written_hdf5(confirmed_file(task.folder, number)) as file:
            file.attrs.update(case=number, key=key, until=end)
            found = {
                "equivalent": (state.equivalent, "Pa"),
                "high": (state.high, "Pa"),
                "low": (state.low, "Pa"),
                "time": (time[state.when], "s"),
            }
            for name, (values, units) in found.items():
                data = file.create_dataset(f"stress/{name}", data=values[:, 0])
                data.attrs["units"] = units
    return task.numbers


def _loads(task: BlockTask) -> tuple[Float64, list[Float64]]:
    """The grid up to the last end, and the loads (t, 6 k) of each case on it."""
    loads, grid = [], None
    for number in task.numbers:
        with h5py.File(case_file(task.folder, number)) as file:
            time = np.asarray(file["loads/time"])
            load = np.asarray(file["loads/load"])
        loads.append(load.reshape(len(time), -1))
        grid = time if grid is None or len(time) > len(grid) else grid
    assert grid is not None
    count = min(int(np.searchsorted(grid, max(task.ends))) + 1, len(grid))
    grid = grid[: max(count, 2)]
    return grid, [_held(load, len(grid)) for load in loads]


def _held(load: Float64, count: int) -> Float64:
    """The load at that many instants; its last value is held."""
    if len(load) >= count:
        return load[:count]
    return np.concatenate([load, np.repeat(load[-1:], count - len(load), axis=0)])


def _integrate(
    full: TransientSetup,
    time: Float64,
    loads: Sequence[Float64],
    watch: StressExtremes,
    scheme: str,
) -> None:
    step = float(time[-1] - time[0]) / (len(time) - 1)
    # The integrator looks ahead of the last step.
    beyond = np.append(time, time[-1] + step * np.array([1.0, 2.0]))
    factors = np.stack(
        [np.concatenate([p, np.repeat(p[-1:], 2, axis=0)]).T for p in loads]
    )
    direct_transient(
        full.stiffness,
        full.mass,
        full.damping,
        steps=[(len(time) - 1, step)],
        load=sampled_load(full.pattern, beyond, factors),
        observers=[watch],
        scheme=SCHEMES[scheme](),
        threads=1,
        mass_product=full.mass_product,
    )
