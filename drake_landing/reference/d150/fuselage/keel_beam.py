"""Keel beam: a box below the wing, from the forward hold past the main gear bay.

Its webs stand on the skin's keel lines; its top is a sheet of its own before and behind
the wing, and the lower cover of the center wing box under it.
"""

import numpy as np

from drake_landing.reference.d150.beams import UP
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.hull import Hull
from drake_landing.reference.d150.fuselage.wing_fit import Fit
from drake_landing.reference.d150.geometry import Float64, Int64

KEEL = "fuselage keel beam"


def add_keel_beam(hull: Hull, fit: Fit | None) -> dict[int, Int64]:
    """Writes webs, top and caps.

    Args:
        hull: the skin.
        fit: joins it to the wing's lower cover; None: nothing is joined.

    Returns:
        Row -> (high + 1, 2) twins of the web, from the skin up.
    """
    halves, data = hull.halves, facts("fuselage_shell")["keel_beam"]
    rows = list(hull.rows.between(*data["frames"]))
    first, last = (hull.rows.at(f) for f in facts("fuselage")["wing_frames"])
    line = hull.line("keel")
    share = np.linspace(0.0, 1.0, data["high"] + 1)[1:]
    tops = _tops(hull)
    web, spine = [], []
    for row in rows:
        foot = hull.p(row, line)
        face, z = None, float(np.interp(foot[0], *tops))
        if fit is not None and first <= row <= last:
            face = {first: "front", last: "rear"}.get(row, "lower")
            z = _under_wing(fit, face, foot[0])
        p = foot + share[:, None] * np.array([0.0, 0.0, z - foot[2]])
        twins = halves.grids(KEEL, p)
        web.append(np.concatenate([hull.at(row, line)[None], twins]))
        amid = np.array([[foot[0], 0.0, z]])
        inside = first < row < last
        spine.append(twins[-1] if inside else halves.grids(KEEL, amid)[0])
        if fit is not None and face is not None:
            fit.to_face(KEEL, twins[-1], face)
            fit.to_face(KEEL, spine[-1], face)
    grid = np.array(web)
    halves.patch(KEEL, halves.sheet("fuselage keel web", data["web"]), grid)
    top = np.stack([grid[:, -1], np.array(spine)], axis=1)
    sheet = halves.sheet("fuselage keel top", data["top"])
    for stretch in (np.s_[: rows.index(first) + 1], np.s_[rows.index(last) :]):
        halves.patch(KEEL, sheet, top[stretch])
    cap = halves.profile("keel_cap")
    for edge in (0, -1):
        halves.chain(KEEL, cap, grid[:, edge], UP)
    return dict(zip(rows, grid))


def _under_wing(fit: Fit, face: str, x: float) -> float:
    """Height of the wing box above the keel: lower cover, or a spar's lower edge."""
    return fit.height(face, x) if face == "lower" else fit.edges(face)[1]


def _tops(hull: Hull) -> tuple[Float64, Float64]:
    """x of four frames, z of the beam's top there: it tapers toward its ends."""
    data, names = facts("fuselage_shell")["keel_beam"], hull.rows.names
    first, last = (hull.rows.number(f) for f in data["frames"])
    x = [
        hull.rows.x[hull.rows.at(names[k])] for k in (first, first + 1, last - 1, last)
    ]
    end, top = data["end_z"], data["top_z"]
    return np.array(x), np.array([end, top, top, end])
