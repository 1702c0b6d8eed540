"""A tyre on a runway, as a Drake system; the law is in `tire_law`."""

import math

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
from systems.tire.tire_law import TireLaw, TireParameters
from systems.tools.checks import require
from systems.tools.template import default_instantiation, for_scalars
from systems.tools.weak_methods import weakly

TireContact = namedview(
    "TireContact", ["deflection", "F_z", "F_x", "F_y", "slip", "slip_angle"]
)
"""The elements of the port `contact`."""

TireTunables = namedview("TireTunables", ["stiffness", "damping", "friction"])
"""The numeric parameters: factors on the law's stiffness, damping and friction."""


@for_scalars
def Tire_(T):
    class Impl(LeafSystem_[T]):
        """A tyre: `Tire(parameters, runway)`; the runway is flat and dry by default.

        | port | size | unit | frame and sign |
        |---|---|---|---|
        | in `wheel` | 12 | m, -, m/s, rad/s | p_WC, axle direction (unit vector, to |
        |  |  |  | starboard at rest), v_WC, ω_WH; world frame |
        | out `wrench` | 6 | N m, N | [torque; force] of the ground on the wheel at |
        |  |  |  | its centre; world frame |
        | out `contact` | 6 | m, N, -, rad | `TireContact` |
        | out `energy` | 1 | J | stored in the radial deflection |
        | out `dissipated_power` | 1 | W | damping and sliding |

        `contact`: deflection (negative: clearance); F_z along the surface normal; F_x
        along axle × normal, aft at rest: positive as drag of an aircraft rolling
        forward; F_y across, to starboard at rest; slip (v_x - r_r ω)/v_x, positive for
        braking when rolling forward, lagged where there is a relaxation length; slip
        angle, positive for sliding to starboard. In the air all but the deflection is
        zero.

        States: none; with a relaxation length, given or from the carcass, the lagged
        slips along and across.
        Numeric parameters: `TireTunables`, factors on the law, 1 each; `set_factors`.

        Energy: wrench power on the wheel + d(energy)/dt + dissipated_power = 0. The
        dissipated power is never negative without a relaxation length and without a
        pneumatic trail; it contains what the carcass stores for a moment across and
        along, and the work of the aligning moment on a wheel that yaws.
        """

        def _construct(
            self,
            parameters: TireParameters,
            runway: Runway | None = None,
            converter=None,
        ):
            LeafSystem_[T].__init__(self, converter=converter)
            self._parameters = parameters
            self._runway = Runway() if runway is None else runway
            self._law = TireLaw(parameters, self._runway)
            self._lagged = parameters.lagged
            self._tunables = NumericParameterIndex(
                self.DeclareNumericParameter(BasicVector_[T]([1.0, 1.0, 1.0]))
            )
            self._wheel = self.DeclareVectorInputPort("wheel", 12)
            geometry = {
                self._wheel.ticket(),
                self.numeric_parameter_ticket(self._tunables),
            }
            everything = set(geometry)
            if self._lagged:
                self.DeclareContinuousState(BasicVector_[T]([0.0, 0.0]))
                everything.add(self.xc_ticket())
            # The law is evaluated once for wrench, contact, power and lagged slips.
            self._contact = self.DeclareCacheEntry(
                "law",
                ValueProducer(
                    allocate=lambda: Value(object()), calc=weakly(self._calc_law)
                ),
                everything,
            )
            law = {self._contact.ticket()}
            for name, size, calc, tickets in (
                ("wrench", 6, weakly(self._calc_wrench), law),
                ("contact", 6, weakly(self._calc_contact), law),
                ("energy", 1, weakly(self._calc_energy), geometry),
                ("dissipated_power", 1, weakly(self._calc_dissipated_power), law),
            ):
                self.DeclareVectorOutputPort(
                    name, size, calc, prerequisites_of_calc=tickets
                )

        def _construct_copy(self, other, converter=None):
            Impl._construct(self, other._parameters, other._runway, converter=converter)

        def rolling_radius(self, deflection):
            """Speed over spin of a wheel that rolls freely, m, at a deflection, m."""
            return self._law.rolling_radius(deflection)

        @property
        def parameters(self) -> TireParameters:
            return self._parameters

        def set_factors(
            self, context, *, stiffness=1.0, damping=1.0, friction=1.0
        ) -> None:
            """Sets the factors on the law in a context of this system."""
            factors = [stiffness, damping, friction]
            for name, value in zip(TireTunables.get_fields(), factors):
                require(self.get_name() or "tire", name, value, "", at_least=0.0)
            parameter = context.get_mutable_numeric_parameter(self._tunables)
            parameter.SetFromVector(factors)

        def clearance(self, context):
            """Height of the tyre's lowest point over the runway below it, m.

            Only that point: on a profile its clearance is vertical, not the nearest
            distance. The context is one of this system, `wheel` connected or fixed.
            """
            x, y, z, _, _, a_z = self._wheel.Eval(context).tolist()[:6]
            reach = self._parameters.radius * (1.0 - a_z * a_z) ** 0.5
            return z - reach - self._runway.height(x, y)

        def _factors(self, context):
            return context.get_numeric_parameter(self._tunables).CopyToVector().tolist()

        def _calc_law(self, context, value):
            """The law's tuple of values, see TireLaw.contact."""
            slip_state = None
            if self._lagged:
                state = context.get_continuous_state_vector()
                slip_state = state.CopyToVector()
            wheel = self._wheel.Eval(context)
            factors = context.get_numeric_parameter(self._tunables).CopyToVector()
            if T is float:
                contact = self._law.contact_of_floats(wheel, slip_state, factors)
            else:
                slip = None if slip_state is None else slip_state.tolist()
                contact = self._law.contact(wheel.tolist(), slip, factors.tolist())
            value.set_value(contact)

        def _calc_wrench(self, context, output):
            output.SetFromVector(self._contact.Eval(context)[:6])

        def _calc_contact(self, context, output):
            values = self._contact.Eval(context)
            deflection, fz, ft, fl, slip, slide, travel = values[6:13]
            angle = 0.0 * deflection
            if deflection > 0.0 and (slide != 0.0 or travel != 0.0):
                angle = (math.atan2 if T is float else atan2)(slide, abs(travel))
            # Forward is -t; the curve's slip is along t.
            output.SetFromVector([deflection, fz, ft, fl, -slip, angle])

        def _calc_energy(self, context, output):
            deflection = self._law.deflection(self._wheel.Eval(context).tolist())
            output.SetAtIndex(
                0, self._law.energy(deflection, self._factors(context)[0])
            )

        def _calc_dissipated_power(self, context, output):
            output.SetAtIndex(0, self._contact.Eval(context)[13])

        def DoCalcTimeDerivatives(self, context, derivatives):
            if self._lagged:
                derivatives.get_mutable_vector().SetFromVector(
                    self._contact.Eval(context)[14:16]
                )

    return Impl


Tire = default_instantiation(Tire_)
