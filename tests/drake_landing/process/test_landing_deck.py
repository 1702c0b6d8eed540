"""The written SOL 109 deck runs as it stands; what is not as it was is found."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.body import AirframeModel, load_airframe
from drake_landing.case.schema import Case
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.landing_deck import check_landing_deck, write_landing_deck
from fem.deck.reader import read_deck
from fem.errors import InputError
from tests.drake_landing.one_aircraft import MM_T_N, Written, case_of

GAP = "CGAP,900,77,1,2\n,0.,0.,1."
TIME = 5e-4 * np.arange(41)


def prepared(
    folder: Path, how: Written, *changes: tuple[str, str]
) -> tuple[Case, Aircraft, AirframeModel, AttachmentLoads]:
    case = case_of(folder, how, *changes)
    aircraft = prepare_aircraft(case, folder)
    load = np.zeros((len(TIME), 2, 6))
    load[:, 0, 2] = 1e4 * np.sin(300.0 * TIME)
    load[:, 1, 4] = 1e3 * np.sin(200.0 * TIME)
    loads = AttachmentLoads(time=TIME, node_id=np.array([2, 11]), load=load)
    return case, aircraft, load_airframe(case.airframe, aircraft), loads


def test_ignored_cards_and_replaced_parameters_are_left_out(tmp_path: Path) -> None:
    how = Written(units="mm-t-N", length=1e-3, mass=1e3, more={"gap": GAP})
    more = "select: count 5\n  ignore: [CGAP]\n  damping: {alpha1: 0.4, deck: drop}"
    run = prepared(tmp_path, how, ("select: count 5", more))
    case, aircraft, airframe, loads = run
    path = tmp_path / "landing.bdf"
    write_landing_deck(path, case, aircraft, airframe, loads, [3, 5])
    text = path.read_text()
    assert "CGAP" not in text.split("BEGIN BULK")[1]
    assert ",0.,0.,1.\n" not in text
    head = [line for line in text.splitlines() if line.startswith("$")]
    for words in ("mm, t, s, N", "flight toward -x", "case.yaml", "CGAP", "20"):
        assert any(words in line for line in head)
    assert "SET 2 = 3, 5\nFORCE = 2\nSTRESS = 2" in text
    again = read_deck(path)
    assert again.number("ALPHA1") == pytest.approx(0.4)
    assert again.number("G") == again.number("W3") == 0.0
    told = check_landing_deck(path, case, airframe, loads)
    assert "same stiffness, mass and damping" in told
    # 0.6 s in 3000 steps is not 2e-4 s to the last bit; the deck has ten digits.
    rounded = replace(loads, time=(1.0 + 1e-12) * TIME)
    assert check_landing_deck(path, case, airframe, rounded) == told


@pytest.mark.parametrize(
    ("pattern", "other", "words"),
    [
        (r"MAT1,1,\S+?,", "MAT1,1,1.,", "stiffness"),
        (r"CONM2,100,1,,[^,]+", "CONM2,100,1,,9.", "mass"),
        (r"TSTEP\*( +)(\d+)( +)40", r"TSTEP*\1\2\g<3>41", "time steps"),
        (r"DLOAD\*( +)(\d+) 1\.0", r"DLOAD*\1\2 1.1", "loads"),
    ],
)
def test_what_differs_from_the_run_is_found(
    pattern: str, other: str, words: str, tmp_path: Path
) -> None:
    case, aircraft, airframe, loads = prepared(tmp_path, MM_T_N)
    path = tmp_path / "landing.bdf"
    write_landing_deck(path, case, aircraft, airframe, loads)
    check_landing_deck(path, case, airframe, loads)
    text, count = re.subn(pattern, other, path.read_text(), count=1)
    assert count == 1
    path.write_text(text)
    with pytest.raises(InputError, match=words):
        check_landing_deck(path, case, airframe, loads)
