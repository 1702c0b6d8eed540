"""The mass case of the reference aircraft: 72,500 kg at 25 % of the mean chord.

Mass items (empty fuselage, payload, wing, fuel, tails, engines, movables) are lumped
onto reference nodes so that mass, first moment and inertia of each item are kept. The
payload is tilted along the fuselage until airframe and landing gears together meet the
stated mass and centre of gravity.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from drake_landing.aircraft.facts import facts, table
from drake_landing.aircraft.geometry import (
    MIRROR,
    Float64,
    fuselage_section,
    surface,
)
from drake_landing.aircraft.reference_axis import (
    SIDES,
    NodeGroup,
    Reference,
    movable_shares,
)
from drake_landing.gear import LandingGear


@dataclass(frozen=True, kw_only=True)
class MassItems:
    """n rigid items of one component.

    Attributes:
        component: name in the mass table.
        mass: (n,) kg.
        p: (n, 3) centres in B, m.
        inertia: (n, 3) own moments of inertia along the axes of B, kg m².
    """

    component: str
    mass: Float64
    p: Float64
    inertia: Float64


@dataclass
class NodeMass:
    """Mass lumped onto one node: mass, first moment and inertia about the node."""

    mass: float = 0.0
    moment: Float64 = field(default_factory=lambda: np.zeros(3))
    inertia: Float64 = field(default_factory=lambda: np.zeros((3, 3)))

    def add(self, mass: float, arm: Float64, own: Float64) -> None:
        """Adds a body: arm from the node (3,), own inertia along B (3,)."""
        self.mass += mass
        self.moment = self.moment + mass * arm
        self.inertia = self.inertia + np.diag(own) + mass * _steiner(arm)

    def about_centre(self) -> tuple[Float64, Float64]:
        """Offset of the centre from the node (3,), and inertia about it (3, 3)."""
        offset = self.moment / self.mass
        return offset, self.inertia - self.mass * _steiner(offset)


Lumps = dict[str, dict[int, NodeMass]]


def _steiner(arm: Float64) -> Float64:
    return arm @ arm * np.eye(3) - np.outer(arm, arm)


def node_masses(reference: Reference, gears: Sequence[LandingGear]) -> Lumps:
    """Lumped masses of the airframe, by component and node id.

    Args:
        reference: the reference nodes.
        gears: landing gears, whose mass and centre count in the closure.
    """
    lumps: Lumps = {}
    fuselage = reference["fuselage"]
    lumps["fuselage"] = _lump(fuselage_items(fuselage.p[:, 0], gears), fuselage)
    for side, sign in SIDES:
        wing = _with_tip(reference, f"wing_{side}", f"monitor_wing_tip_{side}")
        movables = [f"{m}_{side}" for m in ("inner_flap", "outer_flap", "aileron")]
        items = _without_movables(
            strip_items("wing", sign), "wing", movables, reference
        )
        lumps[f"wing_{side}"] = _lump(items, wing)
        lumps[f"fuel_{side}"] = _lump(strip_items("fuel", sign), wing)
        elevator = f"elevator_{side}"
        items = _without_movables(
            strip_items("htp", sign), "tailplane", [elevator], reference
        )
        lumps[f"tailplane_{side}"] = _lump(items, reference[f"tailplane_{side}"])
        lumps[f"engine_{side}"] = _lump(engine(sign), reference[f"engine_{side}"])
        for name in [*movables, elevator]:
            lumps[name] = _lump(_movable_items(reference[name]), reference[name])
    fin = _with_tip(reference, "fin", "monitor_fin_tip")
    items = _without_movables(strip_items("vtp", 1), "fin", ["rudder"], reference)
    lumps["fin"] = _lump(items, fin)
    lumps["rudder"] = _lump(_movable_items(reference["rudder"]), reference["rudder"])
    payload = _closed_payload(payload_items(fuselage.p[:, 0]), lumps, reference, gears)
    lumps["payload"] = _lump(payload, fuselage)
    return lumps


def mass_table(lumps: Lumps, reference: Reference) -> pd.DataFrame:
    """Mass (kg) and centre (m, B) of every component."""
    p = positions(reference)
    rows = []
    for component, nodes in lumps.items():
        mass = sum(n.mass for n in nodes.values())
        moment = np.zeros(3)
        for i, lump in nodes.items():
            moment += lump.moment + lump.mass * p[i]
        rows.append((component, mass, *(moment / mass)))
    return pd.DataFrame(rows, columns=["component", "mass", "x", "y", "z"])


def positions(reference: Reference) -> dict[int, Float64]:
    """Position of every reference node by id."""
    return {i: p for group in reference.values() for i, p in zip(group.ids, group.p)}


def fuselage_items(x: Float64, gears: Sequence[LandingGear]) -> MassItems:
    """Empty fuselage without the nose gear, one item per frame at stations x."""
    data = facts("masses")["fuselage"]
    stations, density = np.array(data["line_density"]).T
    nose = [g for g in gears if g.name == "nose"]
    total = data["total"] - sum(g.mass for g in nose)
    moment = data["total"] * data["x_cg"] - sum(g.mass * g.axle[0] for g in nose)
    mass, centre = _slices(stations, density, x)
    mass = _tilted(mass, centre, total, moment)
    half, bottom, top = fuselage_section(centre).T
    p = np.stack([centre, 0 * centre, (bottom + top) / 2 + data["z_offset"]], axis=1)
    radius = (half + (top - bottom) / 2) / 2
    return MassItems(
        component="fuselage",
        mass=mass,
        p=p,
        inertia=_ring(
            mass, x, data["radius_roll"] * radius, data["radius_transverse"] * radius
        ),
    )


def payload_items(x: Float64) -> MassItems:
    """Payload before the closure, one item per frame at stations x."""
    data = facts("masses")["payload"]
    start, end, kg = np.array(data["line_density"], float).T
    stations = np.stack([start, end - 1e-9], axis=1).ravel()
    mass, centre = _slices(stations, np.repeat(kg / (end - start), 2), x)
    keep = mass > 0
    p = np.stack([centre, 0 * centre, np.full(len(x), data["z"])], axis=1)
    radii = [np.full(len(x), data[k]) for k in ("radius_roll", "radius_transverse")]
    inertia = _ring(mass, x, radii[0], radii[1])
    return MassItems(
        component="payload", mass=mass[keep], p=p[keep], inertia=inertia[keep]
    )


def strip_items(component: str, sign: int) -> MassItems:
    """Items of wing, fuel, htp (one side) or vtp."""
    rows = table("mass_items")
    rows = rows[rows.component == component]
    name = {"wing": "wing", "fuel": "wing", "htp": "tailplane", "vtp": "fin"}[component]
    half = surface(name)
    p = rows[["x", "y", "z"]].to_numpy()
    along = p[:, half.span_axis]
    radii = facts("masses")[
        "fuel_radii" if component == "fuel" else "lifting_surface_radii"
    ]
    mass = rows.mass.to_numpy()
    about_span = mass * (radii["chord"] * half.chord_at(along)) ** 2
    about_chord = mass * (radii["width"] * np.gradient(along)) ** 2
    inertia = np.stack([about_chord, about_span, about_span + about_chord], axis=1)
    if name == "fin":
        inertia = inertia[:, [0, 2, 1]]
    return MassItems(
        component=component,
        mass=mass,
        p=p if sign > 0 else p * MIRROR,
        inertia=inertia,
    )


def engine(sign: int) -> MassItems:
    """One installed engine with its pylon."""
    data = facts("engines")
    p = np.array(data["cg"]) * (1.0 if sign > 0 else MIRROR)
    return MassItems(
        component="engine",
        mass=np.array([data["mass"]]),
        p=p[None],
        inertia=np.array([data["inertia"]]),
    )


def gear_mass_centre(gear: LandingGear) -> tuple[float, Float64]:
    """Mass (kg) and centre (3,) (m, B) of an extended gear."""
    wheels = len(gear.wheel_offsets) * gear.wheel.mass
    parts = [
        (gear.fitting.mass, gear.fitting.cg),
        (gear.piston.mass, gear.piston.cg),
        (wheels, gear.axle),
    ]
    moment = np.sum([m * np.array(p) for m, p in parts], axis=0)
    return gear.mass, moment / gear.mass


def _slices(stations: Float64, density: Float64, x: Float64) -> tuple[Float64, Float64]:
    """Mass and centre of a line density in the slice of each frame."""
    edges = np.concatenate([[stations[0]], (x[1:] + x[:-1]) / 2, [stations[-1]]])
    edges[0], edges[-1] = min(edges[0], x[0]), max(edges[-1], x[-1])
    fine = np.unique(
        np.concatenate([edges, stations, np.linspace(*edges[[0, -1]], 4000)])
    )
    mid, width = (fine[1:] + fine[:-1]) / 2, np.diff(fine)
    q = np.interp(mid, stations, density, left=0.0, right=0.0) * width
    owner = np.clip(np.searchsorted(edges, mid) - 1, 0, len(x) - 1)
    mass: Float64 = np.bincount(owner, q, len(x)).astype(float)
    moment: Float64 = np.bincount(owner, q * mid, len(x)).astype(float)
    return mass, np.divide(moment, mass, out=x.copy(), where=mass > 0)


def _tilted(mass: Float64, x: Float64, total: float, moment: float) -> Float64:
    """mass (a + b (x - mean)) with the given total and first moment."""
    arm = x - mass @ x / mass.sum()
    a = total / mass.sum()
    b = (moment - a * mass @ x) / (mass @ (arm * x))
    return mass * (a + b * arm)


def _ring(mass: Float64, x: Float64, roll: Float64, transverse: Float64) -> Float64:
    """Inertia of slices: radii of gyration and the slice's own length."""
    length = np.gradient(x)
    across = mass * (transverse**2 + length**2 / 12)
    return np.stack([mass * roll**2, across, across], axis=1)


def _with_tip(reference: Reference, name: str, tip: str) -> NodeGroup:
    """A chain of rib nodes with its tip node."""
    a, b = reference[name], reference[tip]
    return NodeGroup(name=name, ids=a.ids + b.ids, p=np.concatenate([a.p, b.p]))


def _lump(items: MassItems, group: NodeGroup) -> dict[int, NodeMass]:
    """Each item is shared by the two nodes beside it by the lever rule.

    Along the longest extent of the group; items beyond its ends go to the end node.
    """
    axis = int(np.argmax(np.ptp(group.p, axis=0)))
    order = np.argsort(group.p[:, axis])
    knots = group.p[order, axis]
    nodes: dict[int, NodeMass] = {}
    for mass, p, own in zip(items.mass, items.p, items.inertia):
        share = np.array([np.interp(p[axis], knots, row) for row in np.eye(len(knots))])
        for k in np.flatnonzero(share):
            at = order[k]
            lump = nodes.setdefault(group.ids[at], NodeMass())
            lump.add(mass * share[k], p - group.p[at], own * share[k])
    return nodes


def _without_movables(
    items: MassItems, name: str, group_names: list[str], reference: Reference
) -> MassItems:
    """The items of a surface less the mass and first moment of its movables.

    Each movable is taken from the items beside it, in proportion to their mass; their
    centres move so that the first moment about the span axis is kept.
    """
    axis = surface(name).span_axis
    mass, p = items.mass.copy(), items.p.copy()
    for group_name in group_names:
        group = reference[group_name]
        m = facts("movables")[movable_of(group_name)]["mass"]
        ends = np.sort(group.p[[0, -1], axis])
        beside = (p[:, axis] > ends[0] - 0.3) & (p[:, axis] < ends[1] + 0.3)
        taken = np.where(beside, mass, 0.0)
        taken *= m / taken.sum()
        order = np.argsort(group.p[:, axis])
        for k in (0, 2):
            at = np.interp(p[:, axis], group.p[order, axis], group.p[order, k])
            if k != axis:
                p[:, k] = (mass * p[:, k] - taken * at) / (mass - taken)
        mass = mass - taken
    return MassItems(
        component=items.component,
        mass=mass,
        p=p,
        inertia=items.inertia * (mass / items.mass)[:, None],
    )


def movable_of(group_name: str) -> str:
    """The name in `movables.yaml` of a group such as `inner_flap_left`."""
    return group_name.removesuffix("_left").removesuffix("_right")


def _movable_items(group: NodeGroup) -> MassItems:
    """One item per node of a movable, by the span it stands for."""
    name = movable_of(group.name)
    shares, _ = movable_shares(name)
    edges = np.concatenate([[0.0], (shares[1:] + shares[:-1]) / 2, [1.0]])
    mass = np.diff(edges) * facts("movables")[name]["mass"]
    inertia = _movable_inertia(name, group, mass)
    return MassItems(component=name, mass=mass, p=group.p, inertia=inertia)


def _movable_inertia(name: str, group: NodeGroup, mass: Float64) -> Float64:
    data = facts("movables")
    parent = surface(data[name]["parent"])
    fraction = 1 - (data[name]["inboard"][1] + data[name]["outboard"][1]) / 2
    chord = fraction * parent.chord_at(np.abs(group.p[:, parent.span_axis]))
    width = np.linalg.norm(np.gradient(group.p, axis=0), axis=1)
    about_span, about_chord = mass * (0.27 * chord) ** 2, mass * width**2 / 12
    inertia = np.stack([about_chord, about_span, about_chord + about_span], axis=1)
    return inertia[:, [0, 2, 1]] if name == "rudder" else inertia


def _closed_payload(
    payload: MassItems,
    lumps: Lumps,
    reference: Reference,
    gears: Sequence[LandingGear],
) -> MassItems:
    """The payload tilted so that the whole aircraft meets mass and c.g."""
    target = facts("overall")["mass"]
    rest = mass_table(lumps, reference)
    mass, moment = rest.mass.sum(), float(rest.mass @ rest.x)
    for gear in gears:
        m, centre = gear_mass_centre(gear)
        mass, moment = mass + m, moment + m * centre[0]
    tilted = _tilted(
        payload.mass,
        payload.p[:, 0],
        target["total"] - mass,
        target["total"] * target["x_cg"] - moment,
    )
    scale = (tilted / payload.mass)[:, None]
    return MassItems(
        component="payload",
        mass=tilted,
        p=payload.p,
        inertia=payload.inertia * scale,
    )
