"""The packages `fem` and `systems` must be those that came with `drake_landing`.

Their names are plain words: a `systems.py` in the folder where Python was started would
be imported instead, and fail in a place that says nothing.
"""

import sys
from importlib.util import find_spec
from pathlib import Path

_HOME = Path(__file__).resolve().parents[1]
_OWN = ("fem", "systems")


def verify_own_packages() -> None:
    """Raises:
    ImportError: one line that names what shadows a package, and what to do.
    """
    for name in _OWN:
        found = _origin(name)
        expected = _HOME / name / "__init__.py"
        if found != expected:
            raise ImportError(
                f"drake_landing needs its own package '{name}' ({expected.parent}), "
                f"but Python finds {found or 'none'} first: rename that, or start "
                "Python in another folder"
            )


def _origin(name: str) -> Path | None:
    """File of a module, imported or not."""
    loaded = sys.modules.get(name)
    spec = getattr(loaded, "__spec__", None) or find_spec(name)
    return Path(spec.origin).resolve() if spec and spec.origin else None
