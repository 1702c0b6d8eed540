"""Ribs of a CPACS wing as lines from the front to the rear spar.

A set of ribs stands on a curve of the wing, its reference: a spar, the leading or the
trailing edge. Its first and last rib are places on it, shares of its length; between
them stand `numberOfRibs`, or one every `spacing`. A rib's direction is that of another
reference turned about the wing's normal by z degrees, 90 without a word.

The generator wants for each rib where it meets the front spar, and its angle from the
span axis, 90 degrees for a rib along the flow.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from drake_landing.reference.d150.cpacs_xml import number

Float64 = npt.NDArray[np.float64]
_SAME = 1e-4  # of the span: one rib, not two
_END = 1e-3  # of the span
_MOST = 1000  # ribs of a set
_STEEPEST = 20.0  # deg between a rib and the span axis


@dataclass(frozen=True, kw_only=True)
class Plan:
    """A half wing from above.

    Attributes:
        y, x, chord: (n,) leading edge and chord of its sections, m.
        spars: uID -> (k, 2) share of the span and chord fraction.
        front, rear: uIDs of the spars of the box.
    """

    y: Float64
    x: Float64
    chord: Float64
    spars: dict[str, Float64]
    front: str
    rear: str

    def curve(self, name: str) -> Float64 | None:
        """(k, 2) y and chord fraction of a spar or edge; None for what is neither."""
        if name in self.spars:
            table = self.spars[name]
        else:
            edges = {"leadingedge": 0.0, "trailingedge": 1.0}
            fraction = edges.get(name.lower())
            if fraction is None:
                return None
            table = np.array([[0.0, fraction], [1.0, fraction]])
        root, tip = self.y[0], self.y[-1]
        return np.column_stack([root + table[:, 0] * (tip - root), table[:, 1]])

    def place(self, curve: Float64, y: Float64) -> Float64:
        """x of a curve at y, m."""
        fraction = np.interp(y, curve[:, 0], curve[:, 1])
        leading = np.interp(y, self.y, self.x)
        return leading + fraction * np.interp(y, self.y, self.chord)


def read_ribs(structure: Any, plan: Plan) -> Float64 | None:
    """(n, 2) share of the span at the front spar and angle (deg) of each rib.

    Args:
        structure: element of a component segment.
        plan: of its wing.

    Raises:
        ValueError: a number is missing, with its line.
    """
    found = []
    for positioning in structure.iterfind("ribsDefinitions/*/ribsPositioning"):
        ends = [_plain(positioning.findtext(name)) for name in ("ribStart", "ribEnd")]
        if ends[0] in (plan.rear, "trailingEdge") or ends[1] == plan.front:
            continue  # in front of or behind the box
        found.append(_set(positioning, plan))
    if not found:
        return None
    ribs = np.concatenate(found)
    ribs = ribs[np.argsort(ribs[:, 0])]
    ribs = ribs[np.append(True, np.diff(ribs[:, 0]) > _SAME)]
    # The box has stations of its own in the center plane and at the tip.
    return ribs[(ribs[:, 0] > _END) & (ribs[:, 0] < 1.0 - _END)]


def _set(positioning: Any, plan: Plan) -> Float64:
    name = _plain(positioning.findtext("ribReference")) or "leadingEdge"
    curve = plan.curve(name)
    if curve is None:
        raise ValueError(
            f"line {positioning.sourceline}: ribReference '{name}', expected a spar "
            f"({', '.join(plan.spars)}), leadingEdge or trailingEdge"
        )
    first = _eta(positioning, "etaStart", "startCurvePoint")
    last = _eta(positioning, "etaEnd", "endCurvePoint")
    start, end = curve[0, 0], curve[-1, 0]
    ends = start + np.array([first, last]) * (end - start)
    y = _spaced(positioning, plan, curve, ends)
    angle = _angle(positioning, plan, y)
    return _at_front_spar(plan, curve, y, angle)


def _spaced(positioning: Any, plan: Plan, curve: Float64, ends: Float64) -> Float64:
    """y of the ribs on their reference: so many, or one every so many metres."""
    if positioning.find("numberOfRibs") is not None:
        count = round(number(positioning, "numberOfRibs"))
        if not 1 <= count <= _MOST:
            raise ValueError(
                f"line {positioning.sourceline}: numberOfRibs {count}, expected 1 or "
                f"more, {_MOST} at most"
            )
        return np.linspace(ends[0], ends[1] if count > 1 else ends[0], count)
    spacing = number(positioning, "spacing")
    length = abs(ends[1] - ends[0])
    if not spacing > length / _MOST or not spacing > 0.0:
        raise ValueError(
            f"line {positioning.sourceline}: spacing {spacing:g}, expected metres "
            f"above {length / _MOST:.3g}, or numberOfRibs"
        )
    dense = np.linspace(*ends, 201)
    step = np.hypot(np.diff(dense), np.diff(plan.place(curve, dense)))
    along = np.append(0.0, np.cumsum(step))
    places = np.arange(0.0, along[-1] * (1.0 + 1e-9) + 1e-9, spacing)
    return np.interp(places, along, dense)


def _angle(positioning: Any, plan: Plan, y: Float64) -> Float64:
    """Angle of ribs at y (m) from the span axis, deg within 0 ... 180."""
    rotation = positioning.find("ribRotation")
    turn, name = 90.0, "leadingEdge"
    if rotation is not None:
        name = _plain(rotation.findtext("ribRotationReference")) or name
        turn = number(rotation, "z")
    direction = {"globalY": 0.0, "globalX": -90.0}
    if name in direction:
        base = np.full(len(y), direction[name])
    else:
        curve = plan.curve(name)
        if curve is None:
            raise ValueError(
                f"line {positioning.sourceline}: ribRotationReference '{name}', "
                f"expected globalX, globalY, a spar ({', '.join(plan.spars)}), "
                "leadingEdge or trailingEdge"
            )
        small = 1e-3
        rise = plan.place(curve, y + small) - plan.place(curve, y - small)
        base = -np.degrees(np.arctan2(rise, 2.0 * small))
    angle = np.mod(base + turn, 180.0)
    if np.any((angle < _STEEPEST) | (angle > 180.0 - _STEEPEST)):
        raise ValueError(
            f"line {positioning.sourceline}: ribs at {angle.min():.1f} degrees from "
            f"the span axis, expected {_STEEPEST:g} to {180.0 - _STEEPEST:g}"
        )
    return angle


def _at_front_spar(plan: Plan, curve: Float64, y: Float64, angle: Float64) -> Float64:
    """Follows ribs from their reference to the front spar."""
    front = plan.curve(plan.front)
    assert front is not None
    inboard = 1.0 / np.tan(np.radians(angle))  # per metre aft
    x, at = plan.place(curve, y), y.copy()
    for _ in range(40):  # contraction: spars are swept less than ribs are turned
        at = y - inboard * (plan.place(front, at) - x)
    eta = (at - plan.y[0]) / (plan.y[-1] - plan.y[0])
    return np.column_stack([eta, angle])


def _eta(positioning: Any, plain: str, point: str) -> float:
    """A place on the reference, as CPACS 2 and as CPACS 3 write it."""
    node = positioning.find(point)
    return number(positioning, plain) if node is None else number(node, "eta")


def _plain(text: str | None) -> str:
    return (text or "").strip()
