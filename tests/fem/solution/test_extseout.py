"""EXTSEOUT in SOL 103: modes of the component with its boundary held."""

import h5py
import numpy as np
import pytest

from fem.deck.reader import read_deck
from fem.solution.run import run_deck

BEAM = (
    "EIGRL,1,,,4\nMAT1,3,7.+10,,.3,2700.\nPBAR,7,3,1.-3,2.-6,3.-6,4.-6\n"
    + "".join(f"GRID,{k},,{k}.,0.,0.\n" for k in range(1, 6))
    + "".join(f"CBAR,{k},7,{k},{k + 1},0.,0.,1.\n" for k in range(1, 5))
)
QSET = "SPOINT,101,102\nQSET1,0,101,102\n"


def frequencies(tmp_path, case: str, bulk: str) -> np.ndarray:
    path = tmp_path / "model.bdf"
    path.write_text(
        f"SOL 103\nCEND\nMETHOD = 1\n{case}BEGIN BULK\n{BEAM}{bulk}ENDDATA\n"
    )
    with h5py.File(run_deck(read_deck(path), tmp_path / "model.h5")) as file:
        return np.asarray(file["modes/frequency_hz"])


@pytest.mark.parametrize(
    ("case", "bulk", "alone"),
    [
        ("", "BSET1,123456,1,5\n", "SPC1,9,123456,1,5\n"),
        ("SPC = 4\n", "SPC1,4,246,1,THRU,5\nASET1,135,5\n",
         "SPC1,9,246,1,THRU,5\nSPC1,9,135,5\n"),
        ("SPC = 4\n", "SPCADD,4,2,3\nSPC1,2,246,1,THRU,5\nSPC1,3,1,1\nBSET1,35,1\n",
         "SPC1,9,246,1,THRU,5\nSPC1,9,135,1\n"),
        ("", "BSET1,123456,1\nBSET1,3,5\nCSET1,12456,5\n",
         "SPC1,9,123456,1\nSPC1,9,3,5\n"),
    ],
)  # fmt: skip
def test_the_boundary_is_held(tmp_path, case, bulk, alone):
    extseout = "EXTSEOUT(ASMBULK,EXTBULK,EXTID=101,MATOP4=101)\n"
    ours = frequencies(tmp_path, f"{case}{extseout}", bulk + QSET)
    theirs = frequencies(tmp_path, "SPC = 9\n", alone)
    np.testing.assert_allclose(ours, theirs, rtol=1e-9)
