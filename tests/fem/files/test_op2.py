"""OP2 files: read back by pyNastran, against the result file and against NX's own."""

import logging
from pathlib import Path

import h5py
import numpy as np
import pytest

import fem
from fem.cli import _status
from fem.files.op2 import write_op2

DECK = """\
SOL {sol}
CEND
TITLE = ALL KINDS
SPC = 1
DISP = ALL
VELO = ALL
ACCE = ALL
SPCFORCES = ALL
FORCE = ALL
STRESS = ALL
{case}
BEGIN BULK
PARAM,POST,-1
MAT1,1,7.+10,,.33,2700.
MAT8,8,1.4+11,9.+9,.3,5.+9,5.+9,3.+9,1600.
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,,0.,0.,1.
GRID,6,,1.,0.,1.
GRID,7,,1.,1.,1.
GRID,8,,0.,1.,1.
GRID,9,,.5,.5,2.
SPOINT,20
PSHELL,1,1,.02,1,,1
PCOMP,3,,,,,,,,+
+,8,.001,0.,YES,8,.001,45.,YES,+
+,8,.002,90.,YES
PSOLID,4,1
PBAR,5,1,1.-3,1.-6,2.-6,5.-7,,,+
+,.1,.1,-.1,.1,-.1,-.1,.1,-.1
PBEAM,6,1,1.-3,1.-6,2.-6,,5.-7,,+
+,.1,.1,-.1,.1,-.1,-.1,.1,-.1
PROD,7,1,1.-3,1.-7,.1
PTUBE,8,1,.05,.002
PBUSH,9,K,1.+6,2.+6,3.+6,1.+4,2.+4,3.+4
PSHEAR,10,1,.001
CHEXA,101,4,1,2,3,4,5,6,+
+,7,8
CPYRAM,102,4,5,6,7,8,9
CQUAD4,111,1,1,2,6,5
CQUAD4,112,3,3,4,8,7
CTRIA3,113,1,5,6,9
CTRIA3,114,3,7,8,9
CBAR,121,5,1,9,0.,1.,0.
CBAR,122,5,2,9,0.,1.,0.
CBEAM,123,6,3,9,0.,1.,0.
CROD,124,7,4,9
CONROD,125,2,7,1,1.-3,1.-7
CTUBE,126,8,1,8
CBUSH,127,9,2,8,0.,1.,0.
CSHEAR,128,10,2,3,7,6
CELAS2,131,1.+5,9,1,20,0
CELAS2,132,1.+5,20,0
CMASS2,133,3.,20,0
CDAMP2,134,10.,9,1,20,0
CONM2,135,9,,5.
SPC1,1,123456,1,2,3,4
FORCE,10,9,,1000.,1.,.5,.2
FORCE,11,7,,-500.,0.,1.,0.
DAREA,20,9,1,1000.
TLOAD1,30,20,,LOAD,40
TABLED1,40
,0.,0.,.01,1.,1.,1.,ENDT
TSTEP,50,40,.001,5
EIGRL,60,,,4
ENDDATA
"""
CASES = {
    101: "SUBCASE 3\nLOAD = 10\nSUBCASE 7\nSUBTITLE = OTHER\nLOAD = 11",
    103: "METHOD = 60",
    109: "SUBCASE 4\nDLOAD = 30\nTSTEP = 50",
}


def read(path: Path):
    from pyNastran.op2.op2 import OP2

    logging.disable(logging.WARNING)
    try:
        model = OP2(debug=None)
        model.read_op2(str(path))
    finally:
        logging.disable(logging.NOTSET)
    return model


@pytest.fixture
def written(tmp_path):
    """Runs a deck; the result file, pyNastran's model of the OP2 file, what is left."""
    files = []

    def go(path):
        deck = fem.read_deck(path)
        results = fem.run_deck(deck, tmp_path / "model.h5")
        left = write_op2(results, fem.Structure.from_deck(deck), tmp_path / "model.op2")
        files.append(h5py.File(results))
        return files[-1], read(tmp_path / "model.op2"), left

    yield go
    for file in files:
        file.close()


@pytest.fixture
def small(written, tmp_path):
    def go(sol):
        path = tmp_path / "model.bdf"
        path.write_text(DECK.format(sol=sol, case=CASES[sol]))
        return written(path)

    return go


# Our columns in pyNastran's arrays, where those have more.
BAR_STRESS = [0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13]
COLUMNS = {
    "stress/CBAR": BAR_STRESS,
    "stress/CROD": [0, 2],
    "stress/CONROD": [0, 2],
    "stress/CTUBE": [0, 2],
    "stress/CSHEAR": [0, 1],
    "stress/CBEAM": [0, 1, 2, 3, 4, 5],
    "force/CBEAM": [1, 2, 3, 4, 5, 6, 7],
}


def compare_elements(group, model, subcase):
    """Every element table of a solution; the names of those compared."""
    found = []
    for kind in ("force", "stress"):
        for card, table in group[f"element_{kind}"].items():
            name = f"{card.lower()}_{kind}"
            theirs = getattr(model.op2_results, kind).__dict__[name][subcase]
            data = theirs.data[..., COLUMNS.get(f"{kind}/{card}", slice(None))]
            ours = table["value"][()]
            ours = ours.reshape(len(data), *ours.shape[-2:])
            e = len(table["id"])
            if "CQUAD4_COMPOSITE" in card or "CTRIA3_COMPOSITE" in card:
                known = np.isfinite(ours[0, 0])
                ours = ours[..., known]
            if card == "CBEAM":
                ends = theirs.element_node[:, 1] > 0
                data = data[:, ends]
            data = data.reshape(len(data), e, -1)
            assert data.shape == ours.shape, (name, data.shape, ours.shape)
            scale = np.abs(ours).max() + 1e-30
            np.testing.assert_allclose(data, ours, rtol=2e-6, atol=1e-6 * scale)
            assert np.isin(_ids(theirs), table["id"][:]).all()
            found.append(name)
    return found


def _ids(table):
    for name in ("element", "element_node", "element_layer"):
        ids = getattr(table, name, None)
        if ids is not None:
            return ids if ids.ndim == 1 else ids[:, 0]
    raise AssertionError(table)


def points(table, grids):
    """Values of grids and of the scalar point behind them."""
    nodes = table.node_gridtype[:, 0].tolist()
    return table.data[:, [nodes.index(g) for g in grids]]


def test_statics_of_two_subcases(small):
    file, model, left = small(101)
    assert left == []
    for subcase in (3, 7):
        group = file[f"static/{subcase}"]
        for ours, theirs in (
            ("displacement", model.displacements),
            ("spc_force", model.spc_forces),
        ):
            values = points(theirs[subcase], file["grid_id"][:])[0]
            expected = group[ours][:]
            atol = 1e-6 * np.abs(expected).max()
            np.testing.assert_allclose(values, expected, rtol=1e-6, atol=atol)
        scalar = points(model.displacements[subcase], [20])[0, 0, 0]
        assert scalar == pytest.approx(group["displacement_scalar_point"][0], rel=1e-6)
        compared = compare_elements(group, model, subcase)
        assert len(compared) >= 22, compared
    assert model.displacements[7].title.strip() == "ALL KINDS"


def test_histories(small):
    file, model, left = small(109)
    assert left == []
    group = file["transient/4"]
    for ours, theirs in (
        ("displacement", model.displacements),
        ("velocity", model.velocities),
        ("acceleration", model.accelerations),
        ("spc_force", model.spc_forces),
    ):
        np.testing.assert_allclose(theirs[4]._times, group["time"][:], atol=1e-7)
        values, expected = points(theirs[4], file["grid_id"][:]), group[ours][:]
        atol = 1e-6 * np.abs(expected).max()
        np.testing.assert_allclose(values, expected, rtol=1e-6, atol=atol)
    assert "cquad4_stress" in compare_elements(group, model, 4)


def test_modes(small):
    file, model, _ = small(103)
    shapes = model.eigenvectors[1]
    np.testing.assert_allclose(
        points(shapes, file["grid_id"][:]), file["modes/shape"][:], rtol=1e-5, atol=1e-6
    )
    np.testing.assert_array_equal(shapes.modes, [1, 2, 3, 4])
    np.testing.assert_allclose(
        shapes.mode_cycles, file["modes/frequency_hz"][:], rtol=1e-6
    )
    assert "cbar_force" in compare_elements(file["modes"], model, 1)


def test_the_same_tables_as_nx_wrote(written, references):
    """Ids, grids, layers and values of a commercial OP2 file, by the same reader."""
    folder = references / "solid_shell_bar"
    _, ours, _ = written(folder / "static_solid_shell_bar.bdf")
    theirs = read(folder / "static_solid_shell_bar.op2")
    compared = 0
    for kind in ("force", "stress"):
        tables = getattr(theirs.op2_results, kind).__dict__
        for name, cases in tables.items():
            if not isinstance(cases, dict) or 1 not in cases:
                continue
            a, b = getattr(ours.op2_results, kind).__dict__[name][1], cases[1]
            if a.data.shape != b.data.shape:
                # Corners are asked for by the deck, and may be left out here.
                assert name.startswith("cquad4_"), name
                continue
            for attribute in ("element", "element_node", "element_layer"):
                if hasattr(b, attribute) and "cbeam" not in name:
                    np.testing.assert_array_equal(
                        getattr(a, attribute), getattr(b, attribute)
                    )
            assert (a.element_type, a.num_wide) == (b.element_type, b.num_wide)
            scale = np.nanmax(np.abs(b.data))
            angle = a.get_headers().index("angle") if "angle" in a.get_headers() else -9
            keep = [k for k in range(b.data.shape[2]) if k != angle]
            np.testing.assert_allclose(
                a.data[..., keep], b.data[..., keep], rtol=1e-3, atol=2e-4 * scale
            )
            compared += 1
    assert compared >= 13


def test_command_line_writes_what_is_asked_for(tmp_path):
    """PARAM,POST,-1 asks for OP2; --no-op2 and --paraview from the command line."""
    path = tmp_path / "model.bdf"
    path.write_text(DECK.format(sol=101, case=CASES[101]))
    assert _status([str(path), "--out", str(tmp_path / "a")]) == 0
    names = {p.name for p in (tmp_path / "a").iterdir()}
    assert names == {".made-by", "model.h5", "model.op2"}
    assert sorted(read(tmp_path / "a" / "model.op2").displacements) == [3, 7]
    options = ["--out", str(tmp_path / "b"), "--no-op2", "--paraview"]
    assert _status([str(path), *options]) == 0
    assert {p.name for p in (tmp_path / "b").iterdir()} == {
        ".made-by",
        "model.h5",
        "model_static_3.vtkhdf",
        "model_static_7.vtkhdf",
    }
