"""The ready-to-run cases are valid, and the schema that users see fits them."""

from pathlib import Path

import pytest

from drake_landing.cases_io import case_text, load_case, parse_case

CASES = sorted(Path(__file__).parents[2].joinpath("cases").glob("*.yaml"))


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_case_is_valid(path: Path) -> None:
    case = load_case(path)
    assert parse_case(case_text(case)) == case


def test_there_are_cases() -> None:
    assert CASES
