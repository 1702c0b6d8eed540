"""A shock absorber, as a Drake system; the law is in `strut_law`."""

import numpy as np
from pydrake.common.containers import namedview
from pydrake.common.value import Value
from pydrake.systems.framework import (
    BasicVector_,
    LeafSystem_,
    NumericParameterIndex,
    ValueProducer,
)

from systems.shock_absorber.strut_law import (
    ShockAbsorberParameters,
    ShockAbsorberTunables,
    StrutLaw,
)
from systems.tools.template import default_instantiation, for_scalars
from systems.tools.weak_methods import weakly

StrutState = namedview("StrutState", ["stroke", "rate"])
StrutComponents = namedview("StrutComponents", ["gas", "damping", "friction", "stops"])


@for_scalars
def ShockAbsorber_(T):
    class Impl(LeafSystem_[T]):
        """A shock absorber: `ShockAbsorber(parameters)`.

        | port | size | unit | frame and sign |
        |---|---|---|---|
        | in `strut_state` | 2 | m, m/s | stroke, rate; positive in compression |
        | in `side_load` (optional) | 3 | N, N m | force across the strut at the axle,
          moment bending with it, moment across that; of `SideLoad` |
        | in `damping_command` (optional) | 1 | | factor on the damping of the orifice,
          > 0: a semi-active valve |
        | out `force` | 1 | N | along the strut, positive apart |
        | out `energy` | 1 | J | stored, zero at zero stroke |
        | out `dissipated_power` | 1 | W | >= 0 |
        | out `components` | 4 | N | gas, damping, friction, stops, positive apart |
        | out `gas_pressure` (where the area is given) | 1 | Pa | absolute |

        States: with `thermal_time` the heat of each gas chamber, with `oil_stiffness`
        the stroke of the gas, see `strut_law`; else none. `settle` sets them to what a
        long time at the present stroke leaves.

        Numeric parameters: `ShockAbsorberTunables`; `set_tunables`. A side load that is
        not connected is zero, a command 1.
        """

        def _construct(self, parameters: ShockAbsorberParameters, converter=None):
            LeafSystem_[T].__init__(self, converter=converter)
            self._parameters = parameters
            self._law = StrutLaw(parameters)
            self._tunables = NumericParameterIndex(
                self.DeclareNumericParameter(BasicVector_[T](parameters.tunables))
            )
            self._state = self.DeclareVectorInputPort("strut_state", 2)
            self._side_load = self.DeclareVectorInputPort("side_load", 3)
            self._command = self.DeclareVectorInputPort("damping_command", 1)
            self._no_load = np.array([T(0.0)] * 3)
            parameter = self.numeric_parameter_ticket(self._tunables)
            state = {self._state.ticket(), parameter}
            initial = parameters.initial_state
            if initial:
                self.DeclareContinuousState(BasicVector_[T](initial))
                state.add(self.xc_ticket())
            self._has_state = bool(initial)
            everything = {*state, self._side_load.ticket(), self._command.ticket()}
            # The law is evaluated once for force, components and power.
            self._response = self.DeclareCacheEntry(
                "law",
                ValueProducer(
                    allocate=lambda: Value(object()), calc=weakly(self._calc_law)
                ),
                everything,
            )
            law = {self._response.ticket()}
            for name, size, calc, tickets in (
                ("force", 1, weakly(self._calc_force), law),
                ("energy", 1, weakly(self._calc_energy), state),
                ("dissipated_power", 1, weakly(self._calc_dissipated_power), law),
                ("components", 4, weakly(self._calc_components), law),
            ):
                self.DeclareVectorOutputPort(
                    name, size, calc, prerequisites_of_calc=tickets
                )
            if parameters.gas.area is not None:
                self.DeclareVectorOutputPort(
                    "gas_pressure",
                    1,
                    weakly(self._calc_gas_pressure),
                    prerequisites_of_calc=state,
                )

        def _construct_copy(self, other, converter=None):
            Impl._construct(self, other._parameters, converter=converter)

        @property
        def parameters(self) -> ShockAbsorberParameters:
            return self._parameters

        def set_tunables(
            self,
            context,
            *,
            precharge=None,
            gas_length=None,
            exponent=None,
            compression_damping=None,
            rebound_damping=None,
            seal_friction=None,
            bearing_friction=None,
        ) -> None:
            """Sets numeric parameters in a context of this system; others stay.

            Raises:
                ValueError: a value is out of its range in ShockAbsorberParameters.
            """
            given = {
                "precharge": precharge,
                "gas_length": gas_length,
                "exponent": exponent,
                "compression_damping": compression_damping,
                "rebound_damping": rebound_damping,
                "seal_friction": seal_friction,
                "bearing_friction": bearing_friction,
            }
            vector = context.get_mutable_numeric_parameter(self._tunables)
            values = ShockAbsorberTunables(vector.CopyToVector())
            for name, value in given.items():
                if value is not None:
                    setattr(values, name, value)
            self._parameters.with_tunables(values)
            vector.SetFromVector(values[:])

        def settle(self, context) -> None:
            """Sets gas and oil to a long rest at the present stroke.

            The context is one of this system, `strut_state` connected or fixed.
            """
            if self._has_state:
                s, p, _ = self._inputs(context)
                settled = self._law.settled(s, p)
                context.get_mutable_continuous_state_vector().SetFromVector(settled)

        def _inputs(self, context):
            """stroke, tunables, state."""
            s = self._state.Eval(context).tolist()[0]
            p = context.get_numeric_parameter(self._tunables).CopyToVector().tolist()
            state = self._own_state(context)
            return s, p, None if state is None else state.tolist()

        def _own_state(self, context):
            if not self._has_state:
                return None
            return context.get_continuous_state_vector().CopyToVector()

        def _calc_law(self, context, value):
            """The response, see StrutLaw."""
            motion = self._state.Eval(context)
            p = context.get_numeric_parameter(self._tunables).CopyToVector()
            load = self._no_load
            if p[6] > 0.0 and self._side_load.HasValue(context):
                load = self._side_load.Eval(context)
            state = self._own_state(context)
            if self._command.HasValue(context):
                p[3:5] = p[3:5] * self._command.Eval(context)[0]
            if T is float:
                found = self._law.response_of_floats(motion, load, p, state)
            else:
                s, rate = motion.tolist()
                state = None if state is None else state.tolist()
                found = self._law.response(s, rate, load.tolist(), p.tolist(), state)
            value.set_value(found)

        def _calc_force(self, context, output):
            output.SetAtIndex(0, self._response.Eval(context).forces.total)

        def _calc_energy(self, context, output):
            s, p, state = self._inputs(context)
            output.SetAtIndex(0, self._law.energy(s, p, state))

        def _calc_dissipated_power(self, context, output):
            output.SetAtIndex(0, self._response.Eval(context).lost_power)

        def _calc_components(self, context, output):
            forces = self._response.Eval(context).forces
            gas, damping, friction, elastic, damper = forces
            output.SetFromVector([gas, damping, friction, elastic + damper])

        def _calc_gas_pressure(self, context, output):
            s, p, state = self._inputs(context)
            area = self._parameters.gas.area
            output.SetAtIndex(0, self._law.gas_force(s, p, state) / area)

        def DoCalcTimeDerivatives(self, context, derivatives):
            if self._has_state:
                derivatives.get_mutable_vector().SetFromVector(
                    self._response.Eval(context).rates
                )

    return Impl


ShockAbsorber = default_instantiation(ShockAbsorber_)
