"""Shock absorbers in a case: orifices, maps, heat and oil; messages with their line."""

from pathlib import Path

import pytest

from drake_landing.case.reading import parse_case
from drake_landing.gears.parameters import shock_absorber_parameters
from drake_landing.gears.shock_absorber_data import ShockAbsorber
from drake_landing.reference.d150.gears import landing_gears
from fem.errors import InputError
from systems.shock_absorber.orifice_damper import orifice_force

HERE = Path(__file__).parents[1]
PLAIN = {"stroke": 0.47, "gas_length": 0.52, "precharge_force": 45e3}


def damping(data: ShockAbsorber, s: float, rate: float) -> float:
    p = shock_absorber_parameters(data)
    metering = p.compression_metering, p.rebound_metering
    return orifice_force(s, rate, p.compression_damping, p.rebound_damping, *metering)


def test_orifices_damp_as_their_areas():
    data = ShockAbsorber(
        **PLAIN, orifices={"piston_area": 0.02, "main": 5e-4, "density": 800.0}
    )
    d = 800.0 * 0.02**3 / (2.0 * (0.75 * 5e-4) ** 2)
    assert damping(data, 0.1, 2.0) == pytest.approx(4.0 * d, rel=1e-9)
    assert damping(data, 0.1, -2.0) == pytest.approx(-4.0 * d, rel=1e-9)


def test_a_map_of_measured_forces_is_met_at_its_points():
    forces = {"compression": [[1e4, 3e4], [2e4, 5e4]], "rebound": [[4e4, 9e4]] * 2}
    data = ShockAbsorber(
        **PLAIN, damping_map={"strokes": [0.0, 0.4], "rates": [1.0, 2.0]} | forces
    )
    assert damping(data, 0.4, 2.0) == pytest.approx(5e4)
    assert damping(data, 0.2, 1.0) == pytest.approx(1.5e4)
    assert damping(data, 0.0, -1.0) == pytest.approx(-4e4)


def test_oil_and_heat_reach_the_law():
    data = ShockAbsorber(
        **PLAIN,
        compression_damping=45e3,
        rebound_damping=180e3,
        thermal_time=8.0,
        piston_area=0.028,
        oil_bulk_modulus=1.4e9,
        oil_volume=0.016,
    )
    found = shock_absorber_parameters(data)
    assert found.thermal_time == 8.0
    assert found.oil_stiffness == pytest.approx(1.4e9 * 0.028**2 / 0.016)


def test_paper_set_has_one_exponent_and_no_friction_and_the_other_one_has_not():
    for paper in (True, False):
        for gear in landing_gears(paper):
            found = gear.shock_absorber
            assert (found.thermal_time is None) == paper
            assert (found.seal_friction == 0.0) == paper
            assert (found.bearing_friction == 0.0) == paper


# --- messages

CASE = (HERE / "tiny_case.yaml").read_text()
LAST = "      compression_damping: 6000.0\n      rebound_damping: 24000.0\n"
LINE = 1 + CASE[: CASE.index(LAST)].count("\n")
BOTH = LAST
ORIFICES = "      orifices: {piston_area: 0.01, main: 1.0e-4"
MAP = "      damping_map: {strokes: [0, 0.2], rates: [1, 2]"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "damping: found none, expected one of compression_damping"),
        (BOTH + ORIFICES + "}\n", "found compression_damping and orifices, expected"),
        ("      compression_damping: 6000.0\n", "rebound_damping: missing"),
        (ORIFICES + ", discharge: 2}\n", "orifices.discharge: found 2, expected less"),
        (ORIFICES + ", relief_area: 1.0e-4}\n", "found one, expected both or none"),
        (ORIFICES + ", recoil_area: 0.002}\n", "recoil_rebound: missing, the area"),
        ("      orifices: {piston_area: 0.01, main: 0.1}\n", "main: found 0.1 m², exp"),
        ("      orifices: {piston_area: 0.01, main: [[0, 0], [1, 1.0e-4]]}\n", "<= 0"),
        (ORIFICES + "}\n      rebound_metering: [[0, 1], [0.1, 2]]\n", "beside orif"),
        (MAP + ", compression: [[1, 2]], rebound: [[1, 2], [1, 2]]}\n", "found 1 rows"),
        (MAP + ", compression: [[1], [1]], rebound: [[1], [1]]}\n", "a row of 1"),
        (
            MAP.replace("[1, 2]", "[2, 1]")
            + ", compression: [[1, 2], [1, 2]], rebound: [[1, 2], [1, 2]]}\n",
            "1 follows 2, expected strictly ascending",
        ),
        (BOTH + "      thermal_time: 0\n", "thermal_time: found 0, expected greater"),
        (
            BOTH + "      thermal_time: 5\n      gas_exponent: 1\n",
            "thermal_time: found beside gas_exponent 1",
        ),
        (
            BOTH + "      oil_bulk_modulus: 1.0e+9\n",
            "oil_volume: found none, expected oil_bulk",
        ),
        (BOTH + "      oil_bulk_modulus: 1.4\n", "oil_bulk_modulus: found 1.4, exp"),
        (BOTH + "      oil_volume: -1\n", "oil_volume: found -1, expected greater"),
    ],
)
def test_bad_shock_absorber_is_named_with_its_line(text, expected):
    with pytest.raises(InputError) as error:
        parse_case(CASE.replace(LAST, text, 1), file="tiny.yaml", folder=HERE)
    found = [p for p in error.value.problems if expected in p]
    assert found, error.value.problems
    line = int(found[0].split(":")[1])
    assert found[0].startswith("tiny.yaml:")
    assert LINE - 5 <= line <= LINE + 3
    assert "gears.main_right.shock_absorber" in found[0]
