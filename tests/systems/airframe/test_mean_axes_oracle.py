"""Constant inertia in mean axes against a chain of rigid bodies, solved exactly.

The bounds are those of the table in docs/accuracy.md, with a margin of a half.
"""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tests.systems.hinged_chain import FIRST_HZ, LENGTH, MASS, difference, make_chain

ROLL, PITCH, YAW = np.eye(3)


@pytest.fixture(scope="module")
def chain():
    return make_chain(6.0)


def test_modal_body_is_that_of_the_chain(chain):
    body = chain.body
    assert_allclose(body.mass, MASS, rtol=1e-6)
    assert_allclose(body.frequency[0], FIRST_HZ, rtol=1e-6)
    # Of a slender bar: m l²/12, and the pieces' own radius.
    assert_allclose(body.inertia_G[1, 1], MASS * (LENGTH**2 / 12 + 1.0), rtol=1e-3)
    # Elastic modes carry neither momentum nor moment of momentum.
    assert np.abs(body.translation.sum(axis=0)).max() < 1e-6
    piece = MASS / len(body.node_id)
    orbital = np.cross(body.p_BN[:, None], body.translation.swapaxes(1, 2))
    own = piece * np.array([2.0, 1.0 + (LENGTH / 11) ** 2 / 12, 0.0])
    own[2] = own[1]
    moment = piece * orbital.sum(axis=0) + (body.rotation.sum(axis=0) * own[:, None]).T
    assert np.abs(moment).max() < 1e-3


@pytest.mark.parametrize(
    ("peak", "spin", "across", "middle", "tip"),
    [
        (5e4, 0.0 * ROLL, 0.001, 0.0015, 0.001),
        (1e6, 0.0 * ROLL, 0.0035, 0.0035, 0.0035),
        (1e6, 0.1 * ROLL, 0.0045, 0.007, 0.0075),
        (1e6, 0.1 * YAW, 0.003, 0.003, 0.007),
        (5e5, 0.3 * PITCH, 0.006, 0.006, 0.012),
    ],
)
def test_errors_stay_within_the_statement(chain, peak, spin, across, middle, tip):
    found = difference(chain, peak, spin)
    assert found.deflection < across
    assert found.middle < middle
    assert found.tip < tip


def test_error_without_rotation_is_of_second_order_in_the_amplitude(chain):
    small, large = (difference(chain, peak, 0.0 * ROLL) for peak in (1e6, 3e6))
    assert_allclose(large.amplitude / small.amplitude, 3.0, rtol=0.01)
    assert 6.0 < large.deflection / small.deflection < 12.0
    # Only the exact model draws the tip in, by the square of the slope.
    assert_allclose(large.shortening / small.shortening, 3.0, rtol=0.05)


def test_plane_of_vibration_is_carried_round_where_both_planes_are_equal():
    """The neglected Coriolis coupling of modes shows most with equal frequencies."""
    found = difference(make_chain(1.0), 5e5, 0.1 * ROLL)
    assert 0.05 < found.deflection < 0.12
