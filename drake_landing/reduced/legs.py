"""Legs of gears whose flexibility is a user's reduced finite-element model."""

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from drake_landing.gears.landing_gear import LandingGear
from drake_landing.gears.legs import LegMatrix, ReducedLeg
from drake_landing.reduced.imported import read_reduced
from drake_landing.reduced.model import ReducedModel
from fem.errors import InputError, nearest

Float64 = npt.NDArray[np.float64]

_AWAY = 0.1  # m, that the matrices' axle may lie from the gear's unsaid
_MASS_OFF = 0.05  # of the gear's own, that a leg's mass may differ by unsaid


def with_read_legs(
    gears: Iterable[LandingGear],
) -> tuple[tuple[LandingGear, ...], tuple[str, ...]]:
    """The gears with the stiffness of reduced legs read, and what is odd about them.

    Raises:
        InputError: files of a leg do not fit together; names the field.
    """
    read, notices = [], []
    for gear in gears:
        leg = gear.leg
        if leg is None or leg.reduced is None:
            read.append(gear)
            continue
        field = f"gears.{gear.name}.leg.reduced"
        try:
            model = read_reduced(
                leg.reduced.files, leg.reduced.grids, _names(leg.reduced)
            )
            K = axle_stiffness(model, leg.reduced.root, leg.reduced.axle)
            matrix = LegMatrix(
                stiffness=tuple(map(tuple, K.tolist())),  # type: ignore[arg-type]
                damping_ratio=leg.reduced.damping_ratio,
            )
        except (InputError, ValueError) as error:
            raise InputError(f"{field}: {_reason(error)}") from None
        odd = (*_mass_notice(model, gear), *_place_notice(model, gear, leg.reduced))
        notices += [f"{field}: {text}" for text in odd]
        whole = leg.model_copy(update={"reduced": None, "matrix": matrix})
        read.append(gear.model_copy(update={"leg": whole}))
    return tuple(read), tuple(notices)


def axle_stiffness(model: ReducedModel, root: int, axle: int) -> Float64:
    """(6, 6) at the axle with the root clamped and all else free.

    Raises:
        InputError: a grid is not there, or the axle has not all six freedoms.
    """
    labels = model.labels
    for name, grid in (("root", root), ("axle", axle)):
        if grid not in model.grid_id:
            known = [str(i) for i in model.grid_id]
            raise InputError(
                f"{name}: found grid {grid}, expected one of {', '.join(known)}"
                + nearest(str(grid), known)
            )
    at = labels[:, 0] == axle
    if at.sum() != 6:
        raise InputError(
            f"axle: grid {axle} has {at.sum()} freedoms in the matrices, expected six"
        )
    rest = ~at & (labels[:, 0] != root)
    K = model.stiffness
    coupling = K[np.ix_(rest, at)]
    try:
        condensed = np.linalg.solve(K[np.ix_(rest, rest)], coupling)
    except np.linalg.LinAlgError:
        raise InputError("stiffness: something moves freely beside the axle") from None
    found = K[np.ix_(at, at)] - coupling.T @ condensed
    return 0.5 * (found + found.T)


def _mass_notice(model: ReducedModel, gear: LandingGear) -> list[str]:
    """The matrices' mass beside what of the gear bends, with or without the fitting."""
    motion = model.rigid_body()[:, 0]
    found = float(motion @ model.mass @ motion)
    moving = sum(part.mass for part in gear.moving_parts.values())
    least, most = moving + gear.sprung_mass - gear.fitting.mass, moving
    most += gear.sprung_mass
    if least * (1 - _MASS_OFF) <= found <= most * (1 + _MASS_OFF):
        return []
    return [
        f"the matrices have a mass of {found:.4g} kg, the gear without wheels "
        f"{least:.4g} kg below its fitting and {most:.4g} kg with it, which are used"
    ]


def _place_notice(model: ReducedModel, gear: LandingGear, leg: ReducedLeg) -> list[str]:
    """A leg of the other side, of another frame or in another unit."""
    there = model.p[list(model.grid_id).index(leg.axle)]
    here = getattr(gear, "pivot" if gear.kind == "bogie" else "axle")
    if np.linalg.norm(there - here) <= _AWAY:
        return []
    at, of = (", ".join(f"{x:.4g}" for x in p) for p in (there, here))
    return [
        f"grid {leg.axle} lies at {at}, the end of the gear's leg at {of} m: the "
        "stiffness is taken as it is, along the axes of the matrices"
    ]


def _names(leg: ReducedLeg) -> dict[str, str]:
    return {
        "stiffness": leg.stiffness,
        "mass": leg.mass,
        "damping": "BRED",
        "recovery": "RRED",
    }


def _reason(error: Exception) -> str:
    if isinstance(error, InputError):
        return "; ".join(text.removeprefix("matrices: ") for text in error.problems)
    return str(error)
