"""Initial state of a landing: steady flight, the lowest tire just off the ground."""

import numpy as np
import numpy.typing as npt
from pydrake.systems.framework import Context

from drake_landing.landing.diagram import LandingDiagram
from systems.tools.rotations import exp, quaternion_from_rotation

Float64 = npt.NDArray[np.float64]


def attitude(roll: float, pitch: float, yaw: float) -> Float64:
    """(3, 3) R_WB of an aircraft that flies toward -x at zero angles.

    Args:
        roll: starboard wing down, rad.
        pitch: nose up, rad.
        yaw: nose to starboard, rad; the first of the rotations, then pitch, then roll.
    """
    turns = exp(np.array([[0.0, 0.0, -yaw], [0.0, pitch, 0.0], [-roll, 0.0, 0.0]]))
    return turns[0] @ turns[1] @ turns[2]


def angular_velocity(roll_rate: float, pitch_rate: float, yaw_rate: float) -> Float64:
    """(3,) ω_B from the rates about the axes of the aircraft, rad/s, signs as above."""
    return np.array([-roll_rate, pitch_rate, -yaw_rate])


def set_initial_state(
    landing: LandingDiagram,
    context: Context,
    *,
    v_WG: npt.ArrayLike,
    R_WB: npt.ArrayLike | None = None,
    w_B: npt.ArrayLike = (0.0, 0.0, 0.0),
    xy: npt.ArrayLike = (0.0, 0.0),
    clearance: float = 1e-3,
    height: float | None = None,
) -> None:
    """Undeformed airframe, extended struts, bogies in trim, wheels that do not turn.

    The state of gears and airframe is consistent: fittings sit at their nodes and move
    with them. States of tires and of the energy budget are set to their defaults, and
    so are all parameters.

    Args:
        landing: the diagram and its parts.
        context: of the diagram.
        v_WG: (3,) velocity of the airframe's center of gravity in W, m/s.
        R_WB: (3, 3) attitude; default level, flying toward -x.
        w_B: (3,) angular velocity in B, rad/s.
        xy: (2,) airframe's center of gravity over ground, W, m.
        clearance: of the lowest tire over the runway, m.
        height: of the airframe's center of gravity, W, m, in place of a clearance.

    Raises:
        ValueError: clearance is negative, a wheel is below the runway, or lies on its
            side.
    """
    if not clearance >= 0:
        raise ValueError(f"clearance is {clearance} m, expected >= 0")
    rotation = np.eye(3) if R_WB is None else np.asarray(R_WB, dtype=float)
    quaternion = quaternion_from_rotation(rotation)
    landing.diagram.SetDefaultContext(context)
    airframe = landing.airframe.GetMyMutableContextFromRoot(context)
    x, y = np.asarray(xy, dtype=float)

    def place(z: float) -> None:
        landing.airframe.set_state(
            airframe, p_WG=[x, y, z], quaternion=quaternion, v_WG=v_WG, w_B=w_B
        )
        landing.attachment.place_fittings(context)

    if height is None:
        place(0.0)
        place(clearance - min(tire_clearances(landing, context).values()))
    else:
        place(height)
        _require_above_runway(landing, context)


def _require_above_runway(landing: LandingDiagram, context: Context) -> None:
    clearances = tire_clearances(landing, context)
    wheel = min(clearances, key=lambda name: clearances[name])
    if clearances[wheel] < 0:
        raise ValueError(
            f"wheel {wheel} is {-clearances[wheel]:.4g} m below the runway at the "
            "start, expected above it: raise the height, or give a clearance"
        )


def tire_clearances(landing: LandingDiagram, context: Context) -> dict[str, float]:
    """Height of each tire's lowest point over the runway below it, m."""
    return {name: tire.clearance(context) for name, tire in landing.tires.items()}
