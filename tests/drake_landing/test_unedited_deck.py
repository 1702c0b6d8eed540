"""A deck as other offices have it goes through check and run as it is.

Weights with WTMASS, an aeroelastic solution with its cards and subcases, names of the
preprocessor, shells whose MCID stands on them, a superelement, a reduction: nothing of
it is edited, and the model is that of the deck in plain form.
"""

import re
from pathlib import Path

import pytest

import fem
from drake_landing.cli import app, guarded

HERE = Path(__file__).parent
GRAVITY = 9.80665
CASE = HERE.joinpath("tiny_case.yaml").read_text()
PLAIN = HERE.joinpath("tiny_aircraft.bdf").read_text()

# A fin of sheet on the tail: the x axis of CORD2R 20 is normal to it.
SHELLS = """\
$ Pset: "fin_skin" will be imported as: "pshell.77"
PSHELL  77      78      .002    78              78
MAT1,78,7.+10,,.33,0.
CORD2R,20,,0.,0.,0.,1.,0.,0.
,0.,1.,0.
GRID,971,,14.,0.,1.
GRID,972,,16.,0.,1.
CQUAD4,977,77,8,9,972,971,20
"""
EXECUTIVE = """\
$ NASTRAN input file created by the Patran input file translator
ASSIGN OUTPUT2='unedited.op2', UNIT=12
SOL 144
CEND
TITLE = TRIM OF THE WHOLE
ECHO = NONE
AECONFIG = AeroSG2D
SUPORT1 = 1
SUBCASE 1
$ Subcase name : level flight
   SUBTITLE = LEVEL
   TRIM = 1
   AESYMXZ = Symmetric
   APRES = ALL
   AEROF = ALL
   DISPLACEMENT(PLOT,SORT1,REAL) = ALL
   STRESS(PLOT,SORT1,REAL,VONMISES,BILIN) = ALL
SUBCASE 2
   TRIM = 2
   AEROF = ALL
BEGIN BULK
"""
AEROELASTIC = """\
$ Elements and Element Properties for region : wing
PARAM,AUNITS,.1019716
PARAM,WTMASS,.10197162
PARAM,POST,0
PARAM,PRTMAXIM,YES
AERO,0,1.,2.,1.225
AEROS,0,0,2.,16.,32.
AESTAT,1,ANGLEA
AESTAT,2,URDD3
AELIST,30,1001,THRU,1004
AESURF,40,ELEV,20,30
CAERO1,1001,1,0,2,2,,,1
,7.,0.,0.,2.,7.,8.,0.,2.
PAERO1,1
SPLINE1,50,1001,1001,1004,60
SET1,60,21,22,23
TRIM,1,.3,6000.,ANGLEA,0.,URDD3,1.
TRIM,2,.5,9000.,ANGLEA,.02
FLFACT,70,1.
FLUTTER,71,PK,70,70,70
MKAERO1,.3
,.01,.1
GUST,72,73,1.,0.,40.
DIVERG,74,2,.3
SUPORT1,1,5,3
"""


def weights(text: str) -> str:
    """Masses of CONM2 as weights: first line and inertias."""

    lines, inertia = [], False
    for line in text.splitlines():
        fields = line.split(",")
        if inertia:
            line = ",".join(["", *(_real(f) for f in fields[1:])])
        inertia = fields[0] == "CONM2"
        if inertia:
            line = ",".join([*fields[:4], _real(fields[4])])
        lines.append(line)
    return "\n".join(lines) + "\n"


def _real(field: str) -> str:
    return f"{float(field) * GRAVITY:.7e}" if field.strip() else ""


def unedited() -> str:
    """The tiny aircraft as somebody else would have written it."""
    bulk = weights(PLAIN.split("BEGIN BULK\n")[1].split("ENDDATA")[0])
    tip = re.compile(r"GRID,24,.*\nCONM2,513,24,.*\n.*\nCBAR,112,.*\n")
    part = tip.search(bulk)
    assert part is not None
    bulk = bulk.replace(part.group(), "")
    frame = "CORD2R,10,,0.,0.,0.,1.,1.,1.\n,1.,0.,0.\n"
    materials = "MAT1,1,7.+10,,.33,0.\nPBAR,2,1,.01,2.8-4,2.8-3,3.-4\n"
    own = part.group().replace("CBAR,112,2,23,24", "CBAR,112,2,123,24")
    superelement = f"BEGIN SUPER=1\nGRID,123,,8.,6.,0.\n{frame}{materials}{own}"
    return f"{EXECUTIVE}{bulk}{AEROELASTIC}{SHELLS}{superelement}ENDDATA\n"


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """Cases with the deck as it is and in plain form with the same sheet."""
    plain = PLAIN.replace("ENDDATA", f"{SHELLS}ENDDATA")
    found = {}
    for name, deck in (("unedited", unedited()), ("plain", plain)):
        folder = tmp_path_factory.mktemp(name)
        (folder / "tiny_aircraft.bdf").write_text(deck)
        case = CASE.replace("duration: 0.4", "duration: 0.05")
        (folder / "case.yaml").write_text(case)
        found[name] = folder
    return found


def test_an_unedited_deck_is_checked(folders, capsys):
    status = guarded(app, ["check", str(folders["unedited"] / "case.yaml")])
    said = capsys.readouterr()
    assert status == 0, said.err
    assert "Traceback" not in said.err


def test_an_unedited_deck_is_the_plain_one(folders):
    """Mass and frequencies: weights, the part and the sheet are what they are."""
    found = {}
    for name, folder in folders.items():
        structure = fem.Structure.from_deck(fem.read_deck(folder / "tiny_aircraft.bdf"))
        modes = fem.normal_modes(
            structure.stiffness,
            structure.mass,
            count=12,
            rigid_body=structure.rigid_body,
        )
        found[name] = structure.rigid_mass.total, modes.frequency_hz[6:]
    assert found["unedited"][0] == pytest.approx(found["plain"][0], rel=1e-6)
    assert found["unedited"][1] == pytest.approx(found["plain"][1], rel=1e-5)


@pytest.mark.usefixtures("blank_curves")
def test_an_unedited_deck_lands(folders, capsys):
    folder = folders["unedited"]
    arguments = ["run", str(folder / "case.yaml"), "--out", str(folder / "out")]
    status = guarded(app, arguments)
    assert status == 0, capsys.readouterr().err
    assert (folder / "out" / "report.html").is_file()
