"""Wheel and strut kinematics against the plant and difference quotients."""

import numpy as np
from numpy.testing import assert_allclose
from pydrake.autodiffutils import AutoDiffXd, ExtractValue

from systems.gear.wheel_kinematics import WheelKinematics, WheelKinematics_
from tests.systems.small_gears import NAMES, two_gears, violent_state


def _outputs(system, state):
    context = system.CreateDefaultContext()
    system.GetInputPort("plant_state").FixValue(context, state)
    return {
        system.get_output_port(i).get_name(): system.get_output_port(i).Eval(context)
        for i in range(system.num_output_ports())
    }


def test_ports_give_position_axle_and_their_rates():
    plant, _, wheels, struts, _ = two_gears()
    system = WheelKinematics(plant, wheels, struts)
    state = violent_state(plant)
    context = plant.CreateDefaultContext()
    plant.SetPositionsAndVelocities(context, state)
    v = plant.GetVelocities(context)
    q_rate = plant.MapVelocityToQDot(context, v)
    h = 1e-6
    shift = h * np.concatenate([q_rate, np.zeros_like(v)])
    now = _outputs(system, state)
    after, before = _outputs(system, state + shift), _outputs(system, state - shift)
    for name in NAMES:
        p, axle, velocity, spin = now[f"wheel_{name}"].reshape(4, 3)
        X = wheels[name].EvalPoseInWorld(context)
        assert_allclose(p, X.translation())
        assert_allclose(axle, X.rotation().matrix()[:, 1])
        slope = (after[f"wheel_{name}"] - before[f"wheel_{name}"]) / (2 * h)
        assert_allclose(velocity, slope[:3], atol=1e-8)
        assert_allclose(np.cross(spin, axle), slope[3:6], atol=1e-8)
        stroke, rate = now[f"strut_{name}"]
        assert stroke == struts[name].get_translation(context)
        assert rate == struts[name].get_translation_rate(context)
        # The piston does not turn in its cylinder: its z axis is the strut's.
        piston = struts[name].child_body().EvalPoseInWorld(context).rotation()
        at = NAMES.index(name)
        assert_allclose(now["strut_axes"].reshape(-1, 3)[at], piston.matrix()[:, 2])
        assert_allclose(now["struts"].reshape(-1, 2)[at], now[f"strut_{name}"])
        assert_allclose(now["wheels"].reshape(-1, 12)[at], now[f"wheel_{name}"])


def test_a_stroke_lifts_the_axle_toward_the_fitting():
    plant, _, wheels, struts, _ = two_gears()
    context = plant.CreateDefaultContext()
    struts["left"].set_translation(context, 0.2)
    state = plant.GetPositionsAndVelocities(context)
    out = _outputs(WheelKinematics(plant, wheels, struts), state)
    assert_allclose(out["wheel_left"][:3], [0.1, 0.0, -1.3], atol=1e-15)
    assert_allclose(out["strut_left"], [0.2, 0.0])
    assert_allclose(out["wheel_right"][:3], [0.1, 0.0, -1.5], atol=1e-15)
    assert_allclose(out["strut_axes"][:3], [0.0, 0.0, 1.0], atol=1e-15)


def test_contexts_do_not_share_state():
    plant, _, wheels, struts, _ = two_gears()
    system = WheelKinematics(plant, wheels, struts)
    contexts = [system.CreateDefaultContext() for _ in range(2)]
    states = [violent_state(plant, seed) for seed in (5, 6)]
    for context, state in zip(contexts, states):
        system.GetInputPort("plant_state").FixValue(context, state)
    port = system.GetOutputPort("wheel_left")
    first, second = (port.Eval(context) for context in contexts)
    assert np.abs(first - second).max() > 0.1
    assert_allclose(port.Eval(contexts[0].Clone()), first)
    system.GetInputPort("plant_state").FixValue(contexts[0], states[1])
    assert_allclose(port.Eval(contexts[0]), second)


def test_kinematics_in_autodiffxd_are_those_of_floats():
    plant, _, wheels, struts, spins = two_gears()
    plain = WheelKinematics(plant, wheels, struts, spins)
    other = plain.ToAutoDiffXd()
    assert isinstance(other, WheelKinematics_[AutoDiffXd])
    state = violent_state(plant)
    contexts = [system.CreateDefaultContext() for system in (plain, other)]
    plain.GetInputPort("plant_state").FixValue(contexts[0], state)
    seeded = np.array([AutoDiffXd(x, row) for x, row in zip(state, np.eye(len(state)))])
    other.GetInputPort("plant_state").FixValue(contexts[1], seeded)
    for i in range(plain.num_output_ports()):
        expected, found = (
            system.get_output_port(i).Eval(context)
            for system, context in zip((plain, other), contexts)
        )
        found = np.atleast_2d(found).reshape(-1, 1)
        assert_allclose(ExtractValue(found).ravel(), expected, rtol=1e-12, atol=1e-12)
