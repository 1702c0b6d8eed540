"""A telescopic gear whose bodies are a model file."""

import re
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydantic import ValidationError

from drake_landing.gears.drop_rig import drop_rig
from drake_landing.gears.landing_gear import TelescopicGear, read_gear
from tests.drake_landing.landing_gears import aircraft_gears


def _inertial(part, origin):
    x, y, z = np.array(part.cg) - origin
    ixx, iyy, izz = part.inertia
    return (
        f"<inertial><pose>{x} {y} {z} 0 0 0</pose><mass>{part.mass}</mass><inertia>"
        f"<ixx>{ixx}</ixx><iyy>{iyy}</iyy><izz>{izz}</izz></inertia></inertial>"
    )


def _sdf(gear, attachment):
    """The gear as SDF: fitting with a door welded to it, piston, wheels."""
    axle, at = np.array(gear.axle), np.array(attachment)
    place = " ".join(map(str, axle - at))
    wheels = ""
    for name, offset in zip(gear.wheel_names, gear.wheel_offsets):
        w = gear.wheel
        there = " ".join(map(str, axle - at + [0.0, offset, 0.0]))
        wheels += (
            f"<link name='{name}'><pose>{there} 0 0 0</pose><inertial><mass>{w.mass}"
            f"</mass><inertia><ixx>{w.transverse}</ixx><iyy>{w.spin_inertia}</iyy>"
            f"<izz>{w.transverse}</izz></inertia></inertial></link>"
            f"<joint name='{name}_spin' type='revolute'><parent>piston</parent>"
            f"<child>{name}</child><axis><xyz>0 1 0</xyz></axis></joint>"
        )
    return (
        "<?xml version='1.0'?><sdf version='1.7'><model name='gear'>"
        f"<link name='fitting'>{_inertial(gear.fitting, at)}</link>"
        f"<link name='piston'><pose>{place} 0 0 0</pose>"
        f"{_inertial(gear.piston, axle)}</link>"
        "<joint name='strut' type='prismatic'><parent>fitting</parent>"
        f"<child>piston</child><axis><xyz>0 0 1</xyz></axis></joint>{wheels}"
        "</model></sdf>"
    )


GEAR = aircraft_gears()[1]
AT = (17.6, -3.795, -1.05)
CHOSEN = {
    "file": "gear.sdf",
    "position": AT,
    "fitting": "fitting",
    "strut": "strut",
    "wheels": ("main_left_left_spin", "main_left_right_spin"),
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "gear.sdf").write_text(_sdf(GEAR, AT))
    return tmp_path


def _data(folder, **changes):
    data = GEAR.model_dump(exclude={"axle", "wheel_offsets", "fitting", "piston"})
    del data["wheel"]
    chosen = CHOSEN | {"file": str(folder / "gear.sdf")} | changes
    return data | {"bodies": chosen}


def test_bodies_of_a_file_are_those_of_the_fields(folder):
    found = read_gear(_data(folder))
    assert isinstance(found, TelescopicGear)
    assert found.wheel_names == GEAR.wheel_names
    assert_allclose(found.axle, GEAR.axle, atol=1e-12)
    assert_allclose(found.wheel_offsets, GEAR.wheel_offsets, atol=1e-12)
    for name in ("fitting", "piston"):
        part, expected = getattr(found, name), getattr(GEAR, name)
        assert part.mass == pytest.approx(expected.mass)
        assert_allclose(part.cg, expected.cg, atol=1e-12)
        assert_allclose(part.inertia, expected.inertia, rtol=1e-9)
    assert found.wheel.spin_inertia == pytest.approx(GEAR.wheel.spin_inertia)
    assert found.wheel.transverse == pytest.approx(GEAR.wheel.transverse)
    peaks = [
        drop_rig(gear, mass=3e4, p_BA=AT).peak_force(sink_rate=2.0, duration=0.02)
        for gear in (found, GEAR)
    ]
    assert peaks[0] == pytest.approx(peaks[1], rel=1e-9)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"file": "nowhere.sdf"}, "bodies.file: .*expected a file that is there"),
        ({"fitting": "fiting"}, "bodies.fitting: found no body fiting .*fitting"),
        ({"strut": "strat"}, "bodies.strut: found no joint strat .*expected one of"),
        ({"strut": "main_left_left_spin"}, "a revolute joint, expected a prismatic"),
        ({"wheels": ("main_left_left_spin",)}, "main_left_right .*belong neither"),
        ({"fitting": "piston"}, "bodies.fitting: piston hangs on another body"),
    ],
)
def test_what_a_file_lacks_is_said_in_one_message(folder, changes, message):
    with pytest.raises(ValidationError) as caught:
        read_gear(_data(folder, **changes))
    (problem,) = caught.value.errors()
    assert re.search(message, problem["msg"]), problem["msg"]


def test_a_field_beside_the_file_is_refused(folder):
    with pytest.raises(ValidationError, match="found axle beside it"):
        read_gear(_data(folder) | {"axle": GEAR.axle})


def test_a_file_that_is_no_model_is_refused(folder):
    (folder / "gear.sdf").write_text("<sdf>")
    with pytest.raises(ValidationError, match=r"bodies\.file: gear\.sdf"):
        read_gear(_data(folder))
