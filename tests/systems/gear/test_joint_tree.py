"""Motion of wheels by the compiled tree against Drake's own."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    BallRpyJoint,
    FixedOffsetFrame,
    JacobianWrtVariable,
    PrismaticJoint,
    RevoluteJoint,
    SpatialInertia,
    WeldJoint,
)

from systems.gear.joint_tree import JointTree
from tests.systems.small_gears import two_gears, violent_state

SOLID = SpatialInertia.SolidSphereWithMass(10.0, 0.5)


def _skew_frame(plant, name, body, seed):
    rng = np.random.default_rng(seed)
    X = RigidTransform(RollPitchYaw(rng.normal(size=3)), rng.normal(size=3))
    return plant.AddFrame(FixedOffsetFrame(name, body.body_frame(), X))


def crooked_plant():
    """Every kind of joint, with frames that lie anyhow; one tree is on the ground."""
    plant = MultibodyPlant(0.0)
    names = ("free", "slide", "turn", "stuck", "turn_again", "on_rail", "on_pin")
    b = {name: plant.AddRigidBody(name, SOLID) for name in names}
    axis = np.array([0.6, 0.0, 0.8])
    seed = 0
    for kind, parent, child in (
        (PrismaticJoint, "free", "slide"),
        (RevoluteJoint, "slide", "turn"),
        (WeldJoint, "turn", "stuck"),
        (RevoluteJoint, "stuck", "turn_again"),
        (PrismaticJoint, None, "on_rail"),
        (RevoluteJoint, "on_rail", "on_pin"),
    ):
        seed += 2
        outer = plant.world_body() if parent is None else b[parent]
        frames = (
            _skew_frame(plant, f"{child}_p", outer, seed),
            _skew_frame(plant, f"{child}_c", b[child], seed + 1),
        )
        last = RigidTransform([0.1, 0.2, 0.3]) if kind is WeldJoint else axis
        plant.AddJoint(kind(f"{child}_joint", *frames, last))
    plant.Finalize()
    return plant, list(b.values())


@pytest.mark.parametrize("make", [crooked_plant, None])
def test_motion_and_jacobian_are_those_of_the_plant(make):
    if make is None:
        plant, _, wheels, _, _ = two_gears()
        bodies = list(wheels.values())
    else:
        plant, bodies = make()
    state = violent_state(plant, 4)
    context = plant.CreateDefaultContext()
    plant.SetPositionsAndVelocities(context, state)
    motion, jacobian, _ = JointTree(plant, bodies).motion(state)
    world = plant.world_frame()
    for i, body in enumerate(bodies):
        X, V = (
            plant.EvalBodyPoseInWorld(context, body),
            plant.EvalBodySpatialVelocityInWorld(context, body),
        )
        expected = [X.translation(), X.rotation().col(1), V.translational()]
        expected = np.concatenate([*expected, V.rotational()])
        assert_allclose(motion[i], expected, atol=1e-13)
        J = plant.CalcJacobianSpatialVelocity(
            context,
            JacobianWrtVariable.kV,
            body.body_frame(),
            np.zeros(3),
            world,
            world,
        )
        assert_allclose(jacobian[6 * i : 6 * i + 6], J, atol=1e-13)


def test_other_joints_are_named():
    plant = MultibodyPlant(0.0)
    body = plant.AddRigidBody("body", SOLID)
    plant.AddJoint(BallRpyJoint("gimbal", plant.world_frame(), body.body_frame(), 0.0))
    plant.Finalize()
    with pytest.raises(ValueError, match="gimbal is of the type ball_rpy"):
        JointTree(plant, [body])
