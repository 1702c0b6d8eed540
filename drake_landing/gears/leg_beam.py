"""Flexibility at the axle of a leg made of two beams, by the principle of virtual work.

The cylinder is clamped at its root and guides the piston by two bearings. A unit force
across the axle bends the overhang of the piston, c long, with x from the axle up; the
part between the bearings, b long, with c(1 - x/b) from the lower bearing up; and the
cylinder, D long, by the bearings' reactions: (c + b) x/b up to the upper bearing, c + x
above it. A unit moment at the axle bends them with 1, 1 - x/b, x/b and 1. Deflection
per force f = Σ ∫ M²/EI and slope per force g = Σ ∫ M m/EI:

    f = (c³ + c² b)/3EI_p + [(c + b)² b + (c + D)³ - (c + b)³]/3EI_c
    g = (c²/2 + c b/3)/EI_p + [(c + b) b/3 + ((c + D)² - (c + b)²)/2]/EI_c

The piston's share is that of a beam with an overhang, 3EI/(c²(c + b)). With the stroke
s, c = a - s and b = b_0 + s. Shear, and the bearings' own flexibility, are neglected.
"""

from drake_landing.gears.legs import LegBeam


def deflection_per_force(beam: LegBeam, stroke: float, lateral: bool) -> float:
    """f at a stroke (m), m/N."""
    c, b, d, piston, cylinder = _measures(beam, stroke, lateral)
    own = (c**3 + c * c * b) / (3.0 * piston)
    return own + ((c + b) ** 2 * b + (c + d) ** 3 - (c + b) ** 3) / (3.0 * cylinder)


def slope_per_force(beam: LegBeam, stroke: float, lateral: bool) -> float:
    """g at a stroke (m), rad/N; by reciprocity also deflection per moment."""
    c, b, d, piston, cylinder = _measures(beam, stroke, lateral)
    own = (c * c / 2.0 + c * b / 3.0) / piston
    return own + ((c + b) * b / 3.0 + ((c + d) ** 2 - (c + b) ** 2) / 2.0) / cylinder


def root_distance(beam: LegBeam, stroke: float, lateral: bool) -> float:
    """Axle to the hinge that has the beams' deflection and slope under a force, m.

    By reciprocity a hinge there also deflects as the beams do under a moment.
    """
    force = deflection_per_force(beam, stroke, lateral)
    return force / slope_per_force(beam, stroke, lateral)


def _measures(
    beam: LegBeam, stroke: float, lateral: bool
) -> tuple[float, float, float, float, float]:
    cylinder = beam.cylinder_bending
    if lateral and beam.cylinder_bending_lateral is not None:
        cylinder = beam.cylinder_bending_lateral
    return (
        beam.overhang - stroke,
        beam.bearing_distance + stroke,
        beam.cylinder_length,
        beam.piston_bending,
        cylinder,
    )
