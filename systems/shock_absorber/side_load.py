"""The load across a strut, which presses its piston against the bearings.

Drag of a wheel that turns freely reaches the piston at the axle, since the wheel hands
on no moment about its axle but that of its brake. A force to the side acts at the
ground, a loaded radius lower, and with the wheel's other forces it also bends the
piston: moments across the axle are handed on.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from pydrake.systems.framework import LeafSystem_

from systems.tools.compiled import compiled_law
from systems.tools.compiled import law as as_law
from systems.tools.scalar import Scalar, sqrt
from systems.tools.template import default_instantiation, for_scalars
from systems.tools.weak_methods import weakly


@for_scalars
def SideLoad_(T):
    law = side_loads_of_floats if T is float else side_loads

    class Impl(LeafSystem_[T]):
        """What the tires press and bend pistons with, for their bearing friction.

        The inertia of piston and wheels is left out: at touchdown it takes a part of
        the load of spin-up, so the friction is somewhat too high rather than too low.

        | port | size | unit | frame and sign |
        |---|---|---|---|
        | in `strut_axes` | 3 s | | unit vector along each strut, upward, W |
        | in `wheels` | 12 k | | of WheelKinematics: axles, W |
        | in `wrench` | 6 k | N m, N | [torque; force] on each wheel, W; of Tire |
        | in `brake_<name>` for each braked wheel | 1 | N m | on the wheel, of Brake |
        | out `side_load` | 3 s | N, N m | of each strut: force across it at the axle, |
        |  |  |  | >= 0; moment that bends with it > 0, as by a longer arm; moment |
        |  |  |  | across |

        Args:
            struts: for each strut, name of each wheel on it -> its place along the axle
                from the strut axis, m, in the direction of the axle. The wheels of the
                ports are all of these in this order.
            brakes: names of those that have a brake.
        """

        def _construct(
            self,
            struts: Sequence[dict[str, float]],
            brakes: Sequence[str] = (),
            converter=None,
        ):
            LeafSystem_[T].__init__(self, converter=converter)
            self._given = tuple(struts), tuple(brakes)
            declare: Any = self.DeclareVectorInputPort
            names = [name for wheels in struts for name in wheels]
            places = [place for wheels in struts for place in wheels.values()]
            self._offsets = np.array(places, dtype=float)
            ends = np.cumsum([len(wheels) for wheels in struts])
            self._first = np.array([0, *ends], dtype=np.int64)
            self._axes = declare("strut_axes", 3 * len(struts))
            self._wheels = declare("wheels", 12 * len(names))
            self._wrench = declare("wrench", 6 * len(names))
            self._brakes = {
                i: declare(f"brake_{name}", 1)
                for i, name in enumerate(names)
                if name in brakes
            }
            self._free = np.array([T(0.0)] * len(names))
            ports = (self._axes, self._wheels, self._wrench, *self._brakes.values())
            self.DeclareVectorOutputPort(
                "side_load",
                3 * len(struts),
                weakly(self._calc_side_load),
                prerequisites_of_calc={port.ticket() for port in ports},
            )

        def _construct_copy(self, other, converter=None):
            Impl._construct(self, *other._given, converter=converter)

        def _calc_side_load(self, context, output):
            torque = self._free
            if self._brakes:
                torque = torque.copy()
                for i, port in self._brakes.items():
                    torque[i] = port.Eval(context)[0]
            load = law(
                self._axes.Eval(context),
                self._wheels.Eval(context),
                self._wrench.Eval(context),
                self._offsets,
                torque,
                self._first,
            )
            output.SetFromVector(load)

    return Impl


@as_law
def side_load(
    axis: Any, wheels: Any, wrenches: Any, offsets: Any, brakes: Any
) -> tuple[Scalar, Scalar, Scalar]:
    """Force across the strut and moments, see `SideLoad`; floats or AutoDiffXd.

    Args:
        axis: (3) of the strut, up.
        wheels: (k, 12) of each, of `WheelKinematics`.
        wrenches: (k, 6) of each, torque at the wheel's center, N m, and force, N.
        offsets: of each center along the axle, m.
        brakes: torque on each wheel, N m.
    """
    zero = 0.0 * axis[0]
    fx, fy, fz, mx, my, mz = zero, zero, zero, zero, zero, zero
    for i in range(len(wheels)):
        a, w, along = wheels[i], wrenches[i], offsets[i]
        size = sqrt(a[3] * a[3] + a[4] * a[4] + a[5] * a[5])
        ex, ey, ez = a[3] / size, a[4] / size, a[5] / size
        fx, fy, fz = fx + w[3], fy + w[4], fz + w[5]
        # The opposite of the brake's torque acts on the axle beside the tire's.
        freed = w[0] * ex + w[1] * ey + w[2] * ez + brakes[i]
        mx = mx + w[0] + along * (ey * w[5] - ez * w[4]) - freed * ex
        my = my + w[1] + along * (ez * w[3] - ex * w[5]) - freed * ey
        mz = mz + w[2] + along * (ex * w[4] - ey * w[3]) - freed * ez
    ux, uy, uz = axis[0], axis[1], axis[2]
    lengthwise = fx * ux + fy * uy + fz * uz
    fx, fy, fz = fx - lengthwise * ux, fy - lengthwise * uy, fz - lengthwise * uz
    # A force an arm h lower has the moment -h u × f; u × m is h f.
    hx, hy, hz = uy * mz - uz * my, uz * mx - ux * mz, ux * my - uy * mx
    across, square = fx * fx + fy * fy + fz * fz, hx * hx + hy * hy + hz * hz
    # Roots of zero have no slope.
    if not across > 0.0:
        return zero, sqrt(square) if square > 0.0 else zero, zero
    force = sqrt(across)
    bending = (hx * fx + hy * fy + hz * fz) / force
    rest = square - bending * bending
    return force, bending, sqrt(rest) if rest > 0.0 else zero


def side_loads(
    axes: Any, wheels: Any, wrenches: Any, offsets: Any, brakes: Any, first: Any
) -> Any:
    """(3 s,) `side_load` of each strut; `first`: of each its first wheel, and the end.

    The others are those of `side_load` for all struts and wheels, as vectors.
    """
    out = np.full(len(axes), 0.0 * axes[0])
    motion, loads = wheels.reshape(-1, 12), wrenches.reshape(-1, 6)
    for i in range(len(first) - 1):
        a, b = first[i], first[i + 1]
        found = side_load(
            axes[3 * i : 3 * i + 3], motion[a:b], loads[a:b], offsets[a:b], brakes[a:b]
        )
        out[3 * i], out[3 * i + 1], out[3 * i + 2] = found
    return out


side_loads_of_floats = compiled_law(side_loads)
"""The same, compiled."""

SideLoad = default_instantiation(SideLoad_)
