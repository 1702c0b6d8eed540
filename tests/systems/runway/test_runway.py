"""Runway profiles against their derivatives; the nearest point against brute force."""

import math
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from systems.runway.runway import SURFACE_FRICTION, Runway
from systems.runway.runway_profile import (
    CosineBump,
    MeasuredProfile,
    Step,
    Waves,
    measured_tracks,
)
from systems.tire.tire_law import TireLaw
from systems.tire.tire_parameters import TireParameters

MEASURED = MeasuredProfile(
    distance=[0.0, 2.0, 3.5, 6.0, 9.0], height=[0.0, 0.03, 0.01, -0.04, 0.02]
)
PROFILES = [
    CosineBump(height=0.05, length=2.0, start=1.0),
    CosineBump(height=-0.04, length=3.0, start=1.0),
    Waves(amplitude=0.03, wavelength=4.0),
    Step(height=0.02, ramp=0.5, start=2.0),
    MEASURED,
]


@pytest.mark.parametrize("profile", PROFILES)
@given(d=st.floats(-2.0, 11.0))
def test_slope_is_the_derivative_of_height(profile, d):
    h = 1e-6
    low, high = profile.shape(d - h), profile.shape(d + h)
    _, slope, curvature = profile.shape(d)
    assert (high[0] - low[0]) / (2 * h) == pytest.approx(slope, abs=2e-5)
    assert curvature <= profile.max_curvature * (1 + 1e-12)


@pytest.mark.parametrize("profile", PROFILES)
def test_largest_curvature_is_that_of_the_slope(profile):
    d = np.linspace(-1.0, 11.0, 24001)
    slope = np.array([profile.shape(x)[1] for x in d.tolist()])
    hollow = np.max(np.diff(slope) / np.diff(d))
    assert profile.max_curvature == pytest.approx(hollow, rel=0.01)


def test_profiles_have_their_heights():
    bump, _, waves, step, measured = PROFILES
    assert bump.shape(2.0)[0] == 0.05
    assert bump.shape(3.5) == (0.0, 0.0, 0.0)
    assert waves.shape(1.0)[0] == pytest.approx(0.03)
    assert step.shape(2.25)[0] == pytest.approx(0.01)
    assert step.shape(9.0)[0] == 0.02
    for d, h in zip(measured.distance, measured.height):
        assert measured.shape(d)[0] == pytest.approx(h, abs=1e-15)
    assert measured.shape(99.0) == (0.02, 0.0, 0.0)


def wheel_circle_distance(runway, p, a):
    """Least distance in the wheel's plane, by sampling lines through its center."""
    p, a = np.array(p), np.array(a)
    along = np.cross(a, [0.0, 0.0, 1.0])
    along /= np.linalg.norm(along)
    up = np.cross(along, a)
    best = np.inf
    for angle in np.linspace(-0.3, 0.3, 2001):
        ray = -math.cos(angle) * up + math.sin(angle) * along
        length = 0.5
        for _ in range(15):
            q = p + length * ray
            length -= (q[2] - runway.height(q[0], q[1])) / ray[2]
        best = min(best, length)
    return best


@pytest.mark.parametrize("profile", PROFILES[:1] + PROFILES[2:3])
@pytest.mark.parametrize(("yaw", "camber"), [(0.0, 0.0), (0.4, 0.1), (-1.2, -0.2)])
def test_nearest_point_is_nearest_in_the_plane_of_the_wheel(profile, yaw, camber):
    runway = Runway(profile=profile)
    a = [
        -math.sin(yaw) * math.cos(camber),
        math.cos(yaw) * math.cos(camber),
        math.sin(camber),
    ]
    p = [-1.4, 0.7, 0.53]
    distance, *normal = runway.nearest(*p, *a)
    assert np.linalg.norm(normal) == pytest.approx(1.0, rel=1e-14)
    assert distance == pytest.approx(wheel_circle_distance(runway, p, a), abs=1e-7)


def test_flat_runway_is_the_ground_plane():
    c = math.cos(0.1)
    assert Runway().nearest(5.0, 3.0, 0.5, 0.0, c, math.sin(0.1)) == pytest.approx(
        (0.5 / c, 0.0, 0.0, 1.0)
    )


def test_profile_lies_along_the_direction_from_the_origin():
    runway = Runway(profile=PROFILES[0], direction=(0.0, 3.0), origin=(7.0, -5.0))
    assert runway.height(123.0, -3.0) == 0.05
    assert runway.height(-3.0, 0.0) == 0.0


def test_surfaces_scale_friction():
    assert [Runway(surface=s).friction for s in SURFACE_FRICTION] == [1.0, 0.6, 0.12]
    assert Runway(surface="wet", friction_factor=0.5).friction == 0.5


def test_measured_profile_is_read_from_a_file(tmp_path):
    path = tmp_path / "profile.csv"
    path.write_text("distance,height\n0,0\n2,0.03\n# joint\n3.5,0.01\n")
    assert measured_tracks(path)[0].distance == (0.0, 2.0, 3.5)
    path.write_text("0,0\n2\n")
    with pytest.raises(ValueError, match="line 2: found '2', expected distance"):
        measured_tracks(path)
    path.write_text("0,0\n2,nan\n")
    with pytest.raises(ValueError, match="line 2: found '2,nan', expected finite"):
        measured_tracks(path)
    path.write_text("")
    with pytest.raises(ValueError, match="0 points, expected two or more"):
        measured_tracks(path)


@pytest.mark.parametrize(
    ("build", "words"),
    [
        (lambda: CosineBump(height=0.1, length=0.0, start=0.0), "length is 0.0 m"),
        (lambda: Step(height=0.1, ramp=-1.0, start=0.0), "ramp is -1.0 m, expected >"),
        (lambda: Waves(amplitude=math.inf, wavelength=1.0), "amplitude is inf m"),
        (
            lambda: MeasuredProfile(distance=[0.0, 1.0, 1.0], height=[0.0, 0.0, 0.0]),
            "distance 1.0 m follows 1.0 m",
        ),
        (lambda: MeasuredProfile(distance=[0.0], height=[0.0]), "two or more"),
        (lambda: Runway(surface="snow"), "'snow', expected one of dry, wet, icy"),
        (lambda: Runway(friction_factor=-0.1), "friction_factor is -0.1"),
        (lambda: Runway(direction=(0.0, 0.0)), "direction is (0, 0)"),
        (
            lambda: TireLaw(
                TireParameters(radius=0.6, stiffness=1e6),
                Runway(profile=Step(height=0.02, ramp=0.1, start=0.0)),
            ),
            "radius of curvature is 0.1013 m in a hollow, expected > 0.6 m",
        ),
    ],
)
def test_bad_runways_are_named(build, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        build()
