"""What the README promises is there."""

import re
from pathlib import Path

import pytest
import yaml

from drake_landing.case.reading import load_case, parse_case
from drake_landing.cli import app

ROOT = Path(__file__).parents[2]
README = ROOT.joinpath("README.md").read_text()
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_links_lead_somewhere(page: Path) -> None:
    links = re.findall(r"\]\(([^)#]+)[^)]*\)", page.read_text())
    missing = [
        link
        for link in links
        if "://" not in link and not (page.parent / link).exists()
    ]
    assert missing == []


def test_every_command_is_there_and_named() -> None:
    names = {
        c.name or c.callback.__name__.replace("_", "-") for c in app.registered_commands
    }
    told = set(re.findall(r"`drake-landing ([a-z-]+)", README))
    assert told == {name.replace("_", "-") for name in names}


def test_the_python_example_is_a_valid_case() -> None:
    (text,) = re.findall(r'parse_case\("""(.*?)"""', README, re.DOTALL)
    assert parse_case(text).name == "hard"


def test_the_case_it_shows_is_the_one_of_the_folder() -> None:
    (text,) = re.findall(r"```yaml\n(.*?)```", README, re.DOTALL)
    shown = yaml.safe_load(text.replace("    ...\n", ""))
    case = load_case(ROOT / "cases/commuter/case.yaml")
    gear = shown["gears"][0]
    assert case.gears[0].attachment_node == gear["attachment_node"]
    assert list(case.gears[0].axle) == gear["axle"]
    assert case.airframe.units == shown["airframe"]["units"]
    for name, grid in shown["airframe"]["monitoring"].items():
        assert case.airframe.monitoring[name] == grid
