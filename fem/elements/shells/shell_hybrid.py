"""Membrane and bending of shells: hybrid quadrilateral, linear triangle.

The quadrilateral assumes the resultants of Pian and Sumihara (1984), for the membrane
and likewise for bending: uniform ones, and one linear along each natural direction.
With compatible linear displacements and rotations it is exact for uniform states on any
shape (patch test) and for bending of rectangles in their plane. Laminates couple both
through their compliance [A B; B D]^-1.

The linear resultants know no shear in their plane (Nastran takes it at the center), and
the strain across is what it would be in a membrane that is free there: -A_12 / A_22 of
the strain along, in bending too, as the displacements and the rotations have one set of
shape functions. Of isotropic sheets the compliance says the same; of laminates, where
it would free shear and curvature as well, the forces on rectangles are so those of MSC
and NX Nastran to seven digits.
"""

from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.shell_geometry import Facet, natural_vectors
from fem.properties.shell_section import ShellSection, line_strain

_GAUSS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / np.sqrt(3.0)
_CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])


@dataclass(frozen=True, kw_only=True)
class InPlane:
    """Membrane and bending in the freedoms [u v ..., bx by ...] of `n` corners.

    Attributes:
        reduced: (e, 4 n, 4 n) stiffness.
        modes: (e, b, 4 n) amplitudes of the assumed resultants.
        at: (e, p, 6, b) resultants N (xx yy xy) and M of unit amplitudes at p points:
            the center of the area, then for quadrilaterals the corners.
    """

    reduced: Float64
    modes: Float64
    at: Float64

    def stiffness(self) -> Float64:
        """(e, 6 n, 6 n) in flat local freedoms."""
        half = scatter(self.reduced).transpose(0, 2, 1)
        return scatter(half)

    def resultant(self, *, corner: bool) -> Float64:
        """(e, p, 6, 6 n) N and M from flat local freedoms; p 1, or all points."""
        at = self.at if corner else self.at[:, :1]
        e, p = at.shape[:2]
        found = scatter((at @ self.modes[:, None]).reshape(e, p * 6, -1))
        return found.reshape(e, p, 6, -1)


def in_plane(
    shape: Facet, section: ShellSection, *, free_across: bool = True
) -> InPlane:
    """Membrane and bending of triangles or quadrilaterals.

    Args:
        shape: geometry.
        section: of the elements.
        free_across: what bends linearly along one direction is free across it; else it
            has no strain there (bending of CQUADR).
    """
    if shape.corners == 3:
        return _triangle(shape, section)
    return _quadrilateral(shape, section, free_across)


def scatter(operator: Float64) -> Float64:
    """(e, m, 6 n) flat local freedoms from (e, m, 4 n) [u v ..., bx by ...].

    The director turns by b = (ry, -rx).
    """
    e, m, width = operator.shape
    n = width // 4
    full = np.zeros((e, m, n, 6))
    full[..., 0:2] = operator[..., : 2 * n].reshape(e, m, n, 2)
    bend = operator[..., 2 * n :].reshape(e, m, n, 2)
    full[..., 4] = bend[..., 0]
    full[..., 3] = -bend[..., 1]
    return full.reshape(e, m, 6 * n)


def plane_strain_operator(gradient: Float64) -> Float64:
    """(..., 3, 2 n) strains xx yy xy from nodal (u, v); gradient (..., 2, n)."""
    n = gradient.shape[-1]
    operator = np.zeros((*gradient.shape[:-2], 3, n, 2))
    operator[..., 0, :, 0] = operator[..., 2, :, 1] = gradient[..., 0, :]
    operator[..., 1, :, 1] = operator[..., 2, :, 0] = gradient[..., 1, :]
    return operator.reshape(*gradient.shape[:-2], 3, 2 * n)


def _joined(section: ShellSection) -> tuple[Float64, Float64]:
    """(e, 6, 6) [A B; B D] and the mask (e, 6) of resultants that exist.

    Absent parts (blank MID1 or MID2) get a unit diagonal so that the compliance exists;
    their rows are dropped afterwards.
    """
    joined = np.concatenate(
        [
            np.concatenate([section.membrane, section.coupling], axis=2),
            np.concatenate([section.coupling, section.bending], axis=2),
        ],
        axis=1,
    )
    there = np.repeat(
        np.stack(
            [
                np.einsum("eii->e", part) > 0.0
                for part in (section.membrane, section.bending)
            ],
            axis=1,
        ),
        3,
        axis=1,
    )
    joined = joined * there[:, :, None] * there[:, None, :]
    joined[:, np.arange(6), np.arange(6)] += ~there
    return joined, there


def _compliance(joined: Float64) -> Float64:
    """(e, 6, 6) inverse of [A B; B D], finite also without stiffness in a direction."""
    stiff = np.einsum("eii->ei", joined).reshape(len(joined), 2, -1)
    largest = stiff.max(axis=2, keepdims=True)
    floor = np.where(largest > 0.0, 1e-9 * largest, 1.0)
    scale = np.sqrt(np.maximum(stiff, floor)).reshape(len(joined), -1)
    scaled = joined / (scale[:, :, None] * scale[:, None, :])
    # A material without stiffness in a direction (MAT2) has no finite compliance.
    value = np.linalg.eigvalsh(scaled)
    scaled[value[:, 0] < 1e-12 * value[:, -1]] += 1e-9 * np.eye(joined.shape[-1])
    return np.linalg.inv(scaled) / (scale[:, :, None] * scale[:, None, :])


def _line_compliance(
    joined: Float64, there: Float64, along: Float64, free_across: bool
) -> Float64:
    """(e, 2, 2) of linear resultants N and M along unit vectors (e, 2)."""
    strain = line_strain(along)
    across = line_strain(np.stack([-along[:, 1], along[:, 0]], axis=1))
    parts = [joined[:, i : i + 3, j : j + 3] for i in (0, 3) for j in (0, 3)]
    plane = np.where(there[:, :1, None], parts[0], parts[3])
    square = np.einsum("ei,eij,ej->e", across, plane, across)
    free = np.einsum("ei,eij,ej->e", strain, plane, across)
    free = np.where(square > 0.0, free / np.where(square > 0.0, square, 1.0), 0.0)
    if free_across:
        strain = strain - free[:, None] * across
    stiffness = [np.einsum("ei,eij,ej->e", strain, part, strain) for part in parts]
    return _compliance(np.stack(stiffness, axis=1).reshape(-1, 2, 2))


def _of_thickness(compliance: Float64, section: ShellSection) -> Float64:
    """(e, q, 2 m, 2 m) at the Gauss points (q 1 or 4) from (e, 2 m, 2 m)."""
    if section.taper is None:
        return compliance[:, None]
    bilinear = (
        0.25
        * (1 + np.outer(_GAUSS[:, 0], _CORNERS[:, 0]))
        * (1 + np.outer(_GAUSS[:, 1], _CORNERS[:, 1]))
    )
    ratio = section.taper @ bilinear.T
    # A grows with t, B with t^2, D with t^3: the compliance with their inverses.
    power = np.repeat([0.5, 1.5], compliance.shape[-1] // 2)
    factor = ratio[..., None] ** -power
    return compliance[:, None] * factor[..., :, None] * factor[..., None, :]


def _quadrilateral(shape: Facet, section: ShellSection, free_across: bool) -> InPlane:
    derivative = 0.25 * np.stack(
        [
            _CORNERS[:, 0] * (1 + np.outer(_GAUSS[:, 1], _CORNERS[:, 1])),
            _CORNERS[:, 1] * (1 + np.outer(_GAUSS[:, 0], _CORNERS[:, 0])),
        ],
        axis=1,
    )
    jacobian = derivative @ shape.xy[:, None]
    weight = np.linalg.det(jacobian)
    strain = plane_strain_operator(np.linalg.inv(jacobian) @ derivative)
    center = (weight @ _GAUSS) / weight.sum(axis=1)[:, None]
    along = _natural_directions(shape)
    at_gauss = _resultant_modes(along, _GAUSS - center[:, None])
    force = np.einsum("eq,eqsb,eqsn->ebn", weight, at_gauss, strain, optimize=True)
    joined, there = _joined(section)
    flexible = _flexibility(
        at_gauss, weight, _of_thickness(_compliance(joined), section)
    )
    for k, coordinate in ((0, 1), (1, 0)):
        line = _line_compliance(joined, there, along[:, k], free_across)
        line = _of_thickness(line, section)
        square = weight * (_GAUSS[:, coordinate] - center[:, coordinate, None]) ** 2
        pair = np.array([3 + k, 8 + k])
        flexible[:, pair[:, None], pair] = np.sum(
            square[..., None, None] * line, axis=1
        )
    work = np.zeros((len(force), 10, 16))
    work[:, :5, :8] = force * there[:, None, None, 0]
    work[:, 5:, 8:] = force * there[:, None, None, 3]
    modes = np.linalg.solve(flexible, work)
    stiffness = work.transpose(0, 2, 1) @ modes
    # At the center of the area the resultants are the mean ones: Nastran's "center".
    corners = _CORNERS - center[:, None]
    points = np.concatenate([np.zeros_like(corners[:, :1]), corners], axis=1)
    points = _resultant_modes(along, points)
    at = np.zeros((*points.shape[:2], 6, 10))
    at[:, :, :3, :5] = points * there[:, None, None, :1]
    at[:, :, 3:, 5:] = points * there[:, None, None, 3:4]
    return InPlane(reduced=stiffness, modes=modes, at=at)


def _flexibility(modes: Float64, weight: Float64, compliance: Float64) -> Float64:
    """(e, 10, 10) of the amplitudes of N and M from (e, q, 6, 6) at Gauss points."""
    weighted = weight[..., None, None] * compliance
    flexible = np.zeros((len(weight), 10, 10))
    for i, j in ((0, 0), (0, 1), (1, 1)):
        part = weighted[:, :, 3 * i : 3 * i + 3, 3 * j : 3 * j + 3]
        block = (modes.transpose(0, 1, 3, 2) @ part @ modes).sum(axis=1)
        flexible[:, 5 * i : 5 * i + 5, 5 * j : 5 * j + 5] = block
        flexible[:, 5 * j : 5 * j + 5, 5 * i : 5 * i + 5] = block.transpose(0, 2, 1)
    return flexible


def _natural_directions(shape: Facet) -> Float64:
    """(e, 2, 2) unit vectors along xi and eta at the center."""
    along = natural_vectors(shape)
    return along / np.linalg.norm(along, axis=2, keepdims=True)


def _resultant_modes(along: Float64, at: Float64) -> Float64:
    """(e, p, 3, 5) assumed resultants of Pian and Sumihara.

    Args:
        along: (e, 2, 2) unit vectors along xi and eta.
        at: (e, p, 2) natural coordinates about the center of the area, so that the
            linear resultants have no mean. (Lengths divided out: the columns stay of
            order one on any mesh.)
    """
    modes = np.zeros((*at.shape[:2], 3, 5))
    modes[..., :3] = np.eye(3)
    for k, coordinate in ((0, 1), (1, 0)):
        a, b = along[:, k, 0], along[:, k, 1]
        direction = np.stack([a * a, b * b, a * b], axis=1)
        modes[..., 3 + k] = at[:, :, coordinate, None] * direction[:, None, :]
    return modes


def _triangle(shape: Facet, section: ShellSection) -> InPlane:
    edges = shape.edges
    area = shape.area
    # dN_i/dx = (y_j - y_k) / 2A = -(edge j->k)_y / 2A, dN_i/dy = (edge j->k)_x / 2A.
    opposite = np.roll(edges, -1, axis=1)
    gradient = np.stack([-opposite[..., 1], opposite[..., 0]], axis=1)
    strain = plane_strain_operator(gradient / (2.0 * area[:, None, None]))
    joined, there = _joined(section)
    joined = joined * there[:, :, None]
    double = np.zeros((len(area), 6, 12))
    double[:, :3, :6] = double[:, 3:, 6:] = strain
    if section.taper is not None:
        joined = joined * _mean_powers(section.taper)
    resultant = joined @ double
    stiffness = area[:, None, None] * (double.transpose(0, 2, 1) @ resultant)
    at = np.broadcast_to(np.eye(6), (len(area), 1, 6, 6))
    return InPlane(reduced=stiffness, modes=resultant, at=at)


def _mean_powers(taper: Float64) -> Float64:
    """(e, 6, 6) means over the triangle of t, t^2, t^3 for A, B, D (edge midpoints)."""
    middle = 0.5 * (taper + np.roll(taper, -1, axis=1))
    first, second, third = ((middle**k).mean(axis=1) for k in (1, 2, 3))
    power = np.empty((len(taper), 2, 2))
    power[:, 0, 0], power[:, 1, 1] = first, third
    power[:, 0, 1] = power[:, 1, 0] = second
    return np.kron(power, np.ones((3, 3)))
