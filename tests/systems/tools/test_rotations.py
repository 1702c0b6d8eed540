"""Rotations against matrix exponentials and difference quotients."""

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from systems.tools import rotations

ANGLES = [0.0, 1e-9, 1e-3, 0.3, 0.49, 0.51, 1.5, 3.0]


def _vectors(angle: float) -> np.ndarray:
    axis = np.random.default_rng(3).normal(size=(4, 3))
    return angle * axis / np.linalg.norm(axis, axis=1)[:, None]


@pytest.mark.parametrize("angle", ANGLES)
def test_exp_is_the_matrix_exponential_and_log_its_inverse(angle):
    theta = _vectors(angle)
    R = rotations.exp(theta)
    expected = [expm(rotations.skew(t)) for t in theta]
    np.testing.assert_allclose(R, expected, atol=1e-14)
    np.testing.assert_allclose(rotations.log(R), theta, atol=1e-14)


@pytest.mark.parametrize("angle", ANGLES)
def test_left_jacobian_gives_the_angular_velocity_and_acceleration(angle):
    theta = _vectors(angle)
    rate = np.random.default_rng(4).normal(size=(4, 3))
    h = 1e-5

    def angular_velocity(t: float) -> np.ndarray:
        _, J, _ = rotations.rotation_kinematics(theta + t * rate, rate)
        return (J @ rate[:, :, None])[:, :, 0]

    R, _, bias = rotations.rotation_kinematics(theta, rate)
    R_dot = (rotations.exp(theta + h * rate) - rotations.exp(theta - h * rate)) / (
        2 * h
    )
    W = R_dot @ R.swapaxes(1, 2)
    found = np.stack([W[:, 2, 1], W[:, 0, 2], W[:, 1, 0]], axis=1)
    np.testing.assert_allclose(angular_velocity(0.0), found, atol=1e-9)
    slope = (angular_velocity(h) - angular_velocity(-h)) / (2 * h)
    np.testing.assert_allclose(bias, slope, atol=1e-9)


def test_quaternions_agree_with_scipy():
    for R in Rotation.random(20, random_state=5):
        q = R.as_quat(scalar_first=True)
        np.testing.assert_allclose(
            rotations.rotation_from_quaternion(3.0 * q), R.as_matrix(), atol=1e-14
        )
        found = rotations.quaternion_from_rotation(R.as_matrix())
        np.testing.assert_allclose(found, q * np.sign(q[0]), atol=1e-14)


def test_quaternion_survives_half_a_turn():
    q = rotations.quaternion_from_rotation(np.diag([-1.0, 1.0, -1.0]))
    np.testing.assert_allclose(np.abs(q), [0, 0, 1, 0], atol=1e-15)


@pytest.mark.parametrize("angle", [0.0, 1e-12, 1e-6, 0.499999, 0.500001, 1.6, 3.14159])
@pytest.mark.parametrize("axis", np.vstack([np.eye(3), [[0.36, -0.48, 0.8]]]))
def test_log_finds_small_and_large_vectors(angle, axis):
    theta = angle * axis[None]
    found = rotations.log(rotations.exp(theta))
    np.testing.assert_allclose(found, theta, rtol=1e-9, atol=1e-15)
