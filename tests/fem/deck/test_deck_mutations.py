"""Malformed decks: whatever befalls a good deck, the end is a Deck or an InputError."""

import random
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mutations import mutate

from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.points import read_points

# Nearly every kind of card, in all three formats.
GOOD = """\
ID A,B
SOL 109
CEND
TITLE = all cards
SPC = 1
SET 5 = 1 THRU 4 EXCEPT 3, 7
DISPLACEMENT(PLOT) = 5
LOADSET = 8
SUBCASE 1
  DLOAD = 5
  TSTEP = 1
  IC = 4
BEGIN BULK
PARAM,COUPMASS,1
CORD2C  1       0       0.      0.      0.      0.      0.      1.
        1.      0.      0.
CORD1R,2,1,2,3
GRDSET,,,,,,,6
GRID*   1                               0.              0.              0.
*       0
GRID    2       1       1.      0.      0.      1
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,,0.,0.,1.
GRID,6,,1.,0.,1.
GRID,7,,1.,1.,1.
GRID,8,,0.,1.,1.
SPOINT,91,THRU,93
CBAR    1       1       1       2       0.      1.      0.      GGG     +B1
+B1     4       5       .1      .0      .0      .1      .0      .0
PBARL,1,1,,BOX
,.1,.2,.01,.01,.5
CBEAM,2,2,2,3,4
PBEAM   2       1       .1      .01     .01     0.      .01
        .1      .1      -.1     .1      -.1     -.1     .1      -.1
        NO      1.      .2      .02     .02     0.      .02
        .8      .8
PBEAML,3,1,,TUBE
,.2,.1,0.,YES,1.,.1,.05
CBEAM,3,3,3,4,0.,0.,1.
CROD,4,4,1,3
PROD,4,1,.1,.1
CONROD,5,2,4,1,.1
CTUBE,6,6,5,6
PTUBE,6,1,.2,.01
CELAS1,7,7,1,1,2,1
PELAS,7,10.,.1,,8,5.
CELAS3,8,7,91,92
CDAMP2,9,3.,92,,93
CBUSH,10,10,1,2,,,,0
PBUSH,10,K,1.,2.,3.
,,B,1.
CONM2,11,4,,5.,.1,.1,.1
,1.,0.,1.,0.,0.,1.
CQUAD4,12,12,1,2,3,4,30.
PSHELL,12,1,.01,1,,1
CTRIA3,13,13,5,6,7
PCOMP,13,-.01
,1,.005,0.,YES,1,.005,90.,YES
CHEXA,14,14,1,2,3,4,5,6
,7,8
PSOLID,14,1
MAT1,1,7.+10,,.3,2700.,,,.02
RBE2,20,7,123,8
RBE3,21,,8,123456,1.,123,1,2
,3,4
MPC,6,3,1,1.,4,1,-1.
SPC1,1,123456,1,THRU,2
SPCADD,9,1
FORCE,3,7,1,10.,1.,0.,0.
MOMENT,3,7,,10.,1.,0.,0.
PLOAD1,3,1,FX,FR,0.,1.,1.,2.
PLOAD4,3,12,5.
PLOAD4,3,14,5.,,,,5,7
GRAV,3,,9.81,0.,0.,-1.
LOAD,2,1.,1.,3
LSEQ,8,7,3
DAREA,7,5,3,2.
DLOAD,5,1.,1.,6,2.,16
TLOAD1,6,7,,,1
TLOAD2,16,7,,,0.,1.,2.,-90.
TABLED1,1
,0.,0.,.5,1.,1.,1.,ENDT
TIC,4,7,1,.1
TSTEP,1,10,.01,2
EIGRL,1,,,5
DMIG,KX,0,6,1
DMIG,KX,1,1,,2,1,3.
ENDDATA
"""


def check(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")
    try:
        deck = read_deck(path)
        read_points(deck)
    except InputError as error:
        problems = error.problems
    else:
        problems = ("none",)
    assert problems
    assert all(problem and "\n" not in problem for problem in problems)


def test_the_deck_is_good(tmp_path):
    path = tmp_path / "a.bdf"
    path.write_text(GOOD)
    deck = read_deck(path)
    assert read_points(deck).size == 51
    assert not any("without effect" in notice for notice in deck.notices)


@pytest.mark.parametrize(
    "seed", [pytest.param(k, marks=[pytest.mark.slow] * (k >= 6)) for k in range(20)]
)
def test_mutated_decks_end_in_a_message_or_a_deck(tmp_path, seed):
    rng = random.Random(seed)
    for _ in range(20):
        check(tmp_path / "a.bdf", mutate(GOOD, rng))


def test_mutated_reference_decks_end_in_a_message_or_a_deck(tmp_path, references):
    rng = random.Random(0)
    names = [
        "transient_1d/tst1d3.bdf",
        "solid_shell_bar/geom.inc",
        "rbe3/make_gm_nx9_rbe3_1.dat",
    ]
    texts = [(references / name).read_text() for name in names]
    for _ in range(60):
        check(tmp_path / "a.bdf", mutate(rng.choice(texts), rng))


@settings(
    max_examples=100,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(text=st.text(max_size=300))
def test_any_text_ends_in_a_message_or_a_deck(tmp_path, text):
    check(tmp_path / "a.bdf", "GRID,1\n" + text.replace("\ud800", ""))
