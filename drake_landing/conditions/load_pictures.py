"""Pictures of the loads on the gears: three views of the aircraft, loads as arrows.

A component of a load is an arrow of its own, with its number beside its tail; the tip
is where it acts. A moment is drawn in the view along its axis.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from drake_landing.airframe.skeleton import Skeleton
from drake_landing.conditions.balance import RigidBalance
from drake_landing.conditions.build import OnGround
from drake_landing.conditions.ground import BookCase, GearLoad
from drake_landing.conditions.mirror import without_mirror_images
from drake_landing.conditions.poses import Posed
from drake_landing.conditions.statics import point
from fem.arrays import Float64
from fem.files.atomic import written_aside


@dataclass(frozen=True, kw_only=True)
class View:
    """Components of G drawn to the right and upward; `out` of the paper, with sign."""

    name: str
    right: int
    up: int
    out: int
    sign: float


_VIEWS = (
    View(name="from port", right=0, up=2, out=1, sign=-1.0),
    View(name="from behind", right=1, up=2, out=0, sign=1.0),
    View(name="from above", right=0, up=1, out=2, sign=1.0),
)
_AXES, _LETTERS = ("aft", "starboard", "up"), "DSV"
_LONGEST = 0.45  # of the aircraft's wheelbase, the largest load's arrow
_LEAST = 1e-3  # of the largest load: below, nothing is drawn
_TOGETHER = 0.01  # of the wheelbase: loads at one place in a view
_PER_PAGE = 5
_COLORS = {"ground": "tab:red", "tow": "tab:blue", "jack": "tab:purple"}
_HELD, _OTHER = "tab:green", "tab:orange"


def load_pictures(
    balances: Sequence[RigidBalance],
    ground: OnGround,
    folder: Path,
    airframe: Skeleton | None = None,
) -> list[Path]:
    """Pictures of each paragraph, a case a row, further pages `_2`; PNG files.

    Of cases that are mirror images one is drawn, which names the others.

    Args:
        balances: of all cases.
        ground: the aircraft.
        folder: made where it is not there.
        airframe: A, drawn behind the loads; None: gears alone.
    """
    folder.mkdir(parents=True, exist_ok=True)
    by_paragraph: dict[str, list[tuple[int, BookCase]]] = {}
    for number, balance in enumerate(balances, 1):
        of = by_paragraph.setdefault(balance.case.paragraph, [])
        of.append((number, balance.case))
    written = []
    for paragraph, cases in by_paragraph.items():
        drawn = list(without_mirror_images(cases, ground.aircraft.poses))
        pages = [drawn[k : k + _PER_PAGE] for k in range(0, len(drawn), _PER_PAGE)]
        stem = "".join(c if c.isalnum() else "_" for c in paragraph).strip("_")
        for page, shown in enumerate(pages, 1):
            title = paragraph + f" ({page} of {len(pages)})" * (len(pages) > 1)
            path = folder / f"{stem}{f'_{page}' * (page > 1)}.png"
            _page(path, title, shown, ground, airframe)
            written.append(path)
    return written


def _page(
    path: Path,
    title: str,
    shown: Sequence[tuple[str, BookCase]],
    ground: OnGround,
    airframe: Skeleton | None,
) -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from drake_landing.drawing_style import plain_style

    height = 2.7 * len(shown) + 0.9
    with plain_style():
        figure = Figure(figsize=(12, height))
        canvas = FigureCanvasAgg(figure)
        axes = figure.subplots(len(shown), len(_VIEWS), squeeze=False)
        kinds: dict[str, str] = {}
        texts = []
        for row, (name, case) in zip(axes, shown):
            texts += _case(row, name, case, ground, airframe)
            kinds |= {one.what or "ground": _color(one) for one in case.loads}
        figure.suptitle(title, fontsize=11, y=1.0 - 0.1 / height, va="top")
        _legend(figure, kinds)
        figure.subplots_adjust(
            left=0.045,
            right=0.99,
            bottom=0.95 / height,
            top=1.0 - 0.55 / height,
            wspace=0.16,
            hspace=0.35,
        )
        for axis, of_axis in zip(axes.flat, texts, strict=True):
            axis.apply_aspect()
            _apart(of_axis, canvas.get_renderer())
        with written_aside(path) as part:
            figure.savefig(part, dpi=110)


def _legend(figure, kinds: dict[str, str]) -> None:
    from matplotlib.lines import Line2D

    marks = [
        Line2D([], [], color="k", marker="+", ls="", label="center of gravity"),
        Line2D([], [], color="0.4", marker="o", ms=5, ls="", label="axle"),
        Line2D([], [], color="0.6", lw=4, label="axle to ground"),
    ]
    marks += [Line2D([], [], color=c, label=what) for what, c in kinds.items()]
    figure.legend(
        handles=marks,
        loc="lower center",
        ncols=len(marks),
        fontsize=7,
        title="D drag, S side, V vertical: kN; M moment about the axis of the view: "
        "kN m; tips of arrows where the loads act, lengths to one scale in a case",
        title_fontsize=7,
        frameon=False,
    )


def _color(one: GearLoad) -> str:
    if "against" in one.what:
        return _HELD
    return _COLORS.get(one.what or "ground", _OTHER)


def _outline(airframe: Skeleton, posed: Posed) -> Float64:
    """(e, 2, 3) lines of the airframe in a pose, G, from the center of gravity."""
    p = (airframe.p - posed.whole.center) @ posed.R_AG
    return p[airframe.edges]


def _case(
    axes, name: str, case: BookCase, ground: OnGround, airframe: Skeleton | None
) -> list[list]:
    """Draws a row; the texts of each view, those that stay where they are first."""
    from matplotlib.collections import LineCollection

    posed = ground.poses[case.pose]
    lines = None if airframe is None else _outline(airframe, posed)
    size = _size(ground)
    texts = []
    for axis, view in zip(axes, _VIEWS):
        across = [view.right, view.up]
        if lines is not None:
            drawn = LineCollection(
                list(lines[:, :, across]), colors="0.75", linewidths=0.5, zorder=0
            )
            axis.add_collection(drawn, autolim=False)  # the gears fill the view
        axis.plot(0.0, 0.0, "k+", ms=10)
        for place in posed.places.values():
            ends = np.array([place.ground, place.axle])
            axis.plot(ends[:, view.right], ends[:, view.up], "-", color="0.6", lw=4)
            axis.plot(*place.axle[across], "o", color="0.4", ms=5)
            around = place.axle[across] + 0.18 * size * np.array([[-1, -1], [1, 1]])
            axis.plot(*around.T, alpha=0.0)  # room for names and turns
        own = [_arrow(axis, arrow, size) for arrow in _arrows(case, posed, view, size)]
        own += [_turn(axis, turn) for turn in _turns(case, posed, view, size)]
        if view.name == "from above":
            own += [_gear_name(axis, n, p.ground[:2]) for n, p in posed.places.items()]
        texts.append(own)
        axis.set_aspect("equal", adjustable="datalim")
        axis.margins(0.08)
        axis.locator_params(nbins=6)
        axis.set_xlabel(f"{_AXES[view.right]}, m ({view.name})", fontsize=7)
        axis.set_ylabel(f"{_AXES[view.up]}, m", fontsize=7)
        axis.tick_params(labelsize=6)
    axes[0].set_title(name, fontsize=8, loc="left")
    return texts


@dataclass(frozen=True, kw_only=True, eq=False)
class Drawn:
    """An arrow, or a turn, of one or several loads that a view shows at one place.

    Attributes:
        at: (2,) where it acts.
        arrow: (2,) of the load, m; of a turn its sense, counter-clockwise positive.
        text: kind and number.
        color: of the kind.
    """

    at: Float64
    arrow: Float64
    text: str
    color: str


def _arrows(case: BookCase, posed: Posed, view: View, size: float) -> Iterator[Drawn]:
    """Components of the forces in a view, loads behind each other as one arrow."""
    largest = max(float(np.abs(one.force).max()) for one in case.loads)
    for k, component in enumerate((view.right, view.up)):
        groups = _groups(case, posed, view, size, "force", component, largest)
        for at, values, color in groups:
            arrow = np.zeros(2)
            arrow[k] = max(values, key=abs) / max(largest, 1e-9) * _LONGEST * size
            text = f"{_LETTERS[component]} {_numbers(values)}"
            yield Drawn(at=at, arrow=arrow, text=text, color=color)


def _turns(case: BookCase, posed: Posed, view: View, size: float) -> Iterator[Drawn]:
    """Moments about the axis of a view."""
    largest = max(float(np.abs(one.moment).max()) for one in case.loads)
    groups = _groups(case, posed, view, size, "moment", view.out, largest)
    for at, values, color in groups:
        sense = np.array([np.sign(values[0]) * view.sign, 0.0]) * 0.07 * size
        yield Drawn(at=at, arrow=sense, text=f"M {_numbers(values)}", color=color)


def _groups(
    case: BookCase,
    posed: Posed,
    view: View,
    size: float,
    of: str,
    component: int,
    largest: float,
) -> list[tuple[Float64, list[float], str]]:
    """Place, values and color of loads that coincide in a view and have one sense."""
    groups: list[tuple[Float64, list[float], str]] = []
    for one in case.loads:
        value = float(getattr(one, of)[component])
        if abs(value) <= max(_LEAST * largest, 1.0):
            continue
        at = point(posed.places[one.gear], one.at)[[view.right, view.up]]
        for place, values, color in groups:
            near = np.linalg.norm(place - at) < _TOGETHER * size
            if near and color == _color(one) and values[0] * value > 0.0:
                values.append(value)
                break
        else:
            groups.append((at, [value], _color(one)))
    return groups


def _numbers(values: Sequence[float]) -> str:
    """In thousands; equal ones as a multiple."""
    told = [
        f"{abs(v) / 1e3:.3g}" if abs(v) < 1e5 else f"{abs(v) / 1e3:.0f}" for v in values
    ]
    if len(set(told)) == 1 and len(told) > 1:
        return f"{len(told)} x {told[0]}"
    return " and ".join(told)


def _line(axis, tail: Float64, tip: Float64, color: str, bend: float = 0.0) -> None:
    """A line with a head, straight or an arc."""
    axis.annotate(
        "",
        tip,
        tail,
        arrowprops={
            "arrowstyle": "-|>",
            "color": color,
            "lw": 1.4,
            "mutation_scale": 8,
            "shrinkA": 0,
            "shrinkB": 0,
            "connectionstyle": f"arc3,rad={bend}",
        },
        zorder=5,
    )


def _arrow(axis, drawn: Drawn, size: float):
    """Its tip where the load acts; the text at its tail."""
    tail = drawn.at - drawn.arrow
    _line(axis, tail, drawn.at, drawn.color)
    x, y = np.sign(drawn.arrow)
    beyond = tail - size * np.array([0.16 * x, 0.05 * y])
    axis.plot(*beyond, alpha=0.0)  # room for the text
    return axis.annotate(
        drawn.text,
        tail,
        xytext=(-3 * x, -3 * y),
        textcoords="offset points",
        ha={1.0: "right", -1.0: "left"}.get(x, "center"),
        va={1.0: "top", -1.0: "bottom"}.get(y, "center"),
        fontsize=7,
        color=drawn.color,
        zorder=6,
    )


def _turn(axis, drawn: Drawn):
    """A curved arrow round the point, its text above."""
    radius = abs(drawn.arrow[0])
    start, end = (
        drawn.at + radius * np.array([np.cos(a), np.sin(a)])
        for a in np.radians([-60.0, 150.0])
    )
    if drawn.arrow[0] < 0.0:
        start, end = end, start
    _line(axis, start, end, drawn.color, bend=0.7 * float(np.sign(drawn.arrow[0])))
    return axis.annotate(
        drawn.text,
        drawn.at + np.array([0.0, radius]),
        xytext=(0, 5),
        textcoords="offset points",
        ha="center",
        va="bottom",
        fontsize=7,
        color=drawn.color,
        zorder=6,
    )


def _gear_name(axis, name: str, at: Float64):
    return axis.annotate(
        name,
        at,
        xytext=(5, 5),
        textcoords="offset points",
        fontsize=6,
        color="0.3",
        zorder=6,
    )


def _apart(texts: Sequence, renderer) -> None:
    """Moves texts that cover each other up or down by as little as it takes."""
    taken: list = []
    for text in texts:
        box = text.get_window_extent(renderer)
        step = box.height
        for k in (0, 1, -1, 2, -2, 3, -3, 4, -4):
            moved = box.translated(0.0, k * step)
            if not any(moved.overlaps(other) for other in taken):
                break
        x, y = text.get_position()
        text.set_position((x, y + k * step * 72.0 / text.figure.dpi))
        taken.append(moved)


def _size(ground: OnGround) -> float:
    """Largest distance between gears, m."""
    p = np.array([place.ground for place in ground.poses["static"].places.values()])
    return float(np.ptp(p, axis=0).max()) or 1.0
