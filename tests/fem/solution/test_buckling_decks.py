"""SOL 105: load factors of closed forms, requests, preloads, signs, files."""

import h5py
import numpy as np
import pytest

import fem
from benchmarks.verification.buckling import plate
from fem.algebra import buckling
from fem.algebra.linear_solver import factorize
from fem.errors import InputError
from fem.files.export import export
from fem.solution import run_deck
from fem.solution.options import Quiet

PI = np.pi
YOUNG, INERTIA = 7e10, 2e-6
EULER = PI**2 * YOUNG * INERTIA / 4.0  # fixed-free, length 1

COLUMN = """\
GRID,1,,0.,0.,0.
=,*1,=,*.1,==
=9
CBAR,1,1,1,2,0.,1.,0.
=,*1,=,*1,*1,==
=8
PBAR,1,1,.01,2.-6,3.-6,4.-6
MAT1,1,7.+10,,.3,2700.
SPC1,1,123456,1
FORCE,7,11,,-1.,1.
FORCE,8,11,,1.,1.
"""
CASE = "SPC = 1\nSUBCASE 1\nLOAD = 7\nSUBCASE 2\nMETHOD = 1\n"


class Said(list):
    def say(self, text):
        self.append(text)

    def progress(self, task):
        return lambda done, total: None


@pytest.fixture
def solve(tmp_path):
    def go(case, more, bulk=COLUMN, sol=105):
        path = tmp_path / "deck.bdf"
        path.write_text(f"SOL {sol}\nCEND\n{case}BEGIN BULK\n{bulk}{more}\nENDDATA\n")
        said = Said()
        deck = fem.read_deck(path)
        out = run_deck(deck, tmp_path / "deck.h5", fem.Options(console=said))
        with h5py.File(out) as file:
            found = {}
            file.visititems(
                lambda n, o: found.update({n: o[()]} if hasattr(o, "shape") else {})
            )
        return found, "\n".join(said), deck, out

    return go


TURNED = np.linalg.qr(np.array([[2.0, 1, 0], [-1, 1, 3], [1, -2, 1]]))[0]
# Half way between r and z of a cylindrical system.
DIAGONAL = np.linalg.qr(np.array([[0.5, 1, 0], [0.5, 0, 1], [0.5**0.5, 0, 0]]))[0].T


@pytest.mark.parametrize(
    ("length", "force", "turn", "torsion"),
    [
        (1e3, 1.0, np.eye(3), 4e-6),  # mm, N
        (39.3700787402, 0.224808943100, np.eye(3), 4e-6),  # in, lbf
        (1.0, 1.0, TURNED, 4e-6),
        (1.0, 1.0, DIAGONAL, 0.0),
    ],
)
def test_factors_know_no_units_and_no_frame(solve, length, force, turn, torsion):
    """The column in other units and directions, its grids in a cylindrical frame.

    Without torsional stiffness AUTOSPC holds a component of each grid, by rounding
    another one where two are as near to the axis.
    """
    y = turn[1] * length
    grids = []
    for k in range(11):
        a, b, c = 0.1 * k * turn[0] * length
        angle = np.degrees(np.arctan2(b, a))
        grids.append(f"GRID,{k + 1},5,{np.hypot(a, b):.9e},{angle:.9e},{c:.9e},5")
    bars = [f"CBAR,{k},1,{k},{k + 1},20" for k in range(1, 11)]
    side = ",".join(f"{v:.9e}" for v in 3.0 * y)  # G0, in the plane of bending
    push = ",".join(f"{v:.9e}" for v in -turn[0] * force)
    bulk = "\n".join(
        [
            *("CORD2C,5,,0.,0.,0.,0.,0.,1.", ",1.,0.,0."),
            *(*grids, f"GRID,20,,{side},,123456", *bars),
            f"PBAR,1,1,{0.01 * length**2:.9e},{2e-6 * length**4:.9e},"
            f"{3e-6 * length**4:.9e},{torsion * length**4:.9e}",
            f"MAT1,1,{YOUNG * force / length**2:.9e},,.3",
            f"SPC1,1,123456,1\nFORCE,7,11,,1.,{push}\n",
        ]
    )
    found, *_ = solve(CASE, "EIGRL,1,,,2", bulk)
    expected = [EULER, 1.5 * EULER]
    assert found["buckling/2/factor"] == pytest.approx(expected, rel=1e-4)


def test_analysis_tells_statics_from_buckling_where_method_stands_above(solve):
    case = (
        "SPC = 1\nMETHOD = 1\nSUBCASE 1\nANALYSIS = STATICS\nLOAD = 7\n"
        "SUBCASE 2\nANALYSIS = STATICS\nLOAD = 8\n"
        "SUBCASE 3\nANALYSIS = BUCK\nSTATSUB = 1\n"
    )
    found, *_ = solve(case, "EIGRL,1,,,1")
    assert found["buckling/3/factor"] == pytest.approx([EULER], rel=1e-4)
    assert "static/2/displacement" in found


def test_a_fixed_free_column_has_eulers_loads_in_both_planes(solve):
    found, said, *_ = solve(CASE, "EIGRL,1,,,3")
    weak = EULER * np.array([1.0, 1.5, 9.0])
    assert found["buckling/2/factor"] == pytest.approx(weak, rel=1e-4)
    shape = found["buckling/2/shape"][0]
    assert np.abs(shape).max() == pytest.approx(1.0)
    x = np.linspace(0.0, 1.0, 11)
    across = shape[:, 1] / shape[-1, 1]
    assert across == pytest.approx(1.0 - np.cos(0.5 * PI * x), abs=1e-4)
    assert "none missed" in said
    assert "MISSING" not in said


def test_tension_buckles_under_the_reversed_load(solve):
    case = CASE.replace("LOAD = 7", "LOAD = 8")
    found, said, *_ = solve(case, "EIGRL,1,,,1")
    assert found["buckling/2/factor"] == pytest.approx([-EULER], rel=1e-4)
    assert "smallest factor of the reversed load" in said
    found, said, *_ = solve(case, "EIGRL,1,0.,,1")
    assert "no factor in the range" in said
    assert found["buckling/2/factor"] == pytest.approx([-EULER], rel=1e-4)


@pytest.mark.parametrize(
    ("card", "count"),
    [
        ("EIGRL,1,0.,1.e6", 2),
        ("EIGRL,1,4.e5,1.e6", 1),
        ("EIGRL,1,,,2", 2),
        ("EIGRL,1", 1),
        ("EIGB,1,SINV,0.,4.e6,2,2,2", 2),
        ("EIGB,1,INV,0.,1.e6,9", 2),
    ],
)
def test_requests_of_eigrl_and_eigb(solve, card, count):
    assert len(solve(CASE, card)[0]["buckling/2/factor"]) == count


def test_a_preload_takes_its_share_of_the_factor(solve):
    case = (
        "SPC = 1\nSUBCASE 1\nLOAD = 7\nSUBCASE 2\nLOAD = 9\nSUBCASE 3\n"
        "STATSUB(PRELOAD) = 2\nSTATSUB(BUCKLING) = 1\nMETHOD = 1\n"
    )
    found = solve(case, f"FORCE,9,11,,-{0.25 * EULER:.1f},1.\nEIGRL,1,,,1")[0]
    assert found["buckling/3/factor"] == pytest.approx([0.75 * EULER], rel=1e-3)


def test_a_subcase_with_load_and_method_buckles_under_its_own_load(solve):
    case = "SPC = 1\nLOAD = 7\nMETHOD = 1\n"
    found = solve(case, "EIGRL,1,,,1")[0]
    assert found["buckling/1/factor"] == pytest.approx([EULER], rel=1e-4)


@pytest.mark.parametrize(
    ("case", "message"),
    [
        (
            CASE.replace("METHOD = 1", "DISP = ALL"),
            "SOL 105 needs a subcase with METHOD",
        ),
        (CASE + "STATSUB = 5\n", "STATSUB = 5, expected one of"),
        (CASE.replace("METHOD = 1", "METHOD = 4"), "METHOD = 4 is not defined"),
    ],
)
def test_requests_that_cannot_be_met_are_named(solve, case, message):
    with pytest.raises(InputError, match=message):
        solve(case, "EIGRL,1,,,1")


def test_post_processors_find_the_modes(solve, tmp_path):
    op2_module = pytest.importorskip("pyNastran.op2.op2")
    _, _, deck, out = solve(CASE + "FORCE = ALL\n", "EIGRL,1,,,2")
    files = export(out, deck, op2=True, paraview=True, say=lambda text: None)
    assert [f.name for f in files if "buckling" in f.name] == ["deck_buckling_2.vtkhdf"]
    op2 = op2_module.OP2(debug=None)
    op2.read_op2(files[0])
    (modes,) = op2.eigenvectors.values()
    assert modes.eigrs == pytest.approx(EULER * np.array([1.0, 1.5]), rel=1e-4)
    assert op2.op2_results.force.cbar_force[2].data.shape == (2, 10, 8)


def test_the_iteration_finds_what_the_dense_solution_finds(solve, monkeypatch):
    dense = solve(CASE, "EIGRL,1,,,6")[0]["buckling/2/factor"]
    monkeypatch.setattr(buckling, "DENSE_LIMIT", 0)
    found, said, *_ = solve(CASE, "EIGRL,1,,,6")
    assert found["buckling/2/factor"] == pytest.approx(dense, rel=1e-9)
    assert "MISSING" not in said
    band = solve(CASE, "EIGRL,1,0.,1.e7")[0]["buckling/2/factor"]
    assert band == pytest.approx(dense[dense < 1e7], rel=1e-9)


@pytest.mark.parametrize(("second", "count"), [("", 1), ("SPC = 2\n", 2)])
def test_subcases_on_the_same_supports_share_the_factorisation(
    solve, monkeypatch, second, count
):
    """Two loads, one column; the other way the second is hinged at its end."""
    monkeypatch.setattr(buckling, "DENSE_LIMIT", 0)
    factorized = []

    def counted(matrix, **how):
        factorized.append(how)
        return factorize(matrix, **how)

    monkeypatch.setattr(buckling, "factorize", counted)
    case = (
        f"SPC = 1\nSUBCASE 1\nLOAD = 7\nSUBCASE 2\n{second}LOAD = 9\nSUBCASE 3\n"
        f"METHOD = 1\nSTATSUB = 1\nSUBCASE 4\n{second}METHOD = 1\nSTATSUB = 2\n"
    )
    more = "SPC1,2,123456,1\nSPC1,2,3,11\nFORCE,9,11,,-2.,1.\nEIGRL,1,,,1"
    found = solve(case, more)[0]
    assert len(factorized) == count
    lowest = [found[f"buckling/{k}/factor"][0] for k in (3, 4)]
    assert lowest[0] == pytest.approx(EULER, rel=1e-3)
    if not second:
        assert lowest[1] == pytest.approx(0.5 * lowest[0], rel=1e-9)


def test_without_internal_forces_nothing_buckles(solve, monkeypatch):
    case = CASE.replace("LOAD = 7", "LOAD = 6")
    for limit in (400, 0):
        monkeypatch.setattr(buckling, "DENSE_LIMIT", limit)
        found, said, *_ = solve(case, "MOMENT,6,1,,1.,0.,0.,1.\nEIGRL,1,,,2")
        assert not len(found["buckling/2/factor"])
        assert "none in the range" in said


def test_what_has_no_differential_stiffness_is_said(solve):
    spring = "CELAS2,99,10.,11,1\nPLOAD4,9,98,1.\nEIGRL,1,,,1"
    shell = "GRID,21,,0.,5.,0.\nGRID,22,,1.,5.,0.\nGRID,23,,0.,6.,0.\n"
    shell += "CTRIA3,98,2,21,22,23\nPSHELL,2,1,.01,1\nSPC1,1,123456,21,THRU,23\n"
    said = solve(CASE, shell + spring)[1]
    assert "no differential stiffness of CELAS2" in said
    assert "no follower stiffness" in said


@pytest.mark.parametrize(("n", "coarse"), [(4, True), (8, False)])
def test_a_mesh_that_shows_no_half_wave_is_told(tmp_path, n, coarse):
    """Shells that do half of the work of a mode, and the notice below eight of them."""
    bulk = plate("CQUAD4", 1.0, n, (1.0, 0.0, 0.0))
    bulk.add("EIGRL", 1, 0.0, "", 1)
    case = "SPC = 1\nSUBCASE 1\n  LOAD = 7\nSUBCASE 2\n  METHOD = 1\n"
    path = tmp_path / "plate.bdf"
    path.write_text(bulk.deck(105, case))
    said: list[str] = []

    class Said(Quiet):
        def say(self, text):
            said.append(text)

    out = run_deck(
        fem.read_deck(path), tmp_path / "plate.h5", fem.Options(console=Said())
    )
    with h5py.File(out) as file:
        (count,) = file["buckling/2/shells_with_half_of_the_work"][:]
    x = np.pi * (np.arange(n) + 0.5) / n
    share = np.sort(np.outer(np.cos(x) ** 2, np.sin(x) ** 2).ravel())[::-1]
    expected = 1 + np.searchsorted(np.cumsum(share), 0.5 * share.sum())
    assert abs(count - expected) <= 1
    assert any("fewer than 8 shells" in text for text in said) == coarse


def test_columns_of_bars_are_never_told_to_be_coarse(solve):
    found, said, *_ = solve(CASE, "EIGRL,1,,,3")
    assert not found["buckling/2/shells_with_half_of_the_work"].any()
    assert not any("fewer than" in text for text in said)
