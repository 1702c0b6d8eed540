"""Where one looks in a case: what it names, a built-in model's places, any deck's."""

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from drake_landing.case import parts as settings
from drake_landing.parts.cuts import ANY, EVERYWHERE, Beam
from drake_landing.parts.places import Panel, Places
from fem.errors import InputError
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]

_CUTS = 12  # of a deck that nothing is known about
_MARGIN = 0.08  # of its size, beyond the first and last of them


def places_of(
    structure: Structure,
    parts: settings.Parts,
    R_AB: Float64,
    monitoring: Mapping[str, int],
    known: Places | None,
) -> Places:
    """The places of a case; those that it does not name are found.

    Args:
        structure: the full model.
        parts: of the case.
        R_AB: (3, 3) from the deck's axes.
        monitoring: points that stand for equipment where nothing else is known.
        known: of a parametric aircraft; None for a deck of the user's own.

    Raises:
        InputError: grids that do not exist.
    """
    beams = tuple(_beam(beam, R_AB) for beam in parts.beams)
    panels = tuple(
        Panel(name=p.name, grid=p.grid, beside=p.beside) for p in parts.panels
    )
    found = Places(
        beams=beams or (known.beams if known else across(structure, R_AB)),
        panels=panels or (known.panels if known else ()),
        equipment=parts.equipment
        or (known.equipment if known and known.equipment else dict(monitoring)),
    )
    missing = {
        g: purpose
        for g, purpose in found.grids.items()
        if g not in structure.points.grid_id
    }
    if missing:
        raise InputError(
            f"{purpose}: grid {g} is not in {structure.deck.path}"
            for g, purpose in missing.items()
        )
    return found


def across(structure: Structure, R_AB: Float64) -> tuple[Beam, ...]:
    """Cuts through the whole airframe across span and length."""
    p = structure.points.xyz @ R_AB.T
    low, high = p.min(axis=0), p.max(axis=0)
    size = high - low
    beams = []
    if size[1] > 0.0:
        middle = 0.5 * (low[1] + high[1])
        reach = 0.5 * size[1] * np.linspace(_MARGIN, 1.0 - _MARGIN, _CUTS)
        for name, sign in (("starboard", 1.0), ("port", -1.0)):
            beams.append((f"all to {name} of the cut", name, middle + sign * reach))
    if size[0] > 0.0:
        x = low[0] + size[0] * np.linspace(_MARGIN, 1.0 - _MARGIN, _CUTS)
        beams.append(("all behind the cut", "aft", x))
    return tuple(
        Beam(name=name, outward=outward, stations=stations, R_AB=R_AB)
        for name, outward, stations in beams
    )


def _beam(beam: settings.Beam, R_AB: Float64) -> Beam:
    boxes = tuple((w.x or ANY, w.y or ANY, w.z or ANY) for w in beam.within)
    return Beam(
        name=beam.name,
        outward=beam.outward,
        stations=np.linspace(beam.first, beam.last, beam.count),
        boxes=boxes or (EVERYWHERE,),
        R_AB=R_AB,
    )
