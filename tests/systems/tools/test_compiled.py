"""Compilation works where nothing can be written, too."""

import subprocess
import sys
from pathlib import Path

import pytest

from systems.airframe import modal_kinematics
from systems.tools import compiled as module
from systems.tools import vectors

MODULE = """\
from systems.tools.compiled import compiled, compiled_before

print(compiled_before(__file__))

@compiled
def double(x: float) -> float:
    return {factor} * x

assert double(1.5) == {factor} * 1.5
print(compiled_before(__file__))
"""

compiling = pytest.mark.skipif(not module.COMPILES, reason="NUMBA_DISABLE_JIT is set")


@compiling
def test_function_is_compiled_and_kept_in_plain_python():
    @module.compiled
    def double(x: float) -> float:
        return 2.0 * x

    assert double(1.5) == 3.0
    assert double.py_func(1.5) == 3.0


def test_without_a_folder_for_the_cache_it_compiles_anew(monkeypatch, tmp_path):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "file"))

    @module.compiled
    def half(x: float) -> float:
        return 0.5 * x

    assert half(3.0) == 1.5
    assert not module.compiled_before(__file__)


@pytest.mark.parametrize("file", [modal_kinematics.__file__, vectors.__file__])
def test_machine_code_depends_on_module_and_vocabulary(file, monkeypatch, tmp_path):
    """Functions of other modules contain that of `vectors`."""
    before = module._folder(modal_kinematics.__file__)
    changed = tmp_path / Path(file).name
    changed.write_text(Path(file).read_text() + "# changed\n")
    if file == vectors.__file__:
        monkeypatch.setattr(module, "_VOCABULARY", changed)
        module._edition.cache_clear()
        after = module._folder(modal_kinematics.__file__)
        module._edition.cache_clear()
    else:
        after = module._folder(str(changed))
    assert before.name.startswith("modal_kinematics-")
    assert after.name != before.name


@compiling
def test_what_is_compiled_is_known_by_its_text(tmp_path):
    """Nothing is left beside the module; a changed text is not taken for compiled."""
    script = tmp_path / "place" / "script.py"
    script.parent.mkdir()
    env = {**module.os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "code")}
    seen = []
    for factor in (2.0, 2.0, 3.0):
        script.write_text(MODULE.format(factor=factor))
        run = [sys.executable, str(script)]
        done = subprocess.run(run, env=env, capture_output=True, text=True, check=True)
        seen.append(done.stdout.split())
    assert seen == [["False", "True"], ["True", "True"], ["False", "True"]]
    assert list(script.parent.iterdir()) == [script]
