"""Files are written aside and then renamed; versions that figures depend on."""

import importlib.metadata
import platform
from collections.abc import Callable
from pathlib import Path

import pandas as pd

from fem.aside import written_aside

_PACKAGES = ("drake-landing", "drake", "numpy", "scipy", "pandas", "pynastran")


def versions() -> dict[str, str]:
    """Of the program and what its figures depend on."""
    found = {name: importlib.metadata.version(name) for name in _PACKAGES}
    return {**found, "python": platform.python_version()}


def write_aside(path: Path, write: Callable[[Path], object]) -> None:
    """Calls `write` with a temporary name in the same folder, then renames.

    A reader never meets a half-written file, and an interrupted run leaves the old one.
    """
    with written_aside(path) as part:
        write(part)


def write_csv(path: Path, table: pd.DataFrame, *, index: bool = False) -> None:
    """Nine significant digits, zero without a sign; NaN is an empty cell."""
    plain = table.copy()
    floats = plain.select_dtypes("floating").columns
    plain[floats] = plain[floats] + 0.0  # -0.0 + 0.0 is 0.0
    write_aside(path, lambda to: plain.to_csv(to, index=index, float_format="%.9g"))
