"""Landing gear drop tests of a third-party model, by the systems of this project."""

import math

import numpy as np

from benchmarks.verification.row import Row, figure
from systems.shock_absorber.gas_spring import GasSpring
from systems.shock_absorber.strut_parameters import ShockAbsorberParameters
from systems.tire.tire_parameters import TireParameters, inflated_stiffness
from systems.tools.table import Table
from tests.systems.drop_rig import Rig, drop

SOURCE = "third-party model (scipy), drop_test.md"


def _orifice(area: float, opening: np.ndarray | float, coefficient: float):
    """Pressure drop as N s²/m²; areas in m², oil of 800 kg/m³."""
    return coefficient * area**3 * 800.0 / (2.0 * np.square(opening))


def main_gear() -> list[Row]:
    """242 kJ, level, one gas chamber; the lift carries the sprung mass."""
    stroke = np.r_[0.0, np.linspace(0.230, 0.237, 15), 0.5]
    oil = _orifice(0.0194, np.interp(stroke, [0.230, 0.237], [470e-6, 320e-6]), 2.1)
    rebound = oil + _orifice(0.00628, 22e-6, 1.7)
    strut = ShockAbsorberParameters(
        gas=GasSpring.from_pressure(
            pressure=4.4e6, volume=17.88e-3, area=math.pi / 4 * 0.19**2, exponent=1.0
        ),
        max_stroke=0.5,
        compression_damping=1.0,
        rebound_damping=1.0,
        compression_metering=Table(stroke.tolist(), oil.tolist()),
        rebound_metering=Table(stroke.tolist(), rebound.tolist()),
        seal_friction=0.07,
        extension_stop_stiffness=1e8,
    )
    rig = Rig(
        shock_absorber=strut,
        tire=_tire(),
        sprung_mass=33390.0,
        unsprung_mass=517.0,
        sink_rate=math.sqrt(2 * 242e3 / (33390.0 + 517.0)),
        unsprung_force=-9.81 * 517.0,
        clearance=5e-3,
    )
    largest, rate = drop(rig, 0.5, accuracy=1e-6)["masses_strut_state"].max(axis=1)
    # Friction at the bearings and the strut's bending are not described there.
    return [
        figure(
            "drop test", "largest stroke, mm", 1e3 * largest, 467.1, SOURCE, target=0.02
        ),
        figure(
            "drop test", "largest rate, mm/s", 1e3 * rate, 2905.0, SOURCE, target=0.02
        ),
    ]


def _tire() -> TireParameters:
    """F = x²/(C1 + C2 x/p) and damping 2 ζ √(m dF/dx) of 517 kg of wheels."""
    c1, c2, pressure, mass, ratio = 0.008469e-6, 0.0005346e3, 1.15e6, 517.0, 0.15
    x = np.linspace(0.0, 0.3, 601)
    a = c1 + c2 * x / pressure
    slope = (2 * x * a - x**2 * c2 / pressure) / a**2
    return TireParameters(
        radius=0.61,
        stiffness=inflated_stiffness(
            c1=c1, c2=c2, pressure=pressure, max_deflection=0.3
        ),
        damping=Table(x.tolist(), (2 * ratio * np.sqrt(mass * slope)).tolist()),
    )
