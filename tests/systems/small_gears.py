"""A plant of two free fittings, each with a sprung axle and one wheel."""

import numpy as np
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    FixedOffsetFrame,
    PrismaticJoint,
    RevoluteJoint,
    SpatialInertia,
)

NAMES = ("left", "right")


def two_gears(gravity: float = 0.0):
    """The plant and, by name, its fittings, wheels, struts and spin joints."""
    plant = MultibodyPlant(0.0)
    fittings, wheels, struts, spins = {}, {}, {}, {}
    for name in NAMES:
        fitting = plant.AddRigidBody(
            f"{name}_fitting", SpatialInertia.SolidSphereWithMass(90.0, 0.5)
        )
        piston = plant.AddRigidBody(
            f"{name}_piston", SpatialInertia.SolidSphereWithMass(60.0, 0.3)
        )
        wheel = plant.AddRigidBody(
            f"{name}_wheel", SpatialInertia.SolidSphereWithMass(80.0, 0.4)
        )
        below = RigidTransform(np.array([0.1, 0.0, -1.5]))
        cylinder = plant.AddFrame(
            FixedOffsetFrame(f"{name}_cylinder", fitting.body_frame(), below)
        )
        struts[name] = plant.AddJoint(
            PrismaticJoint(f"{name}_strut", cylinder, piston.body_frame(), [0, 0, 1])
        )
        spins[name] = plant.AddJoint(
            RevoluteJoint(
                f"{name}_spin", piston.body_frame(), wheel.body_frame(), [0, 1, 0]
            )
        )
        fittings[name], wheels[name] = fitting, wheel
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, -gravity])
    plant.Finalize()
    return plant, fittings, wheels, struts, spins


def violent_state(plant: MultibodyPlant, seed: int = 2) -> np.ndarray:
    """Positions and velocities of any kind, with unit quaternions."""
    rng = np.random.default_rng(seed)
    state = rng.normal(size=plant.num_multibody_states())
    for body in plant.GetFloatingBaseBodies():
        q = plant.get_body(body).floating_positions_start()
        state[q : q + 4] /= np.linalg.norm(state[q : q + 4])
    return state
