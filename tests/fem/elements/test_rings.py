"""CTRIAX6: Lamé's cylinder, spinning discs, spheres, commercial figures, messages."""

import numpy as np
import pytest

from benchmarks.verification.rings import RINGS
from benchmarks.verification.runner import run
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.structure import Structure

E, NU, RHO = 2e11, 0.3, 7800.0
A, B = 1.0, 2.0


def mesh(n, heights, place):
    """Two triangles in each of n by m cells; place(s, t) -> r, z; grids and cards."""
    count = 2 * heights + 1

    def ids(i, j):
        return 1 + i * count + j

    lines, number = [], 0
    for i in range(2 * n + 1):
        for j in range(count):
            r, z = place(i / (2 * n), j / (2 * heights))
            lines.append(f"GRID,{ids(i, j)},,{r!r},0.,{z!r}")
    for i in range(0, 2 * n, 2):
        for j in range(0, 2 * heights, 2):
            lower = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 1)]
            upper = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
            for ring in (lower, upper):
                number += 1
                grids = [str(ids(i + a, j + b)) for a, b in ring]
                lines.append(f"CTRIAX6,{number},1,{','.join(grids)}")
    return "\n".join(lines) + "\n", ids


MATERIAL = f"MAT1,1,{E},,{NU},{RHO},1.2-5\n"


def solve(bulk, held, case="LOAD = 1\n"):
    case = f"SPC = 1\nDISP = ALL\nSTRESS = ALL\n{case}"
    text = f"{bulk}{MATERIAL}SPC1,1,2456,1,THRU,99999\n{held}"
    return run(f"SOL 101\nCEND\n{case}BEGIN BULK\n{text}\nENDDATA\n")


def plane(heights, ids, n):
    """Axial motion held at both faces: plane strain."""
    rows = [ids(i, j) for i in range(2 * n + 1) for j in (0, 2 * heights)]
    return "".join(f"SPC1,1,3,{g}\n" for g in rows)


def test_thick_cylinder_under_inner_pressure():
    """Lamé in plane strain; pressure into the elements by both cards."""
    n, p = 6, 1e6
    bulk, ids = mesh(n, 1, lambda s, t: (A + s * (B - A), 0.5 * t))
    held = plane(1, ids, n)
    c = p * A**2 / (B**2 - A**2)
    first = (1.0 + NU) / E * c
    for load in (
        f"PLOADX,1,{p},{p},{ids(0, 2)},{ids(0, 1)},{ids(0, 0)}\n",
        f"PLOADX1,1,2,{p},,{ids(0, 0)},{ids(0, 2)}\n",
    ):
        found = solve(bulk + load, held)
        r = np.array([A, B])
        u = found["static/1/displacement"][[ids(0, 0) - 1, ids(2 * n, 0) - 1], 0]
        np.testing.assert_allclose(u, first * ((1 - 2 * NU) * r + B**2 / r), rtol=1e-3)
        table = "static/1/element_stress/CTRIAX6"
        middle = 2 * n - 1  # the upper ring beside the outer face
        hoop = found.column(table, "azimuthal")[middle]
        radius = B - (B - A) / n * 2 / 3
        assert hoop == pytest.approx(c * (1 + B**2 / radius**2), rel=2e-3)


def test_pressure_turned_by_theta_pulls_along_the_axis():
    """A right angle counter-clockwise from inward at the inner wall: upwards."""
    bulk, ids = mesh(1, 1, lambda s, t: (A + s * (B - A), t))
    load = f"PLOADX1,1,2,1000.,,{ids(0, 0)},{ids(0, 2)},90.\n"
    held = "".join(f"SPC1,1,3,{ids(i, 0)}\n" for i in range(3))
    found = solve(bulk + load, held, "LOAD = 1\nSPCFORCES = ALL\n")
    total = found["static/1/spc_force"][:, 2].sum()
    assert total == pytest.approx(-1000.0 * 2.0 * np.pi * A, rel=1e-9)


def test_forces_are_those_of_the_whole_circle():
    bulk, ids = mesh(2, 1, lambda s, t: (A + s * (B - A), t))
    area = np.pi * (B**2 - A**2)
    # Shares of a linear radius over each quadratic side: exact uniform tension.
    load = "".join(
        f"FORCE,1,{ids(i, 2)},,{f!r},0.,0.,1.\n" for i, f in enumerate(_ring_shares(2))
    )
    held = "".join(f"SPC1,1,3,{ids(i, 0)}\n" for i in range(5))
    found = solve(bulk + load, held)
    u = found["static/1/displacement"][ids(0, 2) - 1, 2]
    assert u == pytest.approx(1e6 / area / E, rel=1e-9)
    axial = found.column("static/1/element_stress/CTRIAX6", "axial")
    np.testing.assert_allclose(axial, 1e6 / area, rtol=1e-9)


def _ring_shares(n):
    """Nodal shares of 1e6 N spread evenly over the annulus."""
    x, w = np.polynomial.legendre.leggauss(4)
    total = np.zeros(2 * n + 1)
    for k in range(n):
        r = A + (k + 0.5 * (1 + x)) * (B - A) / n
        shapes = [0.5 * x * (x - 1), 1 - x * x, 0.5 * x * (x + 1)]
        for j, shape in enumerate(shapes):
            total[2 * k + j] += (w * r * shape).sum()
    return (1e6 * total / total.sum()).tolist()


@pytest.mark.parametrize("coupled", [-1, 1])
def test_spinning_disc(coupled):
    """Solid disc, plane stress: hoop stress at the axis (3 + nu)/8 rho w^2 b^2."""
    n, hertz = 8, 10.0
    bulk, ids = mesh(n, 1, lambda s, t: (B * s, 0.01 * t))
    load = f"RFORCE,1,,,{hertz},0.,0.,1.\nPARAM,COUPMASS,{coupled}\n"
    found = solve(bulk + load, "".join(f"SPC1,1,3,{ids(i, 0)}\n" for i in range(17)))
    square = RHO * (2 * np.pi * hertz) ** 2
    u = found["static/1/displacement"][ids(2 * n, 0) - 1, 0]
    assert u == pytest.approx(square * B**3 * (1 - NU) / (4 * E), rel=5e-3)
    hoop = found.column("static/1/element_stress/CTRIAX6", "c1_azimuthal")[0]
    expected = (3 + NU) / 8 * square * B**2
    assert hoop == pytest.approx(expected, rel=0.01 if coupled > 0 else 0.05)


def test_sphere_under_inner_pressure():
    """u = p a^3 r / (E (b^3 - a^3)) (1 - 2 nu + (1 + nu) b^3 / (2 r^3))."""
    n, m, p = 4, 6, 1e6

    def place(s, t):
        r, angle = A + s * (B - A), 0.5 * np.pi * t
        return (r * np.cos(angle), r * np.sin(angle))

    bulk, ids = mesh(n, m, place)
    lines = [bulk]
    for j in range(0, 2 * m, 2):
        lines.append(f"PLOADX,1,{p},{p},{ids(0, j + 2)},{ids(0, j + 1)},{ids(0, j)}\n")
    equator = "".join(f"SPC1,1,3,{ids(i, 0)}\n" for i in range(2 * n + 1))
    pole = "".join(f"SPC1,1,1,{ids(i, 2 * m)}\n" for i in range(2 * n + 1))
    found = solve("".join(lines), equator + pole)
    u = found["static/1/displacement"]
    for r, at in ((A, ids(0, 0)), (B, ids(2 * n, 0))):
        expected = p * A**3 * r / (E * (B**3 - A**3))
        expected *= 1 - 2 * NU + (1 + NU) * B**3 / (2 * r**3)
        assert u[at - 1, 0] == pytest.approx(expected, rel=0.01)
    pole_u = u[ids(2 * n, 2 * m) - 1, 2]
    assert pole_u == pytest.approx(u[ids(2 * n, 0) - 1, 0], rel=2e-3)


def test_heat_leaves_no_stress_and_mass_is_that_of_the_body():
    bulk, ids = mesh(2, 2, lambda s, t: (A + s * (B - A), t))
    held = f"SPC1,1,3,{ids(0, 0)}\n"
    found = solve(bulk + "TEMPD,3,50.\n", held, "TEMP(LOAD) = 3\n")
    assert np.abs(found["static/1/element_stress/CTRIAX6/value"]).max() < 1e-3
    u = found["static/1/displacement"][ids(4, 4) - 1]
    np.testing.assert_allclose(u[[0, 2]], [1.2e-5 * 50 * B, 1.2e-5 * 50], rtol=1e-9)
    assert found["mass/total"] == pytest.approx(RHO * np.pi * (B**2 - A**2))


def test_two_rings_as_msc_prints_them():
    """E, G and nu contradict each other, the material is turned by 30 degrees."""
    case = "SPC = 1\nLOAD = 2\nDISP = ALL\nSTRESS = ALL"
    found = run(f"SOL 101\nCEND\n{case}\nBEGIN BULK\n{RINGS}\nENDDATA\n")
    u = found["static/1/displacement"][:, [0, 2]]
    expected = {0: (-0.2956416, -0.02246387), 4: (-0.4104635, -0.3183309)}
    expected |= {6: (-0.5260662, -0.01578419), 10: (-0.3184438, 0.3062404)}
    for row, pair in expected.items():
        np.testing.assert_allclose(u[row], pair, rtol=5e-7)
    stress = found["static/1/element_stress/CTRIAX6/value"].reshape(2, 4, 7)
    center = (-0.01862618, -0.09067669, -0.007052219, 0.01002714, -0.09067669)
    center += (0.04470737, 0.08037893)
    np.testing.assert_allclose(stress[0, 0], center, rtol=1e-6)
    corner = (-0.01728463, -0.12909100, -0.01793208, 0.00292081, -0.12909100)
    corner += (0.05721067, 0.11159878)
    np.testing.assert_allclose(stress[1, 3], corner, rtol=2e-6)


def test_mat3_of_one_kind_is_mat1(tmp_path):
    def stiffness(material):
        bulk, _ = mesh(1, 1, lambda s, t: (A + s, t))
        path = tmp_path / "deck.bdf"
        path.write_text(f"SOL 101\nCEND\nBEGIN BULK\n{bulk}{material}ENDDATA\n")
        return Structure.from_deck(read_deck(path)).matrices.stiffness.toarray()

    g = E / (2 * (1 + NU))
    same = f"MAT3,1,{E},{E},{E},{NU},{NU},{NU}\n,,,{g}\n"
    k = stiffness(MATERIAL)
    np.testing.assert_allclose(stiffness(same), k, atol=1e-9 * np.abs(k).max())
    with pytest.raises(InputError, match="give energy away"):
        stiffness(f"MAT3,1,{E},{E},{E},.3,.3,5.\n,,,{g}\n")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("GRID,5304,,4.238,0.,3.", "GRID,5304,,4.238,.5,3.", "off the x-z plane"),
        ("GRID,5305,,2.536", "GRID,5305,,-2.536", "radius .x. below 0"),
        ("GRID,5305,,2.536,0.,2.", "GRID,5305,,6.,0.,8.", "no area"),
        ("5311,.0222139,.0333209,5311,5313", "5311,1.,1.,5311,5312", "are no side"),
        ("MAT1,1,1.,.8,.1", "MAT1,1,0.,.8,.1", "expected E and G above 0"),
    ],
)
def test_what_is_no_ring_is_named(old, new, message):
    text = RINGS.replace(old, new)
    assert text != RINGS
    case = "SPC = 1\nLOAD = 2"
    with pytest.raises(InputError, match=message):
        run(f"SOL 101\nCEND\n{case}\nBEGIN BULK\n{text}\nENDDATA\n")
