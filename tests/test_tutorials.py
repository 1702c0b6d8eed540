"""What the pages tell people to type can be typed."""

import ast
import importlib
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
import typer

from drake_landing.cli import app

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").glob("*.md")]
TUTORIALS = (ROOT / "docs" / "tutorials.md").read_text(encoding="utf-8")
COMMANDS = typer.main.get_command(app).commands
SHELL = re.compile(r"^    ((?:drake-landing|python -m) .*?)(?:  +#.*)?$", re.M)
PYTHON = re.compile(r"^```python\n(.*?)^```$", re.M | re.S)


def typed(text: str) -> Iterator[list[str]]:
    for line in SHELL.findall(text):
        yield shlex.split(re.sub(r"\[.*?\]", "", line))


def blocks(text: str) -> Iterator[tuple[str, str]]:
    """Language and text of each block, in turn."""
    found = [(m.start(), "shell", m[1]) for m in SHELL.finditer(text)]
    found += [(m.start(), "python", m[1]) for m in PYTHON.finditer(text)]
    for _, language, block in sorted(found):
        yield language, block


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_commands_and_options_are_those_of_the_program(page: Path) -> None:
    for program, *words in typed(page.read_text(encoding="utf-8")):
        if program == "drake-landing":
            known = COMMANDS[words[0]]
            names = {"--help", *(n for p in known.params for n in p.opts)}
            assert {w.split("=")[0] for w in words if w.startswith("--")} <= names, (
                words
            )
        else:
            assert importlib.util.find_spec(words[1]), words
        for word in words:
            if word.startswith(("cases/", "tests/")):
                assert (ROOT / word).exists(), word


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_what_python_blocks_import_is_there(page: Path) -> None:
    for block in PYTHON.findall(page.read_text(encoding="utf-8")):
        for node in ast.walk(ast.parse(block)):
            if isinstance(node, ast.ImportFrom):
                module = importlib.import_module(str(node.module))
                assert all(hasattr(module, n.name) for n in node.names), block


def test_the_gear_of_the_tutorial_falls(capsys: pytest.CaptureFixture[str]) -> None:
    (block,) = (b for b in PYTHON.findall(TUTORIALS) if "drop_rig" in b)
    exec(block, {})
    low, high = re.findall(r"(\d+) kN at most", capsys.readouterr().out)
    assert int(low) < int(high)


@pytest.mark.slow
@pytest.mark.timeout(5400)  # ten minutes of a quiet machine
def test_tutorials_from_top_to_bottom(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "cases").symlink_to(ROOT / "cases")
    for language, block in blocks(TUTORIALS):
        words = ["-c", block]
        if language == "shell":
            program, *words = shlex.split(block)
            if program == "drake-landing":
                words = ["-m", "drake_landing", *words]
        run = subprocess.run(
            [sys.executable, *words], cwd=tmp_path, capture_output=True, text=True
        )
        assert run.returncode == 0, f"{block}\n{run.stdout}\n{run.stderr}"
