"""Complex element results in OP2 and PUNCH, read back by pyNastran."""

import h5py
import numpy as np
import pytest
from pyNastran.op2.op2 import OP2

import fem
from fem.files.export import export
from fem.solution import run_deck

DECK = """\
SOL 108
CEND
SPC = 1
DLOAD = 5
FREQUENCY = 3
DISP({form}) = ALL
STRESS(CORNER,{form}) = ALL
STRAIN(CORNER,{form}) = ALL
FORCE({form}) = ALL
BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,,0.,0.,1.
GRID,6,,1.,0.,1.
GRID,7,,1.,1.,1.
GRID,8,,0.,1.,1.
MAT1,1,7.+10,,.3,2700.,,,.04
CQUAD4,1,1,5,6,7,8
CTRIA3,9,1,5,6,7
PSHELL,1,1,.02,1
CHEXA,2,2,1,2,3,4,5,6
,7,8
PSOLID,2,1
CBAR,3,3,6,7,1.,0.,0.
PBAR,3,1,.01,1.-5,2.-5,1.-5,,,+
+,.1,.1,-.1,.1,.1,-.1,-.1,-.1
CROD,4,4,5,7
PROD,4,1,.01,1.-5,.1
CBEAM,5,5,7,8,0.,1.,0.
PBEAM,5,1,.01,1.-5,2.-5,,1.-5,,+
+,.1,.1,-.1,.1,.1,-.1,-.1,-.1
CBUSH,6,6,5,8,,,,0
PBUSH,6,K,1.+6,2.+6,3.+6,4.+4,5.+4,6.+4
CELAS2,7,1.+6,5,1,8,2
CDAMP2,8,1.+4,5,3,8,3
CSHEAR,10,7,1,2,6,5
PSHEAR,7,1,.01
SPC1,1,123,1,2,3,4
SPC1,1,6,5,6,7,8
DAREA,9,7,1,1.+4,7,3,500.
DAREA,9,6,2,2.+3
DPHASE,8,6,2,70.
RLOAD1,5,9,,8,1.
FREQ,3,2.,60.
ENDDATA
"""
FORCES = {
    "CBAR": "cbar_force",
    "CROD": "crod_force",
    "CBUSH": "cbush_force",
    "CELAS2": "celas2_force",
    "CDAMP2": "cdamp2_force",
    "CSHEAR": "cshear_force",
    "CTRIA3": "ctria3_force",
}
STRESSES = {"CROD": "crod", "CELAS2": "celas2", "CBUSH": "cbush"}


@pytest.fixture(scope="module", params=["REAL", "PHASE"])
def written(request, tmp_path_factory):
    """The result file, the OP2 file as read, PUNCH, how complex numbers stand there."""
    path = tmp_path_factory.mktemp("complex") / "deck.bdf"
    path.write_text(DECK.format(form=request.param))
    deck = fem.read_deck(path)
    out = run_deck(deck, path.with_suffix(".h5"))
    left: list[str] = []
    files = export(out, deck, op2=True, punch=True, paraview=False, say=left.append)
    op2 = OP2(debug=None)
    op2.read_op2(str(next(f for f in files if str(f).endswith("op2"))))
    punch = next(f for f in files if str(f).endswith("pch")).read_text()
    return out, op2, punch, request.param, left


def table(out, name):
    with h5py.File(out) as file:
        group = file[f"frequency/1/{name}"]
        return list(group.attrs["columns"]), group["value"][:]


def same(theirs, ours):
    """pyNastran turns magnitudes and degrees of headers that say so into both parts."""
    scale = np.abs(ours).max()
    np.testing.assert_allclose(theirs, ours, rtol=2e-5, atol=2e-6 * scale)


@pytest.mark.parametrize("card", FORCES)
def test_forces(written, card):
    out, op2, _, _, _ = written
    found = getattr(op2.op2_results.force, FORCES[card])[1]
    _, ours = table(out, f"element_force/{card}")
    same(found.data.reshape(ours.shape), ours)


def test_forces_at_ends_and_corners(written):
    out, op2, _, _, _ = written
    _, plate = table(out, "element_force/CQUAD4")
    found = op2.op2_results.force.cquad4_force[1].data
    same(found.reshape(plate.shape), plate)
    _, beam = table(out, "element_force/CBEAM")
    found = op2.op2_results.force.cbeam_force[1].data
    same(found[:, [0, -1], 1:].reshape(beam.shape), beam)


@pytest.mark.parametrize("kind", ["stress", "strain"])
def test_stresses(written, kind):
    out, op2, _, _, _ = written
    results = getattr(op2.op2_results, kind)
    for card, name in STRESSES.items():
        _, ours = table(out, f"element_{kind}/{card}")
        same(getattr(results, f"{name}_{kind}")[1].data.reshape(ours.shape), ours)
    columns, ours = table(out, f"element_{kind}/CHEXA")
    keep = [k for k, c in enumerate(columns) if "mises" not in c]
    same(
        getattr(results, f"chexa_{kind}")[1].data.reshape(2, 1, -1),
        ours[..., keep],
    )
    for card in ("CQUAD4", "CTRIA3"):
        columns, ours = table(out, f"element_{kind}/{card}")
        keep = [
            k for k, c in enumerate(columns) if "mises" not in c and "fibre" not in c
        ]
        found = getattr(results, f"{card.lower()}_{kind}")[1]
        same(found.data[..., -3:].reshape(2, 1, -1), ours[..., keep])
    columns, ours = table(out, f"element_{kind}/CBAR")
    found = getattr(results, f"cbar_{kind}")[1].data
    same(found[..., :9].reshape(ours.shape), ours)


def test_punch_has_both_parts(written):
    out, _, punch, form, left = written
    heading = {"REAL": "$REAL-IMAGINARY OUTPUT", "PHASE": "$MAGNITUDE-PHASE OUTPUT"}
    assert heading[form] in punch
    assert "$FREQUENCY =" in punch
    with h5py.File(out) as file:
        u = file["frequency/1/displacement"][0, 6]
    lines = punch.splitlines()
    at = next(k for k, line in enumerate(lines) if line.startswith(f"{7:10d}       G"))
    words = "".join(line[18:72] for line in lines[at : at + 4]).split()
    numbers = np.array(words, float)
    first, second = (
        (u.real, u.imag) if form == "REAL" else (np.abs(u), np.degrees(np.angle(u)))
    )
    if form == "PHASE":
        second = second % 360.0
    np.testing.assert_allclose(numbers, [*first, *second], rtol=1e-5, atol=1e-12)
    assert any("CSHEAR" in text for text in left)
