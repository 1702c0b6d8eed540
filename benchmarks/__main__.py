"""All benchmarks, and the page docs/benchmarks.md.

    python -m benchmarks [--only scale,landing,others] [--parts step,...]
                         [--opensees PYTHON]          (make bench)

Figures of the finite elements at scale are kept in out/benchmarks.json, so that parts
can be run again one by one; the page is written from what is there.
"""

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

from benchmarks import other_solvers, transient_scale
from benchmarks.machine import description, load
from benchmarks.stiffened_aircraft import Size

ROOT = Path(__file__).resolve().parents[1]
KEPT = ROOT / "out" / "benchmarks.json"
PAGE = ROOT / "docs" / "benchmarks.md"
LANDING = ("derivatives", "integrators", "landing_peers")
Results = dict[str, dict[str, float]]
# How much faster than OpenSees' a step is expected to be.
_OPENSEES = 15.0

INTRODUCTION = """\
# Benchmarks

Written by `make bench`, on {machine}.
It is shared: each part names the load (processes that wanted to run) it met, and
figures that the load hardly touches are given in processor time of one thread.
Landings have their own tables: `python -m benchmarks.derivatives`, `.integrators`,
`.landing_peers`.

The model is a stiffened cylinder with wings and tail (`benchmarks/stiffened_aircraft`),
read from a deck in text. The bound of a step is the time of two reads of the factor at
the memory bandwidth that is measured before and after the steps. Up to four load cases
take the ordering with the smallest factor, more the one with the largest dense parts.
Thirty-two load cases are integrated as one block. The envelope keeps minimum, maximum
and their times of all stress columns (von Mises, principal, fibres) of all elements;
its cost is that of a run with it over one without, less one.
"""


def run_landing() -> None:
    """The landing benchmarks, which print their own tables."""
    for name in LANDING:
        print(f"\n== benchmarks.{name}", flush=True)
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
        subprocess.run(
            [sys.executable, "-m", f"benchmarks.{name}"], check=False, env=environment
        )


def run_scale(parts: Iterable[str], kept: Results) -> None:
    """Parts of the finite-element benchmark, each in a process of its own."""
    for part in parts:
        print(f"\n== {part} ...", flush=True)
        kept[part] = transient_scale.run_apart(part)
        print(transient_scale.table({part: kept[part]}), flush=True)
        _keep(kept)


def run_others(kept: Results, python: str | None) -> None:
    """CalculiX and OpenSees, where they are installed."""
    for name, figures in (
        ("calculix", other_solvers.calculix(Size())),
        ("opensees", other_solvers.opensees(Size(), python)),
    ):
        if figures is None:
            print(f"{name} is not installed: left out")
            continue
        kept[name] = {**figures, "load of the machine": load()}
        print(json.dumps(kept[name]), flush=True)
        _keep(kept)


def _keep(kept: Results) -> None:
    KEPT.parent.mkdir(exist_ok=True)
    KEPT.write_text(json.dumps(kept, indent=1))


def ratios(kept: Results) -> list[tuple[str, float, str]]:
    """Times of others over ours: what, ratio, what is expected."""
    ours = {
        "one case": kept.get("step", {}).get("ms per step (processor)"),
        "one case of 32": kept.get("block", {}).get(
            "ms per step and case, 32 cases (processor)"
        ),
    }
    found: list[tuple[str, float, str]] = []
    for figure, value in kept.get("superlu", {}).items():
        if figure.startswith("SuperLU over"):
            found.append((figure, value, ""))
    for name, figure in (
        ("calculix", "s per increment (processor)"),
        ("opensees", "s per step (processor)"),
    ):
        for what, own in ours.items():
            if name in kept and own:
                ratio = 1e3 * kept[name][figure] / own
                text = f"{name}: step over ours, {what}, processor time"
                found.append(
                    (text, ratio, _verdict(ratio) if name == "opensees" else "")
                )
    return found


def _verdict(ratio: float) -> str:
    """What is expected beside OpenSees, and whether it is so."""
    text = f"at least {_OPENSEES:g}"
    return text if ratio >= _OPENSEES else f"{text}: MISSED"


def _explanation(kept: Results) -> str:
    """Why one case cannot be that much faster, '' where it is or nothing is known."""
    theirs = kept.get("opensees", {}).get("s per step (processor)")
    bound = kept.get("step", {}).get("bound, ms (processor)")
    one = kept.get("step", {}).get("ms per step (processor)")
    if not (theirs and bound and one) or 1e3 * theirs >= _OPENSEES * one:
        return ""
    return (
        f"A step of OpenSees takes {1e3 * theirs:.0f} ms of processor time, ours "
        f"{one:.0f} ms, of which {bound:.0f} ms are the two reads of the factor: the "
        f"{_OPENSEES:g} that were expected for one case would be "
        f"{1e3 * theirs / _OPENSEES:.0f} ms. Cases in a block share the reads.\n"
    )


def page(kept: Results) -> str:
    """The page as Markdown."""
    order = [*transient_scale.PARTS, "calculix", "opensees"]
    known = {name: kept[name] for name in order if name in kept}
    parts = [INTRODUCTION.format(machine=description())]
    parts += ["## Finite elements at scale\n", transient_scale.table(known), ""]
    compared = ratios(kept)
    if compared:
        parts += [
            "## Others over ours\n",
            "| what | ratio | expected |",
            "|---|---|---|",
        ]
        parts += [
            f"| {what} | {transient_scale.plain(value, 3)} | {text} |"
            for what, value, text in compared
        ]
        parts += ["", _explanation(kept)]
    return "\n".join(parts).rstrip("\n") + "\n"


def main(arguments: list[str] | None = None) -> None:
    """Run what is asked for, print tables, write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", default="scale,others,landing")
    parser.add_argument("--parts", default=",".join(transient_scale.PARTS))
    parser.add_argument("--opensees", metavar="PYTHON", help="interpreter with it")
    options = parser.parse_args(arguments)
    for part in options.parts.split(","):
        if part not in transient_scale.PARTS:
            known = ", ".join(transient_scale.PARTS)
            parser.error(f"--parts: found {part!r}, expected some of {known}")
    kept: Results = json.loads(KEPT.read_text()) if KEPT.exists() else {}
    wanted = options.only.split(",")
    if "scale" in wanted:
        run_scale(options.parts.split(","), kept)
    if "others" in wanted:
        run_others(kept, options.opensees)
    if "landing" in wanted:
        run_landing()
    for what, value, expected in ratios(kept):
        print(f"{what}: {value:.3g} {f'({expected})' if expected else ''}")
    PAGE.write_text(page(kept))
    print(PAGE)


if __name__ == "__main__":
    main()
