"""Bodies and joints of a gear: mass properties, rake, stroke, names; a drop test."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydantic import ValidationError
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import PrismaticJoint

from drake_landing.gears.bodies import AddLandingGear, strut_axis
from drake_landing.gears.landing_gear import LandingGear, TelescopicGear
from tests.drake_landing.landing_gears import aircraft_gears

P_BA = np.array([17.6, 3.795, -1.05])


def _plant(gear: LandingGear):
    plant = MultibodyPlant(0.0)
    bodies = AddLandingGear(plant, gear, P_BA)
    plant.Finalize()
    return plant, bodies, plant.CreateDefaultContext()


def _raked(**changes) -> LandingGear:
    data = aircraft_gears()[2].model_dump() | {"rake_deg": 9.0} | changes
    return TelescopicGear.model_validate(data)


def test_mass_and_center_of_gravity_of_the_extended_gear():
    gear = _raked()
    plant, _, context = _plant(gear)
    assert_allclose(plant.CalcTotalMass(context), gear.mass)
    parts = [(gear.fitting.mass, gear.fitting.cg), (gear.piston.mass, gear.piston.cg)]
    parts.append((2 * gear.wheel.mass, gear.axle))
    expected = sum(m * np.array(p) for m, p in parts) / gear.mass
    found = plant.CalcCenterOfMassPositionInWorld(context) + P_BA
    assert_allclose(found, expected, atol=1e-12)


def test_moments_of_inertia_of_the_whole_gear():
    gear = _raked()
    plant, _, context = _plant(gear)
    models = [plant.GetModelInstanceByName("DefaultModelInstance")]
    inertia = plant.CalcSpatialInertia(
        context,
        plant.world_frame(),
        [i for m in models for i in plant.GetBodyIndices(m)],
    )
    found = inertia.CalcRotationalInertia().CopyToFullMatrix3()
    w = gear.wheel
    parts = [
        (gear.fitting.mass, gear.fitting.cg, gear.fitting.inertia),
        (gear.piston.mass, gear.piston.cg, gear.piston.inertia),
    ]
    for y in gear.wheel_offsets:
        center = np.array(gear.axle) + np.array([0.0, y, 0.0])
        own = (w.transverse, w.spin_inertia, w.transverse)
        parts.append((w.mass, center, own))
    expected = np.zeros((3, 3))
    for mass, p, own in parts:
        r = np.array(p) - P_BA
        expected += np.diag(own) + mass * (r @ r * np.eye(3) - np.outer(r, r))
    assert_allclose(found, expected, rtol=1e-12, atol=1e-9)


def test_stroke_moves_the_axle_up_and_aft_along_the_raked_strut():
    gear = _raked()
    _, bodies, context = _plant(gear)
    bodies.strut.set_translation(context, 0.3)
    found = bodies.parts["piston"].EvalPoseInWorld(context).translation() + P_BA
    axis = strut_axis(gear)
    assert axis[0] > 0
    assert axis[2] > 0.98
    assert_allclose(found, np.array(gear.axle) + 0.3 * axis, atol=1e-13)


def test_wheels_sit_on_the_axle_and_spin_about_it():
    gear = _raked()
    _, bodies, context = _plant(gear)
    assert list(bodies.wheels) == ["main_right_left", "main_right_right"]
    bodies.spins["main_right_left"].set_angular_rate(context, -5.0)
    wheel = bodies.wheels["main_right_left"]
    velocity = wheel.EvalSpatialVelocityInWorld(context).get_coeffs()
    assert_allclose(velocity, [0, -5, 0, 0, 0, 0], atol=1e-14)
    center = wheel.EvalPoseInWorld(context).translation() + P_BA
    assert_allclose(center, np.array(gear.axle) - np.array([0, 0.465, 0]), atol=1e-13)


@pytest.mark.parametrize(
    ("offsets", "names"),
    [
        ((0.0,), ("main_right",)),
        ((-0.4, 0.4), ("main_right_left", "main_right_right")),
        ((-0.6, 0.0, 0.6), ("main_right_1", "main_right_2", "main_right_3")),
    ],
)
def test_wheel_names(offsets, names):
    gear = _raked(wheel_offsets=offsets)
    assert gear.wheel_names == names
    assert _plant(gear)[0].num_velocities() == 6 + 1 + len(offsets)


def test_a_gear_may_hang_on_a_joint_of_the_callers_own():
    plant = MultibodyPlant(0.0)
    bodies = AddLandingGear(plant, aircraft_gears()[2], P_BA)
    carriage = bodies.fitting.body_frame()
    plant.AddJoint(PrismaticJoint("drop", plant.world_frame(), carriage, [0, 0, 1]))
    plant.Finalize()
    assert plant.num_velocities() == 1 + 1 + 2


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        (("fitting", "mass"), -1.0, "greater than 0"),
        (("fitting", "inertia"), (1.0, 1.0, 3.0), "expected no moment above"),
        (("wheel", "transverse_inertia"), 8.0, "no less than half of spin"),
        (("wheel_offsets",), (0.4, -0.4), "strictly ascending"),
        (("wheel_offsets",), (), "at least 1 item"),
        (("shock_absorber", "gas_length"), 0.4, "expected more than the stroke"),
        (
            ("tyre", "load_table"),
            [(0.0, 0.0), (0.1, 2e5)],
            "expected one of stiffness, load_table",
        ),
        (("shock_absorber", "gas_exponent"), -1.0, "greater than or equal to 1"),
        (
            ("shock_absorber", "compression_metering"),
            [(0.0, 1.0), (0.2, 1.5), (0.1, 2.0)],
            "found 0.1 after 0.2, expected strictly ascending",
        ),
        (("rake_deg",), 60.0, "less than 45"),
        (("name",), "Main Gear", "match pattern"),
        (("stiffnes",), 1.0, "Extra inputs"),
    ],
)
def test_bad_data_is_refused(path, value, message):
    data = aircraft_gears()[2].model_dump()
    section = data
    for key in path[:-1]:
        section = section[key]
    section[path[-1]] = value
    with pytest.raises(ValidationError, match=message):
        TelescopicGear.model_validate(data)
