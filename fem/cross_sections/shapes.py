"""Shapes of PBARL and PBEAML: dimensions to the rectangles that a section consists of.

Each function has the dimensions of Nastran's guide in its order, and gives rectangles
and the stress points C, D, E, F (y, z), see `library`.
"""

from collections.abc import Callable

Box = tuple[float, float, float, float]  # y from, y to, z from, z to
Shape = tuple[list[Box], list[list[float]]]


def _corners(y0: float, y1: float, z0: float, z1: float) -> list[list[float]]:
    """Upper right, lower right, lower left, upper left."""
    return [[y1, z1], [y0, z1], [y0, z0], [y1, z0]]


def _bar(w: float, h: float) -> Shape:
    box = (-h / 2, h / 2, -w / 2, w / 2)
    return [box], _corners(*box)


def _box(w: float, h: float, t: float, s: float) -> Shape:
    return _box1(w, h, t, t, s, s)


def _box1(w: float, h: float, top: float, bottom: float, r: float, s: float) -> Shape:
    """DIM3 top, DIM4 bottom, DIM5 right, DIM6 left wall."""
    y, z = h / 2, w / 2
    boxes: list[Box] = [
        (y - top, y, -z, z),
        (-y, -y + bottom, -z, z),
        (-y + bottom, y - top, z - r, z),
        (-y + bottom, y - top, -z, -z + s),
    ]
    _demand(w > r + s and h > top + bottom, "BOX: walls thicker than the section")
    return boxes, _corners(-y, y, -z, z)


def _i(h: float, a: float, b: float, tw: float, ta: float, tb: float) -> Shape:
    """DIM1 height, DIM2 lower and DIM3 upper width, DIM4 web, DIM5, DIM6 flanges."""
    boxes: list[Box] = [
        (0.0, ta, -a / 2, a / 2),
        (ta, h - tb, -tw / 2, tw / 2),
        (h - tb, h, -b / 2, b / 2),
    ]
    return boxes, [[h, b / 2], [0, a / 2], [0, -a / 2], [h, -b / 2]]


def _i1(flange: float, tw: float, inner: float, h: float) -> Shape:
    t = (h - inner) / 2
    return _i(h, flange + tw, flange + tw, tw, t, t)


def _t(w: float, h: float, tf: float, tw: float) -> Shape:
    boxes: list[Box] = [(h - tf, h, -w / 2, w / 2), (0.0, h - tf, -tw / 2, tw / 2)]
    return boxes, [[h, w / 2], [0, tw / 2], [0, -tw / 2], [h, -w / 2]]


def _t2(w: float, h: float, tf: float, tw: float) -> Shape:
    boxes: list[Box] = [(0.0, tf, -w / 2, w / 2), (tf, h, -tw / 2, tw / 2)]
    return boxes, [[h, tw / 2], [0, w / 2], [0, -w / 2], [h, -tw / 2]]


def _t1(h: float, web: float, tf: float, tw: float) -> Shape:
    """Flange of height DIM1 upright on the right, web of length DIM2 to its left."""
    boxes: list[Box] = [(-h / 2, h / 2, 0.0, tf), (-tw / 2, tw / 2, -web, 0.0)]
    return boxes, [[h / 2, tf], [-h / 2, tf], [-tw / 2, -web], [tw / 2, -web]]


def _chan(w: float, h: float, tw: float, tf: float) -> Shape:
    """Web upright on the left, flanges to the right."""
    y = h / 2
    boxes: list[Box] = [
        (-y, y, 0.0, tw),
        (y - tf, y, tw, w),
        (-y, -y + tf, tw, w),
    ]
    _demand(h > 2 * tf, "CHAN: flanges thicker than half the height")
    return boxes, _corners(-y, y, 0.0, w)


def _chan1(flange: float, tw: float, inner: float, h: float) -> Shape:
    return _chan(flange + tw, h, tw, (h - inner) / 2)


def _chan2(leg: float, bottom: float, h: float, w: float) -> Shape:
    """Open at the top: legs of thickness DIM1, bottom of thickness DIM2."""
    z = w / 2
    boxes: list[Box] = [
        (0.0, bottom, -z, z),
        (bottom, h, -z, -z + leg),
        (bottom, h, z - leg, z),
    ]
    _demand(w > 2 * leg, "CHAN2: legs thicker than half the width")
    return boxes, _corners(0.0, h, -z, z)


def _cross(arms: float, tv: float, h: float, th: float) -> Shape:
    """DIM1 both arms together, DIM2 upright, DIM3 height, DIM4 thickness of arms."""
    z = (arms + tv) / 2
    boxes: list[Box] = [(-h / 2, h / 2, -tv / 2, tv / 2), (-th / 2, th / 2, -z, z)]
    _demand(arms > 0 and h > th, "CROSS: arms thicker than the section is high")
    return boxes, [[h / 2, 0.0], [0.0, z], [-h / 2, 0.0], [0.0, -z]]


def _h(web: float, flanges: float, h: float, tw: float) -> Shape:
    """DIM1 length of the web, DIM2 both flanges together, DIM3 height, DIM4 web."""
    z, inner = (web + flanges) / 2, web / 2
    boxes: list[Box] = [
        (-h / 2, h / 2, -z, -inner),
        (-h / 2, h / 2, inner, z),
        (-tw / 2, tw / 2, -inner, inner),
    ]
    return boxes, _corners(-h / 2, h / 2, -z, z)


def _z(flange: float, tw: float, inner: float, h: float) -> Shape:
    """Upper flange to the left, lower flange to the right of the web."""
    y, t, z = h / 2, (h - inner) / 2, tw / 2
    boxes: list[Box] = [
        (-y, y, -z, z),
        (y - t, y, -z - flange, -z),
        (-y, -y + t, z, z + flange),
    ]
    return boxes, [[y, z], [-y, z + flange], [-y, -z], [y, -z - flange]]


def _l(w: float, h: float, t: float, s: float) -> Shape:
    """DIM3 thickness of the lower leg, DIM4 of the upright leg on the left."""
    boxes: list[Box] = [(0.0, t, 0.0, w), (t, h, 0.0, s)]
    _demand(w > s, "L: DIM4 is not less than DIM1")
    return boxes, [[h, s], [0.0, w], [0.0, 0.0], [h, 0.0]]


def _hat(h: float, t: float, top: float, brim: float) -> Shape:
    z = top / 2
    boxes: list[Box] = [
        (h - t, h, -z, z),
        (0.0, h - t, -z, -z + t),
        (0.0, h - t, z - t, z),
        (0.0, t, -z - brim, -z),
        (0.0, t, z, z + brim),
    ]
    _demand(top > 2 * t and h > 2 * t, "HAT: walls thicker than the section")
    return boxes, [[h, z], [0.0, z + brim], [0.0, -z - brim], [h, -z]]


def _hat1(plate: float, h: float, top: float, t: float, tp: float) -> Shape:
    """A hat of height DIM2 - DIM5 and wall DIM4 on a plate of thickness DIM5."""
    z, half = top / 2, plate / 2
    boxes: list[Box] = [
        (0.0, tp, -half, half),
        (h - t, h, -z, z),
        (tp, h - t, -z, -z + t),
        (tp, h - t, z - t, z),
        (tp, tp + t, -half, -z),
        (tp, tp + t, z, half),
    ]
    _demand(top > 2 * t and h > tp + 2 * t, "HAT1: walls thicker than the section")
    return boxes, [[h, z], [0.0, half], [0.0, -half], [h, -z]]


def _dbox(*d: float) -> Shape:
    """Two cells: DIM3 to the middle of the middle wall; walls DIM4 ... DIM10."""
    w, h, middle, left, mid, right, top1, bottom1, top2, bottom2 = d
    a, b = middle - mid / 2, middle + mid / 2
    boxes: list[Box] = [
        (0.0, h, 0.0, left),
        (0.0, h, a, b),
        (0.0, h, w - right, w),
        (h - top1, h, left, a),
        (0.0, bottom1, left, a),
        (h - top2, h, b, w - right),
        (0.0, bottom2, b, w - right),
    ]
    _demand(h > max(top1 + bottom1, top2 + bottom2), "DBOX: walls thicker than high")
    return boxes, _corners(0.0, h, 0.0, w)


def _demand(condition: bool, text: str) -> None:
    if not condition:
        raise ValueError(f"section {text}")


SHAPES: dict[str, Callable[..., Shape]] = {
    "BAR": _bar,
    "BOX": _box,
    "BOX1": _box1,
    "I": _i,
    "I1": _i1,
    "T": _t,
    "T1": _t1,
    "T2": _t2,
    "L": _l,
    "CHAN": _chan,
    "CHAN1": _chan1,
    "CHAN2": _chan2,
    "CROSS": _cross,
    "H": _h,
    "Z": _z,
    "HAT": _hat,
    "HAT1": _hat1,
    "DBOX": _dbox,
}

# Number of dimensions of each type.
DIMENSIONS: dict[str, int] = {
    "ROD": 1,
    "TUBE": 2,
    "TUBE2": 2,
    "HEXA": 3,
    "BAR": 2,
    "BOX": 4,
    "BOX1": 6,
    "I": 6,
    "I1": 4,
    "T": 4,
    "T1": 4,
    "T2": 4,
    "L": 4,
    "CHAN": 4,
    "CHAN1": 4,
    "CHAN2": 4,
    "CROSS": 4,
    "H": 4,
    "Z": 4,
    "HAT": 4,
    "HAT1": 5,
    "DBOX": 10,
}
