"""Mesh stations of lifting surfaces and movables: ribs, and divisions between them.

A station is a line across the structure from its front to its rear edge (spar to spar,
or hinge line to trailing edge), given by the span coordinate and chord fraction of both
ends. Ribs that are turned against the flight direction are turned lines.
"""

from dataclasses import dataclass

import numpy as np

from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.geometry import (
    Float64,
    Int64,
    LiftingSurface,
    polyline,
    surface,
)


@dataclass(frozen=True, kw_only=True)
class Stations:
    """n stations from root to tip.

    Attributes:
        front: (n, 2) span coordinate (m) and chord fraction of the front end.
        rear: (n, 2) of the rear end.
        rib: (n,) number of the rib that stands there, from 0; -1 where none does.
    """

    front: Float64
    rear: Float64
    rib: Int64

    @property
    def span(self) -> Float64:
        """(n,) span coordinate of the middle of each station, m."""
        return (self.front[:, 0] + self.rear[:, 0]) / 2


def plan_x(shape: LiftingSurface, ends: Float64) -> Float64:
    """x of points (span, chord fraction) before the incidence turn, m."""
    leading = polyline(shape.leading, ends[:, 0], shape.span_axis)[:, 0]
    return leading + ends[:, 1] * shape.chord_at(ends[:, 0])


def wing_stations(size: float) -> Stations:
    """Starboard wing box from the center plane to the tip.

    Args:
        size: length of the elements along the span, m.
    """
    ribs, shape = table("wing_ribs"), surface("wing")
    y_front = np.append(shape.station(ribs.eta_front_spar), shape.station(1.0))
    angle = np.append(np.deg2rad(ribs.angle_deg), np.pi / 2)
    y_rear = _rear_ends(shape, y_front, angle)
    lines = np.stack([y_front, y_rear], axis=1)
    return _box(shape, np.concatenate([[[0.0, 0.0]], lines]), 1, size)


def tail_stations(name: str, size: float) -> Stations:
    """Box of the starboard tailplane (from the center plane) or of the fin."""
    data, shape = facts("tails")[name], surface(name)
    eta, turn = np.array(data["ribs"]).T.copy()
    if name == "tailplane":
        eta[0] = data["first_station"]
        # The pivot ribs stand beside each other: both straight, lest they cross.
        turn[:3] = 0.0
    eta, turn = np.append(eta, 1.0), np.append(turn, 0.0)
    middle = shape.station(eta)
    half = (
        plan_x(shape, np.stack([middle, shape.spar_fraction(1, middle)], axis=1))
        - plan_x(shape, np.stack([middle, shape.spar_fraction(0, middle)], axis=1))
    ) / 2
    lean = half * np.tan(np.deg2rad(turn))
    lines = np.stack([middle - lean, middle + lean], axis=1)
    first = 0
    if name == "tailplane":
        lines, first = np.concatenate([[[0.0, 0.0]], lines]), 1
    return _box(shape, lines, first, size)


def movable_stations(name: str, size: float) -> Stations:
    """A movable from its inboard to its outboard end; its ribs are evenly spaced."""
    data = facts("movables")[name]
    shape = surface(data["parent"])
    (eta_a, xi_a), (eta_b, xi_b) = data["inboard"], data["outboard"]
    gap = facts("movables")["end_gap"] / shape.span
    eta_a, eta_b = eta_a + gap, eta_b - gap
    length = (eta_b - eta_a) * shape.span
    each = max(1, round(length / (data["ribs"] - 1) / size))
    count = (data["ribs"] - 1) * each + 1
    share = np.linspace(0.0, 1.0, count)
    s = shape.station(eta_a + share * (eta_b - eta_a))
    rib = np.where(np.arange(count) % each == 0, np.arange(count) // each, -1)
    return Stations(
        front=np.stack([s, xi_a + share * (xi_b - xi_a)], axis=1),
        rear=np.stack([s, np.ones(count)], axis=1),
        rib=rib,
    )


def _rear_ends(shape: LiftingSurface, y_front: Float64, angle: Float64) -> Float64:
    """Where ribs from the front spar meet the rear spar; angle from the span axis."""
    start = plan_x(shape, np.stack([y_front, shape.spar_fraction(0, y_front)], axis=1))
    y = y_front.copy()
    for _ in range(30):  # contraction, as spars are swept by less than 45 degrees
        x = plan_x(shape, np.stack([y, shape.spar_fraction(1, y)], axis=1))
        y = y_front - (x - start) / np.tan(angle)
    return y


def _box(shape: LiftingSurface, lines: Float64, first: int, size: float) -> Stations:
    """Divides the bays between lines (m, 2); ribs stand on lines from `first` on."""
    spans, rib = [lines[:1]], [0 if first == 0 else -1]
    for k in range(len(lines) - 1):
        length = np.mean(lines[k + 1] - lines[k])
        each = max(1, round(length / size))
        share = np.arange(1, each + 1)[:, None] / each
        spans.append(lines[k] + share * (lines[k + 1] - lines[k]))
        rib += [-1] * (each - 1) + [k + 1 - first]
    ends = np.concatenate(spans)
    return Stations(
        front=np.stack([ends[:, 0], shape.spar_fraction(0, ends[:, 0])], axis=1),
        rear=np.stack([ends[:, 1], shape.spar_fraction(1, ends[:, 1])], axis=1),
        rib=np.array(rib),
    )
