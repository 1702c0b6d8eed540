"""Membrane strain and curvature of CQUAD8 and CTRIA6, as MSC Nastran assumes them.

Each node has the normal d of its element; a point at height z above the surface moves
by u + z b with b = theta x d. With base vectors a_k = x,k and the interpolated normal n
the covariant strains are

    e_kl  = (a_k . u,l + a_l . u,k) / 2
    k_kl  = (a_k . b,l + a_l . b,k + n,k . u,l + n,l . u,k) / 2
    2 e_k3 = a_k . b + n . u,k

and, measured in the lengths of the surface at height z, curvatures are less by what the
bent surface makes of the membrane strain. Rigid motions leave all of them zero on any
shape.

Quadrilaterals filter them between 2 x 2 points: with the part P that is bilinear
through these, of the rest (what varies more than bilinearly) direct membrane strains
keep a half, membrane shear none, direct curvatures all and the twist double: of a
deflection x^3 y half of the twist is missing in the interpolation. The split is made
in the axes of the center, so that uniform strains remain; of a bent element the rest is
that of its projection on the plane there, for the membrane (MSC's was found on plane
elements; what it does to bent ones is not known). Triangles take theirs as they are, at
three points.

A mid-side that is left out lies in the middle of its edge, which bends like a cubic
with the slopes of its ends. The middle of a quadrilateral follows its nodes such that
any quadratic deflection of a plane element with straight sides is met (MacNeal and
Harder, Eight nodes or nine?, IJNME 33, 1992, from memory); on parallelograms this is
the interpolation of eight nodes.

The factors of the filter are those that reproduce MSC Nastran's grid point forces,
moments and deflections of squares, a rectangle and half squares, with and without
mid-sides (single precision).
"""

from collections.abc import Sequence

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.quadratic_surface import (
    Base,
    Surface,
    base,
    cartesian,
    fitted,
    turned,
)
from fem.elements.shells.shell_geometry import unit

_PAIRS = ((0, 0), (1, 1), (0, 1))  # of natural directions: strains 11, 22, 2 x 12
# Of what varies more than bilinearly: e_xx e_yy e_xy, k_xx k_yy k_xy.
_KEPT = np.array([0.5, 0.5, 0.0, 1.0, 1.0, 2.0])


def middle_weights(surface: Surface, x: Float64) -> Float64:
    """(e, n) values of the middle from those of all n nodes of quadrilaterals.

    Args:
        surface: of eight nodes.
        x: (e, n, 3) these.
    """
    plain = surface.values(np.zeros((1, 2)))
    at = base(surface, x, np.zeros((1, 2)))
    plane = (x - plain @ x) @ at.axes[:, 0].swapaxes(1, 2)
    size = np.abs(plane).max(axis=(1, 2), keepdims=True)
    r, s = np.moveaxis(plane / size, -1, 0)
    fields = np.stack([np.ones_like(r), r, s, r * r, r * s, s * s], axis=1)
    missing = np.eye(6)[0] - np.einsum("efn,n->ef", fields, plain[0])
    more = np.linalg.pinv(fields, rcond=1e-10) @ missing[..., None]
    return plain + more[..., 0]


def covariant(
    surface: Surface, x: Float64, d: Float64, p: Float64, k: int, m: int
) -> tuple[Float64, Float64]:
    """(e, q, 6 n) membrane strain and curvature; engineering shear for k != m.

    Of u and theta of the nodes x (e, n, 3) with normals d at natural points (q, 2).
    """
    slope = surface.slopes(p)
    a, n = slope @ x[:, None], slope @ d[:, None]

    def both(vector: Float64) -> Float64:
        part = slope[:, m, :, None] * vector[:, :, k, None]
        if k == m:
            return part
        return part + slope[:, k, :, None] * vector[:, :, m, None]

    zero = np.zeros((*a.shape[:2], slope.shape[2], 3))
    stretch = both(a)
    return of_nodes(d, stretch, zero), of_nodes(d, both(n), stretch)


def of_nodes(d: Float64, of_u: Float64, of_b: Float64) -> Float64:
    """(..., 6 n) from operators (e, s, n, 3) on u and on b = theta x d."""
    # w . (theta x d) = theta . (d x w)
    of_turn = np.cross(d[:, None], of_b)
    return np.stack([of_u, of_turn], axis=-2).reshape(*of_u.shape[:2], -1)


def covariant_shear(surface: Surface, x: Float64, d: Float64, p: Float64) -> Float64:
    """(e, q, 2, 6 n) engineering shear with the normal, natural directions."""
    value, slope = surface.values(p), surface.slopes(p)
    along, n = slope @ x[:, None], value @ d
    parts = [
        of_nodes(
            d,
            slope[:, k, :, None] * n[:, :, None],
            value[..., None] * along[:, :, k, None],
        )
        for k in (0, 1)
    ]
    return np.stack(parts, axis=2)


def plane_strain(surface: Surface, x: Float64, d: Float64, p: Float64) -> Float64:
    """(e, q, 6, 6 n) membrane strain and curvature in element axes at points."""
    at = base(surface, x, p)
    parts = [covariant(surface, x, d, p, k, m) for k, m in _PAIRS]
    stretch, curvature = (
        cartesian(at.gradient) @ np.stack(part, axis=2) for part in zip(*parts)
    )
    return np.concatenate(
        [stretch, curvature - _grown(_bend(surface, d, p, at)) @ stretch], axis=2
    )


def _bend(surface: Surface, d: Float64, p: Float64, at: Base) -> Float64:
    """(e, q, 2, 2) d n_j / d x_i at [i, j] of the surface itself, element axes."""
    slope = surface.slopes(p) @ d[:, None]
    return at.gradient @ np.einsum("eqki,eqji->eqkj", slope, at.axes)


def _grown(bend: Float64) -> Float64:
    """(e, q, 3, 3) curvature in membrane strain that is none.

    Lengths grow with the height z over a bent surface: of the strain (e + z k) that is
    measured in those of the surface, e bend^T + bend e are no curvature.
    """
    (xx, xy), (yx, yy) = np.moveaxis(bend, (-2, -1), (0, 1))
    zero = np.zeros_like(xx)
    rows = [[2.0 * xx, zero, xy], [zero, 2.0 * yy, yx], [2.0 * yx, 2.0 * xy, xx + yy]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def assumed_strain(surface: Surface, x: Float64, d: Float64) -> Float64:
    """(e, r, 6, 6 n) in element axes at the points of the rule of the stiffness."""
    if not len(surface.reduced):
        return plane_strain(surface, x, d, surface.rule)
    center = base(surface, x, np.zeros((1, 2)))
    bilinear, rest = _split(surface, x, d, center)
    rest[:, :, :3] = _in_plane(surface, x, center)
    back = turned(center, base(surface, x, surface.rule))[:, :, 0, :6, :6]
    return back @ (bilinear + _KEPT[:, None] * rest)


def _in_center(
    surface: Surface, x: Float64, d: Float64, p: Float64, center: Base
) -> Float64:
    """(e, q, 6, 6 n) `plane_strain` in the axes of the center."""
    turn = turned(base(surface, x, p), center)[:, 0, :, :6, :6]
    return turn @ plane_strain(surface, x, d, p)


def _split(
    surface: Surface, x: Float64, d: Float64, center: Base
) -> tuple[Float64, Float64]:
    """(e, r, 6, 6 n) bilinear between the reduced points, and the rest."""
    fit = fitted(surface.printed, surface.reduced, surface.rule)
    part = _in_center(surface, x, d, surface.reduced, center)
    part = np.einsum("rg,egsn->ersn", fit, part)
    return part, _in_center(surface, x, d, surface.rule, center) - part


def _in_plane(surface: Surface, x: Float64, center: Base) -> Float64:
    """(e, r, 3, 6 n) the rest of the membrane, projected on the plane of the center.

    On the plane a deflection does not stretch: bent elements would lock. Rigid motions
    of the bent element, which strain the plane one, are taken out.
    """
    normal = center.normal
    height = (x - surface.values(np.zeros((1, 2))) @ x) @ normal.swapaxes(1, 2)
    flat = x - height * normal
    _, rest = _split(surface, flat, np.broadcast_to(normal, x.shape), center)
    e, n, _ = x.shape
    rest = rest[:, :, :3].reshape(e, -1, 3, n, 2, 3).copy()
    rigid = np.zeros((e, n, 3, 2, 3))
    rigid[:, :, :, 0] = np.eye(3)
    arm = x - x.mean(axis=1, keepdims=True)
    rigid[:, :, :, 1] = np.cross(np.eye(3), arm[:, :, None]).swapaxes(2, 3)
    rigid = rigid.reshape(e, 1, 3 * n, 6)
    of_u = rest[..., 0, :]
    stray = (of_u.reshape(e, -1, 3, 3 * n) @ rigid) @ np.linalg.pinv(rigid)
    rest[..., 0, :] = of_u - stray.reshape(of_u.shape)
    return rest.reshape(e, -1, 3, 6 * n)


def from_grids(
    surface: Surface, x: Float64, d: Float64, height: Float64, middle: Float64
) -> Float64:
    """(e, 6 w, 6 n) u and theta of all nodes of the strains from those of the grids.

    Args:
        surface: with the grids that are there.
        x, d: (e, w, 3) nodes of `surface.complete` and their normals.
        height: (e, n, 3) of the surface above the grids.
        middle: (e, k) how the middle of quadrilaterals follows the other k nodes.
    """
    whole = surface.nodes if surface.whole is None else surface.whole
    count, present = len(whole), len(surface.nodes)
    follow = np.eye(count) if surface.follow is None else surface.follow
    e = len(x)
    matrix = np.zeros((e, count, 2, 3, present, 2, 3))
    for half in (0, 1):
        matrix[:, :, half, :, :, half] = np.einsum("wn,ij->winj", follow, np.eye(3))
    at = {node: k for k, node in enumerate(np.argmax(follow == 1.0, axis=0))}
    for k in sorted(surface.straight):
        ends = (at[k], at[(k + 1) % surface.corners])
        step = x[:, (k + 1) % surface.corners] - x[:, k]
        _bend_edge(
            matrix[:, surface.corners + k], step, d[:, surface.corners + k], ends
        )
    matrix = matrix.reshape(e, 6 * count, 6 * present)
    raised = np.zeros((e, present, 6, present, 6))
    i = np.arange(present)
    raised[:, i, :, i] = np.eye(6)
    # u + theta x height
    spin = np.cross(np.eye(3), height[:, :, None]).transpose(0, 1, 3, 2)
    raised[:, i, :3, i, 3:] = spin.transpose(1, 0, 2, 3)
    matrix = matrix @ raised.reshape(e, 6 * present, 6 * present)
    if surface.even:
        nodes = matrix.reshape(e, count, 6, -1)
        inside = np.einsum("en,encm->ecm", middle, nodes)
        matrix = np.concatenate([matrix, inside], axis=1)
    return matrix


def _bend_edge(
    rows: Float64, step: Float64, normal: Float64, ends: Sequence[int]
) -> None:
    """Add what bending along an edge does to its middle, in place.

    Args:
        rows: (e, 2, 3, n, 2, 3) u and theta of the middle, means of the ends.
        step: (e, 3) from the first end to the second.
        normal: (e, 3) of the surface.
        ends: their places among the grids.
    """
    length = np.linalg.norm(step, axis=1)[:, None, None]
    across = unit(np.cross(normal, step))
    lift = np.einsum("ei,ej->eij", normal, across) * length / 8.0
    turn = np.einsum("ei,ej->eij", across, across)
    tilt = np.einsum("ei,ej->eij", across, normal) * 1.5 / length
    for end, sign in zip(ends, (-1.0, 1.0)):
        rows[:, 0, :, end, 1] += sign * lift
        rows[:, 1, :, end, 0] -= sign * tilt
        rows[:, 1, :, end, 1] -= 0.75 * turn
