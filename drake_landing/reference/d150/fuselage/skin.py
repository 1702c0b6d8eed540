"""The skin: one sheet with the stringers smeared into a ply on its inside."""

from collections.abc import Sequence

from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.hull import SKIN, Hull
from drake_landing.reference.d150.model import ModelBuilder

_STRINGERS = 21  # id of their material
_SOFT = 1.0e6  # Pa: stiffness of the stringer ply across the stringers


def add_skin(hull: Hull) -> None:
    """Writes the skin's elements; side 1-2 of each runs along the fuselage."""
    model = hull.halves.model
    add_stringer_material(model)
    zones = facts("fuselage_shell")["zones"]
    for first, last, side, belt, bottom in zones:
        properties = [
            stiffened_sheet(model, f"skin {first}-{last} {name}", t)
            for name, t in (("side", side), ("window belt", belt), ("bottom", bottom))
        ]
        for row in range(hull.rows.at(first), hull.rows.at(last)):
            _row(hull, row, properties)


def _row(hull: Hull, row: int, properties: Sequence[int]) -> None:
    side, belt, bottom = properties
    window = range(hull.line("window_top") - 1, hull.line("window_bottom") + 1)
    for line in range(hull.lines.count):
        if not hull.present[row, line]:
            continue
        pid = belt if line in window else side
        if line >= hull.line("wing"):
            pid = bottom
        corners = [(row, line), (row + 1, line), (row + 1, line + 1), (row, line + 1)]
        hull.halves.shell(SKIN, pid, [hull.ids[c] for c in corners])


def add_stringer_material(model: ModelBuilder) -> None:
    """The ply of smeared stringers: stiff along them, in shear by their webs."""
    layer, shape = facts("fuselage_shell")["stringer_layer"], facts("fuselage")
    metal = facts("materials")["al7075"]
    filled = shape["stringer_thickness"] / layer["thickness"]
    web = metal["e"] / (2 + 2 * metal["nu"]) * layer["web_thickness"] / layer["pitch"]
    section = model.section("Materials")
    section.comment("stringers smeared over the skin's inside")
    section.add(
        *("MAT8", _STRINGERS, metal["e"] * filled, _SOFT, 0.0, _SOFT),
        *(float(f"{web:.5g}"), None, metal["rho"] * filled),
    )


def stiffened_sheet(model: ModelBuilder, name: str, thickness: float) -> int:
    """Laminate of stringers and skin; the grids are on the skin's middle surface."""
    sheet, smeared = (
        facts("materials")["al2024"],
        facts("fuselage")["stringer_thickness"],
    )
    height = facts("fuselage_shell")["stringer_layer"]["thickness"]
    stringers = facts("materials")["al7075"]["rho"] * smeared
    return model.laminate_property(
        f"{name} {thickness * 1e3:.1f} mm",
        -height - thickness / 2,
        [
            (_STRINGERS, height, stringers),
            (sheet["id"], thickness, sheet["rho"] * thickness),
        ],
    )
