"""A leg from the stiffness at its axle, as a finite-element model reduces to it.

With C = K⁻¹ the motion of the axle under loads on it, root clamped, and unit vectors a
of each bending's hinge and d of its motion at the axle: a hinge at the distance
h = (d C d)/(a C d) above the axle, deflection over slope under a force, has both right.
Deflections along d and the twist then have the stiffness

    K_q = Jᵀ C_q⁻¹ J,   C_q = D C Dᵀ,   J = diag(h, h, 1),

D the three directions: coupling of bendings and torsion stays. The axle's motion along
the strut is that of the shock absorber, and free of load in C.
"""

import numpy as np
import numpy.typing as npt

Float64 = npt.NDArray[np.float64]


def root_distance(stiffness: Float64, about: Float64, axis: Float64) -> float:
    """Axle to hinge, m.

    Args:
        stiffness: (6, 6) at the axle: forces and moments per translation and rotation.
        about: (3,) of the hinge.
        axis: (3,) of the strut, up.

    Raises:
        ValueError: the leg does not turn the way it bends.
    """
    deflection, slope = _under_force(stiffness, about, axis)
    if not slope > 0.0:
        raise ValueError(
            "leg.matrix: under a force the axle turns against its deflection, expected "
            "a leg that is clamped above its axle"
        )
    return deflection / slope


def hinge_stiffness(
    stiffness: Float64, hinges: Float64, axis: Float64, arms: Float64
) -> Float64:
    """(3, 3) K of the hinges fore and aft, to the side, and of torsion, N m/rad.

    Args:
        stiffness, axis: as above.
        hinges: (3, 3) unit vectors of the hinges.
        arms: (3,) deflection of the axle per angle, m; 1 for the torsion.
    """
    flexibility = np.linalg.inv(stiffness)
    none = np.zeros(3)
    across = [np.cross(axis, about) for about in hinges[:2]]
    rows = np.array([np.r_[d, none] for d in across] + [np.r_[none, hinges[2]]])
    K = np.linalg.inv(rows @ flexibility @ rows.T) * np.outer(arms, arms)
    return 0.5 * (K + K.T)


def turned(stiffness: Float64, R: Float64) -> Float64:
    """The matrix in other axes, R (3, 3) their components."""
    both = np.kron(np.eye(2), R)
    return both @ stiffness @ both.T


def _under_force(
    stiffness: Float64, about: Float64, axis: Float64
) -> tuple[float, float]:
    """Deflection and slope of the axle per force across, m/N and rad/N."""
    along = np.cross(axis, about)
    motion = np.linalg.solve(stiffness, np.r_[along, np.zeros(3)])
    return float(motion[:3] @ along), float(motion[3:] @ about)
