"""Versions that figures depend on."""

import importlib.metadata
import platform

_PACKAGES = ("drake-landing", "drake", "numpy", "scipy", "pandas", "pynastran")


def versions() -> dict[str, str]:
    """Versions of the program and of the packages that its figures depend on."""
    found = {name: importlib.metadata.version(name) for name in _PACKAGES}
    return {**found, "python": platform.python_version()}
