"""Decks run from the command line: reference solvers, result files, messages."""

import json
import logging
import subprocess
import sys

import h5py
import numpy as np
import pytest

import fem
from fem.cli import _status
from fem.solution import run_deck


@pytest.fixture
def run(tmp_path):
    """Runs a deck given as text or as a path; returns the open result file."""
    files = []

    def go(deck, *, ignore=(), **options):
        if isinstance(deck, str):
            path = tmp_path / "model.bdf"
            path.write_text(deck)
        else:
            path = deck
        out = tmp_path / f"{path.stem}.h5"
        run_deck(fem.read_deck(path, ignore=ignore), out, fem.Options(**options))
        files.append(h5py.File(out))
        return files[-1]

    yield go
    for file in files:
        file.close()


def op2_of(path):
    from pyNastran.op2.op2 import OP2

    logging.disable(logging.WARNING)
    try:
        model = OP2(debug=None)
        model.read_op2(str(path))
    finally:
        logging.disable(logging.NOTSET)
    return model


@pytest.fixture(scope="session")
def cantilever(references):
    folder = references / "cantilever"
    return folder, json.loads((folder / "nastran95_cantilever.json").read_text())


def test_step_response_against_nastran95(run, cantilever):
    """400 steps of a bar with an offset mass, G/W3 damping: every printed value."""
    folder, expected = cantilever
    file = run(folder / "cant_a_tran.bdf")
    rows = np.array(expected["cant_a"]["transient"]["11"])
    np.testing.assert_allclose(file["transient/1/time"][:], rows[:, 0], atol=1e-6)
    tip = file["transient/1/displacement"][:, 10]
    peak = np.abs(rows[:, 1:]).max(axis=0)
    assert np.all(np.abs(tip - rows[:, 1:]) <= 1e-6 * peak + 1e-30)
    uz = tip[:, 2]
    assert uz.max() == pytest.approx(0.03446439, rel=1e-6)
    assert file["transient/1/time"][uz.argmax()] == pytest.approx(0.036)


def test_bar_forces_of_the_step_response_against_nastran95(run, cantilever):
    folder, expected = cantilever
    file = run(folder / "cant_a_tran.bdf")
    rows = np.array(expected["cant_a"]["cbar101_force"]["rows"])[:, 1:]
    table = file["transient/1/element_force/CBAR"]
    assert table["id"][0] == 101
    forces = table["value"][:, 0]
    peak = np.abs(rows).max(axis=0)
    assert np.all(np.abs(forces - rows) <= 1e-5 * peak + 1e-12)


def test_step_response_against_opensees(run, cantilever):
    """Newmark with β = 1/4 there: the curves differ by the order of the step only."""
    folder, _ = cantilever
    other = json.loads((folder / "opensees_cantilever.json").read_text())
    file = run(folder / "cant_a_tran.bdf")
    uz = file["transient/1/displacement"][:, 10, 2]
    theirs = np.array(other["cant_a_consistent"]["tip_uz"])
    assert np.abs(uz - theirs).max() < 1e-3 * theirs.max()


def test_statics_and_modes_against_nastran95(run, cantilever):
    folder, expected = cantilever
    static = run(folder / "cant_a_stat.bdf")
    rows = expected["cant_a"]["static"]
    theirs = np.array([rows[str(g)] for g in range(1, 12)])
    ours = static["static/1/displacement"][:]
    np.testing.assert_allclose(ours, theirs, rtol=1e-6, atol=1e-12)
    modes = run(folder / "cant_a_modes.bdf")["modes/frequency_hz"][:]
    hz = expected["cant_a"]["hz"][: len(modes)]
    np.testing.assert_allclose(modes, hz, rtol=1e-6)


def test_forces_of_constraint_balance_the_load(run, cantilever):
    """Statics: reaction = load; transient: reaction = inertia forces + load."""
    folder, _ = cantilever
    static = run(folder / "cant_a_stat.bdf")
    reaction = static["static/1/spc_force"][0]
    np.testing.assert_allclose(reaction[:3], [0, 0, -100], atol=1e-8)
    assert reaction[4] == pytest.approx(100.0, rel=1e-9)  # r × F of the tip load


def test_transient_forces_of_constraint_balance_load_and_inertia(run, tmp_path):
    case = "SPC=1\nTSTEP=51\nDLOAD=30\nSPCFORCES=ALL\n"
    file = run(BEAM.format(sol=109, case=case, bulk="PARAM,G,.02\nPARAM,W3,300."))
    structure = fem.Structure.from_deck(fem.read_deck(tmp_path / "model.bdf"))
    vertical = np.zeros(18)
    vertical[2::6] = 1.0
    a = file["transient/1/acceleration"][:].reshape(-1, 18)
    time = file["transient/1/time"][:]
    # A TABLED1 goes on beyond its last points as the line through them.
    load = 50.0 * np.minimum(time / 0.01, 2.0 - time / 0.01)
    total = file["transient/1/spc_force"][:].sum(axis=1)[:, 2]
    inertia = a @ (structure.matrices.mass @ vertical)
    # The scheme balances loads averaged over three steps, which shows at the peak.
    error = np.abs(total - (inertia - load))[1:]
    assert error.max() < 3e-3 * np.abs(total).max()


def test_line_elements_with_initial_state_against_nx(run, references):
    """CBAR, CBEAM, CTUBE, CELAS3, scalar points, PLOAD1, SLOAD, LSEQ, TIC; no CBEND."""
    folder = references / "transient_1d"
    bends = ["CBEND", "PBEND"]
    file = run(folder / "tst1d3.bdf", ignore=bends, bar_loads=False)
    other = op2_of(folder / "tst1d3.op2")
    theirs = other.displacements[10]
    np.testing.assert_allclose(file["transient/10/time"][:], theirs._times, atol=1e-7)
    nodes = theirs.node_gridtype[:, 0].tolist()
    ours = file["transient/10/displacement"][:]
    for i, grid in enumerate(file["grid_id"][:]):
        if grid == 7:  # the end of the CBEND
            continue
        np.testing.assert_allclose(
            ours[:, i], theirs.data[:, nodes.index(grid)], rtol=1e-6, atol=1e-12
        )
    scalar = file["transient/10/displacement_scalar_point"][:]
    for i, point in enumerate(file["scalar_point_id"][:]):
        np.testing.assert_allclose(
            scalar[:, i], theirs.data[:, nodes.index(point), 0], rtol=1e-6
        )
    stress = other.op2_results.stress
    bar = stress.cbar_stress[10].data[:, 0]
    columns = [0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13]
    group = file["transient/10/element_stress"]
    np.testing.assert_allclose(
        group["CBAR/value"][:, 0], bar[:, columns], rtol=2e-6, atol=1e-6
    )
    beam = stress.cbeam_stress[10].data
    ends = np.concatenate([beam[:, 0, :6], beam[:, -1, :6]], axis=1)
    np.testing.assert_allclose(group["CBEAM/value"][:, 0], ends, rtol=2e-6, atol=1e-6)
    np.testing.assert_allclose(
        group["CELAS3/value"][:, 0, 0], stress.celas3_stress[10].data[:, 0, 0]
    )


def test_shells_solids_and_bars_in_a_transient_against_nx(run, references, tmp_path):
    """Displacements, constraint forces, element forces and stresses at 21 times.

    The published results belong to an earlier state of the deck, as their loads and
    tables show: without springs, damper, shear panel and CONROD.
    """
    folder = references / "solid_shell_bar"
    later = ("CELAS", "PELAS", "CSHEAR", "PSHEAR", "CDAMP2", "CONROD")
    text = (folder / "transient_solid_shell_bar.bdf").read_text()
    lines = [line for line in text.splitlines() if not line.startswith(later)]
    (tmp_path / "geom.inc").write_text((folder / "geom.inc").read_text())
    file = run("\n".join(lines) + "\n")["transient/1"]
    other = op2_of(folder / "transient_solid_shell_bar.op2")
    times = other.displacements[1]._times.round(9)
    first = np.unique(times, return_index=True)[1]  # the table is there twice

    def agree(ours, theirs, tolerance=1e-5):
        scale = np.abs(theirs).max(axis=(0, 1))
        assert np.all(np.abs(ours - theirs) <= tolerance * scale + 1e-12)

    np.testing.assert_allclose(file["time"][:], times[first], atol=1e-8)
    agree(file["displacement"][:], other.displacements[1].data[first])
    agree(file["spc_force"][:], other.spc_forces[1].data)
    force, stress = other.op2_results.force, other.op2_results.stress
    agree(file["element_force/CBAR/value"][:], force.cbar_force[1].data)
    agree(file["element_force/CROD/value"][:], force.crod_force[1].data)
    agree(file["element_force/CTRIA3/value"][:], force.ctria3_force[1].data)
    quads = force.cquad4_force[1].data
    agree(file["element_force/CQUAD4/value"][:].reshape(quads.shape), quads)
    columns = [0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13]
    agree(
        file["element_stress/CBAR/value"][:],
        stress.cbar_stress[1].data[:, :, columns],
    )


BEAM = """\
SOL {sol}
CEND
{case}
BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,2.,0.,0.
CBAR,1,1,1,2,0.,0.,1.
CBAR,2,1,2,3,0.,0.,1.
PBAR,1,1,1.-3,1.-6,2.-6,1.-6
MAT1,1,7.+10,,.3,2700.
SPC1,1,123456,1
FORCE,10,3,,50.,0.,0.,1.
FORCE,11,3,,-70.,0.,1.,0.
GRAV,12,,9.81,0.,0.,-1.
DAREA,20,3,3,50.
DAREA,21,3,2,-70.
TLOAD1,30,20,,LOAD,40
TLOAD1,31,21,,LOAD,40
TABLED1,40
,0.,0.,.01,1.,.02,0.,ENDT
TSTEP,50,60,.0005,7
,,40,.001,10
TSTEP,51,600,.00005,10
EIGRL,60,,,5
{bulk}
ENDDATA
"""


def test_subcases_of_statics_are_a_block_and_equal_single_ones(run):
    case = "SPC=1\nDISP=ALL\nFORCE=ALL\nSTRESS=ALL\nSUBCASE 1\nLOAD=10\n"
    both = run(BEAM.format(sol=101, case=case + "SUBCASE 5\nLOAD=11", bulk=""))
    one = both["static/1/displacement"][2, 2]
    assert one == pytest.approx(50 * 2**3 / (3 * 7e10 * 1e-6), rel=1e-3)
    table = both["static/5/element_force/CBAR"]
    assert next(iter(table.attrs["columns"])) == "bending_moment_a1"
    assert np.abs(table["value"][0, :2]).max() == pytest.approx(140.0, rel=1e-9)
    single = "SPC=1\nLOAD=11\n"
    alone = run(BEAM.format(sol=101, case=single, bulk=""))
    np.testing.assert_allclose(
        alone["static/1/displacement"][:], both["static/5/displacement"][:], rtol=1e-12
    )


def test_subcases_of_transients_are_a_block_and_equal_single_ones(run):
    head = "SPC=1\nTSTEP=50\nDISP=ALL\nSPCFORCES=ALL\nSTRESS=ALL\n"
    case = head + "SUBCASE 1\nDLOAD=30\nSUBCASE 2\nDLOAD=31\n"
    both = run(BEAM.format(sol=109, case=case, bulk="PARAM,G,.02\nPARAM,W3,300."))
    alone = run(
        BEAM.format(sol=109, case=head + "DLOAD=31", bulk="PARAM,G,.02\nPARAM,W3,300.")
    )
    for name in ("time", "displacement", "acceleration", "spc_force"):
        theirs = alone[f"transient/1/{name}"][:]
        scale = np.abs(theirs).max()
        np.testing.assert_allclose(
            both[f"transient/2/{name}"][:], theirs, atol=1e-9 * scale
        )
    # Every 7th step of the first 60, every 10th of the next 40, and the last.
    time = both["transient/1/time"][:]
    expected = np.append(np.arange(0, 60, 7) * 5e-4, 0.03 + np.arange(0, 50, 10) * 1e-3)
    np.testing.assert_allclose(time, expected, atol=1e-12)


def test_modal_transient_with_residual_vectors_follows_the_direct_one(run):
    head = "SPC=1\nTSTEP=51\nDLOAD=30\nMETHOD=60\nDISP=ALL\n"
    params = "PARAM,G,.02\nPARAM,W3,300."
    direct = run(BEAM.format(sol=109, case=head, bulk=params))
    modal = run(BEAM.format(sol=112, case=head, bulk=params))
    theirs = direct["transient/1/displacement"][:, 2, 2]
    ours = modal["transient/1/displacement"][:, 2, 2]
    assert np.abs(ours - theirs).max() < 5e-3 * np.abs(theirs).max()


def test_sets_limit_what_is_written(run):
    case = (
        "SPC=1\nTSTEP=50\nDLOAD=30\nSET 1 = 2\nSET 2 = 1,3\nDISP=1\nVELO=NONE\n"
        "SPCFORCES=2\nFORCE=1\n"
    )
    group = run(BEAM.format(sol=109, case=case, bulk=""))["transient/1"]
    assert group["displacement_grid_id"][:].tolist() == [2]
    assert group["displacement"].shape[1:] == (1, 6)
    assert group["spc_force_grid_id"][:].tolist() == [1, 3]
    assert group["spc_force"].shape[1:] == (2, 6)
    assert "velocity" not in group
    # Nobody asked for it: of the grids whose motion was asked for.
    assert group["acceleration_grid_id"][:].tolist() == [2]
    assert group["element_force/CBAR/id"][:].tolist() == [2]


def test_grid_point_forces_balance_and_strain_energy_is_the_work(run):
    case = "SPC=1\nLOAD=10\nGPFORCE=ALL\nESE=ALL\nOLOAD=ALL"
    group = run(BEAM.format(sol=101, case=case, bulk=""))["static/1"]
    balance = group["grid_point_force"]
    source = balance["source"].asstr()[:]
    force = balance["force"][:]
    np.testing.assert_allclose(force[source == "*TOTALS*"], 0.0, atol=1e-7)
    at = (balance["grid_id"][:] == 2) & (source == "CBAR")
    assert balance["element_id"][at].tolist() == [1, 2]
    # Bar 1 holds grid 2 against the shear force of the tip load.
    assert force[at][0, 2] == pytest.approx(-50.0, rel=1e-9)
    energy = group["strain_energy/CBAR/value"][:].sum()
    work = 0.5 * (group["displacement"][:] * group["applied_load"][:]).sum()
    assert energy == pytest.approx(work, rel=1e-9)


def test_grid_point_forces_against_nx(run, references):
    folder = references / "solid_shell_bar"
    file = run(folder / "static_solid_shell_bar.bdf")
    theirs = op2_of(folder / "static_solid_shell_bar.op2").grid_point_forces[1]
    balance = file["static/1/grid_point_force"]
    ours = {
        (int(g), int(e)): f
        for g, e, f in zip(
            balance["grid_id"][:], balance["element_id"][:], balance["force"][:]
        )
        if e
    }
    pairs = theirs.node_element.reshape(-1, 2)
    compared = 0
    for (grid, element), force in zip(pairs.tolist(), theirs.data[0]):
        if element and (grid, element) in ours:
            np.testing.assert_allclose(ours[grid, element], force, atol=0.05)
            compared += 1
    assert compared > 60


def test_enforced_displacement_and_its_reaction(run):
    bulk = "SPC1,2,2346,3\nSPCADD,3,1,2\nSPCD,13,3,3,.01"
    file = run(BEAM.format(sol=101, case="SPC=3\nLOAD=13\nDISP=ALL", bulk=bulk))
    assert file["static/1/displacement"][2, 2] == pytest.approx(0.01)
    force = file["static/1/spc_force"][:]
    np.testing.assert_allclose(force[:, :3].sum(axis=0), 0, atol=1e-7)
    assert abs(force[2, 2]) == pytest.approx(0.01 * 3 * 7e10 * 1e-6 / 8, rel=1e-3)


@pytest.mark.parametrize("inrel", [-1, -2])
def test_inertia_relief_of_a_free_beam(run, inrel):
    """A central force on three lumped masses: the ends bend back symmetrically."""
    bulk = f"PARAM,INREL,{inrel}\nFORCE,14,2,,100.,0.,0.,1.\nSUPORT,2,123456\n"
    bulk += "CONM2,91,1,,1.\n,1.,,1.,,,1.\nCONM2,93,3,,1.\n,1.,,1.,,,1.\n"
    file = run(BEAM.format(sol=101, case="LOAD=14\nFORCE=ALL", bulk=bulk))
    u = file["static/1/displacement"][:]
    np.testing.assert_allclose(u[0, 2], u[2, 2], rtol=1e-9)
    sag = u[1, 2] - u[0, 2]
    # Lumped: bar ends carry a quarter of its mass of 5.4, plus 1 each.
    end = 1.0 + 2.7 / 2
    force = 100.0 * end / (2 * end + 2.7)
    assert sag == pytest.approx(force / (3 * 7e10 * 1e-6), rel=0.02)
    if inrel == -1:
        np.testing.assert_allclose(u[1], 0.0, atol=1e-15)
    np.testing.assert_allclose(file["static/1/spc_force"][:], 0.0, atol=1e-9)


def test_mode_shapes_and_mass_normalisation(run):
    file = run(BEAM.format(sol=103, case="SPC=1\nMETHOD=60\nFORCE=ALL", bulk=""))
    assert file["modes/shape"].shape == (5, 3, 6)
    np.testing.assert_allclose(file["modes/modal_mass"][:], 1.0, rtol=1e-10)
    assert file["modes/element_force/CBAR/value"].shape == (5, 2, 8)
    _, counted, found = file["modes/sturm"][-1]
    assert counted == found
    scaled = run(
        BEAM.format(sol=103, case="SPC=1\nMETHOD=61", bulk="EIGRL,61,,,5,,,,MAX")
    )
    largest = np.abs(scaled["modes/shape"][:]).max(axis=(1, 2))
    np.testing.assert_allclose(largest, 1.0)


def test_mass_properties_are_written(run):
    file = run(BEAM.format(sol=103, case="SPC=1\nMETHOD=60", bulk=""))
    assert file["mass/total"][()] == pytest.approx(5.4)
    np.testing.assert_allclose(file["mass/cg"][:], [1, 0, 0], atol=1e-12)
    assert file["mass/inertia"].shape == (3, 3)


@pytest.mark.parametrize(
    ("sol", "case", "bulk", "words"),
    [
        (105, "SPC=1", "", "SOL 105"),
        (101, "LOAD=10", "", "singular"),
        (103, "SPC=1", "", "SOL 103 needs METHOD"),
        (109, "SPC=1\nDLOAD=30", "", "TSTEP"),
        (109, "SPC=1\nTSTEP=50", "", "neither DLOAD nor IC"),
        (101, "LOAD=10", "PARAM,INREL,-1", "SUPORT"),
        (101, "LOAD=10\nSPC=1", "PARAM,INREL,-2", "held"),
        (103, "SPC=1\nMETHOD=62", "EIGRL,62,9.,5.", "ascend"),
    ],
)
def test_bad_requests_end_with_one_message(tmp_path, capsys, sol, case, bulk, words):
    path = tmp_path / "bad.bdf"
    path.write_text(BEAM.format(sol=sol, case=case, bulk=bulk))
    assert _status([str(path), "--out", str(tmp_path / "out")]) == 2
    captured = capsys.readouterr()
    assert words in captured.err
    assert "Traceback" not in captured.err
    assert not list((tmp_path / "out").glob("*")) if (tmp_path / "out").exists() else 1


def test_command_line_writes_the_file_and_tells(tmp_path):
    path = tmp_path / "beam.bdf"
    path.write_text(BEAM.format(sol=103, case="SPC=1\nMETHOD=60", bulk=""))
    done = subprocess.run(
        [sys.executable, "-m", "fem", str(path), "--out", str(tmp_path / "r")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "mass 5.4" in done.stdout
    assert "none missed" in done.stdout
    assert {p.name for p in (tmp_path / "r").iterdir()} == {".made-by", "beam.h5"}


@pytest.mark.parametrize("arguments", [[], ["no.bdf", "--nonsense"], ["absent.bdf"]])
def test_wrong_usage_has_status_two(arguments, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert _status(arguments) == 2
    assert "Traceback" not in capsys.readouterr().err


def test_envelope_is_the_extreme_of_the_history(tmp_path):
    path = tmp_path / "beam.bdf"
    case = "SPC=1\nTSTEP=50\nDLOAD=30\nSTRESS=ALL\nFORCE=ALL"
    path.write_text(BEAM.format(sol=109, case=case, bulk=""))
    assert _status([str(path), "--out", str(tmp_path), "--envelope"]) == 0
    with h5py.File(tmp_path / "beam.h5") as file:
        time = file["transient/1/time"][:]
        for kind in ("force", "stress"):
            history = file[f"transient/1/element_{kind}/CBAR/value"][:]
            group = file[f"transient/1/envelope/{kind}/CBAR"]
            np.testing.assert_array_equal(group["max"][:], history.max(axis=0))
            np.testing.assert_array_equal(group["min"][:], history.min(axis=0))
            np.testing.assert_array_equal(
                group["time_of_max"][:], time[history.argmax(axis=0)]
            )
            np.testing.assert_array_equal(
                group["time_of_min"][:], time[history.argmin(axis=0)]
            )
