"""The force law of a shock absorber: gas, oil, friction and both end stops.

The force is positive where it drives fitting and wheel apart, stroke and rate are
positive in compression. Its parts:

    gas       `gas_spring`
    damping   `orifice_damper`
    friction  `friction`: smoothed Coulomb in seals (a share of the gas force) and
              bearings (a share of their reactions to the load across the strut)
    stops     `stops`: bottoming beyond the mechanical stroke, and the extension stop

The extension stop carries the gas preload. With stiffness k_e it is compressed by
s_0 = F_0/k_e at zero stroke, where it holds the gas force exactly: the net force is
zero at rest, and rises continuously with the slope k_e as the stop lets go between
s = 0 and s_0. No load reaches the airframe before touchdown.

Two refinements have states. Heat (`gas_heat`): w of each chamber, 1 at the precharge.
Oil that is compressible is a spring in series with orifice and gas, precharged like
the gas: the stroke of the gas is a state, and damping is what the oil carries beyond
the gas.

Energy: d(energy)/dt + dissipated_power = force × rate, energy zero at rest.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from systems.shock_absorber.gas_heat import available_energy, volumes
from systems.shock_absorber.gas_spring import gas_energy
from systems.shock_absorber.orifice_damper import arrays
from systems.shock_absorber.strut_forces import (
    Chamber,
    Constants,
    heated_gas_force,
    strut_forces,
    strut_forces_of_floats,
)
from systems.shock_absorber.strut_parameters import ShockAbsorberParameters
from systems.tools.compiled import COMPILES
from systems.tools.scalar import Scalar
from systems.tools.stops import contact_energy

Float64 = npt.NDArray[np.float64]

# The gas law is continued along its tangent over the last tenth of the way from the
# mechanical stroke to the end of the gas.
_GAS_LIMIT = 0.9


class StrutForces(NamedTuple):
    """Parts of a strut's force, N, positive apart; floats or AutoDiffXd."""

    gas: Scalar
    damping: Scalar
    friction: Scalar
    stops: Scalar
    stop_damping: Scalar

    @property
    def total(self) -> Scalar:
        """Gas and stops first: their sum is exactly zero at rest."""
        return (
            (self.gas + self.stops) + self.damping + self.friction + self.stop_damping
        )

    @property
    def dissipating(self) -> Scalar:
        """The part that turns power into heat: never with the motion."""
        return self.damping + self.friction + self.stop_damping


class StrutResponse(NamedTuple):
    """Forces; power that turns into heat, W, >= 0; time derivatives of the state."""

    forces: StrutForces
    lost_power: Scalar
    rates: list[Scalar]


class StrutLaw:
    """The force law of one strut: pure functions of stroke, rate, side load and state.

    `tunables` are the seven values of ShockAbsorberTunables, floats or AutoDiffXd;
    `state` is as in `initial_state`, or None: adiabatic gas and incompressible oil.
    """

    def __init__(self, parameters: ShockAbsorberParameters) -> None:
        p = parameters
        self._p = p
        second = p.gas.second
        self._second = (
            (float(second.precharge), float(second.gas_length), float(second.exponent))
            if second
            else None
        )
        self._second_length = self._second[1] if self._second else 0.0
        numbers = Constants(
            max_stroke=float(p.max_stroke),
            extension_stop=float(p.extension_stop_stiffness),
            bottoming_stop=float(p.bottoming_stop_stiffness),
            stop_damping=float(p.stop_damping),
            axle_arm=float(p.axle_arm),
            bearing_distance=float(p.bearing_distance),
            transition=float(p.friction_transition),
        )
        metering = p.compression_metering, p.rebound_metering
        states = p.thermal_time, p.oil_stiffness
        self._constants = (numbers, self._second, *metering, *states)
        self._arrays = (numbers, self._second, *map(arrays, metering), *states)

    def _limit(self, gas_length: Scalar) -> Scalar:
        length = gas_length + self._second_length
        if length <= self._p.max_stroke:
            raise ValueError(
                f"shock absorber: numeric parameter gas_length makes {length} m of "
                f"gas, expected > {self._p.max_stroke} m, the mechanical stroke"
            )
        return length - (1.0 - _GAS_LIMIT) * (length - self._p.max_stroke)

    def _chambers(self, tunables: list[Scalar]) -> list[Chamber]:
        main = (tunables[0], tunables[1], tunables[2])
        return [main] if self._second is None else [main, self._second]

    def forces(
        self,
        s: Scalar,
        rate: Scalar,
        side_load: Scalar,
        tunables: list[Scalar],
        state: list[Scalar] | None = None,
        moment: tuple[Scalar, Scalar] = (0.0, 0.0),
    ) -> StrutForces:
        """The parts of the force at stroke (m), rate (m/s) and side load (N).

        The moment (N m) is that of the side load's surplus, see `bearing_reactions`.
        """
        return self.response(s, rate, [side_load, *moment], tunables, state).forces

    def response(
        self,
        s: Scalar,
        rate: Scalar,
        load: Sequence[Scalar],
        tunables: list[Scalar],
        state: list[Scalar] | None = None,
    ) -> "StrutResponse":
        """Forces, power lost and rates of the state.

        Args:
            s, rate: m, m/s.
            load: side load, N, and the moments of its surplus, N m.
            tunables, state: as everywhere here.
        """
        limit = self._limit(tunables[1])
        found = strut_forces(
            s, rate, load, tunables, *self._split(state), limit, *self._constants
        )
        return self._as_response(found)

    def response_of_floats(
        self, motion: Float64, load: Float64, tunables: Float64, state: Float64 | None
    ) -> "StrutResponse":
        """The same of arrays, compiled; (2) stroke and rate."""
        s, rate = motion.tolist()
        if not COMPILES:
            at = None if state is None else state.tolist()
            return self.response(s, rate, load.tolist(), tunables.tolist(), at)
        limit = float(self._limit(tunables[1]))
        found = strut_forces_of_floats(
            s, rate, load, tunables, *self._split(state), limit, *self._arrays
        )
        return self._as_response(found)

    def _split(self, state: Any) -> tuple[Any, Any]:
        """Stroke of the gas, heat; None where there is no such state."""
        if state is None:
            return None, None
        heats = self._p.heats
        oil = None if self._p.oil_stiffness is None else state[-1]
        return oil, state[:heats] if heats else None

    def _as_response(self, found: tuple[Scalar, ...]) -> "StrutResponse":
        rates = [*found[6 : 6 + self._p.heats]]
        if self._p.oil_stiffness is not None:
            rates.append(found[8])
        return StrutResponse(StrutForces(*found[:5]), found[5], rates)

    def gas_force(
        self, s: Scalar, tunables: list[Scalar], state: list[Scalar] | None = None
    ) -> Scalar:
        """Force of the gas alone, N."""
        oil, heat = self._split(state)
        main = (tunables[0], tunables[1], tunables[2])
        at = s if oil is None else oil
        return heated_gas_force(at, main, self._second, heat, self._limit(tunables[1]))

    def energy(
        self, s: Scalar, tunables: list[Scalar], state: list[Scalar] | None = None
    ) -> Scalar:
        """Energy stored in gas, oil and stops, zero at zero stroke, J."""
        p = self._p
        f0 = tunables[0]
        k = p.extension_stop_stiffness
        preload = f0 / k
        return (
            self._gas_energy(s, tunables, state)
            + self._oil_energy(s, f0, state)
            + contact_energy(preload - s, k)
            - 0.5 * f0 * preload
            + contact_energy(s - p.max_stroke, p.bottoming_stop_stiffness)
        )

    def _gas_energy(
        self, s: Scalar, tunables: list[Scalar], state: list[Scalar] | None
    ) -> Scalar:
        main, limit = (tunables[0], tunables[1], tunables[2]), self._limit(tunables[1])
        oil, heat = self._split(state)
        at = s if oil is None else oil
        if heat is None:
            return gas_energy(at, main, self._second, limit)
        inside = at if at < limit else limit
        x = volumes(inside, main, self._second, heat)
        energy = available_energy(x[0], main, heat[0])
        if self._second is not None:
            energy = energy + available_energy(x[1], self._second, heat[1])
        if at < limit:
            return energy
        # Along the tangent, as the force.
        return energy + 0.5 * (at - limit) * (
            heated_gas_force(limit, main, self._second, heat, limit)
            + heated_gas_force(at, main, self._second, heat, limit)
        )

    def _oil_energy(self, s: Scalar, f0: Scalar, state: list[Scalar] | None) -> Scalar:
        k = self._p.oil_stiffness
        if state is None or k is None:
            return 0.0
        pressed = s - state[-1]
        return pressed * (f0 + 0.5 * k * pressed)

    def rates(
        self, s: Scalar, tunables: list[Scalar], state: list[Scalar]
    ) -> list[Scalar]:
        """Time derivatives of the state; the rate of the stroke has no part in them."""
        return self.response(s, 0.0 * s, [0.0, 0.0, 0.0], tunables, state).rates

    def settled(self, s: float, tunables: list[float]) -> list[float]:
        """The state after a long time at a stroke (m): as warm as the walls, no flow.

        The two chambers share the stroke isothermally.
        """
        p = self._p
        low, high = s - 0.5 * p.max_stroke, s
        for _ in range(60 if p.oil_stiffness is not None else 0):
            middle = 0.5 * (low + high)
            assert p.oil_stiffness is not None
            carried = tunables[0] + p.oil_stiffness * (s - middle)
            gas = self.gas_force(middle, tunables, self._warm(middle, tunables))
            low, high = (middle, high) if gas < carried else (low, middle)
        state = self._warm(high, tunables)
        return state[: p.heats] + [high] * (p.oil_stiffness is not None)

    def _warm(self, gas_stroke: float, tunables: list[float]) -> list[float]:
        """Isothermal w of each chamber at a stroke of the gas, and that stroke."""
        if not self._p.heats:
            return [gas_stroke]
        chambers, limit = self._chambers(tunables), self._limit(tunables[1])
        isothermal = [(force, length, 1.0) for force, length, _ in chambers]
        second = isothermal[1] if len(chambers) == 2 else None
        x = volumes(min(gas_stroke, limit), isothermal[0], second, [1.0, 1.0])
        return [v ** (c[2] - 1.0) for v, c in zip(x, chambers)] + [gas_stroke]
