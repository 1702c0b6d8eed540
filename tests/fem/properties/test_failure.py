"""Failure indices: each theory by hand, its limits, and decks that ask for them."""

import h5py
import numpy as np
import pytest

import fem
from fem.properties.failure import Failure, Strength, hill, max_strain, tsai_wu
from fem.solution import run_deck

XT, XC, YT, YC, S, F12 = 1500e6, 1200e6, 50e6, 200e6, 70e6, -1e-18
E1, E2, G12 = 140e9, 10e9, 5e9
STRENGTH = Strength(
    xt=XT,
    xc=XC,
    yt=YT,
    yc=YC,
    s=S,
    f12=F12,
    strain=(XT / E1, XC / E1, YT / E2, YC / E2, S / G12),
)
# One load case per line: at the limit of a single strength every theory says one.
LIMITS = np.array(
    [[XT, 0, 0], [-XC, 0, 0], [0, YT, 0], [0, -YC, 0], [0, 0, S], [0, 0, -S]]
)


def index(theory: str, stress: np.ndarray) -> np.ndarray:
    failure = Failure(theory=theory, plies=(STRENGTH,), bond=0.0)
    strain = stress / [E1, E2, G12]  # no Poisson's ratio
    return failure.ply_index(stress[:, None], strain[:, None])[:, 0]


@pytest.mark.parametrize("theory", ["HILL", "HOFF", "TSAI", "STRN"])
def test_a_single_stress_at_its_strength_fails(theory):
    np.testing.assert_allclose(index(theory, LIMITS), 1.0, rtol=1e-12)
    half = {"HILL": 0.25, "STRN": 0.5}.get(theory)
    if half:
        np.testing.assert_allclose(index(theory, 0.5 * LIMITS), half, rtol=1e-12)


def test_combined_stresses_by_hand():
    s1, s2, t = 600e6, -80e6, 30e6
    stress = np.array([[s1, s2, t]])
    own = [np.array([v]) for v in (XT, XC, YT, YC, S)]
    expected = (s1 / XT) ** 2 - s1 * s2 / XC**2 + (s2 / YC) ** 2 + (t / S) ** 2
    assert hill(stress, *own)[0] == pytest.approx(expected)
    common = (
        s1 * (1 / XT - 1 / XC)
        + s2 * (1 / YT - 1 / YC)
        + s1**2 / (XT * XC)
        + s2**2 / (YT * YC)
        + (t / S) ** 2
    )
    assert index("HOFF", stress)[0] == pytest.approx(common - s1 * s2 / (XT * XC))
    assert index("TSAI", stress)[0] == pytest.approx(common + 2 * F12 * s1 * s2)
    found = tsai_wu(stress, *own, np.array([-0.5 / (XT * XC)]))
    assert found[0] == pytest.approx(index("HOFF", stress)[0])
    strain = np.array([[2e-3, -9e-3, 1e-3]])
    allowable = np.array([[0.01, 0.02, 0.01, 0.03, 0.02]]).T
    assert max_strain(strain, allowable)[0] == pytest.approx(0.3)


DECK = """\
SOL 101
CEND
SPC=1
LOAD=1
STRESS=ALL
STRAIN=ALL
BEGIN BULK
GRID,1
GRID,2,,1.
GRID,3,,1.,1.
GRID,4,,0.,1.
CQUAD4,1,1,1,2,3,4
PCOMP,1,,,{sb},{ft},,,SYM
,1,.001,0.,YES,1,.002,60.,YES
MAT8,1,140.+9,10.+9,.3,5.+9,5.+9,3.+9,1600.
{strength}
SPC1,1,12345,1
SPC1,1,1345,4
SPC1,1,345,2,3
FORCE,1,2,,4.+5,1.
FORCE,1,3,,4.+5,1.
ENDDATA
"""
ALLOWED = ",,,,1.5+9,1.2+9,5.+7,2.+8,7.+7\n,,-1.-18"


def run(folder, **fields):
    path = folder / "a.bdf"
    path.write_text(DECK.format(**{"sb": "", "ft": "", "strength": "", **fields}))
    deck = fem.read_deck(path)
    with h5py.File(run_deck(deck, folder / "a.h5")) as file:
        results = file["static/1"]
        found = {
            name: (list(group["columns"]), value[:][0])
            for kind in ("stress", "strain", "failure")
            for name, group, value in [
                (kind, g.attrs, g["value"])
                for g in results.get(f"element_{kind}", {}).values()
            ]
        }
        return found, list(file.attrs["notices"])


@pytest.mark.parametrize("theory", ["HILL", "HOFF", "TSAI", "STRN"])
def test_indices_belong_to_the_printed_ply_results(tmp_path, theory):
    found, notices = run(tmp_path, ft=theory, sb="4.+7", strength=ALLOWED)
    names, values = found["failure"]
    assert names[:2] == ["ply_index_p1", "bond_index_p1"]
    assert names[8:] == ["max_index"]
    stress = found["stress"][1].reshape(4, 9)[:, :3]
    strain = found["strain"][1].reshape(4, 9)[:, :3]
    failure = Failure(theory=theory, plies=(STRENGTH,) * 4, bond=4e7)
    expected = failure.ply_index(stress, strain)
    np.testing.assert_allclose(values[0:8:2], expected, rtol=1e-9)
    assert values[-1] == pytest.approx(expected.max())
    # 60-degree plies fail across their fibres before the others.
    assert values[2] > 1.5 * values[0] > 0.0
    assert not [notice for notice in notices if "PCOMP" in notice]


def test_bonding_is_the_interlaminar_shear_over_sb(tmp_path):
    bent = {"strength": ALLOWED, "sb": "4.+7"}
    path = tmp_path / "b.bdf"
    text = DECK.format(ft="", **bent)
    text = text.replace("FORCE,1,2,,4.+5,1.", "FORCE,1,2,,1.+3,0.,0.,1.")
    text = text.replace("FORCE,1,3,,4.+5,1.", "FORCE,1,3,,1.+3,0.,0.,1.")
    text = text.replace("SPC1,1,12345,1", "SPC1,1,123456,1,4")
    text = text.replace("SPC1,1,345,2,3\n", "").replace("SPC1,1,1345,4\n", "")
    path.write_text(text)
    with h5py.File(run_deck(fem.read_deck(path), tmp_path / "b.h5")) as file:
        values = file["static/1/element_failure/CQUAD4_COMPOSITE/value"][0]
        plies = file["static/1/element_stress/CQUAD4_COMPOSITE/value"][0].reshape(4, 9)
    np.testing.assert_allclose(values[1:8:2], np.abs(plies[:, 3:5]).max(axis=1) / 4e7)
    assert np.isnan(values[0:8:2]).all()
    assert values[-1] == values[1:8:2].max() > 0.0


def test_lacking_strengths_are_named(tmp_path):
    found, notices = run(tmp_path, ft="HILL")
    assert "failure" not in found
    assert any("FT HILL" in n and "no strengths for it in material 1" in n
               for n in notices)  # fmt: skip


def test_blank_compression_is_like_tension(tmp_path):
    found, _ = run(tmp_path, ft="HILL", strength=",,,,1.5+9,,5.+7,,7.+7")
    stress = found["stress"][1].reshape(4, 9)[:, :3]
    own = [np.full(4, v) for v in (1.5e9, 1.5e9, 5e7, 5e7, 7e7)]
    np.testing.assert_allclose(found["failure"][1][0:8:2], hill(stress, *own))
