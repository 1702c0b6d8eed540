"""What follows linearly from modal amplitudes: stresses, element forces, strains."""

from typing import Any

import numpy as np
import numpy.typing as npt
from pydrake.systems.framework import DiagramBuilder, LeafSystem

from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.tools.weak_methods import weakly


class ModalRecovery(LeafSystem):
    """Recovered quantities R η of a reduced body, for monitoring during a landing.

    | port | size | unit | meaning |
    |---|---|---|---|
    | in `modal_amplitudes` | n | | in the amplitudes of the ModalBody |
    | out `recovered` | c | that of R | R η |

    Column i of R is the quantity in the mode i of the ModalBody (for instance an
    element's stresses in that mode shape). What the truncated modes would contribute
    is missing, foremost near the attachment nodes; the direct transient has it.

    Args:
        matrix: (c, n) R.

    Raises:
        ValueError: the matrix is not two-dimensional, or a value is not finite.
    """

    def __init__(self, matrix: npt.ArrayLike) -> None:
        super().__init__()
        R = np.ascontiguousarray(matrix, dtype=float)
        if R.ndim != 2:
            raise ValueError(f"modal recovery: matrix has shape {R.shape}, not (c, n)")
        if not np.isfinite(R).all():
            raise ValueError("modal recovery: a value of the matrix is not finite")
        self._matrix = R
        amplitudes: Any = self.DeclareVectorInputPort("modal_amplitudes", R.shape[1])
        self._amplitudes = amplitudes
        self.DeclareVectorOutputPort(
            "recovered",
            R.shape[0],
            weakly(self._calc_recovered),
            prerequisites_of_calc={amplitudes.ticket()},
        )

    def _calc_recovered(self, context, output) -> None:
        output.SetFromVector(self._matrix @ self._amplitudes.Eval(context))


def AddModalRecovery(
    builder: DiagramBuilder,
    airframe: FlexibleAirframe,
    matrix: npt.ArrayLike,
    name: str = "modal_recovery",
) -> ModalRecovery:
    """Adds a recovery and connects it to the airframe's amplitudes.

    Args:
        builder: that already holds the airframe.
        airframe: with n modes.
        matrix: (c, n), see ModalRecovery.
        name: of the system in the diagram.

    Raises:
        ValueError: the matrix does not have a column for each mode.
    """
    recovery = ModalRecovery(matrix)
    found = recovery.GetInputPort("modal_amplitudes").size()
    if found != airframe.n:
        raise ValueError(
            f"{name}: the matrix has {found} columns, expected {airframe.n}, one for "
            "each mode of the airframe"
        )
    builder.AddNamedSystem(name, recovery)
    builder.Connect(
        airframe.GetOutputPort("modal_amplitudes"),
        recovery.GetInputPort("modal_amplitudes"),
    )
    return recovery
