"""Mass items of the reference aircraft: rigid bodies by component, before lumping.

Fuselage and payload come from line densities, one item per frame; wing, fuel and tails
from the decoded items of a half; movables from their estimated mass.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from drake_landing.gears.landing_gear import LandingGear
from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.geometry import (
    MIRROR,
    Float64,
    fuselage_section,
    surface,
)
from drake_landing.reference.d150.reference_axis import NodeGroup, movable_shares


@dataclass(frozen=True, kw_only=True)
class MassItems:
    """n rigid items of one component.

    Attributes:
        component: name in the mass table.
        mass: (n,) kg.
        p: (n, 3) centers in B, m.
        inertia: (n, 3) own moments of inertia along the axes of B, kg m².
    """

    component: str
    mass: Float64
    p: Float64
    inertia: Float64


def fuselage_items(x: Float64, gears: Sequence[LandingGear]) -> MassItems:
    """Empty fuselage without the nose gear, one item per frame at stations x."""
    data = facts("masses")["fuselage"]
    stations, density = np.array(data["line_density"]).T
    nose = [g for g in gears if g.name == "nose"]
    total = data["total"] - sum(g.mass for g in nose)
    moment = data["total"] * data["x_cg"] - sum(g.mass * g.fitting.cg[0] for g in nose)
    mass, center = _slices(stations, density, x)
    mass = tilted(mass, center, total, moment)
    half, bottom, top = fuselage_section(center).T
    p = np.stack([center, 0 * center, (bottom + top) / 2 + data["z_offset"]], axis=1)
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
    mass, center = _slices(stations, np.repeat(kg / (end - start), 2), x)
    keep = mass > 0
    p = np.stack([center, 0 * center, np.full(len(x), data["z"])], axis=1)
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


def less(
    items: MassItems, mass: Float64, p: Float64, axis: int, bins: int
) -> MassItems:
    """The items less other bodies that are modelled by themselves.

    Items and bodies are cut into bins along an axis. In each bin every item gives in
    proportion to its mass, and its center moves so that the first moment is kept.

    Args:
        items: of one component.
        mass: (k,) of the bodies, kg.
        p: (k, 3) their centers, m.
        axis: coordinate along the component.
        bins: their number.

    Raises:
        ValueError: the bodies outweigh 95 % of the items of a bin.
    """
    span = np.abs(items.p[:, axis])  # outward, so that both sides bin alike
    order = np.argsort(span)
    along = span[order]
    groups = np.array_split(order, bins)
    starts = np.cumsum([len(g) for g in groups])[:-1]
    edges = (along[starts - 1] + along[starts]) / 2
    owner = np.searchsorted(edges, np.abs(p[:, axis]))
    new_mass, new_p = items.mass.copy(), items.p.copy()
    slope = np.polyfit(items.p[:, axis], items.p, 1)[0]
    for k, group in enumerate(groups):
        q, centers = mass[owner == k], p[owner == k]
        if not q.sum():
            continue
        share = q.sum() / items.mass[group].sum()
        if share > 0.95:
            raise ValueError(
                f"{items.component}: the structure weighs {q.sum():.0f} kg between "
                f"{along[0]:.1f} and {along[-1]:.1f} m (bin {k + 1} of {bins}), more "
                f"than 95 % of its mass there, {items.mass[group].sum():.0f} kg"
            )
        middle = q @ centers / q.sum()
        taken = share * items.mass[group]
        for other in {0, 1, 2} - {axis}:
            at = middle[other] + slope[other] * (items.p[group, axis] - middle[axis])
            new_p[group, other] -= (
                taken * (at - items.p[group, other]) / (items.mass[group] - taken)
            )
        new_mass[group] -= taken
    return MassItems(
        component=items.component,
        mass=new_mass,
        p=new_p,
        inertia=items.inertia * (new_mass / items.mass)[:, None],
    )


def movable_of(group_name: str) -> str:
    """The name in `movables.yaml` of a group such as `inner_flap_left`."""
    return group_name.removesuffix("_left").removesuffix("_right")


def movable_items(group: NodeGroup) -> MassItems:
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


def _slices(stations: Float64, density: Float64, x: Float64) -> tuple[Float64, Float64]:
    """Mass and center of a line density in the slice of each frame."""
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


def tilted(mass: Float64, x: Float64, total: float, moment: float) -> Float64:
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
