"""The mass case of the reference aircraft: 72,500 kg at 25 % of the mean chord.

Mass items are lumped onto reference nodes so that mass, first moment and inertia of
each item are kept; what the finite elements weigh themselves is taken off first. The
payload is tilted along the fuselage until airframe and landing gears together meet the
stated mass and center of gravity.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from drake_landing.gears.landing_gear import LandingGear
from drake_landing.gears.mass_center import mass_center
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.geometry import Float64
from drake_landing.reference.d150.mass_items import (
    MassItems,
    engine,
    fuselage_items,
    less,
    movable_items,
    payload_items,
    strip_items,
    tilted,
)
from drake_landing.reference.d150.reference_axis import SIDES, NodeGroup, Reference

Structure = Mapping[str, Sequence[tuple[float, Float64]]]


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

    def about_center(self) -> tuple[Float64, Float64]:
        """Offset of the center from the node (3,), and inertia about it (3, 3)."""
        offset = self.moment / self.mass
        return offset, self.inertia - self.mass * _steiner(offset)


Lumps = dict[str, dict[int, NodeMass]]


def node_masses(
    reference: Reference, gears: Sequence[LandingGear], structure: Structure
) -> Lumps:
    """Lumped masses of the airframe, by component and node id.

    Args:
        reference: the reference nodes.
        gears: landing gears, whose mass and center count in the closure.
        structure: part -> mass and center of its finite elements; the lumps and these
            together are the airframe.
    """
    lumps: Lumps = {}
    structure = by_component(structure)
    fuselage = reference["fuselage"]
    items = fuselage_items(fuselage.p[:, 0], gears)
    if structure.get("fuselage"):
        items = less(items, *_arrays(structure["fuselage"]), axis=0, bins=12)
    lumps["fuselage"] = _lump(items, fuselage)
    for side, sign in SIDES:
        wing = _with_tip(reference, f"wing_{side}", f"monitor_wing_tip_{side}")
        movables = [f"{m}_{side}" for m in ("inner_flap", "outer_flap", "aileron")]
        items = _rest(strip_items("wing", sign), wing, movables, reference, structure)
        lumps[wing.name] = _lump(items, wing)
        lumps[f"fuel_{side}"] = _lump(strip_items("fuel", sign), wing)
        tailplane = reference[f"tailplane_{side}"]
        items = _rest(
            strip_items("htp", sign),
            tailplane,
            [f"elevator_{side}"],
            reference,
            structure,
        )
        lumps[tailplane.name] = _lump(items, tailplane)
        lumps[f"engine_{side}"] = _lump(engine(sign), reference[f"engine_{side}"])
        for name in [*movables, f"elevator_{side}"]:
            lumps[name] = _movable(reference[name], structure)
    fin = _with_tip(reference, "fin", "monitor_fin_tip")
    items = _rest(strip_items("vtp", 1), fin, ["rudder"], reference, structure)
    lumps["fin"] = _lump(items, fin)
    lumps["rudder"] = _movable(reference["rudder"], structure)
    payload = _closed_payload(
        payload_items(fuselage.p[:, 0]),
        mass_table(lumps, reference, structure),
        gears,
    )
    lumps["payload"] = _lump(payload, fuselage)
    return lumps


def mass_table(
    lumps: Lumps, reference: Reference, structure: Structure
) -> pd.DataFrame:
    """Mass (kg) and center (m, B) of every component, elements and lumps together."""
    p = positions(reference)
    structure = by_component(structure)
    rows = []
    for component in dict.fromkeys([*lumps, *structure]):
        mass, moment = 0.0, np.zeros(3)
        for node, lump in lumps.get(component, {}).items():
            mass += lump.mass
            moment += lump.moment + lump.mass * p[node]
        for m, center in structure.get(component, ()):
            mass, moment = mass + m, moment + m * center
        rows.append((component, mass, *(moment / mass)))
    return pd.DataFrame(rows, columns=["component", "mass", "x", "y", "z"])


def by_component(structure: Structure) -> Structure:
    """Parts whose names begin with that of a component are put together."""
    result: dict[str, list[tuple[float, Float64]]] = {}
    for part, elements in structure.items():
        component = "fuselage" if part.startswith("fuselage") else part
        result.setdefault(component, []).extend(elements)
    return result


def positions(reference: Reference) -> dict[int, Float64]:
    """Position of every reference node by id."""
    return {i: p for group in reference.values() for i, p in zip(group.ids, group.p)}


def gear_mass_center(gear: LandingGear) -> tuple[float, Float64]:
    """Mass (kg) and center (3,) (m, B) of an extended gear."""
    every = {**gear.moving_parts, **gear.sprung_parts}
    points = [(part.mass, np.array(part.cg)) for part in every.values()]
    wheels = len(gear.wheel_offsets) * gear.wheel.mass
    return mass_center([*points, *((wheels, np.array(axle)) for axle in gear.axles)])


def _steiner(arm: Float64) -> Float64:
    return arm @ arm * np.eye(3) - np.outer(arm, arm)


def _rest(
    items: MassItems,
    group: NodeGroup,
    movables: Sequence[str],
    reference: Reference,
    structure: Structure,
) -> MassItems:
    """A surface's items less its movables and its own finite elements."""
    axis = int(np.argmax(np.ptp(group.p, axis=0)))
    for name in movables:
        own = movable_items(reference[name])
        items = less(items, own.mass, own.p, axis, bins=3)
    elements = structure.get(group.name)
    if elements:
        mass, p = _arrays(elements)
        items = less(items, mass, p, axis, bins=max(2, len(items.mass) // 5))
    return items


def _movable(group: NodeGroup, structure: Structure) -> dict[int, NodeMass]:
    """A movable's lumps: its mass less its finite elements."""
    items = movable_items(group)
    elements = structure.get(group.name)
    if elements:
        mass, p = _arrays(elements)
        items = less(items, mass, p, int(np.argmax(np.ptp(group.p, axis=0))), bins=1)
    return _lump(items, group)


def _arrays(elements: Sequence[tuple[float, Float64]]) -> tuple[Float64, Float64]:
    return np.array([m for m, _ in elements]), np.array([p for _, p in elements])


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


def _closed_payload(
    payload: MassItems, rest: pd.DataFrame, gears: Sequence[LandingGear]
) -> MassItems:
    """The payload tilted so that the whole aircraft meets mass and c.g."""
    target = facts("overall")["mass"]
    mass, moment = rest.mass.sum(), float(rest.mass @ rest.x)
    for gear in gears:
        m, center = gear_mass_center(gear)
        mass, moment = mass + m, moment + m * center[0]
    kilograms = tilted(
        payload.mass,
        payload.p[:, 0],
        target["total"] - mass,
        target["total"] * target["x_cg"] - moment,
    )
    return MassItems(
        component="payload",
        mass=kilograms,
        p=payload.p,
        inertia=payload.inertia * (kilograms / payload.mass)[:, None],
    )
