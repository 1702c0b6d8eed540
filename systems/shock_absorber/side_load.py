"""The load across a strut, which presses its piston against the bearings.

Drag of a wheel that turns freely reaches the piston at the axle, since the wheel hands
on no moment about its axle but that of its brake. A force to the side acts at the
ground, a loaded radius lower, and with the wheel's other forces it also bends the
piston: moments across the axle are handed on.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from pydrake.systems.framework import LeafSystem

from systems.tools.compiled import compiled
from systems.tools.vectors import cross, dot

Float64 = npt.NDArray[np.float64]


class SideLoad(LeafSystem):
    """What the tyres press and bend one piston with, for its bearing friction.

    The inertia of piston and wheels is left out: at touchdown it takes a part of the
    load of spin-up, so the friction is somewhat too high rather than too low.

    | port | size | unit | frame and sign |
    |---|---|---|---|
    | in `strut_axis` | 3 | | unit vector along the strut, upward, W |
    | in `wheel_<name>` for each wheel | 12 | | of WheelKinematics: its axle, W |
    | in `tire_<name>` for each wheel | 6 | N m, N | [torque; force] on it, W |
    | in `brake_<name>` for each braked wheel | 1 | N m | on the wheel, of Brake |
    | out `side_load` | 3 | N, N m | force across the strut at the axle, >= 0; moment |
    |  |  |  | that bends with it > 0, as by a longer arm; moment across that |

    Args:
        wheels: name of each wheel on the strut -> its place along the axle from the
            strut axis, m, in the direction of the axle.
        brakes: names of those that have a brake.
    """

    def __init__(self, wheels: dict[str, float], brakes: Sequence[str] = ()) -> None:
        super().__init__()
        declare: Any = self.DeclareVectorInputPort
        self._offsets = np.array(list(wheels.values()), dtype=float)
        self._axis = declare("strut_axis", 3)
        self._wheels = [declare(f"wheel_{name}", 12) for name in wheels]
        self._tires = [declare(f"tire_{name}", 6) for name in wheels]
        braked = [name for name in wheels if name in brakes]
        self._brakes = [declare(f"brake_{name}", 1) for name in braked]
        self._braked = [list(wheels).index(name) for name in braked]
        ports = (self._axis, *self._wheels, *self._tires, *self._brakes)
        self.DeclareVectorOutputPort(
            "side_load", 3, self._calc_side_load, {port.ticket() for port in ports}
        )

    def _calc_side_load(self, context, output) -> None:
        torque = np.zeros(len(self._tires))
        for i, port in zip(self._braked, self._brakes):
            torque[i] = port.Eval(context)[0]
        load = side_load(
            self._axis.Eval(context),
            np.array([port.Eval(context)[3:6] for port in self._wheels]),
            np.array([port.Eval(context) for port in self._tires]),
            self._offsets,
            torque,
        )
        output.SetFromVector(load)


@compiled
def side_load(
    axis: Float64,
    axles: Float64,
    wrenches: Float64,
    offsets: Float64,
    brakes: Float64,
) -> Float64:
    """(3,) force across the strut and moments, see `SideLoad`.

    Args:
        axis: (3,) of the strut, up.
        axles: (w, 3) directions.
        wrenches: (w, 6) torque at the wheel's centre, N m, and force, N.
        offsets: (w,) of the wheels' centres along the axle, m.
        brakes: (w,) torque on the wheels, N m.
    """
    force, moment = np.zeros(3), np.zeros(3)
    for i in range(len(axles)):
        e = axles[i] / math.sqrt((axles[i] ** 2).sum())
        f = wrenches[i, 3:]
        lever = cross((e[0], e[1], e[2]), (f[0], f[1], f[2]))
        about = 0.0
        for c in range(3):
            force[c] += f[c]
            about += wrenches[i, c] * e[c]
        for c in range(3):
            # The opposite of the brake's torque acts on the axle beside the tyre's.
            freed = about + brakes[i]
            moment[c] += wrenches[i, c] + offsets[i] * lever[c] - freed * e[c]
    u = (axis[0], axis[1], axis[2])
    along = dot((force[0], force[1], force[2]), u)
    for c in range(3):
        force[c] -= along * axis[c]
    # A force an arm h lower has the moment -h u × f; u × m is h f.
    arm = cross(u, (moment[0], moment[1], moment[2]))
    out = np.zeros(3)
    out[0] = math.sqrt((force**2).sum())
    size = math.sqrt(arm[0] ** 2 + arm[1] ** 2 + arm[2] ** 2)
    if out[0] == 0.0:
        out[1] = size
        return out
    out[1] = (arm[0] * force[0] + arm[1] * force[1] + arm[2] * force[2]) / out[0]
    out[2] = math.sqrt(max(size**2 - out[1] ** 2, 0.0))
    return out
