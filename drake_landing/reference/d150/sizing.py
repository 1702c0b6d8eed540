"""Sizes of the thin-walled structure along the span, from the facts."""

from dataclasses import replace

import numpy as np

from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.geometry import surface
from drake_landing.reference.d150.shell_elements import BoxSizing, Law


def box_sizing(name: str) -> BoxSizing:
    """Sizes of the box of `wing`, `tailplane` or `fin`."""
    return _wing() if name == "wing" else _tail(name)


def movable_sizing(name: str) -> BoxSizing:
    """Sizes of a movable: uniform sheets, stiffened skins."""
    data = facts("shells")["movables"]
    sheets = data[name]
    return BoxSizing(
        skin=lambda _: sheets["skin"],
        web=lambda _: sheets["web"],
        rib=lambda _: sheets["rib"],
        bending=data["bending"],
        web_bending=data["bending"],
    )


def smeared(sizing: BoxSizing, *, caps: bool) -> BoxSizing:
    """Copy of the box with its stringers smeared over the skins.

    Args:
        sizing: with stringers.
        caps: smear the spar caps as well, which are slender in the tails.
    """
    stringer, cap = sizing.stringer, sizing.cap
    if not caps or stringer is None or cap is None:
        return replace(sizing, stringer_bars=False)
    return replace(
        sizing,
        stringer_bars=False,
        stringer=lambda span: stringer(span) + 2 * cap(span),
        cap=None,
    )


def with_root_fittings(sizing: BoxSizing) -> BoxSizing:
    """The wing box with heavier spar caps in the bay outside of the fuselage."""
    data, ribs = facts("shells")["wing"]["root_cap"], table("wing_ribs")
    eta = ribs.set_index("rib").eta_front_spar
    first, last = surface("wing").station(eta[[data["first"], data["last"]]])
    cap = sizing.cap or _none

    def heavier(at: float) -> float:
        return max(cap(at), data["area"]) if first <= at <= last else cap(at)

    return replace(sizing, cap=heavier)


def _none(_: float) -> float:
    return 0.0


def _wing() -> BoxSizing:
    data, rows = facts("shells")["wing"], table("wing_stiffness")
    factor = data["thickness_factor"]
    y, width = rows.y.to_numpy(), rows.box_width.to_numpy()
    skin = factor * rows.skin_thickness.to_numpy()
    heavy = data["heavy_ribs"]
    ribs = list(table("wing_ribs").rib)
    heavy_numbers = {ribs.index(rib) for rib in heavy["ribs"]}
    return BoxSizing(
        skin=_law(y, skin),
        web=_law(y, factor * rows.spar_thickness.to_numpy()),
        rib=lambda n: (
            heavy["thickness"] if n in heavy_numbers else data["rib_thickness"]
        ),
        stringer=_law(y, data["stringer_share"] * skin * width),
        cap=_law(*np.array(data["cap_area"]).T),
        stringer_height=data["stringer_height"],
        web_bending=facts("shells")["web_bending"],
    )


def _tail(name: str) -> BoxSizing:
    data, shape = facts("shells")[name], surface(name)
    span, skin = np.array(data["skin"]).T
    front, rear = (shape.spar_fraction(k, span) for k in (0, 1))
    width = (rear - front) * shape.chord_at(span)
    heavy = 3 if name == "tailplane" else 2  # center and pivot ribs, root ribs
    return BoxSizing(
        skin=_law(span, skin),
        web=_law(*np.array(data["web"]).T),
        rib=lambda n: (
            data["heavy_rib_thickness"] if n < heavy else data["rib_thickness"]
        ),
        stringer=_law(span, data["stringer_share"] * skin * width),
        cap=_law(*np.array(data["cap_area"]).T),
        stringer_height=data["stringer_height"],
        web_bending=facts("shells")["web_bending"],
    )


def _law(span: np.ndarray, values: np.ndarray) -> Law:
    return lambda s: float(np.interp(s, span, values))
