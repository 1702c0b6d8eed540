"""Line plots in one calm style, as SVG text to be set into a page.

Text stays text in the SVG, so the page's own font applies and words can be searched.
"""

import io
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import matplotlib as mpl
import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from drake_landing.drawing_style import plain_style, plain_ticks
from fem.files.escaping import attribute

Float64 = npt.NDArray[np.float64]

MULTIBODY = "#1f5fbf"
TRANSIENT = "#cf3a2c"
INK, FAINT = "#2b3440", "#8a94a3"
# Distinct from the two above and for every eye (after Okabe and Ito).
SERIES = ("#00896b", "#d98200", "#7a5195", "#5c6773", "#b5467c", "#4fa3d1")
WIDTH = 9.6  # inch; the page scales the picture to its column

_STYLE = {
    "svg.fonttype": "none",
    "svg.hashsalt": "drake-landing",  # equal data give equal files
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9.0,
    "axes.edgecolor": FAINT,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 9.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.titlecolor": INK,
    "axes.grid": True,
    "grid.color": "#e3e7ec",
    "grid.linewidth": 0.7,
    "xtick.color": FAINT,
    "ytick.color": FAINT,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "lines.linewidth": 1.4,
    "path.simplify_threshold": 0.2,
}


@contextmanager
def panels(
    rows: int, columns: int, *, height: float = 2.1, shared: bool = True
) -> Iterator[tuple[Figure, list[list[Axes]]]]:
    """A figure with a grid of panels, in the style of the report.

    Args:
        rows, columns: of the grid.
        height: of a row, inch.
        shared: all panels have one horizontal axis.
    """
    with plain_style(), mpl.rc_context(_STYLE):
        figure = Figure(figsize=(WIDTH, height * rows + 0.35), layout="constrained")
        FigureCanvasSVG(figure)
        grid = figure.subplots(rows, columns, squeeze=False, sharex=shared)
        yield figure, grid.tolist()


def svg(figure: Figure, label: str) -> str:
    """The figure as an SVG element that scales with the page.

    Args:
        figure: drawn within `panels`.
        label: what it shows, for readers that do not see it.
    """
    out = io.StringIO()
    plain_ticks(figure)
    with plain_style(), mpl.rc_context(_STYLE):
        figure.savefig(out, format="svg", metadata={"Date": None}, transparent=True)
    text = out.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r'width="[\d.]+pt" height="[\d.]+pt"', "", text, count=1)
    # The page's fonts, and ids that differ from those of the other pictures.
    text = text.replace("'DejaVu Sans'", "inherit").replace("DejaVu Sans", "inherit")
    mark = f"f{abs(hash_of(label)):x}-"
    text = re.sub(r'\bid="', f'id="{mark}', text)
    text = re.sub(r'(xlink:href="#|url\(#)', rf"\1{mark}", text)
    shown = attribute(label)
    return text.replace("<svg", f'<svg role="img" aria-label="{shown}"', 1)


def hash_of(text: str) -> int:
    """A hash that is the same in every run of Python."""
    value = 5381
    for byte in text.encode():
        value = (value * 33 + byte) & 0xFFFFFFFF
    return value


def curve(
    axes: Axes,
    time: npt.ArrayLike,
    values: npt.ArrayLike,
    color: str,
    label: str | None = None,
    *,
    dashed: bool = False,
) -> None:
    """One history; the dashed ones leave those beneath visible."""
    style = (0, (5, 3)) if dashed else "-"
    axes.plot(time, values, color=color, label=label, linestyle=style)


def finish(axes: Axes, title: str, unit: str, *, x: str | None = "time, s") -> None:
    """Title with unit, text of the horizontal axis, line at zero."""
    axes.set_title(f"{title}, {unit}" if unit else title)
    if x:
        axes.set_xlabel(x)
    axes.margins(x=0.0)
    axes.axhline(0.0, color=FAINT, linewidth=0.7, zorder=1)


def head(figure: Figure, text: str) -> None:
    """Writes the common title of all panels above them at the left."""
    figure.suptitle(text, x=0.005, ha="left", fontsize="medium", fontweight="bold")


def legend(figure: Figure, axes: Axes) -> None:
    """One legend for all panels, above them, out of the curves' way."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=len(labels))


def common_scale(series: Sequence[npt.ArrayLike], unit: str) -> tuple[float, str]:
    """Factor and unit that suit all series of one panel."""
    largest = max((np.abs(np.asarray(s)).max(initial=0.0) for s in series), default=0.0)
    if unit in ("N", "N m", "J") and largest >= 1e3:
        return 1e-3, f"k{unit}"
    return 1.0, unit
