"""Compiled laws are the formulas themselves, for every kind of tire and strut."""

import numpy as np
import pytest

from systems.runway.runway import Runway
from systems.shock_absorber.gas_spring import GasSpring, SecondChamber
from systems.shock_absorber.shock_absorber import ShockAbsorber
from systems.shock_absorber.strut_law import StrutLaw
from systems.shock_absorber.strut_parameters import ShockAbsorberParameters
from systems.tire.slip import TabulatedSlip
from systems.tire.tire_law import TireLaw
from systems.tire.tire_parameters import TireParameters
from systems.tools.grid import Grid
from systems.tools.table import Table

_SECOND = SecondChamber(precharge=90e3, gas_length=0.1)
_PIN = Table((0.0, 0.4), (1.0, 3.0))
_VALVE = Grid((0.0, 0.4), (0.0, 1.0, 3.0), ((1.0, 1.0, 0.5), (2.0, 1.5, 0.7)))
STRUTS = {
    "plain": {},
    "heat, friction": {
        "thermal_time": 10.0,
        "seal_friction": 0.05,
        "bearing_friction": 0.1,
        "axle_arm": 0.8,
    },
    "two chambers with heat": {
        "gas": GasSpring(precharge=45e3, gas_length=0.52, second=_SECOND),
        "thermal_time": 10.0,
    },
    "metering pin": {"compression_metering": _PIN, "rebound_metering": _PIN},
    "valves, compressible oil": {
        "compression_metering": _VALVE,
        "rebound_metering": _VALVE,
        "oil_stiffness": 6e7,
    },
}
_OVER_DEFLECTION = Table((0.0, 0.3), (0.0, 4e5))
TIRES = {
    "plain": {"damping": 3e3},
    "carcass": {
        "stiffness": Table((0.0, 0.1, 0.2), (0.0, 1e5, 3e5)),
        "cornering": _OVER_DEFLECTION,
        "trail": Table((0.0, 0.3), (0.0, 0.3)),
        "fore_aft_stiffness": 1e6,
        "lateral_stiffness": 6e5,
        "hysteresis": 0.1,
        "rolling_resistance": 0.012,
        "bottoming_deflection": 0.15,
    },
    "tabulated": {
        "slip": TabulatedSlip(table=Table((0.0, 0.1, 1.0), (0.0, 0.7, 0.5))),
        "rolling_radius": Table((0.0, 0.2), (0.58, 0.5)),
        "relaxation_length": 0.3,
    },
}


@pytest.mark.parametrize("name", STRUTS)
def test_strut(name):
    given = {"gas": GasSpring(precharge=45e3, gas_length=0.52), **STRUTS[name]}
    parameters = ShockAbsorberParameters(
        max_stroke=0.47, compression_damping=6e4, rebound_damping=2e5, **given
    )
    law, random = StrutLaw(parameters), np.random.default_rng(1)
    for _ in range(60):
        s, rate = random.uniform(-0.01, 0.48), random.uniform(-3.0, 3.0)
        load, p = random.uniform(0.0, 1e4, 3), np.array(parameters.tunables)
        state = None
        if parameters.initial_state:
            state = random.uniform(0.9, 1.1, len(parameters.initial_state))
            if parameters.oil_stiffness is not None:
                state[-1] = s + random.uniform(-0.01, 0.005)
        found = law.response_of_floats(np.array([s, rate]), load, p, state)
        listed = None if state is None else state.tolist()
        plain = law.response(s, rate, load.tolist(), p.tolist(), listed)
        for a, b in zip(_numbers(found), _numbers(plain)):
            assert a == pytest.approx(b, rel=1e-11, abs=1e-6)


def _numbers(response):
    return [*response.forces, response.lost_power, *response.rates]


@pytest.mark.parametrize("name", TIRES)
def test_tire(name):
    parameters = TireParameters(**{"radius": 0.584, "stiffness": 2e6, **TIRES[name]})
    law, random = TireLaw(parameters, Runway()), np.random.default_rng(2)
    for _ in range(60):
        axle = np.array([0.05, 1.0, 0.1]) / np.sqrt(1.0125)
        place = [0.0, 0.0, 0.584 - random.uniform(-0.05, 0.2)]
        v = random.uniform([-70.0, -3.0, -3.0], [2.0, 3.0, 3.0])
        w = random.uniform([-1.0, -120.0, -1.0], [1.0, 2.0, 1.0])
        wheel, factors = np.concatenate([place, axle, v, w]), random.uniform(0.5, 1, 3)
        state = random.uniform(-0.5, 0.5, 2) if parameters.lagged else None
        slips = None if state is None else state[None]
        found = law.contacts(wheel[None], slips, factors[None])[0]
        listed = None if state is None else state.tolist()
        plain = law.contact(wheel.tolist(), listed, factors.tolist())
        assert found == pytest.approx(np.array(plain), rel=1e-11, abs=1e-6)


def test_damping_follows_the_command():
    """A semi-active valve scales the orifice's part, in either scalar type."""
    parameters = ShockAbsorberParameters(
        gas=GasSpring(precharge=45e3, gas_length=0.52),
        max_stroke=0.47,
        compression_damping=6e4,
        rebound_damping=2e5,
    )
    for system in (ShockAbsorber(parameters), ShockAbsorber(parameters).ToAutoDiffXd()):
        context = system.CreateDefaultContext()
        system.GetInputPort("strut_state").FixValue(context, [0.2, 1.5])
        components = system.GetOutputPort("components")
        gas, passive, *_ = components.Eval(context)
        system.GetInputPort("damping_command").FixValue(context, [2.5])
        same, active, *_ = components.Eval(context)
        assert _number(passive) == pytest.approx(6e4 * 1.5**2)
        assert _number(active) == pytest.approx(2.5 * 6e4 * 1.5**2)
        assert _number(same) == _number(gas)


def _number(x):
    return x if isinstance(x, float) else x.value()
