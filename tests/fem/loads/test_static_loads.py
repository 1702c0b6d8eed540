"""Concentrated, inertial and combined loads: sizes, directions, frames."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fem.errors import InputError
from fem.loads import enforced_displacements, static_load

BASE = """\
CORD2C,5,,1.,0.,0.,1.,0.,1.
,2.,0.,0.
GRID,1
GRID,2,,1.,2.,0.
GRID,3,,1.,2.,3.
GRID,4,5,2.,90.,1.,5
SPOINT,91
"""


def test_force_has_the_direction_and_length_of_a_times_n(loaded):
    result = loaded(BASE + "FORCE,1,2,,10.,1.,2.,-2.\nMOMENT,1,3,,2.,0.,0.,3.\n")
    np.testing.assert_allclose(result.at(2), [10, 20, -20, 0, 0, 0])
    np.testing.assert_allclose(result.at(3), [0, 0, 0, 0, 0, 6])


def test_force_in_a_cylindrical_system_at_its_grid(loaded):
    # Grid 2 is at theta 90 of system 5: r is basic y, theta is -x.
    result = loaded(BASE + "FORCE,1,2,5,10.,1.,0.,0.\nFORCE,1,3,5,10.,0.,1.,0.\n")
    np.testing.assert_allclose(result.at(2)[:3], [0, 10, 0], atol=1e-14)
    np.testing.assert_allclose(result.at(3)[:3], [-10, 0, 0], atol=1e-14)


def test_force_turns_into_the_displacement_frame(loaded):
    result = loaded(BASE + "FORCE,1,4,,1.,3.,4.,5.\n")
    np.testing.assert_allclose(result.at(4)[:3], [4, -3, 5], atol=1e-14)
    np.testing.assert_allclose(result.resultant()[:3], [3, 4, 5], atol=1e-14)


def test_force1_and_force2_follow_grids(loaded):
    result = loaded(BASE + "FORCE1,1,1,7.,2,3\nMOMENT2,1,2,5.,1,2,2,3\n")
    np.testing.assert_allclose(result.at(1)[:3], [0, 0, 7])
    expected = np.cross([1, 2, 0], [0, 0, 3]) / np.linalg.norm([6, 3]) * 5
    np.testing.assert_allclose(result.at(2)[3:], expected)


def test_force_without_a_direction_is_named(loaded):
    with pytest.raises(InputError, match="give no direction"):
        loaded(BASE + "FORCE1,1,1,7.,2,2\n")


def test_scalar_loads_act_on_t1_of_a_grid(loaded):
    result = loaded(BASE + "SLOAD,1,91,-500.,91,100.\nSLOAD,1,2,7.\n")
    assert result.load[result.points.dof(91, 0)] == -400.0
    assert result.load[result.points.dof(2, 1)] == 7.0


def test_a_set_that_load_lacks_loads_nothing(loaded):
    bulk = BASE + "FORCE,11,1,,1.,1.,0.,0.\nLOAD,1,2.,3.,11,-1.,12\n"
    np.testing.assert_allclose(loaded(bulk).at(1)[:3], [6, 0, 0])


def test_load_card_combines_sets(loaded):
    bulk = BASE + "FORCE,11,1,,1.,1.,0.,0.\nFORCE,12,1,,1.,0.,1.,0.\n"
    result = loaded(bulk + "LOAD,1,2.,3.,11,-1.,12,4.,11\n")
    np.testing.assert_allclose(result.at(1)[:3], [14, -2, 0])


def test_load_set_that_is_not_there_is_named(loaded):
    with pytest.raises(InputError, match="load set 1 is not defined"):
        loaded(BASE)


MASS = "CONM2,1,2,,3.,.0,.0,.5\nCONM2,2,4,,2.\n"


def test_weight_is_mass_times_gravity_also_with_offsets_and_wtmass(loaded):
    bulk = BASE + MASS + "PARAM,WTMASS,.5\nGRAV,1,,9.81,0.,0.,-2.\n"
    force = loaded(bulk).resultant()
    np.testing.assert_allclose(force[:3], [0, 0, -0.5 * 5 * 9.81 * 2], atol=1e-12)
    # Gravity acts at the center of the offset mass.
    sideways = loaded(BASE + "CONM2,1,2,,3.,.0,.0,.5\nGRAV,1,,1.,1.,0.,0.\n")
    np.testing.assert_allclose(sideways.at(2), [3, 0, 0, 0, 1.5, 0], atol=1e-14)


def test_accel1_acts_on_its_grids_only(loaded):
    result = loaded(BASE + MASS + "ACCEL1,1,,2.,0.,0.,1.\n,2,THRU,3\n")
    assert result.at(2)[2] == pytest.approx(6.0)
    assert not result.at(4).any()


ALONG_Y = "CORD2R,8,,0.,1.,0.,0.,2.,0.\n,0.,1.,1.\n"  # z: basic y, y: basic x


@pytest.mark.parametrize(
    ("profile", "factor"),
    [("0.,1.,4.,5.", 2.0), ("4.,20.,2.,10.", 10.0), ("-9.,3.,-4.,7.", 7.0)],
)
def test_accel_varies_along_an_axis_of_its_system(loaded, profile, factor):
    """Linear between the places, beyond them that of the nearest."""
    result = loaded(BASE + ALONG_Y + MASS + f"ACCEL,1,8,0.,3.,0.,Z\n,{profile}\n")
    force = result.resultant()[:3]
    np.testing.assert_allclose(force, [5.0 * 3.0 * factor, 0.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(result.at(2)[4], 1.5 * 3.0 * factor)


@pytest.mark.parametrize(
    ("card", "words"),
    [
        ("ACCEL,1,5,0.,3.,0.,Z\n,0.,1.,4.,5.", "system 5 is not rectangular"),
        ("ACCEL,1,8,0.,3.,0.,W\n,0.,1.,4.,5.", "found 'W', expected X, Y or Z"),
        ("ACCEL,1,8,0.,3.,0.,Z\n,0.,1.", "two or more different places"),
        ("ACCEL,1,8,0.,3.,0.,Z\n,0.,1.,0.,2.", "two or more different places"),
    ],
)
def test_accel_that_cannot_be_is_refused(loaded, card, words):
    with pytest.raises(InputError, match=words):
        loaded(BASE + ALONG_Y + MASS + f"{card}\n")


def test_rforce_is_centrifugal_about_its_grid(loaded):
    bulk = BASE + "CONM2,2,4,,2.\nRFORCE,1,1,,.5,0.,0.,2.\n"
    spin = 2 * math.pi * 0.5 * 2
    force = loaded(bulk).resultant()
    np.testing.assert_allclose(force[:3], 2 * spin**2 * np.array([1, 2, 0]), atol=1e-9)
    turning = loaded(BASE + "CONM2,2,4,,2.\nRFORCE,1,1,,0.,0.,0.,1.\n,.5\n")
    expected = 2 * np.pi * np.cross([0, 0, 1], [1, 2, 1])
    np.testing.assert_allclose(turning.resultant()[:3], expected, atol=1e-9)


def test_loads_through_the_mass_say_when_there_is_none(model):
    m = model(BASE + "GRAV,1,,9.81,0.,0.,1.\n")
    with pytest.raises(ValueError, match="mass matrix"):
        static_load(m.deck, m.points, 1)


def test_enforced_displacements_are_scaled_by_load_cards(model):
    m = model(BASE + "SPCD,11,2,13,.5,91,,.1\nLOAD,1,2.,3.,11\n")
    dof, value = enforced_displacements(m.deck, m.points, 1)
    labels = [m.points.label(d) for d in dof]
    assert labels == ["grid 2 T1", "grid 2 T3", "scalar point 91"]
    np.testing.assert_allclose(value, [3.0, 3.0, 0.6])


angles = st.floats(-180, 180).map(lambda a: round(a, 1))


@settings(
    max_examples=6,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(kind=st.sampled_from("RCS"), a=angles, b=angles)
def test_resultants_do_not_depend_on_displacement_frames(loaded, kind, a, b):
    """Every kind of load, grids in basic axes and in a turned frame."""
    a, b = math.radians(a), math.radians(b)
    z = [math.cos(a) * math.cos(b), math.sin(a) * math.cos(b), math.sin(b)]
    x = [-math.sin(a), math.cos(a), 0.0]
    points = ["7.", "8.", "9.", *(f"{7 + i + v:.6f}" for i, v in enumerate(z))]
    frame = f"CORD2{kind},9,,{','.join(points)}\n,"
    frame += ",".join(f"{7 + i + v:.6f}" for i, v in enumerate(x)) + "\n"
    bulk = (
        "GRID,1,,0.,0.,0.,{0}\nGRID,2,,1.,0.,0.,{0}\nGRID,3,,1.,1.,.2,{0}\n"
        "GRID,4,,0.,1.,0.,{0}\nCQUAD4,1,1,1,2,3,4\nPSHELL,1,1,.01,1,,1\n"
        "CBAR,2,2,1,3,0.,0.,1.\nPBAR,2,1,.1,.01,.02,.01\nMAT1,1,7.+10,,.3,2700.\n"
        "FORCE,1,2,,5.,1.,2.,3.\nMOMENT1,1,2,5.,1,3\nPLOAD1,1,2,FY,FR,.1,3.,.7,5.\n"
        "PLOAD1,1,2,MXE,FR,.1,3.\nPLOAD4,1,1,5.,6.,7.,8.\nPLOAD2,1,3.,1\n"
        "GRAV,1,,9.81,1.,1.,1.\nRFORCE,1,2,,.3,1.,0.,1.\n"
    )
    plain = loaded(bulk.format("")).resultant()
    turned = loaded(frame + bulk.format("9")).resultant()
    np.testing.assert_allclose(turned, plain, rtol=1e-9, atol=1e-7)


def test_rotation_of_a_body_is_that_of_its_points(loaded):
    """RFORCE with spin and angular acceleration: CONM2 against four point masses."""
    places = np.array([[2.0, 0.5, 1.0], [1.0, -1.0, 2.0], [0.3, 2.0, 0.4], [3, 1, -1]])
    mass = np.array([1.0, 2.0, 3.0, 1.5])
    center = mass @ places / mass.sum()
    arm = places - center
    inertia = np.einsum("p,pk,pk->", mass, arm, arm) * np.eye(3)
    inertia -= np.einsum("p,pi,pj->ij", mass, arm, arm)
    d = center - [1.0, 2.0, 3.0]
    i = [inertia[0, 0], -inertia[1, 0], inertia[1, 1], -inertia[2, 0], -inertia[2, 1],
         inertia[2, 2]]  # fmt: skip
    spin = "RFORCE,1,1,,.4,1.,0.5,2.\n,.7\n"
    body = f"CONM2,1,3,,{mass.sum()},{d[0]:.12g},{d[1]:.12g},{d[2]:.12g}\n,"
    body += ",".join(f"{value:.12g}" for value in i)
    whole = loaded(BASE + body + "\n" + spin)
    points = "".join(
        f"GRID,{11 + k},,{x},{y},{z}\nCONM2,{11 + k},{11 + k},,{m}\n"
        for k, (m, (x, y, z)) in enumerate(zip(mass, places))
    )
    apart = loaded(BASE + points + spin)
    np.testing.assert_allclose(whole.resultant(), apart.resultant(), rtol=1e-9)


def test_darea_is_a_static_load(loaded):
    """As MSC converts it to FORCE, MOMENT, SLOAD."""
    result = loaded(
        BASE + "DAREA,1,4,2,5.,2,6,3.\nDAREA,1,91,,7.\nFORCE,1,4,5,2.,0.,1.\n"
    )
    np.testing.assert_allclose(result.at(4)[:3], [0.0, 7.0, 0.0], atol=1e-12)
    assert result.at(2)[5] == 3.0
    assert result.load[result.points.dof(91, 0)] == 7.0
