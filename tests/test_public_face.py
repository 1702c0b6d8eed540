"""What a user imports is there, stays itself, and is not somebody else's."""

import importlib
import inspect
import os
import pkgutil
import pydoc
import shutil
import subprocess
import sys
import types
import zipfile
from pathlib import Path

import pytest

import drake_landing
import fem
import systems

ROOT = Path(__file__).parents[1]
PACKAGES = (drake_landing, fem, systems)


def _import_all(package: types.ModuleType) -> None:
    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        if not module.name.endswith("__main__"):
            importlib.import_module(module.name)


@pytest.mark.parametrize("package", PACKAGES, ids=lambda p: p.__name__)
def test_public_names_are_no_modules_even_after_all_are_imported(package) -> None:
    _import_all(package)
    for name in set(package.__all__) - {"__version__"}:
        value = getattr(package, name)
        assert not isinstance(value, types.ModuleType), name
        assert getattr(value, "__module__", "").split(".")[0] != "builtins", name
    assert set(package.__all__) <= set(dir(package))


@pytest.mark.parametrize("package", PACKAGES, ids=lambda p: p.__name__)
def test_packages_are_typed(package) -> None:
    folder = Path(package.__path__[0])
    assert (folder / "py.typed").exists()
    assert (folder / "__init__.pyi").exists()


@pytest.mark.parametrize("foreign", ["fem.py", "systems/__init__.py"])
def test_foreign_packages_are_named(foreign: str, tmp_path: Path) -> None:
    file = tmp_path / foreign
    file.parent.mkdir(exist_ok=True)
    file.write_text("x = 1\n")
    run = subprocess.run(
        [sys.executable, "-c", "import drake_landing"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(["", str(ROOT)])},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 1
    last = run.stderr.strip().splitlines()[-1]
    assert str(file) in last
    assert "rename" in last


@pytest.mark.parametrize("name", [n for n in systems.__all__ if n.endswith("_")])
def test_templated_systems_show_the_parameters_of_their_constructor(name) -> None:
    system = getattr(systems, name[:-1])
    assert system is getattr(systems, name)[None]
    shown = inspect.signature(system)
    assert next(iter(shown.parameters)) == "parameters"
    assert "converter" not in shown.parameters
    assert str(shown)[1:] in str(inspect.signature(system.__init__))


def test_help_shows_what_a_tire_needs() -> None:
    text = pydoc.render_doc(systems.Tire, renderer=pydoc.plaintext)
    assert "(parameters: systems.tire.tire_parameters.TireParameters | " in text
    assert "out `wrench`" in text


def test_version() -> None:
    assert drake_landing.__version__.count(".") == 2


@pytest.mark.slow
def test_editors_find_the_packages_of_an_editable_install(tmp_path: Path) -> None:
    """As README installs it, looked at by a type checker from another folder."""
    source, place, venv = tmp_path / "source", tmp_path / "place", tmp_path / "venv"
    for package in PACKAGES:
        folder = Path(package.__path__[0])
        shutil.copytree(folder, source / folder.name)
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, source)
    subprocess.run([sys.executable, "-m", "venv", str(venv)], check=True)
    python = str(venv / "bin" / "python")
    install = [python, "-m", "pip", "install", "--quiet", "--no-deps", "-e"]
    subprocess.run([*install, str(source)], check=True)
    place.mkdir()
    (place / "mine.py").write_text(
        "from drake_landing import load_case\nfrom fem import read_deck\n"
        "from systems import TireParameters\n"
        "reveal_type(load_case)\nreveal_type(read_deck)\nreveal_type(TireParameters)\n"
    )
    run = subprocess.run(
        [sys.executable, "-m", "pyright", "--pythonpath", python, "mine.py"],
        cwd=place,
        env={k: v for k, v in os.environ.items() if k != "PYTHONPATH"},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stdout
    assert "-> Case" in run.stdout
    assert "-> Deck" in run.stdout
    assert "type[TireParameters]" in run.stdout


@pytest.mark.slow
def test_wheel_runs_in_a_hostile_folder(tmp_path: Path) -> None:
    """A wheel has all data; a foreign fem.py where it is started does no harm."""
    build = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps"]
    subprocess.run([*build, "-w", str(tmp_path), str(ROOT)], check=True)
    wheel = next(tmp_path.glob("*.whl"))
    site = tmp_path / "site"
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(site)
    place = tmp_path / "place"
    (place / "systems").mkdir(parents=True)
    (place / "systems" / "__init__.py").write_text("x = 1\n")
    (place / "fem.py").write_text("x = 1\n")
    # As the installed command does it: the folder of the start is not searched.
    code = "from drake_landing.__main__ import main; main()"
    run = subprocess.run(
        [sys.executable, "-P", "-c", code, "demo", "--out", str(tmp_path / "demo")],
        cwd=place,
        env={**os.environ, "PYTHONPATH": str(site)},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stderr
    assert (tmp_path / "demo" / "report.html").exists()
