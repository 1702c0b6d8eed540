"""The limit manoeuvre of 2.65 g on PRE and FULL: deflection, root moment, margins.

python -m benchmarks.limit_load [pre full] [--page]
"""

import argparse
from pathlib import Path
from tempfile import TemporaryDirectory

import pandas as pd

from benchmarks.page import DOCS, markdown, put
from drake_landing.reference.d150 import write_model
from drake_landing.reference.d150.limit_load import (
    LOAD_FACTOR,
    SOURCE_ROOT_MOMENT,
    LimitLoad,
    limit_load,
)
from fem.deck.reader import read_deck
from fem.model.structure import Structure

_SEMI_SPAN = 16.963  # m


def solve(level: str) -> LimitLoad:
    """The limit load case of a level."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "model.bdf"
        write_model(level, path)
        return limit_load(Structure.from_deck(read_deck(path)))


def column(found: LimitLoad) -> dict[str, str]:
    """Figures of a level in words."""
    worst = found.worst
    ratio = found.root_moment / SOURCE_ROOT_MOMENT - 1.0
    quantiles = found.stress.stress.quantile([0.5, 0.9, 0.99, 0.999]) / 1e6
    moments = ", ".join(f"{m / 1e6:.2f} at {y:g} m" for y, m in found.moments.items())
    return {
        "tip deflection": f"{found.tip_deflection:.2f} m, "
        f"{found.tip_deflection / _SEMI_SPAN:.1%} of the semi-span",
        "bending moment at the side of the body": f"{found.root_moment / 1e6:.3f} "
        f"MN m, the source's {SOURCE_ROOT_MOMENT / 1e6:.3f} ({ratio:+.1%})",
        "bending moment farther out, MN m": moments,
        "stress at limit load, MPa": "half below {:.0f}, 90 % {:.0f}, 99 % {:.0f}, "
        "99.9 % {:.0f}".format(*quantiles),
        "elements": f"{len(found.stress):,}",
        "least margin at ultimate load": f"{worst.margin:+.2f}: {worst.table} "
        f"{worst.id}, property {worst.pid}, {worst.stress / 1e6:.0f} MPa at limit "
        f"load of {worst.allowed / 1e6:.0f} MPa",
    }


def table(levels: dict[str, LimitLoad]) -> str:
    """Both levels side by side, as Markdown."""
    columns = {name: column(found) for name, found in levels.items()}
    first = next(iter(columns.values()))
    rows = {f"at {LOAD_FACTOR} g": list(first)}
    for name, values in columns.items():
        rows[name.upper()] = list(values.values())
    return markdown(pd.DataFrame(rows))


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("levels", nargs="*", default=["pre", "full"])
    parser.add_argument("--page", action="store_true")
    arguments = parser.parse_args()
    text = table({level: solve(level) for level in arguments.levels})
    print(text)
    if arguments.page:
        put(DOCS / "aircraft.md", "limit load", text)


if __name__ == "__main__":
    main()
