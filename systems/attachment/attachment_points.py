"""Where and in which directions the airframe holds a landing gear's fitting.

A rigid fitting held rigidly at two nodes would tie them together, six conditions where
a pinned stay or a bearing makes one to three. So a fitting is held at its origin,
rigidly or in its translations, and at further nodes along chosen directions d, fixed in
the fitting: the node N slides freely across them, as in a guide. With r = p_WN - p_WF,

    gap        g = d·(R_WF p_FN - r)
    rate      g' = d·(v_F + ω × r - v_N)
              g" = d·(a_F + α × r + ω × (ω × r) - a_N) - 2 d·(ω × u),

u the sliding velocity v_F + ω × r - v_N. The load λ acts along d at N, on the fitting
and, opposite, on the airframe: neither momentum nor moment of momentum nor energy is
lost at any sliding. Three translations at one node, two at a second, one at a third
make a statically determinate hold; more than six directions are for the flexibility of
the airframe to share out, or for elastic stays.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt
from pydrake.multibody.tree import RigidBody

from systems.tools.checks import require

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class AttachmentPoint:
    """One node of the airframe and how it holds a fitting.

    Attributes:
        fitting: free body of the plant.
        hold: rigid or ball: all or the translations of the fitting at its origin; or
            (r, 3) directions in the fitting's frame, r from 1 to 3.
        p_FN: (3,) place of the undeformed node in the fitting's frame, m; zero for
            rigid and ball.
        stiffness: N/m along each direction; None is rigid.
        damping: N s/m along each direction, beside a stiffness.

    Raises:
        ValueError: a value is out of range, or directions are not independent.
    """

    fitting: RigidBody
    hold: Literal["rigid", "ball"] | npt.ArrayLike = "rigid"
    p_FN: npt.ArrayLike = (0.0, 0.0, 0.0)
    stiffness: float | None = None
    damping: float = 0.0

    def __post_init__(self) -> None:
        owner = f"attachment of {self.fitting.name()}"
        if self.stiffness is not None:
            require(owner, "stiffness", self.stiffness, "N/m", above=0.0)
        require(owner, "damping", self.damping, "N s/m", at_least=0.0)
        if self.along:
            self._require_directions(owner)
        elif self.stiffness is not None or np.any(np.asarray(self.p_FN) != 0.0):
            raise ValueError(
                f"{owner}: a {self.hold} hold is at the fitting's origin and rigid; "
                "p_FN and stiffness belong to directions"
            )

    @property
    def along(self) -> bool:
        """Held along directions."""
        return not isinstance(self.hold, str)

    @property
    def directions(self) -> Float64:
        """(r, 3) unit vectors, or none."""
        if isinstance(self.hold, str):
            return np.zeros((0, 3))
        d = np.asarray(self.hold, dtype=float)
        return d / np.sqrt((d * d).sum(axis=1, keepdims=True))

    def _require_directions(self, owner: str) -> None:
        d = np.asarray(self.hold, dtype=float)
        if d.ndim != 2 or d.shape[1] != 3 or not 1 <= len(d) <= 3:
            raise ValueError(f"{owner}: directions have shape {d.shape}, not (1-3, 3)")
        if not np.all((d * d).sum(axis=1) > 0.0):
            raise ValueError(f"{owner}: a direction is (0, 0, 0)")
        if np.linalg.svd(self.directions)[1][-1] < 1e-3:
            raise ValueError(
                f"{owner}: directions {d.tolist()} are not independent of each other"
            )


@dataclass(frozen=True, slots=True)
class Rows:
    """Conditions of all points together; g' = on_fitting V_F - on_node V_N.

    Attributes:
        on_fitting: (m, 6 f) of the fittings' [angular; linear] velocities, W.
        on_node: (m, 6 k) of the nodes' velocities, W.
        gap, rate: (m,) g and g'.
        bias: (m,) g" less what the accelerations contribute.
    """

    on_fitting: Float64
    on_node: Float64
    gap: Float64
    rate: Float64
    bias: Float64


class HoldPattern:
    """The rows of the points, laid out once.

    Attributes:
        fittings: the distinct ones, in order of appearance.
        fitting_of: (k,) fitting of each point.
        plain: every fitting is held rigidly at one point of its own: rows are the
            identity.
        stiffness: (m,) N/m; zero for rigid rows.
        damping: (m,) N s/m.
        rotational: (m,) rows that hold a rotation.

    Args:
        points: of all gears.

    Raises:
        ValueError: a fitting is held in fewer than six independent directions.
    """

    def __init__(self, points: Sequence[AttachmentPoint]) -> None:
        self._points = tuple(points)
        names = {point.fitting.index(): point.fitting for point in points}
        order = list(names)
        self.fittings = tuple(names.values())
        self.fitting_of = np.array([order.index(p.fitting.index()) for p in points])
        self.plain = len(order) == len(points) and all(
            isinstance(p.hold, str) and p.hold == "rigid" for p in points
        )
        # Rows of rigid and ball holds pick from the gap of their point: constant.
        picks, self._guides, row = [], [], 0
        for i, point in enumerate(points):
            if point.along:
                count = len(point.directions)
                self._guides.append((i, slice(row, row + count)))
            else:
                chosen = range(6) if point.hold == "rigid" else range(3, 6)
                count = len(chosen)
                picks += [(row + j, i, c) for j, c in enumerate(chosen)]
            row += count
        self.size = row
        self._picks = np.array(picks, dtype=np.int64).reshape(-1, 3).T
        self._lay_out()
        for index in range(len(self.fittings)):
            self._require_held(index)

    @property
    def origins(self) -> dict[int, RigidBody]:
        """The point that holds the origin of each fitting -> the fitting.

        Raises:
            ValueError: a fitting has none.
        """
        found = {}
        for f, fitting in enumerate(self.fittings):
            own = [
                i
                for i in np.flatnonzero(self.fitting_of == f).tolist()
                if not self._points[i].along
            ]
            if not own:
                raise ValueError(
                    f"attachment of {fitting.name()}: held along directions alone, "
                    "expected a rigid or ball hold at its origin"
                )
            found[own[0]] = fitting
        return found

    def _lay_out(self) -> None:
        self.stiffness, self.damping = np.zeros(self.size), np.zeros(self.size)
        for i, rows in self._guides:
            self.stiffness[rows] = self._points[i].stiffness or 0.0
            self.damping[rows] = self._points[i].damping
        row, point, column = self._picks
        self.rotational = np.zeros(self.size, dtype=bool)
        self.rotational[row] = column < 3
        self._on_fitting = np.zeros((self.size, 6 * len(self.fittings)))
        self._on_node = np.zeros((self.size, 6 * len(self._points)))
        self._on_fitting[row, 6 * self.fitting_of[point] + column] = 1.0
        self._on_node[row, 6 * point + column] = 1.0

    def _require_held(self, fitting: int) -> None:
        rows = self._on_fitting[:, 6 * fitting : 6 * fitting + 6].copy()
        for i, at in self._guides:
            if self.fitting_of[i] == fitting:
                d = self._points[i].directions
                rows[at] = np.hstack([np.cross(self._points[i].p_FN, d), d])
        if np.linalg.matrix_rank(rows, tol=1e-3) < 6:
            raise ValueError(
                f"attachment of {self.fittings[fitting].name()}: its points leave it "
                "free to move; expected six independent directions"
            )

    def rows(
        self,
        gap: Float64,
        R_WF: Float64,
        p_WF: Float64,
        V_WF: Float64,
        p_WN: Float64,
        V_WN: Float64,
    ) -> Rows:
        """The conditions in a state.

        Args:
            gap: (k, 2, 6) gap and its rate at the points, W.
            R_WF, p_WF, V_WF: (k, 3, 3), (k, 3), (k, 6) of each point's fitting, W.
            p_WN, V_WN: (k, 3), (k, 6) of the nodes, W.
        """
        row, point, column = self._picks
        on_fitting, on_node = self._on_fitting.copy(), self._on_node.copy()
        out = np.zeros((3, self.size))
        out[:2, row] = gap[point, :, column].T
        for i, at in self._guides:
            d = self._points[i].directions @ R_WF[i].T
            r = p_WN[i] - p_WF[i]
            w, v = V_WF[i, :3], V_WF[i, 3:]
            slide = v + np.cross(w, r) - V_WN[i, 3:]
            first = 6 * self.fitting_of[i]
            on_fitting[at, first : first + 3] = np.cross(r, d)
            on_fitting[at, first + 3 : first + 6] = d
            on_node[at, 6 * i + 3 : 6 * i + 6] = d
            out[0, at] = d @ (R_WF[i] @ np.asarray(self._points[i].p_FN) - r)
            out[1, at] = d @ slide
            out[2, at] = d @ np.cross(w, np.cross(w, r) - 2.0 * slide)
        return Rows(on_fitting, on_node, *out)
