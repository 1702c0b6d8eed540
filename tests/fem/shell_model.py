"""Small shell models on arrays: assembly, supports, solutions. For tests only."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp
import scipy.sparse.linalg as spla

from fem.elements.shells.shell import Shell
from fem.elements.shells.shell_normals import grid_normals
from fem.properties.elasticity import plane_stress
from fem.properties.shells import ShellProperty, sections

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]


def isotropic_property(
    e: float, nu: float, t: float, rho: float = 0.0, *, bending: bool = True
) -> ShellProperty:
    """PSHELL with one MAT1."""
    plane, g = plane_stress(e, nu), e / (2.0 * (1.0 + nu))
    return ShellProperty(
        card="PSHELL",
        pid=1,
        membrane=plane,
        coupling=np.zeros((3, 3)),
        bending=plane / 12.0 * bending,
        shear_flexibility=np.eye(2) / (5.0 / 6.0 * g),
        nominal=1.0,
        thickness=t,
        inertia_ratio=1.0,
        fibre=np.full(2, np.nan),
        density=rho,
        nsm=0.0,
        mass_height=0.0,
        ge=0.0,
    )


def shells(
    xyz: Float64,
    conn: Int64,
    prop: ShellProperty,
    *,
    k6rot: float = 100.0,
    offset: float = 0.0,
    angle: Float64 | None = None,
    snorm: float = 20.0,
) -> Shell:
    """A block of quadrilaterals (e, 4) or triangles (e, 3) over grids (g, 3)."""
    count, corners = conn.shape
    turned = np.zeros(count) if angle is None else angle
    which = np.zeros(count, dtype=np.int64)
    return Shell(
        card="CQUAD4" if corners == 4 else "CTRIA3",
        id=np.arange(1, count + 1),
        dof=(6 * conn[:, :, None] + np.arange(6)).reshape(count, -1),
        pid=np.ones(count, dtype=np.int64),
        property_card=prop.card,
        corners=xyz[conn],
        offset=np.full(count, offset),
        normals=grid_normals(xyz, [conn], snorm)[conn],
        section=sections(
            [prop], which, turned, np.full((count, corners), prop.thickness)
        ),
        k6rot=k6rot,
        properties=(prop,),
        which=which,
        angle=turned,
    )


def scattered(matrix: Float64, dof: Int64, size: int) -> sp.csc_matrix:
    """Sparse sum of element matrices (e, n, n)."""
    n = dof.shape[1]
    rows = np.repeat(dof, n, axis=1).ravel()
    cols = np.tile(dof, (1, n)).ravel()
    return sp.coo_matrix((matrix.ravel(), (rows, cols)), shape=(size, size)).tocsc()


@dataclass
class Model:
    """Grids, blocks and supports."""

    xyz: Float64
    blocks: Sequence
    fixed: Float64 = field(init=False)

    def __post_init__(self) -> None:
        self.fixed = np.zeros((len(self.xyz), 6), dtype=bool)

    def fix(self, grids: npt.ArrayLike, components: str) -> None:
        """Single-point constraints; components "123456"."""
        for c in components:
            self.fixed[grids, int(c) - 1] = True

    @property
    def size(self) -> int:
        return 6 * len(self.xyz)

    def stiffness(self) -> sp.csc_matrix:
        return sum(scattered(b.stiffness(), b.dof, self.size) for b in self.blocks)

    def mass(self, *, coupled: bool) -> sp.csc_matrix:
        return sum(
            scattered(b.mass(coupled=coupled), b.dof, self.size) for b in self.blocks
        )

    def _free(self, k: sp.csc_matrix) -> Int64:
        """Freedoms that are neither fixed nor without any stiffness."""
        return np.flatnonzero(~self.fixed.ravel() & (abs(k).sum(axis=0).A1 > 0.0))

    def solve(self, load: Float64, enforced: Float64 | None = None) -> Float64:
        """(g, 6) displacements under loads (g, 6) and enforced values (g, 6)."""
        k = self.stiffness()
        u = np.zeros(self.size) if enforced is None else enforced.ravel().copy()
        free = self._free(k)
        u[free] = 0.0
        right = load.ravel() - k @ u
        u[free] = spla.spsolve(k[free][:, free], right[free])
        return u.reshape(-1, 6)

    def frequencies(self, count: int, *, coupled: bool = False) -> Float64:
        """The lowest natural frequencies, Hz; free and massless motions too."""
        k = self.stiffness()
        free = self._free(k)
        m = self.mass(coupled=coupled)[free][:, free]
        found = spla.eigsh(
            k[free][:, free],
            count,
            m,
            sigma=-50.0,
            v0=np.ones(len(free)),
            return_eigenvectors=False,
        )
        return np.sqrt(np.maximum(np.sort(found), 0.0)) / (2.0 * np.pi)


def grid(nx: int, ny: int) -> tuple[Float64, Int64]:
    """Unit square: (g, 2) points, x running slowest, and (e, 4) quadrilaterals."""
    x, y = np.meshgrid(np.linspace(0, 1, nx + 1), np.linspace(0, 1, ny + 1))
    points = np.stack([x.T.ravel(), y.T.ravel()], axis=1)
    i, j = (a.ravel() for a in np.meshgrid(range(nx), range(ny), indexing="ij"))
    first = i * (ny + 1) + j
    conn = np.stack([first, first + ny + 1, first + ny + 2, first + 1], axis=1)
    return points, conn


def triangles(conn: Int64) -> Int64:
    """Each quadrilateral cut along its diagonal 1-3."""
    return np.concatenate([conn[:, [0, 1, 2]], conn[:, [0, 2, 3]]])
