"""CPLSTN and CPLSTS: patch test, Lamé, a bent strip, NX's stresses, messages."""

import numpy as np
import pytest

from benchmarks.verification.runner import run
from fem.errors import InputError

E, NU, T = 2e8, 0.25, 0.7
COUNTS = (3, 4, 6, 8)
MATERIAL = f"PPLANE,1,1,{T},.5\nMAT1,1,{E},,{NU},3.,1.-5\n"


def grid(i, x, z, plane="xz"):
    y, w = (0.0, z) if plane == "xz" else (z, 0.0)
    return f"GRID,{i},,{x!r},{y!r},{w!r}\n"


def mesh(count, n, m, place, kind="N", plane="xz"):
    """Cells n by m of one card; place(s, t) -> coordinates in the plane."""
    half = 2 if count in (6, 8) else 1
    rows, columns = half * m + 1, half * n + 1

    def ids(i, j):
        return 1 + i * rows + j

    text = "".join(
        grid(ids(i, j), *place(i / (columns - 1), j / (rows - 1)), plane)
        for i in range(columns)
        for j in range(rows)
    )
    h, number = half, 0
    for i in range(0, columns - 1, h):
        for j in range(0, rows - 1, h):
            square = [(0, 0), (h, 0), (h, h), (0, h)]
            rings = (
                [square] if count in (4, 8) else [square[:3], square[::2] + square[3:]]
            )
            for ring in rings:
                number += 1
                middles = [
                    ((a + c) // 2, (b + d) // 2)
                    for (a, b), (c, d) in zip(ring, ring[1:] + ring[:1])
                ]
                nodes = [*ring, *(middles if half == 2 else [])]
                names = [str(ids(i + a, j + b)) for a, b in nodes]
                head = f"CPLST{kind}{count},{number},1,"
                text += head + ",".join(names[:6]) + "\n"
                if names[6:]:
                    text += "," + ",".join(names[6:]) + "\n"
    return text, ids, rows, columns


def solve(bulk, case="SPC = 1\nDISP = ALL\nSTRESS = ALL\nSTRAIN = ALL"):
    case += "\nLOAD = 1" * ("FORCE" in bulk)
    return run(f"SOL 101\nCEND\n{case}\nBEGIN BULK\n{bulk}{MATERIAL}ENDDATA\n")


def skewed(s, t):
    """The inner grids of a square off their places."""
    inside = s * (1 - s) * t * (1 - t)
    return 3.0 * s + 4.0 * inside, 2.0 * t - 3.0 * inside


@pytest.mark.parametrize("plane", ["xz", "xy"])
@pytest.mark.parametrize("kind", ["N", "S"])
@pytest.mark.parametrize("count", COUNTS)
def test_uniform_strain_is_passed_on(count, kind, plane):
    """Straight sides: mid-sides in their middle; displacements of the rim are given."""
    half = 2 if count in (6, 8) else 1

    def place(s, t):
        if half == 1:
            return skewed(s, t)
        a, b = np.floor(s * 2 + 1e-9) / 2, np.ceil(s * 2 - 1e-9) / 2
        c, d = np.floor(t * 2 + 1e-9) / 2, np.ceil(t * 2 - 1e-9) / 2
        corners = np.array([skewed(x, y) for x in (a, b) for y in (c, d)])
        return tuple(corners.mean(axis=0).tolist())

    text, ids, rows, columns = mesh(count, 2, 2, place, kind, plane)
    first, second = 1, 3 if plane == "xz" else 2
    rim = ""
    for i in range(columns):
        for j in range(rows):
            x, z = place(i / (columns - 1), j / (rows - 1))
            u, w = 1e-3 * x + 4e-4 * z, 2e-4 * x - 5e-4 * z
            if i in (0, columns - 1) or j in (0, rows - 1):
                rim += f"SPC,1,{ids(i, j)},{first},{u!r}\n"
                rim += f"SPC,1,{ids(i, j)},{second},{w!r}\n"
    found = solve(text + rim)
    table = f"static/1/element_stress/CPLST{kind}{count}"
    got = {name: found.column(table, name) for name in ("oxx", "oyy", "ozz", "shear")}
    mu, bulk = E / (2 * (1 + NU)), E / (1 - NU**2)
    if kind == "S":
        a, b, across = bulk * (1e-3 - NU * 5e-4), bulk * (NU * 1e-3 - 5e-4), 0.0
    else:
        lame = E * NU / ((1 + NU) * (1 - 2 * NU))
        a, b = (2 * mu * e + lame * 5e-4 for e in (1e-3, -5e-4))
        across = lame * 5e-4
    b_name, c_name = ("ozz", "oyy") if plane == "xz" else ("oyy", "ozz")
    np.testing.assert_allclose(got["oxx"], a, rtol=1e-9)
    np.testing.assert_allclose(got[b_name], b, rtol=1e-9)
    np.testing.assert_allclose(got[c_name], across, atol=1e-6 * a)
    np.testing.assert_allclose(got["shear"], mu * 6e-4, rtol=1e-9)
    strain = found.column(f"static/1/element_strain/CPLST{kind}{count}", c_name)
    thin = -NU / E * (a + b) if kind == "S" else 0.0
    np.testing.assert_allclose(strain, thin, atol=1e-12)


@pytest.mark.parametrize(("count", "error"), [(4, 2e-3), (6, 2e-3), (8, 1e-3)])
def test_a_bent_strip(count, error):
    """Tip of a cantilever 10 x 1 in plane stress: beam theory with shear."""
    text, ids, rows, columns = mesh(count, 12, 2, lambda s, t: (10 * s, t), "S")
    held = "".join(f"SPC1,1,13,{ids(0, j)}\n" for j in range(rows))
    z = np.linspace(0.0, 1.0, rows)
    share = np.zeros(rows)
    x, w = np.polynomial.legendre.leggauss(6)
    for s, weight in zip(0.5 * (1 + x), 0.5 * w):  # parabolic shear at the end
        hats = np.array([np.interp(s, z, row) for row in np.eye(rows)])
        share += weight * 6 * s * (1 - s) * hats
    load = "".join(
        f"FORCE,1,{ids(columns - 1, j)},,{f!r},0.,0.,1.\n"
        for j, f in enumerate((share / share.sum()).tolist())
    )
    found = solve(text + held + load)
    u = found["static/1/displacement"][ids(columns - 1, 0) - 1, 2]
    inertia = T / 12.0
    bending = 1000.0 / (3 * E * inertia)
    shear = 10.0 * 1.2 / (T * E / (2 * (1 + NU)))
    assert u == pytest.approx(bending + shear, rel=5 * error)


def test_mass_is_that_of_density_thickness_and_what_is_not_structural():
    for count in COUNTS:
        text, *_ = mesh(count, 2, 1, lambda s, t: (2 * s, t), "S")
        found = solve(text + "SPC1,1,123,1,THRU,99\n")
        assert found["mass/total"] == pytest.approx(2.0 * (3.0 * T + 0.5))


def test_heat_of_plane_stress_and_none_of_plane_strain():
    case = "SPC = 1\nTEMP(LOAD) = 3\nDISP = ALL\nSTRESS = ALL"
    text, ids, _, _ = mesh(4, 2, 2, skewed, "S")
    held = f"SPC1,1,13,1\nSPC1,1,3,{ids(2, 0)}\nTEMPD,3,50.\n"
    found = solve(text + held, case)
    stress = found["static/1/element_stress/CPLSTS4/value"]
    assert np.abs(stress).max() < 1e-9 * E * 1e-5 * 50
    u = found["static/1/displacement"][ids(2, 2) - 1]
    np.testing.assert_allclose(u[[0, 2]], [3 * 5e-4, 2 * 5e-4])
    text, ids, _, _ = mesh(4, 2, 2, skewed, "N")
    with pytest.raises(InputError, match="temperatures of plane strain"):
        solve(text + held, case)


# Grids, displacements and stresses at the center of NX: sx, across, sz, shear, Mises.
NX = {
    3: (
        [(20.0, 40.0), (20.0, 60.0), (0.0, 40.0)],
        [(-0.08901284, -0.00936257), (-0.08676793, 0.004084019), (0.0, 0.0)],
        [-1014368.0, -302265.0, -194692.3, -28470.69, 773108.4],
    ),
    4: (
        [(60.0, 80.0), (60.0, 60.0), (80.0, 60.0), (80.0, 80.0)],
        [
            (-0.2924192, 0.04285037),
            (-0.2862654, 0.008878442),
            (-0.3877906, 0.008114277),
            (-0.3941894, 0.04346156),
        ],
        [-1081133.9, -267952.4, 9324.497, -25411.04, 982629.3],
    ),
    6: (
        [
            *((160.5, 40.0), (140.5, 40.0), (140.5, 20.0)),
            *((150.5, 40.0), (140.5, 30.0), (150.5, 30.0)),
        ],
        [
            (-1.398899, -0.07726336),
            (-1.220024, -0.05519792),
            (-1.173227, -0.1294782),
            (-1.300938, -0.06581179),
            (-1.197533, -0.09816367),
            (-1.262742, -0.1224762),
        ],
        [-1357590.9, -185030.1, 617470.5, -425195.3, 1871432.6],
    ),
    8: (
        [
            *((120.5, 60.0), (140.5, 60.0), (140.5, 80.0), (120.5, 80.0)),
            *((130.5, 60.0), (140.5, 70.0), (130.5, 80.0), (120.5, 70.0)),
        ],
        [
            (-1.099449, 0.0220369),
            (-1.228914, 0.04450415),
            (-1.198299, 0.121368),
            (-1.097647, 0.07383592),
            (-1.15957, 0.03123416),
            (-1.21553, 0.0895437),
            (-1.148422, 0.09321482),
            (-1.098146, 0.04944674),
        ],
        [-1160682.9, -221612.5, 274232.8, 204979.9, 1311258.8],
    ),
}
CORNERS = {
    4: [-1082440.9, -270112.9, 1989.249, -25411.04, 978207.3],
    6: [-1946131.6, -242371.2, 976646.8, -518915.5, 2696950.0],
}


@pytest.mark.parametrize("count", COUNTS)
def test_stresses_under_nx_displacements(count):
    """Their deck conedg01e, one element of each card; digits of single precision."""
    places, moved, stress = NX[count]
    text = "".join(grid(k + 1, *at) for k, at in enumerate(places))
    names = [str(k + 1) for k in range(count)]
    text += f"CPLSTN{count},1,1,{','.join(names[:6])}\n"
    text += f",{','.join(names[6:])}\n" if names[6:] else ""
    for k, (u, w) in enumerate(moved):
        text += f"SPC,1,{k + 1},1,{u!r}\nSPC,1,{k + 1},3,{w!r}\n"
    found = solve(text)
    values = found[f"static/1/element_stress/CPLSTN{count}/value"][0].reshape(-1, 5)
    size = np.abs(stress).max()
    np.testing.assert_allclose(values[0], stress, atol=3e-6 * size)
    if count in CORNERS:
        np.testing.assert_allclose(values[1], CORNERS[count], atol=3e-5 * size)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("GRID,3,,20.0,0.0,20.0", "GRID,3,,20.0,5.0,20.0"), "lies off the plane"),
        (("1,1,2,3,4", "1,1,2,4,3"), "out of order"),
        (("1,1,2,3,4", "1,1,2,3,4,30.,.1"), "thicknesses at grids"),
        (("PPLANE,1,1", "PPLANE,2,1"), "PPLANE 1 is not defined"),
        ((f"MAT1,1,{E}", "MAT1,1,0."), "expected E above 0"),
    ],
)
def test_what_is_no_slice_is_named(change, message):
    text = "".join(
        grid(k + 1, *at)
        for k, at in enumerate([(0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0)])
    )
    deck = f"{text}CPLSTN4,1,1,1,2,3,4\nSPC1,1,13,1,2\n{MATERIAL}"
    assert change[0] in deck
    with pytest.raises(InputError, match=message):
        run(f"SOL 101\nCEND\nSPC = 1\nBEGIN BULK\n{deck.replace(*change)}ENDDATA\n")
