"""CQUAD8 and CTRIA6: curved shells with mid-sides, eight and six grids.

Reissner-Mindlin theory on the quadratic surface through the grids, with MSC Nastran's
assumed strains: membrane strain and curvature in `curved_strain`, transverse shear in
`curved_shear`. Grids and mid-sides may be left out. With straight edges and mid-sides
in their middle uniform strains and curvatures are exact on any shape (patch test).
K6ROT does not act, as in MSC Nastran, where AUTOSPC can hold the rotation about the
normal; it does where the normal is oblique to the displacement system of the grid.

Element axes at a point: the orthogonal pair that lies evenly about the tangents of the
quadrilateral; along the first tangent of the triangle. THETA counts from the first
tangent (from memory of the guide; on rectangles the same as from side G1-G2).
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fem.arrays import Bool, Float64, Int64
from fem.elements.block import CENTER, Detail, Kind, Recovery
from fem.elements.preload import of_gradients, symmetric_plane
from fem.elements.shells.curved_shear import ShearModes, mode_flexibility, shear_modes
from fem.elements.shells.curved_strain import (
    assumed_strain,
    from_grids,
    middle_weights,
    of_nodes,
)
from fem.elements.shells.quadratic_surface import (
    QUAD8,
    TRIA6,
    Base,
    Surface,
    base,
    turned,
)
from fem.elements.shells.shell import Shell
from fem.elements.shells.shell_preload import across, add_turning
from fem.properties.shell_section import ShellSection, section_flexibility
from fem.properties.shells import sections

_PIECE = 256  # elements that are integrated at a time
SURFACES = {"CQUAD8": QUAD8, "CTRIA6": TRIA6}


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
        oblique: (e, n) grids whose normal is no axis of their displacement system.
    """

    surface: Surface
    nodes: Float64
    corner_thickness: Float64
    theta: Float64
    towards: Float64
    oblique: Bool

    @property
    def expanding(self) -> Float64:
        """(e, n, 3) grids."""
        return self.nodes

    @cached_property
    def directors(self) -> Float64:
        """(e, n, 3) normals at the grids."""
        return _without_rounding(base(self.surface, self.nodes, self.surface.nodes))

    @cached_property
    def reference(self) -> Float64:
        """(e, n, 3) points of the reference surface, ZOFFS above the grids."""
        return self.nodes + self.offset[:, None, None] * self.directors

    @property
    def _sides(self) -> Float64:
        """(e, k, 3) corners and all mid-sides of the reference surface."""
        follow = self.surface.follow
        return self.reference if follow is None else follow @ self.reference

    @cached_property
    def _middle(self) -> Float64:
        """(e, k) the middle of quadrilaterals from the other nodes; none else."""
        if not self.surface.even:
            return np.zeros((len(self.id), 0))
        return middle_weights(QUAD8, self._sides)

    @cached_property
    def _complete(self) -> tuple[Float64, Float64]:
        """(e, w, 3) nodes of the strains on the reference surface, and normals."""
        x, complete = self._sides, self.surface.complete
        if self.surface.even:
            x = np.concatenate([x, self._middle[:, None] @ x], axis=1)
        return x, _without_rounding(base(complete, x, complete.nodes))

    @cached_property
    def _from_grids(self) -> Float64:
        """(e, 6 w, 6 n) u and theta of these nodes from those of the grids."""
        raised = self.offset[:, None, None] * self.directors
        return from_grids(self.surface, *self._complete, raised, self._middle)

    @property
    def extent(self) -> Float64:
        """(e,) area."""
        surface = self.surface
        return self.base(surface.points).area @ surface.weights

    def base(self, p: Float64) -> Base:
        """The reference surface at natural points (q, 2)."""
        return base(self.surface.complete, self._complete[0], p)

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

    @cached_property
    def _strain(self) -> Float64:
        """(e, r, 6, 6 n) membrane strain and curvature at the points of the rule."""
        strain = assumed_strain(self.surface.complete, *self._complete)
        return strain @ self._from_grids[:, None]

    @cached_property
    def _shear(self) -> ShearModes:
        """Transverse shear of the grids' motions."""
        modes = shear_modes(self.surface.complete, *self._complete)
        return replace(modes, strain=modes.strain @ self._from_grids[:, None])

    @cached_property
    def _shear_amplitudes(self) -> Float64:
        """(e, m, 2, 6 n) shear forces of the modes; none without bending stiffness."""
        plate = np.einsum("eii->e", self.section.bending) > 0.0
        flexible = mode_flexibility(
            self.surface.complete, self._complete[0], self.section, self.extent
        )
        flexible[~plate] = np.eye(2)
        stiff = np.linalg.inv(flexible) * plate[:, None, None, None]
        return stiff @ self._shear.strain

    def plane_matrix(self, p: Float64) -> Float64:
        """(e, q, 6, 6) N, M from membrane strain and curvature, axes at points."""
        section = self.section_at(p)
        isotropic = np.array([own.isotropic for own in self.properties])[self.which]
        isotropic = np.repeat(isotropic, len(p))
        matrix = np.zeros((len(isotropic), 6, 6))
        parts = (section.membrane, section.coupling, section.bending)
        for part, places in zip(parts, (((0, 0),), ((0, 3), (3, 0)), ((3, 3),))):
            # MSC's take no G of MAT1, but E / (2 (1 + nu)).
            own = part.copy()
            own[isotropic, 2, 2] = 0.5 * (own[:, 0, 0] - own[:, 0, 1])[isotropic]
            for row, column in places:
                matrix[:, row : row + 3, column : column + 3] = own
        return matrix.reshape(len(self.id), len(p), 6, 6)

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
        complete, points = self.surface.complete, self.surface.rule
        x, normal = self._complete
        at, slope = base(complete, x, points), complete.slopes(points)
        strain = np.einsum("eqsn,en->eqs", self._strain, motion)
        matrix = self.plane_matrix(points)[:, :, :3]
        membrane = symmetric_plane(np.einsum("eqas,eqs->eqa", matrix, strain))
        weight = self.surface.shares * at.area
        weighted = weight[..., None, None] * membrane
        gradient = at.gradient @ slope
        # Components along the axes of the displacement of the surface.
        frame = np.concatenate([at.axes, at.normal[:, :, None]], axis=2)
        total = np.zeros((len(self.id), self.dof.shape[1], self.dof.shape[1]))
        e, q, _, n = gradient.shape
        for k, own in enumerate(across(weighted)):
            of_u = np.einsum("eqan,eqc->eqanc", gradient, frame[:, :, k])
            of_u = of_u.reshape(e, q * 2, n, 3)
            turned_by = of_nodes(normal, of_u, np.zeros_like(of_u)) @ self._from_grids
            total += of_gradients(turned_by.reshape(e, q, 2, -1), own)
        if self.offset.any():
            own = gradient
            if self.surface.even:
                middle = np.einsum("eqb,en->eqbn", gradient[..., -1], self._middle)
                own = gradient[..., :-1] + middle
            if self.surface.follow is not None:
                own = own @ self.surface.follow
            tip = np.einsum("eqab,eqbn,eqai->eni", weighted, own, at.axes)
            add_turning(total, tip, self.offset[:, None, None] * self.directors)
        return total

    def take(self, part: slice | Int64) -> "CurvedShell":
        """Some of the elements."""
        own = ("nodes", "corner_thickness", "theta", "towards", "oblique")
        chosen = {name: getattr(self, name)[part] for name in own}
        taken = super().take(part)
        assert isinstance(taken, CurvedShell)
        return replace(taken, **chosen)

    def full_stiffness(self) -> Float64:
        """(e, 6 n, 6 n) of all elements at once."""
        weight = self.surface.shares * self.base(self.surface.rule).area
        modulus = self.plane_matrix(self.surface.rule) * weight[..., None, None]
        strain, shear = self._strain, self._shear.strain
        size = strain.shape[-1]
        flat, force = (
            part.reshape(len(part), -1, size) for part in (strain, modulus @ strain)
        )
        matrix = flat.swapaxes(1, 2) @ force
        flat, force = (
            part.reshape(len(part), -1, size)
            for part in (shear, self._shear_amplitudes)
        )
        matrix += flat.swapaxes(1, 2) @ force
        # A rotation that nothing holds has no stiffness, not that of rounding.
        largest = np.abs(matrix).max(axis=(1, 2), keepdims=True)
        matrix[np.abs(matrix) < 1e-25 * largest] = 0.0
        if self.k6rot and self.oblique.any():
            twist = self.drilling()
            stiff = 1e-6 * self.k6rot * self.section.membrane[:, 2, 2] * self.extent
            scale = (stiff / len(self.surface.nodes))[:, None] * self.oblique
            matrix += twist.swapaxes(1, 2) @ (scale[..., None] * twist)
        return matrix

    def drilling(self) -> Float64:
        """(e, n, 6 n) rotation about the normal less that of the membrane, per grid."""
        surface, count = self.surface, len(self.surface.nodes)
        slope = surface.slopes(surface.nodes)
        at = base(surface, self.reference, surface.nodes)
        dual = np.einsum("eqia,eqij->eqaj", at.gradient, at.axes)
        # Half of n . (dual_k x u,k)
        across = np.cross(at.normal[:, :, None], dual)
        of_u = -0.5 * np.einsum("qkn,eqkj->eqnj", slope, across)
        raised = self.offset[:, None, None, None] * of_u
        twist = of_nodes(self.directors, of_u, raised)
        twist = twist.reshape(len(self.id), count, count, 2, 3)
        at_node = np.arange(count)
        twist[:, at_node, at_node, 1] += at.normal
        return twist.reshape(len(self.id), count, -1)

    def mass(self, *, coupled: bool) -> Float64:
        """(e, 6 n, 6 n); lumped: all at the mid-sides, as MSC Nastran's.

        Sums of the rows are negative at the corners of quadrilaterals, each of which
        hands its own to the mid-sides beside it, by the squares of their distances the
        other way round: a square has a quarter at each, a rectangle 1 x 0.5 has 0.3 at
        its long sides (found in MSC's displacements at 10 Hz). Mid-sides that are left
        out hand theirs to the ends of their edges; MSC's square has 0.282, 0.218, 0.282
        at the other three then, not 0.25.
        """
        surface = self.surface
        value = surface.values(surface.points)
        weight = surface.weights * self.base(surface.points).area
        thick = self.corner_thickness @ surface.of_corners(surface.points).T
        share = np.stack([weight, weight * thick / thick.mean(axis=1, keepdims=True)])
        products = np.einsum("keq,qi,qj->keij", share, value, value, optimize=True)
        if not coupled:
            diagonal = self._at_sides(share)
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

    def _at_sides(self, share: Float64) -> Float64:
        """(k, e, n) lumped masses of weights (k, e, q) at the points."""
        surface, whole = self.surface, SURFACES[self.card]
        sums = np.einsum("keq,qi->kei", share, whole.values(surface.points))
        count, x = whole.corners, self._sides
        sides = sums[..., count:].copy()
        for k in range(count):
            beside = [k - 1, k]  # the sides before and after a corner
            gap = x[:, [count + j % count for j in beside]] - x[:, k, None]
            near = 1.0 / (gap**2).sum(axis=2)
            near /= near.sum(axis=1, keepdims=True)
            sides[..., beside] += sums[..., k, None] * near
        if surface.follow is None:
            return np.concatenate([np.zeros_like(sums[..., :count]), sides], axis=2)
        return sides @ surface.follow[count:]

    def resultants(self, *, corner: bool = False) -> Float64:
        """(e, p, 8, 6 n) N, M and Q in the element axes at the center (and corners).

        Strains spread from the points of the rule, as in MSC Nastran.
        """
        parts = [
            slice(start, start + _PIECE) for start in range(0, len(self.id), _PIECE)
        ]
        return np.concatenate([self.take(p).all_resultants(corner) for p in parts])

    def all_resultants(self, corner: bool) -> Float64:
        """`resultants` of all elements at once."""
        surface = self.surface
        at = surface.results if corner else surface.results[:1]
        spread, there = surface.spread(at), self.base(at)
        turn = turned(self.base(surface.rule), there)[..., :6, :6]
        strain = np.einsum(
            "pg,epgij,egjn->epin", spread, turn, self._strain, optimize=True
        )
        shear = np.einsum(
            "epm,emsn->epsn", self._shear.values(at), self._shear_amplitudes
        )
        back = turned(self.base(surface.results[:1]), there)[:, :, 0, 6:, 6:]
        return np.concatenate([self.plane_matrix(at) @ strain, back @ shear], axis=2)

    def flexibility(self, *, corner: bool = False) -> Float64:
        """(e, p, 6, 6), see `Shell.flexibility`."""
        at = self.surface.results if corner else self.surface.results[:1]
        found = section_flexibility(self.section_at(at))
        return found.reshape(len(self.id), len(at), 6, 6)

    def recovery(self, kind: Kind, detail: Detail = CENTER) -> Recovery | None:
        """Recovery as `Shell.recovery`, always with corners, as Nastran prints them."""
        return super().recovery(kind, replace(detail, corner=True))


def _without_rounding(at: Base) -> Float64:
    """(e, q, 3) normals: those along an axis leave the rotation about it free."""
    return np.where(np.abs(at.normal) < 1e-14, 0.0, at.normal)


def material_angle(at: Base, theta: Float64, towards: Float64) -> Float64:
    """(e, q) rad from the element x axis to the material x axis."""
    first = at.a[..., 0, :]
    given = np.isfinite(towards).all(axis=1)[:, None]
    direction = np.where(given[..., None], towards[:, None], first)
    x, y = np.einsum("eqki,eqi->keq", at.axes, direction)
    return np.arctan2(y, x) + np.where(given, 0.0, theta[:, None])
