"""Conditions of holds along directions: rate, acceleration, wrench, errors."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from systems.attachment.attachment import RigidAttachment
from systems.attachment.attachment_points import AttachmentPoint, HoldPattern
from systems.attachment.bushing_attachment import BushingAttachment
from systems.tools.rotations import exp, log
from tests.systems.small_gears import two_gears

P_FN = np.array([0.3, -0.8, 0.5])
DIRECTIONS = np.array([[1.0, 0.2, 0.0], [0.0, 0.3, 2.0]])
FAR = np.array([-0.9, 0.4, 0.6])


def _points(**stay):
    _, fittings, *_ = two_gears()
    left, right = fittings.values()
    return [
        AttachmentPoint(fitting=left, hold="ball"),
        AttachmentPoint(fitting=left, hold=DIRECTIONS, p_FN=P_FN),
        AttachmentPoint(fitting=left, hold=[[0.0, 0.0, 1.0]], p_FN=FAR, **stay),
        AttachmentPoint(fitting=right),
    ]


class _Motion:
    """A body or node that moves with constant acceleration and turns."""

    def __init__(self, rng):
        self.p, self.v, self.a = rng.normal(size=(3, 3))
        self.theta, self.w, self.alpha = 0.5 * rng.normal(size=(3, 3))

    def pose(self, t):
        turn = exp((self.w * t + 0.5 * self.alpha * t * t)[None])[0]
        start = exp(self.theta[None])[0]
        return turn @ start, self.p + self.v * t + 0.5 * self.a * t * t

    def velocity(self, t):
        # Angular velocity by differences of the exact rotation: no formula twice.
        h = 1e-5
        R = [self.pose(t + s)[0] for s in (-h, h)]
        w = log((R[1] @ R[0].T)[None])[0] / (2 * h)
        return np.concatenate([w, self.v + self.a * t])


def _rows(pattern, fittings, nodes, t):
    of = [fittings[i] for i in pattern.fitting_of]
    R_WF, p_WF = map(np.array, zip(*(m.pose(t) for m in of)))
    R_WN, p_WN = map(np.array, zip(*(m.pose(t) for m in nodes)))
    V_WF = np.array([m.velocity(t) for m in of])
    V_WN = np.array([m.velocity(t) for m in nodes])
    gap = np.empty((len(nodes), 2, 6))
    gap[:, 0, :3] = log(R_WF @ R_WN.swapaxes(1, 2))
    gap[:, 0, 3:] = p_WF - p_WN
    gap[:, 1] = V_WF - V_WN
    return pattern.rows(gap, R_WF, p_WF, V_WF, p_WN, V_WN), V_WF, V_WN


def test_rate_and_acceleration_of_the_gap_along_directions():
    rng = np.random.default_rng(5)
    pattern = HoldPattern(_points())
    fittings = [_Motion(rng) for _ in range(2)]
    nodes = [_Motion(rng) for _ in range(4)]
    t, h = 0.2, 1e-4
    now, V_F, V_N = _rows(pattern, fittings, nodes, t)
    after, V_F1, V_N1 = _rows(pattern, fittings, nodes, t + h)
    before, V_F0, V_N0 = _rows(pattern, fittings, nodes, t - h)
    along = slice(3, 6)  # after the three rows of the ball
    assert_allclose(
        now.rate[along], ((after.gap - before.gap) / (2 * h))[along], rtol=1e-5
    )
    first = [0, 3]  # the two fittings, once each
    rate = now.on_fitting @ V_F[first].ravel() - now.on_node @ V_N.ravel()
    assert_allclose(rate, now.rate, atol=1e-12)
    A_F = (V_F1 - V_F0)[first].ravel() / (2 * h)
    A_N = (V_N1 - V_N0).ravel() / (2 * h)
    expected = (after.rate - before.rate) / (2 * h)
    found = now.on_fitting @ A_F - now.on_node @ A_N + now.bias
    assert_allclose(found[along], expected[along], rtol=1e-5, atol=1e-4)


def test_loads_along_directions_balance_on_both_sides():
    """No force and no moment is lost between fitting and node, however far it slid."""
    rng = np.random.default_rng(6)
    pattern = HoldPattern(_points())
    fittings = [_Motion(rng) for _ in range(2)]
    nodes = [_Motion(rng) for _ in range(4)]
    rows, *_ = _rows(pattern, fittings, nodes, 0.0)
    load = np.zeros(pattern.size)
    load[3:6] = rng.normal(size=3)
    on_fitting = (load @ rows.on_fitting).reshape(2, 2, 3)[0]
    on_nodes = -(load @ rows.on_node).reshape(4, 2, 3)
    p_F = fittings[0].p
    force = on_fitting[1] + on_nodes[:, 1].sum(axis=0)
    moment = on_fitting[0] + np.cross(p_F, on_fitting[1])
    moment = moment + on_nodes[:, 0].sum(axis=0)
    moment += sum(np.cross(n.p, w[1]) for n, w in zip(nodes, on_nodes))
    assert_allclose(force, 0.0, atol=1e-12)
    assert_allclose(moment, 0.0, atol=1e-12)


def test_one_rigid_node_each_is_the_plain_case():
    _, fittings, *_ = two_gears()
    points = [AttachmentPoint(fitting=body) for body in fittings.values()]
    assert HoldPattern(points).plain
    assert not HoldPattern(_points()).plain
    assert HoldPattern(_points()).size == 3 + 2 + 1 + 6


def test_bushings_keep_the_stiffness_of_a_stay():
    plant, *_ = two_gears()
    points = _points(stiffness=3e6, damping=2e3)
    points = [
        AttachmentPoint(
            fitting=plant.GetBodyByName(p.fitting.name()),
            hold=p.hold,
            p_FN=p.p_FN,
            stiffness=p.stiffness,
            damping=p.damping,
        )
        for p in points
    ]
    system = BushingAttachment(
        plant, points, translational_stiffness=2e8, rotational_stiffness=1e7
    )
    expected = [2e8] * 5 + [3e6] + [1e7] * 3 + [2e8] * 3
    assert_allclose(system._stiffness, expected)
    assert_allclose(system._damping, np.eye(12)[5] * 2e3)


def test_bad_holds_are_refused():
    plant, fittings, *_ = two_gears()
    left, right = fittings.values()
    rigid_right = AttachmentPoint(fitting=right)

    def points(*of_left):
        return [AttachmentPoint(fitting=left, **p) for p in of_left] + [rigid_right]

    with pytest.raises(ValueError, match="not independent"):
        points({"hold": [[1.0, 0, 0], [2.0, 0, 0]]})
    with pytest.raises(ValueError, match="a direction is"):
        points({"hold": [[0.0, 0, 0]]})
    with pytest.raises(ValueError, match=r"stiffness is -1\.0 N/m, expected > 0"):
        points({"hold": [[1.0, 0, 0]], "stiffness": -1.0})
    with pytest.raises(ValueError, match="belong to directions"):
        points({"hold": "ball", "stiffness": 1e6})
    with pytest.raises(ValueError, match="left_fitting: its points leave it free"):
        RigidAttachment(plant, points({"hold": "ball"}))
    # Six directions, but three of them through the ball: it can turn about them.
    stays = [{"hold": [d], "p_FN": 0.5 * np.array(d)} for d in np.eye(3)]
    with pytest.raises(ValueError, match="free to move"):
        RigidAttachment(plant, points({"hold": "ball"}, *stays))


def test_origins_are_the_points_that_place_the_fittings():
    points = _points()
    origins = HoldPattern(points).origins
    found = {i: fitting.name() for i, fitting in origins.items()}
    assert found == {0: "left_fitting", 3: "right_fitting"}


def test_a_fitting_that_no_point_holds_at_its_origin_cannot_be_placed():
    _, fittings, *_ = two_gears()
    left = next(iter(fittings.values()))
    places = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0])
    held = [
        AttachmentPoint(fitting=left, hold=np.eye(3)[list(rows)], p_FN=p)
        for rows, p in zip(([0, 1, 2], [0, 2], [0]), places)
    ]
    pattern = HoldPattern(held)
    with pytest.raises(ValueError, match="left_fitting: held along directions alone"):
        _ = pattern.origins
