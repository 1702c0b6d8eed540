"""Gears held at several nodes: load split, equivalence, energy, errors."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drake_landing.landing.diagram import MakeLandingDiagram
from drake_landing.landing.equilibrium import set_static_equilibrium
from systems.tools.rotations import rotation_from_quaternion
from tests.drake_landing.landing_gears import aircraft_gears, changed
from tests.drake_landing.landing_run import land
from tests.systems.synthetic_body import aircraft_body

GRAVITY = 9.80665
LOAD = "attachment.load_in_airframe_axes"
SINK_RATE = 1.83
# A bearing that holds two directions and a stay that holds one, on wing nodes.
BEARING = {"name": "bearing", "node": 22, "directions": [(1, 0, 0), (0, 0, 1)]}
STAY = {"name": "stay", "node": 21, "directions": [(0.3, -0.2, 1.0)]}


def _gears(**hold):
    nose, left, right = aircraft_gears()
    return nose, changed(left, **hold), right


def _determinate():
    return _gears(attachment="ball", further_attachments=[BEARING, STAY])


def _eval(system, context, port):
    return system.GetOutputPort(port).Eval(system.GetMyContextFromRoot(context))


def test_attachments_are_named_and_counted():
    gear = _determinate()[1]
    assert gear.attachments == {
        "main_left": 102,
        "main_left_bearing": 22,
        "main_left_stay": 21,
    }


def test_static_split_is_that_of_statics():
    """Three, two and one direction: six equations of equilibrium for six loads."""
    gears = _determinate()
    landing = MakeLandingDiagram(aircraft_body(0), gears, gravity=GRAVITY)
    context = landing.diagram.CreateDefaultContext()
    set_static_equilibrium(landing, context)
    pose = _eval(landing.airframe, context, "pose")
    R_WB, p_WG = rotation_from_quaternion(pose[:4]), pose[4:]
    body = landing.body
    # All that acts on the left main gear: its weight and the runway's push.
    plant = landing.plant.GetMyContextFromRoot(context)
    bodies = landing.bodies["main_left"]
    force, moment = np.zeros(3), np.zeros(3)
    for part in (bodies.fitting, *bodies.parts.values(), *bodies.wheels.values()):
        weight = np.array([0.0, 0.0, -GRAVITY * part.default_mass()])
        force += weight
        at = part.EvalPoseInWorld(plant).multiply(
            part.CalcCenterOfMassInBodyFrame(plant)
        )
        moment += np.cross(at, weight)
    for wheel in gears[1].wheel_names:
        wrench = landing.tires[wheel].wrench(context)
        at = bodies.wheels[wheel].EvalPoseInWorld(plant).translation()
        force += wrench[3:]
        moment += wrench[:3] + np.cross(at, wrench[3:])
    nodes = body.p_BN[body.rows([102, 22, 21])]
    at = p_WG + (nodes - body.p_BG) @ R_WB.T
    unit = [np.eye(3), *(np.array(h["directions"], float) for h in (BEARING, STAY))]
    columns = [
        np.concatenate([d @ R_WB.T, np.cross(p, d @ R_WB.T)], axis=1)
        for p, d in zip(at, unit)
    ]
    split = np.linalg.solve(np.concatenate(columns).T, np.concatenate([force, moment]))
    expected = [split[:3], split[3:5] @ unit[1], split[5:] @ unit[2]]
    load = _eval(landing.attachment, context, "load_in_airframe_axes").reshape(5, 6)
    found = load[1:4]
    scale = np.abs(found).max()
    assert scale > 1e5
    assert_allclose(found[:, 3:], 0.0, atol=1e-9 * scale)
    assert_allclose(found[:, :3], expected, atol=1e-7 * scale)


def test_split_does_not_change_the_landing_of_a_rigid_aircraft():
    one = MakeLandingDiagram(aircraft_body(0), aircraft_gears())
    three = MakeLandingDiagram(aircraft_body(0), _determinate())
    case = {"duration": 0.1, "step": 5e-4}
    loads = [land(landing, **case)[LOAD] for landing in (one, three)]
    single, several = loads[0].reshape(3, 6, -1), loads[1].reshape(5, 6, -1)
    body = one.body
    arms = body.p_BN[body.rows([102, 22, 21])] - body.p_BN[body.rows(102)]
    force = several[1:4, :3].sum(axis=0)
    moment = several[1:4, 3:].sum(axis=0)
    moment += np.cross(arms[:, :, None], several[1:4, :3], axis=1).sum(axis=0)
    scale = np.abs(single).max()
    assert_allclose(force, single[1, :3], atol=1e-6 * scale)
    assert_allclose(moment, single[1, 3:], atol=1e-6 * scale)
    # It is split: the bearing has a good part of the load.
    assert np.abs(several[2]).max() > 0.1 * scale


@pytest.mark.parametrize(
    "hold",
    [
        {"attachment": "ball", "further_attachments": [BEARING, STAY]},
        {"further_attachments": [STAY]},
        {"further_attachments": [STAY | {"stiffness": 2e7, "damping": 1e4}]},
    ],
    ids=["determinate", "rigid and stay", "rigid and elastic stay"],
)
def test_energy_closes_and_the_gap_stays_shut(hold):
    landing = MakeLandingDiagram(aircraft_body(20), _gears(**hold))
    run = land(landing, duration=0.1, sink_rate=SINK_RATE)
    mass = landing.body.mass + sum(gear.mass for gear in landing.gears)
    total = run["energy_budget.total"][0]
    assert np.abs(total - total[0]).max() < 1e-4 * 0.5 * mass * SINK_RATE**2
    load = run[LOAD].reshape(-1, 6, len(run.time))
    further = load[2:-1]
    assert np.abs(further[:, :3]).max() > 1e3
    assert np.abs(further[:, 3:]).max() == 0.0
    elastic = "stiffness" in hold["further_attachments"][0]
    gap = run["attachment.gap"].reshape(-1, 12, len(run.time))
    along = np.array(STAY["directions"][0]) / np.linalg.norm(STAY["directions"][0])
    sliding = np.abs(along @ gap[-2, 3:6] - along @ gap[-2, 3:6, :1])
    if elastic:
        assert sliding.max() > 1e-4
    # Held nodes: the gap is shut; the stay's node moves freely across the stay.
    assert np.abs(gap[1, 3:6]).max() < 1e-7
    assert np.abs(gap[-2, 3:6] - gap[-2, 3:6, :1]).max() > 1e-4


def test_stiff_stay_carries_what_a_rigid_one_does():
    loads = []
    for stiffness in (None, 2e9):
        stay = STAY | {"stiffness": stiffness}
        gears = _gears(further_attachments=[stay])
        landing = MakeLandingDiagram(aircraft_body(40), gears, gravity=GRAVITY)
        context = landing.diagram.CreateDefaultContext()
        set_static_equilibrium(landing, context)
        loads.append(_eval(landing.attachment, context, "load_in_airframe_axes"))
    scale = np.abs(loads[0]).max()
    assert_allclose(loads[1], loads[0], atol=0.02 * scale)


def test_redundant_hold_of_a_rigid_airframe_is_refused():
    gears = _gears(further_attachments=[STAY])
    with pytest.raises(ValueError, match="main_left is held in 7 directions"):
        MakeLandingDiagram(aircraft_body(0), gears)
    elastic = _gears(further_attachments=[STAY | {"stiffness": 1e7}])
    MakeLandingDiagram(aircraft_body(0), elastic)


@pytest.mark.parametrize(
    ("stay", "message"),
    [
        ({"node": 999}, "attachment main_left_stay .* no node .999."),
        ({"directions": [(1, 0, 0), (2, 0, 0)]}, "not independent"),
    ],
)
def test_bad_holds_are_refused(stay, message):
    with pytest.raises(ValueError, match=message):
        MakeLandingDiagram(aircraft_body(3), _gears(further_attachments=[STAY | stay]))


@pytest.mark.parametrize(
    ("stay", "message"),
    [
        ({"directions": []}, "at least 1 item"),
        ({"directions": [(0, 0, 0)]}, "expected a direction"),
        ({"node": 102}, "found node 102 twice"),
        ({"damping": 1e3}, "expected a stiffness"),
        ({"stiffness": -1.0}, "greater than 0"),
    ],
)
def test_bad_data_are_refused(stay, message):
    with pytest.raises(ValueError, match=message):
        _gears(further_attachments=[STAY | stay])
