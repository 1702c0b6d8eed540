"""An aircraft of cubes on three gears with point masses for wheels.

The common case of `landing_peers`: simple enough that every multibody code with
flexible bodies can carry it. SI units; x aft, y to starboard, z up.

Airframe: a lattice of trilinear cubes of 1 m, fuselage 36 x 3 x 3, each wing 3 x 14
x 1, 60 t, Poisson's ratio 0.3, scaled so that its first free mode is at 2.5 Hz. At each
gear the four corners of a cube's lower face move as one. Damping proportional to
stiffness, 2 % at 5 Hz.

Gears: oleo of 2 m between the middle of such a face and a point mass, gas n = 1.3 in a
column of 0.45 m, orifice damping, stops at 0 and 0.40 m; tire that is stiff upwards
only, k δ (1 + χ δ'), no friction. No gravity, no lift: at the start the tires
touch the runway at 3.05 m/s, with the oleos at stroke zero, where gas and stop are not
in balance.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
import numpy.typing as npt
import scipy.linalg
import scipy.sparse as sp
from scipy.sparse.linalg import eigsh, splu

Float64 = npt.NDArray[np.float64]

MASS, FIRST_HZ, POISSON = 60e3, 2.5, 0.3
STIFFNESS_DAMPING = 2 * 0.02 / (2 * np.pi * 5.0)  # s
INNER_MODES = 61
SINK_RATE, DURATION = 3.05, 1.0
OLEO_LENGTH, GAS_LENGTH, GAS_EXPONENT = 2.0, 0.45, 1.3
STROKE, STOP_STIFFNESS = 0.40, 5e6
SIDE_STIFFNESS, SIDE_DAMPING = 5e6, 2e4  # N/m, N s/m
TIRE_DAMPING = 0.02  # s/m, up to LARGEST_DAMPED_RATE
LARGEST_DAMPED_RATE = 2.0  # m/s
TIP = (16, 16, 1)


@dataclass(frozen=True, kw_only=True)
class PointGear:
    """One gear: corner (x, y) of its cube's face, and the parameters of its laws."""

    name: str
    corner: tuple[int, int]
    preload: float  # N
    orifice: float  # N s²/m²
    tire: float  # N/m
    wheel: float  # kg


GEARS = (
    PointGear(
        name="left",
        corner=(16, 3),
        preload=1.6e5,
        orifice=1.2e5,
        tire=2.6e6,
        wheel=450.0,
    ),
    PointGear(
        name="right",
        corner=(16, -3),
        preload=1.6e5,
        orifice=1.2e5,
        tire=2.6e6,
        wheel=450.0,
    ),
    PointGear(
        name="nose",
        corner=(4, 0),
        preload=4e4,
        orifice=4e4,
        tire=1.2e6,
        wheel=120.0,
    ),
)

_CORNERS = np.array(
    [
        (0, 0, 0),
        (1, 0, 0),
        (1, 1, 0),
        (0, 1, 0),
        (0, 0, 1),
        (1, 0, 1),
        (1, 1, 1),
        (0, 1, 1),
    ]
)


@dataclass(frozen=True, kw_only=True)
class Lattice:
    """The free airframe.

    Attributes:
        cell: (k, 3) integer places of the nodes, ascending.
        xyz: (k, 3) places, m.
        cubes: (c, 8) rows of the nodes of each cube.
        K, M: (3 k, 3 k).
        faces: by gear, (4,) rows of the nodes that move as one.
    """

    cell: npt.NDArray[np.int64]
    xyz: Float64
    cubes: npt.NDArray[np.int64]
    K: sp.csr_matrix
    M: sp.csr_matrix
    faces: dict[str, npt.NDArray[np.int64]]

    def row(self, cell: tuple[int, int, int]) -> int:
        """Row of a node."""
        return int(np.flatnonzero((self.cell == cell).all(axis=1))[0])


@cache
def lattice() -> Lattice:
    """The airframe, scaled to its mass and first frequency."""
    grid = np.indices((36, 3, 3)).reshape(3, -1).T + np.array([0, -1, 0])
    wing = np.indices((3, 14, 1)).reshape(3, -1).T + np.array([15, 2, 0])
    origins = np.vstack([grid, wing, wing * [1, -1, 1]])
    corners = (origins[:, None] + _CORNERS).reshape(-1, 3)
    cell, place = np.unique(corners, axis=0, return_inverse=True)
    cubes = place.reshape(-1, 8)
    stiffness, mass = _cube()
    dofs = (3 * cubes[:, :, None] + np.arange(3)).reshape(-1, 24)
    K, M = (_assembled(dofs, matrix, 3 * len(cell)) for matrix in (stiffness, mass))
    M *= 3.0 * MASS / M.sum()
    shift = -1e-6 * K.diagonal().max() / M.diagonal().max()
    lowest = np.sort(eigsh(K, 8, M, sigma=shift, return_eigenvectors=False))
    K *= (2 * np.pi * FIRST_HZ) ** 2 / lowest[6]
    faces = {}
    for gear in GEARS:
        x, y = gear.corner
        near = (np.abs(cell[:, :2] - (x + 0.5, y + 0.5)) < 1).all(axis=1)
        faces[gear.name] = np.flatnonzero(near & (cell[:, 2] == 0))
    return Lattice(
        cell=cell, xyz=cell - [0.0, 0.5, 0.0], cubes=cubes, K=K, M=M, faces=faces
    )


def _cube() -> tuple[Float64, Float64]:
    """(24, 24) stiffness and mass of a trilinear unit cube, unit modulus and density.

    Two Gauss points along each edge.
    """
    shear = 0.5 / (1 + POISSON)
    C = np.diag([2 * shear] * 3 + [shear] * 3)
    C[:3, :3] += 2 * shear * POISSON / (1 - 2 * POISSON)
    K, M = np.zeros((24, 24)), np.zeros((24, 24))
    for point in 0.5 + (_CORNERS - 0.5) / np.sqrt(3):
        factors = np.where(_CORNERS == 1, point, 1 - point)
        value = factors.prod(axis=1)
        slope = np.stack(
            [
                np.where(_CORNERS[:, i] == 1, 1, -1)
                * np.delete(factors, i, axis=1).prod(axis=1)
                for i in range(3)
            ]
        )
        B = np.zeros((6, 8, 3))
        for i in range(3):
            B[i, :, i] = slope[i]
            j, k = (i + 1) % 3, (i + 2) % 3
            B[3 + i, :, j], B[3 + i, :, k] = slope[k], slope[j]
        B = B.reshape(6, 24)
        K += B.T @ C @ B / 8
        M += np.kron(np.outer(value, value), np.eye(3)) / 8
    return K, M


def _assembled(dofs: npt.NDArray, element: Float64, size: int) -> sp.csr_matrix:
    rows, columns = np.repeat(dofs, 24, axis=1), np.tile(dofs, 24)
    values = np.tile(element.ravel(), len(dofs))
    return sp.csr_matrix((values, (rows.ravel(), columns.ravel())), shape=(size, size))


@dataclass(frozen=True, kw_only=True)
class Reduced:
    """Craig-Bampton: 18 interface freedoms and fixed-interface modes, as free modes.

    Attributes:
        frequency: (n,) of the elastic modes, Hz.
        interface: (3, 6, n) [translation; rotation] of the faces' middles, mass-normal.
        shape: (3 k, n) of all nodes.
        rigid: (3 k, 6) unit rigid motions about the center of gravity.
        p_G: (3,) center of gravity, m.
        inertia: (3, 3) about it.
    """

    frequency: Float64
    interface: Float64
    shape: Float64
    rigid: Float64
    p_G: Float64
    inertia: Float64


@cache
def reduced(inner_modes: int = INNER_MODES) -> Reduced:
    """Free elastic modes of the reduced airframe: 12 + inner_modes."""
    model = lattice()
    size = 3 * len(model.xyz)
    on_face = np.concatenate(list(model.faces.values()))
    held = (3 * on_face[:, None] + np.arange(3)).ravel()
    inner = np.setdiff1d(np.arange(size), held)
    follow = np.zeros((size, 18))
    for i, rows in enumerate(model.faces.values()):
        arm = model.xyz[rows] - model.xyz[rows].mean(axis=0)
        dofs = (3 * rows[:, None] + np.arange(3)).ravel()
        follow[dofs, 6 * i : 6 * i + 6] = _rigid_motion(arm)
    K, M = model.K, model.M
    K_ii, M_ii = K[inner][:, inner].tocsc(), M[inner][:, inner].tocsc()
    static = follow.copy()
    static[inner] = splu(K_ii).solve(-(K[inner] @ follow))
    _, fixed = eigsh(K_ii, inner_modes, M_ii, sigma=0.0)
    basis = np.zeros((size, 18 + inner_modes))
    basis[:, :18] = static
    basis[inner, 18:] = fixed
    values, vectors = scipy.linalg.eigh(basis.T @ (K @ basis), basis.T @ (M @ basis))
    elastic = vectors[:, 6:]
    p_G = np.asarray(M.sum(axis=1)).reshape(-1, 3)[:, 0] @ model.xyz / MASS
    rigid = _rigid_motion(model.xyz - p_G)
    return Reduced(
        frequency=np.sqrt(values[6:]) / (2 * np.pi),
        interface=elastic[:18].reshape(3, 6, -1),
        shape=basis @ elastic,
        rigid=rigid,
        p_G=p_G,
        inertia=(rigid.T @ (M @ rigid))[3:, 3:],
    )


def _rigid_motion(arm: Float64) -> Float64:
    """(3 k, 6) translations of points by unit rigid motions."""
    x, y, z = arm.T
    zero = np.zeros_like(x)
    turn = np.stack([zero, z, -y, -z, zero, x, y, -x, zero], axis=1).reshape(-1, 3, 3)
    return np.concatenate([np.tile(np.eye(3), (len(arm), 1, 1)), turn], axis=2).reshape(
        -1, 6
    )
