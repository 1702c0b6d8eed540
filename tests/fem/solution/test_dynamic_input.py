"""K2PP, B2PP, M2PP, transfer functions and loads that follow the motion."""

import h5py
import numpy as np
import pytest

import fem
from fem.errors import InputError
from fem.model.structure import Structure
from fem.solution import run_deck
from fem.solution.options import Options

K1, K2, M1, M2, B = 900.0, 400.0, 2.0, 0.5, 1.5
BULK = f"""\
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,2.,0.,0.
CELAS2,1,{K1},1,1,2,1
CELAS2,2,{K2},2,1,3,1
CDAMP2,3,{B},1,1,2,1
CMASS2,4,{M1},2,1
CMASS2,5,{M2},3,1
SPC1,1,123456,1
SPC1,1,23456,2,3
DAREA,9,2,1,10.
RLOAD1,5,9,,,7
TLOAD1,6,9,,,8
TABLED1,7
,0.,1.,100.,1.,ENDT
TABLED1,8
,0.,0.,.05,1.,.1,0.,1.,0.
,9.,0.,ENDT
FREQ1,3,1.,1.,6
TSTEP,3,300,2.-3
EIGRL,1,,,2
"""
CASE = "SPC = 1\nFREQUENCY = 3\nTSTEP = 3\nDISP = ALL\nMETHOD = 1\n"
K = np.array([[K1 + K2, -K2], [-K2, K2]])
M, D = np.diag([M1, M2]), np.diag([B, 0.0])
OMEGA = 2.0 * np.pi * np.arange(1.0, 8.0)
UNSYMMETRIC = """\
DMIG,ADD,0,1,1,0
DMIG,ADD,2,1,,2,1,50.
,3,1,-30.
DMIG,ADD,3,1,,2,1,80.
,3,1,20.
"""
ADDED = np.array([[50.0, 80.0], [-30.0, 20.0]])
FILTER = """\
EPOINT,11
TF,4,11,,1.,.05,.001
,3,1,-2.,-.01
"""


class Said(list):
    """A console that remembers."""

    def say(self, text):
        self.append(text)

    def progress(self, label):
        return lambda done, total: None


@pytest.fixture
def solve(tmp_path):
    def go(sol, case, bulk):
        path = tmp_path / "deck.bdf"
        load = "DLOAD = 5\n" if sol in (108, 111) else "DLOAD = 6\n"
        load = "" if sol == 103 else load
        path.write_text(
            f"SOL {sol}\nCEND\n{CASE}{load}{case}\nBEGIN BULK\n{BULK}{bulk}\nENDDATA\n"
        )
        said = Said()
        out = run_deck(fem.read_deck(path), tmp_path / "deck.h5", Options(console=said))
        found = {"said": "\n".join(said)}
        with h5py.File(out) as file:
            file.visititems(
                lambda n, o: found.update({n: o[()]} if hasattr(o, "shape") else {})
            )
        return found

    return go


def moved(found, kind):
    """(t, 2) displacements of grids 2 and 3."""
    return found[f"{kind}/1/displacement"][:, 1:, 0]


@pytest.mark.parametrize("sol", [108, 111])
@pytest.mark.parametrize(("name", "power"), [("K2PP", 0), ("B2PP", 1), ("M2PP", 2)])
def test_harmonic_response_with_an_unsymmetric_matrix(solve, sol, name, power):
    scale = (1.0, 0.02, 1e-3)[power]
    found = solve(sol, f"{name} = {scale}*ADD", UNSYMMETRIC)
    for omega, u in zip(OMEGA, moved(found, "frequency")):
        p = 1j * omega
        dynamic = K + p * D + p**2 * M + p**power * scale * ADDED
        expected = np.linalg.solve(dynamic, [10.0, 0.0])
        np.testing.assert_allclose(u, expected, rtol=1e-9)


@pytest.mark.parametrize("sol", [108, 111])
def test_a_complex_stiffness_damps(solve, sol):
    """PARAM G does not act on it; POLAR gives amplitude and degrees."""
    matrix = "DMIG,ADD,0,6,3,0,1\nDMIG,ADD,3,1,,3,1,50.,30.\nPARAM,G,.1\n"
    found = solve(sol, "K2PP = ADD", matrix)
    added = np.diag([0.0, 50.0 * np.exp(1j * np.pi / 6.0)])
    for omega, u in zip(OMEGA, moved(found, "frequency")):
        dynamic = (1.0 + 0.1j) * K + added + 1j * omega * D - omega**2 * M
        np.testing.assert_allclose(u, np.linalg.solve(dynamic, [10.0, 0]), rtol=1e-9)


@pytest.mark.parametrize("sol", [108, 111])
def test_a_transfer_function_follows_and_acts_back(solve, sol):
    """e = (2 + .01 p) u3 / (1 + .05 p + .001 p^2), and a force of 40 e on grid 2."""
    back = "TF,4,2,1,0.\n,11,,-40.\n"
    found = solve(sol, "TFL = 4", FILTER + back)
    extra = found["frequency/1/displacement_scalar_point"][:, 0]
    for omega, u, e in zip(OMEGA, moved(found, "frequency"), extra):
        p = 1j * omega
        h = (2.0 + 0.01 * p) / (1.0 + 0.05 * p + 0.001 * p**2)
        dynamic = K + p * D + p**2 * M + np.array([[0.0, -40.0 * h], [0.0, 0.0]])
        expected = np.linalg.solve(dynamic, [10.0, 0.0])
        np.testing.assert_allclose(u, expected, rtol=1e-9)
        assert e == pytest.approx(h * expected[1], rel=1e-9)


def test_direct_and_coupled_modal_transients_agree(solve):
    """All modes are there, and both take Nastran's scheme."""
    case, bulk = "TFL = 4\nK2PP = ADD", FILTER + "TF,4,2,1\n,11,,-40.\n" + UNSYMMETRIC
    direct, modal = (solve(sol, case, bulk) for sol in (109, 112))
    for name in ("displacement", "displacement_scalar_point", "velocity"):
        a, b = (found[f"transient/1/{name}"] for found in (direct, modal))
        np.testing.assert_allclose(a, b, atol=1e-9 * np.abs(a).max())


def test_initial_values_of_extra_points_decay(solve):
    """e + .1 e' = 0 from 1."""
    bulk = "EPOINT,11\nTF,4,11,,1.,.1\nTIC,2,11,,1.,-10.\n"
    found = solve(109, "TFL = 4\nIC = 2", bulk)
    extra = found["transient/1/displacement_scalar_point"][:, 0]
    time = found["transient/1/time"]
    np.testing.assert_allclose(extra, np.exp(-time / 0.1), atol=2e-4)


@pytest.mark.parametrize("sol", [109, 112])
def test_a_load_that_follows_the_motion_is_a_spring(solve, sol):
    """S T(x) = -300 x at grid 3, on extra points in modes: as 300 more of stiffness."""
    line = "TABLED1,21\n,-1.,-1.,1.,1.,ENDT\n"
    spring = solve(sol, "", "CELAS2,6,300.,3,1\n")
    steps = "TSTEP,3,3000,2.-4,10"
    if sol == 109:
        bulk = "NOLIN1,8,3,1,-300.,3,1,21\n"
        case = "NONLINEAR = 8"
    else:
        # e1 = u3; the load makes e2 = T(e1), and grid 3 takes -300 e2.
        bulk = (
            "EPOINT,11,12\nTF,4,11,,1.\n,3,1,-1.\nTF,4,12,,1.\n"
            "TF,4,3,1\n,12,,300.\nNOLIN1,8,12,,1.,11,,21\n"
        )
        case = "NONLINEAR = 8\nTFL = 4"
    found = solve(
        sol, f"{case}\nTSTEP = 30", line + bulk + steps.replace(",3,", ",30,")
    )
    expected = moved(spring, "transient")
    error = np.abs(moved(found, "transient") - expected).max() / np.abs(expected).max()
    assert error < 0.02


def test_cubic_damping_and_products_step_by_step(solve):
    """NOLIN2, 3 and 4 with velocities, against the scheme written out."""
    bulk = (
        "NOLIN2,8,2,1,-2000.,2,1,3,1\nNOLIN3,8,3,1,-.4,3,11,2.\n"
        "NOLIN4,8,3,1,-.4,3,11,2.\n"
    )
    found = moved(solve(109, "NONLINEAR = 8", bulk), "transient")
    h, load = 2e-3, lambda t: np.interp(t, [0.0, 0.05, 0.1, 9.0], [0.0, 1.0, 0.0, 0.0])
    u = [np.zeros(2), np.zeros(2)]
    matrix = M / h**2 + D / (2.0 * h) + K / 3.0
    for n in range(300):
        now, before = u[-1], u[-2]
        v = (now[1] - before[1]) / h
        p = sum(load(h * k) for k in (n + 1, n, n - 1) if k > 0) / 3.0
        right = np.array([10.0 * p - 2000.0 * now[0] * now[1], -0.4 * v * abs(v)])
        right += (2.0 * M / h**2 - K / 3.0) @ now
        right += (D / (2.0 * h) - M / h**2 - K / 3.0) @ before
        u.append(np.linalg.solve(matrix, right))
    np.testing.assert_allclose(found, u[1:], atol=1e-12)


def test_modes_do_not_know_of_it(solve):
    found = solve(103, "K2PP = ADD\nTFL = 4\nNONLINEAR = 8", UNSYMMETRIC + FILTER)
    expected = np.sqrt(np.linalg.eigvals(np.linalg.solve(M, K))) / (2.0 * np.pi)
    np.testing.assert_allclose(found["modes/frequency_hz"], sorted(expected), rtol=1e-9)
    assert "K2PP, TFL, NONLINEAR: without effect in SOL 103" in found["said"]


@pytest.mark.parametrize("sol", [108, 109, 111, 112])
def test_extra_points_without_an_equation_rest(solve, sol):
    alone, found = solve(sol, "", ""), solve(sol, "", "EPOINT,11\n")
    assert "extra point 11: no row of TF" in found["said"]
    part = "transient" if sol in (109, 112) else "frequency"
    name = f"{part}/1/displacement"
    np.testing.assert_array_equal(found[name], alone[name])


def test_direct_input_sees_no_motion_of_the_base(solve):
    """Nastran takes what SPC holds out of it, moved or not; that is said."""
    bulk = "EPOINT,11\nTF,4,11,,1.\n,1,1,-1.\nRLOAD1,15,19,,,7,,DISP\nSPCD,19,1,1,1.\n"
    case = "TFL = 4\nDLOAD = 15"
    found = solve(108, case, bulk)
    assert np.all(found["frequency/1/displacement_scalar_point"] == 0.0)
    assert "refer to grid 1 T1, which SPC holds and SPCD moves" in found["said"]


@pytest.mark.parametrize(
    ("case", "bulk", "message"),
    [
        ("TFL = 5", FILTER, r"TFL = 5: expected a set of TF: \[4\]"),
        ("TFL = 4", FILTER + "SPC1,1,0,11\n", "SPC 1: 11 is an extra point"),
        ("", FILTER + "CELAS2,9,1.,11,0,3,1\n", "CELAS2 9: 11 is an extra point"),
        ("B2PP = ADD", "DMIG,ADD,0,6,3,0\nDMIG,ADD,3,1,,3,1,0.,1.\n", "is complex"),
        ("K2GG = ADD", "DMIG,ADD,0,6,3,0\nDMIG,ADD,3,1,,3,1,0.,1.\n", "is complex"),
        ("K2PP = NONE", FILTER, "DMIG NONE is not in the deck"),
        ("K2GG = E", "EPOINT,3\nDMIG,E,0,6,1,0\n", "EPOINT 3 is def"),
        ("K2GG = E", FILTER + "DMIG,E,0,6,1,0\nDMIG,E,11,,,11,,1.\n", "K2PP, M2PP or"),
        ("NONLINEAR = 9", "", "NONLINEAR = 9: no NOLIN1"),
        ("NONLINEAR = 8", "NOLIN3,8,1,1,1.,2,1,2.\n", "grid 1 T1 is not in the sol"),
        ("NONLINEAR = 8", "NOLIN3,8,2,11,1.,2,1,2.\n", "a load has no rate"),
    ],
)
def test_what_cannot_be_is_named(solve, case, bulk, message):
    with pytest.raises(InputError, match=message):
        solve(109, case, bulk)


def test_subcases_of_other_solutions_do_not_keep_the_rest_from_running(tmp_path):
    path = tmp_path / "deck.bdf"
    path.write_text(
        "SOL 146\nCEND\nSPC = 1\nMETHOD = 1\nSUBCASE 1\nANALYSIS = MODES\nSUBCASE 2\n"
        f"GUST = 3\nBEGIN BULK\n{BULK}ENDDATA\n"
    )
    said = Said()
    run_deck(fem.read_deck(path), tmp_path / "deck.h5", Options(console=said))
    assert any(
        "warning: subcase 2 is not run: it asks for what SOL 146" in s for s in said
    )


def test_a_landing_has_no_input_of_dynamic_solutions(tmp_path):
    path = tmp_path / "deck.bdf"
    path.write_text(
        f"SOL 103\nCEND\nK2PP = ADD\nBEGIN BULK\n{BULK}{UNSYMMETRIC}ENDDATA\n"
    )
    assert Structure.from_deck(fem.read_deck(path)).dynamic_input is not None
    deck = fem.read_deck(path, ignore=("CASE",))
    assert Structure.from_deck(deck).dynamic_input is None
