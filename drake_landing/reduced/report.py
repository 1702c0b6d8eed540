"""The reduction report: printed, stored, drawn."""

from collections.abc import Mapping
from pathlib import Path

import h5py
import numpy as np
import pandas as pd

from drake_landing.csv_tables import write_csv
from drake_landing.reduced.checks import ReductionChecks
from drake_landing.reduced.model import ReducedModel
from fem.files.atomic import write_aside
from fem.files.atomic_hdf5 import written_hdf5
from fem.files.matrices import write_dmig, write_op4
from fem.matrix_files.nastran_h5 import write_h5

PAIRED = 0.5  # MAC from which two modes are the same
_FILES = ("reduced.h5", "reduced.pch", "reduced.op4", "grids.csv", "report.txt")


def report_text(model: ReducedModel, checks: ReductionChecks) -> str:
    """The checks in words and tables."""
    q = model.size - model.a_size
    paired = checks.modes[checks.modes.mac >= PAIRED]
    error, lost = paired.error.abs(), len(checks.modes) - len(paired)
    lines = [
        f"{model.source}: {model.a_size} freedoms at {len(model.grid_id)} grids"
        + (f", {q} generalised coordinates" if q else "")
        + (f"; {len(model.followers)} grids follow" if len(model.followers) else ""),
        *(f"note: {notice}" for notice in model.notices),
        "",
        "mass properties, in the units of the deck",
        _table(checks.mass, {"difference": "{:.2e}"}, "{:z,.4f}"),
        "",
        f"rigid-body motions ({checks.rigid_modes} modes below 0.01 Hz)",
        _table(checks.rigid, {"effective_mass": "{:.4f}"}, "{:.2e}"),
        "",
        "elastic modes of the reduced model",
        _table(checks.counts, {}, "{:g}"),
        "",
        "modes against the full model",
        _table(checks.modes, {"error": "{:.3%}", "mac": "{:.5f}"}, "{:.4f}"),
        "",
        f"{len(error)} modes: largest error {error.max():.3%}, median "
        f"{error.median():.4%}, lowest MAC {paired.mac.min():.4f}"
        if len(error)
        else "no elastic mode has a counterpart in the band",
    ]
    if lost:
        lines.append(
            f"{lost} modes of the full model have no counterpart (MAC below {PAIRED:g})"
        )
    return "\n".join(lines) + "\n"


def _table(table: pd.DataFrame, formats: Mapping[str, str], real: str) -> str:
    def text(name: str):
        if not pd.api.types.is_float_dtype(table[name]):
            return str
        return formats.get(name, real).format

    columns = list(table.columns)
    rows = [columns] + [
        [text(name)(value) for name, value in zip(columns, row)]
        for row in table.itertuples(index=False)
    ]
    widths = [max(len(row[k]) for row in rows) for k in range(len(columns))]
    words = [table[name].dtype.kind not in "if" for name in columns]
    return "\n".join(
        "  "
        + "  ".join(
            f"{cell:{'<' if left else '>'}{w}}"
            for cell, w, left in zip(row, widths, words)
        ).rstrip()
        for row in rows
    )


def write_report(out: Path, model: ReducedModel, checks: ReductionChecks) -> list[Path]:
    """Writes matrices, grid table, checks and their picture into a folder."""
    matrices = model.matrices()
    write_op4(out / "reduced.op4", matrices)
    write_dmig(out / "reduced.pch", matrices)
    write_csv(out / "grids.csv", grid_table(model))
    write_csv(out / "modes.csv", checks.modes)
    text = report_text(model, checks)
    write_aside(out / "report.txt", lambda part: part.write_text(text, "utf-8"))
    with written_hdf5(out / "reduced.h5") as file:
        _write_h5(file, model, checks)
    draw_errors(out / "errors.png", {model.source: checks.modes})
    return [out / name for name in (*_FILES, "modes.csv", "errors.png")]


def grid_table(model: ReducedModel) -> pd.DataFrame:
    """id, x, y, z, components: those that are freedoms of the matrices, in order."""
    digits = np.array(list("123456"))
    return pd.DataFrame(
        {
            "id": model.grid_id,
            **dict(zip("xyz", model.p.T)),
            "components": ["".join(digits[row]) for row in model.kept],
        }
    )


def _write_h5(file: h5py.File, model: ReducedModel, checks: ReductionChecks) -> None:
    write_h5(file, model.matrices())
    file["grid_id"], file["position"] = model.grid_id, model.p
    file["kept"], file["labels"] = model.kept, model.labels
    file["interior_hz"] = model.interior_hz
    file.attrs["source"] = model.source
    for name in ("mass", "rigid", "modes", "counts"):
        table: pd.DataFrame = getattr(checks, name)
        for column in table.columns:
            values = table[column].to_numpy()
            if values.dtype.kind not in "if":
                values = values.astype(bytes if values.dtype.kind == "S" else "O")
                values = np.array([str(v).encode() for v in values])
            file[f"checks/{name}/{column}"] = values


def draw_errors(path: Path, tables: Mapping[str, pd.DataFrame]) -> None:
    """Frequency error over frequency, one series for each reduction."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from drake_landing.drawing_style import plain_style, plain_ticks

    with plain_style():
        figure = Figure(figsize=(8, 4.5), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.add_subplot()
        for (name, table), marker in zip(tables.items(), "osv^Dx+*"):
            table = table[table.mac >= PAIRED]
            error = np.maximum(100 * table.error.abs(), 1e-10)
            axes.semilogy(
                table.full_hz,
                error,
                marker,
                label=name,
                ms=4,
                alpha=0.8,
            )
        axes.set_xlabel("frequency of the full model, Hz")
        axes.set_ylabel("frequency error, %")
        axes.grid(True, which="major", alpha=0.4)
        axes.legend()
        plain_ticks(figure)
        write_aside(path, lambda part: figure.savefig(part, dpi=150, format="png"))
