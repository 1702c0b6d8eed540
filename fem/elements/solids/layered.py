"""CHEXA with PCOMPS: plies stacked along one of the element's natural directions.

The hybrid hexahedron (`solid_stiffness.py`) with two changes. Transverse shear, uniform
and linear in the plane, is free in each ply. The other assumed stresses s belong to the
whole laminate; with S the compliance of a ply, Q its stiffness in plane stress, and a
bar for the mean over the thickness,

    s_plane(ply) = Q Qbar^-1 (s_plane - Cbar s_33) + C s_33,    C = -Q S_plane,33,

so that the strain in the plane is the same in all plies and the stress across them too.
Where the plies are alike s is as it was: so a laminate of two has the ply stresses that
Simcenter Nastran 2020.2 prints, to its seven digits (pyNastran models, nx,
composite_solids). What that does with plies that differ was not seen; here the strain
of laminate theory is met exactly.
"""

from dataclasses import dataclass, replace

import numpy as np

from fem.arrays import Float64, Int64
from fem.deck.records.shells import of_plies
from fem.deck.records.solids import LAYER_STRAIN, LAYER_STRESS
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock, some
from fem.elements.solids.element_axes import stress_rotation
from fem.elements.solids.isoparametric import (
    HEX_CORNERS,
    Rule,
    hex8,
    hex8_derivatives,
    jacobians,
    strain_operator,
)
from fem.elements.solids.solid import Shape
from fem.elements.solids.solid_stiffness import pian_tong, stress_transform
from fem.elements.stress_measures import solid_von_mises
from fem.errors import InputError

_PLANE = [0, 1, 3]
_ACROSS = 2
# Modes of `pian_tong` that are shear across plies stacked along the third direction,
# and what they are: component, and the coordinate along which it varies.
_SHEAR = (4, 5, 16, 17)
_SHEAR_IN_PLY = ((4, None), (5, None), (4, 0), (5, 1))


@dataclass(frozen=True, kw_only=True)
class Stack:
    """Plies of a laminate, from the bottom, in the axes of its elements.

    Attributes:
        share: (p,) of the thickness; their sum is 1.
        elasticity: (p, 6, 6).
        turn: (p, 6, 6) stresses in the axes of the ply.
        rho: (p,) densities.
        alpha: (p, 6) strain per degree in the axes of the ply.
        ge, tref: structural damping coefficient, temperature without strain.
    """

    share: Float64
    elasticity: Float64
    turn: Float64
    rho: Float64
    alpha: Float64
    ge: float
    tref: float

    @property
    def middle(self) -> Float64:
        """(p,) natural coordinate of the middle of each ply."""
        top = np.cumsum(self.share)
        return 2.0 * (top - 0.5 * self.share) - 1.0

    def rule(self) -> tuple[Rule, Int64]:
        """Two Gauss points along each direction of each ply, and their ply (q,)."""
        x = np.array([-1.0, 1.0]) / np.sqrt(3.0)
        grid = np.stack(np.meshgrid(x, x, x, indexing="ij"), axis=-1).reshape(-1, 3)
        points = np.tile(grid, (len(self.share), 1))
        ply = np.repeat(np.arange(len(self.share)), len(grid))
        points[:, 2] = self.middle[ply] + self.share[ply] * points[:, 2]
        return Rule(points=points, weights=self.share[ply]), ply

    def laminate_map(self) -> Float64:
        """(p, 6, 6) stresses of each ply from those of the laminate as a whole."""
        compliance = np.linalg.inv(self.elasticity)
        plane = np.linalg.inv(compliance[:, _PLANE][:, :, _PLANE])
        along = -np.einsum("pij,pj->pi", plane, compliance[:, _PLANE, _ACROSS])
        ratio = plane @ np.linalg.inv(np.einsum("p,pij->ij", self.share, plane))
        maps = np.broadcast_to(np.eye(6), compliance.shape).copy()
        maps[:, np.array(_PLANE)[:, None], _PLANE] = ratio
        maps[:, _PLANE, _ACROSS] = along - ratio @ (self.share @ along)
        return maps


def layered_modes(points: Float64, ply: Int64, turn: Float64, stack: Stack) -> Float64:
    """(e, q, 6, b) assumed stresses in the axes of the element.

    Args:
        points: (q, 3) natural, the plies stacked along the third.
        ply: (q,) which ply they are in.
        turn: (e, 6, 6) stresses in the axes of the element from natural ones.
        stack: the plies.
    """
    whole = np.delete(pian_tong(points), _SHEAR, axis=2)
    whole = stack.laminate_map()[ply] @ (turn[:, None] @ whole)
    count = len(stack.share)
    shear = np.zeros((len(points), 6, len(_SHEAR_IN_PLY), count))
    for k, (component, coordinate) in enumerate(_SHEAR_IN_PLY):
        value = 1.0 if coordinate is None else points[:, coordinate]
        shear[np.arange(len(points)), component, k, ply] = value
    own = turn[:, None] @ shear.reshape(len(points), 6, -1)
    return np.concatenate([whole, own], axis=-1)


@dataclass(frozen=True, kw_only=True)
class LayeredSolid(DenseBlock):
    """CHEXA with eight grids and one PCOMPS.

    Attributes:
        pid: (e,) property ids.
        shape: that of CHEXA with eight grids.
        nodes: (e, 8, 3) in the basic frame, as on the card.
        order: (e, 8) nodes as they come for plies stacked along the third direction.
        axes: (e, 3, 3) rows: direction of plies at 0 degrees, across it, normal.
        stack: the plies.
    """

    pid: Int64
    shape: Shape
    nodes: Float64
    order: Int64
    axes: Float64
    stack: Stack

    property_card: str = "PCOMPS"

    @property
    def _placed(self) -> Float64:
        return np.take_along_axis(self.nodes, self.order[:, :, None], axis=1)

    def _hybrid(self) -> tuple[Float64, Float64, Float64]:
        """Work (e, b, 24), its amplitudes (e, b, 24), and turns of stresses (e, 6, 6).

        The 24 displacements go by `order`.
        """
        rule, ply = self.stack.rule()
        slope = hex8_derivatives(rule.points)
        jacobian = jacobians(self._placed, slope)
        weight = rule.weights * np.linalg.det(jacobian)
        strain = strain_operator(np.linalg.inv(jacobian) @ slope)
        strain = stress_rotation(self.axes, strain=True)[:, None] @ strain
        center = jacobians(self._placed, hex8_derivatives(np.zeros((1, 3))))[:, 0]
        turn = stress_transform(center @ self.axes.swapaxes(1, 2))
        inside = layered_modes(rule.points, ply, turn, self.stack)
        compliance = np.linalg.inv(self.stack.elasticity)[ply]
        flexible = np.einsum(
            "eq,eqsa,eqsb->eab", weight, inside, compliance @ inside, optimize=True
        )
        work = np.einsum("eq,eqsa,eqsi->eai", weight, inside, strain, optimize=True)
        return work, np.linalg.solve(flexible, work), turn

    def _on_card(self, matrix: Float64, axes: tuple[int, ...]) -> Float64:
        """Displacements by the order of the card along axes of a matrix."""
        back = np.argsort(self.order, axis=1)
        at = (3 * back[:, :, None] + np.arange(3)).reshape(len(self.id), 24)
        for axis in axes:
            index = at.reshape([-1, *(24 if k == axis else 1 for k in (1, 2))])
            matrix = np.take_along_axis(matrix, index, axis=axis)
        return matrix

    def stiffness(self) -> Float64:
        """(e, 24, 24)."""
        work, amplitude, _ = self._hybrid()
        return self._on_card(work.transpose(0, 2, 1) @ amplitude, (1, 2))

    def expansion(self) -> Float64:
        """(e, 24), see `DenseBlock`; plies that expand alike in all directions.

        Raises:
            InputError: others.
        """
        alpha = self.stack.alpha
        mean = alpha[:, :3].mean()
        if np.abs(alpha - mean * np.array([1, 1, 1, 0, 0, 0])).max() > 1e-12 * mean:
            raise InputError(
                f"CHEXA {self.id[0]}: PCOMPS {self.pid[0]}: temperatures of plies that "
                "expand differently are not supported; expected one coefficient for all"
            )
        arm = self.nodes - self.nodes.mean(axis=1, keepdims=True)
        return mean * arm.reshape(len(self.id), -1)

    @property
    def tref(self) -> Float64:
        """(e,) temperature without strain."""
        return np.full(len(self.id), self.stack.tref)

    def structural_damping(self) -> Float64 | None:
        """(e,) GE."""
        return some(np.full(len(self.id), self.stack.ge))

    def volume(self) -> Float64:
        """(e,)."""
        return self._weights().sum(axis=1)

    def _weights(self) -> Float64:
        rule, _ = self.stack.rule()
        slope = hex8_derivatives(rule.points)
        return rule.weights * np.linalg.det(jacobians(self._placed, slope))

    def mass(self, *, coupled: bool) -> Float64:
        """(e, 24, 24): of the displacements, or lumped."""
        rule, ply = self.stack.rule()
        value, weight = hex8(rule.points), self._weights() * self.stack.rho[ply]
        if coupled:
            product = np.einsum("eq,qi,qj->eij", weight, value, value, optimize=True)
        else:
            product = (weight @ value)[:, :, None] * np.eye(8)
        full = product[:, :, None, :, None] * np.eye(3)[:, None, :]
        return self._on_card(full.reshape(-1, 24, 24), (1, 2))

    def stresses(self) -> Recovery:
        """Stresses in the middle of each ply, in its axes."""
        return self._recovery(LAYER_STRESS, self.stack.turn)

    def strains(self) -> Recovery:
        """Strains in the middle of each ply, in its axes."""
        turned = self.stack.turn @ self.stack.elasticity
        back = np.linalg.inv(turned @ self.stack.turn.swapaxes(1, 2))
        return self._recovery(LAYER_STRAIN, back @ self.stack.turn, strain=True)

    def _recovery(
        self, columns: tuple[str, ...], turn: Float64, *, strain: bool = False
    ) -> Recovery:
        _, amplitude, natural = self._hybrid()
        count = len(self.stack.share)
        points = np.column_stack([np.zeros((count, 2)), self.stack.middle])
        modes = layered_modes(points, np.arange(count), natural, self.stack)
        matrix = self._on_card(
            (turn @ modes @ amplitude[:, None]).reshape(len(self.id), -1, 24), (2,)
        )
        return LayerRecovery(
            table=f"{self.card}_COMPOSITE",
            columns=of_plies(columns, count),
            matrix=matrix,
            id=self.id,
            strain=strain,
        )

    def take(self, which: Int64) -> "LayeredSolid":
        """Some of the elements."""
        names = ("id", "dof", "pid", "nodes", "order", "axes")
        return replace(self, **{name: getattr(self, name)[which] for name in names})


@dataclass(frozen=True, kw_only=True)
class LayerRecovery(Recovery):
    """Stresses or strains of plies with von Mises."""

    strain: bool = False

    def derive(self, linear: Float64) -> Float64:
        """(..., e, 7 p) from (..., e, 6 p)."""
        tensor = linear.reshape(*linear.shape[:-1], -1, 6)
        halved = tensor * np.array([1.0] * 3 + [0.5 if self.strain else 1.0] * 3)
        mises = (2.0 / 3.0 if self.strain else 1.0) * solid_von_mises(halved)
        columns = np.concatenate([tensor, mises[..., None]], axis=-1)
        return columns.reshape(*linear.shape[:-1], -1)


def stacked_along(jacobian: Float64, direction: Float64) -> Int64:
    """(e, 8) nodes so that the third natural direction is the one nearest to another.

    Args:
        jacobian: (e, 3, 3) natural directions at the center, as rows.
        direction: (e, 3) of the stack.
    """
    unit = jacobian / np.linalg.norm(jacobian, axis=2, keepdims=True)
    along = np.einsum("eia,ea->ei", unit, direction)
    axis = np.abs(along).argmax(axis=1)
    up = np.take_along_axis(along, axis[:, None], axis=1)[:, 0] > 0.0
    return _ORDERS[axis, up.astype(int)]


def _orders() -> Int64:
    """(3, 2, 8) by natural direction of the stack, and whether it goes along it."""
    found = np.zeros((3, 2, 8), np.int64)
    for axis in range(3):
        for up in (0, 1):
            first, second = (axis + 1) % 3, (axis + 2) % 3
            if not up:
                first, second = second, first
            place = np.empty((8, 3))
            place[:, first], place[:, second] = HEX_CORNERS[:, 0], HEX_CORNERS[:, 1]
            place[:, axis] = HEX_CORNERS[:, 2] * (1.0 if up else -1.0)
            same = (place[:, None] == HEX_CORNERS).all(axis=2)
            found[axis, up] = same.argmax(axis=1)
    return found


_ORDERS = _orders()
