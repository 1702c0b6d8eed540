"""Crown, left and right tracks, random roughness: geometry, spectra, files."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import csd, welch
from scipy.special import k1

from systems.runway.roughness import ISO_8608, coherence, rough_tracks
from systems.runway.runway import Runway
from systems.runway.runway_profile import CosineBump, Waves, measured_tracks
from systems.tire.tire_law import TireLaw
from systems.tire.tire_parameters import TireParameters
from tests.systems.runway.test_runway import wheel_circle_distance
from tests.systems.tire.test_tire import ONES, tilted

LEFT = CosineBump(height=0.05, length=3.0, start=0.0)
RIGHT = Waves(amplitude=0.02, wavelength=5.0)
TRACKS = Runway(profile=LEFT, right=RIGHT, track_spacing=6.0, crown=0.015)
CROWNED = Runway(crown=0.015)


# --- crown


def test_crown_falls_to_both_sides_and_is_round_in_the_middle():
    assert CROWNED.height(12.0, 0.0) == 0.0
    for y in (-20.0, 20.0):
        assert CROWNED.height(3.0, y) == pytest.approx(-0.015 * 19.0, abs=1e-3)
        distance, nx, ny, _ = CROWNED.nearest(0.0, y, 0.2, 0.0, 1.0, 0.0)
        assert nx == 0.0
        assert ny == pytest.approx(math.copysign(0.015, y), rel=2e-3)
        assert distance == pytest.approx(0.2 - CROWNED.height(0.0, y), rel=1e-9)


def test_runway_turned_round_is_the_same():
    turned = Runway(crown=0.015, direction=(0.0, 1.0), origin=(2.0, 3.0))
    assert turned.height(7.0, 50.0) == pytest.approx(CROWNED.height(0.0, 5.0))


# --- tracks


def test_each_side_has_its_track():
    runway = Runway(profile=LEFT, right=RIGHT, track_spacing=6.0)
    for x in (-0.7, -1.5, -2.2):
        assert runway.height(x, -3.0) == LEFT.shape(-x)[0]  # port of -x is -y
        assert runway.height(x, 3.0) == RIGHT.shape(-x)[0]
        middle = 0.5 * (LEFT.shape(-x)[0] + RIGHT.shape(-x)[0])
        assert runway.height(x, 0.0) == pytest.approx(middle)


@pytest.mark.parametrize("y", [-3.2, -1.0, 0.3, 2.5, 4.0])
@pytest.mark.parametrize(("yaw", "camber"), [(0.0, 0.0), (0.4, 0.1), (-1.2, -0.2)])
def test_nearest_point_is_nearest_in_the_plane_of_the_wheel(y, yaw, camber):
    a = [
        -math.sin(yaw) * math.cos(camber),
        math.cos(yaw) * math.cos(camber),
        math.sin(camber),
    ]
    p = [-1.4, y, 0.53]
    distance, *normal = TRACKS.nearest(*p, *a)
    assert np.linalg.norm(normal) == pytest.approx(1.0, rel=1e-14)
    assert distance == pytest.approx(wheel_circle_distance(TRACKS, p, a), abs=2e-6)


@given(
    y=st.floats(-4.0, 4.0),
    yaw=st.floats(-3.0, 3.0),
    camber=st.floats(-0.2, 0.2),
    sway=st.floats(-10.0, 10.0),
    spin=st.floats(-150.0, 0.0),
)
@settings(max_examples=40)
def test_elastic_contact_conserves_energy_on_crown_and_tracks(
    y, yaw, camber, sway, spin
):
    law = TireLaw(TireParameters(radius=0.584, stiffness=2e6), TRACKS)
    wheel = tilted(
        camber, yaw, 0.5, np.array([-60.0, sway, 1.0]), np.array([0.2, spin, 0.3])
    )
    wheel[1] = y
    h = 1e-7

    def energy(t):
        moved = wheel.copy()
        moved[:3] += t * wheel[6:9]
        axle = wheel[3:6] + t * np.cross(wheel[9:], wheel[3:6])
        moved[3:6] = axle / np.linalg.norm(axle)
        return law.energy(law.deflection(moved.tolist()))

    result = law.contact(wheel.tolist(), None, ONES)
    power = np.dot(result[:3], wheel[9:]) + np.dot(result[3:6], wheel[6:9])
    stored = (energy(h) - energy(-h)) / (2 * h)
    scale = np.linalg.norm(result[3:6]) * 60.0 + abs(stored) + 1.0
    assert abs(power + stored + result[13]) < 1e-5 * scale


# --- roughness


def test_roughness_has_the_spectrum_of_its_class():
    left, _ = rough_tracks(
        ISO_8608["C"], seed=3, length=4000.0, wavelengths=(0.5, 90.0)
    )
    d, h = np.array(left.distance), np.array(left.height)
    n, density = welch(h, 1.0 / (d[1] - d[0]), nperseg=4096)
    for low, high in ((0.05, 0.2), (0.2, 0.6), (0.6, 1.6)):
        band = (n > low) & (n < high)
        expected = 256e-6 * (n[band] / 0.1) ** -2.0
        assert density[band].sum() == pytest.approx(expected.sum(), rel=0.1)
    assert density[n > 2.6].max() < 1e-3 * density[(n > 1.5) & (n < 1.9)].min()


def test_coherence_is_that_of_an_isotropic_surface():
    n = np.array([1e-5, 0.02, 0.05, 0.1, 0.3])
    z = 2.0 * np.pi * n * 7.6
    assert coherence(n, 7.6) == pytest.approx(z * k1(z), rel=1e-6)
    assert coherence(n, 0.0) == pytest.approx(1.0)
    left, right = rough_tracks(64e-6, seed=5, length=8000.0, track_spacing=2.0)
    rate, a, b = 1.0 / left.distance[1], np.array(left.height), np.array(right.height)
    n, cross = csd(a, b, rate, nperseg=8192)
    own, other = (welch(h, rate, nperseg=8192)[1] for h in (a, b))
    band = (n > 0.05) & (n < 0.25)
    found = (cross[band].real / np.sqrt(own[band] * other[band])).mean()
    assert found == pytest.approx(coherence(n[band], 2.0).mean(), abs=0.08)


def test_roughness_is_repeated_by_its_seed_and_grows_from_nothing():
    one, two, other = (
        rough_tracks(16e-6, seed=seed, length=200.0, start=5.0)[0] for seed in (1, 1, 2)
    )
    assert one.height == two.height
    assert one.height != other.height
    assert one.shape(5.0)[:2] == (0.0, 0.0)
    assert abs(one.shape(6.0)[0]) < 0.02 * max(map(abs, one.height))
    same = rough_tracks(16e-6, seed=1, length=200.0)
    assert same[0].height == same[1].height


def test_tire_can_roll_over_class_d():
    left, _ = rough_tracks(ISO_8608["D"], seed=1, length=1000.0)
    Runway(profile=left).require_rollable(0.584)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"intensity": 0.0}, r"intensity is 0\.0 m³, expected > 0"),
        ({"length": 10.0}, r"length is 10\.0 m, expected > 180"),
        ({"wavelengths": (2.0, 1.0)}, "longest wavelength is"),
    ],
)
def test_bad_roughness_is_named(changes, message):
    values = {"intensity": 16e-6, "seed": 1, "length": 500.0} | changes
    with pytest.raises(ValueError, match=message):
        rough_tracks(values.pop("intensity"), **values)


# --- files


def test_files_in_feet_with_two_tracks_run_both_ways(tmp_path):
    path = tmp_path / "runway.txt"
    path.write_text("ft left right\n0 0 0\n10\t1  2\n30 0; 4 # end\n")
    left, right = measured_tracks(path, unit=0.3048, start=5.0)
    assert left.distance == pytest.approx((5.0, 8.048, 14.144))
    assert left.height[1] == pytest.approx(0.3048)
    assert right.height == pytest.approx((0.0, 0.6096, 1.2192))
    back_left, back_right = measured_tracks(path, backwards=True)
    assert back_left.distance == (0.0, 20.0, 30.0)
    assert back_left.height == (4.0, 2.0, 0.0)
    assert back_right.height == (0.0, 1.0, 0.0)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0 0\n1 1 1\n", "line 2: found 3 columns, expected 2"),
        ("0,0\n1,x\n", "line 2: found '1,x', expected distance and height"),
        ("1 2 3 4\n", "line 1: found '1 2 3 4'"),
        ("0 0\n0 1\n", "runway.txt: runway profile: distance"),
        ("a b\n0 0\n", "1 points, expected two or more"),
    ],
)
def test_bad_files_are_named_with_their_line(tmp_path, text, message):
    path = tmp_path / "runway.txt"
    path.write_text(text)
    with pytest.raises(ValueError, match=message):
        measured_tracks(path)


def test_bad_runways_are_named():
    with pytest.raises(ValueError, match=r"crown is 0\.2, expected"):
        Runway(crown=0.2)
    with pytest.raises(ValueError, match="a right track without a left one"):
        Runway(right=RIGHT)
    with pytest.raises(ValueError, match="track_spacing is 0"):
        Runway(profile=LEFT, right=RIGHT, track_spacing=0.0)
