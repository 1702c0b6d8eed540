"""The load across a strut, which presses its piston against the bearings."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from pydrake.systems.framework import LeafSystem


class SideLoad(LeafSystem):
    """Magnitude of the tyres' force across one strut, for its bearing friction.

    The inertia of piston and wheels is left out: at touchdown it takes a part of the
    load of spin-up, so the friction is somewhat too high rather than too low.

    | port | size | unit | frame and sign |
    |---|---|---|---|
    | in `strut_axis` | 3 | | unit vector along the strut, W |
    | in `tire_<wheel>` for each wheel | 6 | N m, N | [torque; force] on it, W |
    | out `side_load` | 1 | N | >= 0 |

    Args:
        wheels: names of the wheels on the strut.
    """

    def __init__(self, wheels: Sequence[str]) -> None:
        super().__init__()
        declare: Any = self.DeclareVectorInputPort
        self._axis = declare("strut_axis", 3)
        self._tires = [declare(f"tire_{name}", 6) for name in wheels]
        tickets = {port.ticket() for port in (self._axis, *self._tires)}
        self.DeclareVectorOutputPort("side_load", 1, self._calc_side_load, tickets)

    def _calc_side_load(self, context, output) -> None:
        axis = self._axis.Eval(context)
        force = sum(port.Eval(context)[3:] for port in self._tires)
        across = force - (force @ axis) * axis
        output.SetAtIndex(0, np.sqrt(across @ across))
