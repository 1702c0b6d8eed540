"""Damping that the case gives, and what there is in words."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drake_landing.airframe.body import load_airframe
from drake_landing.airframe.damping import (
    damping_story,
    ratio_at,
    rayleigh_of_ratios,
    with_damping,
)
from drake_landing.case.damping import AirframeDamping
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.explain import explain
from fem.deck.reader import read_deck
from fem.errors import InputError
from tests.drake_landing.one_aircraft import SI, case_of, deck_text


@given(st.floats(0.0, 5.0), st.floats(1e-6, 1e-3))
def test_rayleigh_damping_is_found_from_its_own_ratios(b: float, a: float) -> None:
    hz = np.array([2.0, 15.0, 60.0])
    found = rayleigh_of_ratios(hz, ratio_at(hz, b, a))
    assert ratio_at(hz, *found) == pytest.approx(ratio_at(hz, b, a), rel=1e-6)


@pytest.mark.parametrize("keep", ["keep", "drop"])
def test_modes_have_the_ratios_of_the_case(keep: str, tmp_path: Path) -> None:
    text = f"select: count 5\n  damping: {{ratio: {{5: 0.02, 20: 0.02}}, deck: {keep}}}"
    case = case_of(tmp_path, SI, ("select: count 5", text))
    body = load_airframe(case.airframe, prepare_aircraft(case, tmp_path)).body
    omega = 2 * np.pi * body.frequency
    b, a = rayleigh_of_ratios(np.array([5.0, 20.0]), np.array([0.02, 0.02]))
    assert ratio_at(np.array([5.0, 20.0]), b, a) == pytest.approx(0.02)
    own = 0.03 / 50.0 * (keep == "keep")  # G over W3 of the deck
    expected = np.diag(b + (a + own) * omega**2)
    assert body.modal_damping == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_ratios_that_cannot_be_met_are_said(tmp_path: Path) -> None:
    tmp_path.joinpath("a.bdf").write_text(deck_text(SI))
    wanted = AirframeDamping(ratio={3.0: 0.02, 10.0: 0.05, 40.0: 0.02})
    deck = with_damping(read_deck(tmp_path / "a.bdf"), wanted)
    assert "0.05 at 10 Hz becomes" in deck.notices[-1]


def test_structural_damping_holds_at_its_frequency(tmp_path: Path) -> None:
    tmp_path.joinpath("a.bdf").write_text(deck_text(SI))
    given_ = AirframeDamping(g=0.04, w3=2 * np.pi * 5.0, deck="drop")
    deck = with_damping(read_deck(tmp_path / "a.bdf"), given_)
    found = ratio_at(np.array([5.0]), deck.number("ALPHA1"), deck.number("ALPHA2"))
    assert found == pytest.approx(0.02)


def test_check_says_what_damps_or_that_nothing_does(tmp_path: Path) -> None:
    assert "proportional to stiffness" in explain(case_of(tmp_path), tmp_path)
    text = "select: count 5\n  damping: {deck: drop}"
    bare = case_of(tmp_path, SI, ("select: count 5", text))
    structure = prepare_aircraft(bare, tmp_path).structure()
    assert damping_story(structure).startswith("none: neither the deck nor")


@pytest.mark.parametrize(
    ("text", "words"),
    [("{g: 0.03}", "g and w3"), ("{ratio: {0: 0.1}}", "above 0 and up to 1000 Hz")],
)
def test_what_cannot_be_is_refused(text: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=words):
        case_of(
            tmp_path, SI, ("select: count 5", f"select: count 5\n  damping: {text}")
        )
