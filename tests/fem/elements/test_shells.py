"""CQUAD4 and CTRIA3: patch tests, rigid motions, frames, offsets, taper, laminates."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shell_model import Model, isotropic_property, shells, triangles

from fem.elements.shells.shell import Shell
from fem.elements.shells.shell_geometry import facet
from fem.properties.laminate import Laminate
from fem.properties.shells import ShellProperty, sections

E, NU = 1e6, 0.25
CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
# MacNeal and Harder's patch: irregular inner quadrilateral.
PATCH = np.array(
    [
        [0, 0], [0.24, 0], [0.24, 0.12], [0, 0.12],
        [0.04, 0.02], [0.18, 0.03], [0.16, 0.08], [0.08, 0.08],
    ]
)  # fmt: skip
QUADS = np.array([[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 6, 7]])


def laminated(*, symmetric: bool, z0: float | None = None) -> ShellProperty:
    """0/45/90 (and back) of an orthotropic ply."""
    angles = np.radians([0.0, 45.0, 90.0] + ([90.0, 45.0, 0.0] if symmetric else []))
    count = len(angles)
    plane = np.array([[140e9, 3e9, 0.0], [3e9, 10e9, 0.0], [0.0, 0.0, 5e9]])
    t = 0.0002
    laminate = Laminate(
        z0=-0.5 * count * t if z0 is None else z0,
        thickness=np.full(count, t),
        angle=angles,
        plane=np.repeat(plane[None], count, axis=0),
        shear_flexibility=np.repeat(np.diag([1 / 5e9, 1 / 3e9])[None], count, axis=0),
        rho=np.full(count, 1600.0),
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
        ply_id=np.arange(1, count + 1),
    )


def patch_model(corners: int, prop: ShellProperty) -> Model:
    """The patch, its material axes along the global ones."""
    xyz = np.c_[PATCH, np.zeros(8)]
    conn = QUADS if corners == 4 else triangles(QUADS)
    x = facet(xyz[conn]).axes[:, 0]
    model = Model(xyz, [shells(xyz, conn, prop, angle=-np.arctan2(x[:, 1], x[:, 0]))])
    model.fix(np.arange(4), "123456")
    return model


def linear_plane(xy, gradient):
    """(g, 6) membrane displacements u = gradient x, rz their rotation."""
    u = np.zeros((len(xy), 6))
    u[:, :2] = xy @ np.asarray(gradient).T
    u[:, 5] = 0.5 * (gradient[1][0] - gradient[0][1])
    return u


def quadratic_plate(xy, curvature):
    """(g, 6) w with constant curvatures -w,ab and the rotations that belong to it."""
    k = np.array([[curvature[0], curvature[2] / 2], [curvature[2] / 2, curvature[1]]])
    u = np.zeros((len(xy), 6))
    slope = -xy @ k
    u[:, 2] = 0.5 * np.sum(slope * xy, axis=1)
    u[:, 3], u[:, 4] = slope[:, 1], -slope[:, 0]
    return u


def assert_same_field(u, exact):
    """To 1e-10 of the largest translation, rotations of it over the element size."""
    largest = np.abs(exact[:, :3]).max()
    tolerance = 1e-10 * largest * np.array([1.0, 1.0, 1.0] + [1.0 / 0.04] * 3)
    assert (np.abs(u - exact) <= tolerance).all()


def results(recovery, block: Shell, u):
    linear = np.einsum("eij,ej->ei", recovery.matrix, u.ravel()[block.dof])
    return recovery.derive(linear)


@pytest.mark.parametrize("corners", [4, 3])
def test_membrane_patch_is_exact(corners):
    model = patch_model(corners, isotropic_property(E, NU, 0.001))
    exact = linear_plane(PATCH, [[1e-3, 0.5e-3], [0.5e-3, 1e-3]])
    u = model.solve(np.zeros((8, 6)), exact)
    assert_same_field(u, exact)
    stress = results(model.blocks[0].stresses(), model.blocks[0], u)
    # MacNeal and Harder: 1333, 1333, 400. Element axes differ: take invariants.
    sx, sy, txy = stress[:, 1], stress[:, 2], stress[:, 3]
    np.testing.assert_allclose(sx + sy, 8000 / 3, rtol=1e-10)
    np.testing.assert_allclose((0.5 * (sx - sy)) ** 2 + txy**2, 400.0**2, rtol=1e-10)


@pytest.mark.parametrize("corners", [4, 3])
def test_bending_patch_is_exact(corners):
    model = patch_model(corners, isotropic_property(E, NU, 0.001))
    exact = quadratic_plate(PATCH, [-1e-3, -1e-3, -1e-3])
    u = model.solve(np.zeros((8, 6)), exact)
    assert_same_field(u, exact)
    block = model.blocks[0]
    force = results(block.forces(), block, u)
    mx, my, mxy = force[:, 3], force[:, 4], force[:, 5]
    np.testing.assert_allclose(mx + my, 2 * 1e-6 / 9, rtol=1e-9)
    np.testing.assert_allclose(
        (0.5 * (mx - my)) ** 2 + mxy**2, (1e-7 / 3) ** 2, rtol=1e-8
    )
    assert abs(force[:, 6:]).max() < 1e-8 * abs(mx).max() / 0.1


@pytest.mark.parametrize("corners", [4, 3])
@pytest.mark.parametrize("symmetric", [True, False])
def test_coupled_patch_of_a_laminate_is_exact(corners, symmetric):
    model = patch_model(corners, laminated(symmetric=symmetric))
    exact = quadratic_plate(PATCH, [-1e-3, 2e-3, 5e-4]) + linear_plane(
        PATCH, [[1e-4, 3e-5], [3e-5, -2e-4]]
    )
    u = model.solve(np.zeros((8, 6)), exact)
    assert_same_field(u, exact)


@pytest.mark.parametrize("thickness", [1e-5, 1e-3, 0.1])
def test_bending_patch_is_exact_at_any_thickness(thickness):
    model = patch_model(4, isotropic_property(E, NU, thickness))
    exact = quadratic_plate(PATCH, [-1e-3, -2e-3, 3e-3])
    u = model.solve(np.zeros((8, 6)), exact)
    assert_same_field(u, exact)


def rigid_motion(xyz, rng):
    """(g, 6) small rigid motion."""
    shift, turn = rng.normal(size=3), rng.normal(size=3)
    u = np.empty((len(xyz), 6))
    u[:, :3] = shift + np.cross(turn, xyz)
    u[:, 3:] = turn
    return u


@settings(max_examples=40, deadline=None)
@given(
    seed=st.integers(0, 10**6),
    corners=st.sampled_from([3, 4]),
    warp=st.floats(0.0, 0.3),
    offset=st.floats(-0.2, 0.2),
    composite=st.booleans(),
)
def test_rigid_motion_needs_no_force(seed, corners, warp, offset, composite):
    rng = np.random.default_rng(seed)
    base = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])[:corners]
    xyz = base + rng.uniform(-0.2, 0.2, (corners, 3)) * [1, 1, warp]
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    xyz = xyz @ turn.T
    prop = (
        laminated(symmetric=False) if composite else isotropic_property(7e10, 0.3, 0.02)
    )
    block = shells(
        xyz,
        np.arange(corners)[None],
        prop,
        offset=offset,
        angle=np.array([rng.uniform(0, 3)]),
    )
    stiffness = block.stiffness()[0]
    u = rigid_motion(xyz, rng).ravel()
    scale = np.abs(stiffness) @ np.abs(u)
    assert np.abs(stiffness @ u).max() <= 1e-10 * scale.max()
    assert u @ stiffness @ u <= 1e-10 * np.abs(u) @ np.abs(stiffness) @ np.abs(u)
    np.testing.assert_allclose(stiffness, stiffness.T, atol=1e-9 * stiffness.max())
    values = np.linalg.eigvalsh(0.5 * (stiffness + stiffness.T))
    assert values[0] > -1e-9 * values[-1]
    force = block.forces().matrix[0] @ u
    reference = np.abs(block.forces().matrix[0]) @ np.abs(u)
    assert (np.abs(force) <= 1e-9 * reference.max()).all()


@pytest.mark.parametrize("corners", [3, 4])
def test_only_rigid_motions_are_free(corners):
    xyz = np.array([[0, 0, 0], [1.1, 0, 0.1], [1, 0.9, 0], [0, 1, 0.1]])[:corners]
    block = shells(xyz, np.arange(corners)[None], isotropic_property(7e10, 0.3, 0.02))
    values = np.linalg.eigvalsh(block.stiffness()[0])
    assert values[5] < 1e-9 * values[-1] < values[6]


@pytest.mark.parametrize("corners", [3, 4])
def test_result_does_not_depend_on_the_first_node(corners):
    """A square or half square renumbered is the same element."""
    xyz = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])[:corners]
    prop = isotropic_property(7e10, 0.3, 0.02)
    first = shells(xyz, np.arange(corners)[None], prop).stiffness()[0]
    rolled = np.roll(np.arange(corners), -1)
    block = shells(xyz, rolled[None], prop)
    back = np.empty((6 * corners, 6 * corners))
    back[np.ix_(block.dof[0], block.dof[0])] = block.stiffness()[0]
    np.testing.assert_allclose(back, first, atol=1e-12 * abs(first).max())


@pytest.mark.parametrize("corners", [3, 4])
def test_offset_equals_rigid_links(corners):
    xyz = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])[:corners]
    conn = np.arange(corners)[None]
    prop = isotropic_property(7e10, 0.3, 0.02)
    offset = shells(xyz, conn, prop, offset=0.3, k6rot=0.0).stiffness()[0]
    centered = shells(xyz, conn, prop, k6rot=0.0).stiffness()[0]
    link = np.eye(6)
    link[0, 4], link[1, 3] = 0.3, -0.3
    links = np.kron(np.eye(corners), link)
    np.testing.assert_allclose(
        offset, links.T @ centered @ links, atol=1e-9 * abs(offset).max()
    )


def test_laminate_offset_by_z0_equals_offset_of_the_element():
    xyz = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    conn = np.arange(4)[None]
    centered, raised = laminated(symmetric=True), laminated(symmetric=True, z0=0.0)
    total = centered.thickness
    one = shells(xyz, conn, centered, offset=0.5 * total, k6rot=0.0)
    two = shells(xyz, conn, raised, k6rot=0.0)
    np.testing.assert_allclose(
        one.stiffness(), two.stiffness(), atol=1e-9 * one.stiffness().max()
    )
    for coupled in (False, True):
        np.testing.assert_allclose(
            one.mass(coupled=coupled), two.mass(coupled=coupled), atol=1e-15
        )


@pytest.mark.parametrize("corners", [3, 4])
@pytest.mark.parametrize("coupled", [False, True])
def test_mass_and_first_moment_with_offset(corners, coupled):
    rng = np.random.default_rng(3)
    xyz = np.array([[0, 0, 0], [1.3, 0, 0], [1, 0.8, 0], [-0.1, 1, 0.0]])[:corners]
    prop = isotropic_property(7e10, 0.3, 0.02, 2700.0)
    block = shells(xyz, np.arange(corners)[None], prop, offset=0.4)
    mass = block.mass(coupled=coupled)[0]
    total = 2700.0 * 0.02 * block.extent[0]
    for _ in range(3):
        u = rigid_motion(xyz, rng).ravel()
        turned = np.zeros((corners, 6))
        turned[:, 1] = 1.0
        # Force along y of a unit acceleration, moment about x: -m z.
        force = (mass @ turned.ravel()).reshape(-1, 6)
        assert force[:, 1].sum() == pytest.approx(total)
        assert force[:, 3].sum() == pytest.approx(-0.4 * total)
        assert u @ mass @ u > 0.0


def test_tapered_thickness_stretches_like_its_mean_and_bends_like_its_cube():
    """Uniform fields on a taper along y only: A integrates t, D integrates t^3."""
    xyz = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    prop = isotropic_property(7e10, 0.0, 0.02)
    thickness = np.array([[0.01, 0.01, 0.03, 0.03]])
    block = shells(xyz, np.arange(4)[None], prop)
    section = sections([prop], np.zeros(1, int), np.zeros(1), thickness)
    tapered = replace(block, section=section, k6rot=0.0)
    k = tapered.stiffness()[0]
    plate = quadratic_plate(xyz[:, :2], [0.0, 1e-3, 0.0]).ravel()
    energy = 0.5 * plate @ k @ plate
    bending = 7e10 / 12.0 * np.mean(np.linspace(0.01, 0.03, 200001) ** 3)
    # The moment is uniform across y: the compliance is averaged, 1 / mean(t^-3).
    soft = 7e10 / 12.0 / np.mean(np.linspace(0.01, 0.03, 200001) ** -3.0)
    assert 0.5 * soft * 1e-6 * 0.9 < energy < 0.5 * bending * 1e-6
    along = linear_plane(xyz[:, :2], [[1e-3, 0.0], [0.0, 0.0]]).ravel()
    assert 0.5 * along @ k @ along == pytest.approx(0.5 * 7e10 * 0.02 * 1e-6, rel=1e-9)


def test_membrane_only_and_bending_only():
    xyz = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    full = isotropic_property(7e10, 0.3, 0.02)
    conn = np.arange(4)[None]

    def matrix(**changes):
        return shells(xyz, conn, replace(full, **changes), k6rot=0.0).stiffness()[0]

    zero = np.zeros((3, 3))
    membrane, plate = matrix(bending=zero), matrix(membrane=zero)
    np.testing.assert_allclose(
        membrane + plate, matrix(), atol=1e-10 * abs(membrane).max()
    )
    assert np.linalg.matrix_rank(membrane, tol=1e-6 * membrane.max()) == 5
    assert np.linalg.matrix_rank(plate, tol=1e-6 * plate.max()) == 9


def test_drilling_stiffness_scales_with_k6rot_and_keeps_rigid_motions_free():
    xyz = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0.0]])
    prop = isotropic_property(7e10, 0.3, 0.02)
    conn = np.arange(4)[None]
    k0, k1, k2 = (
        shells(xyz, conn, prop, k6rot=k).stiffness()[0] for k in (0.0, 1.0, 3.0)
    )
    np.testing.assert_allclose(k2 - k0, 3.0 * (k1 - k0), atol=1e-6)
    g = 7e10 / 2.6
    assert (k1 - k0)[5, 5] == pytest.approx(1e-6 * g * 0.02 * 2.0, rel=1e-3)


def test_drilling_acts_about_the_normal_of_the_grid():
    """Two plates meet at a kink of 24 degrees: the grids between have a mean normal.

    Drilling gives moments about it alone there, and none in rigid motions.
    """
    slope = np.tan(np.radians(12.0))
    x, y = np.array([-1.0, 0.0, 1.5]), np.array([0.0, 0.8])
    xyz = np.array([[a, b, -slope * abs(a)] for a in x for b in y])
    conn = np.array([[0, 2, 3, 1], [2, 4, 5, 3]])
    prop = isotropic_property(E, NU, 0.02)
    full, bare = (shells(xyz, conn, prop, k6rot=k).stiffness() for k in (100.0, 0.0))
    drilling = np.zeros((36, 36))
    for matrix, grids in zip(full - bare, conn):
        dof = (6 * grids[:, None] + np.arange(6)).ravel()
        drilling[np.ix_(dof, dof)] += matrix
    moments = drilling.reshape(6, 6, 36)[2:4, 3:]
    size = np.abs(moments).max()
    assert size > 0.0
    np.testing.assert_allclose(moments[:, :2], 0.0, atol=1e-9 * size)
    rigid = np.concatenate([np.c_[np.eye(3), np.cross(np.eye(3), p).T] for p in xyz])
    turned = np.zeros((36, 6))
    for k in range(6):
        turned[6 * k : 6 * k + 3] = rigid[3 * k : 3 * k + 3]
        turned[6 * k + 3 : 6 * k + 6, 3:] = np.eye(3)
    np.testing.assert_allclose(drilling @ turned, 0.0, atol=1e-8 * size)


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 10**6), warp=st.floats(-0.2, 0.2))
def test_sides_of_a_warped_quadrilateral_stretch_in_a_linear_field(seed, warp):
    """u = H x: the mean of t . H t over opposite sides t is the strain at the center.

    Rotations of the grids play no part, neither does a rotation of the whole.
    """
    rng = np.random.default_rng(seed)
    first, second = np.array([1.0, 0.1]), np.array([rng.uniform(-0.5, 0.5), 0.8])
    flat = 0.5 * (CORNERS[:, :1] * first + CORNERS[:, 1:] * second)
    xyz = np.c_[flat, warp * np.array([1.0, -1.0, 1.0, -1.0])]
    field = rng.normal(size=(3, 3))
    block = shells(xyz, np.arange(4)[None], isotropic_property(E, NU, 0.01))
    u = np.c_[xyz @ field.T, rng.normal(size=(4, 3))]
    found = block.resultants()[0, 0, :3] @ u.ravel()
    sides = 0.5 * (np.roll(xyz, -1, axis=0) - xyz)
    stretch = np.einsum("ki,ij,kj->k", sides, field, sides)
    along = 0.5 * (stretch[0] + stretch[2]), 0.5 * (stretch[1] + stretch[3])
    plane = np.zeros((2, 2))
    plane[0, 0], plane[1, 1] = along
    sheared = 0.25 * first @ (field + field.T)[:2, :2] @ second
    plane[0, 1] = plane[1, 0] = 0.5 * sheared
    inverse = np.linalg.inv(0.5 * np.stack([first, second]))
    strain = inverse @ plane @ inverse.T
    axes = block.shape.axes[0]
    strain = axes[:2, :2] @ strain @ axes[:2, :2].T
    vector = np.array([strain[0, 0], strain[1, 1], 2.0 * strain[0, 1]])
    expected = block.section.membrane[0] @ vector
    np.testing.assert_allclose(found, expected, atol=1e-9 * np.abs(expected).max())
