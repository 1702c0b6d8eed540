"""Runways in a case: crown, tracks, roughness; messages with their line; a taxi run."""

from pathlib import Path

import pytest

from drake_landing.case.reading import parse_case
from drake_landing.case.runway import RunwaySection
from drake_landing.landing.diagram import MakeLandingDiagram
from drake_landing.landing.start import runway_of
from fem.errors import InputError
from systems.runway.runway import Runway
from tests.drake_landing.landing_gears import aircraft_gears
from tests.drake_landing.landing_run import land
from tests.systems.synthetic_body import aircraft_body

HERE = Path(__file__).parents[1]
CASE = (HERE / "tiny_case.yaml").read_text()
OLD = "scenario: {sink_rate: 1.2, forward_speed: 40}"
LINE = 1 + CASE[: CASE.index(OLD)].count("\n")


def test_crown_and_offset_of_the_aircraft():
    runway = runway_of(RunwaySection(crown=0.015, offset=4.0), origin=(-3.0, 0.0))
    # The center line lies 4 m to port of the aircraft.
    assert runway.height(0.0, -4.0) == 0.0
    assert runway.height(0.0, 0.0) == Runway(crown=0.015).height(0.0, 4.0)


def test_roughness_gives_one_track_or_two():
    profile = {"kind": "roughness", "iso_class": "B", "length": 300}
    assert runway_of(RunwaySection(profile=profile)).right is None
    two = RunwaySection(profile=profile | {"track_spacing": 7.6})
    runway = runway_of(two)
    assert runway.track_spacing == 7.6
    assert runway.profile.height != runway.right.height


def test_aircraft_stands_level_on_a_crown_and_rolls_over_the_rough():
    profile = {"kind": "roughness", "iso_class": "D", "length": 300}
    profile |= {"start": 2.0, "run_in": 2.0}
    rough = runway_of(RunwaySection(profile=profile, crown=0.015))
    body = aircraft_body(0)
    landing = MakeLandingDiagram(body, aircraft_gears(), rough, gravity=9.80665)
    run = land(landing, duration=0.15, accuracy=1e-3, rolling=50.0)
    left, right = (
        run[f"tire_main_{side}_{side}.contact"][1] for side in ("left", "right")
    )
    assert left[0] == pytest.approx(right[0], rel=1e-6)
    assert abs(left - left[0]).max() > 0.02 * left[0]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("crown: 1", "runway.crown: found 1, expected less than or equal to 0.1"),
        ("offset: 90", "runway.offset: found 90"),
        (
            "profile: {kind: roughness}",
            "iso_class: found none, expected one of iso_class, in",
        ),
        ("profile: {kind: roughness, iso_class: K}", "iso_class: found 'K'"),
        ("profile: {kind: roughness, intensity: 0}", "intensity: found 0"),
        (
            "profile: {kind: roughness, iso_class: A, length: 100}",
            "length: found 100 m, expected more than twice",
        ),
        (
            "profile: {kind: roughness, iso_class: A, wavelengths: [3, 2]}",
            "wavelengths: found 3 to 2 m",
        ),
        ("profile: {kind: measured, file: two.txt}", "track_spacing: found none, but"),
        (
            "profile: {kind: measured, file: one.txt, track_spacing: 7}",
            "has one track, expected none",
        ),
        ("profile: {kind: measured, file: bad.txt}", "bad.txt, line 2: found"),
        ("profile: {kind: measured, file: one.txt, unit: in}", "unit: found 'in'"),
        ("profile: {kind: rough}", "expected a mapping with kind bump, waves, step"),
    ],
)
def test_bad_runway_is_named_with_its_line(tmp_path, text, expected):
    (tmp_path / "one.txt").write_text("0 0\n10 0\n")
    (tmp_path / "two.txt").write_text("0 0 0\n10 0 0\n")
    (tmp_path / "bad.txt").write_text("0 0\nx\n")
    new = OLD[:-1] + f", runway: {{{text}}}}}"
    with pytest.raises(InputError) as error:
        parse_case(CASE.replace(OLD, new), file="tiny.yaml", folder=tmp_path)
    found = [p for p in error.value.problems if expected in p]
    assert found, error.value.problems
    assert found[0].startswith(f"tiny.yaml:{LINE}: scenario.runway")
