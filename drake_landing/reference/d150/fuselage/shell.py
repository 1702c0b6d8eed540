"""The fuselage as a shell, put together."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.bulkheads import add_bulkheads
from drake_landing.reference.d150.fuselage.cargo_floor import add_cargo_floor
from drake_landing.reference.d150.fuselage.frame_ties import tie_frames
from drake_landing.reference.d150.fuselage.frames import add_frames
from drake_landing.reference.d150.fuselage.halves import Halves
from drake_landing.reference.d150.fuselage.hull import Hull, make_hull
from drake_landing.reference.d150.fuselage.keel_beam import add_keel_beam
from drake_landing.reference.d150.fuselage.lines import fuselage_lines
from drake_landing.reference.d150.fuselage.longerons import (
    add_opening_edges,
    add_splices,
)
from drake_landing.reference.d150.fuselage.nose_bay import add_nose_bay
from drake_landing.reference.d150.fuselage.passenger_floor import (
    PassengerFloor,
    add_passenger_floor,
)
from drake_landing.reference.d150.fuselage.rows import fuselage_rows
from drake_landing.reference.d150.fuselage.skin import add_skin
from drake_landing.reference.d150.fuselage.tail_junction import join_fin, join_tailplane
from drake_landing.reference.d150.fuselage.walls import add_bay_wall
from drake_landing.reference.d150.fuselage.wing_fit import Fit
from drake_landing.reference.d150.fuselage.wing_junction import add_wing_junction
from drake_landing.reference.d150.model import ModelBuilder
from drake_landing.reference.d150.reference_axis import Reference
from drake_landing.reference.d150.shell_mesh import BoxMesh

FIRST_ID = 1_000_001


@dataclass(frozen=True, kw_only=True)
class FuselageShell:
    """Grids of the fuselage to which other parts attach.

    Attributes:
        hull: skin grids.
        floor: passenger floor.
        nose_gear: grids that hold the nose gear.
    """

    hull: Hull
    floor: PassengerFloor
    nose_gear: list[int]


def add_fuselage_shell(
    model: ModelBuilder,
    reference: Reference,
    density: Mapping[str, Any],
    meshes: Mapping[str, BoxMesh] | None = None,
) -> FuselageShell:
    """Writes the fuselage, joins wing, fin and tailplane to it, ties reference nodes.

    Args:
        model: the bench, reference nodes written.
        reference: the reference nodes.
        density: `size` of the elements along the fuselage (m) and `lines`, the number
            of elements round the section between the named lines.
        meshes: the lifting surfaces; None: the fuselage alone.
    """
    halves = Halves(model, FIRST_ID)
    rows = fuselage_rows(density["size"])
    hull = make_hull(halves, rows, fuselage_lines(rows.x, density["lines"]))
    fit = None if meshes is None else Fit(halves, meshes)
    add_skin(hull)
    add_frames(hull)
    floor = add_passenger_floor(hull)
    add_cargo_floor(hull)
    add_bulkheads(hull)
    nose_gear = add_nose_bay(hull, floor)
    keel = add_keel_beam(hull, fit)
    frame = facts("fuselage_shell")["main_bay"]["frames"][1]
    add_bay_wall(hull, floor, frame, keel[hull.rows.at(frame)])
    add_opening_edges(hull)
    add_splices(hull)
    if meshes is not None and fit is not None:
        add_wing_junction(hull, floor, fit)
        join_fin(hull, meshes["fin"])
        join_tailplane(hull, meshes, reference)
    tie_frames(hull, floor, reference["fuselage"])
    return FuselageShell(hull=hull, floor=floor, nose_gear=nose_gear)
