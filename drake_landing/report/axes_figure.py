"""The airframe from above and from the side, with the axes of its deck."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from drake_landing.case.axes import axis_words
from drake_landing.parts.cuts import BeamCuts
from drake_landing.report.svg_plots import (
    FAINT,
    INK,
    SERIES,
    TRANSIENT,
    legend,
    panels,
    svg,
)
from fem.arrays import Float64
from fem.model.structure import Structure

_DOTS = 2000  # grids drawn at most


def axes_sketch(
    structure: Structure, R_AB: Float64, gears: Sequence[int], cuts: Sequence[BeamCuts]
) -> str:
    """Grids, gears, points of the cuts and the axes x, y, z of the deck.

    Args:
        structure: the full model.
        R_AB: (3, 3).
        gears: grids that gears hang on.
        cuts: of all beams.
    """
    points = structure.points
    p = points.xyz @ R_AB.T
    p = p[:: max(1, len(p) // _DOTS)]
    at = points.xyz[points.rows(np.array(gears, np.int64))] @ R_AB.T
    cut = np.concatenate([np.zeros((0, 3)), *(c.point for c in cuts)]) @ R_AB.T
    size = float(np.ptp(p, axis=0).max(initial=1e-9))
    with panels(1, 2, height=3.0, shared=False) as (figure, grid):
        for axes, across, title in zip(grid[0], (1, 2), ("From above", "From port")):
            # Seen from above with the nose to the left, starboard is up on the page.
            axes.plot(p[:, 0], p[:, across], ".", color=FAINT, ms=1.6, label="grids")
            axes.plot(
                cut[:, 0], cut[:, across], ".", color=SERIES[0], ms=3.5,
                label="points that section loads refer to",
            )  # fmt: skip
            axes.plot(
                at[:, 0], at[:, across], "v", color=TRANSIENT, ms=5, label="gears"
            )
            _arrows(axes, R_AB, across, size)
            axes.set_aspect("equal", adjustable="datalim")
            axes.margins(0.12)
            axes.set_title(f"{title}, nose to the left")
            axes.set_xticks([])
            axes.set_yticks([])
            axes.grid(visible=False)
        legend(figure, grid[0][0])
        return svg(figure, "axes of the deck")


def _arrows(axes: Axes, R_AB: Float64, across: int, size: float) -> None:
    """The axes of B that lie in the page, from the origin of the deck."""
    words = axis_words(R_AB)
    for k, name in enumerate("xyz"):
        way = R_AB[[0, across], k]
        if not way.any():
            continue
        tip = 0.22 * size * way
        axes.annotate(
            "",
            xy=(tip[0], tip[1]),
            xytext=(0.0, 0.0),
            arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 1.6},
        )
        axes.annotate(
            f"{name} {words[name]}",
            xy=(1.12 * tip[0], 1.12 * tip[1]),
            color=INK,
            ha="center",
            va="center",
            weight="bold",
            size=8.5,
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1},
        )
        # Annotations do not widen a panel, data do.
        axes.plot(1.3 * tip[:1], 1.3 * tip[1:], linestyle="")
    axes.plot(0.0, 0.0, "o", color=INK, ms=4)
