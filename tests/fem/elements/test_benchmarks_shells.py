"""Shells and solids against published benchmarks, with mesh convergence.

MacNeal and Harder (1985), NAFEMS R0015 and R0016. Refinements must come closer, or be
within the tolerance that is named; coarse figures are pinned as a record.
"""

import numpy as np
import pytest
from shell_model import Model, grid, isotropic_property, shells, triangles

from fem.elements.solids.hexa import HEXA8
from fem.elements.solids.solid import Solid
from fem.properties.elasticity import isotropic_solid


def tip_load(model, corner_grids, component, *, total=1.0):
    """Load on an edge, by the trapezoidal rule."""
    load = np.zeros((len(model.xyz), 6))
    weight = np.ones(len(corner_grids))
    weight[[0, -1]] = 0.5
    load[corner_grids, component] = total * weight / weight.sum()
    return load


def straight_beam(kind, nx=6):
    """MacNeal-Harder straight cantilever 6 x 0.2 x 0.1; tips over references."""
    points, conn = grid(nx, 1)
    xy = (points * [6.0, 0.2]).reshape(nx + 1, 2, 2)
    inner = np.zeros(nx + 1)
    inner[1:-1] = 0.1
    if kind == "trapezoids":
        sign = inner * (-1.0) ** np.arange(nx + 1)
        xy[:, 0, 0] -= sign
        xy[:, 1, 0] += sign
    elif kind == "parallelograms":
        xy[:, 0, 0] -= inner
        xy[:, 1, 0] += inner
    xyz = np.c_[xy.reshape(-1, 2), np.zeros(2 * nx + 2)]
    model = Model(xyz, [shells(xyz, conn, isotropic_property(1e7, 0.3, 0.1))])
    model.fix([0, 1], "123456")
    ratios = []
    for component, reference in ((0, 3.0e-5), (1, 0.1081), (2, 0.4321), (3, 0.03208)):
        u = model.solve(tip_load(model, [2 * nx, 2 * nx + 1], component))
        ratios.append(u[-2:, component].mean() / reference)
    return np.array(ratios)


def test_straight_beam():
    # extension, in-plane shear, out-of-plane shear, twist.
    expected = {
        "rectangles": [0.996, 0.990, 0.987, 0.953],
        # Four nodes that pass the patch test must lock here (MacNeal 1987).
        "trapezoids": [0.999, 0.052, 0.981, 0.944],
        "parallelograms": [0.999, 0.631, 0.992, 0.863],
    }
    for kind, ratios in expected.items():
        np.testing.assert_allclose(straight_beam(kind), ratios, atol=2e-3)
    fine = straight_beam("trapezoids", nx=96)
    assert fine[1] == pytest.approx(1.0, abs=0.03)


def curved_beam(nx, ny=1):
    points, conn = grid(nx, ny)
    r, angle = 4.12 + 0.2 * points[:, 1], 0.5 * np.pi * (1.0 - points[:, 0])
    xyz = np.c_[r * np.cos(angle), r * np.sin(angle), 0.0 * r]
    model = Model(xyz, [shells(xyz, conn, isotropic_property(1e7, 0.25, 0.1))])
    model.fix(np.arange(ny + 1), "123456")
    tip = np.arange(len(xyz) - ny - 1, len(xyz))
    ratios = []
    for component, reference in ((0, 0.08734), (2, 0.5022)):
        u = model.solve(tip_load(model, tip, component))
        ratios.append(u[tip, component].mean() / reference)
    return np.array(ratios)


def test_curved_beam():
    # OptiStruct's CQUAD4 on this mesh: 0.952, 0.955; MSC (1985): 0.833, 0.951.
    np.testing.assert_allclose(curved_beam(6), [0.885, 0.956], atol=2e-3)
    np.testing.assert_allclose(curved_beam(24), [1.012, 0.963], atol=3e-3)


def twisted_beam(refinement, *, corners=4, thickness=0.32):
    nx, ny = 12 * refinement, 2 * refinement
    points, conn = grid(nx, ny)
    angle, across = 0.5 * np.pi * points[:, 0], 1.1 * (points[:, 1] - 0.5)
    xyz = np.c_[12.0 * points[:, 0], across * np.cos(angle), across * np.sin(angle)]
    conn = conn if corners == 4 else triangles(conn)
    prop = isotropic_property(29e6, 0.22, thickness)
    model = Model(xyz, [shells(xyz, conn, prop)])
    model.fix(np.arange(ny + 1), "123456")
    tip = np.arange(len(xyz) - ny - 1, len(xyz))
    found = []
    for component in (2, 1):
        u = model.solve(tip_load(model, tip, component))
        found.append(u[tip[ny // 2], component])
    return np.array(found)


def test_twisted_beam():
    """OptiStruct's CQUAD4 on 12 x 2: 0.992, 0.988 (warped elements)."""
    reference = [0.005424, 0.001754]
    coarse = twisted_beam(1) / reference
    fine = twisted_beam(4) / reference
    np.testing.assert_allclose(coarse, [0.9937, 0.9887], atol=1e-3)
    np.testing.assert_allclose(fine, 1.0, atol=3e-3)
    triangular = twisted_beam(4, corners=3) / reference
    np.testing.assert_allclose(triangular, [0.996, 0.975], atol=3e-3)


def test_thin_twisted_beam_does_not_lock():
    """Thickness 0.0032 (Belytschko 1989): 5256e-6 and 1294e-6 for a load of 1e-6.

    Normals at the grids that are means of elements instead of corners cost 2.4 % in
    plane on 12 x 2: those at the edges are a quarter of an element off.
    """
    reference = np.array([5256e-6, 1294e-6])
    coarse, fine = (twisted_beam(n, thickness=0.0032) * 1e-6 for n in (1, 2))
    np.testing.assert_allclose(coarse / reference, [1.002, 0.988], atol=2e-3)
    np.testing.assert_allclose(fine / reference, [0.997, 0.996], atol=2e-3)


def scordelis_lo(n, corners=4):
    points, conn = grid(n, n)
    angle = np.radians(40.0) * points[:, 1]
    xyz = np.c_[25.0 * points[:, 0], 25.0 * np.sin(angle), 25.0 * np.cos(angle)]
    conn = conn if corners == 4 else triangles(conn)
    model = Model(xyz, [shells(xyz, conn, isotropic_property(4.32e8, 0.0, 0.25))])
    x, y = points.T
    model.fix(x == 0, "23")
    model.fix(x == 1, "156")
    model.fix(y == 0, "246")
    load = np.zeros((len(xyz), 6))
    share = 90.0 * model.blocks[0].extent / conn.shape[1]
    for k in range(conn.shape[1]):
        np.add.at(load[:, 2], conn[:, k], -share)
    return -model.solve(load)[(x == 1) & (y == 1), 2][0] / 0.3024


def test_scordelis_lo_roof():
    """OptiStruct's CQUAD4, N = 2, 4, 6, 8, 10: 1.487 1.082 1.035 1.020 1.013."""
    found = [scordelis_lo(n) for n in (2, 4, 8, 16, 32)]
    np.testing.assert_allclose(
        found, [1.4273, 1.0598, 1.0124, 1.0017, 0.9989], atol=2e-3
    )
    # Constant strain in the plane converges from the stiff side, slowly.
    coarse, fine = scordelis_lo(16, 3), scordelis_lo(32, 3)
    assert 0.95 < coarse < fine < 1.0
    assert fine > 0.985


def hemisphere(n, corners=4):
    points, conn = grid(n, n)
    round_, up = 0.5 * np.pi * points[:, 0], np.radians(72.0) * points[:, 1]
    xyz = (
        10.0
        * np.c_[np.cos(up) * np.cos(round_), np.cos(up) * np.sin(round_), np.sin(up)]
    )
    conn = conn if corners == 4 else triangles(conn)
    model = Model(xyz, [shells(xyz, conn, isotropic_property(6.825e7, 0.3, 0.04))])
    x, y = points.T
    model.fix(x == 0, "246")
    model.fix(x == 1, "156")
    first, second = (x == 0) & (y == 0), (x == 1) & (y == 0)
    model.fix(first, "3")
    load = np.zeros((len(xyz), 6))
    load[first, 0], load[second, 1] = 1.0, -1.0
    return model.solve(load)[first, 0][0] / 0.094


def test_hemisphere_with_hole():
    """Reference 0.094; later computations converge to about 0.0935 (0.995).

    MSC (1985), N = 4, 8, 12: 1.024, 1.005, 0.998 (from memory).
    """
    found = [hemisphere(n) for n in (4, 8, 16)]
    np.testing.assert_allclose(found, [1.012, 1.006, 0.997], atol=3e-3)
    assert hemisphere(16, 3) == pytest.approx(0.992, abs=3e-3)


def plate_center(n, b, *, clamped, point):
    """Quarter of MacNeal and Harder's rectangular plate, deflection of the center."""
    points, conn = grid(n, n)
    xyz = np.c_[points * [1.0, 0.5 * b], np.zeros(len(points))]
    model = Model(xyz, [shells(xyz, conn, isotropic_property(1.7472e7, 0.3, 1e-4))])
    x, y = points.T
    model.fix(slice(None), "126")
    model.fix(x == 0, "5")
    model.fix(y == 0, "4")
    model.fix((x == 1) | (y == 1), "345" if clamped else "3")
    if not clamped:
        model.fix(x == 1, "4")
        model.fix(y == 1, "5")
    load = np.zeros((len(xyz), 6))
    if point:
        load[0, 2] = 1e-4
    else:
        for k in range(4):
            np.add.at(load[:, 2], conn[:, k], 1e-4 * model.blocks[0].extent / 4)
    return model.solve(load)[0, 2]


@pytest.mark.parametrize(
    ("clamped", "point", "b", "reference"),
    [
        (False, False, 2, 4.062), (False, False, 10, 12.97),
        (False, True, 2, 11.60), (False, True, 10, 16.96),
        (True, False, 2, 1.26), (True, False, 10, 2.56),
        (True, True, 2, 5.60), (True, True, 10, 7.23),
    ],
)  # fmt: skip
def test_rectangular_plate_converges(clamped, point, b, reference):
    found = [
        plate_center(n, b, clamped=clamped, point=point) / reference for n in (4, 16)
    ]
    # 1.26 and 2.56 have three digits; aspect 5 with a point load is hard.
    assert found[0] == pytest.approx(1.0, abs=0.13 if b == 10 and point else 0.06)
    assert found[1] == pytest.approx(1.0, abs=0.018)


FV11 = [2.377, 5.942, 5.942, 9.507, 11.884, 11.884]
FV12 = [1.622, 2.360, 2.922, 4.233, 4.233, 7.416]
FV16 = [0.421, 1.029, 2.582, 3.306, 3.753, 6.555]
FV32 = [44.623, 130.03, 162.70, 246.05, 379.90, 391.44]


def square_plate(n, case, *, coupled, corners=4):
    points, conn = grid(n, n)
    xyz = np.c_[10.0 * points, np.zeros(len(points))]
    conn = conn if corners == 4 else triangles(conn)
    prop = isotropic_property(200e9, 0.3, 0.05, 8000.0)
    model = Model(xyz, [shells(xyz, conn, prop)])
    x, y = points.T
    model.fix(slice(None), "126")
    if case == "FV11":
        model.fix((x == 0) | (x == 1) | (y == 0) | (y == 1), "3")
        model.fix((x == 0) | (x == 1), "4")
        model.fix((y == 0) | (y == 1), "5")
        return model.frequencies(6, coupled=coupled) / FV11
    if case == "FV16":
        model.fix(x == 0, "345")
        return model.frequencies(6, coupled=coupled) / FV16
    found = model.frequencies(9, coupled=coupled)
    assert (found[:3] < 1e-3).all()
    return found[3:] / FV12


@pytest.mark.parametrize("case", ["FV11", "FV12", "FV16"])
def test_plate_frequencies(case):
    """Coupled and lumped mass bracket the reference on a coarse mesh."""
    coarse = square_plate(8, case, coupled=True)
    fine = square_plate(16, case, coupled=True)
    np.testing.assert_allclose(fine[:3], 1.0, atol=0.01)
    np.testing.assert_allclose(fine, 1.0, atol=0.025)
    assert np.abs(fine - 1.0).mean() < np.abs(coarse - 1.0).mean()
    lumped = square_plate(16, case, coupled=False)
    np.testing.assert_allclose(lumped, 1.0, atol=0.03)
    assert (lumped < fine).all()


@pytest.mark.parametrize("case", ["FV11", "FV12", "FV16"])
def test_plate_frequencies_of_triangles(case):
    fine = square_plate(16, case, coupled=False, corners=3)
    np.testing.assert_allclose(fine, 1.0, atol=0.035)


def test_tapered_membrane_frequencies():
    ratios = []
    for n in (1, 2):
        points, conn = grid(16 * n, 8 * n)
        x, y = points.T
        xyz = np.c_[10.0 * x, (y - 0.5) * (5.0 - 4.0 * x), 0.0 * x]
        prop = isotropic_property(200e9, 0.3, 0.05, 8000.0)
        model = Model(xyz, [shells(xyz, conn, prop)])
        model.fix(slice(None), "3456")
        model.fix(x == 0, "12")
        ratios.append(model.frequencies(6) / FV32)
    np.testing.assert_allclose(ratios[0], 1.0, atol=0.015)
    np.testing.assert_allclose(ratios[1], 1.0, atol=0.005)


def thick_plate(n, layers):
    """FV52: solid square plate 10 x 10 x 1, uz = 0 along the lower edges."""
    points, conn = grid(n, n)
    planes = np.linspace(0.0, 1.0, layers + 1)
    xyz = np.concatenate(
        [np.c_[10.0 * points, np.full(len(points), z)] for z in planes]
    )
    bricks = np.concatenate(
        [
            np.c_[conn + k * len(points), conn + (k + 1) * len(points)]
            for k in range(layers)
        ]
    )
    prop = isotropic_property(200e9, 0.3, 1.0, 8000.0)
    count = len(bricks)
    block = Solid(
        card="CHEXA",
        id=np.arange(1, count + 1),
        dof=(6 * bricks[:, :, None] + np.arange(3)).reshape(count, -1),
        pid=np.ones(count, np.int64),
        shape=HEXA8,
        nodes=xyz[bricks],
        elasticity=np.repeat(isotropic_solid(200e9, 0.3)[None], count, axis=0),
        axes=np.repeat(np.eye(3)[None], count, axis=0),
        rho=np.full(count, prop.density),
        ge=np.zeros(count),
        alpha=np.zeros((count, 6)),
        tref=np.zeros(count),
    )
    model = Model(xyz, [block])
    x, y = xyz[:, 0] / 10.0, xyz[:, 1] / 10.0
    edge = (x == 0) | (x == 1) | (y == 0) | (y == 1)
    model.fix(edge & (xyz[:, 2] == 0.0), "3")
    model.fix(slice(None), "456")
    return model.frequencies(10, coupled=True)


def test_solid_plate_frequencies():
    """Bending and in-plane modes of a thick plate of bricks.

    Supports along a line yield without limit when solids are refined: the frequencies
    of bending fall below the plate's (0.947 of it at 20 x 20 x 6): no convergence.
    """
    reference = [45.897, 109.44, 109.44, 167.89, 193.59, 206.19, 206.19]
    coarse, fine = (thick_plate(n, 2) / ([1.0] * 3 + reference) for n in (8, 12))
    assert (fine[:3] < 0.1).all()
    np.testing.assert_allclose(coarse[3:], 1.0, atol=0.05)
    np.testing.assert_allclose(fine[3:], 1.0, atol=0.035)
    np.testing.assert_allclose(fine[7:], 1.0, atol=0.01)  # in-plane


def test_cantilever_plate_between_the_solvers():
    """1.0 x 0.3 x 0.01 m, 10 x 4: NASTRAN-95, OpenSees, CalculiX S8R."""
    points, conn = grid(10, 4)
    xyz = np.c_[points * [1.0, 0.3], np.zeros(len(points))]
    prop = isotropic_property(7e10, 0.3, 0.01, 2700.0)
    model = Model(xyz, [shells(xyz, conn, prop)])
    model.fix(points[:, 0] == 0, "123456")
    found = model.frequencies(3, coupled=True)
    others = np.array(
        [
            [8.3752, 53.1421, 56.4987],
            [8.3925, 53.6865, 57.1393],
            [8.4595, 52.8788, 56.9077],
        ]
    )
    # The torsion mode of elements 4 by 3 is 0.4 % softer than NASTRAN-95's.
    assert (found > 0.996 * others.min(axis=0)).all()
    assert (found < 1.001 * others.max(axis=0)).all()
    load = np.zeros((len(xyz), 6))
    load[50, 2] = 10.0
    # NASTRAN-95 .001927512, OpenSees .001920661, CalculiX .001901791; meshes of ours
    # four times as fine go to 1.0027 of the first, this one is at 1.0012.
    assert model.solve(load)[50, 2] == pytest.approx(0.001927512, rel=2e-3)
