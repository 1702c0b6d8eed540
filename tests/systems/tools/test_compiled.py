"""Compilation works where nothing can be written, too."""

import hashlib
from pathlib import Path

import numba

from systems.airframe import modal_kinematics
from systems.tools import compiled as module
from systems.tools import vectors


def test_function_is_compiled_and_kept_in_plain_python():
    @module.compiled
    def double(x: float) -> float:
        return 2.0 * x

    assert double(1.5) == 3.0
    assert double.py_func(1.5) == 3.0


def test_without_a_folder_for_the_cache_it_compiles_anew(monkeypatch):
    def njit(cache: bool = False, **options):
        if cache:
            raise RuntimeError("cannot cache function: no locator available")
        return numba.njit(**options)

    monkeypatch.setattr(module, "njit", njit)

    @module.compiled
    def half(x: float) -> float:
        return 0.5 * x

    assert half(3.0) == 1.5


def test_machine_code_is_renewed_with_the_vocabulary():
    """Functions of other modules contain that of `vectors`: its text is in the name."""
    name = modal_kinematics._node_motion.py_func.__qualname__
    text = Path(vectors.__file__).read_bytes()
    assert name == "_node_motion_" + hashlib.sha256(text).hexdigest()[:8]
