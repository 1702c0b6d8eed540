"""Blocks of solids: three freedoms per node, stresses at the center and the corners."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from fem.arrays import Float64, Int64
from fem.deck.records.solids import SOLID_STRAIN, SOLID_STRESS
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock, some
from fem.elements.shells.shell_recovery import point_names
from fem.elements.solids.element_axes import stress_rotation
from fem.elements.solids.isoparametric import Derivatives, Rule, jacobians
from fem.elements.solids.solid_preload import solid_differential
from fem.elements.solids.solid_stiffness import SolidMatrices
from fem.elements.stress_measures import solid_principal, solid_von_mises

# Elements that are integrated at a time: bounds the memory for large models.
_CHUNK = 2048


Matrices = Callable[[Float64, Float64], SolidMatrices]


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
        integration: other ways to integrate, by the fields IN and ISOP of PSOLID.
    """

    card: str
    nodes: int
    corners: int
    matrices: Matrices
    values: Derivatives
    derivatives: Derivatives
    mass_rule: Rule
    checked: Float64
    integration: Mapping[tuple[str, str], Matrices] = field(default_factory=dict)


def lumped_mass(nodes: Float64, masses: Float64, corners: int) -> Float64:
    """(e, n) masses at the nodes, none of them negative on common shapes.

    The integrals of the shape functions, as long as they are positive. With mid-sides
    those of corners are negative: what such corners have is given to the mid-sides in
    proportion to their squared distance from the center of the element. On a box this
    is 1/24 + L^2 / (8 sum L^2) of the mass on the middle of an edge of length L, which
    MSC 2020 has (gravity load of one CHEXA with edges of 2.5, 5 and 10). On a right
    prism NX 2019.2 has other shares, by up to 0.012 of the element's mass.

    Args:
        nodes: (e, n, 3) corners, then mid-sides.
        masses: (e, n) integrals of the shape functions.
        corners: number of corners.
    """
    if masses.shape[1] == corners:
        return masses
    middles = nodes[:, corners:]
    center = nodes[:, :corners].mean(axis=1, keepdims=True)
    square = ((middles - center) ** 2).sum(axis=2)
    share = square / square.sum(axis=1, keepdims=True)
    lumped = masses.copy()
    lumped[:, :corners] = np.maximum(masses[:, :corners], 0.0)
    left = np.minimum(masses[:, :corners], 0.0).sum(axis=1, keepdims=True)
    lumped[:, corners:] += left * share
    return lumped


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
        alpha: (e, 6) strain per degree, basic axes.
        tref: (e,) temperature without strain.
    """

    pid: Int64
    shape: Shape
    nodes: Float64
    elasticity: Float64
    axes: Float64
    rho: Float64
    ge: Float64
    alpha: Float64
    tref: Float64

    property_card: str = "PSOLID"

    def _matrices(self, part: slice) -> SolidMatrices:
        return self.shape.matrices(self.nodes[part], self.elasticity[part])

    def _parts(self) -> list[slice]:
        count = len(self.id)
        return [slice(k, min(k + _CHUNK, count)) for k in range(0, count, _CHUNK)]

    def stiffness(self) -> Float64:
        """(e, 3 n, 3 n)."""
        return np.concatenate([self._matrices(p).stiffness for p in self._parts()])

    def differential_stiffness(
        self, motion: Float64, load: Float64 | None = None
    ) -> Float64:
        """(e, 3 n, 3 n) of the stresses."""
        shape, found = self.shape, []
        for part in self._parts():
            stress = np.einsum(
                "epsn,en->eps", self._matrices(part).stress, motion[part]
            )
            found.append(
                solid_differential(
                    self.nodes[part],
                    stress,
                    shape.corners,
                    shape.mass_rule,
                    shape.derivatives,
                )
            )
        return np.concatenate(found)

    def expansion(self) -> Float64:
        """(e, 3 n), see `DenseBlock`."""
        xx, yy, zz, xy, yz, zx = self.alpha.T
        rows = [[xx, 0.5 * xy, 0.5 * zx], [0.5 * xy, yy, 0.5 * yz]]
        rows.append([0.5 * zx, 0.5 * yz, zz])
        strain = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
        arm = self.nodes - self.nodes.mean(axis=1, keepdims=True)
        return (arm @ strain).reshape(len(self.id), -1)

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
        """(e, 3 n, 3 n): of the displacements, or lumped (`lumped_mass`)."""
        rule = self.shape.mass_rule
        slope, value = (
            self.shape.derivatives(rule.points),
            self.shape.values(rule.points),
        )
        weight = rule.weights * np.linalg.det(jacobians(self.nodes, slope))
        if coupled:
            product = np.einsum("eq,qi,qj->eij", weight, value, value, optimize=True)
        else:
            masses = lumped_mass(self.nodes, weight @ value, self.shape.corners)
            product = masses[:, :, None] * np.eye(self.shape.nodes)
        product = product * self.rho[:, None, None]
        size = 3 * self.shape.nodes
        full = product[:, :, None, :, None] * np.eye(3)[:, None, :]
        return full.reshape(-1, size, size)

    def stresses(self) -> Recovery:
        """Stresses at the center and the corners in material axes."""
        return self._recovery(strain=False)

    def strains(self) -> Recovery:
        """Strains at the center and the corners in material axes."""
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
        names = (
            "id",
            "dof",
            "pid",
            "nodes",
            "elasticity",
            "axes",
            "rho",
            "ge",
            "alpha",
        )
        names += ("tref",)
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
