"""The report of one landing: which pictures and tables, in which order."""

import platform
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from drake_landing.case.axes import deck_axes
from drake_landing.case.reading import case_text
from drake_landing.files import versions
from drake_landing.report import figures
from drake_landing.report.axes_figure import axes_sketch
from drake_landing.report.gear_echo import gear_echo
from drake_landing.report.page import (
    Block,
    Page,
    Section,
    pairs_block,
    table_block,
    write_page,
)
from drake_landing.report.parts_sections import Picture, parts_sections
from drake_landing.results.comparison import NEGLIGIBLE, shock_response_spectrum
from drake_landing.results.readme import file_lines
from drake_landing.results.reliability import reliability
from drake_landing.results.summary import key_figures, mode_count, story
from drake_landing.results.truncation import peaks_below
from drake_landing.results.verdict import verdict
from drake_landing.results.whole_mass import whole_mass
from drake_landing.transient.extremes import worst_elements

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult

_SPECTRUM_HZ = np.geomspace(2.0, 200.0, 120)

_AGREEMENT = {
    "point": "point",
    "axis": "axis",
    "peak_fe": "peak, transient m/s²",
    "time_fe": "at s",
    "peak_low": "low-passed, magnitude m/s²",
    "peak_mbs": "peak, multibody m/s²",
    "time_mbs": "at s ",
    "peak_error": "peak error",
    "rms_error": "rms difference",
    "correlation": "correlation",
    "sprague_geers": "Sprague-Geers",
}
_AGREEMENT_FORMATS = {
    **dict.fromkeys(("peak_fe", "peak_low", "peak_mbs"), ".3f"),
    **dict.fromkeys(("time_fe", "time_mbs"), ".3f"),
    **dict.fromkeys(("peak_error", "rms_error", "sprague_geers"), ".2%"),
    "correlation": ".4f",
}


_BESIDE = {
    "landing.html": "Replay in three dimensions",
    "histories.html": "Interactive histories",
}
_WORST = {
    "result": "result",
    "type": "type",
    "column": "quantity",
    "element": "element",
    "value": "extreme",
    "time": "time, s",
}


def write_report(
    path: Path,
    result: "ProcessResult",
    pictures: Sequence[Picture] = (),
    unable: str = "",
    buckling: Sequence[Picture] = (),
) -> None:
    """Writes `report.html`.

    Args:
        path: of the file.
        result: of the run.
        pictures: of the stress field, and what they show.
        unable: a sentence on why there are none.
        buckling: pictures of the mode that buckles first.
    """
    case = result.case
    write_page(
        path,
        Page(
            name=case.name,
            title=case.title or f"{result.aircraft.name}: landing",
            story=story(result),
            key_figures=key_figures(result),
            sections=list(_sections(result, pictures, unable, buckling, path.parent)),
            beside=[
                (name, what)
                for name, what in _BESIDE.items()
                if (path.parent / name).is_file()
            ],
            footer=", ".join(f"{k} {v}" for k, v in versions().items() if k != "python")
            + f", Python {platform.python_version()}. SI units.",
        ),
    )


def _sections(
    result: "ProcessResult",
    pictures: Sequence[Picture],
    unable: str,
    buckling: Sequence[Picture],
    folder: Path,
) -> Iterator[Section]:
    yield Section(
        id="verdict",
        title="In short",
        blocks=[
            pairs_block(verdict(result)),
            pairs_block(reliability(result), "How far the numbers carry"),
            *_late(result),
        ],
    )
    yield _axes(result)
    yield _gears(result)
    yield Section(
        id="loads",
        title="Attachment loads",
        text="Force and moment of the gear on the airframe at the attachment node, in "
        f"the axes of the deck ({deck_axes(result.airframe.R_AB)}), as increments to "
        "steady flight; moments are about the node, right-handed about the axes. These "
        "load the full model.",
        blocks=[
            Block(svg=figures.attachment_loads(result.history)),
            _attachment_nodes(result),
        ],
    )
    yield from parts_sections(result, pictures, unable, buckling)
    yield _accelerations(result)
    yield _spectra(result)
    yield _extremes(result)
    yield Section(
        id="energy",
        title="Energy audit",
        text="Kinetic, stored and dissipated energy must add up to a constant. "
        + _reference_energy(result),
        blocks=[Block(svg=figures.energy(result.history))],
    )
    yield _case(result)
    yield Section(
        id="made",
        title="How it was made",
        text="The same stands in results.h5 (group provenance) and at the head of "
        "landing_sol109.bdf; drake-landing show-run FOLDER prints it and verifies the "
        "checksums. Paths are relative to the folder of the results.",
        blocks=[pairs_block(_made(result))],
    )
    yield _files(result, folder)
    if result.notices:
        yield Section(
            id="notices",
            title=f"Notices ({len(result.notices)})",
            text="What the program met in the deck and the case; of one kind, one line "
            "with the number.",
            blocks=[Block(items=result.notices)],
        )


def _axes(result: "ProcessResult") -> Section:
    R_AB, structure = result.airframe.R_AB, result.airframe.structure
    gears = [n for gear in result.aircraft.gears for n in gear.attachments.values()]
    sketch = axes_sketch(structure, R_AB, gears, list(result.parts.cuts.values()))
    return Section(
        id="axes",
        title="Axes, units, signs, mass",
        text="All in this report and in the files is along the axes x, y, z of the "
        f"deck's basic frame ({deck_axes(R_AB)}), which is fixed to the airframe and "
        "pitches, rolls and yaws with it, and in SI units (m, kg, s, N, Pa; kN and MPa "
        "where a heading says so), whatever the units of the deck. Aft, starboard and "
        "up are directions of the airframe, too; those of the runway are named. Loads, "
        "accelerations and stresses are increments to the steady flight before "
        "touchdown where nothing else is said; all are limit loads, without a factor. "
        "Accelerations are those of the motion: an accelerometer shows 1 g upward "
        "more. Time counts from the start of the run.",
        blocks=[
            Block(svg=sketch, caption="The arrows start at the deck's origin."),
            pairs_block(_mass_pairs(result), "Mass, gears extended"),
        ],
    )


def _mass_pairs(result: "ProcessResult") -> list[tuple[str, str]]:
    """Of the airframe and of the aircraft with its gears."""
    body, R_AB = result.airframe.body, result.airframe.R_AB
    whole = whole_mass(result.airframe, result.aircraft.gears)
    own, chord = R_AB.T @ body.p_BG, result.case.airframe.mac

    def share(cg: np.ndarray) -> str:
        return "" if chord is None else f", {chord.percent(cg, R_AB):.2f} % MAC"

    pairs = [
        ("airframe without gears", _mass(body.mass, own) + share(own)),
        ("its inertia", _inertia(R_AB.T @ body.inertia_G @ R_AB)),
        ("aircraft with gears", _mass(whole.mass, whole.cg) + share(whole.cg)),
        ("its inertia with gears", _inertia(whole.inertia)),
    ]
    gears = [
        f"{g.name.replace('_', ' ')} {g.mass:,.1f} kg" for g in result.aircraft.gears
    ]
    return [*pairs, ("gears", ", ".join(gears))]


def _inertia(inertia: np.ndarray) -> str:
    return (
        "about that centre of gravity, axes of the deck, kg m²: "
        + ", ".join(f"I{a}{a} {inertia[i, i]:,.0f}" for i, a in enumerate("xyz"))
        + "; products (minus the integrals) "
        + ", ".join(
            f"I{'xyz'[i]}{'xyz'[j]} {inertia[i, j]:z,.0f}"
            for i, j in ((0, 1), (0, 2), (1, 2))
        )
    )


def _mass(mass: float, cg: np.ndarray) -> str:
    x, y, z = cg
    return (
        f"{mass:,.1f} kg, centre of gravity at x {x:z.3f}, y {y:z.3f}, z {z:z.3f} m "
        "from the origin of the deck"
    )


def _reference_energy(result: "ProcessResult") -> str:
    """What the figure of the energies refers to."""
    energy = f"{result.history.figures['sink_energy'] / 1e3:.1f} kJ"
    if result.aircraft.scenario.start == "touchdown":
        return (
            f"The sink energy, half the mass times the sink rate squared, is {energy}."
        )
    return (
        f"The aircraft rolls and does not sink: shares are those of {energy}, the sink "
        "energy of a landing with the same mass."
    )


def _late(result: "ProcessResult") -> list[Block]:
    """Extremes that came in the last swing."""
    if result.late.empty:
        return []
    heads = {"kind": "kind", "quantity": "quantity", "value": "extreme", "unit": "unit"}
    heads |= {"time": "time s"}
    return [
        table_block(
            result.late,
            heads,
            {"value": ".4g", "time": ".3f"},
            "Extremes in the last swing of the run: a longer one may find more",
        )
    ]


def _extremes(result: "ProcessResult") -> Section:
    worst = worst_elements(result.envelopes, 1)
    return Section(
        id="extremes",
        title="Extremes of all results",
        text="Extremes of element forces and stresses in the direct transient, "
        "increments to steady flight: for each type and quantity the element with "
        "the largest. All elements: results.h5, group envelope; the worst ten: "
        "worst_elements.csv. Quantities and element axes are Nastran's; SI units (N, "
        "N m, N/m of shells, Pa). Stresses of bars without stress recovery points "
        "leave out bending; those of CBUSH are forces times the recovery coefficients "
        "of PBUSH (1 by default), and no stress then.",
        blocks=[table_block(worst, _WORST, {"value": ".4g", "time": ".3f"})],
    )


def _accelerations(result: "ProcessResult") -> Section:
    multibody = result.multibody_on_grid
    floor = NEGLIGIBLE * max(result.comparison["peak_fe"].max(), 0.0)
    pictures = [
        figures.accelerations(point, multibody[point], transient, floor)
        for point, transient in result.response.items()
    ]
    shown = result.comparison.dropna(subset="rms_error").merge(peaks_below(result))
    shown = _with_signs(shown, result.response, multibody, result.loads.time)
    return Section(
        id="accelerations",
        title="Accelerations",
        text=f"Multibody with {mode_count(result)}, and the direct "
        "transient of the full model under the same attachment loads. Axes of the "
        f"deck ({deck_axes(result.airframe.R_AB)}); components that vanish by symmetry "
        "are left out. The transient has the modes above the last of the multibody "
        "model too: beside its raw peaks stand those low-passed at "
        f"{result.airframe.highest_hz:.0f} Hz (Butterworth, forward and back: no "
        "phase, and peaks may grow a little).",
        blocks=[
            *(Block(svg=picture) for picture in pictures if picture),
            table_block(
                shown,
                _AGREEMENT,
                _AGREEMENT_FORMATS,
                "Multibody against direct transient: peaks are the largest magnitudes, "
                "with their sign and instant; errors are relative to the transient",
            ),
        ],
    )


def _with_signs(
    rows: pd.DataFrame,
    transient: Mapping[str, pd.DataFrame],
    multibody: Mapping[str, pd.DataFrame],
    time: np.ndarray,
) -> pd.DataFrame:
    """Peaks of points and axes with their signs, and their instants."""
    found: dict[str, list[float]] = {}
    for model, tables in (("fe", transient), ("mbs", multibody)):
        for point, axis in zip(rows["point"], rows["axis"]):
            values = tables[point][axis].to_numpy()
            at = int(np.abs(values).argmax())
            found.setdefault(f"peak_{model}", []).append(float(values[at]))
            found.setdefault(f"time_{model}", []).append(float(time[at]))
    return rows.assign(**found)


def _spectra(result: "ProcessResult") -> Section:
    step = result.loads.step

    def of(tables: dict[str, pd.DataFrame]) -> dict[str, np.ndarray]:
        return {
            point: shock_response_spectrum(
                t[result.vertical].to_numpy(), step, _SPECTRUM_HZ
            )
            for point, t in tables.items()
        }

    picture = figures.spectra(
        _SPECTRUM_HZ,
        of(result.multibody_on_grid),
        of(result.response),
        result.vertical,
    )
    return Section(
        id="spectra",
        title="Shock response spectra",
        text="Largest acceleration of an oscillator (Q = 10) that stands on the point "
        "and is shaken vertically, over its natural frequency: what equipment there "
        "has to bear.",
        blocks=[Block(svg=picture)],
    )


def _gears(result: "ProcessResult") -> Section:
    return Section(
        id="gears",
        title="Landing gears",
        text="Tyre loads are those of the runway on all tyres of a gear: vertical is "
        "normal to the runway, drag along it, aft. Stroke and force of a shock "
        "absorber are along its own axis, positive in compression. The wheels stand "
        "still at touchdown and are spun up by the drag.",
        blocks=[
            *_gear_peaks(result),
            Block(svg=figures.struts_and_tyres(result.history)),
            Block(svg=figures.force_over_stroke(result.history)),
        ],
    )


def _attachment_nodes(result: "ProcessResult") -> Block:
    """Where the nodes are that moments are about."""
    points, rows = result.airframe.structure.points, []
    for gear in result.aircraft.gears:
        for name, node in gear.attachments.items():
            x, y, z = points.xyz[points.rows(node)]
            rows.append(
                {"name": name.replace("_", " "), "node": str(node)}
                | {"x": float(x), "y": float(y), "z": float(z)}
            )
    heads = {"name": "attachment", "node": "grid", "x": "x m", "y": "y m", "z": "z m"}
    formats = dict.fromkeys("xyz", ".3f")
    return table_block(pd.DataFrame(rows), heads, formats, "Attachment nodes")


def _gear_peaks(result: "ProcessResult") -> Iterator[Block]:
    """Peaks and their instants."""
    peaks = result.gears.pivot(index="gear", columns="quantity", values="peak")
    peaks = peaks.loc[list(dict.fromkeys(result.gears["gear"]))].reset_index()
    kilo = [c for c in peaks.columns if c not in ("gear", "stroke")]
    peaks[kilo] = peaks[kilo] / 1e3
    heads = {
        "gear": "gear",
        "stroke": "stroke m",
        "tyre_vertical": "tyre vertical kN",
        "tyre_drag": "tyre drag kN",
        **{f"attachment_f{a}": f"F{a} kN" for a in "xyz"},
        **{f"attachment_m{a}": f"M{a} kN m" for a in "xyz"},
    }
    formats = dict.fromkeys(heads, ".2f") | {"stroke": ".4f"}
    # Zero by symmetry reads better without a sign.
    peaks[kilo] = peaks[kilo].where(peaks[kilo].abs() > 5e-3, 0.0)
    instants = result.gears.pivot(index="gear", columns="quantity", values="time")
    instants = instants.loc[peaks["gear"]].reset_index()
    yield table_block(
        peaks,
        heads,
        formats,
        f"Load case '{result.case.name}': peaks per gear (largest magnitude, with its "
        "sign): tyres in the axes of the runway; F and M on the airframe at the "
        f"attachment node, axes of the deck ({deck_axes(result.airframe.R_AB)}), "
        "increments to steady flight; the peaks of a row are not of one instant",
    )
    yield table_block(
        instants,
        {name: head.split(" k")[0].removesuffix(" m") for name, head in heads.items()},
        dict.fromkeys(heads, ".3f"),
        "Instants of these peaks, s",
    )


def _case(result: "ProcessResult") -> Section:
    return Section(
        id="case",
        title="Case and gears",
        blocks=[
            pairs_block(_case_pairs(result)),
            gear_echo(result.aircraft.gears, result.provenance.facts["gear data"]),
            Block(
                caption="The case file, defaults written out",
                pre=case_text(result.case),
            ),
        ],
    )


def _made(result: "ProcessResult") -> list[tuple[str, str]]:
    seconds = sum(result.seconds.values())
    return [
        *result.provenance.lines(),
        ("duration", f"{seconds:.1f} s until this page"),
    ]


def _files(result: "ProcessResult", folder: Path) -> Section:
    return Section(
        id="files",
        title="Files and time",
        text="Beside this page lie the files below; README.txt there names the "
        "columns, units and frames.",
        blocks=[
            pairs_block(file_lines(result, folder)),
            table_block(
                result.stages.table(),
                {
                    "stage": "stage",
                    "wall": "time s",
                    "share": "share",
                    "processor": "processor time s",
                    "memory_gb": "peak memory so far GB",
                },
                {
                    "wall": ".1f",
                    "share": ".0%",
                    "processor": ".1f",
                    "memory_gb": ".2f",
                },
                "Time and memory taken until this page was written",
            ),
        ],
    )


def _case_pairs(result: "ProcessResult") -> list[tuple[str, str]]:
    case, body, run = result.case, result.airframe.body, result.history.figures
    sim, tr = case.simulation, case.transient
    x, y, z = result.airframe.R_AB.T @ body.p_BG  # in the frame of the deck
    last = f" up to {body.frequency[-1]:.2f} Hz" if body.n else ""
    topology = result.aircraft.topology
    return [
        (
            "aircraft",
            result.aircraft.name + (f", topology {topology}" * bool(topology)),
        ),
        (
            "airframe",
            f"{result.airframe.grids} grids, {body.mass:,.0f} kg without gears, centre "
            f"of gravity at x {x:z.3f}, y {y:z.3f}, z {z:z.3f} m of the deck",
        ),
        ("basis", case.airframe.basis),
        ("elastic modes", f"{body.n} ({case.airframe.select}){last}"),
        (
            "scenario",
            f"{result.aircraft.scenario.story}; {result.aircraft.scenario.lift_story}",
        ),
        (
            "multibody run",
            f"{result.history.time[-1]:.4g} s, {sim.integrator}, accuracy "
            f"{sim.accuracy:g}: "
            f"{run['steps']:.0f} steps, {run['evaluations']:.0f} evaluations",
        ),
        (
            "direct transient",
            f"{result.loads.time[-1]:g} s in steps of {tr.step:g} s, {tr.scheme}",
        ),
    ]
