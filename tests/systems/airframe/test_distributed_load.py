"""Distributed load: resultant, moment, modal forces, power, shares, ports."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from systems.airframe.distributed_load import DistributedLoad, trimmed_shares
from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.tools.rotations import exp, quaternion_from_rotation
from systems.tools.table import Table
from tests.systems.synthetic_body import aircraft_body

WING = [*range(21, 28), *range(31, 38)]


def _pose(vector) -> list[float]:
    R_WB = exp(np.array([vector]))[0]
    return [*quaternion_from_rotation(R_WB), 1.0, 2.0, 3.0]


def test_load_is_the_sum_over_the_nodes():
    body = aircraft_body(9)
    rng = np.random.default_rng(3)
    shares = rng.uniform(size=len(WING))
    shares /= shares.sum()
    system = DistributedLoad(body, WING, shares, 7e5)
    context = system.CreateDefaultContext()
    turn, eta = 0.3 * rng.normal(size=3), 5.0 * rng.normal(size=9)
    system.GetInputPort("pose").FixValue(context, _pose(turn))
    system.GetInputPort("modal_amplitudes").FixValue(context, eta)
    load = system.GetOutputPort("load").Eval(context)
    R_WB = exp(turn[None])[0]
    moment, modal = np.zeros(3), np.zeros(9)
    for share, row in zip(shares, body.rows(WING)):
        f_B = R_WB.T @ [0.0, 0.0, 7e5 * share]
        arm = body.p_BN[row] - body.p_BG + body.translation[row] @ eta
        moment += np.cross(arm, f_B)
        modal += body.translation[row].T @ f_B
    assert_allclose(load[:3], [0.0, 0.0, 7e5])
    assert_allclose(load[3:6], moment, rtol=1e-12)
    assert_allclose(load[6:], modal, atol=1e-9 * np.abs(modal).max())


def test_power_on_the_airframe_is_force_times_velocity_of_the_nodes():
    body = aircraft_body(9)
    rng = np.random.default_rng(4)
    shares = np.full(len(WING), 1.0 / len(WING))
    lift = DistributedLoad(body, WING, shares, 7e5)
    airframe = FlexibleAirframe(body, WING)
    context, of_lift = airframe.CreateDefaultContext(), lift.CreateDefaultContext()
    eta, rate = 5.0 * rng.normal(size=(2, 9))
    pose = _pose(0.2 * rng.normal(size=3))
    airframe.set_state(
        context,
        quaternion=pose[:4],
        v_WG=rng.normal(size=3),
        w_B=rng.normal(size=3),
        modal_amplitudes=eta,
        modal_rates=rate,
    )
    port = airframe.GetOutputPort("external_power")
    assert port.Eval(context)[0] == 0.0  # nothing is connected
    lift.GetInputPort("pose").FixValue(of_lift, pose)
    lift.GetInputPort("modal_amplitudes").FixValue(of_lift, eta)
    load = lift.GetOutputPort("load").Eval(of_lift)
    airframe.GetInputPort("external_load").FixValue(context, load)
    velocity = airframe.GetOutputPort("node_velocity").Eval(context).reshape(-1, 6)
    expected = 7e5 * (shares @ velocity[:, 5])
    assert_allclose(port.Eval(context)[0], expected, rtol=1e-10)


def test_force_over_time_and_factor():
    body = aircraft_body(0)
    system = DistributedLoad(body, [6], [1.0], Table((0.5, 1.5), (4e5, 0.0)))
    context = system.CreateDefaultContext()
    force = system.GetOutputPort("force")
    for time, expected in ((0.0, 4e5), (1.0, 2e5), (3.0, 0.0)):
        context.SetTime(time)
        assert_allclose(force.Eval(context), expected)
    context.SetTime(0.0)
    system.set_factor(context, 0.5)
    assert_allclose(force.Eval(context), 2e5)
    pose, load = system.GetInputPort("pose"), system.GetOutputPort("load")
    assert system.HasDirectFeedthrough(pose.get_index(), load.get_index())
    assert not system.HasDirectFeedthrough(pose.get_index(), force.get_index())


@settings(max_examples=50, deadline=None)
@given(
    x=st.floats(-0.3, 0.3),
    y=st.floats(-0.5, 0.5),
    weights=st.lists(st.floats(0.5, 2.0), min_size=14, max_size=14),
)
def test_trimmed_shares_pass_the_point(x, y, weights):
    body = aircraft_body(0)
    p = body.p_BN[body.rows(WING)]
    base = np.array(weights) / np.sum(weights)
    point = base @ p + [x, y, 5.0]
    shares = trimmed_shares(p, point, weights)
    assert_allclose(shares.sum(), 1.0)
    assert_allclose(shares @ p[:, :2], point[:2], rtol=1e-9, atol=1e-9)
    assert shares.min() >= -1e-9


def test_bad_loads_are_refused():
    body = aircraft_body(3)
    p = body.p_BN[body.rows(WING)]
    with pytest.raises(ValueError, match="cannot carry a resultant through x 40"):
        trimmed_shares(p, [40.0, 0.0, 0.0])
    with pytest.raises(ValueError, match="2 shares for 14 nodes"):
        trimmed_shares(p, [16.0, 0.0, 0.0], [0.5, 0.5])
    with pytest.raises(ValueError, match="none negative"):
        trimmed_shares(p, [16.0, 0.0, 0.0], [-1.0] * 14)
    with pytest.raises(ValueError, match="1 shares for 14 nodes, expected one each"):
        DistributedLoad(body, WING, [1.0], 1e5)
    with pytest.raises(ValueError, match=r"no node \[4711\]"):
        DistributedLoad(body, [4711], [1.0], 1e5)
    with pytest.raises(ValueError, match="force is nan N"):
        DistributedLoad(body, [21], [1.0], float("nan"))
