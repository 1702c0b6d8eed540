"""What a landing gear looks like: rods and wheels, fixed to its bodies.

Body frames as `gears.bodies` makes them: parallel to A in the extended gear, turned
where it is steered; the origin of the fitting at the attachment node, that of piston,
arm or beam at the axle or pivot.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from drake_landing.gears.bodies import cylinder_body, steering, strut_axis
from drake_landing.gears.landing_gear import BogieGear, LandingGear, LeveredGear

Float64 = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Rod:
    """A cylinder between two points of a body.

    Attributes:
        body: name of the body in the plant.
        start, end: (3,) in the body's frame, m.
        thickness: radius over that of the thickest rod of the gear.
        bright: chromed rather than painted.
    """

    body: str
    start: Float64
    end: Float64
    thickness: float
    bright: bool = False


def rods(gear: LandingGear, p_AF: npt.ArrayLike) -> list[Rod]:
    """All rods of a gear.

    Args:
        gear: in the axes A.
        p_AF: (3,) attachment node in A.
    """
    attachment = np.asarray(p_AF, dtype=float)
    if isinstance(gear, LeveredGear):
        return _levered(gear, attachment)
    if isinstance(gear, BogieGear):
        pivot = np.array(gear.pivot)
        beam = [np.array(axle) - pivot for axle in gear.axles]
        return [
            *_strut(gear, attachment, pivot),
            Rod(body=f"{gear.name}_beam", start=beam[0], end=beam[-1], thickness=0.8),
            *(_axle(gear, f"{gear.name}_beam", center) for center in beam),
        ]
    axle = np.array(gear.axles[0])
    return [
        *_strut(gear, attachment, axle),
        _axle(gear, f"{gear.name}_piston", np.zeros(3)),
    ]


def _strut(gear: LandingGear, attachment: Float64, lower: Float64) -> list[Rod]:
    """Fitting, cylinder and piston above a point on the strut axis; legs bend."""
    up = strut_axis(gear)
    reach = float((attachment - lower) @ up)
    top, mouth = lower + reach * up, lower + 0.45 * reach * up
    fitting, piston = f"{gear.name}_fitting", f"{gear.name}_piston"
    cylinder, root = cylinder_body(gear, attachment)
    return [
        Rod(body=fitting, start=np.zeros(3), end=top - attachment, thickness=0.7),
        Rod(body=cylinder, start=top - root, end=mouth - root, thickness=1.0),
        Rod(
            body=piston,
            start=np.zeros(3),
            end=0.6 * reach * up,
            thickness=0.7,
            bright=True,
        ),
    ]


def _levered(gear: LeveredGear, attachment: Float64) -> list[Rod]:
    leg, root = cylinder_body(gear, attachment)
    arm = f"{gear.name}_arm"
    pivot, axle = np.array(gear.pivot), np.array(gear.axle)
    upper, lower = np.array(gear.absorber_upper), np.array(gear.absorber_lower)
    turned = pivot + steering(gear).matrix() @ (upper - pivot)
    zero = np.zeros(3)
    return [
        Rod(body=leg, start=attachment - root, end=pivot - root, thickness=1.0),
        Rod(body=leg, start=attachment - root, end=turned - root, thickness=0.6),
        Rod(body=arm, start=zero, end=axle - pivot, thickness=0.9),
        Rod(
            body=arm,
            start=lower - pivot,
            end=0.7 * upper + 0.3 * lower - pivot,
            thickness=0.5,
            bright=True,
        ),
        _axle(gear, arm, axle - pivot),
    ]


def _axle(gear: LandingGear, body: str, center: Float64) -> Rod:
    """Across, to the outermost wheels."""
    side = np.array([0.0, 1.0, 0.0])
    left, right = min(gear.wheel_offsets[0], 0.0), max(gear.wheel_offsets[-1], 0.0)
    return Rod(
        body=body,
        start=center + left * side,
        end=center + right * side,
        thickness=0.6,
        bright=True,
    )
