"""External superelements: the answers of the model whose matrices they have."""

from pathlib import Path

import h5py
import numpy as np
import pytest

from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.files.matrices import write_dmig, write_op4
from fem.matrix_files.named import NamedMatrix
from fem.model.structure import Structure
from fem.solution.run import run_deck

STEEL = "MAT1,3,7.+10,,.3,2700.\nPBAR,7,3,1.-3,2.-6,3.-6,4.-6\n"
FRAME = "CORD2R,5,,0.,0.,0.,0.,0.8,0.6\n,1.,0.,0.\n"
ROOT = "GRID,1,,0.,0.,0.\nCBAR,1,7,1,2,0.,0.,1.\nSPC1,5,123456,1\n"
JOINT = "GRID,2,,1.,0.,0.,5\n"
ARM = "GRID,3,,1.,2.,0.\nGRID,4,,1.,2.,-1.\n"
BARS = "CBAR,2,7,2,3,0.,0.,1.\nCBAR,3,7,3,4,0.,1.,0.\n"
LOADS = "FORCE,9,4,,1000.,0.3,0.,1.\nGRAV,8,,9.81,0.,0.,-1.\n"
ASSEMBLY = f"SECONCT,11,0\n,2,2,3,3,4,4\nBEGIN SUPER = 11\n{FRAME}{JOINT}{ARM}"
EXTRN = "EXTRN,2,123456,3,123456,4,123456\n"


def solve(folder: Path, sol: int, bulk: str, executive: str = "") -> np.ndarray:
    """Displacements of grid 4, or frequencies."""
    case = "SPC = 5\nMETHOD = 1\nLOAD = 9\nDISP = ALL\n"
    text = f"{executive}SOL {sol}\nCEND\n{case}BEGIN BULK\nEIGRL,1,,,6\n{bulk}ENDDATA\n"
    (folder / "model.bdf").write_text(text)
    deck = read_deck(folder / "model.bdf")
    with h5py.File(run_deck(deck, folder / "model.h5")) as file:
        if sol == 103:
            return np.asarray(file["modes/frequency_hz"])
        at = file["grid_id"][:].tolist().index(4)
        return np.asarray(file["static/1/displacement"][at])


@pytest.fixture
def component(tmp_path) -> list[NamedMatrix]:
    """Stiffness and mass of the arm, on its three grids."""
    (tmp_path / "arm.bdf").write_text(
        f"BEGIN BULK\n{STEEL}{FRAME}{JOINT}{ARM}{BARS}PARAM,COUPMASS,1\nENDDATA\n"
    )
    matrices = Structure(read_deck(tmp_path / "arm.bdf")).matrices
    rows = np.array([(g, c) for g in (2, 3, 4) for c in range(1, 7)])
    return [
        NamedMatrix(
            name=name, values=0.5 * (m + m.T).toarray(), rows=rows, columns=rows
        )
        for name, m in (("KAA", matrices.stiffness), ("MAA", matrices.mass))
    ]


WHOLE = f"PARAM,COUPMASS,1\n{STEEL}{FRAME}{ROOT}{JOINT}{ARM}{BARS}{LOADS}"
MAIN = f"PARAM,COUPMASS,1\n{STEEL}{FRAME}{ROOT}{JOINT}{ARM}{LOADS}"


@pytest.mark.parametrize("sol", [101, 103])
@pytest.mark.parametrize("how", ["op4 text", "op4 binary", "dmig"])
def test_matrices_of_another_run_stand_for_the_part(tmp_path, component, sol, how):
    theirs = solve(tmp_path, sol, WHOLE)
    if how == "dmig":
        named = [
            NamedMatrix(name=m.name + "X", values=m.values, rows=m.rows, columns=m.rows)
            for m in component
        ]
        write_dmig(tmp_path / "arm.pch", named)
        punched = (tmp_path / "arm.pch").read_text()
        bulk = f"SEBULK,11,EXTERNAL,,MANUAL\n{ASSEMBLY}{punched}"
        ours = solve(tmp_path, sol, MAIN + bulk)
    else:
        write_op4(tmp_path / "arm.op4", component, binary=how == "op4 binary")
        bulk = f"SEBULK,11,EXTOP4,,MANUAL,,,31\n{ASSEMBLY}{EXTRN}"
        assign = "ASSIGN INPUTT4='ARM.op4',UNIT=31\n"
        ours = solve(tmp_path, sol, MAIN + bulk, assign)
    np.testing.assert_allclose(
        ours, theirs, rtol=1e-6, atol=1e-8 * np.abs(theirs).max()
    )


@pytest.mark.parametrize(
    ("unit", "extrn", "said"),
    [
        (32, EXTRN, "unit 32 is assigned to no file.*assigned: 31"),
        (31, "EXTRN,2,123456\n", "KAA is 18 x 18, EXTRN has 6 freedoms"),
    ],
)
def test_what_does_not_fit_is_said(tmp_path, component, unit, extrn, said):
    write_op4(tmp_path / "arm.op4", component)
    bulk = f"SEBULK,11,EXTOP4,,MANUAL,,,{unit}\n{ASSEMBLY}{extrn}"
    with pytest.raises(InputError, match=said):
        solve(tmp_path, 101, MAIN + bulk, "ASSIGN INPUTT4='arm.op4',UNIT=31\n")


def test_gravity_does_not_act_on_their_mass_and_that_is_said(tmp_path, component):
    write_op4(tmp_path / "arm.op4", component)
    bulk = f"SEBULK,11,EXTOP4,,MANUAL,,,31\n{ASSEMBLY}{EXTRN}"
    text = (
        "ASSIGN INPUTT4='arm.op4',UNIT=31\nSOL 101\nCEND\nSPC=5\nLOAD=8\nBEGIN BULK\n"
        f"{MAIN}{bulk}ENDDATA\n"
    )
    (tmp_path / "model.bdf").write_text(text)
    deck = read_deck(tmp_path / "model.bdf")
    assert "GRAV, ACCEL, ACCEL1 and RFORCE do not act" in "".join(deck.notices)
    model = Structure(deck)
    tip = slice(18, 21)
    assert model.matrices.mass[tip, tip].toarray().any()
    assert not model.loaded_mass[tip, tip].toarray().any()


def test_equations_that_nobody_selects_may_name_absent_points(tmp_path):
    found = solve(tmp_path, 101, f"{WHOLE}MPC,77,4,1,1.,999,0,1.\n")
    np.testing.assert_allclose(found, solve(tmp_path, 101, WHOLE), rtol=1e-12)
