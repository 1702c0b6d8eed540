"""Time steps of a transient: groups of equal steps and the times that are put out.

As on a TSTEP card: each group has a count of steps, a step size and an output stride.
Every stride-th step of a group is put out, the first of each group and the very last.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fem.arrays import Float64

# The window of displacements that lies in memory at a time.
_WINDOW_BYTES = 128e6
_SHORTEST, _LONGEST = 4, 32


@dataclass(frozen=True)
class StepGroup:
    """Equal time steps.

    Attributes:
        count: number of steps.
        step: size, s.
        stride: every stride-th is put out.
        start: time before the first step, s.
        last: whether the transient ends with this group.
        first_output: index of the group's first output among all.
    """

    count: int
    step: float
    stride: int
    start: float
    last: bool
    first_output: int

    @property
    def outputs(self) -> npt.NDArray[np.intp]:
        """Steps 0 ... count of this group that are put out."""
        steps = np.arange(0, self.count, self.stride)
        return np.append(steps, self.count) if self.last else steps

    def time(self, step: npt.ArrayLike) -> Float64:
        """Times (s) of steps of this group."""
        return self.start + self.step * np.asarray(step, dtype=float)


def step_groups(
    steps: Iterable[tuple[int, float] | tuple[int, float, int]],
) -> list[StepGroup]:
    """Groups from (count, step, stride) rows; the stride is 1 where it is left out.

    Raises:
        ValueError: no rows, or a row without positive numbers.
    """
    rows = [(int(row[0]), float(row[1]), int((*row, 1)[2])) for row in steps]
    if not rows:
        raise ValueError("no time steps are given")
    groups: list[StepGroup] = []
    start, output = 0.0, 0
    for i, (count, step, stride) in enumerate(rows):
        if count < 1 or not 0.0 < step < np.inf or stride < 1:
            raise ValueError(
                f"time steps {i + 1}: count {count}, step {step}, stride {stride}; "
                "expected positive numbers"
            )
        group = StepGroup(count, step, stride, start, i == len(rows) - 1, output)
        groups.append(group)
        start += count * step
        output += len(group.outputs)
    return groups


def output_times(groups: list[StepGroup]) -> Float64:
    """All output times, s."""
    return np.concatenate([group.time(group.outputs) for group in groups])


def window_length(cases: int, size: int) -> int:
    """Steps that are kept in memory before observers are called."""
    bytes_per_step = 8.0 * max(cases * size, 1)
    return int(np.clip(_WINDOW_BYTES / bytes_per_step, _SHORTEST, _LONGEST))
