"""Reductions of PRE and FULL onto the 261 reference nodes against the full models.

    python -m benchmarks.reduction [pre full] [--topology 2] [--out DIR] [--page]

Per level: elastic modes below some frequencies beside the paper's counts, the named
global modes, and per mode below 50 Hz the frequency error and MAC of Guyan's and of
Craig-Bampton's reduction. Written are `<level>_modes.csv`, `reduction.md` and
`aircraft_reduction.png`; `--page` puts tables and picture into the documentation.
"""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pandas as pd

from benchmarks.page import DOCS, markdown, put
from drake_landing.reduced.checks import (
    ReductionChecks,
    check_reduction,
    full_modes,
    reduced_modes,
)
from drake_landing.reduced.make import reduce_structure
from drake_landing.reduced.report import PAIRED
from drake_landing.reference.d150 import interface_nodes, write_model
from drake_landing.reference.global_modes import named_modes
from fem.deck.reader import read_deck
from fem.model.structure import Structure

HIGHEST = 50.0  # Hz, of the modes that are compared
INTERIOR = 150.0  # Hz, of Craig-Bampton's fixed-interface modes
# Elastic modes of the reduced model below a frequency, as published.
PAPER = {
    "pre": {10.0: 19, 50.0: 73, 150.0: 210},
    "full": {25.0: 38, 50.0: 95, 100.0: 192, 150.0: 270},
}
PICTURE = "aircraft_reduction.png"
_BANDS = (10.0, 25.0, 50.0)


@dataclass(frozen=True, kw_only=True)
class Level:
    """Both reductions of an aircraft.

    Attributes:
        name: pre or full.
        guyan, bampton: checks.
        interior: number of fixed-interface modes.
        named: the named global modes of Guyan's model.
    """

    name: str
    guyan: ReductionChecks
    bampton: ReductionChecks
    interior: int
    named: pd.DataFrame

    @property
    def modes(self) -> pd.DataFrame:
        """Mode, full_hz, motion, and frequency, error, MAC of both reductions."""
        columns = ["mode", "reduced_hz", "error", "mac"]
        first = self.guyan.modes[[*columns, "full_hz", "motion"]]
        return first.merge(
            self.bampton.modes[columns], on="mode", suffixes=("_guyan", "_cb")
        )


def solve(level: str, topology: str) -> Level:
    """Both reductions and their checks."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"{level}.bdf"
        write_model(level, path, topology)
        structure = Structure.from_deck(read_deck(path))
        full = full_modes(structure, HIGHEST)
        guyan = reduce_structure(structure, interface_nodes(), "guyan")
        first = check_reduction(structure, guyan, HIGHEST, full)
        named = named_modes(guyan.model, reduced_modes(guyan.model, 60.0))
        del guyan
        bampton = reduce_structure(
            structure, interface_nodes(), "craig-bampton", highest_hz=INTERIOR
        )
        second = check_reduction(structure, bampton, HIGHEST, full)
    return Level(
        name=level,
        guyan=first,
        bampton=second,
        interior=len(bampton.model.interior_hz),
        named=named,
    )


def counts(levels: Sequence[Level]) -> pd.DataFrame:
    """Elastic modes of Guyan's models beside the paper's."""
    rows = []
    for level in levels:
        own = dict(zip(level.guyan.counts.below_hz, level.guyan.counts.modes))
        for hertz, found in own.items():
            paper = PAPER[level.name].get(hertz)
            away = "" if paper is None else f"{found / paper - 1.0:+.0%}"
            name = level.name.upper()
            rows.append((name, f"{hertz:g}", found, paper or "", away))
    return pd.DataFrame(rows, columns=["model", "below Hz", "ours", "paper", "away"])


def named(levels: Sequence[Level]) -> pd.DataFrame:
    """The named modes of both models, and the band of each."""
    result = None
    for level in levels:
        table, name = level.named, level.name.upper()
        part = pd.DataFrame(
            {
                "mode": table.name,
                "band Hz": [
                    f"{a:g}-{b:g}" for a, b in zip(table.lowest, table.highest)
                ],
                f"{name} Hz": [
                    f"{hertz:.2f}{'' if inside else ' (outside)'}"
                    for hertz, inside in zip(table.hz, table.inside)
                ],
                f"{name} number": table["mode"],
                f"{name} participation": [f"{p:.2f}" for p in table.participation],
            }
        )
        result = part if result is None else result.merge(part, on=["mode", "band Hz"])
    assert result is not None
    return result


def errors(levels: Sequence[Level]) -> pd.DataFrame:
    """Median and largest error by band of frequency."""
    rows = []
    for level in levels:
        table = level.modes
        for low, high in zip((0.0, *_BANDS), _BANDS):
            part = table[(table.full_hz >= low) & (table.full_hz < high)]
            row = [level.name.upper(), f"{low:g}-{high:g}", len(part)]
            for kind in ("guyan", "cb"):
                paired = part[part[f"mac_{kind}"] >= PAIRED]
                size = paired[f"error_{kind}"].abs()
                row += [f"{size.median():.3%}", f"{size.max():.2%}"]
                row += [len(part) - len(paired)]
            rows.append(row)
    names = ["model", "Hz", "modes"]
    for kind in ("Guyan", "CB"):
        names += [f"{kind} median", f"{kind} largest", f"{kind} unpaired"]
    return pd.DataFrame(rows, columns=names)


def each(level: Level) -> pd.DataFrame:
    """Every mode of the full model below 50 Hz."""
    table = level.modes.sort_values("mode")
    columns = {"mode": table["mode"], "full Hz": table.full_hz.map("{:.3f}".format)}
    for kind, name in (("guyan", "Guyan"), ("cb", "CB")):
        paired = table[f"mac_{kind}"] >= PAIRED
        error = table[f"error_{kind}"].map("{:+.3%}".format)
        columns[name] = np.where(paired, error, "-")
        columns[f"{name} MAC"] = table[f"mac_{kind}"].map("{:.3f}".format)
    return pd.DataFrame({**columns, "motion": table.motion})


def draw(path: Path, levels: Sequence[Level]) -> None:
    """Frequency errors of both reductions, one panel per level."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(4.8 * len(levels), 4.0), layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(1, len(levels), sharey=True, squeeze=False)[0]
    for axes, level in zip(panels, levels):
        table = level.modes
        for kind, name, mark in (
            ("guyan", "Guyan", "o"),
            ("cb", f"Craig-Bampton, {level.interior} interior modes", "s"),
        ):
            paired = table[table[f"mac_{kind}"] >= PAIRED]
            size = np.maximum(100 * paired[f"error_{kind}"].abs(), 1e-5)
            axes.semilogy(paired.full_hz, size, mark, mfc="none", ms=5, label=name)
        lost = table[table.mac_guyan < PAIRED].full_hz
        if len(lost):
            axes.plot(
                *(lost, np.full(len(lost), 0.97), "|"),
                color="black", ms=9, transform=axes.get_xaxis_transform(),
                label=f"{len(lost)} modes without a counterpart in Guyan's",
            )  # fmt: skip
        axes.set_ylim(5e-6, 10.0)
        axes.set_title(f"DLR-D150-{level.name.upper()}")
        axes.set_xlabel("frequency of the full model, Hz")
        axes.grid(alpha=0.4)
        axes.legend(loc="lower right", fontsize=8)
    panels[0].set_ylabel("frequency error, %")
    figure.savefig(path, dpi=130)


def tables(levels: Sequence[Level]) -> dict[str, str]:
    """Name of its place in the documentation -> table."""
    return {
        "mode counts": markdown(counts(levels)),
        "named modes": markdown(named(levels)),
        "reduction errors": markdown(errors(levels)),
        **{f"{lv.name} modes": markdown(each(lv)) for lv in levels},
    }


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("levels", nargs="*", default=["pre", "full"])
    parser.add_argument("--topology", default="2")
    parser.add_argument("--out", type=Path, default=Path("out", "reduction"))
    parser.add_argument("--page", action="store_true")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    levels = [solve(name, arguments.topology) for name in arguments.levels]
    for level in levels:
        level.modes.to_csv(arguments.out / f"{level.name}_modes.csv", index=False)
    draw(arguments.out / PICTURE, levels)
    found = tables(levels)
    text = "\n\n".join(f"## {name}\n\n{table}" for name, table in found.items())
    (arguments.out / "reduction.md").write_text(text + "\n")
    print(text)
    if arguments.page:
        draw(DOCS / PICTURE, levels)
        for name, table in found.items():
            put(DOCS / "aircraft.md", name, table)


if __name__ == "__main__":
    main()
