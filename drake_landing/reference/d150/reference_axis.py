"""The 261 reference nodes that every level of the aircraft shares, with the same ids.

They are the interface of the reduced model: fuselage frames, wing and tail ribs on
their structural axes, nodes of the movables, engines, gear attachments and monitoring
points. A node's id says where it belongs: 10001-10087 fuselage frames C01-C87 (there is
no C22), 11001 starboard and 12001 port wing from the center outward, 13001, 14001
tailplane, 15001 fin, 16001 engines, 17001 gear attachments, 18001 movables, 19001
monitoring points.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np

from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.geometry import (
    MIRROR,
    Float64,
    LiftingSurface,
    fuselage_section,
    surface,
    wing,
)

SIDES = (("right", 1), ("left", -1))
ATTACHMENTS = {"nose": 17001, "main_left": 17002, "main_right": 17003}
MONITORS = {
    "nose_tip": 19001,
    "cg": 19002,
    "tail_tip": 19003,
    "wing_tip_right": 19004,
    "wing_tip_left": 19005,
    "fin_tip": 19006,
}
_MOVABLE_BASE = {
    "inner_flap": 18001,
    "outer_flap": 18201,
    "aileron": 18401,
    "elevator": 18601,
    "rudder": 18801,
}


@dataclass(frozen=True, kw_only=True)
class NodeGroup:
    """Nodes of one part in order along it.

    Attributes:
        name: e.g. `wing_right`.
        ids: (n,) grid ids.
        p: (n, 3) positions in B, m.
    """

    name: str
    ids: tuple[int, ...]
    p: Float64

    def id_of(self, index: int) -> int:
        """Id of the node at a position in the order."""
        return self.ids[index]

    def nearest(self, p: Float64) -> int:
        """Id of the node nearest to a point."""
        return self.ids[int(np.argmin(np.linalg.norm(self.p - p, axis=1)))]


Reference = dict[str, NodeGroup]


@cache
def reference_nodes() -> Reference:
    """All 261 nodes by group."""
    groups = [
        _fuselage(),
        *_surface_groups("wing", _wing_rib_nodes(), 11001),
        *_surface_groups("tailplane", _tailplane_rib_nodes(), 13001),
        NodeGroup(name="fin", ids=_ids(15001, 11), p=_fin_rib_nodes()),
        *_engines(),
        *_attachments(),
        *_movables(),
        *_monitors(),
    ]
    return {group.name: group for group in groups}


def frame_id(frame: str) -> int:
    """Id of the reference node of a fuselage frame, e.g. C36."""
    return 10000 + int(frame[1:])


def _ids(first: int, count: int) -> tuple[int, ...]:
    return tuple(range(first, first + count))


def _fuselage() -> NodeGroup:
    frames = table("fuselage_frames")
    p = np.zeros((len(frames), 3))
    p[:, 0] = frames.x
    return NodeGroup(name="fuselage", ids=tuple(map(frame_id, frames.frame)), p=p)


def _surface_groups(name: str, p: Float64, first: int) -> Iterator[NodeGroup]:
    for side, sign in SIDES:
        base = first if sign > 0 else first + 1000
        q = p if sign > 0 else p * MIRROR
        yield NodeGroup(name=f"{name}_{side}", ids=_ids(base, len(p)), p=q)


def _wing_rib_nodes() -> Float64:
    """Where the rib planes cut the reference axis, in plan."""
    ribs = table("wing_ribs")
    half = wing()
    y_front = half.station(ribs.eta_front_spar)
    x_front = half.point(y_front, half.spar_fraction(0, y_front))[:, 0]
    slope = 1 / np.tan(np.deg2rad(ribs.angle_deg.to_numpy()))  # inboard per metre aft
    y = y_front.copy()
    for _ in range(20):  # contraction: the axis is swept by 20 degrees, ribs as well
        y = y_front - slope * (half.on_axis(y)[:, 0] - x_front)
    return half.on_axis(y)


def _tailplane_rib_nodes() -> Float64:
    data, half = facts("tails")["tailplane"], surface("tailplane")
    eta = np.array(data["ribs"])[:, 0].copy()
    eta[0] = data["first_station"]
    return half.on_axis(half.station(eta))


def _fin_rib_nodes() -> Float64:
    fin = surface("fin")
    return fin.on_axis(fin.station(np.array(facts("tails")["fin"]["ribs"])[:, 0]))


def _engines() -> Iterator[NodeGroup]:
    cg = np.array(facts("engines")["cg"])
    for k, (side, sign) in enumerate(SIDES):
        p = cg if sign > 0 else cg * MIRROR
        yield NodeGroup(name=f"engine_{side}", ids=(16001 + k,), p=p[None])


def _attachments() -> Iterator[NodeGroup]:
    data = facts("gears")["attachment"]
    main = np.array(data["main"])
    positions = {
        "nose": np.array(data["nose"]),
        "main_left": main * MIRROR,
        "main_right": main,
    }
    for gear, p in positions.items():
        yield NodeGroup(name=f"gear_{gear}", ids=(ATTACHMENTS[gear],), p=p[None])


def _movables() -> Iterator[NodeGroup]:
    for name, first in _MOVABLE_BASE.items():
        p = movable_axis(name)
        if name == "rudder":
            yield NodeGroup(name=name, ids=_ids(first, len(p)), p=p)
            continue
        for side, sign in SIDES:
            base = first if sign > 0 else first + 100
            q = p if sign > 0 else p * MIRROR
            yield NodeGroup(name=f"{name}_{side}", ids=_ids(base, len(p)), p=q)


def movable_shares(name: str) -> tuple[Float64, tuple[int, ...]]:
    """Nodes of a movable as shares of its span, and which of them are supported.

    Evenly spaced, off the ends, where neighbours meet; the node nearest to a track or
    hinge stands on it.
    """
    data = facts("movables")[name]
    shares = np.linspace(0.02, 0.98, data["nodes"])
    supported = []
    for support in data["supports"]:
        k = int(np.argmin(np.abs(shares - support)))
        shares[k] = support
        supported.append(k)
    return shares, tuple(supported)


def movable_axis(name: str) -> Float64:
    """Nodes of a movable (starboard), on its own axis, (n, 3)."""
    everything = facts("movables")
    data = everything[name]
    parent: LiftingSurface = surface(data["parent"])
    (eta_a, xi_a), (eta_b, xi_b) = data["inboard"], data["outboard"]
    shares, _ = movable_shares(name)
    leading = xi_a + shares * (xi_b - xi_a)
    fraction = leading + everything["axis_fraction"] * (1.0 - leading)
    return parent.point(parent.station(eta_a + shares * (eta_b - eta_a)), fraction)


def _monitors() -> Iterator[NodeGroup]:
    length = facts("overall")["length"]
    half, fin = wing(), surface("fin")
    tip = half.on_axis(half.station(1.0))[0]
    positions = {
        "nose_tip": np.array([0.0, 0.0, fuselage_section(0.0)[0, 1]]),
        "cg": np.array([facts("overall")["mass"]["x_cg"], 0.0, -0.75]),
        "tail_tip": np.array([length, 0.0, fuselage_section(length)[0, 1]]),
        "wing_tip_right": tip,
        "wing_tip_left": tip * MIRROR,
        "fin_tip": fin.on_axis(fin.station(1.0))[0],
    }
    for name, node in MONITORS.items():
        yield NodeGroup(name=f"monitor_{name}", ids=(node,), p=positions[name][None])
