"""Pictures of the loads on the gears: three views of the aircraft, loads as arrows."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from drake_landing.airframe.skeleton import Skeleton
from drake_landing.conditions.balance import RigidBalance
from drake_landing.conditions.build import OnGround
from drake_landing.conditions.ground import BookCase
from drake_landing.conditions.poses import Posed
from drake_landing.conditions.statics import point
from fem.arrays import Float64
from fem.files.atomic import written_aside

# Views: what is drawn to the right and upward, components of G and their sign.
_VIEWS = (("from port", 0, 2), ("from ahead", 1, 2), ("from above", 0, 1))
_LONGEST = 0.45  # of the aircraft's wheelbase, the largest load's arrow


def load_pictures(
    balances: Sequence[RigidBalance],
    ground: OnGround,
    folder: Path,
    airframe: Skeleton | None = None,
) -> list[Path]:
    """One picture a paragraph, its cases below each other; PNG files.

    Args:
        balances: of all cases.
        ground: the aircraft.
        folder: made where it is not there.
        airframe: A, drawn behind the loads; None: gears alone.
    """
    import matplotlib.pyplot as plt

    folder.mkdir(parents=True, exist_ok=True)
    by_paragraph: dict[str, list[BookCase]] = {}
    for balance in balances:
        by_paragraph.setdefault(balance.case.paragraph, []).append(balance.case)
    written = []
    for paragraph, cases in by_paragraph.items():
        shown = cases[:4]
        figure, axes = plt.subplots(
            len(shown), 3, figsize=(11, 2.6 * len(shown)), squeeze=False
        )
        for row, case in zip(axes, shown):
            _case(row, case, ground, airframe)
        more = f" ({len(cases) - len(shown)} more)" * (len(cases) > len(shown))
        figure.suptitle(f"{paragraph}{more}", fontsize=11)
        figure.tight_layout()
        name = "".join(c if c.isalnum() else "_" for c in paragraph).strip("_")
        path = folder / f"{name}.png"
        try:
            with written_aside(path) as part:
                figure.savefig(part, dpi=110)
        finally:
            plt.close(figure)
        written.append(path)
    return written


def _outline(airframe: Skeleton, posed: Posed) -> Float64:
    """(e, 2, 3) lines of the airframe in a pose, G, from the centre of gravity."""
    p = (airframe.p - posed.whole.center) @ posed.R_AG
    return p[airframe.edges]


def _case(axes, case: BookCase, ground: OnGround, airframe: Skeleton | None) -> None:
    from matplotlib.collections import LineCollection

    posed = ground.poses[case.pose]
    places = posed.places
    lines = None if airframe is None else _outline(airframe, posed)
    size = _size(ground)
    largest = max(float(np.linalg.norm(one.force)) for one in case.loads)
    for axis, (view, right, up) in zip(axes, _VIEWS):
        if lines is not None:
            drawn = LineCollection(
                list(lines[:, :, [right, up]]), colors="0.7", linewidths=0.6, zorder=0
            )
            axis.add_collection(drawn)
        axis.plot(0.0, 0.0, "k+", ms=10)
        for name, place in places.items():
            ends = np.array([place.ground, place.axle])
            axis.plot(ends[:, right], ends[:, up], "-", color="0.6", lw=4)
            axis.plot(*place.axle[[right, up]], "o", color="0.4", ms=5)
            if view == "from above":
                axis.annotate(name, place.ground[[right, up]], fontsize=6, color="0.4")
        for one in case.loads:
            start = point(places[one.gear], one.at)
            if view == "from above" and abs(one.moment[2]) > 1.0:
                axis.annotate(
                    f"{one.moment[2] / 1e3:+.1f} kN m about up",
                    start[[right, up]],
                    xytext=(4, -9),
                    textcoords="offset points",
                    fontsize=6,
                    color="tab:red",
                )
            arrow = one.force / max(largest, 1e-9) * _LONGEST * size
            if np.linalg.norm(arrow[[right, up]]) < 1e-3 * size:
                continue
            tip = start[[right, up]] + arrow[[right, up]]
            axis.annotate(
                "",
                tip,
                start[[right, up]],
                arrowprops={"arrowstyle": "-|>", "color": "tab:red", "lw": 1.4},
            )
            axis.plot(*tip, alpha=0.0)
            if view == "from ahead":
                label = f"{np.linalg.norm(one.force) / 1e3:.0f} kN"
                axis.annotate(label, tip, fontsize=7, color="tab:red")
        axis.set_aspect("equal", adjustable="datalim")
        axis.margins(0.15)
        axis.set_xlabel(f"{'aft' if right == 0 else 'starboard'}, m", fontsize=7)
        axis.set_ylabel(f"{'up' if up == 2 else 'starboard'}, m", fontsize=7)
        axis.tick_params(labelsize=6)
    axes[0].set_title(case.name, fontsize=8, loc="left")


def _size(ground: OnGround) -> float:
    """Largest distance between gears, m."""
    p = np.array([place.ground for place in ground.poses["static"].places.values()])
    return float(np.ptp(p, axis=0).max()) or 1.0
