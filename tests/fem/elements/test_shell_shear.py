"""Transverse shear of shells that are not square, and of laminates, against theory."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shell_model import Model, grid, isotropic_property, shells, triangles

from fem.elements.shells.shell_geometry import facet
from fem.elements.shells.shell_hybrid import in_plane
from fem.elements.shells.shell_shear import residual_flexibility, twist_shares
from fem.properties.laminate import Laminate
from fem.properties.shell_section import bending_along
from fem.properties.shells import ShellProperty

E = 7e10


def cross_ply(*, z0: float | None = None) -> ShellProperty:
    """0/90/90 without Poisson's effect: its neutral surface is not in the middle."""
    t = np.array([0.01, 0.005, 0.02])
    laminate = Laminate(
        z0=-0.5 * t.sum() if z0 is None else z0,
        thickness=t,
        angle=np.radians([0.0, 90.0, 90.0]),
        plane=np.repeat(np.diag([140e9, 10e9, 5e9])[None], 3, axis=0),
        shear_flexibility=np.repeat(np.diag([1 / 5e9, 1 / 3e9])[None], 3, axis=0),
        rho=np.full(3, 1600.0),
    )
    a, b, d = laminate.stiffness()
    return ShellProperty(
        card="PCOMP",
        pid=1,
        membrane=a,
        coupling=b,
        bending=d,
        shear_flexibility=laminate.transverse_flexibility(),
        nominal=laminate.total,
        thickness=laminate.total,
        inertia_ratio=1.0,
        fibre=np.array([laminate.z0, laminate.z0 + laminate.total]),
        density=1600.0 * laminate.total,
        nsm=0.0,
        mass_height=laminate.mass_height(),
        ge=0.0,
        laminate=laminate,
        ply_id=np.arange(1, 4),
    )


def strip_tip(prop: ShellProperty, length: float, width: float, count: int) -> float:
    """Tip deflection of a cantilever one element wide under a unit force."""
    points, conn = grid(count, 1)
    xyz = np.c_[points * [length, width], np.zeros(len(points))]
    x = facet(xyz[conn]).axes[:, 0]
    angle = -np.arctan2(x[:, 1], x[:, 0])
    model = Model(xyz, [shells(xyz, conn, prop, angle=angle)])
    model.fix(points[:, 0] == 0.0, "123456")
    load = np.zeros((len(xyz), 6))
    load[-2:, 2] = 0.5
    return model.solve(load)[-2:, 2].mean()


@pytest.mark.parametrize("aspect", [0.1, 0.8, 1.0, 1.25, 4.0, 10.0])
@pytest.mark.parametrize("count", [1, 3])
def test_strips_bend_as_timoshenkos_beam_at_any_aspect(aspect, count):
    """Whatever the shape of the elements: F l^3 / 3 EI + F l / GA at the grids."""
    length, thickness = 1.0, 0.05
    width = length / count / aspect
    found = strip_tip(isotropic_property(E, 0.0, thickness), length, width, count)
    bending = length**3 / (3.0 * E * width * thickness**3 / 12.0)
    shear = length / (5.0 / 6.0 * 0.5 * E * width * thickness)
    assert found == pytest.approx(bending + shear, rel=1e-9)


@pytest.mark.parametrize("aspect", [0.2, 1.0, 5.0])
@pytest.mark.parametrize("z0", [None, 0.0, 0.1])
def test_unsymmetric_strips_bend_about_their_neutral_surface(aspect, z0):
    """Wherever the reference surface lies; B is not zero in any of them."""
    prop = cross_ply(z0=z0)
    length, width = 1.0, 0.5 / aspect
    a, b, d = (m[0, 0] for m in (prop.membrane, prop.coupling, prop.bending))
    rigidity = (d - b * b / a) * width
    exact = length**3 / (3.0 * rigidity) + length * prop.shear_flexibility[0, 0] / width
    assert strip_tip(prop, length, width, 2) == pytest.approx(exact, rel=1e-7)


def section_of(xyz, prop):
    block = shells(xyz, np.arange(len(xyz))[None], prop)
    return block.shape, block.section


def test_bending_along_a_line_is_that_of_the_laminates_transverse_shear():
    """Both use D - B^2 / A of the direction, Nastran's cylindrical bending."""
    prop = cross_ply(z0=0.03)
    xyz = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    _, section = section_of(xyz, prop)
    direction = np.array([[[1.0, 0.0], [0.0, 1.0]]])
    centered = cross_ply()
    a, b, d = centered.membrane, centered.coupling, centered.bending
    expected = np.diag(d) - np.diag(b) ** 2 / np.diag(a)
    np.testing.assert_allclose(
        bending_along(section, direction)[0], expected[:2], rtol=1e-10
    )


@given(
    aspect=st.floats(0.05, 20.0),
    skew=st.floats(-1.2, 1.2),
    turn=st.floats(0.0, 6.0),
)
def test_twist_shares_are_two_springs_side_by_side(aspect, skew, turn):
    """1 / (a l^2) = 1 / l^2 + (1/e - 1) / width^2, in any frame; 1/40 of squares."""
    c, s = np.cos(turn), np.sin(turn)
    jacobian = np.array([[aspect, 0.0], [np.sin(skew), np.cos(skew)]])
    shares = twist_shares((jacobian @ np.array([[c, s], [-s, c]]))[None])[0]
    length = np.linalg.norm(jacobian, axis=1)
    width = abs(np.linalg.det(jacobian)) / length
    stiffness = 1.0 / length**2 + 39.0 / width**2
    np.testing.assert_allclose(shares * length**2, 1.0 / stiffness, rtol=1e-9)
    assert twist_shares(np.eye(2)[None]) == pytest.approx(1.0 / 40.0)


@given(
    x=st.floats(-3.0, 3.0),
    y=st.floats(0.05, 3.0),
)
def test_circulation_of_triangles_knows_their_area_alone(x, y):
    """sqrt(4/3 det Z_r) = A / (6 D) of isotropic plates, whatever the shape."""
    xyz = np.array([[0, 0, 0], [1, 0, 0], [x, y, 0.0]])
    shape, section = section_of(xyz, isotropic_property(E, 0.3, 0.01))
    residual = residual_flexibility(shape, section)[0]
    rigidity = E * 0.01**3 / (12.0 * (1.0 - 0.3**2))
    turning = np.sqrt(4.0 / 3.0 * np.linalg.det(residual))
    assert turning == pytest.approx(0.5 * y / (6.0 * rigidity), rel=1e-9)


@pytest.mark.parametrize("aspect", [1.0, 3.0, 10.0])
def test_linear_resultants_leave_the_strain_across_to_the_membrane(aspect):
    """Bending of a rectangle in its plane, N_x = y: stiffness A_11 - A_12^2 / A_22.

    Of isotropic sheets E t; of any laminate without its A_16 and D_16 terms.
    """
    angle_ply = cross_ply()
    a = np.array([[90e9, 30e9, 20e9], [30e9, 40e9, 5e9], [20e9, 5e9, 35e9]]) * 0.035
    d = a * 0.035**2 / 12.0 * np.array([[1.2, 1, 1], [1, 0.8, 1], [1, 1, 1.0]])
    prop = replace(angle_ply, membrane=a, bending=d, coupling=np.zeros((3, 3)))
    xyz = np.array([[0, 0, 0], [aspect, 0, 0], [aspect, 1, 0], [0, 1, 0.0]])
    x = facet(xyz[None]).axes[:, 0]
    block = shells(xyz, np.arange(4)[None], prop, angle=-np.arctan2(x[:, 1], x[:, 0]))
    stiffness = in_plane(block.shape, block.section).reduced[0]
    # Hourglass: u = x y in the plane, or the same of the director; strain xx = y.
    xy = block.shape.xy[0]
    mode = np.zeros((4, 2))
    mode[:, 0] = xy[:, 0] * xy[:, 1]
    moment = aspect / 12.0  # integral of y^2
    nu = a[0, 1] / a[1, 1]
    strain = np.array([1.0, -nu, 0.0])
    for part, rows in ((a, slice(0, 8)), (d, slice(8, 16))):
        energy = mode.ravel() @ stiffness[rows, rows] @ mode.ravel()
        assert energy == pytest.approx(strain @ part @ strain * moment, rel=1e-9)


def supported_plate(nx: int, ny: int, corners: int = 4):
    """Unit square, 1/100 thick, simply supported, unit pressure: reactions (g,)."""
    points, conn = grid(nx, ny)
    conn = conn if corners == 4 else triangles(conn)
    xyz = np.c_[points, np.zeros(len(points))]
    model = Model(xyz, [shells(xyz, conn, isotropic_property(E, 0.3, 0.01))])
    x, y = points.T
    ends, sides = (x == 0) | (x == 1), (y == 0) | (y == 1)
    model.fix(slice(None), "126")
    model.fix(ends | sides, "3")
    model.fix(ends, "4")
    model.fix(sides, "5")
    load = np.zeros((len(xyz), 6))
    block = model.blocks[0]
    for k in range(corners):
        np.add.at(load[:, 2], conn[:, k], block.extent / corners)
    u = model.solve(load)
    force = np.zeros(6 * len(xyz))
    inner = np.einsum("eij,ej->ei", block.stiffness(), u.ravel()[block.dof])
    np.add.at(force, block.dof.ravel(), inner.ravel())
    return points, force.reshape(-1, 6)[:, 2] - load[:, 2]


def edge_reactions(count: int) -> np.ndarray:
    """(count + 1,) shear forces of Navier's series on an edge, lumped to its grids."""
    odd = np.arange(1.0, 999.0, 2.0)
    across, along = np.meshgrid(np.pi * odd, np.pi * odd)
    amplitude = (16.0 / (across * along) * across / (across**2 + along**2)).sum(axis=1)
    wave, step = np.pi * odd, 1.0 / count
    hat = (2.0 - 2.0 * np.cos(wave * step)) / (wave**2 * step)
    return np.sin(np.outer(np.arange(count + 1) * step, wave)) @ (amplitude * hat)


@pytest.mark.parametrize(
    ("corners", "shape", "middle", "worst"),
    [
        (4, (16, 16), 0.02, 0.06), (4, (8, 32), 0.02, 0.08), (4, (4, 40), 0.05, 0.15),
        (3, (16, 16), 0.01, 0.04), (3, (8, 16), 0.02, 0.17),
    ],
)  # fmt: skip
def test_reactions_of_a_supported_plate(corners, shape, middle, worst):
    """Navier's shear forces on both edges, elements of aspect 1 to 10."""
    points, reaction = supported_plate(*shape, corners)
    assert reaction.sum() == pytest.approx(-1.0, rel=1e-9)
    for axis, count in ((0, shape[1]), (1, shape[0])):
        found = -reaction[points[:, axis] == 0.0]
        exact = edge_reactions(count)
        half = count // 2
        assert found[half] == pytest.approx(exact[half], rel=middle)
        assert np.abs(found - exact)[1:-1].max() < worst * exact.max()


@pytest.mark.parametrize("corners", [3, 4])
def test_bending_in_one_direction_alone_and_rigid_shear(corners):
    """Corrugated sheet: no stiffness along y, no shear flexibility (blank MID3)."""
    prop = replace(
        isotropic_property(E, 0.0, 0.01),
        bending=np.diag([E / 12.0, 0.0, 0.0]),
        shear_flexibility=np.zeros((2, 2)),
    )
    xyz = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0.0]])[:corners]
    block = shells(xyz, np.arange(corners)[None], prop)
    stiffness = block.stiffness()[0]
    assert np.isfinite(stiffness).all()
    assert np.linalg.eigvalsh(stiffness)[0] > -1e-9 * np.abs(stiffness).max()
