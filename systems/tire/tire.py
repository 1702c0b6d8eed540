"""Tires on a runway, as a Drake system; the law is in `tire_law`."""

import math
from collections.abc import Sequence

import numpy as np
from pydrake.common.containers import namedview
from pydrake.common.value import Value
from pydrake.math import atan2
from pydrake.systems.framework import (
    BasicVector_,
    LeafSystem_,
    NumericParameterIndex,
    ValueProducer,
)

from systems.runway.runway import Runway
from systems.tire.tire_law import TireLaw
from systems.tire.tire_parameters import TireParameters
from systems.tools.checks import require, require_index, require_some
from systems.tools.template import default_instantiation, for_scalars
from systems.tools.weak_methods import weakly

TireContact = namedview(
    "TireContact", ["deflection", "F_z", "F_x", "F_y", "slip", "slip_angle"]
)
"""The elements of the port `contact`, of one tire."""

TireTunables = namedview("TireTunables", ["stiffness", "damping", "friction"])
"""The numeric parameters of one tire: factors on stiffness, damping and friction."""


@for_scalars
def Tire_(T):
    def _contact(*values):
        """`TireContact` of the law's values."""
        deflection, fz, ft, fl, slip, slide, travel = values[6:13]
        angle = 0.0 * deflection
        if deflection > 0.0 and (slide != 0.0 or travel != 0.0):
            angle = (math.atan2 if T is float else atan2)(slide, abs(travel))
        # Forward is -t; the curve's slip is along t.
        return deflection, fz, ft, fl, -slip, angle

    class Impl(LeafSystem_[T]):
        """One tire, `Tire(parameters, runway)`, or n in one: `Tire([first, ...])`.

        The runway is flat and dry by default. What passes a port is of one tire after
        the other; several in one system take a fraction of the time of as many systems.

        | port | size | unit | frame and sign |
        |---|---|---|---|
        | in `wheel` | 12 n | m, -, m/s, rad/s | p_WC, axle direction (unit vector, to |
        |  |  |  | starboard at rest), v_WC, ω_WH; world frame |
        | out `wrench` | 6 n | N m, N | [torque; force] of the ground on the wheel at |
        |  |  |  | its center; world frame |
        | out `contact` | 6 n | m, N, -, rad | `TireContact` |
        | out `energy` | 1 | J | stored in the radial deflection of all |
        | out `dissipated_power` | 1 | W | damping and sliding of all |

        `contact`: deflection (negative: clearance); F_z along the surface normal; F_x
        along axle × normal, aft at rest: positive as drag of an aircraft rolling
        forward; F_y across, to starboard at rest; slip (v_x - r_r ω)/v_x, positive for
        braking when rolling forward, lagged where there is a relaxation length; slip
        angle, positive for sliding to starboard. In the air all but the deflection is
        zero.

        States: none; with a relaxation length, given or from the carcass, the lagged
        slips along and across of each such tire.
        Numeric parameters: one vector with the `TireTunables` of each, factors on the
        law, 1; `set_factors`.

        Energy: wrench power on the wheel + d(energy)/dt + dissipated_power = 0. The
        dissipated power is never negative without a relaxation length and without a
        pneumatic trail; it contains what the carcass stores for a moment across and
        along, and the work of the aligning moment on a wheel that yaws.

        Raises:
            ValueError: no parameters at all.
        """

        def _construct(
            self,
            parameters: TireParameters | Sequence[TireParameters],
            runway: Runway | None = None,
            converter=None,
        ):
            LeafSystem_[T].__init__(self, converter=converter)
            single = isinstance(parameters, TireParameters)
            self._parameters = (parameters,) if single else tuple(parameters)
            require_some("tire", self._parameters)
            self._runway = Runway() if runway is None else runway
            self._n = n = len(self._parameters)
            self._kinds = _kinds(self._parameters, self._runway)
            law_of = {i: law for law, members, _ in self._kinds for i in members}
            self._laws = [law_of[i] for i in range(n)]
            self._lagged = [i for i, p in enumerate(self._parameters) if p.lagged]
            self._tunables = NumericParameterIndex(
                self.DeclareNumericParameter(BasicVector_[T]([1.0] * (3 * n)))
            )
            self._wheel = self.DeclareVectorInputPort("wheel", 12 * n)
            geometry = {
                self._wheel.ticket(),
                self.numeric_parameter_ticket(self._tunables),
            }
            everything = set(geometry)
            if self._lagged:
                slips = BasicVector_[T]([0.0] * (2 * len(self._lagged)))
                self.DeclareContinuousState(slips)
                everything.add(self.xc_ticket())
            # The laws are evaluated once for wrench, contact, power and lagged slips.
            self._contact = self.DeclareCacheEntry(
                "law",
                ValueProducer(
                    allocate=lambda: Value(object()), calc=weakly(self._calc_law)
                ),
                everything,
            )
            law = {self._contact.ticket()}
            for name, size, calc, tickets in (
                ("wrench", 6 * n, weakly(self._calc_wrench), law),
                ("contact", 6 * n, weakly(self._calc_contact), law),
                ("energy", 1, weakly(self._calc_energy), geometry),
                ("dissipated_power", 1, weakly(self._calc_dissipated_power), law),
            ):
                self.DeclareVectorOutputPort(
                    name, size, calc, prerequisites_of_calc=tickets
                )

        def _construct_copy(self, other, converter=None):
            Impl._construct(self, other._parameters, other._runway, converter=converter)

        @property
        def parameters(self) -> tuple[TireParameters, ...]:
            """Parameters of each tire."""
            return self._parameters

        def rolling_radius(self, deflection, which: int = 0):
            """Speed over spin of a wheel that rolls freely, m, at a deflection, m."""
            return self._laws[which].rolling_radius(deflection)

        def set_factors(
            self,
            context,
            *,
            which: int = 0,
            stiffness=1.0,
            damping=1.0,
            friction=1.0,
        ) -> None:
            """Sets the factors on the law of one tire in a context of this system.

            Raises:
                ValueError: a factor below zero, a tire that is not there.
            """
            require_index(self.get_name() or "tire", which, self._n)
            factors = [stiffness, damping, friction]
            for name, value in zip(TireTunables.get_fields(), factors):
                require(self.get_name() or "tire", name, value, "", at_least=0.0)
            vector = context.get_mutable_numeric_parameter(self._tunables)
            for i, factor in enumerate(factors):
                vector.SetAtIndex(3 * which + i, factor)

        def clearance(self, context, which: int = 0):
            """Height of a tire's lowest point over the runway below it, m.

            Only that point: on a profile its clearance is vertical, not the nearest
            distance. The context is one of this system, `wheel` connected or fixed.
            """
            x, y, z, _, _, a_z = self._wheels(context)[which, :6].tolist()
            reach = self._parameters[which].radius * (1.0 - a_z * a_z) ** 0.5
            return z - reach - self._runway.height(x, y)

        def _wheels(self, context):
            return self._wheel.Eval(context).reshape(self._n, 12)

        def _factors(self, context):
            parameter = context.get_numeric_parameter(self._tunables)
            return parameter.CopyToVector().reshape(self._n, 3)

        def _calc_law(self, context, value):
            """(n, 16) see TireLaw.contact."""
            wheels, factors = self._wheels(context), self._factors(context)
            slips = None
            if self._lagged:
                state = context.get_continuous_state_vector().CopyToVector()
                slips = state.reshape(-1, 2)
            if len(self._kinds) == 1:
                value.set_value(self._kinds[0][0].contacts(wheels, slips, factors))
                return
            found = np.empty((self._n, 16), dtype=wheels.dtype)
            for law, rows, states in self._kinds:
                lagged = None if states is None or slips is None else slips[states]
                found[rows] = law.contacts(wheels[rows], lagged, factors[rows])
            value.set_value(found)

        def _calc_wrench(self, context, output):
            output.SetFromVector(self._contact.Eval(context)[:, :6].ravel())

        def _calc_contact(self, context, output):
            rows = [_contact(*row) for row in self._contact.Eval(context).tolist()]
            output.SetFromVector([value for row in rows for value in row])

        def _calc_energy(self, context, output):
            total = T(0.0)
            for law, wheel, factors in zip(
                self._laws, self._wheels(context), self._factors(context)
            ):
                deflection = law.deflection(wheel.tolist())
                total = total + law.energy(deflection, factors[0])
            output.SetAtIndex(0, total)

        def _calc_dissipated_power(self, context, output):
            output.SetAtIndex(0, self._contact.Eval(context)[:, 13].sum())

        def DoCalcTimeDerivatives(self, context, derivatives):
            if self._lagged:
                rates = self._contact.Eval(context)[self._lagged, 14:16]
                derivatives.get_mutable_vector().SetFromVector(rates.ravel())

    return Impl


def _kinds(parameters: Sequence[TireParameters], runway: Runway) -> list[tuple]:
    """Law, tires and rows of lagged slips (None without) of each kind of tire."""
    members: list[list[int]] = []
    for i, p in enumerate(parameters):
        alike = [m for m in members if parameters[m[0]] == p]
        if alike:
            alike[0].append(i)
        else:
            members.append([i])
    lagged = [i for i, p in enumerate(parameters) if p.lagged]
    return [
        (
            TireLaw(parameters[m[0]], runway),
            m,
            [lagged.index(i) for i in m] if parameters[m[0]].lagged else None,
        )
        for m in members
    ]


Tire = default_instantiation(Tire_)
