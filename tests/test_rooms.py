"""The house stands as docs/design.md says."""

import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_fem_imports_without_drake() -> None:
    """`python -m fem` must serve users who have no Drake."""
    code = "import sys, fem; sys.exit('pydrake' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT).returncode == 0


def test_constraints_pin_every_dependency() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    wanted = project["dependencies"] + project["optional-dependencies"]["test"]
    pinned = {
        line.split("==")[0].lower()
        for line in (ROOT / "constraints.txt").read_text().splitlines()
        if "==" in line
    }
    names = {
        w.split(";")[0].split("[")[0].split(">")[0].split("<")[0].strip().lower()
        for w in wanted
    }
    assert names <= pinned


def test_folders_of_tests_are_rooms() -> None:
    for package in ("drake_landing", "fem", "systems"):
        rooms = {path.name for path in (ROOT / package).iterdir() if path.is_dir()}
        tests = ROOT / "tests" / package
        folders = {path.name for path in tests.iterdir() if path.is_dir()}
        assert folders - rooms - {"__pycache__"} == set(), package
