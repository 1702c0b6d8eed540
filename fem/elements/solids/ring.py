"""CTRIAX6: rings whose cross-section is a triangle of up to six grids.

The section lies in the x-z plane of the basic frame, x the radius. Displacements are
radial and axial, quadratic in the section; matrices and loads are those of the whole
circumference, so that a force at a grid is that of its circle. Stiffness by seven
points (exact to degree five), order of strains radial, azimuthal, axial, shear.

With these seven points, E and nu for the normal strains, the card's own G for shear and
material axes turned by TH from x towards z, displacements and stresses are those of MSC
Nastran to single precision (pyNastran models, randvar2, d200obus). Its mass was not
seen: coupled it is that of the displacements, lumped its diagonal scaled to the whole
mass (Hinton, Rock and Zienkiewicz 1976).
"""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.records.solids import RING_STRESS
from fem.deck.references import table, where
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock, some
from fem.elements.shells.shell_recovery import point_names
from fem.elements.solids.isoparametric import product_penta
from fem.elements.stress_measures import solid_principal, solid_von_mises
from fem.errors import InputError, Problems
from fem.geometry.points import Points
from fem.properties.ring_elasticity import RingMaterial, ring_materials

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_CORNERS = (0, 2, 4)
_CENTER = np.array([[1 / 3, 1 / 3]])
_OUTPUT = np.concatenate([_CENTER, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]])
_PLANE = 1e-6  # of the size: how far from the x-z plane a grid may lie


def shapes(points: Float64, there: npt.NDArray[np.bool_]) -> tuple[Float64, Float64]:
    """Shape functions (q, 6) and derivatives (q, 2, 6) at natural points (q, 2).

    Grids go round: corner, mid-side, corner, ...; `there` (6,) says which exist.
    """
    r, s = points.T
    area = np.stack([1.0 - r - s, r, s], axis=1)
    slope = np.array([[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]])
    value, derivative = np.zeros((len(points), 6)), np.zeros((len(points), 2, 6))
    value[:, ::2], derivative[:, :, ::2] = area, slope
    for side in range(3):
        a, b, middle = side, (side + 1) % 3, 2 * side + 1
        if not there[middle]:
            continue
        value[:, middle] = 4.0 * area[:, a] * area[:, b]
        derivative[:, :, middle] = 4.0 * (
            area[:, a, None] * slope[:, b] + area[:, b, None] * slope[:, a]
        )
        for corner in (2 * a, 2 * b):
            value[:, corner] -= 0.5 * value[:, middle]
            derivative[:, :, corner] -= 0.5 * derivative[:, :, middle]
    return value, derivative


@dataclass(frozen=True, kw_only=True)
class Ring(DenseBlock):
    """Rings with like mid-sides; three freedoms a grid, of which T2 has no stiffness.

    Attributes:
        section: (e, 6, 2) x and z of the grids; mid-sides that are not there are zero.
        there: (6,) which grids there are, as on the card; freedoms come by `order`.
        elasticity: (e, 4, 4) in the axes of the section.
        turn: (e, 4, 4) strains in the axes of the material.
        stiffness_in_axes: (e, 4, 4) elasticity in these.
        rho, ge, tref: (e,) of the material.
        alpha: (e, 3) radial, azimuthal and axial strain per degree, material axes.
    """

    section: Float64
    there: npt.NDArray[np.bool_]
    turn: Float64
    stiffness_in_axes: Float64
    rho: Float64
    ge: Float64
    alpha: Float64
    tref: Float64

    @property
    def order(self) -> list[int]:
        """(n,) grids on the card, corners first."""
        return _ordered(self.there)

    def _at(self, points: Float64) -> tuple[Float64, Float64, Float64, Float64]:
        """Shape functions (q, 6), strains (e, q, 4, 3 n), Jacobian, radius (e, q)."""
        value, slope = shapes(points, self.there)
        jacobian = np.einsum("qbn,ena->eqba", slope, self.section)
        gradient = np.linalg.solve(
            jacobian, np.broadcast_to(slope, (len(self.id), *slope.shape))
        )
        radius = np.einsum("qn,en->eq", value, self.section[:, :, 0])
        strain = np.zeros((*radius.shape, 4, 6, 3))
        strain[:, :, 0, :, 0] = strain[:, :, 3, :, 2] = gradient[:, :, 0]
        strain[:, :, 2, :, 2] = strain[:, :, 3, :, 0] = gradient[:, :, 1]
        # On the axis the hoop strain is the radial one.
        on_axis = radius < 1e-9 * np.abs(self.section).max()
        hoop = value / np.where(on_axis, 1.0, radius)[..., None]
        strain[:, :, 1, :, 0] = np.where(on_axis[..., None], gradient[:, :, 0], hoop)
        strain = strain[:, :, :, self.order].reshape(*radius.shape, 4, -1)
        return value[:, self.order], strain, np.linalg.det(jacobian), radius

    def _integrated(self) -> tuple[Float64, Float64, Float64]:
        rule = product_penta(7, 1)
        value, strain, jacobian, radius = self._at(rule.points[:, :2])
        weight = 0.5 * rule.weights * np.abs(jacobian) * 2.0 * np.pi * radius
        return value, strain, weight

    def _elasticity(self) -> Float64:
        return self.turn.swapaxes(1, 2) @ self.stiffness_in_axes @ self.turn

    def stiffness(self) -> Float64:
        """(e, 3 n, 3 n)."""
        _, strain, weight = self._integrated()
        stress = self._elasticity()[:, None] @ strain
        return np.einsum("eq,eqsi,eqsj->eij", weight, strain, stress, optimize=True)

    def structural_damping(self) -> Float64 | None:
        """(e,) GE."""
        return some(self.ge)

    def mass(self, *, coupled: bool) -> Float64:
        """(e, 3 n, 3 n): of the displacements, or its diagonal scaled."""
        value, _, weight = self._integrated()
        product = np.einsum("eq,qi,qj->eij", weight, value, value, optimize=True)
        if not coupled:
            diagonal = np.einsum("eii->ei", product)
            share = diagonal / diagonal.sum(axis=1, keepdims=True)
            product = (share * weight.sum(axis=1)[:, None])[:, :, None] * np.eye(
                value.shape[1]
            )
        full = (product * self.rho[:, None, None])[:, :, None, :, None]
        size = 3 * value.shape[1]
        return (full * np.eye(3)[:, None, :]).reshape(-1, size, size)

    def expansion(self) -> Float64:
        """(e, 3 n), see `DenseBlock`; materials that expand alike in all directions.

        Raises:
            InputError: others.
        """
        mean = self.alpha.mean(axis=1)
        if np.any(np.abs(self.alpha - mean[:, None]) > 1e-12 * np.abs(mean)[:, None]):
            raise InputError(
                f"CTRIAX6 {self.id[0]}: temperatures of a MAT3 that expands unlike in "
                "its directions are not supported; expected AX = ATH = AZ"
            )
        moved = np.zeros((len(self.id), 6, 3))
        moved[:, :, [0, 2]] = mean[:, None, None] * self.section
        return moved[:, self.order].reshape(len(self.id), -1)

    def stresses(self) -> Recovery:
        """Stresses at the center and the corners, axes of the material."""
        return self._recovery(strain=False)

    def strains(self) -> Recovery:
        """Strains at the center and the corners, axes of the material."""
        return self._recovery(strain=True)

    def _recovery(self, *, strain: bool) -> Recovery:
        _, matrix, _, _ = self._at(_OUTPUT)
        matrix = self.turn[:, None] @ matrix
        if not strain:
            matrix = self.stiffness_in_axes[:, None] @ matrix
        return RingRecovery(
            table=self.card,
            columns=point_names(RING_STRESS, len(_OUTPUT)),
            matrix=matrix.reshape(len(self.id), 4 * len(_OUTPUT), -1),
            id=self.id,
            strain=strain,
        )

    def take(self, which: Int64) -> "Ring":
        """Some of the elements."""
        names = ("id", "dof", "section", "turn", "stiffness_in_axes")
        names += ("rho", "ge", "alpha", "tref")
        return replace(self, **{name: getattr(self, name)[which] for name in names})


@dataclass(frozen=True, kw_only=True)
class RingRecovery(Recovery):
    """Components, the principal one of largest size, greatest shear, von Mises."""

    strain: bool = False

    def derive(self, linear: Float64) -> Float64:
        """(..., e, 7 p) from (..., e, 4 p)."""
        own = linear.reshape(*linear.shape[:-1], -1, 4)
        half = 0.5 if self.strain else 1.0
        none = np.zeros_like(own[..., 0])
        radial, hoop, axial, shear = np.moveaxis(own, -1, 0)
        tensor = np.stack([radial, hoop, axial, none, none, half * shear], axis=-1)
        principal = solid_principal(tensor)
        largest = np.abs(principal).argmax(axis=-1)[..., None]
        major = np.take_along_axis(principal, largest, axis=-1)
        spread = principal[..., :1] - principal[..., 2:]
        factor = 2.0 / 3.0 if self.strain else 1.0
        mises = factor * solid_von_mises(tensor)[..., None]
        columns = np.concatenate([own, major, 0.5 / half * spread, mises], axis=-1)
        return columns.reshape(*linear.shape[:-1], -1)


def read_ctriax6(deck: "Deck", points: Points) -> list[Ring]:
    """The CTRIAX6 blocks of a deck, one for each set of mid-sides.

    Raises:
        InputError: grids off the x-z plane or left of the axis, sections without area,
            materials of other kinds; all of them.
    """
    rows = table(deck, "CTRIAX6").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    grids = rows[[f"g{k}" for k in range(1, 7)]].to_numpy(np.int64)
    materials = ring_materials(deck)
    blocks, problems = [], Problems()
    patterns, which = np.unique(grids > 0, axis=0, return_inverse=True)
    for k, there in enumerate(patterns):
        own = np.flatnonzero(which.ravel() == k)
        part = rows.iloc[own].reset_index(drop=True)
        with problems.gathered():
            blocks.append(_block(points, part, grids[own], there, materials))
    problems.report()
    return blocks


def _block(
    points: Points,
    rows: pd.DataFrame,
    grids: Int64,
    there: npt.NDArray[np.bool_],
    materials: dict[int, RingMaterial],
) -> Ring:
    at = points.rows(grids[:, _ordered(there)])
    xyz = points.xyz[at]
    section = np.zeros((len(rows), 6, 2))
    section[:, _ordered(there)] = xyz[:, :, [0, 2]]
    size = np.ptp(section[:, _CORNERS], axis=1).max(axis=1)
    _, slope = shapes(product_penta(7, 1).points[:, :2], there)
    jacobian = np.linalg.det(np.einsum("qbn,ena->eqba", slope, section))
    turned = np.abs(jacobian.sum(axis=1)) < (1.0 - 1e-9) * np.abs(jacobian).sum(axis=1)
    flat = np.abs(jacobian).max(axis=1) <= 1e-9 * size**2
    problems = Problems()
    for bad, text in (
        (
            np.abs(xyz[:, :, 1]).max(axis=1) > _PLANE * size,
            "a grid lies off the x-z plane",
        ),
        (xyz[:, :, 0].min(axis=1) < -_PLANE * size, "a grid has a radius (x) below 0"),
        (flat | turned, "its section has no area, or is turned inside out"),
    ):
        problems += [
            f"{where('CTRIAX6', rows.iloc[k])}: {text}; expected a triangle in the x-z "
            "plane of the basic frame with x >= 0, corner, mid-side, corner, ..."
            for k in np.flatnonzero(bad)[:10]
        ]
    problems.report()
    found = [materials[int(mid)] for mid in rows["mid"]]
    angle = np.radians(rows["th"].to_numpy(float))
    return Ring(
        card="CTRIAX6",
        id=rows["eid"].to_numpy(np.int64),
        dof=(6 * at[:, :, None] + np.arange(3)).reshape(len(rows), -1),
        section=section,
        there=there,
        turn=_turn(angle),
        stiffness_in_axes=np.stack([m.elasticity for m in found]),
        rho=np.array([m.rho for m in found]),
        ge=np.array([m.ge for m in found]),
        alpha=np.stack([m.alpha for m in found]),
        tref=np.array([m.tref for m in found]),
    )


def _ordered(there: npt.NDArray[np.bool_]) -> list[int]:
    """Grids that there are, the corners first."""
    return [k for k in (*_CORNERS, 1, 3, 5) if there[k]]


def _turn(angle: Float64) -> Float64:
    """(e, 4, 4) strains in axes turned from x towards z by angles (e,), radians."""
    c, s = np.cos(angle), np.sin(angle)
    turn = np.zeros((len(angle), 4, 4))
    turn[:, 1, 1] = 1.0
    turn[:, 0, 0] = turn[:, 2, 2] = c * c
    turn[:, 0, 2] = turn[:, 2, 0] = s * s
    turn[:, 0, 3], turn[:, 2, 3] = c * s, -c * s
    turn[:, 3, 0], turn[:, 3, 2] = -2.0 * c * s, 2.0 * c * s
    turn[:, 3, 3] = c * c - s * s
    return turn
