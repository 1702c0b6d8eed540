"""What the forces of a static answer add up to, and how well they balance.

Resultants of loads and of forces of constraint, epsilon, and the forces that are left
at free points. Those are rounding: displacements carry 16 digits, so K u carries the
16th digit of the stiffest member's K times u. Beside a member that is 1e10 times as
stiff as others that is a share of the loads; it is said where it may mislead.
"""

import numpy as np

from fem.arrays import Float64
from fem.files.hdf5 import ResultFile
from fem.model.structure import Structure
from fem.model.weight import rigid_modes

UNBALANCED = 1e-6  # forces left, of the largest one: said from here on


def write_resultants(
    model: Structure,
    u_g: Float64,
    load: Float64,
    residual: Float64,
    results: ResultFile,
    name: str,
) -> None:
    """Writes sums of loads and of forces of constraint, and epsilon, as an F06 begins.

    Of each component of the forces what it adds to the resultant, (6, 6), about the
    reference point of the weight table; epsilon is the work of the residual over that
    of the loads, both (2,).

    Args:
        model: the structure.
        u_g, load, residual: displacements, loads, forces of constraint, (g,) each.
        results, name: where to write.
    """
    points = model.points
    arm = rigid_modes(points, model.weight.reference)
    rotation = points.basic_rotation()
    spc_force = model.elimination.spc_force(residual)
    for label, vector in (("oload", load), ("spc_force", spc_force)):
        basic = rotation @ vector
        grids = 6 * len(points.grid_id)
        parts = np.zeros((6, points.size))
        for k in range(6):
            parts[k, k:grids:6] = basic[k:grids:6]
        results.write(f"{name}/{label}_resultant", (rotation.T @ parts.T).T @ arm)
    work = float(load @ u_g)
    free = model.elimination.T.T @ residual
    error = float((model.elimination.T.T @ u_g) @ free)
    epsilon = error / work if work else 0.0
    results.write(f"{name}/epsilon", np.array([epsilon, work]))


def unbalanced(model: Structure, load: Float64, residual: Float64) -> float:
    """Sum of the forces left at free points over the largest load or reaction.

    Translations alone: forces, whatever the units. A bound of what the sums of loads
    and reactions differ by.

    Args:
        model: the structure.
        load, residual: loads, forces of constraint, (g,) each.
    """
    elimination = model.elimination
    force = np.ones(model.points.size, bool)
    rotations = np.arange(6 * len(model.points.grid_id)) % 6 > 2
    force[: len(rotations)] = ~rotations
    left = np.abs(elimination.T.T @ residual)[force[elimination.f]].sum()
    forces = np.abs([load, elimination.spc_force(residual)])[:, force]
    largest = forces.max(initial=0.0)
    return float(left / largest) if largest > 0 else 0.0
