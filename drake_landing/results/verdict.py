"""What a run says in a few lines: landed, trust, loads, margins, what to look at."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from drake_landing.airframe.truncation import WANTED
from drake_landing.parts.tables import component_table
from drake_landing.results.truncation import point_errors
from drake_landing.results.whole_mass import whole_mass
from drake_landing.transient.step_error import WARNED
from fem.arrays import Float64
from fem.model.differential import COARSE

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult

_FAIR = 0.15  # error above which a model is not called fair any more
_BALANCE = 0.01  # of the sink energy
_SHOWN = 3
_ALIKE = 0.01  # of the largest: loads of mirror images


def verdict(result: "ProcessResult") -> list[tuple[str, str]]:
    """What, and the sentence on it."""
    return [
        ("landed", _landed(result)),
        ("trust", _trust(result)),
        ("gear loads", _gear_loads(result)),
        *_sections(result),
        *_stresses(result),
        *_buckling(result),
        ("to look at", "; ".join(_to_look_at(result)) or "nothing stands out"),
    ]


def _landed(result: "ProcessResult") -> str:
    whole = whole_mass(result.airframe, result.aircraft.gears)
    x, y, z = whole.cg
    scenario = result.aircraft.scenario
    return (
        f"load case '{result.case.name}': {scenario.story}; {scenario.lift_story}; "
        f"{whole.mass:,.0f} kg with gears, center of gravity at x {x:z.3f}, y "
        f"{y:z.3f}, z {z:z.3f} m of the deck"
    )


def _trust(result: "ProcessResult") -> str:
    errors, gears = point_errors(result), result.truncation.gears
    load = max(gears.values(), default=0.0)
    point = max(errors, key=errors.__getitem__, default="")
    off = errors.get(point, 0.0)
    return (
        f"gear loads {_grade(load)} (modes left out: {_share(load)}); section loads "
        "and stresses come from the full model under these loads, "
        f"{_grade(max(load, result.step.error))} (time step: "
        f"{_share(result.step.error)} of the peak accelerations expected); "
        f"accelerations of the multibody model alone {_grade(off)} (against the full "
        f"model {_share(off)} rms, all axes together, at the worst point, "
        f"{point.replace('_', ' ')})"
    )


def _grade(error: float) -> str:
    """Good up to 5 %, fair up to 15 %."""
    return "good" if error <= WANTED else "fair" if error <= _FAIR else "poor"


def _share(error: float) -> str:
    return f"{error:.1%}" if error <= 1.0 else "more than 100 %"


def _gear_loads(result: "ProcessResult") -> str:
    """Peaks of each gear's tires."""
    strokes = {g.name: g.shock_absorber.stroke for g in result.aircraft.gears}
    said = []
    for gear, own in result.gears.groupby("gear", sort=False):
        peaks = own.set_index("quantity").peak
        if "tyre_vertical" not in peaks:
            continue
        name = str(gear).replace("_", " ")
        if not peaks["tyre_vertical"]:
            said.append(f"{name} never on the ground")
            continue
        said.append(
            f"{name} {peaks['tyre_vertical'] / 1e3:z.1f} kN vertical, "
            f"{peaks['tyre_drag'] / 1e3:z.1f} kN drag, {peaks['stroke']:.3f} of "
            f"{strokes[str(gear)]:.3f} m stroke"
        )
    return "; ".join(said) + " (peaks of the tires, runway axes)"


def _sections(result: "ProcessResult") -> Iterator[tuple[str, str]]:
    """Largest bending of the parts that carry most, over time and all cuts."""
    found = result.parts
    rows = []
    for name, cuts in found.cuts.items():
        bending = cuts.named(found.landing.sections[name])[:, :, 1]
        k, at = np.unravel_index(np.argmax(np.abs(bending)), bending.shape)
        value = bending[k, at]
        place = f"{cuts.beam.axis} = {cuts.beam.stations[at]:z.2f} m"
        if not any(mirrored(bending, other) for *_, other in rows):
            rows.append((abs(value), name, place, value, found.time[k], bending))
    rows.sort(key=lambda row: -row[0])
    said = [
        f"{name if place in name else f'{name}, cut at {place}'}: {value / 1e3:z.1f} "
        f"kN m ({time:.3f} s)"
        for _, name, place, value, time, _ in rows[:_SHOWN]
    ]
    if said:
        text = (
            f"{'; '.join(said)}; the largest of all cuts, mirror images once; about "
            "the points under 'Section loads', increments to steady flight"
        )
        yield "largest bending", text


def mirrored(a: Float64, b: Float64) -> bool:
    """Whether loads (t, ...) of two parts are so alike that one is shown for both."""
    return a.shape == b.shape and bool(
        np.abs(np.abs(a) - np.abs(b)).max() <= _ALIKE * np.abs(b).max()
    )


def _buckling(result: "ProcessResult") -> Iterator[tuple[str, str]]:
    """The panel that buckles first, where that was asked for."""
    buckled = result.buckled
    if buckled is None:
        return
    if buckled.table.empty:
        yield "buckling", "no panel of the mesh buckles in the static cases"
        return
    first = buckled.table.iloc[0]
    coarse = first["elements"] < COARSE
    mesh = "; its half wave is coarser than the mesh can show" if coarse else ""
    yield (
        "buckling",
        f"smallest load factor {first.factor:.3g}: {first.component}, element "
        f"{first['id']}, in the static case at {first.time:.3f} s ({first.reason})"
        f"{mesh}",
    )


def _stresses(result: "ProcessResult") -> Iterator[tuple[str, str]]:
    """Smallest margins; largest stresses where no allowable is known."""
    parts, factor = result.parts, result.case.parts.ultimate_factor
    table = component_table(parts.judged, factor)
    increments = parts.total is None
    of = "increments to steady flight" if increments else "steady flight included"
    if table.empty:
        text = "none: no element has stress recovery points; see the section loads"
        yield "stresses", text
        return
    known = table[table.margin.notna()].sort_values("margin")
    if len(known):
        said = [
            f"{row.margin:+.2f} {_element(row)}" for row in known[:_SHOWN].itertuples()
        ]
        yield (
            "smallest margins",
            f"{'; '.join(said)}; allowable over {factor:g} times the stress, less 1; "
            f"load case '{result.case.name}', {of}",
        )
        return
    worst = table.sort_values("equivalent", ascending=False)
    said = [_element(row) for row in worst[:_SHOWN].itertuples()]
    yield (
        "largest stresses",
        f"{'; '.join(said)}; load case '{result.case.name}', {of}; no allowable is "
        "known (ST of MAT1, parts.allowables), hence no margin",
    )


def _element(row) -> str:
    return (
        f"{row.component}, element {row.id}: {row.equivalent / 1e6:.1f} MPa at "
        f"{row.time:.3f} s"
    )


def _to_look_at(result: "ProcessResult") -> Iterator[str]:
    judged = component_table(result.parts.judged, result.case.parts.ultimate_factor)
    negative = judged[judged.margin < 0.0]
    if len(negative):
        yield f"negative margins in {', '.join(negative.component)}"
    errors = [*point_errors(result).values(), *result.truncation.gears.values()]
    if max(errors, default=0.0) > WANTED:
        yield "modes left out: see 'How far the numbers carry'"
    if result.step.error > WARNED:
        yield "the time step of the transient"
    if len(result.late):
        count = len(result.late)
        yield f"{count} extremes in the last swing: a longer run may find more"
    yield from _after_the_ground(result)
    missed = result.history.energy["balance"].abs().max()
    if missed > _BALANCE * result.history.figures["sink_energy"]:
        yield f"the energy audit misses {missed / 1e3:.1f} kJ"
    bars = int(result.parts.judged.axial_only.sum())
    if bars:
        yield f"{bars} bars without stress recovery points: see the section loads"
    if result.notices:
        count = len(result.notices)
        yield f"{count} notice{'s' * (count > 1)} at the end"


def _after_the_ground(result: "ProcessResult") -> Iterator[str]:
    """Whether the highest acceleration comes when all tires have left the runway."""
    history, table = result.history, result.comparison
    loads = [history.leg(gear, "vertical") for gear in history.strut]
    last = max(
        (float(f.index[f > 0.0].max()) for f in loads if f.max() > 0.0), default=0.0
    )
    highest = table.loc[table["peak_fe"].idxmax()]
    point, axis = str(highest["point"]), str(highest["axis"])
    at = float(result.response[point][axis].abs().idxmax())
    if not at > last > 0.0:
        return
    strokes = [table["stroke"].loc[last:at] for table in history.strut.values()]
    struck = any(s.max() > 0.0 >= s.min() for s in strokes if len(s))
    yield (
        f"the highest acceleration comes at {at:.3f} s, when no tire is on the runway "
        f"any more (since {last:.3f} s)"
        + ": shock absorbers strike their extension stops"
        * struck
    )
