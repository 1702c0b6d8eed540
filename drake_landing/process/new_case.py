"""A commented case for a deck, so that nobody starts from an empty file.

What the deck tells is filled in: units by the stiffness of its materials, axes by its
symmetry and its tail, mass, points worth monitoring, grids near where gears usually
are. Supports of the deck's own solution are left out. Gears have values of the right
size for the mass; each line that is a guess says so.
"""

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.deck_units import (
    METALS,
    material_moduli,
    span_and_sized,
    units_of_materials,
)
from drake_landing.airframe.free_flight import half_model
from drake_landing.airframe.load_shapes import load_model
from drake_landing.airframe.selection import expected_pulses
from drake_landing.airframe.supports import Supports, supports_of
from drake_landing.cache import Cache
from drake_landing.case.axes import rotation_AB
from drake_landing.case.deck_frame import Axes
from drake_landing.case.reading import parse_case
from drake_landing.case.schema import Case
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.transient.step_error import STEPS, step_error
from fem.arrays import Float64, Int64
from fem.deck.deck import Deck
from fem.deck.reader import read_deck
from fem.deck.units import SYSTEMS, in_si, units_of
from fem.errors import InputError, Problems, nearest
from fem.model.structure import Structure

_GRAVITY = 9.81  # m/s²
_NOSE_SHARE = 0.1  # of the weight
_STROKE, _STATIC = 0.35, 0.7  # m; share of the stroke at rest
_CANDIDATES = 4
_END, _MIDDLE = 0.2, 0.1  # of the length: nose and tail; of the width: the fuselage
_TAIL = 0.03  # of the length: by how much a tail is higher and wider than a nose
_AXES = ("x", "-x", "y", "-y", "z", "-z")


@dataclass(frozen=True, kw_only=True)
class Stated:
    """What the user says of the deck; None: to be guessed.

    Attributes:
        units: a name of `fem.deck.units.SYSTEMS`.
        forward, up: axes of the deck, such as `-x`; `+x` is `x`.
    """

    units: str | None = None
    forward: str | None = None
    up: str | None = None

    def __post_init__(self) -> None:
        for option in ("forward", "up"):
            axis = getattr(self, option)
            object.__setattr__(self, option, axis and axis.removeprefix("+"))

    def check(self) -> None:
        """Raises an InputError with all that cannot be meant."""
        problems = Problems()
        for option in ("forward", "up"):
            axis = getattr(self, option)
            if axis is not None and axis not in _AXES:
                problems.append(
                    f"--{option}: found {axis}, expected one of {', '.join(_AXES)}"
                )
        if self.units is not None and self.units not in SYSTEMS:
            problems.append(
                f"--units: found {self.units}, expected one of {', '.join(SYSTEMS)}"
                + nearest(self.units, list(SYSTEMS))
            )
        if self.forward and self.up and self.forward[-1] == self.up[-1]:
            problems.append(
                f"--up: found {self.up}, expected another axis than that of --forward "
                f"{self.forward}"
            )
        problems.report()


@dataclass(frozen=True)
class _Layout:
    """A deck as an aircraft: axes A are aft, starboard, up (m)."""

    axes: Axes
    ids: Int64
    p: Float64  # (g, 3) in A
    R_BA: Float64
    mass: float
    cg: Float64  # (3,) in A
    damped: bool
    middle: float  # height of the fuselage

    def nearest(self, target: Sequence[float], count: int = 1) -> list[int]:
        """Rows of the grids next to a point in A."""
        away = np.linalg.norm(self.p - np.asarray(target), axis=1)
        return np.argsort(away, kind="stable")[:count].tolist()


def new_case(deck: Path, case: Path, stated: Stated | None = None) -> str:
    """The text of a case for a deck.

    Args:
        deck: bulk-data file.
        case: the file that the text is for; the deck's path is relative to it.
        stated: what need not be guessed.

    Raises:
        InputError: the deck cannot be read, has no mass, or what is stated cannot be.
    """
    stated = stated or Stated()
    stated.check()
    raw = read_deck(deck)
    units = stated.units or guess_units(raw)
    structure = Structure.from_deck(in_si(raw, units_of(units)))
    _check_size(structure, units)
    layout, supports = _layout(structure, stated), supports_of(structure)
    text = "\n".join(_lines(deck, case, stated, units, layout, supports)) + "\n"
    return text + _transient(
        parse_case(text, file=str(case), folder=case.resolve().parent)
    )


def _check_size(structure: Structure, units: str) -> None:
    """Raises an InputError where nothing that lands has the size."""
    span, sized = span_and_sized(structure, units)
    if units in sized:
        return
    told = units_of_materials(structure.deck, units)
    materials = f"; its materials say {told}" if told and told != units else ""
    raise InputError(
        f"--units: found {units}, in which {structure.deck.path} spans {span:,.4g} m"
        f"{materials}; expected {' or '.join(sized) or 'the deck of an aircraft'}"
    )


def _transient(case: Case) -> str:
    """The step of the transient by what it is expected to cost; without modes."""
    try:
        with TemporaryDirectory() as folder:
            aircraft = prepare_aircraft(case, Path(folder))
            structure = aircraft.structure()
            shapes = load_model(structure, aircraft, Cache.of_user())
        pulses = expected_pulses(structure, case.airframe, aircraft, aircraft.scenario)
        points = list(aircraft.monitoring)
        found = step_error(shapes, pulses, points, case.transient.step)
    except InputError:  # check says what is wrong with deck or gears
        return ""
    step, why = found.enough, "keeps peak accelerations within 2 %"
    if step is None:
        step, why = STEPS[-1], f"{found}"
    return f"transient:\n  step: {step:.1e} # s; {why}, as expected for these gears\n"


def guess_units(deck: Deck) -> str:
    """By weight and materials (`units_of_materials`), else by the modulus that is
    nearest to a metal's; without any the largest extent of the grids decides: metres
    below 150.
    """
    if told := units_of_materials(deck):
        return told
    moduli = material_moduli(deck)
    if len(moduli):
        e = float(np.median(moduli))
        return min(METALS, key=lambda n: abs(np.log(e / METALS[n])))
    p = deck.cards["GRID"][["x1", "x2", "x3"]].to_numpy(float)
    return "SI" if np.ptp(p, axis=0).max() < 150.0 else "mm-t-N"


def _layout(structure: Structure, stated: Stated) -> _Layout:
    p, weight = structure.points.xyz, structure.rigid_mass
    if problems := half_model(p):
        raise InputError(f"{structure.deck.path}: {text}" for text in problems)
    if weight.total <= 0.0:
        raise InputError("the deck has no mass, expected that of an airframe")
    axes, b = _guessed_axes(p, stated), structure.damping
    R_BA = rotation_AB(axes).T
    p_A = p @ R_BA
    return _Layout(
        axes=axes,
        ids=structure.points.grid_id,
        p=p_A,
        R_BA=R_BA,
        mass=float(weight.total),
        cg=np.asarray(weight.center) @ R_BA,
        damped=bool(b.stiffness_factor or b.mass_factor or b.other is not None),
        middle=float(np.median(p_A[_near_middle(p_A[:, 1]), 2])),
    )


def _guessed_axes(p: Float64, stated: Stated) -> Axes:
    """Forward and up of grids (g, 3): as stated, else by symmetry and tail.

    The tail is the end that is higher and wider; its fin stands up from the fuselage.
    """
    taken = {axis[-1] for axis in (stated.forward, stated.up) if axis}
    lateral = _lateral(p, [a for a in range(3) if "xyz"[a] not in taken])
    rest = [a for a in range(3) if a != lateral]
    along, vertical = sorted(rest, key=lambda a: -float(np.ptp(p[:, a])))
    if "xyz"[vertical] == (stated.forward or " ")[-1] or (
        "xyz"[along] == (stated.up or " ")[-1]
    ):
        along, vertical = vertical, along
    length = float(np.ptp(p[:, along]))
    ends = _ends(p[:, along])
    before, behind = (np.ptp(p[end][:, [lateral, vertical]], axis=0) for end in ends)
    tail_ahead = bool(behind.sum() > before.sum())  # at the greater coordinate
    tailed = abs(behind.sum() - before.sum()) > _TAIL * length
    if stated.forward:
        tail_ahead, tailed = stated.forward.startswith("-"), True
    tail = p[ends[int(tail_ahead)], vertical]
    if not tailed or np.ptp(tail) < _TAIL * length:  # what stands out tells, then
        tail = p[:, vertical]
    height = tail - np.median(p[_near_middle(p[:, lateral]), vertical])
    up = stated.up or "-" * bool(-height.min() > height.max()) + "xyz"[vertical]
    if not tailed:
        height = -height if up.startswith("-") else height
        high = height >= 0.9 * height.max(initial=0.0)
        tail_ahead = bool(p[high, along].mean() >= p[:, along].mean())
    return Axes(forward=stated.forward or "-" * tail_ahead + "xyz"[along], up=up)


def _ends(x: Float64) -> tuple[npt.NDArray[np.bool_], npt.NDArray[np.bool_]]:
    """Which of some coordinates lie at the lower and at the upper end."""
    reach = _END * float(np.ptp(x))
    return x <= x.min() + reach, x >= x.max() - reach


def _near_middle(y: Float64) -> npt.NDArray[np.bool_]:
    """Which of some coordinates lie in the middle between the outermost; else all."""
    low, high = float(y.min()), float(y.max())
    near = np.abs(y - 0.5 * (low + high)) <= _MIDDLE * (high - low)
    return near if near.any() else np.ones(len(y), bool)


def _lateral(p: Float64, among: Sequence[int]) -> int:
    """The axis across which the grids are most nearly their own mirror image."""
    spread = np.ptp(p, axis=0)
    skewed = np.abs(p.max(axis=0) + p.min(axis=0)) / np.maximum(spread, 1e-9)
    skewed += 10.0 * (spread < 1e-3 * spread.max())
    return min(among, key=lambda a: skewed[a])


def _lines(
    deck: Path,
    case: Path,
    stated: Stated,
    units: str,
    a: _Layout,
    supports: Supports | None,
) -> Iterator[str]:
    folder = case.resolve().parent
    shown = os.path.relpath(deck.resolve(), folder)
    name = "".join(c if c.isalnum() else "_" for c in deck.stem.lower()).strip("_")
    x, y, z = _in_B(a, a.cg)
    yield f"# A landing of {deck.name}: {a.mass:,.0f} kg without gears, its"
    yield f"# center of gravity at x {x:z.3f}, y {y:z.3f}, z {z:z.3f} m. All is SI,"
    yield "# in the frame of the deck. Replace or confirm what is marked GUESS."
    yield "# Next: drake-landing check on this file says what fits and what does not;"
    yield "# docs/gears.md describes gears, docs/conditions.md the conditions of CS-25."
    yield f"name: {name or 'landing'}"
    yield "airframe:"
    yield f"  deck: {shown!r}"
    guess = "" if stated.units else "GUESS by its materials, else new --units: "
    yield f"  units: {units} # {guess}SI, mm-t-N or in-lbf"
    if supports:
        cards = ", ".join(supports.cards)
        yield f"  # An aircraft flies freely, but {supports.story}."
        yield f"  ignore: [{cards}]" if cards else "  # Take it out of the deck."
    known = stated.forward and stated.up
    guess = "" if known else " # GUESS by symmetry and tail, else new --forward, --up"
    yield f"  axes: {{ forward: {a.axes.forward}, up: {a.axes.up} }}{guess}"
    if not a.damped:
        yield "  damping: { ratio: { 3: 0.01, 30: 0.03 } } # GUESS: the deck has none"
    yield "  select: below 50 Hz # modes of the multibody model"
    yield "  monitoring: # points whose accelerations are compared: name and grid"
    for point, row in _points(a).items():
        yield f"    {point}: {a.ids[row]} # {_at(a, row)}"
    yield "scenario:"
    yield "  sink_rate: 3.05 # m/s; or a preset (docs/conditions.md)"
    yield "  forward_speed: 70 # m/s, GUESS"
    yield "# Gears have the size for this mass, not that of this aircraft's, and lie"
    yield "# where units and axes put them: where these are wrong, write the case anew"
    yield "# with the options --units, --forward and --up."
    yield "gears: # GUESS throughout"
    yield from _gears(a)


def _points(a: _Layout) -> dict[str, int]:
    """Point -> row: extremities and the grid next to the center of gravity."""
    found = {
        "nose": int(a.p[:, 0].argmin()),
        "center": a.nearest(a.cg)[0],
        "tail": int(a.p[:, 0].argmax()),
        "tip_starboard": int(a.p[:, 1].argmax()),
        "tip_port": int(a.p[:, 1].argmin()),
    }
    first: dict[int, str] = {}
    for name, row in found.items():
        first.setdefault(row, name)
    return {name: row for row, name in first.items()}


def _gears(a: _Layout) -> Iterator[str]:
    """Nose gear ahead of, main gears a little behind the center of gravity."""
    length = float(np.ptp(a.p[:, 0]))
    half = float(a.p[:, 1].max())
    nose_x = a.cg[0] - min(0.35 * length, 0.8 * (a.cg[0] - a.p[:, 0].min()))
    ahead = a.cg[0] - nose_x
    main_x = a.cg[0] + ahead * _NOSE_SHARE / (1.0 - _NOSE_SHARE)
    ground = a.p[:, 2].min() - 1.0 if len(a.p) else 0.0
    track = min(0.18 * half, 0.25 * length)
    weight = a.mass * _GRAVITY
    places = {
        "nose": ((nose_x, 0.0), _NOSE_SHARE * weight),
        "main_starboard": ((main_x, track), 0.5 * (1.0 - _NOSE_SHARE) * weight),
        "main_port": ((main_x, -track), 0.5 * (1.0 - _NOSE_SHARE) * weight),
    }
    for name, ((x, y), load) in places.items():
        rows = a.nearest((x, y, a.middle), _CANDIDATES)
        others = ", ".join(f"{a.ids[r]} ({_at(a, r)})" for r in rows[1:])
        yield f"  - name: {name}"
        yield f"    attachment_node: {a.ids[rows[0]]} # {_at(a, rows[0])}"
        yield f"    # other grids nearby: {others}"
        yield from _gear(a, a.p[rows[0]], x, ground, load)


def _gear(
    a: _Layout, node: Float64, x: float, ground: float, load: float
) -> Iterator[str]:
    """A telescopic twin for a static load (N), its axle at x whatever its node."""
    radius = float(np.clip(0.20 * (load / 1e4) ** 0.33, 0.15, 0.6))
    axle = np.array([x, node[1], ground + radius])
    gap = node[2] - axle[2]
    mass = 0.006 * load  # kg: gears weigh some 4 % of what they carry (from memory)
    fitting, piston, wheel = 0.4 * mass, 0.25 * mass, 0.12 * mass
    inertia = [
        round(0.05 * m * max(gap, 0.3) ** 2 + 0.01, 3) for m in (fitting, piston)
    ]
    rest = 1.0 - _STATIC * _STROKE / (_STROKE * 1.15)
    offset = round(0.35 * radius, 3)
    yield f"    axle: {_vector(a, axle)} # m, gear extended"
    yield f"    wheel_offsets: [{-offset}, {offset}] # m from the middle of the axle"
    for part, m, share, i in (
        ("fitting", fitting, 0.7, inertia[0]),
        ("piston", piston, 0.2, inertia[1]),
    ):
        at = axle + np.array([0.0, 0.0, share * gap])
        cg, j = _vector(a, at), f"[{i}, {i}, {i}] }} # kg, m, kg m²"
        yield f"    {part}: {{ mass: {_number(m)}, cg: {cg}, inertia: {j}"
    m, spin = _number(wheel), _number(0.5 * wheel * radius**2)
    yield f"    wheel: {{ mass: {m}, spin_inertia: {spin} }} # kg, kg m²"
    stiffness = _number(0.5 * load / (0.2 * radius))
    precharge = _number(load * rest**1.4)
    yield f"    tyre: {{ radius: {radius:.3f}, stiffness: {stiffness} }} # m, N/m"
    yield "    shock_absorber:"
    yield f"      stroke: {_STROKE} # m"
    yield f"      gas_length: {_STROKE * 1.15:.4g} # m"
    yield f"      precharge_force: {precharge} # N; {load:,.0f} N at rest"
    yield f"      compression_damping: {_number(0.12 * load)} # N s²/m²"
    yield f"      rebound_damping: {_number(0.6 * load)} # N s²/m²"


def _in_B(a: _Layout, p: Float64) -> Float64:
    return a.R_BA @ p


def _at(a: _Layout, row: int) -> str:
    x, y, z = _in_B(a, a.p[row])
    return f"at {x:z.2f}, {y:z.2f}, {z:z.2f} m"


def _vector(a: _Layout, p: Float64) -> str:
    return "[" + ", ".join(f"{v:z.3f}" for v in _in_B(a, p)) + "]"


def _number(value: float) -> str:
    """Four digits, without the exponents that YAML takes for text."""
    return f"{value:.4g}" if 1e-4 < value < 1e4 else f"{value:.0f}"
