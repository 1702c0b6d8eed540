"""Geometry of a shock absorber over an arm: lengths, ratio, power, errors."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from systems.gear.lever_strut import LeverGeometry
from systems.tools.rotations import exp

AXIS = np.array([0.0, 1.0, 0.0])
UPPER, LOWER = np.array([0.4, 0.05, 1.4]), np.array([0.63, -0.02, -0.1])
component = st.floats(-2.0, 2.0)
vector = st.tuples(component, component, component).map(np.array)


def _span(angle: float, axis=AXIS, upper=UPPER, lower=LOWER) -> float:
    turned = exp((angle * axis / np.linalg.norm(axis))[None])[0] @ lower
    return float(np.linalg.norm(upper - turned))


@given(upper=vector, lower=vector, axis=vector, angle=st.floats(-3.0, 3.0))
def test_length_is_the_distance_of_the_ends(upper, lower, axis, angle):
    norms = [np.linalg.norm(np.cross(v, axis)) for v in (upper, lower)]
    if min(*norms, np.linalg.norm(axis), np.linalg.norm(upper - lower)) < 0.1:
        return
    if _span(angle, axis, upper, lower) < 0.1:
        return
    geometry = LeverGeometry.between(upper, lower, axis)
    expected = _span(angle, axis, upper, lower)
    assert_allclose(geometry.length(angle), expected, rtol=1e-9)
    assert_allclose(geometry.stroke(0.0), 0.0, atol=1e-12)


@pytest.mark.parametrize("angle", [-0.4, -0.1, 0.0, 0.2])
def test_ratio_is_the_slope_of_the_stroke(angle):
    geometry = LeverGeometry.between(UPPER, LOWER, AXIS)
    h = 1e-6
    slope = (geometry.stroke(angle + h) - geometry.stroke(angle - h)) / (2 * h)
    assert_allclose(geometry.ratio(angle), slope, rtol=1e-8)


@pytest.mark.parametrize("stroke", [0.0, 0.1, 0.3])
@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_angle_inverts_the_stroke(stroke, mirror):
    turn = np.array([mirror, 1.0, 1.0])
    geometry = LeverGeometry.between(turn * UPPER, turn * LOWER, AXIS)
    angle = geometry.angle(stroke)
    assert_allclose(geometry.stroke(angle), stroke, atol=1e-12)
    # A trailing arm turns nose up as it closes, a leading one nose down.
    assert angle * mirror < 1e-12
    assert abs(angle) > 0.9 * stroke


def test_reach_is_the_dead_center():
    geometry = LeverGeometry.between(UPPER, LOWER, AXIS)
    end = geometry.angle(geometry.reach * (1 - 1e-12))
    assert abs(geometry.ratio(end)) < 1e-5
    with pytest.raises(ValueError, match="beyond what the arm can give"):
        geometry.angle(geometry.reach + 0.01)
    with pytest.raises(ValueError, match="almost no lever arm"):
        geometry.require_stroke(geometry.reach - 1e-6)
    geometry.require_stroke(0.4)


def test_degenerate_levers_are_refused():
    with pytest.raises(ValueError, match="lies on the pivot"):
        LeverGeometry.between(UPPER, 0.3 * AXIS, AXIS)
    with pytest.raises(ValueError, match="coincide"):
        LeverGeometry.between(UPPER, UPPER, AXIS)
