"""A force distributed over nodes of the airframe, such as the lift of its wing.

The force L(t) points in a fixed direction of the world; node i takes the share w_i of
it. Since all shares are parallel, only their sums act: with c = Σ w_i (r_i + φ_i η)
from the center of gravity and Φ = Σ w_i φ_i,

    force L, moment c × L_B about G, modal forces Φᵀ L_B.

The arm c is that of the deformed airframe, like the arms of all loads there: so the
work on the generalised coordinates is the work on the nodes.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from pydrake.common.value import Value
from pydrake.systems.framework import (
    BasicVector,
    Context,
    LeafSystem,
    NumericParameterIndex,
    ValueProducer,
)

from systems.airframe.modal_body import ModalBody
from systems.tools.checks import require
from systems.tools.rotations import rotation_from_quaternion
from systems.tools.table import Table
from systems.tools.weak_methods import weakly

Float64 = npt.NDArray[np.float64]


def trimmed_shares(
    p_BN: npt.ArrayLike, p_BC: npt.ArrayLike, base: npt.ArrayLike | None = None
) -> Float64:
    """Shares of parallel forces at nodes, upright in B, whose resultant passes a point.

    The given shares are multiplied by exp(a + b x + c y): of all that do it, those
    with the least relative entropy; none is negative.

    Args:
        p_BN: (k, 3) nodes, x aft and y to starboard, m.
        p_BC: (3,) a point of the line of action, m; only x and y matter.
        base: (k,) shares to start from; default equal ones.

    Returns:
        (k,) shares, their sum one.

    Raises:
        ValueError: the nodes do not surround the point.
    """
    point = np.asarray(p_BC, dtype=float)[:2]
    arms = np.asarray(p_BN, dtype=float)[:, :2] - point
    weights = np.ones(len(arms)) if base is None else np.asarray(base, dtype=float)
    if len(weights) != len(arms) or np.any(weights < 0) or not weights.sum() > 0:
        raise ValueError(
            f"distributed load: {len(weights)} shares for {len(arms)} nodes, expected "
            "as many, none negative, and not all zero"
        )
    arms = arms / max(float(np.abs(arms).max()), 1.0)
    tilt = np.zeros(2)
    for _ in range(100):
        shares = _tilted(weights, arms, tilt)
        off = shares @ arms
        if np.abs(off).max() < 1e-14:
            return shares
        spread = (arms - off).T @ ((arms - off) * shares[:, None])
        step = np.linalg.pinv(spread, rcond=1e-12) @ off
        tilt = tilt - step * min(1.0, 5.0 / max(np.abs(step).max(), 1e-300))
    if np.abs(shares @ arms).max() < 1e-9:
        return shares
    raise ValueError(
        "distributed load: the nodes cannot carry a resultant through x "
        f"{point[0]:.4g}, y {point[1]:.4g} m by pushing all in one direction; expected "
        "nodes around it"
    )


def _tilted(weights: Float64, arms: Float64, tilt: Float64) -> Float64:
    exponents = arms @ tilt
    tilted = weights * np.exp(exponents - exponents.max())
    return tilted / tilted.sum()


class DistributedLoad(LeafSystem):
    """Forces at nodes of a `FlexibleAirframe`, for its input `external_load`.

    | port | size | unit | frame |
    |---|---|---|---|
    | in `pose` | 7 | -, m | quaternion of R_WB, p_WG of the airframe |
    | in `modal_amplitudes` | n | | in the amplitudes of the ModalBody |
    | out `load` | 6 + n | N, N m | force W, moment about G in B, modal forces |
    | out `force` | 1 | N | L(t) |
    | out `node_force` | k | N | of each node, in its direction |

    No state. Numeric parameter: factor on the force, 1.

    Args:
        body: the modal body of that airframe.
        nodes: grids that take the force.
        shares: (k,) of each, see `trimmed_shares`.
        force: N, constant or a table over time (s).
        direction: (3,) of the force, W.

    Raises:
        ValueError: a node is not one of the body's, or a length is wrong.
    """

    def __init__(
        self,
        body: ModalBody,
        nodes: Sequence[int],
        shares: npt.ArrayLike,
        force: float | Table,
        direction: npt.ArrayLike = (0.0, 0.0, 1.0),
    ) -> None:
        super().__init__()
        if not isinstance(force, Table):
            require("distributed load", "force", force, "N")
        w = np.asarray(shares, dtype=float)
        if w.shape != (len(nodes),):
            raise ValueError(
                f"distributed load: {w.size} shares for {len(nodes)} nodes, expected "
                "one each"
            )
        rows = body.rows(nodes)
        self.nodes, self.shares = tuple(nodes), tuple(w.tolist())
        self._force = force
        self._direction = np.asarray(direction, dtype=float)
        self._arm = w @ (body.p_BN[rows] - body.p_BG)
        self._shape = np.tensordot(w, body.translation[rows], axes=1)
        self._factor = NumericParameterIndex(
            self.DeclareNumericParameter(BasicVector([1.0]))
        )
        declare: Any = self.DeclareVectorInputPort
        self._pose = declare("pose", 7)
        self._amplitudes = declare("modal_amplitudes", body.n)
        force_tickets = {self.numeric_parameter_ticket(self._factor)}
        if isinstance(force, Table):
            force_tickets.add(self.time_ticket())
        self._now: Any = self.DeclareCacheEntry(
            "force",
            ValueProducer(
                allocate=lambda: Value(object()), calc=weakly(self._calc_now)
            ),
            force_tickets,
        )
        now = {self._now.ticket()}
        state = {self._pose.ticket(), self._amplitudes.ticket()}
        vector = self.DeclareVectorOutputPort
        vector("load", 6 + body.n, weakly(self._calc_load), now | state)
        vector("force", 1, weakly(self._calc_force), now)
        vector("node_force", len(w), weakly(self._calc_node_force), now)

    def set_factor(self, context: Context, factor: float) -> None:
        """Sets the factor on the force in a context of this system."""
        context.get_mutable_numeric_parameter(self._factor).SetAtIndex(0, factor)

    def _calc_now(self, context, value) -> None:
        force = self._force
        if isinstance(force, Table):
            force = force.value(context.get_time())
        factor = context.get_numeric_parameter(self._factor).GetAtIndex(0)
        value.set_value(factor * force)

    def _calc_force(self, context, output) -> None:
        output.SetAtIndex(0, self._now.Eval(context))

    def _calc_node_force(self, context, output) -> None:
        output.SetFromVector(self._now.Eval(context) * np.array(self.shares))

    def _calc_load(self, context, output) -> None:
        R_WB = rotation_from_quaternion(self._pose.Eval(context)[:4])
        in_W = self._now.Eval(context) * self._direction
        in_B = in_W @ R_WB
        arm = self._arm + self._shape @ self._amplitudes.Eval(context)
        x, y, z = arm.tolist()
        a, b, c = in_B.tolist()
        moment = [y * c - z * b, z * a - x * c, x * b - y * a]
        output.SetFromVector(np.concatenate([in_W, moment, in_B @ self._shape]))
