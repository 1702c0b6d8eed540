"""The house stands as docs/design.md says."""

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def test_fem_imports_without_drake() -> None:
    """`python -m fem` must serve users who have no Drake."""
    code = "import sys, fem; sys.exit('pydrake' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT).returncode == 0


def test_constraints_pin_every_dependency() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    wanted = sum(project["optional-dependencies"].values(), project["dependencies"])
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


@pytest.mark.parametrize(
    ("script", "said"),
    [
        ("echo 3.13.1", "(3.13.1)"),
        ("exit 127", "(does not start)"),
        ("case $2 in *venv*) exit 1 ;; esac; echo 3.12.9", "python3.12-venv"),
    ],
)
def test_a_python_that_does_not_fit_is_said_in_one_line(
    script: str, said: str, tmp_path: Path
) -> None:
    python = tmp_path / "python3.12"
    python.write_text(f"#!/bin/sh\n{script}\n")
    python.chmod(0o755)
    find = ["sh", str(ROOT / "find_python.sh"), str(tmp_path / "venv"), str(python)]
    run = subprocess.run(find, capture_output=True, text=True)
    assert run.returncode == 1
    assert run.stdout == ""
    assert len(run.stderr.splitlines()) == 1
    assert f"{python} (" in run.stderr
    assert said in run.stderr


def test_an_environment_of_another_python_is_not_ignored(tmp_path: Path) -> None:
    held, asked = tmp_path / "venv" / "bin" / "python", tmp_path / "python"
    held.parent.mkdir(parents=True)
    for place, version in ((held, "3.11.7"), (asked, "3.12.1")):
        place.write_text(f"#!/bin/sh\necho {version}\n")
        place.chmod(0o755)
    find = ["sh", str(ROOT / "find_python.sh"), str(tmp_path / "venv"), str(asked)]
    run = subprocess.run(find, capture_output=True, text=True)
    assert run.returncode == 1
    assert "holds Python 3.11.7" in run.stderr
    assert "make clean" in run.stderr


def test_folders_of_tests_are_rooms() -> None:
    for package in ("drake_landing", "fem", "systems"):
        rooms = {path.name for path in (ROOT / package).iterdir() if path.is_dir()}
        tests = ROOT / "tests" / package
        folders = {path.name for path in tests.iterdir() if path.is_dir()}
        assert folders - rooms - {"__pycache__"} == set(), package
