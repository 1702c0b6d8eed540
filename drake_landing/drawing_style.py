"""Pictures look alike on every machine, and in every folder."""

from contextlib import AbstractContextManager

from matplotlib import style


def plain_style() -> AbstractContextManager[None]:
    """Matplotlib as it comes: no matplotlibrc counts, and `$` is no mathematics.

    Matplotlib reads one in the working directory, which may be somebody else's: TeX,
    for one, includes any file.
    """
    return style.context(["default", {"text.parse_math": False}])
