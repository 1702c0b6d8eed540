"""Heat of the gas, compressible oil, orifices with valves: limits, energy, inverses.

Heat is checked against the first law in temperatures and volumes, integrated without a
line of the systems.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydrake.autodiffutils import InitializeAutoDiff
from scipy.integrate import solve_ivp

from systems.shock_absorber.gas_heat import available_energy, volumes
from systems.shock_absorber.gas_spring import (
    GasSpring,
    SecondChamber,
    polytropic_energy,
)
from systems.shock_absorber.orifice_damper import orifice_force, orifice_rate
from systems.shock_absorber.orifice_network import OrificeNetwork
from systems.shock_absorber.shock_absorber import ShockAbsorber
from systems.shock_absorber.strut_law import StrutLaw
from systems.shock_absorber.strut_parameters import ShockAbsorberParameters
from systems.tools.grid import Grid
from systems.tools.table import Table
from tests.systems.drop_rig import Rig, drop
from tests.systems.shock_absorber.test_drop_test_laws import MAIN_LEG

ONE = GasSpring(precharge=45e3, gas_length=0.52)
TWO = GasSpring(
    precharge=12e3,
    gas_length=0.31,
    exponent=1.2,
    second=SecondChamber(precharge=60e3, gas_length=0.15, exponent=1.35),
)


def strut(gas=ONE, **changes) -> ShockAbsorberParameters:
    values = {
        "gas": gas,
        "max_stroke": 0.9 * gas.total_length,
        "compression_damping": 45e3,
        "rebound_damping": 180e3,
        "thermal_time": 10.0,
    }
    return ShockAbsorberParameters(**values | changes)


# --- heat


def forced(period: float, tau: float) -> tuple[float, float, float]:
    """Largest gas force, work lost in the second cycle, and the work of its half
    stroke, of a sine stroke of 0.4 m.
    """
    parameters = strut(thermal_time=tau)
    law, p = StrutLaw(parameters), parameters.tunables
    w = 2.0 * math.pi / period

    def stroke(t):
        return 0.2 * (1.0 - math.cos(w * t)), 0.2 * w * math.sin(w * t)

    def rhs(t, y):
        s, rate = stroke(t)
        return [*law.rates(s, p, [y[0]]), law.gas_force(s, p, [y[0]]) * rate]

    run = solve_ivp(
        rhs, (0, 2 * period), [1.0, 0.0], rtol=1e-9, atol=1e-9, dense_output=True
    )
    times = np.linspace(period, 2 * period, 201)
    force = [law.gas_force(stroke(t)[0], p, [run.sol(t)[0]]) for t in times]
    work = [run.sol(t)[1] for t in times]
    return max(force), work[-1] - work[0], max(work) - work[0]


def test_quick_strokes_are_adiabatic_and_slow_ones_isothermal():
    x = 1.0 - 0.4 / 0.52
    quick, lost, work = forced(period=0.1, tau=100.0)
    # The gas at the walls' temperature on the mean: within the share of the period.
    assert quick == pytest.approx(45e3 * x**-1.4, rel=2e-3)
    assert abs(lost) < 1e-2 * work
    slow, lost, work = forced(period=1e4, tau=1.0)
    assert slow == pytest.approx(45e3 / x, rel=1e-3)
    assert abs(lost) < 1e-2 * work
    between, lost, work = forced(period=60.0, tau=10.0)
    assert 45e3 / x < between < 45e3 * x**-1.4
    assert lost > 0.02 * work


def test_force_is_that_of_the_first_law_in_temperature_and_volume():
    """p V = m R T, m c_v T' = -p V' - m c_v (T - T0)/τ, by scipy alone."""
    tau, n, w = 0.5, 1.4, 8.0
    p0v0, t0 = 45e3 * 0.52, 290.0
    mr = p0v0 / t0
    mcv = mr / (n - 1.0)

    def stroke(t):
        return 0.15 * (1.0 - math.cos(w * t)), 0.15 * w * math.sin(w * t)

    def temperature(t, y):
        s, rate = stroke(t)
        force = mr * y[0] / (0.52 - s)  # pressure times area
        return [(force * rate - mcv * (y[0] - t0) / tau) / mcv]

    theirs = solve_ivp(
        temperature, (0, 3), [t0], rtol=1e-10, atol=1e-10, dense_output=True
    )
    parameters = strut(thermal_time=tau)
    law, p = StrutLaw(parameters), parameters.tunables
    ours = solve_ivp(
        lambda t, y: law.rates(stroke(t)[0], p, list(y)),
        (0, 3),
        [1.0],
        rtol=1e-10,
        atol=1e-10,
        dense_output=True,
    )
    for t in np.linspace(0.05, 3.0, 40):
        s = stroke(t)[0]
        expected = mr * theirs.sol(t)[0] / (0.52 - s)
        assert law.gas_force(s, p, list(ours.sol(t))) == pytest.approx(
            expected, rel=2e-6
        )


@given(s=st.floats(0.0, 0.45))
def test_stored_energy_has_the_adiabatic_and_the_isothermal_one_as_limits(s):
    chamber = (45e3, 0.52, 1.4)
    x = volumes(s, chamber, None, [1.0])[0]
    adiabatic = available_energy(x, chamber, 1.0)
    assert adiabatic == pytest.approx(
        polytropic_energy(s, *chamber), rel=1e-9, abs=1e-6
    )
    warm = available_energy(x, chamber, x**0.4)
    isothermal = polytropic_energy(s, 45e3, 0.52, 1.0)
    assert warm == pytest.approx(isothermal, rel=1e-9, abs=1e-6)


CASES = {
    "heat": strut(),
    "two chambers": strut(TWO),
    "oil": strut(thermal_time=None, oil_stiffness=6e7),
    "all": strut(TWO, oil_stiffness=6e7, seal_friction=0.03),
}


@pytest.mark.parametrize("name", CASES)
@given(
    s=st.floats(0.03, 0.4),
    rate=st.floats(-3.0, 3.0),
    heat=st.floats(0.7, 1.2),
    pressed=st.floats(-0.01, 0.005),
)
@settings(max_examples=40)
def test_power_is_stored_or_lost(name, s, rate, heat, pressed):
    parameters = CASES[name]
    law, p = StrutLaw(parameters), parameters.tunables
    state = [heat] * parameters.heats
    if parameters.oil_stiffness:
        state.append(s + pressed)
    forces = law.forces(s, rate, 0.0, p, state)
    speeds, h = law.rates(s, p, state), 1e-7

    def energy(t):
        return law.energy(s + t * rate, p, [v + t * d for v, d in zip(state, speeds)])

    stored = (energy(h) - energy(-h)) / (2.0 * h)
    lost = law.response(s, rate, [0.0, 0.0, 0.0], p, state).lost_power
    assert lost >= 0.0
    scale = abs(forces.total * rate) + abs(stored) + lost + 1e3
    assert stored + lost - forces.total * rate == pytest.approx(0.0, abs=2e-5 * scale)


@pytest.mark.parametrize("name", CASES)
@given(s=st.floats(0.0, 0.4))
@settings(max_examples=30)
def test_settled_state_does_not_change(name, s):
    parameters = CASES[name]
    law, p = StrutLaw(parameters), parameters.tunables
    state = law.settled(s, p)
    assert law.rates(s, p, state) == pytest.approx([0.0] * len(state), abs=1e-4)


def test_static_stroke_is_that_of_isothermal_gas():
    parameters = strut(max_stroke=0.47)
    law, p = StrutLaw(parameters), parameters.tunables
    load = 309.4e3
    for states, expected in ((True, 0.4444), (False, 0.3888)):
        low, high = 0.0, 0.47
        for _ in range(60):
            s = 0.5 * (low + high)
            state = law.settled(s, p) if states else None
            low, high = (s, high) if law.gas_force(s, p, state) < load else (low, s)
        assert s == pytest.approx(expected, abs=2e-4)


# --- oil


@given(force=st.floats(-5e5, 5e5), d=st.floats(1e3, 2e5), metering=st.floats(0.2, 3.0))
def test_flow_through_the_orifice_is_the_inverse_of_its_force(force, d, metering):
    table = Table((0.0, 1.0), (metering, metering))
    rate = orifice_rate(0.2, force, d, d, table, table)
    assert math.copysign(1.0, rate) == math.copysign(1.0, force)
    found = d * metering * rate * math.hypot(rate, 0.1)
    assert found == pytest.approx(force, rel=1e-9, abs=1e-6)
    if abs(rate) > 1.0:
        plain = orifice_force(0.2, rate, d, d, table, table)
        assert plain == pytest.approx(force, rel=0.006)


def test_flow_with_valves_is_the_inverse_too():
    grid = Grid((0.0, 1.0), (0.1, 1.0, 3.0), ((2e4, 2e4, 6e3), (4e4, 4e4, 1e4)))
    for force in (1e3, 1e4, 3e4, 5e4):
        rate = orifice_rate(0.3, force, 1.0, 1.0, grid, grid)
        found = rate * math.hypot(rate, 0.1) * grid.value(0.3, rate)
        assert found == pytest.approx(force, rel=1e-6)


def test_stiff_oil_is_incompressible_and_soft_oil_a_spring_in_series():
    rigid = drop(MAIN_LEG, 0.12, accuracy=1e-6)
    found = {}
    for stiffness in (6e7, 6e8):
        changed = ShockAbsorberParameters(
            **{**vars(MAIN_LEG.shock_absorber), "oil_stiffness": stiffness}
        )
        rig = Rig(**{**vars(MAIN_LEG), "shock_absorber": changed})
        found[stiffness] = drop(rig, 0.12, accuracy=1e-5)
    peak = rigid["strut_force"].max()
    assert found[6e8]["strut_force"].max() == pytest.approx(peak, rel=0.01)
    assert found[6e7]["strut_force"].max() == pytest.approx(peak, rel=0.05)
    system = ShockAbsorber(strut(thermal_time=None, oil_stiffness=1e6))
    context = system.CreateDefaultContext()
    system.GetInputPort("strut_state").FixValue(context, [0.3, 0.0])
    system.settle(context)
    gas_stroke = context.get_continuous_state_vector()[0]
    force = system.GetOutputPort("force").Eval(context)[0]
    assert force == pytest.approx(45e3 + 1e6 * (0.3 - gas_stroke), rel=1e-9)
    assert force == pytest.approx(45e3 * (1 - gas_stroke / 0.52) ** -1.4, rel=1e-9)


def test_system_with_states_has_gradients_and_needs_no_settling_without_them():
    system = ShockAbsorber(CASES["all"])
    point = InitializeAutoDiff([0.2, 1.0])[:, 0]
    converted = system.ToAutoDiffXd()
    context = converted.CreateDefaultContext()
    converted.GetInputPort("strut_state").FixValue(context, point)
    assert converted.GetOutputPort("force").Eval(context)[0].derivatives()[0] > 0.0
    plain = ShockAbsorber(strut(thermal_time=None))
    context = plain.CreateDefaultContext()
    plain.settle(context)
    assert context.num_continuous_states() == 0


# --- orifices

NETWORK = OrificeNetwork(
    piston_area=0.02,
    main=Table((0.0, 0.3), (6e-4, 3e-4)),
    density=860.0,
    discharge=0.75,
)


@given(s=st.floats(0.0, 0.3), rate=st.floats(0.2, 7.0))
def test_main_orifice_follows_the_law_of_bernoulli(s, rate):
    area = 6e-4 - 1e-3 * s
    exact = 860.0 * 0.02**3 / (2.0 * (0.75 * area) ** 2)
    for grid in NETWORK.damping(0.3):
        # Chords of 7.5 mm of a curve that bends by (h/a)²/8 × 6.
        assert grid.value(s, rate) == pytest.approx(exact, rel=1e-3)


def test_relief_valve_holds_the_pressure():
    valve = OrificeNetwork(
        piston_area=0.02,
        main=3e-4,
        relief_pressure=2e7,
        relief_area=2e-3,
        relief_band=1e6,
    )
    without = OrificeNetwork(piston_area=0.02, main=3e-4)
    slow, fast = 1.0, 4.0
    closing, open_ = valve.damping(0.4)[0], without.damping(0.4)[0]
    assert closing.value(0.2, slow) == pytest.approx(open_.value(0.2, slow))
    pressure = closing.value(0.2, fast) * fast**2 / 0.02
    assert 2.0e7 < pressure < 2.1e7
    assert open_.value(0.2, fast) * fast**2 / 0.02 > 5e7
    # It does not act on the way back.
    assert valve.damping(0.4)[1] == without.damping(0.4)[1]


def test_snubber_damps_near_full_extension():
    network = OrificeNetwork(
        piston_area=0.02,
        main=5e-4,
        recoil_area=0.006,
        recoil_compression=2e-4,
        recoil_rebound=Table((0.0, 0.05, 0.1), (1e-5, 3e-5, 3e-5)),
    )
    closing, opening = network.damping(0.4)
    assert opening.value(0.0, 1.0) > 5.0 * opening.value(0.2, 1.0)
    recoil = 860.0 * 0.006**3 / (2.0 * (0.75 * 3e-5) ** 2)
    main = 860.0 * 0.02**3 / (2.0 * (0.75 * 5e-4) ** 2)
    assert opening.value(0.2, 1.0) == pytest.approx(main + recoil, rel=1e-9)
    filling = 860.0 * 0.006**3 / (2.0 * (0.75 * 2e-4) ** 2)
    assert closing.value(0.2, 1.0) == pytest.approx(main + filling, rel=1e-9)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"main": 0.0}, "main is 0.0 m², expected > 0.0"),
        ({"recoil_area": 0.01}, "recoil_area without recoil_rebound"),
        ({"discharge": -1.0}, "discharge is -1.0"),
    ],
)
def test_bad_orifices_are_named(changes, message):
    with pytest.raises(ValueError, match=message):
        OrificeNetwork(**{"piston_area": 0.02, "main": 3e-4} | changes)


def test_bad_states_are_named():
    with pytest.raises(ValueError, match=r"thermal_time is 0\.0 s, expected > 0"):
        strut(thermal_time=0.0)
    with pytest.raises(ValueError, match=r"beside compressible oil is 0\.0"):
        strut(oil_stiffness=1e7, rebound_damping=0.0)


def test_grid_is_bilinear_and_held_at_its_edges():
    grid = Grid((0.0, 1.0, 3.0), (0.0, 2.0), ((0.0, 4.0), (1.0, 5.0), (3.0, 7.0)))
    for x, y in ((0.2, 0.3), (2.0, 1.9), (1.0, 1.0)):
        assert grid.value(x, y) == pytest.approx(x + 2.0 * y)
    assert grid.value(9.0, -1.0) == 3.0
    short = ((0.0,), (0.0, 1.0), ((1.0, 2.0),))
    falling = ((0.0, 0.0), (0.0, 1.0), ((1.0, 2.0), (1.0, 2.0)))
    for bad in (short, falling):
        with pytest.raises(ValueError, match="grid"):
            Grid(*bad)
