"""Superelements reduced as the deck asks, against the model and its own reduction."""

from pathlib import Path

import h5py
import numpy as np
import pytest

from fem.deck.reader import read_deck
from fem.solution.run import run_deck

_BAR = "PBAR,7,3,1.-3,2.-6,3.-6,4.-6\nMAT1,3,7.+10,,.3,2700.\n"
_HEAD = "SOL {sol}\nCEND\nSPC = 5\nMETHOD = 1\n{case}BEGIN BULK\nEIGRL,1,,,{n}\n"


def _grids(first: int, last: int, step: float = 0.25) -> str:
    return "".join(
        f"GRID,{i},,{step * (i - 1)},0.,0.\n" for i in range(first, last + 1)
    )


def _bars(first: int, last: int) -> str:
    """Bars from each grid to the next one."""
    rows = (f"CBAR,{i},7,{i},{i + 1},0.,0.,1.\n" for i in range(first, last))
    return "".join(rows)


# A cantilever of twelve bars, grids 1 to 13; grids 7 to 13 and their bars are the part.
_HELD = "SPC1,5,123456,1\n"
WHOLE = _grids(1, 13) + _bars(1, 13) + _HELD + _BAR
ROOT = _grids(1, 7) + _bars(1, 7) + _HELD + _BAR
TIP = _grids(7, 13) + _bars(7, 13) + _BAR
MODAL = "SPOINT,101,THRU,{last}\n"
CASES = "SUBCASE 1\nSUPER = 4\nMETHOD = 9\nSUBCASE 2\nSET 8 = 0\nSUPER = 8\n"


def _section(modes: int) -> str:
    """The tip as BEGIN SUPER = 4, with that many fixed-interface modes."""
    if not modes:
        joined = "SEBULK,4,PRIMARY,,MANUAL\nSECONCT,4,0,,,,,,,+\n+,7,7\n"
        return f"{joined}BEGIN SUPER=4\n{TIP}"
    last = 100 + modes
    points = MODAL.format(last=last)
    joined = f"SECONCT,4,0,,,,,,,+\n+,7,7\n,101,THRU,{last},101,THRU,{last}\n"
    return (
        f"{points}SEBULK,4,PRIMARY,,MANUAL\n{joined}BEGIN SUPER=4\n{TIP}{points}"
        f"QSET1,0,101,THRU,{last}\nEIGRL,9,,,{modes}\n"
    )


def _seset(modes: int) -> str:
    """The same by SESET, in one section."""
    text = f"SESET,4,8,THRU,13\nEIGRL,9,,,{max(modes, 1)}\n"
    if modes:
        last = 100 + modes
        text += MODAL.format(last=last) + f"SEQSET1,4,0,101,THRU,{last}\n"
    return text


def frequencies(tmp_path: Path, bulk: str, case: str = "", n: int = 6) -> np.ndarray:
    path, out = tmp_path / "a.bdf", tmp_path / "a.h5"
    path.write_text(_HEAD.format(sol=103, case=case, n=n) + bulk + "ENDDATA\n")
    run_deck(read_deck(path), out)
    with h5py.File(out) as file:
        return np.asarray(file["modes/frequency_hz"])


@pytest.mark.parametrize("written", ["section", "seset"])
def test_without_modal_points_it_is_guyan(tmp_path, written):
    """The root structure keeps all its grids: ASET with grids 2 to 7 says the same."""
    kept = WHOLE + "ASET1,123456,2,THRU,7\n"
    expected = frequencies(tmp_path, kept)
    text = ROOT + _section(0) if written == "section" else WHOLE + _seset(0)
    found = frequencies(tmp_path, text, CASES)
    np.testing.assert_allclose(found, expected, rtol=1e-9)


@pytest.mark.parametrize("written", ["section", "seset"])
def test_modal_points_are_fixed_interface_modes(tmp_path, written):
    """ASET of grids 2 to 7 with as many QSET points says the same."""
    kept = WHOLE + "ASET1,123456,2,THRU,7\n"
    kept += MODAL.format(last=104) + "QSET1,0,101,THRU,104\n"
    expected = frequencies(tmp_path, kept)
    text = ROOT + _section(4) if written == "section" else WHOLE + _seset(4)
    found = frequencies(tmp_path, text, CASES)
    np.testing.assert_allclose(found, expected, rtol=1e-9)
    guyan = frequencies(tmp_path, WHOLE + _seset(0), CASES)
    whole = frequencies(tmp_path, WHOLE)
    # More of a basis never raises a frequency, and all of it is the model.
    assert (guyan >= found - 1e-9).all()
    assert (found >= whole - 1e-9).all()
    np.testing.assert_allclose(found[:2], whole[:2], rtol=1e-3)


def test_a_part_within_a_part_is_reduced_before_it(tmp_path):
    """Interior of 4 is the middle, interior of 5 the tip, whose boundary is in 4."""
    two = "SESET,4,6,THRU,9\nSESET,5,10,THRU,13\nSEBSET1,5,123456,9\n"
    found = frequencies(tmp_path, WHOLE + two)
    expected = frequencies(tmp_path, WHOLE + "ASET1,123456,2,THRU,5\n")
    # Guyan in two steps differs from one step in its mass only; statics are alike.
    assert len(found) == len(expected)
    np.testing.assert_allclose(found[0], expected[0], rtol=0.02)


def test_shapes_of_the_interior_come_with_those_of_the_whole(tmp_path):
    frequencies(tmp_path, WHOLE + _seset(4), CASES)
    with h5py.File(tmp_path / "a.h5") as file:
        reduced = np.asarray(file["modes/shape"])[0]
    frequencies(tmp_path, WHOLE)
    with h5py.File(tmp_path / "a.h5") as file:
        whole = np.asarray(file["modes/shape"])[0]
    sign = np.sign((reduced * whole).sum())
    np.testing.assert_allclose(sign * reduced, whole, atol=1e-3 * np.abs(whole).max())


def test_sets_of_a_superelement_are_those_of_its_own_subcase(tmp_path):
    """The part is held by a set of another number, at the tip of a second support."""
    held = "SPC1,6,3,13\n"
    case = CASES.replace("METHOD = 9", "METHOD = 9\nSPC = 6")
    found = frequencies(tmp_path, ROOT + _section(4) + held, case)
    expected = frequencies(tmp_path, WHOLE.replace(_HELD, _HELD + "SPC1,5,3,13\n"))
    np.testing.assert_allclose(found[:2], expected[:2], rtol=2e-3)
