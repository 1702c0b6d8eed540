"""CPLSTN3 to 8 and CPLSTS3 to 8: slices in plane strain, and in plane stress.

They lie in the x-z or the x-y plane of the basic frame; PPLANE gives their thickness.
Triangles of three and six grids and quadrilaterals of eight take displacements (three
and 3 x 3 points), those of four the five stresses of Pian and Sumihara (1984). Under
the displacements that NX Nastran prints for plane strain its inner grids are in balance
to single precision, and these are its stresses (pyNastran models, conedg01e).
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.records.solids import PLANE_STRESS
from fem.deck.references import refer, table, where
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock, some
from fem.elements.shells.shell_recovery import point_names
from fem.elements.solids.isoparametric import product_penta
from fem.elements.solids.plane_shapes import CORNERS, Shapes, quad4, quad8, triangle
from fem.elements.stress_measures import solid_von_mises
from fem.errors import InputError
from fem.geometry.points import Points
from fem.properties.elasticity import isotropic_solid, plane_stress
from fem.properties.materials import isotropic

if TYPE_CHECKING:
    from fem.deck.deck import Deck

CARDS = tuple(f"CPLST{kind}{n}" for kind in "NS" for n in (3, 4, 6, 8))
_FLAT = 1e-6  # of the size: how far from its plane a grid may lie


def _gauss(order: int) -> tuple[Float64, Float64]:
    x, w = np.polynomial.legendre.leggauss(order)
    points = np.stack(np.meshgrid(x, x, indexing="ij"), axis=-1).reshape(-1, 2)
    return points, np.outer(w, w).ravel()


def _inside(count: int) -> tuple[Float64, Float64]:
    rule = product_penta(count, 1)
    return rule.points[:, :2], 0.5 * rule.weights


_TRIANGLE = np.array([[1 / 3, 1 / 3], [0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
_QUAD = np.concatenate([np.zeros((1, 2)), CORNERS])


@dataclass(frozen=True)
class _Kind:
    """Shape functions, points and weights, points of the results."""

    shapes: Shapes
    rule: tuple[Float64, Float64]
    output: Float64


_KINDS: Mapping[int, _Kind] = {
    3: _Kind(triangle(3), _inside(3), _TRIANGLE[:1]),
    4: _Kind(quad4, _gauss(2), _QUAD),
    6: _Kind(triangle(6), _inside(3), _TRIANGLE),
    8: _Kind(quad8, _gauss(3), _QUAD[:1]),  # what NX prints at corners was not found
}


@dataclass(frozen=True, kw_only=True)
class Slice(DenseBlock):
    """Slices of one card in one plane; three freedoms a grid.

    Attributes:
        pid: (e,) property ids.
        grids: number of grids of an element.
        axes: the basic axes of the plane, (0, 2) or (0, 1).
        nodes: (e, n, 2) along these.
        thickness, rho, nsm, ge, alpha, tref: (e,) of property and material.
        elasticity: (e, 3, 3) direct, direct, shear.
        across: (e,) stress across the plane over the sum of those within; 0: none.
        stretch: (e,) strain across over the sum of the stresses within.
    """

    pid: Int64
    grids: int
    axes: tuple[int, int]
    nodes: Float64
    thickness: Float64
    rho: Float64
    nsm: Float64
    ge: Float64
    alpha: Float64
    tref: Float64
    elasticity: Float64
    across: Float64
    stretch: Float64

    property_card: str = "PPLANE"

    @property
    def corners(self) -> Float64:
        """(e, 3 or 4, 3) corners, basic frame."""
        count = 4 if self.grids in (4, 8) else 3
        found = np.zeros((len(self.id), count, 3))
        found[:, :, list(self.axes)] = self.nodes[:, :count]
        return found

    def _at(self, points: Float64) -> tuple[Float64, Float64]:
        """(e, q, 3, 2 n) strains and (e, q) Jacobians."""
        _, slope = _KINDS[self.grids].shapes(points)
        jacobian = np.einsum("qbn,ena->eqba", slope, self.nodes)
        gradient = np.linalg.inv(jacobian) @ slope
        strain = np.zeros((*gradient.shape[:2], 3, self.grids, 2))
        strain[:, :, 0, :, 0] = strain[:, :, 2, :, 1] = gradient[:, :, 0]
        strain[:, :, 1, :, 1] = strain[:, :, 2, :, 0] = gradient[:, :, 1]
        shape = (*gradient.shape[:2], 3, 2 * self.grids)
        return strain.reshape(shape), np.linalg.det(jacobian)

    def _weighted(self) -> tuple[Float64, Float64]:
        points, weights = _KINDS[self.grids].rule
        strain, jacobian = self._at(points)
        return strain, weights * np.abs(jacobian) * self.thickness[:, None]

    def _assumed(self, points: Float64) -> Float64:
        """(e, q, 3, 5) stresses of Pian and Sumihara."""
        _, slope = quad4(np.zeros((1, 2)))
        first, second = np.einsum("bn,ena->bea", slope[0], self.nodes)
        modes = np.zeros((len(self.id), len(points), 3, 5))
        modes[:, :, :, :3] = np.eye(3)
        for k, (along, coordinate) in enumerate(((first, 1), (second, 0))):
            a, b = along.T
            tensor = np.stack([a * a, b * b, a * b], axis=1)
            modes[:, :, :, 3 + k] = points[:, coordinate, None] * tensor[:, None]
        return modes

    def _amplitudes(self) -> tuple[Float64, Float64]:
        """Work (e, 5, 8) of the assumed stresses, and what they are (e, 5, 8)."""
        strain, weight = self._weighted()
        modes = self._assumed(_KINDS[4].rule[0])
        yielding = np.linalg.inv(self.elasticity)[:, None] @ modes
        flexible = np.einsum("eq,eqsa,eqsb->eab", weight, modes, yielding)
        work = np.einsum("eq,eqsa,eqsi->eai", weight, modes, strain)
        return work, np.linalg.solve(flexible, work)

    def _spread(self, matrix: Float64, axes: tuple[int, ...]) -> Float64:
        """Freedoms of the plane among three a grid, along axes of a matrix."""
        at = (3 * np.arange(self.grids)[:, None] + np.array(self.axes)).ravel()
        shape = list(matrix.shape)
        for axis in axes:
            shape[axis] = 3 * self.grids
        full = np.zeros(shape)
        place = [slice(None)] * (matrix.ndim - len(axes))
        full[(*place, *(np.ix_(*[at] * len(axes))))] = matrix
        return full

    def stiffness(self) -> Float64:
        """(e, 3 n, 3 n)."""
        if self.grids == 4:
            work, amplitude = self._amplitudes()
            flat = work.swapaxes(1, 2) @ amplitude
        else:
            strain, weight = self._weighted()
            stress = self.elasticity[:, None] @ strain
            flat = np.einsum("eq,eqsi,eqsj->eij", weight, strain, stress, optimize=True)
        return self._spread(flat, (1, 2))

    def structural_damping(self) -> Float64 | None:
        """(e,) GE."""
        return some(self.ge)

    def mass(self, *, coupled: bool) -> Float64:
        """(e, 3 n, 3 n): of the displacements, or its diagonal scaled to the whole."""
        points, _ = _KINDS[self.grids].rule
        value, _ = _KINDS[self.grids].shapes(points)
        _, weight = self._weighted()
        weight = weight * (self.rho + self.nsm / self.thickness)[:, None]
        product = np.einsum("eq,qi,qj->eij", weight, value, value, optimize=True)
        if not coupled:
            diagonal = np.einsum("eii->ei", product)
            whole = weight.sum(axis=1, keepdims=True)
            total = diagonal.sum(axis=1, keepdims=True)
            share = diagonal / np.where(total > 0.0, total, 1.0)
            product = (share * whole)[:, :, None] * np.eye(self.grids)
        full = product[:, :, None, :, None] * np.eye(3)[:, None, :]
        return full.reshape(len(self.id), 3 * self.grids, -1)

    def expansion(self) -> Float64:
        """(e, 3 n), see `DenseBlock`; of plane stress.

        Raises:
            InputError: plane strain, which is never free to expand.
        """
        if np.any(self.across):
            raise InputError(
                f"{self.card} {self.id[0]}: temperatures of plane strain are not "
                "supported; expected plane stress (CPLSTS) or solids"
            )
        arm = self.nodes - self.nodes.mean(axis=1, keepdims=True)
        moved = (self.alpha[:, None, None] * arm).reshape(len(self.id), -1)
        return self._spread(moved, (1,))

    def stresses(self) -> Recovery:
        """Stresses at the center and the corners."""
        return self._recovery(strain=False)

    def strains(self) -> Recovery:
        """Strains at the center and the corners."""
        return self._recovery(strain=True)

    def _recovery(self, *, strain: bool) -> Recovery:
        points = _KINDS[self.grids].output
        if self.grids == 4:
            stress = self._assumed(points) @ self._amplitudes()[1][:, None]
        else:
            stress = self.elasticity[:, None] @ self._at(points)[0]
        within = stress
        if strain:
            within = np.linalg.inv(self.elasticity)[:, None] @ stress
        factor = self.stretch if strain else self.across
        across = factor[:, None, None] * (stress[:, :, 0] + stress[:, :, 1])
        ordered = np.zeros((*stress.shape[:2], 4, stress.shape[3]))
        other = 3 - sum(self.axes)
        ordered[:, :, list(self.axes)] = within[:, :, :2]
        ordered[:, :, other], ordered[:, :, 3] = across, within[:, :, 2]
        matrix = ordered.reshape(len(self.id), 4 * len(points), -1)
        return SliceRecovery(
            table=self.card,
            columns=point_names(PLANE_STRESS, len(points)),
            matrix=self._spread(matrix, (2,)),
            id=self.id,
            strain=strain,
        )

    def take(self, which: Int64) -> "Slice":
        """Some of the elements."""
        names = ("id", "dof", "pid", "nodes", "thickness", "rho", "nsm", "ge")
        names += ("alpha", "tref", "elasticity", "across", "stretch")
        return replace(self, **{name: getattr(self, name)[which] for name in names})


@dataclass(frozen=True, kw_only=True)
class SliceRecovery(Recovery):
    """Three direct components, the shear in the plane, von Mises."""

    strain: bool = False

    def derive(self, linear: Float64) -> Float64:
        """(..., e, 5 p) from (..., e, 4 p)."""
        own = linear.reshape(*linear.shape[:-1], -1, 4)
        none = np.zeros_like(own[..., 0])
        half = 0.5 if self.strain else 1.0
        tensor = np.stack(
            [*np.moveaxis(own[..., :3], -1, 0), half * own[..., 3], none, none], axis=-1
        )
        mises = (2.0 / 3.0 if self.strain else 1.0) * solid_von_mises(tensor)
        columns = np.concatenate([own, mises[..., None]], axis=-1)
        return columns.reshape(*linear.shape[:-1], -1)


def read_slices(deck: "Deck", points: Points, card: str) -> list[Slice]:
    """Blocks of one card, one for each plane.

    Raises:
        InputError: grids off both planes, shapes without area or concave, materials
            that are absent; all of them.
    """
    rows = table(deck, card).sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    at = points.rows(np.stack([np.asarray(n, np.int64) for n in rows["nodes"]]))
    xyz = points.xyz[at]
    size = np.ptp(xyz, axis=1).max(axis=1)
    flat = {k: np.abs(xyz[:, :, k]).max(axis=1) <= _FLAT * size for k in (1, 2)}
    loose = np.flatnonzero(~(flat[1] | flat[2]))
    problems = [
        f"{where(card, rows.iloc[k])}: a grid lies off the plane; expected all of them "
        "in the x-z or the x-y plane of the basic frame"
        for k in loose[:10]
    ]
    if problems:
        raise InputError(problems)
    blocks = []
    for axes, chosen in (((0, 2), flat[1]), ((0, 1), flat[2] & ~flat[1])):
        own = np.flatnonzero(chosen)
        if len(own):
            part = rows.iloc[own].reset_index(drop=True)
            blocks.append(_block(deck, card, part, at[own], xyz[own], axes))
    return blocks


def _block(
    deck: "Deck",
    card: str,
    rows: pd.DataFrame,
    at: Int64,
    xyz: Float64,
    axes: tuple[int, int],
) -> Slice:
    count = int(card[-1])
    nodes = xyz[:, :, list(axes)]
    kind = _KINDS[count]
    _, slope = kind.shapes(np.concatenate([kind.rule[0], kind.output]))
    jacobian = np.linalg.det(np.einsum("qbn,ena->eqba", slope, nodes))
    size = np.abs(jacobian).max(axis=1, keepdims=True)
    signs = np.sign(np.where(np.abs(jacobian) > 1e-9 * size, jacobian, 0.0))
    bad = np.flatnonzero(np.abs(signs.sum(axis=1)) < jacobian.shape[1])
    if len(bad):
        raise InputError(
            f"{where(card, rows.iloc[k])}: it has no area, is concave, or its grids "
            "are out of order; expected corners that go round, then mid-sides"
            for k in bad[:10]
        )
    values = refer(rows, card, "pid", table(deck, "PPLANE"), "PPLANE")
    material = isotropic(deck, values, "PPLANE", poisson=True)
    within = [_elasticity(e, nu, card) for e, nu in zip(material.e, material.nu)]
    strain = card[5] == "N"
    return Slice(
        card=card,
        id=rows["eid"].to_numpy(np.int64),
        dof=(6 * at[:, :, None] + np.arange(3)).reshape(len(rows), -1),
        pid=rows["pid"].to_numpy(np.int64),
        grids=count,
        axes=axes,
        nodes=nodes,
        thickness=values["t"].to_numpy(float),
        rho=material.rho,
        nsm=values["nsm"].to_numpy(float),
        ge=material.ge,
        alpha=material.alpha,
        tref=material.tref,
        elasticity=np.stack(within),
        across=material.nu * strain,
        stretch=np.zeros(len(rows)) if strain else -material.nu / material.e,
    )


def _elasticity(young: float, nu: float, card: str) -> Float64:
    """(3, 3) of plane strain or plane stress.

    Raises:
        InputError: there is none.
    """
    if not young > 0.0 or not -1.0 < nu < 0.5:
        raise InputError(
            f"{card}: E {young:g}, NU {nu:g}: expected E above 0, NU from -1 to 0.5"
        )
    if card[5] == "S":
        return plane_stress(young, nu)
    rows = [0, 1, 3]
    return isotropic_solid(young, nu)[np.ix_(rows, rows)]
