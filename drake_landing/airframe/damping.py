"""Damping of the airframe: what the case adds to a deck, and what there is, in words.

B = b M + a K gives an elastic mode of circular frequency ω the damping ratio
(b/ω + a ω)/2.
"""

from dataclasses import replace

import numpy as np
import numpy.typing as npt
from scipy.optimize import nnls

from drake_landing.case.damping import AirframeDamping
from fem.deck.deck import Deck
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]

PARAMETERS = ("G", "W3", "W4", "ALPHA1", "ALPHA2")
_TOLD_AT = (5.0, 20.0, 50.0)  # Hz


def rayleigh_of_ratios(frequency_hz: Float64, ratio: Float64) -> tuple[float, float]:
    """Factors b (1/s) on M and a (s) on K, >= 0, of least squares in ratio over ratio.

    Args:
        frequency_hz, ratio: (k,) > 0.
    """
    omega = 2.0 * np.pi * frequency_hz
    rows = np.column_stack([0.5 / omega, 0.5 * omega]) / ratio[:, None]
    scale = np.linalg.norm(rows, axis=0)
    found, _ = nnls(rows / scale, np.ones(len(ratio)))
    b, a = found / scale
    return float(b), float(a)


def ratio_at(frequency_hz: Float64, b: float, a: float) -> Float64:
    """Damping ratio of Rayleigh damping."""
    omega = 2.0 * np.pi * frequency_hz
    return 0.5 * (b / omega + a * omega)


def with_damping(deck: Deck, given: AirframeDamping | None) -> Deck:
    """The deck with the damping of a case, as PARAM ALPHA1 and ALPHA2."""
    if given is None:
        return deck
    params = dict(deck.params)
    if given.deck == "drop":
        params |= {name: 0.0 for name in PARAMETERS}
    b, a = given.alpha1 or 0.0, given.alpha2 or 0.0
    if given.g is not None and given.w3 is not None:
        a += given.g / given.w3
    notices = []
    if given.ratio:
        hz, ratio = (np.array(list(v)) for v in (given.ratio, given.ratio.values()))
        more = rayleigh_of_ratios(hz, ratio)
        b, a = b + more[0], a + more[1]
        error = ratio_at(hz, *more) / ratio - 1.0
        worst = int(np.argmax(np.abs(error)))
        if abs(error[worst]) > 0.01:
            notices.append(
                f"airframe.damping.ratio: {ratio[worst]:g} at {hz[worst]:g} Hz becomes "
                f"{ratio[worst] * (1.0 + error[worst]):.3g}, the nearest that damping "
                "by mass and stiffness has; give the frequencies that matter"
            )
    for name, more in (("ALPHA1", b), ("ALPHA2", a)):
        params[name] = float(params.get(name, 0.0)) + more
    return replace(deck, params=params, notices=(*deck.notices, *notices))


def damping_story(structure: Structure) -> str:
    """What damps the airframe in the multibody model and in the transient."""
    found = structure.damping
    b, a = found.mass_factor, found.stiffness_factor
    if not (a or b or found.other is not None):
        return (
            "none: neither the deck nor airframe.damping gives any, so that the "
            "airframe never stops to swing and late peaks come out too high"
        )
    parts = []
    if a or b:
        hz = np.array(_TOLD_AT)
        ratios = ", ".join(
            f"{ratio:.2%} at {f:g} Hz" for f, ratio in zip(hz, ratio_at(hz, b, a))
        )
        of = " and ".join(["mass"] * (b != 0.0) + ["stiffness"] * (a != 0.0))
        parts.append(f"proportional to {of}: {ratios} of critical")
    if found.other is not None:
        parts.append("dampers or matrices of the deck")
    return "; ".join(parts)
