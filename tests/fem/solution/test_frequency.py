"""SOL 108 and 111: one degree of freedom, a beam in closed form, requests."""

import h5py
import numpy as np
import pytest

import fem
from fem.errors import InputError
from fem.files.export import export
from fem.recovery.elements import element_tables
from fem.solution import run_deck

OSCILLATOR = """\
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
CELAS2,1,1000.,1,1,2,1
CDAMP2,2,.5,1,1,2,1
CMASS2,3,2.,2,1
SPC1,1,123456,1
SPC1,1,23456,2
RLOAD1,5,9,.01,30.,7,-2.
RLOAD2,6,9,4,8,7,20.
DLOAD,7,2.,1.,5,.5,6
DAREA,9,2,1,10.
DELAY,4,2,1,.02
DPHASE,8,2,1,-40.
TABLED1,7
,0.,1.,100.,2.,ENDT
FREQ1,3,1.,.5,10
FREQ,3,3.2,5.1
EIGRL,1,,,1
"""
CASE = "SPC = 1\nDLOAD = 5\nFREQUENCY = 3\nDISP = ALL\nMETHOD = 1\n"
K, B, M, G = 1000.0, 0.5, 2.0, 0.04


@pytest.fixture
def solve(tmp_path):
    def go(sol, case, bulk):
        path = tmp_path / "deck.bdf"
        path.write_text(f"SOL {sol}\nCEND\n{case}BEGIN BULK\n{bulk}\nENDDATA\n")
        deck = fem.read_deck(path)
        out = run_deck(deck, tmp_path / "deck.h5")
        with h5py.File(out) as file:
            found = {}
            file.visititems(
                lambda n, o: found.update({n: o[()]} if hasattr(o, "shape") else {})
            )
        return found, deck, out

    return go


def first(omega):
    """RLOAD1 5."""
    table = 1.0 + omega / (2.0 * np.pi) / 100.0
    return 10.0 * (table - 2.0j) * np.exp(1j * (np.radians(30.0) - 0.01 * omega))


def second(omega):
    """RLOAD2 6."""
    table = 1.0 + omega / (2.0 * np.pi) / 100.0
    angle = np.radians(20.0 - 40.0) - 0.02 * omega
    return 10.0 * table * np.exp(1j * angle)


@pytest.mark.parametrize("sol", [108, 111])
@pytest.mark.parametrize("dload", [5, 6, 7])
def test_an_oscillator_follows_its_transfer_function(solve, sol, dload):
    case = CASE.replace("DLOAD = 5", f"DLOAD = {dload}")
    case += "ACCE = ALL\nSPCF = ALL\nFORCE = ALL\nOLOAD = ALL\n"
    found = solve(sol, case, f"PARAM,G,{G}\n{OSCILLATOR}")[0]
    hertz = found["frequency/1/frequency_hz"]
    expected = np.unique([*(1.0 + 0.5 * np.arange(11)), 3.2, 5.1])
    assert hertz == pytest.approx(expected)
    omega = 2.0 * np.pi * hertz
    parts = {5: first(omega), 6: second(omega)}
    parts[7] = 2.0 * (parts[5] + 0.5 * parts[6])
    spring = K * (1.0 + 1j * G) + 1j * omega * B
    u = parts[dload] / (spring - omega**2 * M)
    assert found["frequency/1/displacement"][:, 1, 0] == pytest.approx(u, rel=1e-9)
    acceleration = found["frequency/1/acceleration"][:, 1, 0]
    assert acceleration == pytest.approx(-(omega**2) * u, rel=1e-9)
    assert found["frequency/1/spc_force"][:, 0, 0] == pytest.approx(-spring * u)
    assert found["frequency/1/applied_load"][:, 1, 0] == pytest.approx(parts[dload])
    damper = found["frequency/1/element_force/CDAMP2/value"][:, 0, 0]
    assert np.abs(damper) == pytest.approx(np.abs(omega * B * u))


BEAM_PUSHED = """\
GRID,1,,0.,0.,0.
=,*1,=,*.3,==
=9
CBAR,1,1,1,2,0.,1.,0.
=,*1,=,*1,*1,==
=8
PBAR,1,1,1.-3,1.-6,2.-6,1.-6
MAT1,1,7.+10,,.3,2700.
PARAM,COUPMASS,1
SPC1,1,123456,1
FORCE,9,11,,100.,10.,1.,1.
RLOAD1,5,9,,,7
TABLED1,7
,0.,1.,100.,1.,ENDT
FREQ,3,15.
"""


def test_inertia_stands_for_the_low_modes_that_are_left_out(solve):
    """Bending at 4 and 6 Hz, load at 15 Hz; without them the load's own vector bends.

    The bar is pushed: 1000 N and the mass beyond, far below its mode at 424 Hz.
    """
    case = CASE + "FORCE = ALL\n"

    def push(more, sol=111):
        found = solve(sol, case + more, BEAM_PUSHED + "EIGRL,1,12.,,2")[0]
        return found["frequency/1/element_force/CBAR/value"][0, :, 6].real

    direct = push("", sol=108)
    np.testing.assert_allclose(push(""), direct, rtol=5e-3)
    np.testing.assert_allclose(push("RESVEC = YES\n"), direct, rtol=5e-3)
    assert np.abs(push("RESVEC(NOINRL) = YES\n") / direct - 1.0).max() > 0.5
    assert np.abs(push("RESVEC = NO\n") / direct - 1.0).max() > 0.5


def test_modal_damping_is_viscous_or_structural(solve):
    bulk = OSCILLATOR.replace("CDAMP2,2,.5,1,1,2,1\n", "")
    bulk += "TABDMP1,2,CRIT\n,0.,.05,100.,.05,ENDT\n"
    own = np.sqrt(K / M)
    for param, damping in (
        ("", lambda omega: 0.1j * own * omega),
        ("PARAM,KDAMP,-1\n", lambda omega: 0.1j * own**2),
    ):
        found = solve(111, f"{CASE}SDAMP = 2\n", param + bulk)[0]
        omega = 2.0 * np.pi * found["frequency/1/frequency_hz"]
        u = first(omega) / (M * (own**2 - omega**2 + damping(omega)))
        assert found["frequency/1/displacement"][:, 1, 0] == pytest.approx(u, rel=1e-9)


@pytest.mark.parametrize("sol", [108, 111])
def test_rayleigh_damping_is_viscous(solve, sol):
    """ALPHA1 M + ALPHA2 K, the damper beside it."""
    bulk = f"PARAM,ALPHA1,3.,0.\nPARAM,ALPHA2,.002,0.\n{OSCILLATOR}"
    found = solve(sol, f"{CASE}SPCF = ALL\n", bulk)[0]
    omega = 2.0 * np.pi * found["frequency/1/frequency_hz"]
    spring = K + 1j * omega * (B + 0.002 * K)
    u = first(omega) / (spring + 3.0j * omega * M - omega**2 * M)
    assert found["frequency/1/displacement"][:, 1, 0] == pytest.approx(u, rel=1e-9)
    assert found["frequency/1/spc_force"][:, 0, 0] == pytest.approx(-spring * u)


def test_a_cantilever_moves_as_the_wave_equation_says(solve):
    """Tip of an Euler beam with structural damping under a harmonic force."""
    length, young, inertia, area, rho, g = 1.0, 7e10, 2e-6, 0.01, 2700.0, 0.05
    n = 20
    bulk = "PARAM,COUPMASS,1\nPARAM,G,.05\nFREQ1,3,10.,30.,10\n"
    bulk += "".join(f"GRID,{k + 1},,{k / n:.4f},0.,0.\n" for k in range(n + 1))
    bulk += "".join(f"CBAR,{k},1,{k},{k + 1},0.,1.,0.\n" for k in range(1, n + 1))
    bulk += f"PBAR,1,1,{area},{inertia},{inertia},1.-6\nMAT1,1,7.+10,,.3,2700.\n"
    bulk += f"SPC1,1,123456,1\nDAREA,9,{n + 1},2,1.\nRLOAD1,5,9,,,1.\n"
    found = solve(108, CASE, bulk)[0]
    omega = 2.0 * np.pi * found["frequency/1/frequency_hz"]
    stiff = young * inertia * (1.0 + 1j * g)
    wave = (rho * area * omega**2 / stiff) ** 0.25
    x = wave * length
    flexible = np.sin(x) * np.cosh(x) - np.cos(x) * np.sinh(x)
    flexible = flexible / (stiff * wave**3 * (1.0 + np.cos(x) * np.cosh(x)))
    tip = found["frequency/1/displacement"][:, -1, 1]
    assert tip == pytest.approx(flexible, rel=2e-4)


def test_post_processors_find_complex_displacements(solve):
    op2_module = pytest.importorskip("pyNastran.op2.op2")
    found, deck, out = solve(108, CASE, OSCILLATOR)
    files = export(out, deck, op2=True, paraview=True, say=lambda text: None)
    op2 = op2_module.OP2(debug=None)
    op2.read_op2(files[0])
    table = op2.displacements[1]
    ours = found["frequency/1/displacement"]
    assert table.data == pytest.approx(ours.astype(np.complex64))
    assert table._times == pytest.approx(found["frequency/1/frequency_hz"])


VARYING = """\
GRID,1,,0.,0.,0.
CBUSH,1,1,2,,,,,0
GRID,2,,1.,0.,0.
PBUSH,1,K,500.
,,GE,.1
PBUSHT,1,B,12
,,GE,13
,,K,11
CONM2,9,2,,2.
CELAS1,2,2,2,2
PELAS,2,900.,.5
PELAST,2,21,0
CDAMP1,3,3,2,2
PDAMP,3,4.
PDAMPT,3,22
SPC1,1,3456,2
SPC1,1,123456,1
DAREA,9,2,1,10.
DAREA,9,2,2,20.
RLOAD1,5,9,,,1.
TABLED1,11
,0.,700.,100.,1700.,ENDT
TABLED1,12
,0.,3.,100.,103.,ENDT
TABLED1,13
,0.,2.,100.,1.,ENDT
TABLED1,21
,0.,800.,100.,300.,ENDT
TABLED1,22
,0.,5.,100.,1.,ENDT
FREQ1,3,1.,.5,10
EIGRL,1,,,2
"""


@pytest.mark.parametrize("sol", [108, 111])
def test_springs_and_dampers_follow_their_tables_of_frequency(solve, sol):
    """Forces of CBUSH have all parts of its impedance, balances hold."""
    case = f"{CASE}SPCF = ALL\nFORCE = ALL\n"
    found = solve(sol, case, f"PARAM,G,{G}\n{VARYING}")[0]
    hertz = found["frequency/1/frequency_hz"]
    omega = 2.0 * np.pi * hertz
    k, b, ge = 700.0 + 10.0 * hertz, 3.0 + hertz, 2.0 - 0.01 * hertz
    bush = k * (1.0 + 1j * ge) + 1j * omega * b
    k2, b2 = 800.0 - 5.0 * hertz, 5.0 - 0.04 * hertz
    x = 10.0 / (bush + 1j * G * k - 2.0 * omega**2)
    y = 20.0 / (k2 * (1.0 + 1j * (0.5 + G)) + 1j * omega * b2 - 2.0 * omega**2)
    u = found["frequency/1/displacement"][:, 1]
    assert u[:, :2] == pytest.approx(np.stack([x, y], axis=1), rel=1e-9)
    forces = {
        card: found[f"frequency/1/element_force/{card}/value"][:, 0, 0]
        for card in ("CBUSH", "CELAS1", "CDAMP1")
    }
    assert np.abs(forces["CBUSH"]) == pytest.approx(np.abs(bush * x), rel=1e-9)
    assert forces["CELAS1"] == pytest.approx(k2 * (1.0 + 0.5j) * y, rel=1e-9)
    assert forces["CDAMP1"] == pytest.approx(1j * omega * b2 * y, rel=1e-9)
    assert np.abs(found["frequency/1/spc_force"][:, 1]).max() < 1e-6


def test_a_table_of_frequency_that_is_not_there_is_named(solve):
    with pytest.raises(InputError, match="TABLED1 99 is not defined"):
        solve(108, CASE, VARYING.replace("PDAMPT,3,22", "PDAMPT,3,99"))


@pytest.mark.parametrize(
    ("sol", "case", "bulk", "message"),
    [
        (108, CASE.replace("FREQUENCY = 3\n", ""), OSCILLATOR, "needs FREQUENCY"),
        (108, CASE.replace("DLOAD = 5\n", ""), OSCILLATOR, "needs DLOAD"),
        (111, CASE.replace("METHOD = 1\n", ""), OSCILLATOR, "needs METHOD"),
        (108, CASE.replace("= 3", "= 8"), OSCILLATOR, "FREQUENCY = 8 is not defined"),
        (108, CASE, OSCILLATOR.replace("30.,7,-2.", "30.,7,-2.,DISP"), "no SPCD"),
        (
            108,
            CASE,
            OSCILLATOR.replace("CDAMP2,2,.5,1,1,2,1\n", "")
            .replace("SPC1,1,123456,1", "SPC1,1,23456,1")
            .replace("3.2,5.1", "0."),
            "without damping",
        ),
    ],
)
def test_what_cannot_be_solved_is_named(solve, sol, case, bulk, message):
    with pytest.raises(InputError, match=message):
        solve(sol, case, bulk)


NATURAL = np.sqrt(K / M) / (2.0 * np.pi)


@pytest.mark.parametrize(
    ("card", "expected"),
    [
        ("FREQ4,3,0.,100.,.2,5", NATURAL * np.array([0.8, 0.9, 1.0, 1.1, 1.2])),
        ("FREQ4,3,10.,100.\nFREQ,3,1.", [1.0]),
        ("FREQ5,3,0.,9.,.5,1.,1.5", NATURAL * np.array([0.5, 1.0, 1.5])),
        (
            "FREQ3,3,1.,9.,LINEAR,3",
            [1.0, 0.5 * (1.0 + NATURAL), NATURAL, 0.5 * (9.0 + NATURAL), 9.0],
        ),
        (
            "FREQ3,3,1.,9.,LOG,3",
            [1.0, np.sqrt(NATURAL), NATURAL, 3.0 * np.sqrt(NATURAL), 9.0],
        ),
        # Clustered at the ends: share sign(x) |x|^(1/2) of half the interval.
        (
            "FREQ3,3,5.,9.,LINEAR,5,2.",
            7.0 + 2.0 * np.array([-1.0, -np.sqrt(0.5), 0.0, np.sqrt(0.5), 1.0]),
        ),
        ("FREQ,3,1.,1.000009,2.", [1.0, 2.0]),
    ],
)
def test_frequencies_by_natural_ones(solve, card, expected):
    bulk = OSCILLATOR.replace("FREQ1,3,1.,.5,10\nFREQ,3,3.2,5.1", card)
    found = solve(111, CASE, f"PARAM,G,.04\n{bulk}")[0]["frequency/1/frequency_hz"]
    assert found == pytest.approx(np.asarray(expected), rel=1e-6)


def test_direct_response_knows_no_natural_frequencies(solve):
    bulk = OSCILLATOR.replace("FREQ1,3,1.,.5,10\nFREQ,3,3.2,5.1", "FREQ4,3,0.,9.")
    with pytest.raises(InputError, match="expected SOL 111, or FREQ, FREQ1"):
        solve(108, CASE, bulk)


PLATE = """\
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,.1
CQUAD4,1,1,1,2,3,4
CBAR,2,2,2,3,1.,0.,0.
PBAR,2,1,.01,1.-5,2.-5,1.-5,,,+
+,.1,.1,-.1,.1,.1,-.1,-.1,-.1
PSHELL,1,1,.02,1
MAT1,1,7.+10,,.3,2700.,,,.03
SPC1,1,123456,1,4
DAREA,9,3,1,1.+4,3,3,500.
DAREA,9,2,2,2.+3
DPHASE,8,2,2,70.
RLOAD1,5,9,,8,1.
FREQ,3,2.,60.
EIGRL,1,,,12
"""


def test_complex_stresses_follow_the_motion(solve):
    """Linear columns by the real and the imaginary part; von Mises at its peak."""
    case = CASE + "STRESS = ALL\nSTRAIN = ALL\nFORCE = ALL\n"
    found, deck, out = solve(108, case, PLATE)
    structure = fem.Structure.from_deck(deck)
    u = found["frequency/1/displacement"].reshape(2, -1)
    (table,) = [
        t
        for t in element_tables(structure.points, structure.blocks, "stress")
        if t.table == "CQUAD4"
    ]
    with h5py.File(out) as file:
        group = file["frequency/1/element_stress/CQUAD4"]
        columns, values = list(group.attrs["columns"]), group["value"][:]
        bar = list(file["frequency/1/element_stress/CBAR"].attrs["columns"])
    assert bar == ["s1a", "s2a", "s3a", "s4a", "axial", "s1b", "s2b", "s3b", "s4b"]
    turns = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 721))
    for k in range(2):
        cycle = np.stack([table.of((u[k] * turn).real)[0] for turn in turns])
        for name in ("oxx_1", "txy_2"):
            history = cycle[:, table.columns.index(name)]
            np.testing.assert_allclose(
                history, (values[k, 0, columns.index(name)] * turns).real, rtol=1e-9
            )
        peak = cycle[:, table.columns.index("von_mises_1")].max()
        largest = values[k, 0, columns.index("von_mises_1")]
        assert largest.imag == 0.0
        assert largest.real == pytest.approx(peak, rel=1e-4)
        assert values[k, 0, columns.index("fibre_1")] == pytest.approx(-0.01)
