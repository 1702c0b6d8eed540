"""The suite of decks tells right, wrong and refused apart."""

from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest

import fem
from benchmarks.suite import grid_forces
from benchmarks.suite.__main__ import summary
from benchmarks.suite.compare import differences
from benchmarks.suite.decks import decks, judge
from benchmarks.suite.mystran_listing import read_mystran
from benchmarks.suite.tables import listed, read_f06, read_op2
from fem.files.op2 import write_op2
from fem.model.structure import Structure
from fem.solution import run_deck

DECK = """\
SOL 103
CEND
METHOD = 1
SPC = 1
BEGIN BULK
EIGRL,1,,,3
GRID,1
GRID,2,,1.
GRID,3,,2.
CBAR,1,1,1,2,0.,1.,0.
CBAR,2,1,2,3,0.,1.,0.
PBAR,1,1,1.-4,1.-9,2.-9,1.-9
MAT1,1,7.+10,,.3,2700.
SPC1,1,123456,1
ENDDATA
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Three decks, each with the OP2 file of the first."""
    for name, text in (
        ("a_same.bdf", DECK),
        ("b_softer.bdf", DECK.replace("7.+10", "5.+10")),
        ("c_refused.bdf", DECK.replace("GRID,1", "CHACAB,1,1")),
    ):
        (tmp_path / name).write_text(text)
    deck = fem.read_deck(tmp_path / "a_same.bdf")
    results = run_deck(deck, tmp_path / "out" / "a.h5")
    op2 = tmp_path / "a_same.op2"
    write_op2(results, Structure(deck), op2)
    for name in ("b_softer.op2", "c_refused.op2"):
        (tmp_path / name).write_bytes(op2.read_bytes())
    (tmp_path / "d_alone.bdf").write_text(DECK)
    (tmp_path / "e_other.bdf").write_text(DECK.replace("SOL 103", "SOL 145"))
    return tmp_path


def test_decks_are_judged_by_the_files_beside_them(folder):
    found = [judge(deck, files, folder, 60.0) for deck, files in decks(folder)]
    verdicts = [outcome.verdict for outcome in found]
    assert verdicts == ["right", "wrong", "refused", "ran", "refused"]
    assert [outcome.declared for outcome in found] == [True] * 4 + [False]
    assert found[1].beyond["frequency"] == pytest.approx(1 - (5 / 7) ** 0.5, rel=1e-5)
    text = summary(found)
    assert "SOL 103: right 1, wrong 1, nothing in common 0, ran 1, refused 1" in text
    assert "other solutions: 1, crashed 0; 145 (1)" in text
    assert "1 x refused (0 by this alone): CHACAB (N card;" in text


def test_frequencies_of_a_listing_are_read(folder):
    hertz = read_op2(folder / "a_same.op2")["frequency", 1].values.ravel()
    rows = "\n".join(
        f"{k:9d}{k:10d}{w**2 * 39.47841760435743:20.6E}{w * 6.283185307:20.6E}"
        f"{w:20.6E}{1.0:20.6E}{w**2:20.6E}"
        for k, w in enumerate(hertz, start=1)
    )
    (folder / "a_same.f06").write_text(
        "1    TITLE\n0                    SUBCASE 1\n"
        f"               R E A L   E I G E N V A L U E S\n{rows}\n1\n"
    )
    theirs = read_f06(folder / "a_same.f06")
    (found,) = differences(read_op2(folder / "a_same.op2"), theirs)
    assert found.name == "frequency"
    assert found.value < 1e-6


def test_listings_of_mystran_are_read(folder):
    frequency = read_op2(folder / "a_same.op2")["frequency", 1].values.ravel()
    roots = "\n".join(
        f"{k:9d}{k:9d}{0.0:16.6E}{0.0:16.6E}{hertz:16.6E}{1.0:16.6E}{1.0:16.6E}"
        for k, hertz in enumerate(frequency, start=1)
    )
    (folder / "a_same.f06").write_text(
        " OUTPUT FOR SUBCASE        3\n             D I S P L A C E M E N T S\n"
        "    GRID     COORD      T1            T2\n"
        "       7        0  1.500000E-05  0.0   0.0  -2.0E-06  0.0  0.0\n"
        "                  ------------- -------------\n"
        " MAX (for output set):   1.5E-05  0.0  0.0  0.0  0.0  0.0\n"
        f"               R E A L   E I G E N V A L U E S\n\n{roots}\n"
        " OUTPUT FOR EIGENVECTOR        1\n             S P C   F O R C E S\n"
        "       7        0  1.0  0.0  0.0  0.0  0.0  0.0\n"
    )
    found = read_mystran(folder / "a_same.f06")
    assert set(found) == {("displacement", 3), ("frequency", 1)}
    assert found["displacement", 3].owner == [(7, 1)]
    assert found["displacement", 3].values[0, 0].tolist() == [1.5e-5, 0, 0, -2e-6, 0, 0]
    np.testing.assert_allclose(
        found["frequency", 1].values.ravel(), frequency, rtol=1e-6
    )


HARMONIC = (
    DECK.replace("SOL 103", "SOL 108")
    .replace("METHOD = 1", "FREQUENCY = 1\nDLOAD = 2\nDISP = ALL\nFORCE = ALL")
    .replace(
        "EIGRL,1,,,3",
        "FREQ,1,1.,2.\nRLOAD1,2,3,,,4\nDAREA,3,3,1,10.\nTABLED1,4\n"
        ",0.,1.,100.,1.,ENDT\nPARAM,G,.1",
    )
)


def test_complex_forces_are_compared(tmp_path):
    (tmp_path / "a.bdf").write_text(HARMONIC)
    deck = fem.read_deck(tmp_path / "a.bdf")
    results = run_deck(deck, tmp_path / "out" / "a.h5")
    assert write_op2(results, Structure(deck), tmp_path / "a.op2") == []
    ours = read_op2(tmp_path / "a.op2")
    axial = ours["force of CBAR", 1].values[:, :, 6]
    # Far below the first mode: K u with K (1 + ig) u = 10 N.
    assert axial[0, 1] == pytest.approx(10.0 / (1.0 + 0.1j), rel=1e-5)
    theirs = {k: replace(v, values=1.1j * v.values) for k, v in ours.items()}
    found = {d.name: d.value for d in differences(ours, theirs)}
    assert found["force of CBAR"] == pytest.approx(abs(1 - 1.1j) / 1.1, rel=1e-6)


def test_negative_load_factors_are_no_rounding():
    ours, theirs = (
        {("load factor", 1): listed(np.array(v))} for v in ([-2.0, -3.0], [-2.0, -4.0])
    )
    (found,) = differences(ours, theirs)
    assert found.value == pytest.approx(0.25)


def test_an_element_with_another_stiffness_is_found_by_its_forces(
    tmp_path, monkeypatch
):
    """Grid point forces under the displacements of a run, in frames of their own."""
    loaded = DECK.replace("SOL 103\nCEND\nMETHOD = 1", "SOL 101\nCEND\nLOAD = 2")
    loaded = loaded.replace("SPC = 1", "SPC = 1\nDISP = ALL\nGPFORCE = ALL")
    loaded = loaded.replace("GRID,3,,2.", "GRID,3,,2.,0.,0.,5\nFORCE,2,3,,1.,1.,2.,3.")
    loaded = loaded.replace("EIGRL,1,,,3", "CORD2R,5,,0.,0.,0.,0.,1.,1.,+\n+,1.")
    path = tmp_path / "deck.bdf"
    path.write_text(loaded)
    deck = fem.read_deck(path)
    with h5py.File(run_deck(deck, tmp_path / "deck.h5")) as file:
        u = np.asarray(file["static/1/displacement"]).ravel()
        group = file["static/1/grid_point_force"]
        names = [group[n][()] for n in ("grid_id", "element_id", "force")]
    forces: dict[int, dict[int, np.ndarray]] = {}
    for grid, element, row in zip(*names):
        if element > 0:
            forces.setdefault(int(element), {})[int(grid)] = row
    monkeypatch.setattr(grid_forces, "_states", lambda *_: [(u, forces)])
    same = grid_forces.compared(Structure(deck), path)
    assert same.keys() == {(1, "CBAR"), (2, "CBAR")}
    assert max(same.values()) < 1e-9
    softer = loaded.replace("CBAR,2,1", "CBAR,2,2")
    path.write_text(softer.replace("PBAR,1", "PBAR,2,1,1.-4,2.-9,2.-9,1.-9\nPBAR,1"))
    other = grid_forces.compared(Structure(fem.read_deck(path)), path)
    assert other[1, "CBAR"] < 1e-9 < 0.1 < other[2, "CBAR"]
