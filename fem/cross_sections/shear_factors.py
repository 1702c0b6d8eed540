"""Shear factors and torsion constants of Nastran's beam library (MSCBML0).

The library works with thin walls: a transverse force is carried by the walls along it,
counted between those across it, with a uniform stress; a closed section twists by
Bredt's formula, an open one by the sum of length times thickness cubed over three. NX
Nastran uses it for all its releases; MSC Nastran where MDLPRM,TWBRBML,1 asks for it and
in older releases, and finite elements otherwise (remark 10 of PBARL in its guide of
2022). With these, ROD has 0.857 and TUBE its elastic value (results in TACS's study
of beams), which moves the end of a cantilever of ten diameters by 3e-4. `SOURCES`
says for each type where its values were read; types without an entry are left to the
finite elements of `analysis.py`, as MSC has them.
"""

from collections.abc import Callable

# k1, k2, j; None: what the finite elements find.
Values = tuple[float, float, float | None]

# Shear factor of round sections in all directions.
ROUND = {"ROD": 0.9, "TUBE": 0.5, "TUBE2": 0.5}


def library_values(
    kind: str, dimensions: tuple[float, ...], area: float
) -> Values | None:
    """Shear factors and torsion constant of a type with walls, if it is known.

    Args:
        kind: type of section.
        dimensions: DIM1, DIM2, ...
        area: of the section.
    """
    rule = _RULES.get(kind)
    return rule(area, *dimensions) if rule else None


def _bar(_area: float, _w: float, _h: float) -> Values:
    return 5.0 / 6.0, 5.0 / 6.0, None


def _box1(
    area: float, w: float, h: float, top: float, bottom: float, r: float, s: float
) -> Values:
    upright = (r + s) * (h - top - bottom)
    flat = (top + bottom) * (w - r - s)
    middle_w, middle_h = w - (r + s) / 2, h - (top + bottom) / 2
    round_trip = middle_w * (1 / top + 1 / bottom) + middle_h * (1 / r + 1 / s)
    bredt = 4.0 * (middle_w * middle_h) ** 2 / round_trip
    return upright / area, flat / area, bredt


def _box(area: float, w: float, h: float, t: float, s: float) -> Values:
    return _box1(area, w, h, t, t, s, s)


def _l(area: float, w: float, h: float, t: float, s: float) -> Values:
    j = (t**3 * (w - s / 2) + s**3 * (h - t / 2)) / 3
    return s * (h - t) / area, t * (w - s) / area, j


def _chan(area: float, w: float, h: float, tw: float, tf: float) -> Values:
    j = (2 * (w - tw / 2) * tf**3 + (h - tf) * tw**3) / 3
    return tw * (h - 2 * tf) / area, 2 * tf * (w - tw) / area, j


def _chan1(area: float, flange: float, tw: float, inner: float, h: float) -> Values:
    return _chan(area, flange + tw, h, tw, (h - inner) / 2)


def _chan2(area: float, leg: float, bottom: float, h: float, w: float) -> Values:
    k_bottom, k_legs, j = _chan(area, h, w, bottom, leg)
    return k_legs, k_bottom, j


_RULES: dict[str, Callable[..., Values]] = {
    "BAR": _bar,
    "BOX": _box,
    "BOX1": _box1,
    "L": _l,
    "CHAN": _chan,
    "CHAN1": _chan1,
    "CHAN2": _chan2,
}

_GUIDE = "equations of the NX Element Library Reference 10, as pyNastran cites them"
SOURCES: dict[str, str] = {
    "ROD": "PBAR and PBEAM printed by NX 2019.2 (pyNastran models, beam_modes)",
    "TUBE": "PBEAM printed by MSC 2005 (pyNastran models, fmondsp)",
    "TUBE2": "a TUBE by its thickness",
    "BAR": "the exact value without Poisson's ratio, 5/6",
    "BOX": "PBEAM printed by NX 8.5 and MSC 2005 (pyNastran models, aerobeam, fmondsp)",
    "BOX1": "a BOX with unlike walls",
    "L": _GUIDE,
    "CHAN": _GUIDE,
    "CHAN1": "a CHAN by other dimensions",
    "CHAN2": "a CHAN, turned",
}
