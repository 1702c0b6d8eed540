"""CSHEAR: Garvey's shear panel, with extensional rods along its sides.

Forces act along the sides only; at each corner they add up to a force along the
diagonal. Equilibrium fixes them up to one number, the mean shear flow of side 1-2. Its
flexibility is Garvey's (NASTRAN Theoretical Manual, section 5.3): parallelograms,
trapezoids (sides within 1 % of parallel) and general quadrilaterals. A warped panel
keeps its forces along the diagonals, in equilibrium. PSHEAR F1 and F2 give the sides
extensional areas: F T PA / (l + l') of opposite sides, F T^2 / 2 where F exceeds 1.01.
"""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.records.shells import PANEL_FORCE, PANEL_STRESS
from fem.deck.references import column, refer, table, where
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock, some
from fem.elements.preload import tension_across
from fem.elements.shells.convex import bad_facets
from fem.elements.shells.shell_geometry import facet
from fem.errors import InputError
from fem.geometry.points import Points, grid_freedoms
from fem.properties.materials import Isotropic, isotropic

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_SIDES = ((0, 1), (1, 2), (2, 3), (3, 0))
_PARALLEL = 0.01


@dataclass(frozen=True, kw_only=True)
class PanelShape:
    """Garvey's panel in its plane.

    Attributes:
        p: (e, 4) distances of the corners that rule the shear flow.
        flexibility: (e,) Z G t, area times a shape factor over two.
        corner: (e, 4) force along the diagonal at each corner per unit of mean shear
            flow on side 1-2, towards the opposite corner.
        side: (e, 4) lengths of the sides in the mean plane.
        warp: (e,) height of corner 2 above corner 1.
    """

    p: Float64
    flexibility: Float64
    corner: Float64
    side: Float64
    warp: Float64


def panel_shape(corners: Float64, nu: Float64) -> PanelShape:
    """Distances, flexibility and corner forces of panels (e, 4, 3)."""
    flat = facet(corners)
    xy = _along_first_side(flat.xy)
    p, factor = _garvey(xy, nu, flat.area)
    first, second = xy[:, 2] - xy[:, 0], xy[:, 3] - xy[:, 1]

    def twice(i: int, j: int, k: int) -> Float64:
        a, b = xy[:, j] - xy[:, i], xy[:, k] - xy[:, i]
        return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]

    one = 0.5 * np.linalg.norm(first, axis=1) * twice(0, 1, 3) / twice(0, 2, 3)
    two = -0.5 * np.linalg.norm(second, axis=1) * twice(0, 1, 2) / twice(1, 2, 3)
    side = np.linalg.norm(np.roll(xy, -1, axis=1) - xy, axis=2)
    return PanelShape(
        p=p,
        flexibility=0.5 * p[:, 0] * p[:, 1] / (p[:, 2] * p[:, 3]) * factor,
        corner=np.stack([one, two, -one, -two], axis=1),
        side=side,
        warp=-2.0 * flat.warp,
    )


def _along_first_side(xy: Float64) -> Float64:
    """(e, 4, 2) corners with the first as origin and side 1-2 as x axis."""
    shifted = xy - xy[:, :1]
    x = shifted[:, 1] / np.linalg.norm(shifted[:, 1], axis=1, keepdims=True)
    y = np.stack([-x[:, 1], x[:, 0]], axis=1)
    return np.stack([np.einsum("eni,ei->en", shifted, axis) for axis in (x, y)], axis=2)


def _garvey(xy: Float64, nu: Float64, area: Float64) -> tuple[Float64, Float64]:
    """(e, 4) distances p and (e,) areas that carry the shape factor."""
    x2 = xy[:, 1, 0]
    x3, y3 = xy[:, 2].T
    x4, y4 = xy[:, 3].T
    lower = np.abs(y3 - y4) < _PARALLEL * np.abs(x3 - x4)
    upright = np.abs(y4 * (x3 - x2) - y3 * x4) < _PARALLEL * np.abs(
        x4 * (x3 - x2) + y4 * y3
    )
    p, factor = np.empty((len(xy), 4)), np.empty(len(xy))
    for chosen, form in (
        (lower & upright, _parallelogram),
        (lower & ~upright, _sides_12_34),
        (~lower & upright, _sides_14_23),
        (~lower & ~upright, _general),
    ):
        if chosen.any():
            p[chosen], factor[chosen] = form(xy[chosen], nu[chosen], area[chosen])
    return p, factor


Form = tuple[Float64, Float64]


def _parallelogram(xy: Float64, nu: Float64, area: Float64) -> Form:
    """Factor 1 + 2 d^2 / (1 + nu), d the cotangent of the angle between the sides."""
    x2 = xy[:, 1, 0]
    (x3, y3), (x4, y4) = xy[:, 2].T, xy[:, 3].T
    d = -0.5 * (x4 / y4 + (x3 - x2) / y3 + (y3 - y4) / (x3 - x4))
    return np.ones((len(xy), 4)), area * (1.0 + 2.0 * d * d / (1.0 + nu))


def _sides_12_34(xy: Float64, nu: Float64, area: Float64) -> Form:
    """Sides 1-2 and 3-4 parallel: p is the height below the meeting point."""
    x2 = xy[:, 1, 0]
    (x3, y3), (x4, y4) = xy[:, 2].T, xy[:, 3].T
    down = y3 * x4 - y4 * (x3 - x2)
    height, at = x2 * y3 * y4 / down, x2 * y3 * x4 / down
    p = height[:, None] - xy[:, :, 1]
    a, c = (x2 - at) / height, -at / height
    shape = 1.0 + 2.0 / 3.0 / (1.0 + nu) * (a * a + a * c + c * c)
    return p, area * shape


def _sides_14_23(xy: Float64, nu: Float64, area: Float64) -> Form:
    """Sides 1-4 and 2-3 parallel."""
    x2 = xy[:, 1, 0]
    (x3, y3), (x4, y4) = xy[:, 2].T, xy[:, 3].T
    d = -0.5 * (x4 / y4 + (x3 - x2) / y3)
    at = x4 - y4 * (x3 - x4) / (y3 - y4)
    scale = 1.0 / np.sqrt(1.0 + d * d)
    p = (at[:, None] - xy[:, :, 0] - d[:, None] * xy[:, :, 1]) * scale[:, None]
    beyond = at - x4
    b = (beyond * d + y4) / (beyond - y4 * d)
    shape = 1.0 + 2.0 / 3.0 / (1.0 + nu) * (b * b + b * d + d * d)
    return p, area * shape


def _general(xy: Float64, nu: Float64, area: Float64) -> Form:
    """No sides parallel: p is the distance from the line of the two meeting points."""
    x2 = xy[:, 1, 0]
    (x3, y3), (x4, y4) = xy[:, 2].T, xy[:, 3].T
    down = y3 * x4 - y4 * (x3 - x2)
    first = x4 - (x3 - x4) / (y3 - y4) * y4
    second, height = x2 * y3 * x4 / down, x2 * y3 * y4 / down
    length = np.hypot(first - second, height)
    d = (first - second) / height
    p = (first[:, None] - xy[:, :, 0] - d[:, None] * xy[:, :, 1]) * (height / length)[
        :, None
    ]
    c = length / p[:, 0] - d
    b, a = length / p[:, 3] - c, length / p[:, 1] - d

    def term(u: Float64, v: Float64) -> Float64:
        odd = u + v + 2.0 / 3.0 * (u**3 + v**3) + 0.2 * (u**5 + v**5)
        return odd * np.log(np.abs(u + v))

    inner = (
        term(a, b)
        + term(c, d)
        - term(b, c)
        - term(d, a)
        + 0.1 * ((a**2 - c**2) * (b**3 - d**3) + (b**2 - d**2) * (a**3 - c**3))
        - 0.2 * ((a - c) * (b**4 - d**4) + (b - d) * (a**4 - c**4))
    )
    inner *= 0.5 * p.prod(axis=1) / length**2
    return p, area + 4.0 / (1.0 + nu) * (inner - 2.0 / 3.0 * area)


@dataclass(frozen=True, kw_only=True)
class ShearPanel(DenseBlock):
    """All CSHEAR elements; 12 freedoms, basic axes.

    Attributes:
        pid: (e,) property ids.
        corners: (e, 4, 3) grids in the basic frame.
        thickness, nsm: (e,) T and non-structural mass per area.
        rods: (e, 4) extensional areas of the sides.
        material: MAT1.
    """

    pid: Int64
    corners: Float64
    thickness: Float64
    nsm: Float64
    rods: Float64
    material: Isotropic
    property_card: str = "PSHEAR"

    @property
    def extent(self) -> Float64:
        """(e,) area."""
        return facet(self.corners).area

    def with_nonstructural_mass(self, per_area: Float64) -> "ShearPanel":
        """Copy with additional mass per area (e,)."""
        return replace(self, nsm=self.nsm + per_area)

    def _flow(self, shape: PanelShape) -> Float64:
        """(e, 12) mean shear flow on side 1-2 from the displacements."""
        x = self.corners
        diagonal = np.stack([x[:, 2] - x[:, 0], x[:, 3] - x[:, 1]], axis=1)
        diagonal /= np.linalg.norm(diagonal, axis=2, keepdims=True)
        operator = -shape.corner[..., None] * diagonal[:, [0, 1, 0, 1]]
        stiffness = self.material.g * self.thickness / (2.0 * shape.flexibility)
        return (stiffness[:, None, None] * operator).reshape(-1, 12)

    def stiffness(self) -> Float64:
        """(e, 12, 12)."""
        shape = panel_shape(self.corners, self.material.nu)
        flow = self._flow(shape)
        soft = 2.0 * shape.flexibility / (self.material.g * self.thickness)
        matrix = soft[:, None, None] * flow[:, :, None] * flow[:, None, :]
        if self.rods.any():
            matrix += self._extension()
        return matrix

    def differential_stiffness(
        self, motion: Float64, load: Float64 | None = None
    ) -> Float64:
        """(e, 12, 12) of the forces along the diagonals and of the sides' rods.

        The corner forces are those of two bars along the diagonals: the same work as
        that of the shear flow on bilinear deflections of a rectangle.
        """
        shape = panel_shape(self.corners, self.material.nu)
        flow = np.einsum("ei,ei->e", self._flow(shape), motion)
        moved = motion.reshape(-1, 4, 3)
        matrix = np.zeros((len(self.id), 4, 3, 4, 3))
        lines = [((0, 2), None), ((1, 3), None)]
        lines += [(side, self.rods[:, k]) for k, side in enumerate(_SIDES)]
        for (i, j), area in lines:
            between = self.corners[:, j] - self.corners[:, i]
            length = np.linalg.norm(between, axis=1)
            axis = between / length[:, None]
            if area is None:
                tension = flow * shape.corner[:, i]
            else:
                stretch = np.einsum("ei,ei->e", axis, moved[:, j] - moved[:, i])
                tension = self.material.e * area * stretch / length
            part = tension_across(axis, tension / length).reshape(-1, 2, 3, 2, 3)
            for a, p in enumerate((i, j)):
                for b, q in enumerate((i, j)):
                    matrix[:, p, :, q] += part[:, a, :, b]
        return matrix.reshape(-1, 12, 12)

    def _extension(self) -> Float64:
        """(e, 12, 12) of the rods along the sides."""
        matrix = np.zeros((len(self.id), 4, 3, 4, 3))
        for k, (i, j) in enumerate(_SIDES):
            along = self.corners[:, j] - self.corners[:, i]
            length = np.linalg.norm(along, axis=1)
            factor = self.material.e * self.rods[:, k] / length**3
            part = factor[:, None, None] * along[:, :, None] * along[:, None, :]
            for a, b, sign in ((i, i, 1), (j, j, 1), (i, j, -1), (j, i, -1)):
                matrix[:, a, :, b] += sign * part
        return matrix.reshape(-1, 12, 12)

    def structural_damping(self) -> Float64 | None:
        """(e,) GE."""
        return some(self.material.ge)

    def mass(self, *, coupled: bool) -> Float64:
        """(e, 12, 12) a quarter at each corner; Nastran has no coupled mass for it."""
        total = (self.material.rho * self.thickness + self.nsm) * self.extent
        return 0.25 * total[:, None, None] * np.eye(12)

    def forces(self) -> Recovery:
        """Corner forces along the sides (positive: shear), kick forces, shear flows."""
        shape = panel_shape(self.corners, self.material.nu)
        flow = self._flow(shape)
        p = shape.p
        ratio = np.stack(
            [
                np.ones(len(p)),
                p[:, 0] / p[:, 2],
                p[:, 0] * p[:, 1] / (p[:, 2] * p[:, 3]),
                p[:, 1] / p[:, 3],
            ],
            axis=1,
        )
        # A warped panel's sides are longer than their shadows: the flow acts on them.
        ratio = ratio / np.sqrt(1.0 + (shape.warp[:, None] / shape.side) ** 2)
        half = 0.5 * shape.side * ratio
        lift = 0.5 * shape.warp
        rows = np.stack(
            [
                half[:, 3], half[:, 0], -half[:, 0], -half[:, 1],
                half[:, 1], half[:, 2], -half[:, 2], -half[:, 3],
                lift * (ratio[:, 0] + ratio[:, 3]), ratio[:, 0],
                lift * (ratio[:, 0] + ratio[:, 1]), ratio[:, 1],
                lift * (ratio[:, 1] + ratio[:, 2]), ratio[:, 2],
                lift * (ratio[:, 2] + ratio[:, 3]), ratio[:, 3],
            ],
            axis=1,
        )  # fmt: skip
        return Recovery(
            table=self.card,
            columns=PANEL_FORCE,
            matrix=rows[:, :, None] * flow[:, None, :],
            id=self.id,
        )

    def stresses(self) -> Recovery:
        """Largest magnitude and mean of the shear stresses at the corners."""
        shape = panel_shape(self.corners, self.material.nu)
        p = shape.p
        first, second = p[:, 0], p[:, 1]
        ratio = np.stack(
            [
                second / first,
                first / second,
                first * second / p[:, 2] ** 2,
                first * second / p[:, 3] ** 2,
            ],
            axis=1,
        )
        mean = self._flow(shape) / self.thickness[:, None]
        return PanelStress(
            table=self.card,
            columns=PANEL_STRESS,
            matrix=ratio[:, :, None] * mean[:, None, :],
            id=self.id,
        )

    def strains(self) -> Recovery:
        """Stresses over the shear modulus."""
        stress = self.stresses()
        per_modulus = 1.0 / self.material.g[:, None, None]
        return replace(stress, matrix=stress.matrix * per_modulus)


@dataclass(frozen=True, kw_only=True)
class PanelStress(Recovery):
    """Extremes of the shear stresses at the four corners."""

    def derive(self, linear: Float64) -> Float64:
        """(..., e, 2) from (..., e, 4)."""
        return np.stack([np.abs(linear).max(axis=-1), linear.mean(axis=-1)], axis=-1)


def read_cshear(deck: "Deck", points: Points) -> list[ShearPanel]:
    """The CSHEAR block of a deck, or none.

    Raises:
        InputError: undefined references, no thickness, corners that do not make a
            convex panel; all of them.
    """
    rows = table(deck, "CSHEAR").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    properties = refer(rows, "CSHEAR", "pid", table(deck, "PSHEAR"), "PSHEAR")
    material = isotropic(deck, properties, "PSHEAR", poisson=True)
    at = points.rows(rows[[f"g{k}" for k in range(1, 5)]].to_numpy(np.int64))
    corners = points.xyz[at]
    thickness = column(properties, "t")
    _check(rows, corners, thickness * material.g)
    side = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    area = facet(corners).area
    rods = np.empty((len(rows), 4))
    for k, name in ((0, "f1"), (1, "f2")):
        f = column(properties, name)
        share = f * thickness * area / (side[:, k] + side[:, k + 2])
        share = np.where(f > 1.01, 0.5 * f * thickness**2, share)
        rods[:, k] = rods[:, k + 2] = share
    return [
        ShearPanel(
            card="CSHEAR",
            id=rows["eid"].to_numpy(np.int64),
            dof=grid_freedoms(at, 3),
            pid=rows["pid"].to_numpy(np.int64),
            corners=corners,
            thickness=thickness,
            nsm=column(properties, "nsm"),
            rods=rods,
            material=material,
        )
    ]


def _check(rows: pd.DataFrame, corners: Float64, stiffness: Float64) -> None:
    bad, texts = bad_facets(corners)
    problems = [
        f"{where('CSHEAR', rows.iloc[i])}: {text}" for i, text in zip(bad, texts)
    ]
    problems += [
        f"{where('CSHEAR', rows.iloc[i])}: thickness times shear modulus is "
        f"{stiffness[i]:g}, expected a positive value"
        for i in np.flatnonzero(stiffness <= 0.0)
    ]
    if problems:
        raise InputError(problems)
