"""Compilation of small numerical functions to machine code.

For functions of a few microseconds that a simulation calls ten thousand times: scalar
arithmetic and short loops, where numpy spends most of its time on the call itself.
Plain Python remains the language; `function.py_func` is the function uncompiled, and
with NUMBA_DISABLE_JIT=1 in the environment nothing is compiled: a debugger steps into
the laws (`COMPILES`; a landing is then some tens of times slower).

The machine code is kept in the user's cache folder (Linux: ~/.cache/drake-landing/
compiled), or below the folder that the environment's NUMBA_CACHE_DIR names, under a
name that depends on the text of the module and of `vectors`, on Python, numba and the
processor: a compiled function calls only compiled functions of its own module and of
`vectors`; a compiled law those of its room and of this one. Nothing is written beside
the modules.
"""

import hashlib
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import ParamSpec, TypeVar, cast

import numba
import platformdirs
from llvmlite.binding import get_host_cpu_name
from numba import njit
from numba.core import config
from numba.core.caching import FunctionCache
from numba.extending import register_jitable

# Numba takes settings from the working directory, which may be somebody else's.
config._config_fname = ""
config.reload_config()

COMPILES = not config.DISABLE_JIT
"""Whether laws run as machine code, which takes arrays where they take objects."""

P = ParamSpec("P")
R = TypeVar("R")

_VOCABULARY = Path(__file__).with_name("vectors.py")

# Sums may be reordered, which lets loops use vector instructions; nothing is assumed
# of infinities, NaN or signed zeros.
_OPTIONS = {"fastmath": {"reassoc", "contract", "nsz"}, "error_model": "numpy"}


def compiled_folder() -> Path:
    """Where machine code is kept."""
    given = os.environ.get("NUMBA_CACHE_DIR")
    if given:
        return Path(given, "drake-landing")
    return Path(platformdirs.user_cache_dir("drake-landing"), "compiled")


def compiled_before(module: str) -> bool:
    """Whether machine code of a module, by its file, is kept; else calls compile."""
    return any(_folder(module).rglob("*.nbi"))


def compiled(function: Callable[P, R], *, nogil: bool = False) -> Callable[P, R]:
    """The function, compiled at its first call.

    Args:
        function: of a module.
        nogil: other threads of Python run on meanwhile.
    """
    folder = _folder(function.__code__.co_filename)
    return _compiled(function, folder, {**_OPTIONS, "nogil": nogil})


def law(function: Callable[P, R]) -> Callable[P, R]:
    """A formula for floats and AutoDiffXd, unchanged; a compiled law may call it."""
    return cast(Callable[P, R], register_jitable(function))


def compiled_law(function: Callable[P, R]) -> Callable[P, R]:
    """A compiled twin of a formula that calls functions marked `law`.

    The formula itself stays as it is and serves AutoDiffXd. The functions it calls are
    of its own room and of this one. Sums are not reordered: what is exactly zero in
    Python is so here.
    """
    import systems.tools.numba_overloads  # noqa: F401  registers them

    file = Path(function.__code__.co_filename)
    rooms = sorted({*file.parent.glob("*.py"), *Path(__file__).parent.glob("*.py")})
    folder = _folder(str(file), tuple(rooms))
    return _compiled(function, folder, {"error_model": "numpy"})


def _compiled(function: Callable[P, R], folder: Path, options: dict) -> Callable[P, R]:
    if not _writable(folder):
        return cast(Callable[P, R], njit(**options)(function))
    # Numba looks up the folder when it decorates.
    before, config.CACHE_DIR = config.CACHE_DIR, str(folder)
    try:
        found = njit(**options)(function)
        found._cache = _Forgiving(function)
        return cast(Callable[P, R], found)
    finally:
        config.CACHE_DIR = before


class _Forgiving(FunctionCache):
    """A full disk, or damaged machine code, costs time and not the result."""

    def load_overload(self, sig: object, target_context: object) -> object:
        """See numba; None: compile."""
        with suppress(Exception):  # of unpickling: any
            return super().load_overload(sig, target_context)
        return None

    def save_overload(self, sig: object, data: object) -> None:
        """See numba."""
        with suppress(OSError):
            super().save_overload(sig, data)


def _folder(file: str, others: tuple[Path, ...] = ()) -> Path:
    """Folder of the machine code of a module, which calls others or the vocabulary."""
    return (
        compiled_folder()
        / f"{Path(file).stem}-{_edition(file, others or (_VOCABULARY,))}"
    )


@cache
def _edition(file: str, others: tuple[Path, ...]) -> str:
    """Hash of all that machine code depends on."""
    machine = f"{sys.version} {numba.__version__} {get_host_cpu_name()}"
    text = b"".join(path.read_bytes() for path in (Path(file), *others))
    return hashlib.sha256(machine.encode() + text).hexdigest()[:16]


def _writable(folder: Path) -> bool:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return False
    return os.access(folder, os.W_OK)
