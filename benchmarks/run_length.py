"""What the length of a run and the time step do to the extremes of whole cases.

python -m benchmarks.run_length [CASE.yaml ...] [--page]

Each case is run for 0.6 s, for `duration: auto`, for 3 s, and with a step of 0.1 ms
beside 0.5 ms. Differences are those of peaks: accelerations (components above 5 % of
the largest), section loads at the cuts that are looked at, the worst stress of each
component of the structure.
"""

import argparse
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pandas as pd

from benchmarks.page import DOCS, markdown, put
from drake_landing.case.reading import load_case
from drake_landing.case.schema import Case
from drake_landing.parts.tables import component_table, root_histories
from drake_landing.process.run import run_case
from drake_landing.results.result import ProcessResult
from fem.errors import InputError

CASES = Path(__file__).resolve().parents[1] / "cases"
DEFAULT = (CASES / "d150_con_50hz.yaml", CASES / "commuter/case.yaml")
COARSE, FINE = 5e-4, 1e-4  # s
RELEVANT = 0.05  # of the largest peak of its kind


def with_settings(case: Case, duration: float | str, step: float) -> Case:
    """The same case with another length and another step."""
    return case.model_copy(
        update={
            "simulation": case.simulation.model_copy(update={"duration": duration}),
            "transient": case.transient.model_copy(
                update={"step": step, "accept": 100.0}
            ),
        }
    )


def peaks(result: ProcessResult) -> dict[str, np.ndarray]:
    """Kind -> largest magnitude of each of its quantities."""
    accelerations = pd.concat(list(result.response.values()), axis="columns")
    sections = root_histories(result.parts)
    shear = [str(c).endswith("shear") for c in sections]
    return {
        "accelerations": accelerations.abs().max().to_numpy(),
        "shear": sections.loc[:, shear].abs().max().to_numpy(),
        "moments": sections.loc[:, np.invert(shear)].abs().max().to_numpy(),
        "stresses": component_table(result.parts.judged, 1.0)
        .sort_values("component")
        .equivalent.to_numpy(),
    }


def differences(
    found: dict[str, np.ndarray], reference: dict[str, np.ndarray]
) -> dict[str, float]:
    """Kind -> worst relative difference with its sign."""
    worst = {}
    for kind, values in reference.items():
        counts = values > RELEVANT * values.max()
        error = found[kind][counts] / values[counts] - 1.0
        worst[kind] = float(error[np.argmax(np.abs(error))])
    return worst


def _quantities(result: ProcessResult) -> int:
    """How many extremes could have been flagged."""
    return sum(len(values) for values in peaks(result).values())


def row(path: Path) -> Iterator[tuple[str, str]]:
    """The figures of a case, column by column."""

    def run(duration: float | str, step: float) -> ProcessResult:
        with TemporaryDirectory() as folder:
            return run_case(with_settings(case, duration, step), folder)

    case = load_case(path)
    auto = run("auto", COARSE)
    short, long, fine = run(0.6, COARSE), run(3.0, COARSE), run("auto", FINE)
    length = differences(peaks(auto), peaks(long))
    step = differences(peaks(auto), peaks(fine))
    cut = differences(peaks(short), peaks(long))
    yield "case", case.name
    yield "auto, s", f"{auto.loads.time[-1]:.2f}"
    yield "auto against 3 s", _percent(*length.values())
    yield "0.6 s against 3 s", _percent(*cut.values())
    flagged = f"{len(short.late)} of {_quantities(short)}, {len(auto.late)}"
    yield "extremes in the last swing: 0.6 s, auto", flagged
    yield "expected error of 0.5 ms", f"{100.0 * auto.step.error:.1f} %"
    yield "0.5 ms against 0.1 ms: accelerations", _percent(step["accelerations"])
    yield "section loads", _percent(step["shear"], step["moments"])
    yield "stresses", _percent(step["stresses"])


def _percent(*values: float) -> str:
    return f"{100.0 * max(values, key=abs):+.1f} %"


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="*", type=Path, default=DEFAULT)
    parser.add_argument("--page", action="store_true", help="into docs/accuracy.md")
    arguments = parser.parse_args()
    try:
        text = markdown(pd.DataFrame([dict(row(path)) for path in arguments.cases]))
    except InputError as error:
        parser.error(str(error))
    print(text)
    if arguments.page:
        put(DOCS / "accuracy.md", "length of a run", text)


if __name__ == "__main__":
    main()
