"""Shock absorbers, as a Drake system; the law is in `strut_law`."""

from collections.abc import Sequence

import numpy as np
from pydrake.common.containers import namedview
from pydrake.common.value import Value
from pydrake.systems.framework import (
    BasicVector_,
    LeafSystem_,
    NumericParameterIndex,
    ValueProducer,
)

from systems.shock_absorber.strut_law import StrutLaw
from systems.shock_absorber.strut_parameters import (
    ShockAbsorberParameters,
    ShockAbsorberTunables,
)
from systems.tools.checks import require_index, require_some
from systems.tools.template import default_instantiation, for_scalars
from systems.tools.weak_methods import weakly

StrutState = namedview("StrutState", ["stroke", "rate"])
StrutComponents = namedview("StrutComponents", ["gas", "damping", "friction", "stops"])


@for_scalars
def ShockAbsorber_(T):
    def _response(law, motion, load, p, state):
        if T is float:
            return law.response_of_floats(motion, load, p, state)
        s, rate = motion.tolist()
        state = None if state is None else state.tolist()
        return law.response(s, rate, load.tolist(), p.tolist(), state)

    class Impl(LeafSystem_[T]):
        """One shock absorber, `ShockAbsorber(parameters)`, or n: `ShockAbsorber([p])`.

        What passes a port is of one after the other; several in one system take a
        fraction of the time of as many systems.

        | port | size | unit | frame and sign |
        |---|---|---|---|
        | in `strut_state` | 2 n | m, m/s | stroke, rate; positive in compression |
        | in `side_load` (optional) | 3 n | N, N m | force across the strut at the axle,
          moment bending with it, moment across that; of `SideLoad` |
        | in `damping_command` (optional) | n | | factor on the damping of the orifice,
          > 0: a semi-active valve |
        | out `force` | n | N | along the strut, positive apart |
        | out `energy` | 1 | J | stored in all, zero at zero stroke |
        | out `dissipated_power` | 1 | W | of all, >= 0 |
        | out `components` | 4 n | N | gas, damping, friction, stops, positive apart |
        | out `gas_pressure` (where all areas are given) | n | Pa | absolute |

        States, of one after the other: with `thermal_time` the heat of each gas
        chamber, with `oil_stiffness` the stroke of the gas, see `strut_law`; else none.
        `settle` sets them to what a long time at the present stroke leaves.

        Numeric parameters: one vector with the `ShockAbsorberTunables` of each;
        `set_tunables`. A side load that is not connected is zero, a command 1.

        Raises:
            ValueError: no parameters at all.
        """

        def _construct(
            self,
            parameters: ShockAbsorberParameters | Sequence[ShockAbsorberParameters],
            converter=None,
        ):
            LeafSystem_[T].__init__(self, converter=converter)
            single = isinstance(parameters, ShockAbsorberParameters)
            self._parameters = each = (parameters,) if single else tuple(parameters)
            require_some("shock absorber", each)
            self._laws = [StrutLaw(p) for p in each]
            self._n = n = len(each)
            tunables = [value for p in each for value in p.tunables]
            self._tunables = NumericParameterIndex(
                self.DeclareNumericParameter(BasicVector_[T](tunables))
            )
            self._state = self.DeclareVectorInputPort("strut_state", 2 * n)
            self._side_load = self.DeclareVectorInputPort("side_load", 3 * n)
            self._command = self.DeclareVectorInputPort("damping_command", n)
            self._no_load = np.array([[T(0.0)] * 3] * n)
            parameter = self.numeric_parameter_ticket(self._tunables)
            state = {self._state.ticket(), parameter}
            self._slices = _slices([len(p.initial_state) for p in each])
            initial = [value for p in each for value in p.initial_state]
            if initial:
                self.DeclareContinuousState(BasicVector_[T](initial))
                state.add(self.xc_ticket())
            self._has_state = bool(initial)
            everything = {*state, self._side_load.ticket(), self._command.ticket()}
            # The laws are evaluated once for force, components and power.
            self._response = self.DeclareCacheEntry(
                "law",
                ValueProducer(
                    allocate=lambda: Value(object()), calc=weakly(self._calc_law)
                ),
                everything,
            )
            law = {self._response.ticket()}
            for name, size, calc, tickets in (
                ("force", n, weakly(self._calc_force), law),
                ("energy", 1, weakly(self._calc_energy), state),
                ("dissipated_power", 1, weakly(self._calc_dissipated_power), law),
                ("components", 4 * n, weakly(self._calc_components), law),
            ):
                self.DeclareVectorOutputPort(
                    name, size, calc, prerequisites_of_calc=tickets
                )
            if all(p.gas.area is not None for p in each):
                self.DeclareVectorOutputPort(
                    "gas_pressure",
                    n,
                    weakly(self._calc_gas_pressure),
                    prerequisites_of_calc=state,
                )

        def _construct_copy(self, other, converter=None):
            Impl._construct(self, other._parameters, converter=converter)

        @property
        def parameters(self) -> tuple[ShockAbsorberParameters, ...]:
            """Parameters of each shock absorber."""
            return self._parameters

        def set_tunables(
            self,
            context,
            *,
            which: int = 0,
            precharge=None,
            gas_length=None,
            exponent=None,
            compression_damping=None,
            rebound_damping=None,
            seal_friction=None,
            bearing_friction=None,
        ) -> None:
            """Sets numeric parameters of one in a context of this system; others stay.

            Raises:
                ValueError: a value is out of its range in ShockAbsorberParameters, a
                    shock absorber that is not there.
            """
            require_index(self.get_name() or "shock absorber", which, self._n)
            given = {
                "precharge": precharge,
                "gas_length": gas_length,
                "exponent": exponent,
                "compression_damping": compression_damping,
                "rebound_damping": rebound_damping,
                "seal_friction": seal_friction,
                "bearing_friction": bearing_friction,
            }
            values = ShockAbsorberTunables(self._all_tunables(context)[which])
            for name, value in given.items():
                if value is not None:
                    setattr(values, name, value)
            self._parameters[which].with_tunables(values)
            vector = context.get_mutable_numeric_parameter(self._tunables)
            for i, value in enumerate(values[:]):
                vector.SetAtIndex(len(values[:]) * which + i, value)

        def settle(self, context) -> None:
            """Sets gas and oil of all to a long rest at the present strokes.

            The context is one of this system, `strut_state` connected or fixed.
            """
            if self._has_state:
                each = zip(self._laws, *self._inputs(context))
                settled = [x for law, s, p, _ in each for x in law.settled(s, p)]
                context.get_mutable_continuous_state_vector().SetFromVector(settled)

        def _all_tunables(self, context):
            """(n, tunables)."""
            vector = context.get_numeric_parameter(self._tunables).CopyToVector()
            return vector.reshape(self._n, -1)

        def _inputs(self, context):
            """strokes, tunables, states: of each, as lists."""
            strokes = self._state.Eval(context)[::2].tolist()
            states = [s if s is None else s.tolist() for s in self._states(context)]
            return strokes, self._all_tunables(context).tolist(), states

        def _states(self, context):
            """States of each shock absorber, None where it has none."""
            if not self._has_state:
                return [None] * self._n
            state = context.get_continuous_state_vector().CopyToVector()
            return [None if part is None else state[part] for part in self._slices]

        def _calc_law(self, context, value):
            """The responses, see StrutLaw."""
            motion = self._state.Eval(context).reshape(self._n, 2)
            tunables, load = self._all_tunables(context), self._no_load
            if self._side_load.HasValue(context) and (tunables[:, 6] > 0.0).any():
                load = self._side_load.Eval(context).reshape(self._n, 3)
            if self._command.HasValue(context):
                command = self._command.Eval(context)
                tunables[:, 3:5] = tunables[:, 3:5] * command[:, None]
            given = zip(self._laws, motion, load, tunables, self._states(context))
            value.set_value([_response(*each) for each in given])

        def _calc_force(self, context, output):
            each = self._response.Eval(context)
            output.SetFromVector([response.forces.total for response in each])

        def _calc_energy(self, context, output):
            each = zip(self._laws, *self._inputs(context))
            output.SetAtIndex(0, sum(law.energy(s, p, x) for law, s, p, x in each))

        def _calc_dissipated_power(self, context, output):
            each = self._response.Eval(context)
            output.SetAtIndex(0, sum(response.lost_power for response in each))

        def _calc_components(self, context, output):
            parts = []
            for response in self._response.Eval(context):
                gas, damping, friction, elastic, damper = response.forces
                parts += [gas, damping, friction, elastic + damper]
            output.SetFromVector(parts)

        def _calc_gas_pressure(self, context, output):
            each = zip(self._laws, self._parameters, *self._inputs(context))
            output.SetFromVector(
                [law.gas_force(s, t, x) / p.gas.area for law, p, s, t, x in each]
            )

        def DoCalcTimeDerivatives(self, context, derivatives):
            if self._has_state:
                each = self._response.Eval(context)
                rates = [rate for response in each for rate in response.rates]
                derivatives.get_mutable_vector().SetFromVector(rates)

    return Impl


def _slices(sizes: Sequence[int]) -> list[slice | None]:
    """Where vectors of these sizes lie one after the other; None for nothing."""
    ends = np.cumsum(sizes)
    return [slice(int(b) - a, int(b)) if a else None for a, b in zip(sizes, ends)]


ShockAbsorber = default_instantiation(ShockAbsorber_)
