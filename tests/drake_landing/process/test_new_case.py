"""A case written for a deck is one that reads, and that knows what the deck tells."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.airframe.free_flight import half_model
from drake_landing.airframe.gear_checks import check_gears
from drake_landing.case.axes import rotation_AB
from drake_landing.case.deck_frame import Axes
from drake_landing.case.reading import load_case
from drake_landing.case.schema import Case
from drake_landing.cli import app, guarded
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.new_case import Stated, _guessed_axes, guess_units
from fem.deck.reader import read_deck
from tests.drake_landing.one_aircraft import FRAMES, MM_T_N, SI, WEIGHTS, case_of

HERE = Path(__file__).parents[1]
COMMUTER = HERE.parents[1] / "cases" / "commuter" / "commuter.bdf"


def written(folder: Path, deck: Path) -> Case:
    path = folder / "new.yaml"
    assert guarded(app, ["new", str(path), "--deck", str(deck)]) == 0
    return load_case(path)


def test_a_foreign_deck_is_understood(tmp_path: Path) -> None:
    case = written(tmp_path, COMMUTER)
    assert case.airframe.units == "mm-t-N"
    assert (case.airframe.axes.forward, case.airframe.axes.up) == ("x", "z")
    assert not isinstance(case.gears, str)
    # Where its own case hangs the main gears.
    assert [g.attachment_node for g in case.gears[1:]] == [270, 370]
    assert case.airframe.monitoring["tip_starboard"] == 209
    assert case.transient.step in (5e-4, 2e-4)  # within 2 %, whatever the gears


@pytest.mark.parametrize("forward", FRAMES)
@pytest.mark.parametrize("form", [SI, MM_T_N, WEIGHTS])
def test_units_and_frames_do_not_matter(tmp_path: Path, form, forward: str) -> None:
    changed = type(form)(**{**vars(form), "forward": forward})
    deck = case_of(tmp_path, changed).airframe.deck
    assert deck is not None
    case = written(tmp_path, deck)
    assert case.airframe.units == form.units
    assert (case.airframe.axes.forward, case.airframe.axes.up) == (forward, "z")
    aircraft = prepare_aircraft(case, tmp_path)
    structure = aircraft.structure()
    R_AB = rotation_AB(case.airframe.axes)
    check_gears(structure, aircraft, R_AB)  # refuses what cannot land
    # Wheels stand on both sides of the center of gravity, at one height.
    axles = np.array([gear.axles[0] for gear in aircraft.gears]) @ R_AB.T
    lowest = axles[:, 2] - [gear.tyre.radius for gear in aircraft.gears]
    assert np.ptp(lowest) < 2e-3
    assert axles[0, 0] < (R_AB @ structure.weight.center)[0] < axles[1, 0] + 0.5


def test_a_case_that_is_there_is_left(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "new.yaml"
    path.write_text("mine")
    assert guarded(app, ["new", str(path), "--deck", str(COMMUTER)]) == 2
    assert path.read_text() == "mine"
    assert "is there already" in capsys.readouterr().err


def test_supports_of_the_decks_own_solution_are_left_out(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    deck = tmp_path / "deck.bdf"
    text = (HERE / "tiny_aircraft.bdf").read_text()
    text = text.replace("METHOD = 1\n", "METHOD = 1\nSPC = 7\n")
    deck.write_text(text.replace("BEGIN BULK\n", "BEGIN BULK\nSPC1,7,123456,5\n"))
    case = written(tmp_path, deck)
    assert case.airframe.ignore == ("SPC1",)
    new = tmp_path / "new.yaml"
    assert guarded(app, ["check", str(new)]) == 0
    capsys.readouterr()
    new.write_text(new.read_text().replace("  ignore: [SPC1]\n", ""))
    assert guarded(app, ["check", str(new)]) == 2
    said = capsys.readouterr().err
    assert "SPC = 7 holds grid 5 T1 T2 T3 R1 R2 R3" in said
    assert "airframe.ignore: [SPC1]" in said


def test_half_a_model_is_said_and_a_whole_one_is_not() -> None:
    whole = np.array(
        [
            (x, y, z)
            for x in np.linspace(0.0, 20.0, 15)
            for y in np.linspace(-9.0, 9.0, 7)
            for z in (0.0, 2.0)
        ]
    )
    assert half_model(whole) == []
    (text,) = half_model(whole[whole[:, 1] >= 0.0])
    assert "y >= 0" in text
    assert "30 of them on y = 0" in text
    (text,) = half_model(whole[whole[:, 1] <= 0.0] @ np.diag([1.0, 1.0, 0.1]))
    assert "y <= 0" in text


def test_weights_in_pounds_say_their_units(tmp_path: Path) -> None:
    deck = tmp_path / "deck.bdf"
    deck.write_text(
        "CEND\nBEGIN BULK\nPARAM,WTMASS,.00259\nGRID,1,,0.,0.,0.\n"
        "MAT1,1,325.,,.3\nMAT1,2,1.+7,,.3\nENDDATA\n"
    )
    assert guess_units(read_deck(deck)) == "in-lbf"
    deck.write_text(deck.read_text().replace("PARAM,WTMASS,.00259\n", ""))
    assert guess_units(read_deck(deck)) == "in-lbf"  # by the metal, not the core


# An aircraft in aft, starboard, up: fuselage, wing with engines below, fin.
CLOUD = np.array(
    [(x, 0.0, 0.0) for x in range(15)]
    + [(6.0, side * y, 0.1 * y) for y in range(1, 8) for side in (-1, 1)]
    + [(5.0, side * 3.0, -1.2) for side in (-1, 1)]
    + [(13.5, 0.0, 1.5), (14.0, 0.0, 3.0)]
)
# A high wing, hence most grids far above belly, gears and a tail of T form.
HIGH_WING = np.array(
    [(x, 0.0, 0.0) for x in np.linspace(-5.0, 7.0, 13)]
    + [(0.0, side * y, 1.2) for y in range(1, 9) for side in (-1, 1)]
    + [(-1.0, side * 2.5, 1.0) for side in (-1, 1)]
    + [(0.5, -1.4, -0.7), (0.5, 1.4, -0.7), (-4.0, 0.0, -0.5)]
    + [(6.8, side * y, 2.0) for y in (0.0, 1.2, 2.4) for side in (-1, 1)]
)
SIGNED = [sign + axis for axis in "xyz" for sign in ("", "-")]


@pytest.mark.parametrize("cloud", [CLOUD, HIGH_WING])
@pytest.mark.parametrize("forward", SIGNED)
def test_axes_are_found_however_a_deck_lies(forward: str, cloud: np.ndarray) -> None:
    for up in (axis for axis in SIGNED if axis[-1] != forward[-1]):
        grids = cloud @ rotation_AB(Axes.model_validate({"forward": forward, "up": up}))
        for stated in (
            Stated(),
            Stated(forward=forward),
            Stated(up=up),
            Stated(forward=forward, up=up),
        ):
            found = _guessed_axes(grids, stated)
            assert (found.forward, found.up) == (forward, up), (forward, up, stated)


def test_what_is_stated_is_not_guessed(tmp_path: Path) -> None:
    path = tmp_path / "new.yaml"
    options = ["--units", "mm-t-N", "--forward", "x", "--up", "+z"]
    assert guarded(app, ["new", str(path), "--deck", str(COMMUTER), *options]) == 0
    head = path.read_text().split("scenario:")[0]
    assert "GUESS by" not in head
    assert load_case(path).airframe.units == "mm-t-N"


def test_options_that_cannot_be_are_all_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "new.yaml"
    options = ["--units", "mm-t", "--forward", "x", "--up", "-x"]
    assert guarded(app, ["new", str(path), "--deck", str(COMMUTER), *options]) == 2
    said = capsys.readouterr().err
    assert "--units: found mm-t, expected one of SI, mm-t-N, in-lbf" in said
    assert "--up: found -x, expected another axis than that of --forward x" in said
    assert not path.exists()


def test_units_of_no_aircraft_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "new.yaml"
    options = ["--units", "SI"]
    assert guarded(app, ["new", str(path), "--deck", str(COMMUTER), *options]) == 2
    said = capsys.readouterr().err
    assert "--units: found SI, in which" in said
    assert "its materials say mm-t-N; expected mm-t-N" in said


def test_a_stick_with_its_nose_in_x_and_z_down_can_land(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """mm-t-N, no damping, masses without inertia, few grids: the main gears stand
    behind the center of gravity, and the turning of grids asks for no small step.
    """
    down = CLOUD @ rotation_AB(Axes(forward="x", up="-z")) * 1e3
    lines = ["MAT1,1,71000.,,.33,2.8-9", "PBAR,1,1,9000.,4.+9,4.+9,4.+9"]
    lines += [",300.,0.,-300."]
    lines += [
        f"GRID,{k},,{x:.1f},{y:.1f},{z:.1f}" for k, (x, y, z) in enumerate(down, 1)
    ]
    ends = [(k, k + 1) for k in range(1, 15)]
    ends += [(7, 16), (7, 17), *((k, k + 2) for k in range(16, 28))]
    ends += [(20, 30), (21, 31), (14, 32), (32, 33)]
    up = {(14, 32): "1.,0.,0.", (32, 33): "1.,0.,0."}
    lines += [
        f"CBAR,{k},1,{a},{b},{up.get((a, b), '0.,0.3,-1.')}"
        for k, (a, b) in enumerate(ends, 1)
    ]
    lines += [f"CONM2,{900 + k},{k},,.2" for k in range(1, 34)]
    deck = tmp_path / "stick.bdf"
    deck.write_text("CEND\nBEGIN BULK\n" + "\n".join(lines) + "\nENDDATA\n")
    case = written(tmp_path, deck)
    assert (case.airframe.axes.forward, case.airframe.axes.up) == ("x", "-z")
    assert case.airframe.units == "mm-t-N"
    assert case.airframe.damping is not None
    capsys.readouterr()
    assert guarded(app, ["check", str(tmp_path / "new.yaml")]) == 0
    said = capsys.readouterr().out
    assert "cannot stand" not in said
    assert "outside the wheels" not in said
