"""Enforced motion in SOL 108 and 111: closed forms; modes against the direct way."""

import h5py
import numpy as np
import pytest

import fem
from fem.cli import _status
from fem.errors import InputError
from fem.solution import run_deck

K, B, M = 1000.0, 3.0, 2.0
OSCILLATOR = """\
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
CELAS2,1,1000.,1,1,2,1
CDAMP2,2,3.,1,1,2,1
CMASS2,3,2.,2,1
SPC1,1,123456,1
SPC1,1,23456,2
SPCD,9,1,1,.5
TABLED1,7
,0.,1.,100.,1.,ENDT
FREQ1,3,1.,.5,10
EIGRL,1,,,1
"""
CASE = """\
SPC = 1
DLOAD = 5
FREQUENCY = 3
DISP = ALL
SPCFORCES = ALL
FORCE = ALL
METHOD = 1
"""


@pytest.fixture
def solve(tmp_path):
    def go(sol, case, bulk):
        path = tmp_path / "deck.bdf"
        path.write_text(f"SOL {sol}\nCEND\n{case}BEGIN BULK\n{bulk}\nENDDATA\n")
        out = run_deck(fem.read_deck(path), tmp_path / "deck.h5")
        with h5py.File(out) as file:
            group = file["frequency/1"]
            omega = 2.0 * np.pi * group["frequency_hz"][()]
            found = {name: group[name][()] for name in ("displacement", "spc_force")}
        return omega, found

    return go


@pytest.mark.parametrize("sol", [108, 111])
@pytest.mark.parametrize(
    ("load", "order"), [("DISP", 0), ("2", 1), ("ACC", 2)], ids=lambda x: str(x)
)
def test_an_oscillator_on_a_moving_base_follows_its_transmissibility(
    solve, sol, load, order
):
    bulk = OSCILLATOR + f"RLOAD1,5,9,.01,30.,7,,{load}"
    omega, found = solve(sol, CASE, bulk)
    base = 0.5 * np.exp(1j * (np.radians(30.0) - 0.01 * omega)) / (1j * omega) ** order
    joined = K + 1j * omega * B
    mass = joined / (joined - omega**2 * M) * base
    u = found["displacement"]
    np.testing.assert_allclose(u[:, 0, 0], base, rtol=1e-9)
    np.testing.assert_allclose(u[:, 1, 0], mass, rtol=1e-7)
    # What moves the base moves the mass.
    np.testing.assert_allclose(
        found["spc_force"][:, 0, 0], -(omega**2) * M * mass, rtol=1e-6
    )


def test_loads_and_motions_add_up(solve):
    both = """\
RLOAD1,11,9,,,7,,DISP
RLOAD1,12,9,,,7
FORCE,9,2,,1.,4.,0.,0.
DLOAD,5,2.,1.,11,3.,12
"""
    omega, found = solve(108, CASE, OSCILLATOR + both)
    joined = K + 1j * omega * B
    expected = (joined * 1.0 + 12.0 * 2.0) / (joined - omega**2 * M)
    # The set 9 has a load of 4: 2 x 3 x 4 = 24, and a motion of 0.5: 2 x 0.5 = 1.
    np.testing.assert_allclose(found["displacement"][:, 1, 0], expected, rtol=1e-9)


BEAM = """\
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,2.,0.,0.
GRID,4,,3.,0.,0.
CBAR,1,1,1,2,0.,1.,0.
CBAR,2,1,2,3,0.,1.,0.
CBAR,3,1,3,4,0.,1.,0.
PBAR,1,1,1.-3,1.-6,2.-6,1.-6
MAT1,1,7.+10,,.3,2700.,,,.02
CONM2,9,4,,3.,0.,.1
SPC1,1,123456,1
SPCD,9,1,3,1.,1,5,.2
TABLED1,7
,0.,9.81,2000.,9.81,ENDT
RLOAD1,5,9,,,7,,ACCE
FREQ1,3,4.,6.,6
PARAM,G,.01
"""


@pytest.mark.parametrize("modes", [4, 6])
def test_few_modes_with_residual_vectors_are_the_direct_response(solve, modes):
    _, direct = solve(108, CASE, BEAM)
    _, modal = solve(111, CASE, f"{BEAM}EIGRL,1,,,{modes}\n")
    size = np.abs(direct["displacement"]).max(axis=(1, 2))
    gap = np.abs(modal["displacement"] - direct["displacement"]).max(axis=(1, 2)) / size

    assert gap.max() < (1e-2 if modes == 4 else 1e-9)
    assert gap[0] < 1e-6  # it grows as the fourth power


def test_a_slow_base_carries_the_beam_as_a_rigid_body(solve):
    bulk = BEAM.replace("FREQ1,3,4.,6.,6", "FREQ,3,.01")
    omega, found = solve(108, CASE, bulk)
    base = -9.81 / omega[0] ** 2
    tip = found["displacement"][0, 3]
    assert tip[2] == pytest.approx(base * (1.0 - 0.2 * 3.0), rel=1e-4)
    assert tip[4] == pytest.approx(base * 0.2, rel=1e-4)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("SPCD,9,1,1,.5", "SPCD,9,2,1,.5", "grid 2 T1, which no SPC holds"),
        ("SPCD,9,1,1,.5\n", "", "EXCITEID 9 has no SPCD"),
        ("FREQ1,3,1.", "FREQ1,3,0.", "at 0 Hz has no displacement"),
    ],
)
def test_motion_that_cannot_be_is_named(solve, old, new, message):
    bulk = OSCILLATOR.replace(old, new) + "RLOAD1,5,9,,,7,,VELO"
    with pytest.raises(InputError, match=message):
        solve(108, CASE, bulk)


def test_motions_are_absolute_and_said(tmp_path, capsys):
    bulk = OSCILLATOR + "RLOAD1,5,9,,,7,,DISP\nPARAM,ENFMOTN,REL\n"
    path = tmp_path / "deck.bdf"
    path.write_text(f"SOL 108\nCEND\n{CASE}BEGIN BULK\n{bulk}ENDDATA\n")
    assert _status([str(path), "--out", str(tmp_path / "out")]) == 0
    assert "those written here are absolute" in capsys.readouterr().out


def test_spc_with_a_value_moves_as_well(solve):
    bulk = OSCILLATOR.replace("SPCD,9,1,1,.5\n", "SPC,9,1,1,.5\n")
    _, found = solve(108, CASE, bulk + "RLOAD1,5,9,,,7,,DISP")
    np.testing.assert_allclose(found["displacement"][:, 0, 0], 0.5)
