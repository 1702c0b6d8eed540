"""Blocks of solids: three freedoms per node, stresses at the centre and the corners."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from fem.arrays import Float64, Int64
from fem.deck.records.solids import SOLID_STRAIN, SOLID_STRESS
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock, some
from fem.elements.shells.shell_recovery import point_names
from fem.elements.solids.isoparametric import Derivatives, Rule, jacobians
from fem.elements.solids.solid_stiffness import SolidMatrices
from fem.elements.stress_measures import solid_principal, solid_von_mises

# Elements that are integrated at a time: bounds the memory for large models.
_CHUNK = 2048


@dataclass(frozen=True, kw_only=True)
class Shape:
    """One kind of solid.

    Attributes:
        card, nodes: "CHEXA" and its number of nodes.
        corners: number of corner nodes.
        matrices: nodes (e, n, 3) and elasticity (e, 6, 6) to stiffness and stresses.
        values, derivatives: shape functions at natural points.
        mass_rule: quadrature of the mass.
        checked: (p, 3) natural points where the Jacobian must be positive.
        quadratic: with mid-side nodes.
    """

    card: str
    nodes: int
    corners: int
    matrices: Callable[[Float64, Float64], SolidMatrices]
    values: Derivatives
    derivatives: Derivatives
    mass_rule: Rule
    checked: Float64
    quadratic: bool = False


@dataclass(frozen=True, kw_only=True)
class Solid(DenseBlock):
    """Solids of one kind; 3 n freedoms, basic axes.

    Attributes:
        pid: (e,) property ids.
        shape: kind of element.
        nodes: (e, n, 3) in the basic frame.
        elasticity: (e, 6, 6) in basic axes.
        axes: (e, 3, 3) rows are the material axes in the basic frame (stress output).
        rho, ge: (e,) density and structural damping coefficient.
    """

    pid: Int64
    shape: Shape
    nodes: Float64
    elasticity: Float64
    axes: Float64
    rho: Float64
    ge: Float64

    property_card: str = "PSOLID"

    def _matrices(self, part: slice) -> SolidMatrices:
        return self.shape.matrices(self.nodes[part], self.elasticity[part])

    def _parts(self) -> list[slice]:
        count = len(self.id)
        return [slice(k, min(k + _CHUNK, count)) for k in range(0, count, _CHUNK)]

    def stiffness(self) -> Float64:
        """(e, 3 n, 3 n)."""
        return np.concatenate([self._matrices(p).stiffness for p in self._parts()])

    def structural_damping(self) -> Float64 | None:
        """(e,) GE."""
        return some(self.ge)

    def volume(self) -> Float64:
        """(e,)."""
        rule = self.shape.mass_rule
        return np.linalg.det(
            jacobians(self.nodes, self.shape.derivatives(rule.points))
        ) @ (rule.weights)

    def mass(self, *, coupled: bool) -> Float64:
        """(e, 3 n, 3 n).

        Lumped: row sums for linear elements; for quadratic ones the diagonal of the
        coupled matrix scaled to the total mass, since row sums are negative there.
        """
        rule = self.shape.mass_rule
        slope, value = (
            self.shape.derivatives(rule.points),
            self.shape.values(rule.points),
        )
        weight = rule.weights * np.linalg.det(jacobians(self.nodes, slope))
        product = np.einsum("eq,qi,qj->eij", weight, value, value, optimize=True)
        if not coupled:
            diagonal = product.sum(axis=2)
            if self.shape.quadratic:
                total = diagonal.sum(axis=1, keepdims=True)
                diagonal = np.einsum("eii->ei", product)
                diagonal = diagonal * total / diagonal.sum(axis=1, keepdims=True)
            product = diagonal[:, :, None] * np.eye(self.shape.nodes)
        # Last: the scaling of quadratic elements divides by the mass of the shape.
        product = product * self.rho[:, None, None]
        size = 3 * self.shape.nodes
        full = product[:, :, None, :, None] * np.eye(3)[:, None, :]
        return full.reshape(-1, size, size)

    def stresses(self) -> Recovery:
        """Stresses at the centre and the corners in material axes."""
        return self._recovery(strain=False)

    def strains(self) -> Recovery:
        """Strains at the centre and the corners in material axes."""
        return self._recovery(strain=True)

    def _recovery(self, *, strain: bool) -> Recovery:
        stress = np.concatenate([self._matrices(p).stress for p in self._parts()])
        if strain:
            stress = np.linalg.inv(self.elasticity)[:, None] @ stress
        turn = stress_rotation(self.axes, strain=strain)
        matrix = turn[:, None] @ stress
        e, p = matrix.shape[:2]
        return SolidRecovery(
            table=self.card,
            columns=point_names(SOLID_STRAIN if strain else SOLID_STRESS, p),
            matrix=matrix.reshape(e, p * 6, -1),
            id=self.id,
            strain=strain,
        )

    def take(self, which: Int64) -> "Solid":
        """Some of the elements."""
        names = ("id", "dof", "pid", "nodes", "elasticity", "axes", "rho", "ge")
        return replace(self, **{k: getattr(self, k)[which] for k in names})


@dataclass(frozen=True, kw_only=True)
class SolidRecovery(Recovery):
    """Stresses or strains of solids with principal values and von Mises, per point."""

    strain: bool = False

    def derive(self, linear: Float64) -> Float64:
        """(..., e, 10 p) from (..., e, 6 p)."""
        tensor = linear.reshape(*linear.shape[:-1], -1, 6)
        halved = tensor * np.array([1.0] * 3 + [0.5 if self.strain else 1.0] * 3)
        factor = 2.0 / 3.0 if self.strain else 1.0
        columns = np.concatenate(
            [
                tensor,
                solid_principal(halved),
                factor * solid_von_mises(halved)[..., None],
            ],
            axis=-1,
        )
        return columns.reshape(*linear.shape[:-1], -1)


def stress_rotation(axes: Float64, *, strain: bool = False) -> Float64:
    """(e, 6, 6) components along rows of `axes` from basic ones, xx yy zz xy yz zx.

    Engineering shear strains take the factor 2 on the other side of the diagonal.
    """
    pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))
    matrix = np.empty((len(axes), 6, 6))
    for row, (i, j) in enumerate(pairs):
        for col, (a, b) in enumerate(pairs):
            value = axes[:, i, a] * axes[:, j, b]
            if a != b:
                value = value + axes[:, i, b] * axes[:, j, a]
            if strain and (a != b) != (i != j):
                value = value * (0.5 if a != b else 2.0)
            matrix[:, row, col] = value
    return matrix
