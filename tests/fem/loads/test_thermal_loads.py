"""Temperatures and DEFORM in statics: closed forms."""

import h5py
import numpy as np
import pytest

import fem
from fem.errors import InputError
from fem.solution import run_deck

E, NU, ALPHA = 7e10, 0.3, 2e-5
MAT1 = f"MAT1,1,7.+10,,.3,2700.,{ALPHA},20.\n"


@pytest.fixture
def solve(tmp_path):
    files = []

    def go(bulk, case="SPC = 1\nTEMP(LOAD) = 4"):
        path = tmp_path / "deck.bdf"
        asked = "FORCE = ALL\nSTRESS = ALL\nESE = ALL\n"
        path.write_text(f"SOL 101\nCEND\n{asked}{case}\nBEGIN BULK\n{bulk}ENDDATA\n")
        files.append(h5py.File(run_deck(fem.read_deck(path), tmp_path / "deck.h5")))
        return files[-1]

    yield go
    for file in files:
        file.close()


LINES = {
    "CROD": "CROD,1,1,1,2\nPROD,1,1,2.-4,1.-8\n",
    "CBAR": "CBAR,1,1,1,2,0.,1.,0.\nPBAR,1,1,2.-4,1.-8,1.-8,1.-8\n",
    "CBEAM": "CBEAM,1,1,1,2,0.,1.,0.\nPBEAM,1,1,2.-4,1.-8,1.-8,,1.-8\n",
}


@pytest.mark.parametrize("card", list(LINES))
def test_a_heated_line_between_walls(solve, card):
    """N = -E A alpha (T - TREF), along any direction; half as much at half the heat."""
    grids = "GRID,1,,1.,2.,3.\nGRID,2,,2.,4.,5.\nSPC1,1,123456,1,2\n"
    file = solve(grids + LINES[card] + MAT1 + "TEMPD,4,120.\nTEMP,4,1,20.\n")
    force = file[f"static/1/element_force/{card}"]
    columns = list(force.attrs["columns"])
    axial = next(k for k, name in enumerate(columns) if name.startswith("axial"))
    expected = -E * 2e-4 * ALPHA * 50.0
    assert force["value"][0, axial] == pytest.approx(expected, rel=1e-9)
    reaction = file["static/1/spc_force"][0, :3]
    np.testing.assert_allclose(reaction, -expected * np.array([1, 2, 2]) / 3, rtol=1e-9)


def test_a_free_bar_grows_without_force(solve):
    grids = "GRID,1\nGRID,2,,3.\nSPC1,1,123456,1\nTEMPD,4,120.\n"
    file = solve(grids + LINES["CBAR"] + MAT1)
    assert file["static/1/displacement"][1, 0] == pytest.approx(3.0 * ALPHA * 100.0)
    stress = file["static/1/element_stress/CBAR/value"][:]
    assert np.abs(stress).max() < 1e-6 * E * ALPHA * 100.0


@pytest.mark.parametrize("offset", ["", ",,+\n+,,,0.,.05,0.,0.,.05,0."])
def test_gradients_bend_a_cantilever(solve, offset):
    """v'' = -alpha T', linear from 300 to 600 per length; no force where it is free."""
    bar = LINES["CBAR"].replace("0.,1.,0.\n", f"0.,1.,0.{offset}\n", 1)
    grids = "GRID,1\nGRID,2,,3.\nSPC1,1,123456,1\nTEMPRB,4,1,20.,20.,300.,600.\n"
    file = solve(grids + bar + MAT1)
    moved = file["static/1/displacement"][1]
    v = -ALPHA * 9.0 * (300.0 / 3.0 + 600.0 / 6.0)
    slope = -ALPHA * 3.0 * 450.0
    assert moved[1] == pytest.approx(v, rel=1e-9)
    assert moved[5] == pytest.approx(slope, rel=1e-9)
    assert np.abs(file["static/1/element_force/CBAR/value"][:]).max() < 1e-6


def test_a_clamped_bar_under_a_gradient(solve):
    """A uniform gradient along y leaves E I alpha T' in it."""
    grids = "GRID,1\nGRID,2,,3.\nSPC1,1,123456,1,2\nTEMPRB,4,1,20.,20.,300.,300.\n"
    file = solve(grids + LINES["CBAR"] + MAT1)
    moments = file["static/1/element_force/CBAR/value"][0, [0, 2]]
    np.testing.assert_allclose(np.abs(moments), E * 1e-8 * ALPHA * 300.0, rtol=1e-9)


QUADS = "".join(
    f"GRID,{10 * j + i},,{i * 0.5 + 0.1 * (i == 1) * (j == 1):g},{j * 0.4:g},0.\n"
    for i in range(3)
    for j in range(3)
) + "".join(
    f"CQUAD4,{10 * j + i + 1},1,{10 * j + i},{10 * j + i + 1},"
    f"{10 * j + i + 11},{10 * j + i + 10}\n"
    for i in range(2)
    for j in range(2)
)
HELD = "SPC1,1,123456,0,1,2,10,11,12,20,21,22\n"


def plate(text):
    """With grids from 100 on: 0 is no id."""
    rows = []
    for line in text.splitlines():
        words = line.split(",")
        first = {"GRID": 1, "CQUAD4": 3, "SPC1": 3}[words[0]]
        last = 2 if words[0] == "GRID" else len(words)
        words[first:last] = [str(int(w) + 100) for w in words[first:last]]
        rows.append(",".join(words))
    return "\n".join(rows) + "\n"


def test_a_free_plate_grows_and_a_held_one_is_pressed(solve):
    shell = "PSHELL,1,1,.01,1,,1\n" + MAT1 + "TEMPD,4,70.\n"
    free = solve(plate(QUADS + "SPC1,1,123456,0\n") + shell)
    grown = free["static/1/displacement"][:, :2]
    np.testing.assert_allclose(
        grown, ALPHA * 50.0 * free["position"][:, :2], rtol=1e-8, atol=1e-13
    )
    stress = free["static/1/element_stress/CQUAD4/value"][:]
    pressed = -E * ALPHA * 50.0 / (1.0 - NU)
    assert np.abs(stress[:, [1, 2, 3, 9, 10, 11]]).max() < 1e-7 * abs(pressed)
    held = solve(plate(QUADS + HELD) + shell)
    stress = held["static/1/element_stress/CQUAD4/value"][:]
    np.testing.assert_allclose(stress[:, [1, 2, 9, 10]], pressed, rtol=1e-9)


def test_a_turned_ply_grows_along_its_own_axes(solve):
    """MAT8 at 90 degrees: A1 along y of the element."""
    ply = (
        "PCOMP,1\n+,2,.01,90.\nMAT8,2,1.+11,1.+10,.3,5.+9,,,1500.,+\n+,1.-6,3.-5,20.\n"
    )
    file = solve(plate(QUADS + "SPC1,1,123456,0\n") + ply + "TEMPD,4,100.\n")
    # TREF of a laminate is that of PCOMP, 0 here.
    strain = np.array([3e-5, 1e-6]) * 100.0
    np.testing.assert_allclose(
        file["static/1/displacement"][:, :2],
        strain * file["position"][:, :2],
        rtol=1e-6,
        atol=1e-10,
    )


FREE = "SPC1,1,123456,0\n"
T1, T2, E1, E2, A1, A2 = 0.004, 0.006, 2e11, 7e10, 1.2e-5, 2.4e-5
BIMETAL = f"""PCOMP,1,,,,,20.
+,2,{T1},0.,YES,3,{T2},0.,YES
MAT1,2,{E1:.0f}.,,.3,,{A1}
MAT1,3,{E2:.0f}.,,.3,,{A2}
"""


def bimetal(heat):
    """Timoshenko's strip as a plate: curvature; stresses in the middle of the plies."""
    m, n, h = T1 / T2, E1 / E2, T1 + T2
    square = (1.0 + m) ** 2
    curved = 6.0 * (A2 - A1) * heat * square
    curved /= h * (3.0 * square + (1.0 + m * n) * (m**2 + 1.0 / (m * n)))
    # One force in each layer, with the moments of both in balance.
    stiff = (E1 * T1**3 + E2 * T2**3) / 12.0
    force = 2.0 * stiff * curved / h
    return curved, np.array([force / T1, -force / T2]) / (1.0 - NU)


@pytest.mark.parametrize("z0", ["", "0.02"])
def test_a_bimetal_plate_curls(solve, z0):
    """Anywhere above the reference surface: w = -k r^2 / 2, stresses by Timoshenko."""
    plies = BIMETAL.replace("PCOMP,1,,", f"PCOMP,1,{z0},")
    file = solve(plate(QUADS + FREE) + plies + "TEMPD,4,120.\n")
    curvature, stress = bimetal(100.0)
    moved = file["static/1/displacement"]
    at = file["position"][:]
    w = -0.5 * curvature * (at[:, 0] ** 2 + at[:, 1] ** 2)
    np.testing.assert_allclose(moved[:, 2], w, rtol=1e-7, atol=1e-10)
    np.testing.assert_allclose(moved[:, 4], curvature * at[:, 0], rtol=1e-7, atol=1e-10)
    found = file["static/1/element_stress/CQUAD4_COMPOSITE"]
    columns = list(found.attrs["columns"])
    for ply, expected in enumerate(stress, start=1):
        for name in (f"o11_p{ply}", f"o22_p{ply}"):
            values = found["value"][:, columns.index(name)]
            np.testing.assert_allclose(values, expected, rtol=1e-7)
    force = file["static/1/element_force/CQUAD4/value"][:]
    assert np.abs(force).max() < 1e-6 * E1 * A1 * 100.0 * T1


def test_plies_between_walls_are_pressed_each_by_itself(solve):
    file = solve(plate(QUADS + HELD) + BIMETAL + "TEMPD,4,120.\n")
    found = file["static/1/element_stress/CQUAD4_COMPOSITE"]
    columns = list(found.attrs["columns"])
    for ply, (e, a) in enumerate(((E1, A1), (E2, A2)), start=1):
        values = found["value"][:, columns.index(f"o11_p{ply}")]
        np.testing.assert_allclose(values, -e * a * 100.0 / (1.0 - NU), rtol=1e-9)


def test_a_cross_ply_keeps_stresses_that_balance(solve):
    """0/90/90/0 of MAT8: no curvature, forces of the plies sum to nothing."""
    ply = "MAT8,2,1.4+11,9.+9,.3,5.+9,5.+9,3.+9,1600.,+\n+,-.5-6,3.-5,20.\n"
    plies = "PCOMP,1,,,,,20.,,SYM\n+,2,.001,0.,YES,2,.001,90.,YES\n"
    file = solve(plate(QUADS + FREE) + plies + ply + "TEMPD,4,-80.\n")
    found = file["static/1/element_stress/CQUAD4_COMPOSITE"]
    columns, values = list(found.attrs["columns"]), found["value"][0]
    o11, o22 = (
        np.array([values[columns.index(f"{name}_p{k}")] for k in range(1, 5)])
        for name in ("o11", "o22")
    )
    # Along x: the fibres of the outer plies, across the inner ones.
    assert o11[0] + o22[1] == pytest.approx(0.0, abs=1e-7 * abs(o11[0]))
    e1, e2, nu12 = 1.4e11, 9e9, 0.3
    q = 1.0 - nu12**2 * e2 / e1
    q11, q22, q12 = e1 / q, e2 / q, nu12 * e2 / q
    a = np.array([-0.5e-6, 3e-5]) * -100.0
    strain = (q11 * a[0] + q12 * a[1] + q22 * a[1] + q12 * a[0]) / (q11 + q22 + 2 * q12)
    expected = q11 * (strain - a[0]) + q12 * (strain - a[1])
    np.testing.assert_allclose(o11, expected, rtol=1e-8)
    assert np.abs(file["static/1/displacement"][:, 2]).max() < 1e-12


@pytest.mark.parametrize(
    "pshell", ["PSHELL,1,1,.01,1,,1\n", "PCOMP,1,,,,,20.\n+,1,.01\n"]
)
def test_a_gradient_over_the_thickness_curls_or_bends(solve, pshell):
    """Free: k = alpha T'; held: M = D (1 + nu) alpha T'."""
    gradient = "TEMPD,4,20.\nTEMPP1,4,1,20.,3000.,,,,,+\n+,2,11,12\n"
    free = solve(plate(QUADS + FREE) + pshell + MAT1 + gradient)
    at = free["position"][:]
    w = -0.5 * ALPHA * 3000.0 * (at[:, 0] ** 2 + at[:, 1] ** 2)
    np.testing.assert_allclose(
        free["static/1/displacement"][:, 2], w, rtol=1e-7, atol=1e-12
    )
    held = solve(plate(QUADS + HELD) + pshell + MAT1 + gradient)
    moment = E * 0.01**3 / 12.0 / (1.0 - NU) * ALPHA * 3000.0
    force = held["static/1/element_force/CQUAD4/value"][:]
    np.testing.assert_allclose(np.abs(force[:, 3:5]), moment, rtol=1e-9)


def test_bent_shells_with_mid_sides_are_refused(solve):
    bulk = (
        "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,.5,0.,0.\n"
        "CTRIA6,1,1,1,2,3,4\nSPC1,1,123456,1,2\n"
    )
    with pytest.raises(InputError, match=r"CTRIA6 1: temperatures bend it"):
        solve(bulk + BIMETAL + "TEMPD,4,100.\n")


CUBE = "".join(
    f"GRID,{k + 1},,{place}\n"
    for k, place in enumerate(
        "0.,0.,0. 1.,0.,0. 1.2,1.,0. 0.,1.,0. "
        "0.,0.,1. 1.,.1,1. 1.,1.,1.3 0.,1.,1.".split()
    )
)
HEXA = "CHEXA,1,1,1,2,3,4,5,6,+\n+,7,8\nPSOLID,1,1\nTEMPD,4,70.\n"


def test_a_heated_solid(solve):
    """Free: alpha T x; held: -E alpha T / (1 - 2 nu) in all directions."""
    free = solve(CUBE + HEXA + MAT1 + "SPC1,1,123,1\nSPC1,1,23,2\nSPC1,1,3,4\n")
    stress = free["static/1/element_stress/CHEXA/value"][0, :6]
    pressed = -E * ALPHA * 50.0 / (1.0 - 2.0 * NU)
    assert np.abs(stress).max() < 1e-7 * abs(pressed)
    held = solve(CUBE + HEXA + MAT1 + "SPC1,1,123456,1,THRU,8\n")
    stress = held["static/1/element_stress/CHEXA/value"][0, :6]
    np.testing.assert_allclose(stress[:3], pressed, rtol=1e-9)
    np.testing.assert_allclose(stress[3:], 0.0, atol=1e-6 * abs(pressed))


def test_a_bimetal_strip(solve):
    """Two bars joined by their offsets: Timoshenko's curvature (JOSA 11, 1925).

    Equal thickness h and modulus: 1.5 (alpha_2 - alpha_1) T / (2 h).
    """
    h, length, other = 0.01, 1.0, 1e-5
    section = f"{h:g},{h**3 / 12:.9e},{h / 12:.9e},1.-4"
    bulk = (
        f"GRID,1\nGRID,2,,{length}\nSPC1,1,123456,1\nTEMPD,4,120.\n"
        f"CBAR,1,1,1,2,0.,1.,0.,,+\n+,,,0.,{h / 2},0.,0.,{h / 2},0.\n"
        f"CBAR,2,2,1,2,0.,1.,0.,,+\n+,,,0.,{-h / 2},0.,0.,{-h / 2},0.\n"
        f"PBAR,1,1,{section}\nPBAR,2,2,{section}\n"
        f"{MAT1}MAT1,2,7.+10,,.3,2700.,{other},20.\n"
    )
    moved = solve(bulk)["static/1/displacement"][1]
    curvature = 1.5 * (ALPHA - other) * 100.0 / (2.0 * h)
    assert moved[1] == pytest.approx(-curvature * length**2 / 2.0, rel=1e-5)
    assert moved[0] == pytest.approx(0.5 * (ALPHA + other) * 100.0, rel=1e-5)


def test_deform_makes_an_element_longer(solve):
    """Held it is pressed by E A d / L; sums of subcases add up."""
    grids = "GRID,1\nGRID,2,,3.\nSPC1,1,123456,1,2\nDEFORM,6,1,.001\nTEMPD,4,120.\n"
    case = (
        "SPC = 1\nSUBCASE 1\nDEFORM = 6\nSUBCASE 2\nTEMP(LOAD) = 4\n"
        "SUBCOM 3\nSUBSEQ = 2.,1.\n"
    )
    file = solve(grids + LINES["CROD"] + MAT1, case)
    deformed = -E * 2e-4 * 1e-3 / 3.0
    heated = -E * 2e-4 * ALPHA * 100.0
    for k, force in ((1, deformed), (2, heated), (3, 2.0 * deformed + heated)):
        value = file[f"static/{k}/element_force/CROD/value"][0, 0]
        assert value == pytest.approx(force, rel=1e-9)


def test_what_is_missing_is_named(solve):
    grids = "GRID,1\nGRID,2,,3.\nSPC1,1,123456,1,2\nTEMP,4,1,120.\n"
    bulk = grids + LINES["CROD"] + MAT1
    with pytest.raises(InputError, match="CROD 1: a grid of it has no temperature"):
        solve(bulk)
    with pytest.raises(InputError, match=r"TEMPERATURE\(LOAD\) = 9: no TEMP"):
        solve(bulk, "SPC = 1\nTEMP(LOAD) = 9")
    with pytest.raises(InputError, match="TEMPP3 with TEMPERATURE"):
        solve(bulk + "TEMPP3,4,1,20.,5.\n")
    with pytest.raises(InputError, match="DEFORM 6: element 77 is no rod"):
        solve(bulk + "DEFORM,6,77,.1\n", "SPC = 1\nDEFORM = 6")


def test_a_free_sheet_under_linear_temperature_has_no_stress(solve):
    """Distorted CQUAD4: u = a (T_x (x^2 - y^2) / 2 + T_y x y), v alike."""
    xy = np.array([(0, 0), (1.1, 0), (2, 0), (0, 1), (0.8, 1.2), (2.1, 0.9)], float)
    tx, ty = 30.0, -50.0
    heat = 20.0 + xy @ (tx, ty)
    bulk = "SPC1,1,123456,1\nSPC1,1,2,2\nCQUAD4,1,1,1,2,5,4\nCQUAD4,2,1,2,3,6,5\n"
    for k, ((x, y), t) in enumerate(zip(xy, heat), 1):
        bulk += f"GRID,{k},,{x},{y},0.,,345\nTEMP,4,{k},{t}\n"
    file = solve(bulk + "PSHELL,1,1,.01,1\nPARAM,K6ROT,1.-6\n" + MAT1)
    x, y = xy.T
    u = ALPHA * (tx * (x**2 - y**2) / 2.0 + ty * x * y)
    v = ALPHA * (ty * (y**2 - x**2) / 2.0 + tx * x * y)
    turn = v[1] / x[1]  # grid 2 is held along y
    expected = np.stack([u + turn * y, v - turn * x], axis=1)
    moved = file["static/1/displacement"][:, :2]
    np.testing.assert_allclose(moved, expected, atol=1e-7 * np.abs(expected).max())
    force = file["static/1/element_force/CQUAD4/value"][:]
    assert np.abs(force).max() < 1e-6 * E * 0.01 * ALPHA * 50.0


@pytest.mark.parametrize("turned", [False, True])
def test_a_clamped_rectangle_under_a_slope_of_temperature(solve, turned):
    """Its corners: E t alpha (T a / 2 (1 - nu) -+ T_x a^2 / 12) along y."""
    a, b, t, slope = 2.0, 1.0, 0.01, 30.0
    bulk = "CQUAD4,1,1,1,2,3,4\nPSHELL,1,1,.01,1\nSPC1,1,123456,1,THRU,4\n"
    for k, (x, y) in enumerate(((0, 0), (a, 0), (a, b), (0, b)), 1):
        x, y, z = (0.0, x, y) if turned else (x, y, 0.0)
        degrees = 30.0 + slope * (y if turned else x)
        bulk += f"GRID,{k},,{x},{y},{z}\nTEMP,4,{k},{degrees}\n"
    file = solve(bulk + MAT1)
    reaction = file["static/1/spc_force"][:]
    mean = 10.0 + 0.5 * slope * a
    even, odd = mean * a / (2.0 * (1.0 - NU)), slope * a**2 / 12.0
    along = E * t * ALPHA * np.array([even - odd, even + odd])
    expected = np.array([along[0], along[1], -along[1], -along[0]])
    np.testing.assert_allclose(reaction[:, 2 if turned else 1], expected, rtol=1e-4)


INITIAL = "SPC = 1\nTEMP(LOAD) = 4\nTEMP(INIT) = 5"


@pytest.mark.parametrize(
    ("tref", "heat"), [("", 50.0), ("20.", 100.0)], ids=["blank", "given"]
)
@pytest.mark.parametrize("card", [*LINES, "CQUAD4", "CHEXA"])
def test_a_blank_reference_is_the_initial_temperature(solve, card, tref, heat):
    """Between walls; with a TREF in the material that one counts."""
    grids = (
        "GRID,1\nGRID,2,,3.\nGRID,3,,3.,1.\nGRID,4,,0.,1.\nGRID,5,,0.,0.,1.\n"
        "GRID,6,,3.,0.,1.\nGRID,7,,3.,1.,1.\nGRID,8,,0.,1.,1.\n"
    )
    more = {
        "CQUAD4": "CQUAD4,1,1,1,2,3,4\nPSHELL,1,1,.01,1,,1\nSPC1,1,123,5,6,7,8\n",
        "CHEXA": "CHEXA,1,1,1,2,3,4,5,6\n,7,8\nPSOLID,1,1\n",
    }
    others = "SPC1,1,123456,3,THRU,8\n"
    bulk = LINES.get(card, "") + more.get(card, "") + (others if card in LINES else "")
    material = MAT1.replace(",20.\n", f",{tref}\n")
    held = "SPC1,1,1,1,THRU,8\nSPC1,1,2,1,2\nSPC1,1,3,1,2,3,4\nSPC1,1,456,1,2\n"
    file = solve(grids + bulk + held + material + "TEMPD,4,120.,5,70.\n", case=INITIAL)
    table = file[f"static/1/element_stress/{card}"]
    names = ("axial", "oxx", "oxx_1", "sxc_a")
    at = next(k for k, n in enumerate(table.attrs["columns"]) if n in names)
    if card == "CBEAM":
        force = file["static/1/element_force/CBEAM"]
        at = list(force.attrs["columns"]).index("axial_force_a")
        stress = force["value"][0, at] / 2e-4
    else:
        stress = table["value"][0, at]
    assert stress == pytest.approx(-E * ALPHA * heat, rel=1e-9)


def test_reference_of_the_material_against_the_initial_one_is_said(solve, tmp_path):
    grids = "GRID,1\nGRID,2,,3.\nSPC1,1,123456,1,2\nTEMPD,4,120.,5,70.\n"
    solve(grids + LINES["CROD"] + MAT1, case=INITIAL)
    notices = "".join(fem.read_deck(tmp_path / "deck.bdf").notices)
    assert "MAT1 1: TREF counts; TEMPERATURE(INITIAL) is the reference" in notices
    with pytest.raises(InputError, match=r"TEMPERATURE\(INITIAL\) = 5: no TEMP"):
        solve(grids.replace(",5,70.", "") + LINES["CROD"] + MAT1, case=INITIAL)
