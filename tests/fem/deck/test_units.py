"""Decks in other units: the same structure, whatever they are written in."""

from pathlib import Path

import numpy as np
import pytest
import scipy.linalg

from fem.deck.deck import Deck
from fem.deck.reader import read_deck
from fem.deck.records import TABLES
from fem.deck.units import SYSTEMS, Units, in_si, is_convertible
from fem.errors import InputError
from fem.model.structure import Structure

# Every card of a model whose fields have dimensions; SI.
TEXT = """\
SOL 103
CEND
METHOD = 1
SPC = 7
MPC = 3
NSM = 9
K2GG = KAA
BEGIN BULK
EIGRL,1,,,12
EIGB,2,SINV,.5,9.,3
PARAM,G,.03
PARAM,W3,50.
PARAM,COUPMASS,1
CORD2R,7,,.1,.2,.3,.3,.1,1.3,
,1.,.5,.2
CORD2C,8,7,5.,6.,-4.,5.3,6.5,1.,
,8.,5.,-3.
CORD2S,9,8,2.,30.,-.5,2.1,35.,.4,
,2.5,70.,.2
GRID,1,,0.,0.,0.
GRID,2,,1.1,0.,0.,7
GRID,3,,2.,.1,0.
GRID,4,,0.,1.,.1
GRID,5,,1.,1.05,0.,8
GRID,6,,2.1,1.,.05
GRID,7,,0.,2.,0.
GRID,8,,1.,2.1,.1
GRID,9,,2.,2.,0.
GRID,11,,2.,.1,1.
GRID,12,,2.1,1.,1.05
GRID,13,,2.9,0.,0.
GRID,14,,3.,1.,.1
GRID,15,,3.,.1,1.
GRID,16,,3.1,1.1,1.
GRID,20,,1.,1.,1.5
GRID,21,,3.5,.6,.6
GRID,22,8,2.2,40.,.8
GRID,23,9,2.2,40.,80.
GRID,24,7,1.,2.,3.,9
GRID,25,,1.5,2.,2.
GRID,26,,2.,.1,2.
GRID,27,,3.,.1,2.1
GRID,28,,3.1,1.1,2.
GRID,29,,2.1,1.,2.2
GRID,101,,3.,0.,2.
GRID,102,,4.,0.,2.
GRID,103,,3.5,0.,3.
GRID,31,,.55,0.,.01
GRID,32,,1.05,.5,.02
GRID,33,,.5,1.02,.03
GRID,34,,0.,.5,.03
GRID,35,,1.55,1.,.02
GRID,36,,2.05,1.5,.03
GRID,37,,1.5,1.5,.04
SPOINT,90,91
CQUAD4,1,1,1,2,5,4,30.,.02
,,,.03,.03,.04,.03
CQUAD4,2,1,2,3,6,5
,,1,.9,.8,1.1,1.
CQUAD4,3,2,4,5,8,7,7
CTRIA3,4,2,5,6,9,7
CQUADR,42,1,1,2,5,4,30.,.02
,,,.03,.03,.04,.03
CTRIAR,43,2,5,6,9,7,.01
,,,.03,.03,.04
CQUAD8,40,1,1,2,5,4,31,32,+
+,33,34,.03,.03,.04,.03,30.,.02
CTRIA6,41,1,5,6,9,35,36,37,+
+,,-.01,.03,.03,.04
CTRIA3,5,11,5,9,8,,-.01
CHEXA,6,3,3,13,14,6,11,15,
,16,12
CHEXA,42,41,11,15,16,12,26,27,
,28,29
CTRIAX6,43,42,101,,102,,103
,15.
CPLSTN3,60,43,101,102,103
CBAR,7,4,5,20,0.,1.,1.
,,,.05,0.,.1,0.,0.,.1
CBEAM,8,5,20,11,7
,,,0.,.02,.01,.03,0.,0.
CBUSH,9,6,9,16,,,,7
CBUSH1D,44,30,9,16
CGAP,45,31,9,16,0.,1.,0.
CFAST,48,33,ELEM,1,3,,31,33
PFAST,33,.2,7,,900.,800.,700.,60.,+
+,50.,40.,3.,.02
CWELD,49,34,,PARTPAT,,,,,+
+,2,11,,,,,,,+
+,1.,1.6,.06
PWELD,34,1,.1
GENEL,46,,24,1,24,5,,,+
+,UD,,23,2,23,4,,,+
+,K,300.,20.,50.,,,,,+
+,S,1.,.2,.3,1.
CBEND,47,32,20,25,0.,0.,1.,3
CROD,10,8,8,20
CSHEAR,11,9,3,6,12,11
RBE2,12,20,123456,22
RBE3,13,,21,123456,1.,123,13,14,
,15,16
CONM2,14,22,,30.,.1,.2,.3
,1.,,2.,,,3.
CONM1,15,23,,40.,,41.,1.,
,42.,.1,.2,.3,4.,.4,.5,.6
,.1,5.,.7,.8,.2,.3,.4,6.
CONROD,16,22,23,1,2.-4,1.-7,,.3
CTUBE,17,10,23,24
CVISC,18,12,23,24
CELAS2,19,1000.,24,1,23,1
CELAS2,20,900.,24,4,23,5
CELAS2,22,700.,24,6
CELAS1,23,20,24,3,90
CELAS1,24,21,24,5,23,4
CDAMP1,25,22,24,3,91
CDAMP2,26,5.,24,4
CMASS1,27,23,90
CMASS2,28,3.,91
CMASS2,29,2.,24,6
CBAR,30,4,23,25,0.,1.,0.
CBAR,31,4,25,24,0.,1.,0.
PSHELL,1,1,.03,1,,1,,.4
PSHELL,11,4,.03,4
PCOMP,2,-.004,1.5,,,,,SYM
,2,.004,0.,YES,2,.005,35.,YES
PSOLID,3,5
PPLANE,43,1,.02,.3
PCOMPS,41,0,13
,1,5,.1
,2,1,.2,30.
MAT3,42,7.+10,6.+10,5.+10,.3,.2,.25,2700.
,,,2.+10
PBAR,4,1,4.-3,2.-6,3.-6,4.-6,1.5
,.05,.02
,.8,.7
PBEAM,5,1,4.-3,2.-6,3.-6,,4.-6,1.2
,.05,.02
,YES,1.,3.-3,1.-6,2.-6,,3.-6,1.3
,.05,.02
,,,,,.4,.5
,,,.01,.02,.01,.02
PBUSH,6,K,1.+5,2.+5,3.+5,4.+4,5.+4,6.+4
,,B,10.,20.,30.,40.,50.,60.
PBUSH1D,30,200.,10.,3.,,5.,4.
PGAP,31,,,400.,,300.
PBEND,32,1,4.-3,2.-6,3.-6,4.-6,2.,,+
+,.1,.1,.1,.1,.1,.1,.1,.1,+
+,.8,.7,.6,.01,.02,.03
PROD,8,1,2.-4,1.-7,,.5
PSHEAR,9,1,.01,.2
PTUBE,10,1,.1,.01,.2
PVISC,12,100.,20.
PELAS,20,5000.
PELAS,21,600.
PDAMP,22,7.
PMASS,23,8.
MAT1,1,7.+10,,.3,2700.,,,.02
MAT8,2,1.2+11,9.+9,.3,5.+9,4.+9,3.+9,1600.
MAT2,4,8.+10,2.+10,1.+9,7.+10,1.+9,2.+10,2000.
MAT9,5,8.+10,2.+10,2.+10,,,,8.+10
,2.+10,,,,8.+10,,,
,2.+10,,,2.+10,,2.+10,2500.
MPC,3,13,1,1.,14,1,-.5
,,14,6,-.3
SPC1,7,123456,1,101,102,103
NSM1,5,PSHELL,.7,1
NSM1,6,PBAR,.8,4
NSML1,8,PSHELL,3.,11
NSMADD,9,5,6,8
DMIG,KAA,0,6,1,0
DMIG,KAA,13,3,,13,3,500.
,14,5,60.,,14,3,-400.
DMIG,KAA,14,3,,14,3,450.
DMIG,KAA,14,5,,14,5,70.
ENDDATA
"""
MILLIMETRES = Units(1e3, 1e-3)  # as if SI was to be given in mm and t


@pytest.fixture(scope="module")
def deck(tmp_path_factory: pytest.TempPathFactory) -> Deck:
    path = tmp_path_factory.mktemp("units") / "model.bdf"
    path.write_text(TEXT)
    return read_deck(path)


def factors(structure: Structure, units: Units) -> np.ndarray:
    """Square root of the unit of stiffness at each row of the g-set."""
    turning = np.tile(np.repeat([0.0, 1.0], 3), len(structure.points.grid_id))
    turning = np.append(turning, np.zeros(len(structure.points.spoint_id)))
    return np.sqrt(units.mass) * units.length**turning


@pytest.mark.parametrize("name", ["stiffness", "mass", "damping", "structural_damping"])
def test_matrices_are_those_of_the_same_structure(deck: Deck, name: str) -> None:
    si = Structure.from_deck(deck)
    mm = Structure.from_deck(in_si(deck, MILLIMETRES))
    d = factors(si, MILLIMETRES)
    expected = getattr(si.matrices, name).toarray() * np.outer(d, d)
    found = getattr(mm.matrices, name).toarray()
    assert np.abs(expected).max() > 0.0
    size = np.sqrt(np.abs(np.diag(expected)) + 1e-30)
    # Entry by entry, relative to the diagonal of its rows and columns.
    error = np.abs(found - expected) / np.maximum(np.outer(size, size), 1e-30)
    assert np.where(np.abs(found - expected) > 0, error, 0.0).max() < 1e-9


def test_frequencies_do_not_depend_on_units(deck: Deck) -> None:
    def inverse(model: Deck) -> np.ndarray:
        """1/(w² + 1e4): some freedoms have no mass, some motions no stiffness."""
        s = Structure.from_deck(model)
        k, m = s.stiffness.toarray() + 1e4 * s.mass.toarray(), s.mass.toarray()
        scale = np.sqrt(np.outer(np.diag(k), np.diag(k)))
        return scipy.linalg.eigh(m / scale, k / scale, eigvals_only=True)[-30:]

    assert inverse(in_si(deck, MILLIMETRES)) == pytest.approx(inverse(deck), rel=1e-9)


def test_there_and_back(deck: Deck) -> None:
    """Millimetres to SI undoes SI to millimetres, in every table."""
    back = in_si(in_si(deck, MILLIMETRES), SYSTEMS["mm-t-N"])
    for name, table in deck.cards.items():
        for column in table if not TABLES[name].load else ():
            for a, b in zip(table[column], back.cards[name][column]):
                if isinstance(a, str) or a is None:
                    assert a == b
                else:
                    a, b = (np.asarray(x) for x in (a, b))
                    if a.dtype.kind in "fi":
                        np.testing.assert_allclose(b, a, rtol=1e-12)


def test_every_card_is_thought_of() -> None:
    """The real numbers of a card of the model have dimensions."""
    for card in TABLES.values():
        assert card.load or is_convertible(card), card.name


def test_every_dimension_is_in_the_deck_above(deck: Deck) -> None:
    """Else the laws here prove nothing of it."""
    given = [c for c in TABLES.values() if any(i.dimension for i in c.columns.values())]
    empty = [c.name for c in given if deck.cards[c.name].empty and not c.load]
    # mere numbers
    without = {"TABDMP1", "SEBULK", "MASSSET", "EIGB", "RSPLINE", "SNORM"}
    assert set(empty) <= without


def test_units_are_consistent() -> None:
    """Force is mass times length over s²."""
    assert SYSTEMS["mm-t-N"].force == pytest.approx(1.0)
    assert SYSTEMS["in-lbf"].force == pytest.approx(4.4482216152605)
    assert SYSTEMS["in-lbf"].mass == pytest.approx(175.126835)  # lbf s²/in in kg


def test_what_is_ambiguous_is_refused(tmp_path: Path) -> None:
    text = TEXT.replace("CELAS1,24,21,", "CELAS1,24,20,")
    text = text.replace("CELAS2,20,900.,24,4,23,5", "CELAS2,20,900.,24,4,23,2")
    text = text.replace("NSM1,6,PBAR,.8,4", "NSM1,6,ELEMENT,.8,7")
    path = tmp_path / "model.bdf"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        in_si(read_deck(path), SYSTEMS["mm-t-N"])
    found = {p.split(":")[0] for p in caught.value.problems}
    assert found == {"PELAS 20", "CELAS2 20", "NSM 6"}
