"""Where one looks in a case: what it names, a built-in model's places, any deck's."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from drake_landing.case import parts as settings
from drake_landing.parts.branches import (
    beams_of_branches,
    grid_masses,
    named_apart,
    part_name,
)
from drake_landing.parts.cuts import Cutter
from drake_landing.parts.inventory import Inventory
from drake_landing.parts.section_point import crossing
from drake_landing.places import ANY, EVERYWHERE, Beam, Panel, Places, axis_name
from fem.errors import InputError, nearest
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]

_LEAST = 1e-3  # of the mass beyond a cut: lighter pieces are no parts


def places_of(
    cutter: Cutter,
    parts: settings.Parts,
    R_AB: Float64,
    monitoring: Mapping[str, int],
    known: Places | None,
    elements: Inventory,
    loaded: Sequence[int],
) -> Places:
    """The places of a case; those that it does not name are found.

    Args:
        cutter: of the full model.
        parts: of the case.
        R_AB: (3, 3) from the deck's axes.
        monitoring: points that stand for equipment where nothing else is known.
        known: of a parametric aircraft; None for a deck of the user's own.
        elements: of the model, which name the parts that are found.
        loaded: nodes that loads act on.

    Raises:
        InputError: grids that do not exist, cuts that do not go outward.
    """
    structure = cutter.structure
    named = [_beam(given, R_AB) for given in parts.beams]
    problems = [*_inward(parts.beams, named), *_absent(parts, structure)]
    if problems:
        raise InputError(problems)
    beams = tuple(b for beam in named for b in _found(cutter, beam, elements))
    if not beams and known is None:
        beams = beams_of_branches(cutter, R_AB, loaded, elements)
    panels = tuple(
        Panel(name=p.name, grid=p.grid, beside=p.beside) for p in parts.panels
    )
    return Places(
        beams=beams or (known.beams if known else ()),
        panels=panels or (known.panels if known else ()),
        equipment=parts.equipment
        or (known.equipment if known and known.equipment else dict(monitoring)),
    )


def _absent(parts: settings.Parts, structure: Structure) -> Iterator[str]:
    """Grids of a case that the deck does not have."""
    there = set(structure.points.grid_id.tolist())
    grids = [
        *((f"parts.beams: {b.name}", b.grid) for b in parts.beams if b.grid),
        *(
            (f"parts.panels: {p.name}", grid)
            for p in parts.panels
            for grid in (p.grid, *p.beside)
        ),
        *((f"parts.equipment.{name}", grid) for name, grid in parts.equipment.items()),
    ]
    for purpose, grid in grids:
        if grid not in there:
            yield f"{purpose}: grid {grid} is not in {structure.deck.path}" + nearest(
                str(grid), [str(g) for g in sorted(there)], 0.8
            )


def _beam(given: settings.Beam, R_AB: Float64) -> Beam:
    boxes = tuple((w.x or ANY, w.y or ANY, w.z or ANY) for w in given.within)
    return Beam(
        name=given.name,
        outward=given.outward,
        stations=np.linspace(given.first, given.last, given.count),
        tips=() if given.grid is None else (given.grid,),
        boxes=boxes or (EVERYWHERE,),
        line=None if given.line is None else np.array(given.line, float),
        R_AB=R_AB,
    )


def _inward(beams: Sequence[settings.Beam], named: Sequence[Beam]) -> Iterator[str]:
    """Beams whose last cut does not lie outward of the first."""
    for given, beam in zip(beams, named):
        if np.any(np.diff(beam.along) <= 0.0):
            yield (
                f"parts.beams: {given.name}: first {given.first:g} and last "
                f"{given.last:g}: the last cut must lie {given.outward} of the first, "
                f"which is toward {axis_name(beam.direction)} in the deck's axes"
            )


def _found(cutter: Cutter, beam: Beam, elements: Inventory) -> Sequence[Beam]:
    """A beam that names no box takes each connected piece for itself."""
    if beam.boxes != (EVERYWHERE,) or beam.tips:
        return [beam]
    return _pieces(cutter, beam, elements)


def _pieces(cutter: Cutter, beam: Beam, elements: Inventory) -> Sequence[Beam]:
    """A beam for each piece beyond the first cut that weighs something and deforms."""
    d, along = beam.direction, float(beam.along[0])
    piece = cutter.links.pieces(cutter.beyond(d, along))
    weight = np.bincount(piece + 1, grid_masses(cutter.structure))[1:]
    s = cutter.structure.points.xyz @ d
    ids = cutter.structure.points.grid_id
    found = []
    for k in np.flatnonzero(weight > _LEAST * weight.sum()):
        own = piece == k
        tip = int(np.argmax(np.where(own, s, -np.inf)))
        held = crossing(cutter.links, cutter.elements, own, d, along)
        cuts = int(np.searchsorted(beam.along, s[tip] + cutter.tolerance))
        if len(held.id):
            stations = beam.stations[:cuts]
            found.append(replace(beam, tips=(int(ids[tip]),), stations=stations))
    if len(found) < 2:
        return found or [beam]
    names = [f"{beam.name}: {part_name(cutter, b, elements)}" for b in found]
    return named_apart(cutter, found, names)
