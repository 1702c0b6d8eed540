"""Pictures look alike on every machine, and in every folder."""

import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
from matplotlib import style
from matplotlib.axis import Axis
from matplotlib.figure import Figure

_MOST_DECADES = 3.5  # of a logarithmic axis with 2 and 5 beside 1


@contextmanager
def plain_style() -> Iterator[None]:
    """Matplotlib as it comes: no matplotlibrc counts, and `$` is no mathematics.

    Matplotlib reads one in the working directory, which may be somebody else's: TeX,
    for one, includes any file.
    """
    plain = style.context(["default", {"text.parse_math": False}])
    with plain, warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing")  # boxes stand there
        yield


def plain_ticks(figure: Figure) -> None:
    """Logarithmic axes with 1, 2, 5 as plain numbers: nothing is mathematics here."""
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            if axis.get_scale() == "log":
                label = _labels(axis)
                axis.set_major_formatter(label)
                axis.set_minor_formatter(label)


def _labels(axis: Axis) -> Callable[[float, int], str]:
    """Tick labels of a logarithmic axis: fewer digits, the more decades it has."""
    low, high = axis.get_view_interval()
    decades = float(np.log10(high / low))
    digits = "1" if decades > _MOST_DECADES else "125" if decades > 1.0 else "123456789"
    return lambda x, _: f"{x:g}" if f"{x:.1e}"[0] in digits else ""
