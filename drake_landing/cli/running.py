"""`demo` and `run`: the whole process of a case, and its figures on the terminal."""

import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from drake_landing.cli.options import (
    Reach,
    Trust,
    default_folder,
    out_option,
    read_case,
)
from drake_landing.terminal import show as show_lines

if TYPE_CHECKING:
    from drake_landing.case.schema import Case
    from drake_landing.results.result import ProcessResult

_AFTER_DEMO = """
One elastic mode is on purpose: this is the functional test of the paper, which shows
how far a single mode gets. With the 76 modes below 50 Hz both models agree far better:

  drake-landing check cases/d150_con_50hz.yaml    what it does, before it runs
  drake-landing run cases/d150_con_50hz.yaml
  drake-landing model con --out con.bdf           its deck, a start for one of yours"""


def demo(out: Annotated[Path | None, out_option("out/demo")] = None) -> None:
    """The conceptual aircraft touches down: the whole process, no input needed."""
    from importlib.resources import files

    from drake_landing.case.reading import parse_case

    text = files("drake_landing").joinpath("demo.yaml").read_text(encoding="utf-8")
    _run(parse_case(text, file="demo.yaml"), out)
    print(_AFTER_DEMO)


def run(
    case: Annotated[Path, typer.Argument(help="case file (YAML)")],
    out: Annotated[Path | None, out_option("out/<name of the case>")] = None,
    practices: Annotated[
        bool,
        typer.Option(
            "--practices",
            help="compare with rigid-airframe gear loads and with static slices",
        ),
    ] = False,
    include_path: Reach = None,
    trust: Trust = False,
    pdf: Annotated[
        bool, typer.Option("--pdf", help="also report.pdf, by Chromium or Chrome")
    ] = False,
) -> None:
    """The whole process for a case: landing, direct transient, comparison, report."""
    from fem.deck.text.source import include_reach

    if pdf:
        from drake_landing.report.pdf import browser

        browser()  # said before the work, not after it
    with include_reach(include_path or [], trust=trust):
        _run(read_case(case), out, practices=practices, pdf=pdf)


def _landing_table(folder: Path) -> tuple[int, int] | None:
    """Which table of a landing lies there, whatever clocks say of its age."""
    table = folder / "attachment_loads.csv"
    if not table.is_file():
        return None
    found = table.stat()
    return found.st_ino, found.st_mtime_ns


def _kept(
    case: "Case", folder: Path, out: Path | None, before: tuple[int, int] | None
) -> str:
    """What a run leaves that is interrupted; `before` it the table of a landing."""
    landed = _landing_table(folder) not in (None, before)
    tables = f"; tables of the landing are in {folder}" if landed else ""
    again = "drake-landing demo"
    if Path(case.places.file).is_file():
        again = f"drake-landing run {shlex.quote(case.places.file)}"
    again += "" if out is None else f" --out {shlex.quote(str(out))}"
    return f"modes found so far are kept for the next run{tables}; again: {again}"


def _run(
    case: "Case", out: Path | None, *, practices: bool = False, pdf: bool = False
) -> None:
    from drake_landing.process.run import run_case
    from drake_landing.progress import reporter, told_when_interrupted
    from fem.files.folders import claim

    folder = claim(out or default_folder(case), f"run {case.name}")
    before = _landing_table(folder)
    with (
        told_when_interrupted(lambda: _kept(case, folder, out, before)),
        reporter() as progress,
    ):
        result = run_case(case, folder, progress, practices=practices)
    if pdf:
        from drake_landing.report.pdf import write_pdf
        from drake_landing.results.readme import write_readme

        write_pdf(folder / "report.html", folder / "report.pdf")
        write_readme(result, folder)
    show_lines(_summary(result, folder))


def _summary(result: "ProcessResult", folder: Path) -> str:
    from drake_landing.results.reliability import reliability
    from drake_landing.results.summary import key_figures, story, time_taken

    figures = [*key_figures(result), *reliability(result)]
    width = max(len(name) for name, _ in figures)
    lines = [story(result), ""]
    lines += [f"  {name:<{width}}  {value}" for name, value in figures]
    if result.notices:
        lines += ["", *(f"note: {notice}" for notice in result.notices)]
    lines += ["", *time_taken(result)]
    return "\n".join([*lines, "", f"report: {folder / 'report.html'}"])
