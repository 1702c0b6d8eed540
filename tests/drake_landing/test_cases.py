"""The ready-to-run cases are valid, and the schema that users see fits them."""

import json
from pathlib import Path

import jsonschema
import pytest
import yaml

from drake_landing.campaign.cases import is_campaign, load_campaign
from drake_landing.campaign.run import expand
from drake_landing.case.reading import case_text, load_case, parse_case, schema_text
from drake_landing.process.explain import explain
from fem.errors import InputError

FILES = sorted(Path(__file__).parents[2].joinpath("cases").rglob("*.yaml"))
CASES = [path for path in FILES if not is_campaign(path)]
CAMPAIGNS = [path for path in FILES if is_campaign(path)]


@pytest.mark.parametrize("path", CAMPAIGNS, ids=lambda path: path.stem)
def test_campaigns_expand_to_valid_cases(path: Path) -> None:
    rows, cases = expand(load_campaign(path))
    assert len(rows) == len(cases) > 1


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_case_is_valid(path: Path) -> None:
    case = load_case(path)
    assert parse_case(case_text(case)) == case


ACCEPTED = {
    "sink rate": "{sink_rate: 2}",
    "preset": "{preset: two_point}",
    "rolling": "{start: rolling, lift: none}",
}
REFUSED = {"nothing": "{}", "no sink rate": "{pitch: 3}", "too fast": "{sink_rate: 20}"}


def by_schema(text: str) -> bool:
    schema = json.loads(schema_text())
    data = json.loads(json.dumps(yaml.safe_load(text)))
    return not list(jsonschema.Draft202012Validator(schema).iter_errors(data))


def by_program(text: str) -> bool:
    try:
        parse_case(text)
    except InputError:
        return False
    return True


@pytest.mark.parametrize("name", [*ACCEPTED, *REFUSED])
def test_editors_accept_what_the_program_accepts(name: str) -> None:
    scenario = (ACCEPTED | REFUSED)[name]
    text = (
        f"$schema: case.json\nname: a\nairframe: {{model: con}}\nscenario: {scenario}"
    )
    assert by_schema(text) == by_program(text) == (name in ACCEPTED)


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_schema_fits_the_cases(path: Path) -> None:
    assert by_schema(path.read_text())


QUICK = [
    pytest.param(
        path,
        id=path.stem,
        marks=[pytest.mark.slow] if "model: full" in path.read_text() else [],
    )
    for path in CASES
]


@pytest.mark.parametrize("path", QUICK)
def test_dry_run_of_a_case_finds_nothing_odd(path: Path) -> None:
    text = explain(load_case(path))
    assert "6 rigid-body motions, no mechanism" in text
    notes = [line for line in text.splitlines() if line.startswith("note:")]
    assert [note for note in notes if "gears" in note or "axes" in note] == []


def test_there_are_cases() -> None:
    assert CASES
