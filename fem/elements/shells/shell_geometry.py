"""Element axes of shells, their flat shape, and the link from grids to that shape.

A quadrilateral is flattened onto its mean plane: the normal is that of the diagonals,
the corners lie alternately h above and below. The element x axis bisects the diagonals
(Nastran's rule), that of a triangle runs along its first side. The offset (ZOFFS) is a
rigid link along the normal from each grid to its point on the flat reference surface.

Warp acts without the rotations of the grids (MacNeal 1978: forces off the plane are
balanced by forces along the normal). A corner at height z follows the mean slope of w
over the element; and where w is warped itself by w_h, alternately up and down, the
sides of the warped shape stretch: with the tangents x,1 = (j_1, z,1) its strain at the
center has the covariant parts h w_h along both natural directions. Rigid motions give
none. Under MSC's displacements the membrane forces of a foreign airframe's warped
quadrilaterals are so MSC's to 1e-4.

Where facets meet at an angle, bending moments have a part along the normal of the grid,
which nothing but the weak drilling stiffness would carry. Therefore each corner has its
own normal d (that of the grid, PARAM SNORM, or of the warped corner): the part of the
rotation along d, less the rotation of the membrane there, does not bend the element,
and the drilling stiffness (`shell_drilling`) acts about d. Under NX's displacements the
moments at the kinks of a foreign wing box balance so to 1e-4 of their parts.
"""

from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64


@dataclass(frozen=True, kw_only=True)
class Facet:
    """Flat shape of n-cornered shells, units of the deck.

    Attributes:
        axes: (e, 3, 3) rows are the element axes x, y, z in the basic frame.
        xy: (e, n, 2) corners in the element plane, about the centroid of the corners.
        offset: (e,) height of the reference surface above the grids' mean plane, z.
        warp: (e,) height h of corners 1 and 3 above the mean plane, 2 and 4 below it.
        slope: (e, n, 2) normal of the corner, x and y component over z component.
    """

    axes: Float64
    xy: Float64
    offset: Float64
    warp: Float64
    slope: Float64

    @property
    def corners(self) -> int:
        """Number of corners n."""
        return self.xy.shape[1]

    @property
    def area(self) -> Float64:
        """(e,) area of the flat shape."""
        x, y = self.xy[..., 0], self.xy[..., 1]
        return 0.5 * np.sum(
            x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y, axis=1
        )

    @property
    def edges(self) -> Float64:
        """(e, n, 2) vectors from each corner to the next."""
        return np.roll(self.xy, -1, axis=1) - self.xy


def unit(vectors: Float64) -> Float64:
    """(..., 3) of length one; zero vectors stay zero, for the quality check to name."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length == 0.0, 1.0, length)


def element_normals(corners: Float64) -> Float64:
    """(e, 3) unit normals of triangles or quadrilaterals (e, n, 3)."""
    return unit(np.cross(*_spanning(corners)))


def corner_normals(corners: Float64) -> Float64:
    """(e, n, 3) unit normals of the two edges that meet in each corner.

    That of the element where the edges are in line.
    """
    edge = np.roll(corners, -1, axis=1) - corners
    own = unit(np.cross(np.roll(edge, 1, axis=1), edge))
    straight = ~own.any(axis=2, keepdims=True)
    return np.where(straight, element_normals(corners)[:, None], own)


def _spanning(corners: Float64) -> tuple[Float64, Float64]:
    if corners.shape[1] == 4:
        return corners[:, 1] - corners[:, 3], corners[:, 2] - corners[:, 0]
    return corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]


def facet(
    corners: Float64, offset: Float64 | None = None, normals: Float64 | None = None
) -> Facet:
    """Element axes and flat shape of triangles or quadrilaterals.

    Args:
        corners: (e, n, 3) grids in the basic frame, n 3 or 4.
        offset: (e,) ZOFFS, the surface above the grids along the element z axis.
        normals: (e, n, 3) normals at the grids, basic frame, zero where a grid has
            none; the corner's own is taken there.
    """
    first, second = _spanning(corners)
    z = unit(np.cross(first, second))
    x = unit(unit(first) + unit(second)) if corners.shape[1] == 4 else unit(first)
    axes = np.stack([x, np.cross(z, x), z], axis=1)
    local = (corners - corners.mean(axis=1, keepdims=True)) @ axes.transpose(0, 2, 1)
    above = np.zeros(len(corners)) if offset is None else offset
    return Facet(
        axes=axes,
        xy=local[..., :2],
        offset=above,
        warp=local[:, 0, 2] if corners.shape[1] == 4 else np.zeros(len(corners)),
        slope=_slopes(corners, axes, normals),
    )


def _slopes(corners: Float64, axes: Float64, normals: Float64 | None) -> Float64:
    """(e, n, 2) slopes of the corner normals against the element's z axis."""
    own = corner_normals(corners)
    if normals is not None:
        own = np.where(normals.any(axis=2)[..., None], normals, own)
    local = own @ axes.transpose(0, 2, 1)
    upright = np.abs(local[..., 2:]) > 0.5
    slope = local[..., :2] / np.where(upright, local[..., 2:], 1.0)
    # Below rounding of the coordinates a facet is flat.
    return np.where(upright & (np.abs(slope) > 1e-12), slope, 0.0)


def to_grids(local: Float64, shape: Facet) -> Float64:
    """Columns of an operator turned from flat local to grid freedoms, basic axes.

    Args:
        local: (e, m, 6 n) acts on u v w rx ry rz of the flat corners, element axes.
        shape: geometry.

    Returns:
        (e, m, 6 n) acts on T1 T2 T3 R1 R2 R3 of the grids in basic axes.
    """
    e, m, _ = local.shape
    parts = local.reshape(e, m, shape.corners, 2, 3)
    force, moment = parts[..., 0, :].copy(), parts[..., 1, :].copy()
    # A point at height z above the grid moves by theta x (0, 0, z) = (z ry, -z rx, 0).
    moment[..., 1] += force[..., 0] * shape.offset[:, None, None]
    moment[..., 0] -= force[..., 1] * shape.offset[:, None, None]
    if shape.slope.any():
        # rx and ry become rx - s_x (rz - spin), ry - s_y (rz - spin).
        spun = np.einsum("emnk,enk->emn", moment[..., :2], shape.slope)
        moment[..., 2] -= spun
        spin = corner_spin(corner_gradients(shape))
        force[..., :2] += (spun @ spin.reshape(*spin.shape[:2], -1)).reshape(
            *spun.shape, 2
        )
    if shape.warp.any():
        force[..., 2] += np.einsum("emia,eiak->emk", force[..., :2], _warping(shape))
    turned = np.stack([force, moment], axis=-2).reshape(e, -1, 3) @ shape.axes
    return turned.reshape(e, m, -1)


def corner_gradients(shape: Facet) -> Float64:
    """(e, n, 2, n) derivatives in x and y of the shape functions at each corner.

    They follow from the differences to both neighbours.
    """
    n = shape.corners
    after = shape.edges
    before = np.roll(after, 1, axis=1)
    inverse = np.linalg.inv(np.stack([after, -before], axis=2))
    corner = np.arange(n)
    gradients = np.zeros((len(after), n, 2, n))
    for k, neighbour in enumerate((np.roll(corner, -1), np.roll(corner, 1))):
        part = inverse[..., k]
        gradients[:, corner, :, neighbour] += part.transpose(1, 0, 2)
        gradients[:, corner, :, corner] -= part.transpose(1, 0, 2)
    return gradients


def corner_spin(gradients: Float64) -> Float64:
    """(e, n, n, 2) rotations (v,x - u,y) / 2 of the membrane at corners from (u, v)."""
    return 0.5 * np.stack([-gradients[:, :, 1], gradients[:, :, 0]], axis=3)


def center_gradient(shape: Facet) -> Float64:
    """(e, 2, n) derivatives in x and y of the shape functions at the center."""
    x = shape.xy
    # Of both shapes: dN/dx = (y_next - y_previous) / 2A, dN/dy = -(x_next - ...) / 2A.
    across = np.roll(x, -1, axis=1) - np.roll(x, 1, axis=1)
    return (
        np.stack([across[..., 1], -across[..., 0]], axis=1)
        / (2.0 * shape.area)[:, None, None]
    )


def natural_vectors(shape: Facet) -> Float64:
    """(e, 2, 2) derivatives of (x, y) along xi and eta at the center (rows)."""
    x = shape.xy
    return 0.25 * np.stack(
        [x[:, 1] + x[:, 2] - x[:, 0] - x[:, 3], x[:, 2] + x[:, 3] - x[:, 0] - x[:, 1]],
        axis=1,
    )


def _warping(shape: Facet) -> Float64:
    """(e, 4, 2, 4) displacement (u, v) of the flat corners from w of the grids.

    z_i grad w, and the uniform strain h w_h J^-1 J^-T times the place of the corner,
    with w_h the part of w that no linear field has.
    """
    sign = np.array([1.0, -1.0, 1.0, -1.0])
    gradient, height = center_gradient(shape), shape.warp[:, None, None, None]
    rotation = sign[:, None, None] * gradient[:, None]
    hourglass = 0.25 * (sign - (sign @ shape.xy)[:, None] @ gradient)[:, 0]
    inverse = np.linalg.inv(natural_vectors(shape))
    stretched = shape.xy @ (inverse @ inverse.transpose(0, 2, 1))
    return height * (rotation + stretched[..., None] * hourglass[:, None, None])


def matrix_to_grids(local: Float64, shape: Facet) -> Float64:
    """(e, 6 n, 6 n) element matrix turned on both sides, see `to_grids`."""
    half = to_grids(local, shape).transpose(0, 2, 1)
    return to_grids(half, shape)
