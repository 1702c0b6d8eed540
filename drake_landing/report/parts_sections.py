"""The part of the report on what the parts see."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from drake_landing.case.axes import deck_axes
from drake_landing.parts import tables
from drake_landing.parts.buckling import BuckledPanels, with_margin
from drake_landing.report import parts_figures as figures
from drake_landing.report.page import Block, Section, png_block, table_block
from drake_landing.report.section_loads import monitor_points, section_loads
from drake_landing.results.comparison import shock_response_spectrum
from drake_landing.transient.practices import HYBRID, RIGID, STATIC, Practices
from fem.arrays import Float64
from fem.model.differential import COARSE

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult

SPECTRUM_HZ = np.geomspace(2.0, 200.0, 120)
Picture = tuple[Path, str]

_COMPONENT = {
    "component": "component",
    "elements": "elements",
    "id": "worst element",
    "equivalent": "equivalent MPa",
    "increment": "landing alone MPa",
    "largest": "largest MPa",
    "smallest": "smallest MPa",
    "time": "time s",
    "x": "at x m",
    "y": "y m",
    "z": "z m",
    "allowed": "allowable MPa",
    "margin": "margin",
}
_FORMATS = {
    **dict.fromkeys(("equivalent", "increment", "largest", "smallest"), ".1f"),
    **dict.fromkeys(("x", "y", "z"), ".2f"),
    **{"time": ".3f", "allowed": ".0f", "margin": "+.2f"},
}
_NOUGHT = 1e-6  # of the largest: by symmetry, but for rounding


def parts_sections(
    result: "ProcessResult",
    pictures: Sequence[Picture],
    unable: str,
    buckling: Sequence[Picture] = (),
) -> Iterator[Section]:
    """The sections in their order.

    Args:
        result: of the run.
        pictures: PNG files and what they show.
        unable: why there are none.
        buckling: pictures of the mode that buckles first.
    """
    yield section_loads(result)
    if result.parts.stations:
        yield monitor_points(result)
    yield _stresses(result, pictures, unable)
    if result.buckled is not None:
        yield _buckling(result, result.buckled, buckling)
    if result.parts.places.panels:
        yield _panels(result)
    yield _equipment(result)
    if result.practices is not None:
        yield _practices(result.practices)


def _stresses(
    result: "ProcessResult", pictures: Sequence[Picture], unable: str
) -> Section:
    factor, total = result.case.parts.ultimate_factor, result.parts.total
    stress = result.parts.judged
    components = tables.component_table(stress, factor)
    landing = result.parts.landing.stress
    alone = landing[~landing.axial_only].groupby("component").equivalent.max()
    components["increment"] = alone.loc[components.component].to_numpy()
    axial = tables.axial_elements(stress)
    worst = tables.worst_elements(stress, factor)
    blocks = [png_block(path, caption) for path, caption in pictures]
    unknown = {"increment"} if total is None else set()
    unknown |= {"allowed", "margin"} if components.margin.isna().all() else set()
    heads = {k: v for k, v in _COMPONENT.items() if k not in unknown}
    if len(components):
        blocks += [
            Block(svg=figures.stress_bars(components)),
            table_block(
                _mega(components), heads, _FORMATS, "Worst element per component"
            ),
            table_block(
                _mega(worst),
                {"component": "component", "rank": "no."}
                | {
                    k: v
                    for k, v in heads.items()
                    if k not in ("component", "elements", "increment")
                },
                _FORMATS,
                "The worst ten elements of each component",
                fold=True,
            ),
        ]
    bars = 0
    if len(axial):
        blocks.append(_axial(axial))
        bars = int(stress.axial_only.sum())
    none = not bars and not len(components)
    text = _stress_text(result, "margin" not in unknown, bars)
    return Section(
        id="parts",
        title="What the parts see: stresses",
        text=text + "The model has no element with stresses. " * none + unable,
        blocks=blocks,
    )


def _stress_text(result: "ProcessResult", margins: bool, bars: int) -> str:
    """How to read the tables, with `margins`, and without `bars` that bend."""
    factor, total = result.case.parts.ultimate_factor, result.parts.total
    text = (
        "Direct transient, all elements at all steps. Equivalent: von Mises of the "
        "sheet itself, the larger of both fibres; of bars the largest direct stress, "
        "without torsion. "
        f"Places are those of the deck ({deck_axes(result.airframe.R_AB)}). "
    )
    if margins:
        text += (
            f"Margin of safety: allowable over {factor:g} times the stress, less 1. "
        )
    text += (
        "The stresses are increments to steady flight. "
        if total is None
        else f"The stress of steady flight ({_steady(result)}) is included; the "
        "largest increment of the landing alone, of any element and instant, stands "
        "beside it. "
    )
    if bars:
        text += (
            f"{bars} bars give no stress recovery points: their axial stress, which "
            "leaves out bending, stands in a table of its own and is no part of the "
            "worst stresses. Their section loads tell what they carry; C, D, E, F on "
            "PBAR (PBEAM), or shapes by PBARL (PBEAML), give their stresses. "
        )
    return text


def _steady(result: "ProcessResult") -> str:
    """Which loads make the stress of steady flight."""
    steady = result.case.airframe.steady
    if steady is None:
        return "weight and the lift distribution of the built-in model at 1 g"
    if steady.nodes:
        return "weight and lift over the nodes of airframe.steady at 1 g"
    source = steady.file.name if steady.file else "the deck"
    which = "all loads" if steady.load is None else f"LOAD {steady.load}"
    return f"weight at 1 g and {which} of {source}"


def _buckling(
    result: "ProcessResult", buckled: BuckledPanels, pictures: Sequence[Picture]
) -> Section:
    ultimate = result.case.parts.ultimate_factor
    upon = "" if result.parts.total is None else " and of steady flight"
    missed = (
        "A count of eigenvalues shows that no lower one was missed. "
        if buckled.complete
        else "A count of eigenvalues says that lower ones may be missing. "
    )
    coarse = int((buckled.table.elements < COARSE).sum())
    heads = {
        "factor": "load factor",
        "margin": "margin",
        "component": "component",
        "id": "element",
        "x": "at x m",
        "y": "y m",
        "z": "z m",
        "elements": "elements with half of the work",
        "time": "instant s",
        "reason": "extreme",
    }
    formats = dict.fromkeys(("x", "y", "z"), ".2f")
    formats |= {"factor": ".3g", "margin": "+.2f", "time": ".3f"}
    text = (
        f"The loads of {buckled.instants} instants at which a gear's load is extreme, "
        f"at rest and balanced by rigid inertia{upon}, times the load factor let the "
        f"panel buckle (linear buckling of the full model). {missed}Margin: the factor "
        f"over {ultimate:g}, less 1. These panels were checked as far as the mesh has "
        "them: buckling between its grids, of a panel that is one element wide, is not "
        "seen, nor are local buckling of thin flanges and what happens after buckling. "
    )
    if coarse:
        text += (
            f"In {coarse} of these modes fewer than {COARSE} elements do half of the "
            "work: the mesh is too coarse for their half waves, and the factor is a "
            "hint, no proof. "
        )
    wanted = result.case.parts.buckling
    if len(buckled.table) < wanted and np.isfinite(buckled.known_below):
        text += (
            f"Of the {wanted} panels that were asked for {len(buckled.table)} are "
            "known to be the lowest: the modes of a case reach a factor of "
            f"{buckled.known_below:.3g}. "
        )
    elif buckled.table.empty:
        text += "No panel buckles under these loads, whatever their size."
    blocks = [png_block(path, caption) for path, caption in pictures]
    if len(buckled.table):
        table = with_margin(buckled, ultimate)
        blocks.append(table_block(table, heads, formats, "Panels that buckle first"))
    return Section(
        id="buckling",
        title="What the parts see: buckling",
        text=text,
        blocks=blocks,
    )


def _axial(axial: pd.DataFrame) -> Block:
    heads = {
        "component": "component",
        "rank": "no.",
        "id": "element",
        "equivalent": "axial stress, magnitude MPa",
        "time": "time s",
        "x": "x m",
        "y": "y m",
        "z": "z m",
    }
    return table_block(
        _mega(axial),
        heads,
        _FORMATS,
        "Bars without stress recovery points: axial stress only, bending not included",
        fold=True,
    )


def _mega(table: pd.DataFrame) -> pd.DataFrame:
    columns = ["equivalent", "increment", "largest", "smallest", "allowed"]
    columns = [c for c in columns if c in table]
    return table.assign(**{c: table[c] / 1e6 for c in columns})


def _panels(result: "ProcessResult") -> Section:
    found = result.parts
    table = tables.panel_table(found)
    pictures = []
    for i, place in enumerate(found.places.panels):
        own = table[table.panel == place.name].reset_index(drop=True)
        axis = int(own.relative.argmax())
        pictures.append(Block(svg=figures.panel(found, i, axis)))
    heads = {
        "panel": "panel",
        "axis": "axis",
        "middle": "middle m/s²",
        "beside": "frames m/s²",
        "relative": "difference m/s²",
        "ratio": "middle / frames",
    }
    formats = dict.fromkeys(("middle", "beside", "relative", "ratio"), ".2f")
    return Section(
        id="panels",
        title="Between two frames",
        text="Acceleration of a point in the middle of a panel beside the mean of its "
        "neighbours on the frames, along the axes of the deck "
        f"({deck_axes(result.airframe.R_AB)}): what a model without the panel cannot "
        "show.",
        blocks=[*pictures, table_block(table, heads, formats, "Peaks")],
    )


def _equipment(result: "ProcessResult") -> Section:
    histories = tables.equipment_histories(result.parts)
    step = result.loads.step
    spectra = {
        name: shock_response_spectrum(
            table[result.vertical].to_numpy(), step, SPECTRUM_HZ
        )
        for name, table in histories.items()
    }
    rows = [
        _equipment_row(name, table, result.loads.time, spectra[name])
        for name, table in histories.items()
    ]
    formats = dict.fromkeys(("x", "y", "z", "spectrum", "hertz"), ".1f")
    formats |= dict.fromkeys(("tx", "ty", "tz"), ".3f")
    groups: dict[str, list[str]] = {}
    for name in histories:
        groups.setdefault(name.split(", ", 1)[-1], []).append(name)
    pictures = [
        Block(
            svg=figures.equipment(
                {n: histories[n] for n in names},
                SPECTRUM_HZ,
                {n: spectra[n] for n in names},
                title.replace("_", " "),
                result.vertical,
            )
        )
        for title, names in groups.items()
    ]
    return Section(
        id="floor",
        title="Floor, rails, equipment",
        text="Accelerations of places that carry equipment, and the largest "
        "acceleration of an oscillator (Q = 10) that stands there and is shaken "
        f"vertically (along {result.vertical}), over its natural frequency. Peaks are "
        "the largest magnitudes with their sign and instant, along the axes of the "
        f"deck ({deck_axes(result.airframe.R_AB)}).",
        blocks=[
            *pictures,
            table_block(pd.DataFrame(rows), _EQUIPMENT, formats, "Peaks and spectra"),
        ],
    )


_EQUIPMENT = {
    "place": "place",
    "x": "peak x m/s²",
    "tx": "at s",
    "y": "peak y m/s²",
    "ty": "at s ",
    "z": "peak z m/s²",
    "tz": " at s",
    "spectrum": "largest response m/s²",
    "hertz": "at Hz",
}


def _equipment_row(
    name: str, table: pd.DataFrame, time: Float64, spectrum: Float64
) -> dict[str, str | float]:
    """Peaks along the axes with their instants, and that of the spectrum."""
    values = table.to_numpy()
    nought = _NOUGHT * float(np.abs(values).max(initial=0.0))
    row: dict[str, str | float] = {"place": name.replace("_", " ")}
    for axis, value in zip(table.columns, values.T):
        k = int(np.abs(value).argmax())
        row[axis] = float(value[k])
        row[f"t{axis}"] = float(time[k]) if abs(value[k]) > nought else float("nan")
    at = int(np.argmax(spectrum))
    return {**row, "spectrum": float(spectrum[at]), "hertz": float(SPECTRUM_HZ[at])}


def _practices(practices: Practices) -> Section:
    rows = []
    table = practices.table
    for kind, quantity in dict.fromkeys(zip(table.kind, table.quantity)):
        own = table[(table.kind == kind) & (table.quantity == quantity)]
        by = own.set_index("practice")
        unit = str(own.unit.iloc[0])
        factor, shown = {
            "Pa": (1e-6, "MPa"), "N": (1e-3, "kN"), "N m": (1e-3, "kN m")
        }.get(unit, (1.0, unit))  # fmt: skip
        rows.append(
            {
                "kind": kind,
                "quantity": f"{quantity}, {shown}",
                "hybrid": factor * by.value[HYBRID],
                "at": by.time[HYBRID],
                "rigid": factor * by.value[RIGID],
                "rigid_error": by.error[RIGID],
                "static": factor * by.value[STATIC],
                "static_error": by.error[STATIC],
            }
        )
    heads = {
        "kind": "kind",
        "quantity": "quantity",
        "hybrid": "hybrid",
        "at": "at s",
        "rigid": "rigid gear loads",
        "rigid_error": "error",
        "static": "static slices",
        "static_error": "error ",
    }
    formats = dict.fromkeys(("hybrid", "rigid", "static"), ".2f") | {"at": ".3f"}
    formats |= dict.fromkeys(("rigid_error", "static_error"), "+.0%")
    slices = practices.slices
    instants = "; ".join(
        f"{t:.3f} s ({why})" for t, why in zip(slices.time, slices.reason)
    )
    return Section(
        id="practices",
        title="Three practices for the same landing",
        text="Rigid gear loads: the gears land under a rigid airframe, their loads act "
        "on the flexible model. Static slices: the loads of the hybrid process at "
        f"{instants}, balanced by rigid inertia. Hybrid: this report. Errors compare "
        "magnitudes of peaks, which are increments to steady flight; quantities that "
        "vanish by symmetry are left out.",
        blocks=[
            Block(svg=figures.practice_errors(practices)),
            table_block(pd.DataFrame(rows), heads, formats, "Peaks"),
        ],
    )
