"""Side load of a strut, and the bearing reactions that it makes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from systems.shock_absorber.friction import bearing_reactions
from systems.shock_absorber.side_load import SideLoad, side_loads, side_loads_of_floats

UP, AXLE = np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])


def _at_ground(force, radius):
    """Wrench at the wheel's center of a force at the ground below it."""
    return np.concatenate([np.cross([0.0, 0.0, -radius], force), force])


def _load(wrenches, offsets, brakes=None, axis=UP, axle=AXLE):
    brakes = np.zeros(len(wrenches)) if brakes is None else np.asarray(brakes)
    wheels = np.tile(np.concatenate([np.zeros(3), axle, np.zeros(6)]), len(wrenches))
    first = np.array([0, len(wrenches)])
    given = axis, wheels, np.ravel(wrenches), np.array(offsets), brakes, first
    found = side_loads(*given)
    assert_allclose(found, side_loads_of_floats(*given), rtol=1e-9, atol=1e-7)
    return found


def test_drag_acts_at_the_axle_and_a_side_force_at_the_ground():
    drag = _at_ground([3e4, 0.0, 1e5], 0.5)
    assert_allclose(_load([drag, drag], [-0.4, 0.4]), [6e4, 0.0, 0.0], atol=1e-8)
    side = _at_ground([0.0, 2e4, 1e5], 0.5)
    found = _load([side, side], [-0.4, 0.4])
    assert_allclose(found, [4e4, 4e4 * 0.5, 0.0], atol=1e-8)


def test_a_braked_wheel_hands_its_moment_to_the_piston():
    drag = _at_ground([3e4, 0.0, 1e5], 0.5)
    # In a steady roll the brake balances the drag's moment about the axle.
    found = _load([drag], [0.0], brakes=[-drag[1]])
    assert_allclose(found, [3e4, 3e4 * 0.5, 0.0], atol=1e-8)


def test_unequal_wheels_bend_the_piston_without_a_side_force():
    left, right = (_at_ground([1e4, 0.0, load], 0.5) for load in (8e4, 1e5))
    force, along, across = _load([left, right], [-0.4, 0.4])
    assert_allclose([force, along, across], [2e4, 0.0, 0.4 * 2e4], atol=1e-7)


@given(*[st.floats(-1e5, 1e5)] * 6, st.floats(-0.5, 0.5))
def test_reactions_hold_the_piston(fx, fy, mx, my, fz, mz, rake):
    """Equilibrium of the piston, with the bearings' forces found by least squares."""
    axis = np.array([np.sin(rake), 0.0, np.cos(rake)])
    wrench = np.array([mx, my, mz, fx, fy, fz])
    force, along, across = _load([wrench], [0.3], axis=axis)
    arm, apart, stroke = 0.9, 0.5, 0.1
    f = wrench[3:]
    m = wrench[:3] - (wrench[:3] @ AXLE) * AXLE + 0.3 * np.cross(AXLE, f)
    turn = np.array([np.cross(axis, e) for e in np.eye(3)]).T  # axis × .
    below = arm - stroke
    # Unknown forces at the lower and the upper bearing, across the axis.
    rows = np.vstack(
        [
            np.hstack([np.eye(3), np.eye(3)]),
            np.hstack([np.zeros((3, 3)), (apart + stroke) * turn]),
            np.hstack([axis, np.zeros(3)])[None],
            np.hstack([np.zeros(3), axis])[None],
        ]
    )
    across_axis = f - (f @ axis) * axis
    bending = m - (m @ axis) * axis - below * np.cross(axis, f)
    wanted = np.concatenate([-across_axis, -bending, [0.0, 0.0]])
    both = np.linalg.lstsq(rows, wanted, rcond=None)[0]
    expected = np.linalg.norm(both[:3]) + np.linalg.norm(both[3:])
    found = bearing_reactions(force, stroke, arm, apart, (along, across))
    assert_allclose(found, expected, rtol=1e-6, atol=1e-2)


def test_system_gathers_wheels_and_brakes():
    system = SideLoad([{"left": -0.4, "right": 0.4}], ["left"])
    context = system.CreateDefaultContext()
    side = _at_ground([1e4, 2e4, 1e5], 0.5)
    wheel = np.concatenate([np.zeros(3), AXLE, np.zeros(6)])
    values = {
        "strut_axes": UP,
        "brake_left": [3e3],
        "wheels": np.tile(wheel, 2),
        "wrench": np.tile(side, 2),
    }
    for name, value in values.items():
        system.GetInputPort(name).FixValue(context, value)
    found = system.GetOutputPort("side_load").Eval(context)
    assert_allclose(found, _load([side, side], [-0.4, 0.4], brakes=[3e3, 0.0]))
    assert found[0] == pytest.approx(np.hypot(2e4, 4e4))
