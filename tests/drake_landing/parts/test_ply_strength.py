"""Margins of laminates by the strengths of their plies and of their bonding."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drake_landing.parts.inventory import inventory
from drake_landing.parts.ply_strength import strength_use
from drake_landing.parts.stress import stresses
from drake_landing.parts.tables import with_margin
from fem.deck.reader import read_deck
from fem.model.structure import Structure
from fem.properties.failure import Failure, Strength

# A strip 2 x 1 m, fibres along x; Poisson's ratio 0, so that ply 1 sees E1 e alone.
DECK = """\
SOL 101
CEND
SPC = 1
BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.
GRID,3,,2.,1.,0.
GRID,4,,0.,1.,0.
CQUAD4,1,1,1,2,3,4,0.
PCOMP,1,,,{sb},{ft}
,2,.001,0.,YES,2,.001,90.,YES
,1,.002,0.,YES
MAT8,2,1.+11,1.+10,0.,5.+9,4.+9,4.+9,1600.
,,,,1.+9,8.+8,5.+7,2.+8,{s}
MAT1,1,{core},,.0,2700.
,{st}
SPC1,1,123456,1
ENDDATA
"""
STRAINS = (0.01, 0.008, 0.005, 0.02, 0.014)
STRENGTH = Strength(xt=1e9, xc=8e8, yt=5e7, yc=2e8, s=7e7, f12=0.0, strain=STRAINS)
COMPLIANCE = np.diag([1e-11, 1e-10, 2e-10])


def judged(folder: Path, exx: float, allowables=None, **fields) -> tuple:
    """Equivalent stress and its allowable under a uniform strain exx."""
    given = {"sb": "", "ft": "", "s": "7.+7", "st": "", "core": "7.+10", **fields}
    path = folder / "strip.bdf"
    path.write_text(DECK.format(**given))
    model = Structure.from_deck(read_deck(path))
    u = np.zeros(model.points.size)
    u[::6] = exx * model.points.xyz[:, 0]
    found = stresses(model, allowables).of(u[model.elimination.f][:, None])[0, 0]
    row = inventory(model, allowables or {}).elements.iloc[0]
    return found, row


def test_margin_of_the_ply_that_bears_least(tmp_path):
    """Across the fibres 1e10 e of 5e7 or 2e8, along them 1e11 e of 1e9 or 8e8."""
    found, row = judged(tmp_path, 1e-3)
    assert (row.material, row.allowed) == (2, 1e9)
    assert found[0] / row.allowed == pytest.approx(1e7 / 5e7)
    assert found[1] == pytest.approx(1e8)
    found, row = judged(tmp_path, -1e-3)
    assert found[0] / row.allowed == pytest.approx(1e8 / 8e8)
    table = row.to_frame().T.assign(equivalent=found[0], axial_only=False)
    margin = with_margin(table, 1.5).margin.iloc[0]
    assert margin == pytest.approx(8.0 / 1.5 - 1.0)


def test_isotropic_plies_and_allowables_of_the_case_count_too(tmp_path):
    found, row = judged(tmp_path, -1e-3, st="1.4+8")
    assert found[0] / row.allowed == pytest.approx(7e7 / 1.4e8)
    found, row = judged(tmp_path, 1e-3, {2: 4e8})
    assert row.allowed == 4e8
    assert found[0] == pytest.approx(1e8)


def test_without_strengths_the_sheet_decides_as_ever(tmp_path):
    found, row = judged(tmp_path, 1e-3, s="", st="3.+8")
    assert (row.material, row.allowed) == (1, 3e8)
    assert found[0] == pytest.approx(7e7)


def test_a_soft_core_does_not_stand_for_its_faces(tmp_path):
    """The ply along the fibres has the largest stress: 1e11 e."""
    found, row = judged(tmp_path, 1e-3, s="", core="7.+7")
    assert row.material == 2
    assert found[0] == pytest.approx(1e8)


def test_bonding_is_judged_by_the_shear_between_plies(tmp_path):
    """A strip that slides across itself: half the use of twice the allowable."""
    path = tmp_path / "strip.bdf"
    use = []
    for sb in ("1.+6", "2.+6"):
        path.write_text(DECK.format(sb=sb, ft="", s="", st="", core="7.+10"))
        model = Structure.from_deck(read_deck(path))
        u = np.zeros(model.points.size)
        u[2::6] = 1e-4 * model.points.xyz[:, 0]
        free = u[model.elimination.f][:, None]
        row = inventory(model, {}).elements.iloc[0]
        use.append(stresses(model).of(free)[0, 0, 0] / row.allowed)
    assert use[0] == pytest.approx(2.0 * use[1])
    assert use[0] > 0.0


@settings(max_examples=40, deadline=None)
@given(
    theory=st.sampled_from(["", "HILL", "HOFF", "TSAI", "STRN"]),
    stress=st.tuples(*[st.floats(-1e9, 1e9)] * 3),
    factor=st.floats(0.1, 10.0),
)
def test_use_is_proportional_to_the_load_and_one_at_failure(theory, stress, factor):
    """The failure index of fem of the stress over its use is one."""
    s = np.array(stress)
    use = strength_use(s, STRENGTH, theory, COMPLIANCE)
    grown = strength_use(factor * s, STRENGTH, theory, COMPLIANCE)
    assert grown == pytest.approx(factor * use, rel=1e-9, abs=1e-9)
    if theory and use > 1e-6:
        at_failure = (s / use)[None]
        strain = at_failure @ COMPLIANCE
        failure = Failure(theory=theory, plies=(STRENGTH,), bond=0.0)
        assert failure.ply_index(at_failure, strain)[0] == pytest.approx(1.0, abs=1e-6)
