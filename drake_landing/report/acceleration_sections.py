"""Accelerations of a report: multibody beside direct transient, shock spectra."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from drake_landing.case.axes import deck_axes
from drake_landing.report import figures
from drake_landing.report.page import Block, Section, table_block
from drake_landing.results.comparison import NEGLIGIBLE, shock_response_spectrum
from drake_landing.results.summary import mode_count
from drake_landing.results.truncation import peaks_below

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


def accelerations_section(result: "ProcessResult") -> Section:
    """Accelerations of the points, m/s², axes of the deck: histories and peaks."""
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


def spectra_section(result: "ProcessResult") -> Section:
    """Shock response spectra of the points, vertical, Q = 10."""
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
