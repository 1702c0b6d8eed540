"""The limit manoeuvre of 2.65 g on PRE and FULL: deflection, root moment, margins.

python -m benchmarks.limit_load [pre full]
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from drake_landing.aircraft import write_model
from drake_landing.aircraft.limit_load import (
    LOAD_FACTOR,
    SOURCE_ROOT_MOMENT,
    LimitLoad,
    limit_load,
)
from fem.deck.reader import read_deck
from fem.structure import Structure


def solve(level: str) -> LimitLoad:
    """The limit load case of a level."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "model.bdf"
        write_model(level, path)
        return limit_load(Structure.from_deck(read_deck(path)))


def text(level: str, found: LimitLoad) -> str:
    """A few lines."""
    worst, ratio = found.worst, found.root_moment / SOURCE_ROOT_MOMENT - 1.0
    high = found.stress.stress.quantile([0.5, 0.9, 0.99, 0.999]) / 1e6
    moments = ", ".join(f"{m / 1e6:.3f} at {y:g} m" for y, m in found.moments.items())
    return (
        f"DLR-D150-{level.upper()} at {LOAD_FACTOR} g\n"
        f"  tip deflection {found.tip_deflection:.3f} m\n"
        f"  bending moment at the side of the body {found.root_moment / 1e6:.3f} MN m, "
        f"source {SOURCE_ROOT_MOMENT / 1e6:.3f} ({ratio:+.1%}); {moments}\n"
        f"  stress at limit load: median {high.iloc[0]:.0f}, 90 % {high.iloc[1]:.0f}, "
        f"99 % {high.iloc[2]:.0f}, 99.9 % {high.iloc[3]:.0f}, largest "
        f"{found.stress.stress.max() / 1e6:.0f} MPa\n"
        f"  least margin at ultimate load {worst.margin:+.2f}: {worst.table} "
        f"{worst.id}, property {worst.pid}, {worst.stress / 1e6:.0f} of "
        f"{worst.allowed / 1e6:.0f} MPa"
    )


if __name__ == "__main__":
    for name in sys.argv[1:] or ("pre", "full"):
        print(text(name, solve(name)))
