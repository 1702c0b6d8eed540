"""CQUAD8 and CTRIA6: curved shells with mid-sides, eight and six grids.

Reissner-Mindlin theory on the quadratic surface through the grids. Each grid has the
normal d of its element; a point at height z above the surface moves by u + z b with
b = theta x d. With base vectors a_k = x,k and the interpolated normal n the covariant
strains are

    e_kl  = (a_k . u,l + a_l . u,k) / 2
    k_kl  = (a_k . b,l + a_l . b,k + n,k . u,l + n,l . u,k) / 2
    2 e_k3 = a_k . b + n . u,k

and, measured in the lengths of the surface at height z, curvatures are less by what the
bent surface makes of the membrane strain (`_in_axes`). Rigid motions leave all of them
zero on any shape. Full integration would lock, so strains are assumed from samples
(assumed natural strains). Membrane strain and curvature along a natural direction of
the quadrilateral are sampled at its two Gauss points and at three places across, their
shear at 2 x 2 points; those of the triangle at its three points of integration.
Transverse shear is sampled along the edges, at two points each, where any quadratic
deflection is met exactly, that of the quadrilateral also as a mean over its middle
(MITC8); on an edge without its mid-side only the mean of both counts. Uniform parts are
added such that uniform stress does the work that it does on the strains of the
displacements. Rotations inside the triangle, condensed, give it the freedom that the
mean of its shear takes (MITC7); without it shear forces of thin plates grow under
refinement. There is no spurious mode; with straight edges and mid-sides in their
middle uniform strains and curvatures are exact on any shape (patch test). Plates
converge with the fourth order at any thickness; curved triangles are stiffer than
quadrilaterals on coarse meshes.

References: Huang and Hinton, A new nine node degenerated shell element with enhanced
membrane and shear interpolation, IJNME 22 (1986); Park and Stanley, A curved C0 shell
element based on assumed natural-coordinate strains, JAM 53 (1986); Bathe and Dvorkin,
A formulation of general shell elements, IJNME 22 (1986); Bathe, Brezzi and Cho, The
MITC7 and MITC9 plate bending elements, C&S 32 (1989), from memory. MSC Nastran's own
elements integrate 2 x 2 points; theirs and these converge to the same.

Element axes at a point: the orthogonal pair that lies evenly about the tangents of the
quadrilateral; along the first tangent of the triangle. THETA counts from the first
tangent (from memory of the guide; on rectangles the same as from side G1-G2).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fem.arrays import Float64, Int64
from fem.elements.block import CENTER, Detail, Kind, Recovery
from fem.elements.preload import of_gradients, symmetric_plane
from fem.elements.shells.quadratic_surface import (
    QUAD8,
    TRIA6,
    Base,
    Surface,
    base,
    cartesian,
    fitted,
    turned,
)
from fem.elements.shells.shell import Shell
from fem.elements.shells.shell_preload import across, add_turning
from fem.properties.shell_section import (
    ShellSection,
    bending_along,
    section_flexibility,
)
from fem.properties.shells import sections

_RIGID_SHEAR = 1e-5  # of area / D: flexibility of plates without MID3, as good as none
_BUBBLE_REST = 0.1  # of the curvature of rotations inside that is not linear
_PAIRS = ((0, 0), (1, 1), (0, 1))  # of natural directions: strains 11, 22, 2 x 12
_PIECE = 256  # elements that are integrated at a time
SURFACES = {"CQUAD8": QUAD8, "CTRIA6": TRIA6}


def _in_axes(
    at: Base, bend: Float64, plane: Sequence[Float64], shear: Float64
) -> Float64:
    """(e, q, 8, 6 n) in element axes from covariant strains.

    Lengths grow with the height z over a bent surface: of the strain (e + z k) that is
    measured in those of the surface, e bend^T + bend e are no curvature.

    Args:
        at: the points.
        bend: (e, q, 2, 2) of the surface.
        plane: 11, 22, 2 x 12, each (e, q, 12 n), membrane strain beside curvature.
        shear: (e, q, 2, 6 n) with the normal.
    """
    both = cartesian(at.gradient) @ np.stack(plane, axis=2)
    stretch, curvature = np.split(both, 2, axis=-1)
    (xx, xy), (yx, yy) = np.moveaxis(bend, (-2, -1), (0, 1))
    zero = np.zeros_like(xx)
    rows = [[2.0 * xx, zero, xy], [zero, 2.0 * yy, yx], [2.0 * yx, 2.0 * xy, xx + yy]]
    grown = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    curvature = curvature - grown @ stretch
    return np.concatenate([stretch, curvature, at.gradient @ shear], axis=2)


@dataclass(frozen=True, kw_only=True)
class CurvedShell(Shell):
    """CQUAD8 or CTRIA6 elements with PSHELL or with PCOMP; basic axes.

    `section` and `angle` are those of the center.

    Attributes:
        surface: its natural coordinates.
        nodes: (e, n, 3) grids.
        corner_thickness: (e, c).
        theta: (e,) rad, from the first tangent to the material x axis.
        towards: (e, 3) direction of the material x axis instead; NaN where none is.
    """

    surface: Surface
    nodes: Float64
    corner_thickness: Float64
    theta: Float64
    towards: Float64

    @property
    def expanding(self) -> Float64:
        """(e, n, 3) grids."""
        return self.nodes

    @cached_property
    def directors(self) -> Float64:
        """(e, n, 3) normals at the grids."""
        return base(self.surface, self.nodes, self.surface.nodes).normal

    @cached_property
    def reference(self) -> Float64:
        """(e, n, 3) points of the reference surface, ZOFFS above the grids."""
        return self.nodes + self.offset[:, None, None] * self.directors

    @property
    def extent(self) -> Float64:
        """(e,) area."""
        surface = self.surface
        return self.base(surface.points).area @ surface.weights

    def base(self, p: Float64) -> Base:
        """The reference surface at natural points (q, 2)."""
        return base(self.surface, self.reference, p)

    def section_at(self, p: Float64) -> ShellSection:
        """Sections at natural points, (e q, ...), in the element axes there."""
        at = self.base(p)
        count = at.normal.shape[1]
        thickness = self.corner_thickness @ self.surface.of_corners(p).T
        angle = material_angle(at, self.theta, self.towards)
        return sections(
            list(self.properties),
            np.repeat(self.which, count),
            angle.ravel(),
            thickness.reshape(-1, 1),
        )

    def _to_grids(self, of_u: Float64, of_b: Float64) -> Float64:
        """(..., 6 n) from operators (e, s, n, 3) on u of the surface and on b."""
        of_b = of_b + self.offset[:, None, None, None] * of_u
        # b = theta x d: w . (theta x d) = theta . (d x w)
        turned = np.cross(self.directors[:, None], of_b)
        return np.stack([of_u, turned], axis=-2).reshape(*of_u.shape[:2], -1)

    def covariant(self, p: Float64, k: int, m: int) -> tuple[Float64, Float64]:
        """(e, q, 6 n) membrane strain and curvature; engineering shear for k != m."""
        slope = self.surface.slopes(p)
        a, n = slope @ self.reference[:, None], slope @ self.directors[:, None]

        def both(vector: Float64) -> Float64:
            part = slope[:, m, :, None] * vector[:, :, k, None]
            if k == m:
                return part
            return part + slope[:, k, :, None] * vector[:, :, m, None]

        zero = np.zeros((*a.shape[:2], slope.shape[2], 3))
        stretch = both(a)
        return self._to_grids(stretch, zero), self._to_grids(both(n), stretch)

    def _bubble_curvature(self, p: Float64, k: int, m: int) -> Float64:
        """(e, q, 2) of b = bubble times the element axes at the center."""
        along = self.surface.slopes(p) @ self.reference[:, None]
        towards = np.einsum("eqki,eji->eqkj", along, self._center.axes[:, 0])
        slope = self.surface.bubble_slopes(p)
        part = slope[:, m, None] * towards[:, :, k]
        return part if k == m else part + slope[:, k, None] * towards[:, :, m]

    def _with_bubble(self, p: Float64, plane: Sequence[Float64]) -> list[Float64]:
        """`_plane` with columns for the rotations inside.

        Linear parts of their curvatures do the work on moments that vary linearly. The
        rest would stiffen, and shear forces of thin plates alternate: it keeps a
        hundredth of its energy, which holds modes that have no other.
        """
        if not self.surface.bubble:
            return list(plane)
        found = []
        for both, (k, m) in zip(plane, _PAIRS):
            stretch, curvature = np.split(both, 2, axis=2)
            whole = self._bubble_curvature(p, k, m)
            six = self._bubble_curvature(self.surface.points, k, m)
            linear = np.einsum("pq,eqi->epi", self.surface.projection(p), six)
            inside = linear + _BUBBLE_REST * (whole - linear)
            parts = [stretch, np.zeros_like(inside), curvature, inside]
            found.append(np.concatenate(parts, axis=2))
        return found

    def covariant_shear(self, p: Float64, towards: Float64) -> Float64:
        """(e, q, 6 n + i) engineering shear with the normal, natural directions."""
        value = self.surface.values(p)
        slope = np.einsum("qk,qkn->qn", towards, self.surface.slopes(p))
        along, n = slope @ self.reference, value @ self.directors
        of_grids = self._to_grids(
            slope[..., None] * n[:, :, None], value[..., None] * along[:, :, None]
        )
        if not self.surface.bubble:
            return of_grids
        inside = self.surface.bubble_values(p)[:, None]
        axes = self._center.axes[:, 0]
        turned = inside * np.einsum("eqi,eji->eqj", along, axes)
        return np.concatenate([of_grids, turned], axis=2)

    @cached_property
    def _samples(self) -> list[Float64]:
        """(e, s, 12 n) membrane and curvature 11, 22, 12, and (e, s, 6 n) shear."""
        surface = self.surface
        shear = self.covariant_shear(surface.edges, surface.towards)
        return [*self._plane([at for at, _ in surface.strains]), shear]

    def strain_operator(self, p: Float64) -> Float64:
        """(e, q, 8, 6 n) membrane, curvature, shear in the element axes at points."""
        strain = self._with_inside(p)
        if not self.surface.bubble:
            return strain
        size = self.dof.shape[1]
        return strain[..., :size] + strain[..., size:] @ self._inside[:, None]

    @cached_property
    def _inside(self) -> Float64:
        """(e, 2, 6 n) rotations inside, at rest under no load of their own."""
        points, size = self.surface.points, self.dof.shape[1]
        strain = self._with_inside(points)
        modulus = self.resultant_matrix(points)
        weight = self.surface.weights * self.base(points).area
        inner = strain[..., size:]
        force = np.einsum("eq,eqsi,eqst->eqit", weight, inner, modulus)
        square, other = (
            np.einsum("eqit,eqtn->ein", force, part)
            for part in (inner, strain[..., :size])
        )
        # Membranes have no stiffness in bending: nothing turns inside.
        none = np.einsum("eii->e", square) <= 0.0
        square[none] = np.eye(2)
        return -np.linalg.solve(square, np.where(none[:, None, None], 0.0, other))

    def _with_inside(self, p: Float64) -> Float64:
        """(e, q, 8, 6 n + i) strains of the grids and of the rotations inside."""
        at = self.base(p)
        turn = turned(self._center, at)[:, :, 0]
        return self._assumed(p, at) + turn @ self._mean_correction[:, None]

    def _assumed(self, p: Float64, at: Base) -> Float64:
        """(e, q, 8, 6 n) strains from their samples."""
        fits = [fitted(powers, where, p) for where, powers in self.surface.strains]
        plane = self._with_bubble(p, [f @ s for f, s in zip(fits, self._samples)])
        shear = np.einsum("qks,esn->eqkn", self.surface.shear_fit(p), self._samples[3])
        return _in_axes(at, self._bend(p, at), plane, shear)

    def _direct(self, p: Float64, at: Base) -> Float64:
        """(e, q, 8, 6 n) strains of the displacements and rotations themselves."""
        shear = [self.covariant_shear(p, np.tile(d, (len(p), 1))) for d in np.eye(2)]
        plane = self._with_bubble(p, self._plane([p] * 3))
        return _in_axes(at, self._bend(p, at), plane, np.stack(shear, axis=2))

    def _bend(self, p: Float64, at: Base) -> Float64:
        """(e, q, 2, 2) d n_j / d x_i at [i, j] of the surface itself, element axes."""
        slope = self.surface.slopes(p) @ self.directors[:, None]
        return at.gradient @ np.einsum("eqki,eqji->eqkj", slope, at.axes)

    def _plane(self, at: Sequence[Float64]) -> list[Float64]:
        """Covariant membrane strain beside curvature: 11, 22, 2 x 12."""
        parts = [self.covariant(p, k, m) for p, (k, m) in zip(at, _PAIRS)]
        return [np.concatenate(both, axis=2) for both in parts]

    @cached_property
    def _center(self) -> Base:
        return self.base(self.surface.results[:1])

    @cached_property
    def _mean_correction(self) -> Float64:
        """(e, 8, 6 n) mean strain of the displacements less that of the samples.

        Uniform stress then does the same work on both: patch test on any quadrilateral,
        equilibrium of triangles in bending that varies. The first mean is that of the
        points of reduced integration, exact for uniform stress and free of locking.
        """
        surface = self.surface
        inner, outer = self.base(surface.stress), self.base(surface.points)
        share = surface.weights.sum() / len(surface.stress)
        total = self._to_center(
            inner, share * inner.area, self._direct(surface.stress, inner)
        )
        total -= self._to_center(
            outer, surface.weights * outer.area, self._assumed(surface.points, outer)
        )
        total[:, 6:] = 0.0  # the shear of the quadrilateral is tied, see `Surface`
        return total / self.extent[:, None, None]

    def _to_center(self, at: Base, weight: Float64, strain: Float64) -> Float64:
        """(e, 8, 6 n) weighted sum over points, in the element axes of the center."""
        turn = turned(at, self._center)[:, 0]
        return ((weight[..., None, None] * turn) @ strain).sum(axis=1)

    def stiffness(self) -> Float64:
        """(e, 6 n, 6 n)."""
        size = self.dof.shape[1]
        matrix = np.empty((len(self.id), size, size))
        for start in range(0, len(self.id), _PIECE):
            part = slice(start, start + _PIECE)
            matrix[part] = self.take(part).full_stiffness()
        return matrix

    def differential_stiffness(
        self, motion: Float64, load: Float64 | None = None
    ) -> Float64:
        """(e, 6 n, 6 n) of the membrane forces, see `shell_preload`."""
        size = self.dof.shape[1]
        matrix = np.empty((len(self.id), size, size))
        for start in range(0, len(self.id), _PIECE):
            part = slice(start, start + _PIECE)
            matrix[part] = self.take(part).full_differential(motion[part])
        return matrix

    def full_differential(self, motion: Float64) -> Float64:
        """(e, 6 n, 6 n) of all elements at once."""
        points = self.surface.points
        at, slope = self.base(points), self.surface.slopes(points)
        strain = np.einsum("eqsn,en->eqs", self.strain_operator(points), motion)
        matrix = self.resultant_matrix(points)[:, :, :3]
        membrane = symmetric_plane(np.einsum("eqas,eqs->eqa", matrix, strain))
        weight = self.surface.weights * at.area
        weighted = weight[..., None, None] * membrane
        gradient = at.gradient @ slope
        # Components along the axes of the displacement of the surface.
        frame = np.concatenate([at.axes, at.normal[:, :, None]], axis=2)
        total = np.zeros((len(self.id), self.dof.shape[1], self.dof.shape[1]))
        e, q, _, n = gradient.shape
        for k, own in enumerate(across(weighted)):
            of_u = np.einsum("eqan,eqc->eqanc", gradient, frame[:, :, k])
            of_u = of_u.reshape(e, q * 2, n, 3)
            turned_by = self._to_grids(of_u, np.zeros_like(of_u))
            total += of_gradients(turned_by.reshape(e, q, 2, -1), own)
        if self.offset.any():
            tip = np.einsum("eqab,eqbn,eqai->eni", weighted, gradient, at.axes)
            add_turning(total, tip, self.offset[:, None, None] * self.directors)
        return total

    def take(self, part: slice | Int64) -> "CurvedShell":
        """Some of the elements."""
        own = ("nodes", "corner_thickness", "theta", "towards")
        chosen = {name: getattr(self, name)[part] for name in own}
        taken = super().take(part)
        assert isinstance(taken, CurvedShell)
        return replace(taken, **chosen)

    def full_stiffness(self) -> Float64:
        """(e, 6 n, 6 n) of all elements at once."""
        surface = self.surface
        at = self.base(surface.points)
        strain = self.strain_operator(surface.points)
        weight = surface.weights * at.area
        modulus = self.resultant_matrix(surface.points) * weight[..., None, None]
        e, q, _, size = strain.shape
        flat = strain.reshape(e, q * 8, size)
        force = (modulus @ strain).reshape(e, q * 8, size)
        matrix = flat.transpose(0, 2, 1) @ force
        if self.k6rot:
            twist = self.drilling()
            stiff = 1e-6 * self.k6rot * self.section.membrane[:, 2, 2] * self.extent
            scale = (stiff / len(surface.nodes))[:, None, None]
            matrix += twist.transpose(0, 2, 1) @ (scale * twist)
        return matrix

    def resultant_matrix(self, p: Float64) -> Float64:
        """(e, q, 8, 8) N, M, Q from strains, in the element axes at points."""
        section = self.section_at(p)
        bending = section.bending
        plate = np.einsum("eii->e", bending) > 0.0
        size = np.repeat(self.extent, len(p))
        least = _RIGID_SHEAR * size / np.where(plate, np.einsum("eii->e", bending), 1.0)
        flexible = section.shear_flexibility + least[:, None, None] * np.eye(2)
        flexible[plate] += self._residual_flexibility(p, section)[plate]
        matrix = np.zeros((len(plate), 8, 8))
        matrix[:, :3, :3], matrix[:, 3:6, 3:6] = section.membrane, section.bending
        matrix[:, :3, 3:6] = matrix[:, 3:6, :3] = section.coupling
        matrix[plate, 6:, 6:] = np.linalg.inv(flexible[plate])
        return matrix.reshape(len(self.id), len(p), 8, 8)

    def _residual_flexibility(self, p: Float64, section: ShellSection) -> Float64:
        """(e q, 2, 2) of edges without mid-sides, as of CQUAD4 and CTRIA3.

        Rotations are linear along such an edge l: the bending that varies along it
        counts as shear, l l^T / (24 D_l) (`shell_shear`). Elements that few corners
        hold would lock without.
        """
        count = self.surface.corners
        at = self.base(p)
        total = np.zeros((*at.normal.shape[:2], 2, 2))
        for k in sorted(self.surface.straight):
            edge = self.reference[:, (k + 1) % count] - self.reference[:, k]
            local = np.einsum("eqai,ei->eqa", at.axes, edge).reshape(-1, 1, 2)
            square = (local**2).sum(axis=2)
            along = bending_along(section, local / np.sqrt(square)[..., None])
            share = 1.0 / np.where(along > 0.0, 24.0 * along, np.inf)
            own = share[..., None] * local[:, 0, :, None] * local[:, :1]
            total += own.reshape(total.shape)
        return total.reshape(-1, 2, 2)

    def drilling(self) -> Float64:
        """(e, n, 6 n) rotation about the normal less that of the membrane, per grid."""
        surface, count = self.surface, len(self.surface.nodes)
        slope = surface.slopes(surface.nodes)
        at = self.base(surface.nodes)
        dual = np.einsum("eqia,eqij->eqaj", at.gradient, at.axes)
        # Half of n . (dual_k x u,k)
        across = np.cross(at.normal[:, :, None], dual)
        of_u = -0.5 * np.einsum("qkn,eqkj->eqnj", slope, across)
        twist = self._to_grids(of_u, np.zeros_like(of_u))
        twist = twist.reshape(len(self.id), count, count, 2, 3)
        at_node = np.arange(count)
        twist[:, at_node, at_node, 1] += at.normal
        return twist.reshape(len(self.id), count, -1)

    def mass(self, *, coupled: bool) -> Float64:
        """(e, 6 n, 6 n); lumped: the diagonal of the products, scaled to the total.

        Row sums of quadratic elements are negative at their corners.
        """
        surface = self.surface
        value = surface.values(surface.points)
        weight = surface.weights * self.base(surface.points).area
        thick = self.corner_thickness @ surface.of_corners(surface.points).T
        share = np.stack([weight, weight * thick / thick.mean(axis=1, keepdims=True)])
        products = np.einsum("keq,qi,qj->keij", share, value, value, optimize=True)
        if not coupled:
            total = products.sum(axis=(2, 3))
            diagonal = np.einsum("keii->kei", products)
            diagonal = diagonal * (total / diagonal.sum(axis=2))[..., None]
            products = diagonal[..., None] * np.eye(len(surface.nodes))
        other = products[0] * self.section.nonstructural[:, None, None]
        own = products[1] * self.section.density[:, None, None]
        height = (self.offset + self.section.mass_height)[:, None, None]
        first = own * height + other * self.offset[:, None, None]
        second = own * height**2 + other * self.offset[:, None, None] ** 2
        # theta x d = S theta
        spin = np.cross(np.eye(3), self.directors[:, :, None]).transpose(0, 1, 3, 2)
        e, n = self.nodes.shape[:2]
        matrix = np.zeros((e, n, 2, 3, n, 2, 3))
        matrix[:, :, 0, :, :, 0] = np.einsum("eij,ab->eiajb", own + other, np.eye(3))
        turned = np.einsum("eij,ejab->eiajb", first, spin)
        matrix[:, :, 0, :, :, 1] = turned
        matrix[:, :, 1, :, :, 0] = turned.transpose(0, 3, 4, 1, 2)
        both = np.einsum("eij,eica,ejcb->eiajb", second, spin, spin)
        matrix[:, :, 1, :, :, 1] = both
        return matrix.reshape(e, 6 * n, 6 * n)

    def resultants(self, *, corner: bool = False) -> Float64:
        """(e, p, 8, 6 n) N, M and Q in the element axes at the center (and corners).

        Strains are extrapolated from the points where they are most exact.
        """
        parts = [
            slice(start, start + _PIECE) for start in range(0, len(self.id), _PIECE)
        ]
        return np.concatenate([self.take(p).all_resultants(corner) for p in parts])

    def all_resultants(self, corner: bool) -> Float64:
        """`resultants` of all elements at once."""
        surface = self.surface
        at = surface.results if corner else surface.results[:1]
        inside = self.strain_operator(surface.stress)
        fit = fitted(surface.printed, surface.stress, at)
        turn = turned(self.base(surface.stress), self.base(at))
        strain = np.einsum("pg,epgij,egjn->epin", fit, turn, inside, optimize=True)
        return self.resultant_matrix(at) @ strain

    def flexibility(self, *, corner: bool = False) -> Float64:
        """(e, p, 6, 6), see `Shell.flexibility`."""
        at = self.surface.results if corner else self.surface.results[:1]
        found = section_flexibility(self.section_at(at))
        return found.reshape(len(self.id), len(at), 6, 6)

    def recovery(self, kind: Kind, detail: Detail = CENTER) -> Recovery | None:
        """As `Shell.recovery`, always with the corners, as Nastran prints them."""
        return super().recovery(kind, replace(detail, corner=True))


def material_angle(at: Base, theta: Float64, towards: Float64) -> Float64:
    """(e, q) rad from the element x axis to the material x axis."""
    first = at.a[..., 0, :]
    given = np.isfinite(towards).all(axis=1)[:, None]
    direction = np.where(given[..., None], towards[:, None], first)
    x, y = np.einsum("eqki,eqi->keq", at.axes, direction)
    return np.arctan2(y, x) + np.where(given, 0.0, theta[:, None])
