"""CHEXA, CPENTA, CTETRA, CPYRAM: patch tests, rigid motions, bending, mass, axes."""

import numpy as np
import pytest
import scipy.sparse.linalg as spla
from hypothesis import given, settings
from hypothesis import strategies as st
from shell_model import scattered

from benchmarks.verification.runner import run
from fem.deck.reader import read_deck
from fem.deck.records.solids import HEXA, PENTA, PYRAMID
from fem.elements.solids.element_axes import penta_axes, stress_rotation
from fem.elements.solids.hexa import HEXA8, HEXA20, hexa8_full
from fem.elements.solids.incomplete import without
from fem.elements.solids.isoparametric import (
    HEX20_POINTS,
    HEX_CORNERS,
    PENTA_CORNERS,
    TETRA_CORNERS,
    jacobians,
    tetra15,
)
from fem.elements.solids.notices import solid_notices
from fem.elements.solids.penta import PENTA6
from fem.elements.solids.penta15 import PENTA15
from fem.elements.solids.pyramid import PYRAM5, PYRAM13
from fem.elements.solids.solid import Shape, Solid, lumped_mass
from fem.elements.solids.tetra import TETRA4, TETRA10
from fem.elements.stress_measures import solid_principal
from fem.properties.elasticity import isotropic_solid

E, NU = 1e6, 0.25
_EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
_PYRAMID = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1.0]])


def _with_middles(corners, edges):
    return np.vstack([corners, corners[np.array(edges)].mean(axis=1)])


NATURAL = {
    "HEXA8": (HEXA8, HEX_CORNERS),
    "HEXA20": (HEXA20, HEX20_POINTS),
    "PENTA6": (PENTA6, PENTA_CORNERS),
    "TETRA4": (TETRA4, TETRA_CORNERS),
    "TETRA10": (
        TETRA10,
        np.vstack(
            [TETRA_CORNERS, [TETRA_CORNERS[[i, j]].mean(axis=0) for i, j in _EDGES]]
        ),
    ),
    "PYRAM5": (PYRAM5, _PYRAMID),
    "PENTA15": (PENTA15, _with_middles(PENTA_CORNERS, PENTA.edges)),
    "PYRAM13": (PYRAM13, _with_middles(_PYRAMID, PYRAMID.edges)),
}


def solids(shape: Shape, xyz, conn, *, matrix=None, rho=0.0, axes=None) -> Solid:
    """Elements (e, n) over nodes (g, 3), three freedoms per node."""
    count = len(conn)
    own = isotropic_solid(E, NU) if matrix is None else matrix
    triads = np.eye(3) if axes is None else axes
    return Solid(
        card=shape.card,
        id=np.arange(1, count + 1),
        dof=(3 * conn[:, :, None] + np.arange(3)).reshape(count, -1),
        pid=np.ones(count, np.int64),
        shape=shape,
        nodes=xyz[conn],
        elasticity=np.repeat(own[None], count, axis=0),
        axes=np.repeat(triads[None], count, axis=0),
        rho=np.full(count, rho),
        ge=np.zeros(count),
        alpha=np.zeros((count, 6)),
        tref=np.zeros(count),
    )


def solve(blocks, size, fixed, values, load=None):
    """Displacements (g, 3) with enforced values where `fixed` (g, 3)."""
    k = sum(scattered(b.stiffness(), b.dof, 3 * size) for b in blocks)
    u = np.where(fixed, values, 0.0).ravel()
    free = np.flatnonzero(~fixed.ravel())
    right = -(k @ u) if load is None else load.ravel() - k @ u
    u[free] = spla.spsolve(k[free][:, free], right[free])
    return u.reshape(-1, 3)


# MacNeal and Harder's solid patch: seven bricks in a unit cube.
INNER = np.array(
    [
        [0.249, 0.342, 0.192], [0.826, 0.288, 0.288], [0.850, 0.649, 0.263],
        [0.273, 0.750, 0.230], [0.320, 0.186, 0.643], [0.677, 0.305, 0.683],
        [0.788, 0.693, 0.644], [0.165, 0.745, 0.702],
    ]
)  # fmt: skip
BRICK = np.vstack([INNER, 0.5 * (HEX_CORNERS + 1.0)])
HEXES = np.array(
    [
        [0, 1, 2, 3, 4, 5, 6, 7],
        [8, 9, 10, 11, 0, 1, 2, 3],
        [4, 5, 6, 7, 12, 13, 14, 15],
        [8, 9, 1, 0, 12, 13, 5, 4],
        [9, 10, 2, 1, 13, 14, 6, 5],
        [10, 11, 3, 2, 14, 15, 7, 6],
        [11, 8, 0, 3, 15, 12, 4, 7],
    ]
)
GRADIENT = 1e-3 * np.array([[1.0, 0.5, 0.5], [0.5, 1.0, 0.5], [0.5, 0.5, 1.0]])


def tetra_cut(xyz, hexes):
    """Each hexahedron as twelve tetrahedra: its pyramids with their bases cut."""
    nodes, pyramids = pyramid_cut(xyz, hexes)
    tetras = []
    for *base, apex in pyramids.tolist():
        start = base.index(min(base))
        a, b, c, d = base[start:] + base[:start]
        tetras += [[a, b, c, apex], [a, c, d, apex]]
    return nodes, np.array(tetras)


def pyramid_cut(xyz, hexes):
    """Each hexahedron as six pyramids around its centroid (added to the nodes)."""
    faces = [
        (0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1),
        (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0),
    ]  # fmt: skip
    apex = len(xyz) + np.arange(len(hexes))
    conn = [np.c_[hexes[:, f], apex] for f in faces]
    return np.vstack([xyz, xyz[hexes].mean(axis=1)]), np.concatenate(conn)


def mid_sides(xyz, conn, edges):
    """Nodes at the middles of the edges, and the longer connections."""
    pairs = np.sort(conn[:, np.asarray(edges)], axis=2)
    unique, inverse = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    nodes = np.vstack([xyz, xyz[unique].mean(axis=1)])
    return nodes, np.c_[conn, len(xyz) + inverse.reshape(len(conn), -1)]


def patch(kind):
    if kind == "HEXA8":
        return HEXA8, BRICK, HEXES
    if kind == "HEXA20":
        ring = [(0, 1), (1, 2), (2, 3), (3, 0)]
        edges = (
            ring + [(k, k + 4) for k in range(4)] + [(a + 4, b + 4) for a, b in ring]
        )
        return HEXA20, *mid_sides(BRICK, HEXES, edges)
    if kind == "TETRA4":
        return TETRA4, *tetra_cut(BRICK, HEXES)
    if kind == "TETRA10":
        return TETRA10, *mid_sides(*tetra_cut(BRICK, HEXES), _EDGES)
    return PYRAM5, *pyramid_cut(BRICK, HEXES)


@pytest.mark.parametrize("kind", ["HEXA8", "HEXA20", "TETRA4", "TETRA10", "PYRAM5"])
def test_patch_is_exact(kind):
    shape, xyz, conn = patch(kind)
    block = solids(shape, xyz, conn)
    exact = xyz @ GRADIENT.T
    outside = ((xyz == 0.0) | (xyz == 1.0)).any(axis=1)
    u = solve([block], len(xyz), np.repeat(outside[:, None], 3, axis=1), exact)
    assert (~outside).sum() >= 8
    np.testing.assert_allclose(u, exact, rtol=0, atol=1e-10 * abs(exact).max())
    linear = np.einsum("eij,ej->ei", block.stresses().matrix, u.ravel()[block.dof])
    stress = linear.reshape(len(conn), -1, 6)
    # MacNeal and Harder: 2000 and 400.
    expected = np.broadcast_to([2000.0] * 3 + [400.0] * 3, stress.shape)
    if kind == "PYRAM5":  # the apex is sampled just below itself
        stress, expected = stress[:, :5], expected[:, :5]
    np.testing.assert_allclose(stress, expected, rtol=1e-9)


def test_penta_patch_is_exact_on_an_extruded_irregular_mesh():
    """Irregular triangles, three layers of unlike height, inclined direction."""
    flat = np.array(
        [
            [0, 0],
            [1, 0],
            [1, 1],
            [0, 1],
            [0.3, 0.2],
            [0.7, 0.35],
            [0.65, 0.75],
            [0.2, 0.6],
        ]
    )
    quads = np.array(
        [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 6, 7]]
    )
    tri = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    heights = np.array([0.0, 0.2, 0.7, 1.0])
    lean = np.array([0.0, 0.3, 0.1, -0.1])
    xyz = np.concatenate(
        [
            np.c_[flat + np.array([s, 0.5 * s]), np.full(8, h)]
            for h, s in zip(heights, lean)
        ]
    )
    conn = np.concatenate([np.c_[tri + 8 * k, tri + 8 * k + 8] for k in range(3)])
    turn, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))
    xyz = xyz @ (turn * np.sign(np.linalg.det(turn))).T
    inside = np.zeros(32, bool)
    inside[[12, 13, 14, 15, 20, 21, 22, 23]] = True
    block = solids(PENTA6, xyz, conn)
    exact = xyz @ GRADIENT.T
    u = solve([block], 32, np.repeat(~inside[:, None], 3, axis=1), exact)
    np.testing.assert_allclose(u, exact, rtol=0, atol=1e-10 * abs(exact).max())
    linear = np.einsum("eij,ej->ei", block.stresses().matrix, u.ravel()[block.dof])
    strain = np.array([1e-3] * 3 + [1e-3] * 3)
    stress = isotropic_solid(E, NU) @ strain
    expected = np.broadcast_to(stress, (len(conn), 7, 6)).reshape(len(conn), -1)
    np.testing.assert_allclose(linear, expected, rtol=1e-9)


@settings(max_examples=40, deadline=None)
@given(kind=st.sampled_from(sorted(NATURAL)), seed=st.integers(0, 10**6))
def test_rigid_motion_needs_no_force_and_nothing_else_is_free(kind, seed):
    shape, natural = NATURAL[kind]
    rng = np.random.default_rng(seed)
    xyz = natural + 0.1 * rng.uniform(-1, 1, natural.shape) * np.ptp(natural, axis=0)
    if np.linalg.det(jacobians(xyz[None], shape.derivatives(shape.checked))).min() <= 0:
        return
    stiffness = solids(shape, xyz, np.arange(len(xyz))[None]).stiffness()[0]
    shift, turn = rng.normal(size=3), rng.normal(size=3)
    u = (shift + np.cross(turn, xyz)).ravel()
    scale = np.abs(stiffness) @ np.abs(u)
    assert np.abs(stiffness @ u).max() <= 1e-10 * scale.max()
    values = np.linalg.eigvalsh(0.5 * (stiffness + stiffness.T))
    assert abs(values[:6]).max() < 1e-9 * values[-1]
    assert values[6] > 1e-6 * values[-1]


@pytest.mark.parametrize("kind", sorted(NATURAL))
@pytest.mark.parametrize("coupled", [False, True])
def test_mass_is_density_times_volume_and_positive(kind, coupled):
    shape, natural = NATURAL[kind]
    stretched = natural * [2.0, 1.0, 0.5]
    block = solids(shape, stretched, np.arange(len(natural))[None], rho=3.0)
    mass = block.mass(coupled=coupled)[0]
    volume = {"HEXA8": 8.0, "HEXA20": 8.0, "PENTA6": 1.0, "PENTA15": 1.0}
    expected = 3.0 * volume.get(kind, 1 / 6 if kind.startswith("TETRA") else 1 / 3)
    assert block.volume()[0] * 3.0 == pytest.approx(expected)
    unit = np.tile([0.0, 1.0, 0.0], len(natural))
    assert unit @ mass @ unit == pytest.approx(expected)
    least = np.linalg.eigvalsh(mass)[0]
    assert least >= 0.0
    # Lumped quadratic elements have nothing at their corners.
    assert least > 0.0 or (not coupled and shape.nodes > shape.corners)


@pytest.mark.parametrize("kind", sorted(NATURAL))
def test_no_density_is_no_mass(kind):
    shape, natural = NATURAL[kind]
    block = solids(shape, natural, np.arange(len(natural))[None])
    assert np.array_equal(block.mass(coupled=False), 0.0 * block.stiffness())


@pytest.mark.parametrize("kind", ["HEXA20", "PENTA15", "PYRAM13", "TETRA10"])
def test_shape_functions_are_one_at_their_node_and_their_slopes_are_theirs(kind):
    shape, natural = NATURAL[kind]
    if kind.startswith("PYRAM"):  # natural coordinates of the collapsed cube
        natural = 2.0 * natural - 1.0
        rise = np.clip(natural[:, 2:], -1.0, 1.0 - 1e-9)
        flat = natural[:, :2] / (0.5 * (1.0 - rise))
        natural = np.c_[flat, natural[:, 2:]]
    values = shape.values(natural)
    np.testing.assert_allclose(values, np.eye(len(natural)), atol=1e-8)
    at, step = np.full((1, 3), 0.2), 1e-6
    for k in range(3):
        ahead = shape.values(at + step * np.eye(3)[k])
        behind = shape.values(at - step * np.eye(3)[k])
        slope = shape.derivatives(at)[0, k]
        np.testing.assert_allclose((ahead - behind)[0] / (2 * step), slope, atol=1e-8)


def test_lumped_mass_of_a_box_is_that_of_msc():
    """8, 11 and 23 of 168 on the middles of edges of 2.5, 5 and 10; none at corners."""
    size = np.array([2.5, 5.0, 10.0])
    block = solids(HEXA20, 0.5 * HEX20_POINTS * size, np.arange(20)[None], rho=1.0)
    shares = np.diag(block.mass(coupled=False)[0])[::3] / size.prod()
    along = np.argmax(HEX20_POINTS[8:] == 0.0, axis=1)
    np.testing.assert_allclose(shares[:8], 0.0, atol=1e-15)
    np.testing.assert_allclose(168 * shares[8:], np.array([8, 11, 23])[along])


@settings(max_examples=30, deadline=None)
@given(
    kind=st.sampled_from(["HEXA20", "PENTA15", "PYRAM13", "TETRA10"]),
    seed=st.integers(0, 10**6),
)
def test_lumped_mass_knows_no_direction_and_no_size(kind, seed):
    shape, natural = NATURAL[kind]
    rng = np.random.default_rng(seed)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    moved = 3.0 * natural @ (turn * np.sign(np.linalg.det(turn))).T + rng.normal(size=3)
    masses = rng.uniform(0.1, 1.0, (1, shape.nodes))
    one = lumped_mass(natural[None], masses, shape.corners)
    np.testing.assert_allclose(one, lumped_mass(moved[None], masses, shape.corners))
    assert one.sum() == pytest.approx(masses.sum())


def test_axes_of_a_right_angled_prism_favour_no_side():
    r, s, height = np.eye(3)[0], np.array([1.0, 1.0, 0.0]), np.eye(3)[2]
    axes = penta_axes(np.stack([r, s, height])[None])[0]
    angle = np.degrees(np.arctan2(axes[0, 1], axes[0, 0]))
    assert angle == pytest.approx(-15.0)


@pytest.mark.parametrize("kind", ["HEXA20", "PENTA15", "TETRA10", "PYRAM13"])
def test_stiffness_turns_with_the_element(kind):
    shape, natural = NATURAL[kind]
    rng = np.random.default_rng(5)
    xyz = natural + 0.05 * rng.uniform(-1, 1, natural.shape) * np.ptp(natural, axis=0)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn = turn * np.sign(np.linalg.det(turn))
    conn = np.arange(len(xyz))[None]
    here = solids(shape, xyz, conn).stiffness()[0]
    there = solids(shape, xyz @ turn.T, conn).stiffness()[0]
    whole = np.kron(np.eye(len(xyz)), turn)
    np.testing.assert_allclose(
        there, whole @ here @ whole.T, atol=1e-9 * abs(here).max()
    )


_CUBE = """\
SOL 101
CEND
SPC = 1
LOAD = 2
DISP = ALL
BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,,0.,0.,1.
GRID,6,,1.,0.,1.
GRID,7,,1.,1.,1.
GRID,8,,0.,1.,1.
CHEXA,1,1,1,2,3,4,5,6
,7,8
MAT1,1,1.+6,,.25
SPC1,1,123,1,4,5,8
FORCE,2,2,,1.,0.,0.,1.
PSOLID,1,1,,{0},{1},{2}
ENDDATA
"""


@pytest.mark.parametrize(
    ("fields", "order"), [(("TWO", "", "FULL"), 2), (("3", "GRID", "1"), 3)]
)
def test_psolid_chooses_the_integration(fields, order):
    text = _CUBE.format(*fields)
    corner = run(text)["static/1/displacement"][6, :3]
    xyz = 0.5 * (HEX_CORNERS + 1.0)
    stiffness = hexa8_full(xyz[None], isotropic_solid(E, NU)[None], order=order)
    free = np.repeat(xyz[:, 0] > 0.0, 3)
    load = np.zeros(24)
    load[5] = 1.0
    u = np.zeros(24)
    u[free] = np.linalg.solve(stiffness.stiffness[0][free][:, free], load[free])
    np.testing.assert_allclose(corner, u[18:21], rtol=1e-9)


def test_what_psolid_asks_in_vain_is_said(tmp_path):
    path = tmp_path / "cube.bdf"
    path.write_text(_CUBE.format("THREE", "GAUSS", ""))
    notices = solid_notices(read_deck(path))
    assert len(notices) == 2
    assert "IN 'THREE' with ISOP '' is not done for CHEXA with 8 nodes" in notices[0]
    assert "STRESS 'GAUSS' is not done" in notices[1]
    path.write_text(_CUBE.format("BUBBLE", "GRID", "REDUCED"))
    assert solid_notices(read_deck(path)) == []


@pytest.mark.parametrize("seed", range(3))
def test_a_brick_without_mid_sides_is_the_one_with_them_held_straight(seed):
    """Any set of mid-sides: same energy, mass and volume, no force in rigid motion."""
    rng = np.random.default_rng(seed)
    there = rng.uniform(size=12) < 0.5
    shape = without(HEXA20, HEXA.edges, there)
    kept = np.r_[np.full(8, True), there]
    corners = HEX_CORNERS + 0.1 * rng.uniform(-1, 1, (8, 3))
    whole = _with_middles(corners, HEXA.edges)
    xyz, count = whole[kept], int(kept.sum())
    small = solids(shape, xyz, np.arange(count)[None], rho=2.0)
    large = solids(HEXA20, whole, np.arange(20)[None], rho=2.0)
    u = rng.normal(size=(20, 3))
    for k, (i, j) in enumerate(HEXA.edges):
        if not there[k]:
            u[8 + k] = 0.5 * (u[i] + u[j])
    part = u[kept].ravel()
    energy = part @ small.stiffness()[0] @ part
    assert energy == pytest.approx(u.ravel() @ large.stiffness()[0] @ u.ravel())
    assert small.volume() == pytest.approx(large.volume())
    mass = np.diag(small.mass(coupled=False)[0])[::3]
    assert mass.sum() == pytest.approx(2.0 * small.volume()[0])
    stress = small.stresses().matrix[0] @ part
    np.testing.assert_allclose(
        stress, large.stresses().matrix[0] @ u.ravel(), rtol=1e-9
    )


def test_one_row_of_bricks_bends_like_a_beam():
    """In-plane bending by an end moment, one element high: no locking."""
    for aspect in (1.0, 5.0):
        count, height = 4, 1.0
        x = aspect * np.arange(count + 1)
        section = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
        xyz = np.concatenate([np.c_[np.full(4, a), section] for a in x])
        conn = np.array([np.r_[4 * k : 4 * k + 8] for k in range(count)])
        conn = conn[:, [0, 4, 5, 1, 3, 7, 6, 2]]
        block = solids(HEXA8, xyz, conn)
        fixed = np.zeros((len(xyz), 3), bool)
        fixed[:4, 0] = True
        fixed[0, 1:] = fixed[1, 2] = True
        load = np.zeros((len(xyz), 3))
        load[-4:, 0] = 0.5 * np.array([-1.0, -1.0, 1.0, 1.0])  # moment 1
        u = solve([block], len(xyz), fixed, np.zeros((len(xyz), 3)), load)
        length = aspect * count
        tip = u[-4:, 2].mean() - u[:4, 2].mean()
        assert tip == pytest.approx(-(length**2) / (2 * E / 12.0) * height, rel=1e-9)


def test_orthotropic_stress_comes_in_material_axes():
    matrix = isotropic_solid(E, NU)
    matrix[0, 0] *= 3.0
    turn, _ = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))
    turn = turn * np.sign(np.linalg.det(turn))
    rotation = stress_rotation(turn[None], strain=True)[0]
    basic = rotation.T @ matrix @ rotation
    xyz = HEX_CORNERS
    block = solids(HEXA8, xyz, np.arange(8)[None], matrix=basic, axes=turn)
    along = turn[0]
    u = (xyz @ along)[:, None] * along * 1e-3  # strain 1e-3 along material axis 1
    linear = block.stresses().matrix[0] @ u.ravel()
    np.testing.assert_allclose(
        linear.reshape(-1, 6), np.tile(matrix[:, 0] * 1e-3, (9, 1)), atol=1e-9 * E
    )


def test_quadrature_of_degree_five():
    """Integral of x^a y^b z^c over the unit tetrahedron: a! b! c! / (a+b+c+3)!."""
    from math import factorial

    rule = tetra15()
    for a, b, c in ((0, 0, 0), (2, 0, 0), (1, 1, 1), (2, 2, 0), (3, 1, 1), (5, 0, 0)):
        value = rule.weights @ np.prod(rule.points ** np.array([a, b, c]), axis=1)
        exact = factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3)
        assert value == pytest.approx(exact, rel=1e-12)


def test_principal_values_are_eigenvalues():
    rng = np.random.default_rng(0)
    stress = rng.normal(size=(200, 6))
    stress[0] = [1, 1, 1, 0, 0, 0]
    stress[1] = 0.0
    full = stress[:, [[0, 3, 5], [3, 1, 4], [5, 4, 2]]]
    np.testing.assert_allclose(
        solid_principal(stress), np.linalg.eigvalsh(full)[:, ::-1], atol=1e-7
    )


@pytest.mark.parametrize(
    ("shape", "natural"), [(HEXA8, HEX_CORNERS), (PENTA6, PENTA_CORNERS)]
)
def test_linear_motions_without_bubble_functions(shape, natural):
    """IN TWO: uniform strain is felt on any shape, and carried on skewed boxes."""
    way = shape.integration["TWO", "REDUCED"]
    matrix = isotropic_solid(E, NU)
    gradient = np.array([[1.0, 0.3, -0.2], [0.1, -0.4, 0.5], [0.7, 0.2, 0.6]])
    strain = [*np.diag(gradient), *(gradient + gradient.T)[[0, 1, 2], [1, 2, 0]]]
    skew = natural @ np.array([[1.0, 0.2, 0.0], [0.1, 0.8, 0.3], [0.0, 0.2, 1.2]])
    for nodes in (skew, skew + 0.1 * np.sin(np.arange(natural.size)).reshape(-1, 3)):
        found = way(nodes[None], matrix[None])
        moved = (nodes @ gradient.T).ravel()
        stress = np.einsum("psn,n->ps", found.stress[0], moved)
        np.testing.assert_allclose(stress, np.tile(matrix @ strain, (len(stress), 1)))
        spin = np.cross([0.3, -0.2, 0.5], nodes).ravel()
        assert np.abs(found.stiffness[0] @ spin).max() < 1e-9 * E
    plain = shape.integration["TWO", "FULL"](skew[None], matrix[None]).stiffness[0]
    moved = (skew @ gradient.T).ravel()
    force = way(skew[None], matrix[None]).stiffness[0] @ moved
    np.testing.assert_allclose(force, plain @ moved, atol=1e-9 * E)
