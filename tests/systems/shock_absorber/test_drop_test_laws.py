"""Drop tests: the systems wired in a diagram against independent integrations.

The first oracle writes the equations once more, in numpy and without a line of the
systems, and integrates them with scipy. The second is a third-party model of the gears
of an airliner (public repository aircraft-taxiing-vibrations, MIT licence), of which
parameters and results are known; its two wheels together have one mass of 517 kg (main)
and 130 kg (nose), and its sprung mass is carried by lift.
"""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from systems.shock_absorber.gas_spring import GasSpring
from systems.shock_absorber.strut_parameters import ShockAbsorberParameters
from systems.tire.tire_parameters import TireParameters, inflated_stiffness
from systems.tools.table import Table
from tests.systems.drop_rig import Rig, drop

MAIN_LEG = Rig(
    shock_absorber=ShockAbsorberParameters(
        gas=GasSpring(precharge=45e3, gas_length=0.52),
        max_stroke=0.47,
        compression_damping=45e3,
        rebound_damping=180e3,
        seal_friction=0.03,
    ),
    tire=TireParameters(radius=0.584, stiffness=2e6, damping=3e3, rolling_radius=1.0),
    sprung_mass=32246.0 - 750.0,
    unsprung_mass=750.0,
    sink_rate=1.83,
    forward_speed=67.0,
)


def scipy_drop(duration: float, times: np.ndarray) -> dict[str, np.ndarray]:
    """The same leg by scipy: stroke, tire force per leg, drag per leg, spin."""
    m, mu_unsprung, inertia, v = 31496.0, 750.0, 18.0, 67.0
    k_stop, chi = 5e7, 0.5

    def strut(s, rate):
        gas = 45e3 / (1 - s / 0.52) ** 1.4
        oil = (45e3 if rate > 0 else 180e3) * rate * abs(rate)
        seal = 0.03 * gas * rate / math.hypot(rate, 0.02)
        pressed = max(45e3 / k_stop - s, 0.0)
        stop = k_stop * pressed * max(1 - chi * rate, 0.0)
        deep = max(s - 0.47, 0.0)
        return gas + oil + seal - stop + 3e7 * deep * max(1 + chi * rate, 0.0)

    def tire(z, rate, spin):
        x = 0.584 - z
        if x <= 0:
            return 0.0, 0.0
        load = max(2e6 * x - 3e3 * min(x / 0.005, 1.0) * rate, 0.0)
        slip = (v - z * spin) / v
        return load, 0.8 * math.sin(1.6 * math.atan(12.5 * slip)) * load

    def rhs(t, y):
        zs, zu, vs, vu, spin = y
        f = strut(zu - zs, vu - vs)
        load, drag = tire(zu, vu, spin)
        return [vs, vu, f / m, (2 * load - f) / mu_unsprung, drag * zu / inertia]

    start = [0.585, 0.585, -1.83, -1.83, 0.0]
    run = solve_ivp(
        rhs,
        (0, duration),
        start,
        method="DOP853",
        rtol=1e-10,
        atol=1e-11,
        max_step=5e-4,
        dense_output=True,
    )
    zs, zu, vs, vu, spin = run.sol(times)
    tires = np.array([tire(*row) for row in zip(zu, vu, spin)])
    return {
        "stroke": zu - zs,
        "rate": vu - vs,
        "load": 2 * tires[:, 0],
        "drag": 2 * tires[:, 1],
        "spin": spin,
        "strut": np.array([strut(*row) for row in zip(zu - zs, vu - vs)]),
    }


@pytest.fixture(scope="module")
def landed():
    return drop(MAIN_LEG, 0.4, accuracy=1e-8)


def test_histories_agree_with_scipy_within_a_thousandth(landed):
    oracle = scipy_drop(0.4, landed["time"])
    ours = {
        "stroke": landed["masses_strut_state"][0],
        "rate": landed["masses_strut_state"][1],
        "load": 2 * landed["tire_contact"][1],
        "drag": 2 * landed["tire_contact"][2],
        "spin": -landed["masses_state"][4],
        "strut": landed["strut_force"][0],
    }
    for name, history in ours.items():
        peak = np.abs(oracle[name]).max()
        assert np.abs(history).max() == pytest.approx(peak, rel=1e-3), name
        assert np.abs(history - oracle[name]).max() < 1e-3 * peak, name


def test_energy_closes(landed):
    stored = landed["masses_kinetic_energy"] + landed["strut_energy"]
    stored = (stored + 2 * landed["tire_energy"])[0]
    power = (landed["strut_dissipated_power"] + 2 * landed["tire_dissipated_power"])[0]
    # The carriage keeps its speed: it feeds drag times speed.
    power = power - 2 * landed["tire_contact"][2] * MAIN_LEG.forward_speed
    t = landed["time"]
    lost = np.r_[0.0, np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(t))]
    balance = stored + lost - stored[0]
    # The trapezoidal rule over the steps of the integrator.
    sink = 0.5 * 32246.0 * 1.83**2
    assert np.abs(balance).max() < 1e-4 * sink


def test_spin_up_takes_the_angular_impulse_of_the_drag(landed):
    t, drag = landed["time"], landed["tire_contact"][2]
    radius = landed["masses_state"][1]
    moment = drag * radius
    impulse = np.sum(0.5 * (moment[1:] + moment[:-1]) * np.diff(t))
    spin = -landed["masses_state"][4, -1]
    assert impulse == pytest.approx(18.0 * spin, rel=1e-3)
    assert spin == pytest.approx(67.0 / radius[-1], rel=0.01)


def test_strut_is_unloaded_before_touchdown(landed):
    air = landed["tire_contact"][0] < 0
    assert np.abs(landed["strut_force"][0, air]).max() == 0.0


def flow(area: float, orifice, coefficient: float):
    """Pressure drop of an orifice as N s²/m²; areas in m², density 800 kg/m³."""
    return coefficient * area**3 * 800.0 / (2 * np.square(orifice))


def third_party_tire(*, radius, pressure, c1, c2, ratio, mass) -> TireParameters:
    """F = x²/(c1 + c2 x/p); damping 2 ζ √(m dF/dx). SI but for c1 (mm²/N) and c2."""
    c1, c2 = c1 * 1e-6, c2 * 1e3
    x = np.linspace(0.0, 0.3, 601)
    a = c1 + c2 * x / pressure
    slope = (2 * x * a - x**2 * c2 / pressure) / a**2
    return TireParameters(
        radius=radius,
        stiffness=inflated_stiffness(
            c1=c1, c2=c2, pressure=pressure, max_deflection=0.3
        ),
        damping=Table(x.tolist(), (2 * ratio * np.sqrt(mass * slope)).tolist()),
    )


def third_party_drop(strut, tire, *, sprung, unsprung, energy):
    """Largest stroke (m) and stroke rate (m/s)."""
    rig = Rig(
        shock_absorber=strut,
        tire=tire,
        sprung_mass=sprung,
        unsprung_mass=unsprung,
        sink_rate=math.sqrt(2 * energy / (sprung + unsprung)),
        unsprung_force=-9.81 * unsprung,
        clearance=5e-3,
    )
    return drop(rig, 0.5, accuracy=1e-6)["masses_strut_state"].max(axis=1)


def test_third_party_main_gear():
    stroke = np.r_[0.0, np.linspace(0.230, 0.237, 15), 0.5]
    orifice = np.interp(stroke, [0.230, 0.237], [470e-6, 320e-6])
    oil = flow(0.0194, orifice, 2.1)
    strut = ShockAbsorberParameters(
        gas=GasSpring.from_pressure(
            pressure=4.4e6, volume=17.88e-3, area=math.pi / 4 * 0.19**2, exponent=1.0
        ),
        max_stroke=0.5,
        compression_damping=1.0,
        rebound_damping=1.0,
        compression_metering=Table(stroke.tolist(), oil.tolist()),
        rebound_metering=Table(
            stroke.tolist(), (oil + flow(0.00628, 22e-6, 1.7)).tolist()
        ),
        seal_friction=0.07,
        extension_stop_stiffness=1e8,
    )
    tire = third_party_tire(
        radius=0.61, pressure=1.15e6, c1=0.008469, c2=0.0005346, ratio=0.15, mass=517.0
    )
    found = third_party_drop(strut, tire, sprung=33390.0, unsprung=517.0, energy=242e3)
    assert found == pytest.approx([0.4671, 2.905], rel=0.02)


@pytest.mark.parametrize(
    ("energy", "expected"), [(163e3, [0.4064, 3.514]), (63e3, [0.3622, 2.438])]
)
def test_third_party_nose_gear_with_two_gas_chambers(energy, expected):
    oil = float(flow(0.01327, 320e-6, 2.1))
    strut = ShockAbsorberParameters(
        gas=GasSpring.from_pressure(
            pressure=1.1e6,
            volume=3.63e-3,
            area=math.pi / 4 * (0.150**2 - 0.088**2),
            exponent=1.1,
            second_pressure=7.7e6,
            second_volume=1.7e-3,
            second_exponent=1.3,
        ),
        max_stroke=0.44,
        compression_damping=oil,
        rebound_damping=oil + float(flow(0.0023, 19e-6, 1.7)),
        seal_friction=0.07,
        extension_stop_stiffness=1e7,
    )
    tire = third_party_tire(
        radius=0.375, pressure=1.05e6, c1=0.00959, c2=0.0009285, ratio=0.10, mass=130.0
    )
    found = third_party_drop(strut, tire, sprung=13200.0, unsprung=130.0, energy=energy)
    assert found == pytest.approx(expected, rel=0.01)
