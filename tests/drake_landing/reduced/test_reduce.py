"""Reductions as models of their own: mass, rigid motions, frequencies, files."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from drake_landing.cache import Cache
from drake_landing.cli import app, guarded
from drake_landing.reduced import stored
from drake_landing.reduced.checks import check_reduction, reduced_modes
from drake_landing.reduced.interface import case_sets, interface_grids
from drake_landing.reduced.make import METHODS, Method, reduce_structure
from drake_landing.reference.d150 import write_model
from fem.algebra.modes import normal_modes
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.files.matrices import read_matrices
from fem.model.structure import Structure

FEW = (
    "10001, 10010, 10020 THRU 10021, 10030, 10040, 10050, 10060, 10070, 10077,10087,"
    "11001 THRU 11030, 12001 THRU 12030, 17001 THRU 17003, 19001 THRU 19006"
)


@pytest.fixture(scope="module")
def con(tmp_path_factory: pytest.TempPathFactory) -> Structure:
    path = tmp_path_factory.mktemp("con") / "con.bdf"
    write_model("con", path)
    return Structure.from_deck(read_deck(path))


@pytest.mark.parametrize("method", METHODS)
def test_reduction_keeps_mass_and_rigid_motions(con: Structure, method: Method) -> None:
    reduced = reduce_structure(con, interface_grids(FEW, con), method)
    checks = check_reduction(con, reduced, 10.0)
    assert checks.mass.difference.abs().max() < 1e-9
    assert checks.rigid_modes == 6
    assert checks.rigid.grounding.max() < 1e-9
    assert checks.rigid.hz.max() < 1e-3
    # Grids that follow rigidly or freely move with the model as a whole.
    model = reduced.model
    about = con.weight.center
    follow = model.recovery @ model.rigid_body(about)
    grid, component = model.following.T
    arm = model.p[np.searchsorted(model.grid_id, grid)] - about
    turn = np.column_stack([-arm[:, 1], arm[:, 0], 0 * arm[:, 0], *3 * [0 * grid]])
    turn[:, 5] = 1.0
    expected = turn[np.arange(len(grid)), component - 1]
    np.testing.assert_allclose(follow[:, 5], expected, atol=1e-7)
    assert 11004 in grid, "a rib whose motion is partly that of a frame"


def test_generalised_coordinates_bring_the_frequencies_closer(con: Structure) -> None:
    grids = interface_grids(FEW, con)
    error = {}
    full = normal_modes(con.stiffness, con.mass, count=26).frequency_hz[6:]
    for method in METHODS:
        reduced = reduce_structure(con, grids, method, count=50, highest_hz=60.0)
        own = reduced_modes(reduced.model, 50.0).frequency_hz[6:26]
        assert (own >= full * (1 - 1e-7)).all(), "a reduction stiffens"
        error[method] = (own / full - 1).max()
    assert error["craig-bampton"] < 0.05 * error["guyan"]
    assert error["dynamic"] < 0.05 * error["guyan"]
    assert error["guyan"] > 1e-3


def test_ritz_values_approach_interior_frequencies_from_above(con: Structure) -> None:
    grids = interface_grids(FEW, con)
    exact = reduce_structure(con, grids, "craig-bampton", highest_hz=60.0).model
    ritz = reduce_structure(con, grids, "dynamic", count=40).model
    k = 5
    assert (ritz.interior_hz[:k] >= exact.interior_hz[:k] * (1 - 1e-9)).all()
    np.testing.assert_allclose(ritz.interior_hz[:k], exact.interior_hz[:k], rtol=1e-3)


def test_displacement_frames_are_turned_to_the_basic_frame(tmp_path: Path) -> None:
    deck = Path(__file__).parents[1] / "tiny_aircraft.bdf"
    plain = Structure.from_deck(read_deck(deck))
    turned = plain.points.rotation
    assert not np.allclose(turned, np.eye(3)), "the deck has frames of its own"
    reduced = reduce_structure(plain, plain.points.grid_id.tolist(), "guyan")
    model = reduced.model
    force = model.stiffness @ model.rigid_body()
    assert np.abs(force).max() < 1e-7 * np.abs(model.stiffness).max()
    assert check_reduction(plain, reduced, 30.0).modes.error.abs().max() < 1e-6


def test_command_writes_the_same_model_in_three_formats(
    con: Structure, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    line = ["reduce", str(con.deck.path), "--interface", FEW, "--compare", "8"]
    assert guarded(app, [*line, "--out", str(tmp_path)]) == 0
    text = capsys.readouterr().out
    assert "6 modes below 0.01 Hz" in text
    punch, op4, h5 = (
        read_matrices(tmp_path / f"reduced.{kind}") for kind in ("pch", "op4", "h5")
    )
    for name, matrix in op4.items():
        np.testing.assert_array_equal(h5[name].values, matrix.values)
        if name == "RRED":  # columns without any term are not punched
            rows = punch[name].rows
            assert rows is not None
            assert matrix.rows is None or len(matrix.rows) == len(h5[name].values)
            grids = {11004, 12004, *range(17001, 17004), *range(19001, 19007)}
            assert set(rows[:, 0].tolist()) <= grids
            assert {11004, 17001} <= set(rows[:, 0].tolist())
            continue
        scale = np.abs(matrix.values).max()
        assert np.abs(punch[name].values - matrix.values).max() < 1e-9 * scale
    assert (tmp_path / "errors.png").stat().st_size > 5000


def test_a_reduction_is_found_again_and_a_damaged_one_made_anew(
    con: Structure, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = []
    honest = stored.reduce_structure

    def counted(*arguments, **options):
        calls.append(arguments[2])
        return honest(*arguments, **options)

    monkeypatch.setattr(stored, "reduce_structure", counted)
    cache = Cache(tmp_path)
    settings = {"highest_hz": 60.0, "count": 10, "compare_hz": 6.0, "cache": cache}
    grids = interface_grids(FEW, con)
    first, checks = stored.checked_reduction(con, grids, "guyan", **settings)
    again, same = stored.checked_reduction(con, grids, "guyan", **settings)
    assert calls == ["guyan"]
    np.testing.assert_array_equal(again.stiffness, first.stiffness)
    assert (again.source, again.notices) == (first.source, first.notices)
    pd.testing.assert_frame_equal(same.modes, checks.modes, check_dtype=False)
    assert same.rigid_modes == checks.rigid_modes == 6
    # Other settings are another entry; a flipped bit is noticed.
    stored.checked_reduction(con, grids[:-1], "guyan", **settings)
    assert len(calls) == 2
    for place in tmp_path.iterdir():
        data = bytearray((place / "model-mass.npy").read_bytes())
        data[-9] ^= 4
        (place / "model-mass.npy").write_bytes(data)
    mended, _ = stored.checked_reduction(con, grids, "guyan", **settings)
    assert len(calls) == 3
    np.testing.assert_array_equal(mended.mass, first.mass)


def test_named_sets_and_bad_interfaces(con: Structure) -> None:
    assert sorted(case_sets(con.deck.path)) == [1, 2, 3]
    assert len(interface_grids("set 2", con)) == 261
    for text, words in (
        ("SET 9", "no SET 9"),
        ("1, x", "found 'x'"),
        (None, "no ASET"),
    ):
        with pytest.raises(InputError, match=words):
            interface_grids(text, con)
    with pytest.raises(InputError, match="grids 1, 2 are not in"):
        reduce_structure(con, [1, 2, 10001], "guyan")


def test_unknown_basis(con: Structure, capsys: pytest.CaptureFixture[str]) -> None:
    line = ["reduce", str(con.deck.path), "--interface", "10001", "--basis", "guyen"]
    assert guarded(app, line) == 2
    assert "did you mean 'guyan'" in capsys.readouterr().err


def test_a_stick_without_rotary_inertia_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    deck = tmp_path / "leg.bdf"
    deck.write_text(
        """BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,0.,0.,-1.
GRID,3,,0.,0.,-2.
CBAR,1,1,1,2,0.,1.,0.
CBAR,2,1,2,3,0.,1.,0.
PBAR,1,1,2.-2,9.-5,9.-5,1.8-4
MAT1,1,2.+11,,.3,7800.
ASET1,123456,1,3
ENDDATA
"""
    )
    line = ["reduce", str(deck), "--out", str(tmp_path / "out")]
    assert guarded(app, line) == 2
    told = capsys.readouterr().err
    assert "motion without stiffness and mass" in told
    assert "grid 1 R3" in told


def test_guyan_onto_everything_has_the_modes_of_the_deck(con: Structure) -> None:
    reduced = reduce_structure(con, interface_grids("SET 2", con), "guyan")
    modes = reduced_modes(reduced.model, 3.0)
    assert modes.rigid == 6
    np.testing.assert_allclose(modes.frequency_hz[6:], [2.141, 2.884], atol=5e-4)
