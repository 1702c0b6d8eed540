"""Case files: what is accepted, and what the user reads where it is not."""

import json
from pathlib import Path
from typing import get_args

import pytest

from drake_landing.airframe.deck_units import METALS
from drake_landing.case.airframe import UnitSystem
from drake_landing.case.mode_selection import Selection
from drake_landing.case.reading import case_text, load_case, parse_case, schema_text
from drake_landing.case.schema import Case
from drake_landing.case.simulation import Transient
from drake_landing.process import landing_deck
from drake_landing.transient.response import SCHEMES
from fem.deck.units import SYSTEMS
from fem.errors import InputError

MINIMAL = """\
name: small
airframe:
  model: con
scenario:
  sink_rate: 1.8288
"""


def problems(text: str) -> list[str]:
    with pytest.raises(InputError) as caught:
        parse_case(text, file="c.yaml")
    return list(caught.value.problems)


def gears_of_tiny_case() -> str:
    text = (Path(__file__).parents[1] / "tiny_case.yaml").read_text()
    return text[text.index("gears:") :]


def edited(old: str, new: str) -> str:
    assert old in MINIMAL
    return MINIMAL.replace(old, new)


def test_names_that_cases_take_are_those_of_the_tables() -> None:
    scheme = Transient.model_fields["scheme"].annotation
    assert set(get_args(scheme)) == set(SCHEMES)
    assert set(get_args(UnitSystem)) == set(SYSTEMS) == set(METALS)
    assert set(landing_deck._UNITS) == set(SYSTEMS)


def test_defaults_make_a_complete_case() -> None:
    case = parse_case(MINIMAL)
    assert case.gears == "d150"
    assert case.simulation.integrator == "runge_kutta3"
    assert case.airframe.select == Selection(kind="below", value=50.0)
    assert case.simulation.duration == "auto"
    assert case.transient_duration(1.7) == 1.7


def test_text_of_a_case_reads_back_equal() -> None:
    case = parse_case(edited("model: con", "model: con\n  select: count 7"))
    assert parse_case(case_text(case)) == case


def test_deck_is_relative_to_the_case_file(tmp_path: Path) -> None:
    text = edited("model: con", "deck: a/b.bdf\n  monitoring: {tip: 4}")
    gears = gears_of_tiny_case()
    path = tmp_path / "case.yaml"
    path.write_text(text + gears)
    assert load_case(path).airframe.deck == tmp_path / "a/b.bdf"


def test_case_is_frozen() -> None:
    case = parse_case(MINIMAL)
    with pytest.raises(ValueError, match="frozen"):
        case.name = "other"  # pyright: ignore[reportAttributeAccessIssue]


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [("count 3", "count", 3), ("below 50 Hz", "below", 50), ("all", "all", 0)],
)
def test_selections(text: str, kind: str, value: float) -> None:
    case = parse_case(edited("model: con", f"model: con\n  select: {text}"))
    assert (case.airframe.select.kind, case.airframe.select.value) == (kind, value)
    assert str(case.airframe.select) == text


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ("sink_rate", "sink_rte", 5, ["scenario.sink_rte", "did you mean 'sink_rate'"]),
        ("model", "modell", 3, ["airframe.modell", "did you mean 'model'"]),
        ("1.8288", "0", 5, ["scenario.sink_rate", "found 0", "greater than 0", "m/s"]),
        ("1.8288", "360", 5, ["found 360", "less than or equal to 10", "m/s"]),
        ("1.8288", "fast", 5, ["found 'fast'", "number"]),
        ("1.8288", ".nan", 5, ["found .nan", "finite"]),
        ("model: con", "model: cone", 3, ["found 'cone'", "did you mean 'con'"]),
        (
            "model: con",
            "select: count 1",
            2,
            ["one of `model`", "`deck`", "`matrices`"],
        ),
        ("model: con", "model: con\n  select: 7", 4, ["found 7", "count N"]),
        ("name: small", "name: a/b", 1, ["found 'a/b'"]),
        ("name: small", "nam: small", 1, ["name: missing"]),
        ("name: small", "name: small\nname: big", 2, ["already given in line 1"]),
        ("  sink_rate: 1.8288", "  3", 4, ["scenario: found 3", "mapping"]),
        ("name: small", "name: small\ngears: d15", 2, ["did you mean 'd150'"]),
        ("name: small", "name: small\ngears: []", 2, ["at least one landing gear"]),
        ("name: small", "name: [", 3, ["not valid YAML"]),
        (
            "name: small",
            "name: small\ntransient: {step: 1e-300}",
            2,
            ["transient.step", "found 1e-300", "greater than or equal to 0.000001"],
        ),
    ],
)
def test_mistakes_are_named_with_line_and_path(
    old: str, new: str, line: int, words: list[str]
) -> None:
    found = problems(edited(old, new))
    fitting = [p for p in found if all(word in p for word in words)]
    assert fitting, found
    assert fitting[0].startswith(f"c.yaml:{line}: ")


def test_all_mistakes_come_at_once() -> None:
    text = edited("1.8288", "-1\n  pitch: 91\n  rol: 2").replace("con", "cone")
    assert len(problems(text)) == 4


@pytest.mark.parametrize("text", ["", "[1, 2]", "hello"])
def test_other_yaml_is_refused(text: str) -> None:
    assert "expected a mapping of sections" in problems(text)[0]


def test_unreadable_files_are_named(tmp_path: Path) -> None:
    binary = tmp_path / "x.yaml"
    binary.write_bytes(b"\xfd\xfe\x00")
    for path, words in [
        (tmp_path / "none.yaml", "no such case file"),
        (tmp_path, "is a folder"),
        (binary, "not a UTF-8 text file"),
    ]:
        with pytest.raises(InputError, match=words) as caught:
            load_case(path)
        assert str(path) in str(caught.value)


def test_gear_mistakes_carry_their_path() -> None:
    gears = gears_of_tiny_case()
    text = edited("model: con", "deck: a.bdf\n  monitoring: {tip: 4}") + gears
    found = problems(text.replace("stiffness: ", "stifness: ", 1))
    assert any("gears.nose.tyre.stifness" in p and "'stiffness'" in p for p in found)
    found = problems(text.replace("name: nose", "name: nose\n    kind: flying", 1))
    assert "gears.nose.kind: found 'flying', expected telescopic, levered" in found[0]
    found = problems(text.replace("name: main_right", "name: main_left"))
    assert "name main_left is used more than once" in found[0]


_BEAM = "cylinder_bending: 1.0e+6, piston_bending: 1.0e+6, overhang: 0.2"


@pytest.mark.parametrize(
    ("field", "message"),
    [
        ("leg: 3", "leg: found 3, expected a mapping"),
        ("leg: {}", "leg: found nothing that bends, expected fore_aft, lateral"),
        ("leg: {fore_aft: {}}", "leg.fore_aft: found none, expected one of stiffness"),
        (
            "leg: {fore_aft: {frequency: 500}}",
            "leg.fore_aft.frequency: found 500, expected less than or equal to 200",
        ),
        (
            "leg: {lateral: {stiffness_table: [[0, 1.0e+6], [0.1, -2]]}}",
            "leg.lateral.stiffness_table: found -2, expected > 0",
        ),
        (
            "leg: {lateral: {frequency_table: [[0, 9], [40, 8]]}}",
            "leg.lateral.frequency_table: found a stroke of 40 m, expected about 0.22",
        ),
        (
            "leg: {torsion: {frequency: 9, free_play_deg: 20}}",
            "leg.torsion.free_play_deg: found 20, expected less than or equal to 5",
        ),
        (
            "leg: {fore_aft: {frequncy: 9}}",
            "leg.fore_aft.frequncy: unknown key; did you mean 'frequency'?",
        ),
        (
            f"leg: {{beam: {{{_BEAM}, cylinder_length: 0.9, bearing_distance: 0.2}}}}",
            "leg.beam.overhang: found 0.2 m, expected more than the stroke, 0.22 m",
        ),
        (
            "cylinder: {mass: 5, cg: [2, 0, -1], inertia: [3, 3, 1]}",
            "cylinder: found one on a leg that does not bend, expected its mass in",
        ),
    ],
)
def test_bad_legs_give_one_message_with_line_field_found_and_expected(
    field: str, message: str
) -> None:
    gears = gears_of_tiny_case()
    text = edited("model: con", "deck: a.bdf\n  monitoring: {tip: 4}") + gears
    text = text.replace("    wheel_offsets", f"    {field}\n    wheel_offsets", 1)
    line = text.split("\n").index(f"    {field}") + 1
    (problem,) = problems(text)
    assert problem.startswith(f"c.yaml:{line}: gears.nose.{message}")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "{translational_stiffness: -1, rotational_stiffness: 1}",
            "found -1, expected",
        ),
        ("{translational_stiffness: 1}", "rotational_stiffness: missing"),
        ("true", "found true, expected a mapping"),
    ],
)
def test_bad_bushings_are_named(text: str, message: str) -> None:
    found = problems(edited("name: small", f"name: small\nbushing: {text}"))
    assert len(found) == 1
    assert found[0].startswith("c.yaml:2: bushing")
    assert message in found[0]


def test_bushings_need_a_run_without_gravity() -> None:
    bushing = "{translational_stiffness: 1.0e+8, rotational_stiffness: 1.0e+8}"
    text = edited("name: small", f"name: small\nbushing: {bushing}")
    assert parse_case(text).bushing is not None
    (problem,) = problems(text.replace("sink_rate: 1.8288", "preset: taxi_bump"))
    assert problem.startswith("c.yaml:2: bushing: found one where gravity acts")


def test_schema_gives_meaning_unit_and_range_of_every_number() -> None:
    schema = json.loads(schema_text())
    assert schema.pop("$schema").endswith("2020-12/schema")
    assert schema == Case.model_json_schema()
    sink_rate = schema["$defs"]["Scenario"]["properties"]["sink_rate"]
    assert "m/s, > 0 and <= 10" in sink_rate["description"]
    for section in ("Airframe", "Scenario", "Simulation", "Transient"):
        for name, field in schema["$defs"][section]["properties"].items():
            assert field.get("description"), f"{section}.{name}"
