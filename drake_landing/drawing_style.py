"""Pictures look alike on every machine, and in every folder."""

from contextlib import AbstractContextManager

from matplotlib import style
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatter


def plain_style() -> AbstractContextManager[None]:
    """Matplotlib as it comes: no matplotlibrc counts, and `$` is no mathematics.

    Matplotlib reads one in the working directory, which may be somebody else's: TeX,
    for one, includes any file.
    """
    return style.context(["default", {"text.parse_math": False}])


def plain_ticks(figure: Figure) -> None:
    """Decades as plain numbers: nothing is mathematics here."""
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            if axis.get_scale() == "log":
                axis.set_major_formatter(LogFormatter())
                axis.set_minor_formatter(LogFormatter(labelOnlyBase=False))
