"""Grid point weight generator: rigid-body mass, center of gravity, inertia.

MO is the mass matrix of the model moving as a rigid body about the reference point.
Where the mass differs by direction (scalar masses), S turns into the axes of its
translational part, and each axis has its own center of gravity, as Nastran's table
shows it.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.arrays import Float64
from fem.geometry.points import Points
from fem.geometry.rigid_motion import rigid_motion


@dataclass(frozen=True, kw_only=True)
class Weight:
    """Nastran's weight table; units of the deck, basic frame where not said.

    Attributes:
        reference: (3,) reference point.
        MO: (6, 6) rigid-body mass about it.
        S: (3, 3) columns are the principal mass axes.
        mass: (3,) along the axes of S.
        cg: (3, 3) row i: center of gravity for the mass of axis i, from the reference,
            axes of S.
        IS: (3, 3) inertia tensor about the center of gravity, axes of S; off-diagonal
            terms have Nastran's sign, + ∫ x y dm.
        IQ: (3,) principal moments.
        Q: (3, 3) columns are the principal directions, axes of S.
    """

    reference: Float64
    MO: Float64
    S: Float64
    mass: Float64
    cg: Float64
    IS: Float64
    IQ: Float64
    Q: Float64

    @property
    def total(self) -> float:
        """Mean of three axes, equal unless masses act in one direction; deck units."""
        return float(self.mass.mean())

    @property
    def center(self) -> Float64:
        """(3,) center of gravity, basic coordinates."""
        x = np.array([self.cg[1, 0], self.cg[0, 1], self.cg[0, 2]])
        return self.reference + self.S @ x

    @property
    def inertia(self) -> Float64:
        """(3, 3) tensor about the center of gravity, basic axes, products negative."""
        tensor = 2.0 * np.diag(np.diag(self.IS)) - self.IS
        return self.S @ tensor @ self.S.T


def rigid_modes(points: Points, reference: npt.ArrayLike) -> Float64:
    """(g, 6) displacements by unit rigid motions about a point, displacement frames.

    Scalar points stay at rest.
    """
    lever = points.xyz - np.asarray(reference, float)
    modes = np.zeros((points.size, 6))
    motion = rigid_motion(lever, points.rotation)
    modes[: 6 * len(lever)] = motion.reshape(-1, 6)
    return modes


def weigh(
    points: Points,
    mass: sp.csr_matrix,
    *,
    reference: npt.ArrayLike = (0.0, 0.0, 0.0),
    wtmass: float = 1.0,
) -> Weight:
    """Weight table of a mass matrix.

    Args:
        points: positions.
        mass: (g, g) g-set mass.
        reference: (3,) point about which MO is taken (the grid of PARAM GRDPNT).
        wtmass: PARAM WTMASS that is part of the mass and taken out of the table.
    """
    modes = rigid_modes(points, reference)
    rigid = modes.T @ (mass @ modes) / wtmass
    rigid = 0.5 * (rigid + rigid.T)
    mt, mtr, mr = rigid[:3, :3], rigid[:3, 3:], rigid[3:, 3:]
    axes = np.eye(3)
    diagonal = np.linalg.norm(np.diag(mt))
    if np.linalg.norm(mt[np.triu_indices(3, 1)]) > 1e-6 * diagonal:
        axes = _right_handed(np.linalg.eigh(mt)[1])
        mt, mtr, mr = (axes.T @ part @ axes for part in (mt, mtr, mr))
    m = np.diag(mt).copy()
    cg = _centers(m, mtr)
    inertia = _about_center(m, cg, mr)
    tensor = 2.0 * np.diag(np.diag(inertia)) - inertia
    principal, directions = np.linalg.eigh(tensor)
    return Weight(
        reference=np.asarray(reference, float),
        MO=rigid,
        S=axes,
        mass=m,
        cg=cg,
        IS=inertia,
        IQ=principal,
        Q=_right_handed(directions),
    )


def rigid_mass_properties(mass: Float64) -> tuple[float, Float64, Float64]:
    """Mass, center (3,) and inertia about it (3, 3) from a rigid mass matrix (6, 6).

    The center is relative to the point that the motions turn about.
    """
    total = float(np.trace(mass[:3, :3])) / 3
    moment = mass[3:, :3] / total
    center = 0.5 * np.array(
        [
            moment[2, 1] - moment[1, 2],
            moment[0, 2] - moment[2, 0],
            moment[1, 0] - moment[0, 1],
        ]
    )
    inertia = mass[3:, 3:] - total * (center @ center * np.eye(3))
    inertia += total * np.outer(center, center)
    return total, center, 0.5 * (inertia + inertia.T)


def _centers(m: Float64, mtr: Float64) -> Float64:
    """(3, 3) row i: center for mass i; the coordinate along i comes from Mtr_ii."""
    safe = np.where(m != 0.0, m, np.inf)
    return (
        np.array(
            [
                [mtr[0, 0], -mtr[0, 2], mtr[0, 1]],
                [mtr[1, 2], mtr[1, 1], -mtr[1, 0]],
                [-mtr[2, 1], mtr[2, 0], mtr[2, 2]],
            ]
        )
        / safe[:, None]
    )


def _about_center(m: Float64, cg: Float64, mr: Float64) -> Float64:
    """(3, 3) moments of inertia and, off the diagonal, + ∫ x y dm about the center."""
    (mx, my, mz) = m
    inertia = np.empty((3, 3))
    inertia[0, 0] = mr[0, 0] - my * cg[1, 2] ** 2 - mz * cg[2, 1] ** 2
    inertia[1, 1] = mr[1, 1] - mz * cg[2, 0] ** 2 - mx * cg[0, 2] ** 2
    inertia[2, 2] = mr[2, 2] - mx * cg[0, 1] ** 2 - my * cg[1, 0] ** 2
    inertia[0, 1] = inertia[1, 0] = -mr[0, 1] - mz * cg[2, 0] * cg[2, 1]
    inertia[0, 2] = inertia[2, 0] = -mr[0, 2] - my * cg[1, 0] * cg[1, 2]
    inertia[1, 2] = inertia[2, 1] = -mr[1, 2] - mx * cg[0, 1] * cg[0, 2]
    return inertia


def _right_handed(axes: Float64) -> Float64:
    return axes if np.linalg.det(axes) > 0.0 else axes * np.array([1.0, 1.0, -1.0])
