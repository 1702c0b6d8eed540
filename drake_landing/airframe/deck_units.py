"""Units of a user's deck: noticed where they cannot be right, undone in what he gets.

Inside everything is SI; a deck in other units is converted when it is read
(`fem.deck.units`), and the loads handed over to it are written in its own. What tells
the units of a deck are its size, its materials and its weight factor, and where the
gears lie; the gears alone do not, since they may have been written for wrong units.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.landing.handover import AttachmentLoads
from fem.deck.deck import Deck
from fem.deck.units import SYSTEMS, Units, units_of
from fem.errors import InputError
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]

# Young's modulus of aluminium in each system; titanium, steel and fibres are near.
METALS: Mapping[str, float] = {"SI": 7e10, "mm-t-N": 7e4, "in-lbf": 1e7}
_NEAR = (0.3, 6.0)  # times that of aluminium

_INCH_GRAVITY = 386.1  # in/s²
_SPAN = (0.5, 300.0)  # m, of anything that lands
_REACH = 10.0  # m, farther from its attachment node no axle lies


def material_moduli(deck: Deck) -> Float64:
    """Positive moduli of MAT1, MAT2 and MAT8, in the units that the deck has."""
    columns = {"MAT1": "e", "MAT2": "g11", "MAT8": "e1"}
    found = [deck.cards[name][c].to_numpy(float) for name, c in columns.items()]
    moduli = np.concatenate(found)
    return moduli[moduli > 0.0]


def units_of_materials(deck: Deck, read_in: str | None = None) -> str | None:
    """By PARAM WTMASS of 1/386.1 (lbf), else the one system in which most materials
    have the modulus of a metal or of fibres; None: nothing tells.

    Args:
        deck: as it is, or in SI.
        read_in: the system from which it was taken to SI; None: as it is.
    """
    if abs((deck.number("WTMASS") or 1.0) * _INCH_GRAVITY - 1.0) < 0.02:
        return "in-lbf"
    moduli = material_moduli(deck)
    if read_in is not None:
        moduli = moduli / _stress(units_of(read_in))
    low, high = _NEAR
    hits = {
        name: int(np.sum((moduli >= low * metal) & (moduli <= high * metal)))
        for name, metal in METALS.items()
    }
    most = max(hits.values())
    fits = [name for name, hit in hits.items() if hit == most]
    return fits[0] if most and len(fits) == 1 else None


def check_units(structure: Structure, aircraft: Aircraft) -> tuple[str, ...]:
    """The deck has the size of an aircraft, and its gears are where it is.

    Args:
        structure: in SI, as the units of the case say.
        aircraft: whose attachment nodes exist.

    Returns:
        What is odd: materials of another system.

    Raises:
        InputError: other units fit the deck and those of the case do not; or the gears
            lie where they would with other units than the deck has.
    """
    stated = aircraft.units
    span, sized = span_and_sized(structure, stated)
    told = units_of_materials(structure.deck, stated)
    reach = {n: _away(structure, aircraft, f) for n, f in _factors(stated).items()}
    near = [name for name, away in reach.items() if away < _REACH]
    if stated in sized and stated in near:
        return _materials_remark(structure.deck, stated, told)
    away = f"gears lie up to {reach[stated]:,.4g} m from their attachment nodes"
    if stated in sized and told == stated:
        if written := _written_for(reach, span, stated):
            raise InputError(
                f"gears: {away}, yet size and materials of the deck fit "
                f"airframe.units {stated}; expected positions in m in the frame of the "
                f"deck. They fit a deck in {written}: where they were written for "
                f"that, `drake-landing new --units {stated}` writes them anew"
            )
        return ()  # places of gears are judged one by one
    others = [n for n in sized if n != stated and told in (None, n)]
    fitting = others if stated not in sized else [n for n in others if n in near]
    if not fitting:
        return ()
    materials = f", its materials say {told}" if told in fitting else ""
    raise InputError(
        f"airframe.units: found {stated}, in which the deck spans {span:,.4g} m and "
        f"{away}{materials}; expected {' or '.join(fitting)}. Gears are given in SI in "
        "any case"
        + (
            ""
            if set(near) & set(fitting)
            else f"; these do not fit: `drake-landing new --units {fitting[0]}` "
            "writes others"
        )
    )


def _factors(read_in: str) -> dict[str, float]:
    """How much larger the deck were in each system."""
    length = units_of(read_in).length
    return {name: units.length / length for name, units in SYSTEMS.items()}


def _written_for(reach: Mapping[str, float], span: float, stated: str) -> str | None:
    """The other system in which gears lie within a quarter of the deck; None: none.

    Args:
        reach: system -> the farthest axle from its node, m.
        span: of the deck in the stated system, m.
        stated: system.
    """
    share = {n: reach[n] / (f * span) for n, f in _factors(stated).items()}
    best = min(share, key=lambda name: share[name])
    return best if best != stated and share[best] < 0.25 else None


def span_and_sized(structure: Structure, read_in: str) -> tuple[float, list[str]]:
    """Largest extent of the grids, m, and the systems in which it is an aircraft's.

    Args:
        structure: in SI.
        read_in: the system from which it was taken to SI.
    """
    span = float(np.ptp(structure.points.xyz, axis=0).max())
    low, high = (end * units_of(read_in).length / span for end in _SPAN)
    return span, [n for n, units in SYSTEMS.items() if low < units.length < high]


def _away(structure: Structure, aircraft: Aircraft, factor: float) -> float:
    """The farthest axle from its attachment node, m, were the deck `factor` larger."""
    points = structure.points
    nodes = points.xyz[points.rows([g.attachment_node for g in aircraft.gears])]
    axles = np.array([gear.axles[0] for gear in aircraft.gears])
    return float(np.linalg.norm(factor * nodes - axles, axis=1).max())


def _materials_remark(deck: Deck, stated: str, told: str | None) -> tuple[str, ...]:
    if told in (None, stated):
        return ()
    e = np.median(material_moduli(deck))
    return (
        f"airframe.units: found {stated}, in which the materials have a Young's "
        f"modulus of {e:.3g} Pa (aluminium: 7e10); they look like {told}, and gears "
        f"written by `new` lie where its units put them: if the deck is in {told}, "
        f"`drake-landing new --units {told}` writes the case anew",
    )


def _stress(units: Units) -> float:
    """Pa of the system's unit of stress."""
    return units.force / units.length**2


def in_deck_units(loads: AttachmentLoads, units: Units) -> AttachmentLoads:
    """Loads in N and N m, in the units of a deck."""
    six = np.repeat([units.force, units.moment], 3)
    return replace(loads, load=loads.load / six)
