"""Command line: `drake-landing`.

Exit states are those of `fem.exit_status`. Heavy packages are imported by the commands
that need them.
"""

import shlex
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from drake_landing.terminal import show as show_lines

if TYPE_CHECKING:
    from drake_landing.case.schema import Case
    from drake_landing.results.result import ProcessResult

app = typer.Typer(
    name="drake-landing",
    help="Aircraft landing loads: multibody simulation of the touchdown in Drake, then "
    "the direct transient response of the full Nastran model.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)


def _out(default: str) -> Any:
    """Option of the folder for results."""
    return typer.Option("--out", help=f"folder of the results; default {default}")


Reach = Annotated[
    list[Path] | None,
    typer.Option(
        "--include-path", help="folder that INCLUDE may read beside the deck's"
    ),
]
Trust = Annotated[bool, typer.Option("--trust", help="INCLUDE may read any file")]


def _show_version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        print(f"drake-landing {version('drake-landing')}, drake {version('drake')}")
        raise typer.Exit


@app.callback()
def common(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_show_version, is_eager=True, help="and that of Drake"
        ),
    ] = False,
) -> None:
    """What all commands have in common."""


@app.command()
def demo(out: Annotated[Path | None, _out("out/demo")] = None) -> None:
    """The conceptual aircraft touches down: the whole process, no input needed."""
    from importlib.resources import files

    from drake_landing.case.reading import parse_case

    text = files("drake_landing").joinpath("demo.yaml").read_text(encoding="utf-8")
    _run(parse_case(text, file="demo.yaml"), out)
    print(_AFTER_DEMO)


@app.command()
def run(
    case: Annotated[Path, typer.Argument(help="case file (YAML)")],
    out: Annotated[Path | None, _out("out/<name of the case>")] = None,
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
    from fem.deck.source import include_reach

    if pdf:
        from drake_landing.report.pdf import browser

        browser()  # said before the work, not after it
    with include_reach(include_path or [], trust=trust):
        _run(_case(case), out, practices=practices, pdf=pdf)


@app.command()
def new(
    case: Annotated[Path, typer.Argument(metavar="CASE.yaml", help="file to write")],
    deck: Annotated[Path, typer.Option("--deck", help="Nastran deck of the airframe")],
    units: Annotated[
        str | None,
        typer.Option("--units", help="of the deck: SI, mm-t-N or in-lbf; else guessed"),
    ] = None,
    forward: Annotated[
        str | None,
        typer.Option(
            "--forward", help="where the deck's nose points, e.g. x or -x; else guessed"
        ),
    ] = None,
    up: Annotated[
        str | None,
        typer.Option("--up", help="up in the deck, e.g. z or -z; else guessed"),
    ] = None,
    include_path: Reach = None,
    trust: Trust = False,
) -> None:
    """Writes a commented case for a deck: units, axes, points, gears to begin with."""
    _expect_deck(deck)
    from drake_landing.process.new_case import Stated, new_case
    from fem.deck.source import include_reach
    from fem.errors import InputError
    from fem.files.atomic import write_aside

    if case.exists():
        raise InputError(f"{case}: is there already, and is left as it is")
    with include_reach(include_path or [], trust=trust):
        text = new_case(deck, case, Stated(units=units, forward=forward, up=up))
    write_aside(case, lambda to: to.write_text(text, encoding="utf-8") and None)
    again = shlex.quote(str(case))
    print(f"{case}: replace what is marked GUESS, then drake-landing check {again}")


@app.command()
def conditions(
    case: Annotated[Path, typer.Argument(help="case file (YAML)")],
    out: Annotated[Path | None, _out("out/conditions/<name of the case>")] = None,
    include_path: Reach = None,
    trust: Trust = False,
) -> None:
    """Ground-load conditions of CS-25 or CS-23 as balanced static cases."""
    loaded = _case(case)
    from drake_landing.process.static_conditions import run_conditions, summary
    from drake_landing.progress import reporter
    from fem.deck.source import include_reach
    from fem.files.folders import claim

    folder = out or Path("out", "conditions", loaded.name)
    folder = claim(folder, f"conditions {loaded.name}")
    with include_reach(include_path or [], trust=trust), reporter() as progress:
        result = run_conditions(loaded, folder, progress)
    show_lines(summary(result, loaded, folder))


@app.command()
def check(
    case: Annotated[
        Path | None, typer.Argument(help="case or campaign file (YAML)")
    ] = None,
    schema: Annotated[
        bool, typer.Option("--schema", help="print the JSON schema of case files")
    ] = False,
    everything: Annotated[
        bool, typer.Option("--all", help="also all values, defaults included")
    ] = False,
    thorough: Annotated[
        bool, typer.Option("--thorough", help="factorise very large models too")
    ] = False,
    include_path: Reach = None,
    trust: Trust = False,
) -> None:
    """Explains a case after a dry run: deck, mechanisms, gears, initial state."""
    from drake_landing.case.reading import case_text, schema_text
    from fem.deck.source import include_reach
    from fem.errors import InputError

    if schema:
        print(schema_text())
        return
    if case is None:
        raise InputError("check: give a case file, or --schema")
    from drake_landing.campaign.cases import is_campaign, load_campaign

    if is_campaign(case):
        from drake_landing.campaign.command import explain_campaign

        with include_reach(include_path or [], trust=trust):
            show_lines(explain_campaign(load_campaign(case)))
        return
    checked = _case(case)
    from drake_landing.process.explain import explain
    from drake_landing.transient.step_error import StepRefused

    with include_reach(include_path or [], trust=trust):
        try:
            show_lines(explain(checked, _default_folder(checked), thorough=thorough))
        except StepRefused as refused:
            show_lines(refused.explanation)
            raise
    if everything:
        print(f"\nall values, defaults included:\n\n{case_text(checked)}", end="")
    else:
        name = shlex.quote(str(case))
        print(f"run it: drake-landing run {name}; all its values: check --all {name}")


@app.command()
def model(
    level: Annotated[str, typer.Argument(help="con, pre, full, or from-cpacs")],
    out: Annotated[Path, typer.Option("--out", help="bulk-data file to write")],
    source: Annotated[
        Path | None, typer.Argument(metavar="FILE.xml", help="for from-cpacs")
    ] = None,
    cpacs_level: Annotated[
        str, typer.Option("--level", help="of from-cpacs: con, pre or full")
    ] = "pre",
    topology: Annotated[
        str | None,
        typer.Option("--topology", help="gears' attachment: 1, 2, full: distributed"),
    ] = None,
) -> None:
    """Writes a reference aircraft, or one from a CPACS file, as a Nastran deck."""
    from drake_landing.parametric import parametric_aircraft
    from fem.errors import InputError

    if level == "from-cpacs":
        if source is None:
            raise InputError("model from-cpacs: give a CPACS file")
        from drake_landing.reference.d150.cpacs import write_cpacs_model

        show_lines(write_cpacs_model(source, cpacs_level, out, topology).story(out))
        return
    if source is not None:
        raise InputError(f"model {level}: found {source}; only from-cpacs takes a file")
    print(parametric_aircraft(level).write(out, topology).story)


@app.command()
def show(
    deck: Annotated[Path, typer.Argument(metavar="MODEL.bdf", help="Nastran deck")],
    out: Annotated[Path | None, _out("out/show/<name of the deck>")] = None,
    modes: Annotated[int, typer.Option("--modes", help="elastic modes to show")] = 10,
    include_path: Reach = None,
    trust: Trust = False,
) -> None:
    """Pictures of a deck: mesh by component, modes, a viewer that needs no server."""
    _expect_deck(deck)
    from drake_landing.show import show_model
    from fem.deck.source import include_reach
    from fem.files.folders import claim

    folder = claim(out or Path("out", "show", deck.stem), f"show {deck.name}")
    with include_reach(include_path or [], trust=trust):
        show_model(deck, folder, modes)


@app.command()
def study(
    name: Annotated[str, typer.Argument(help="modes, topology or full")],
    out: Annotated[Path | None, _out("out/study/<name>")] = None,
) -> None:
    """The paper's studies: numbers of modes, gear topologies, the full aircraft."""
    from drake_landing.progress import reporter, told_when_interrupted
    from drake_landing.reference.studies import PLANS, run_study
    from drake_landing.reference.studies.findings import findings
    from fem.errors import InputError, nearest
    from fem.files.folders import claim

    if name not in PLANS:
        raise InputError(
            f"study: found '{name}', expected one of {', '.join(PLANS)}"
            + nearest(name, PLANS)
        )
    folder = claim(out or Path("out", "study", name), f"study {name}")
    again = "" if out is None else f" --out {shlex.quote(str(out))}"
    kept = f"landings and transients so far are kept; go on: study {name}{again}"
    with told_when_interrupted(lambda: kept), reporter() as progress:
        done = run_study(PLANS[name], folder, progress)
    for row in findings(done).to_dict("records"):
        print(f"{row['finding']}: {row['figures']} -- {row['holds']}")
    print(f"\nreport: {folder / 'report.html'}")


@app.command()
def campaign(
    file: Annotated[
        Path, typer.Argument(metavar="CAMPAIGN.yaml", help="see docs/campaigns.md")
    ],
    out: Annotated[Path | None, _out("out/campaign/<name>")] = None,
    scheduler: Annotated[
        str,
        typer.Option("--scheduler", help="local, here, or tcp://host:port of Dask"),
    ] = "local",
    workers: Annotated[
        int | None, typer.Option("--workers", min=1, help="processes; default cores")
    ] = None,
    memory: Annotated[
        float, typer.Option("--memory", min=0.0, help="GB per worker; 0: no limit")
    ] = 0.0,
    report: Annotated[
        list[int] | None,
        typer.Option("--report", help="case whose whole process is run, with report"),
    ] = None,
    compare: Annotated[
        Path | None,
        typer.Option("--compare", help="folder of another campaign: what grew"),
    ] = None,
    include_path: Reach = None,
    trust: Trust = False,
) -> None:
    """Many landings: stress of every element, envelopes, critical cases; goes on."""
    from drake_landing.campaign.cases import load_campaign

    planned = load_campaign(file)  # what is wrong with it, before much is loaded
    from drake_landing.campaign.command import campaign_command
    from drake_landing.campaign.engine import Pool
    from fem.deck.source import include_reach

    pool = Pool(scheduler=scheduler, workers=workers, memory_gb=memory)
    with include_reach(include_path or [], trust=trust):
        failed = campaign_command(planned, file, out, pool, report or [], compare)
    if failed:
        raise typer.Exit(3)


@app.command()
def reduce(
    deck: Annotated[Path, typer.Argument(metavar="MODEL.bdf", help="Nastran deck")],
    basis: Annotated[
        str, typer.Option("--basis", help="guyan, craig-bampton or dynamic")
    ] = "guyan",
    interface: Annotated[
        str | None,
        typer.Option("--interface", help="'SET 2' or '11, 20 THRU 30'; default ASET"),
    ] = None,
    out: Annotated[Path | None, _out("out/reduce/<name of the deck>")] = None,
    highest: Annotated[
        float, typer.Option("--highest", help="craig-bampton: interior modes to, Hz")
    ] = 150.0,
    count: Annotated[
        int, typer.Option("--count", help="dynamic: generalised coordinates")
    ] = 60,
    compare: Annotated[
        float, typer.Option("--compare", help="modes compared with the full model, Hz")
    ] = 50.0,
    include_path: Reach = None,
    trust: Trust = False,
) -> None:
    """Reduces a deck to interface grids; checks; HDF5, DMIG punch and OUTPUT4."""
    _expect_deck(deck)
    from drake_landing.reduced.command import reduce_deck
    from fem.deck.source import include_reach
    from fem.files.folders import claim

    folder = claim(out or Path("out", "reduce", deck.stem), f"reduce {deck.name}")
    options = {"highest_hz": highest, "count": count, "compare_hz": compare}
    with include_reach(include_path or [], trust=trust):
        done = reduce_deck(deck, folder, basis=basis, interface=interface, **options)
    show_lines(done)


@app.command("show-run")
def show_run(
    folder: Annotated[Path, typer.Argument(metavar="OUT", help="results of a run")],
) -> None:
    """How a run was made, and whether its files are still those that it has read."""
    from drake_landing.results.provenance import read_provenance
    from fem.errors import InputError

    made = read_provenance(folder)
    lines = made.lines()
    width = max(len(what) for what, _ in lines)
    for what, value in lines:
        show_lines(f"{what:<{width}}  {value}")
    if changes := made.changes(folder):
        raise InputError(changes)
    print(f"\nverified: {len(made.files)} files and the gear data are those of the run")


@app.command()
def cache(
    clear: Annotated[bool, typer.Option("--clear", help="delete what is kept")] = False,
) -> None:
    """Where modes are kept between runs, and how much; `--clear`: machine code, too."""
    import shutil

    from drake_landing.cache import Cache
    from systems.tools.compiled import compiled_folder

    store = Cache.of_user()
    if clear:
        shutil.rmtree(compiled_folder(), ignore_errors=True)
    if store.folder is None:
        print("nothing is kept: DRAKE_LANDING_CACHE=off")
        return
    entries = store.entries()
    size = f"{len(entries)} entries, {sum(entries.values()) / 1e6:,.1f} MB"
    if clear:
        store.clear()
        print(f"{store.folder}: deleted {size}")
        return
    print(f"{store.folder}: {size} of at most {store.limit_gb:g} GB")


_AFTER_DEMO = """
One elastic mode is on purpose: this is the functional test of the paper, which shows
how far a single mode gets. With the 76 modes below 50 Hz both models agree far better:

  drake-landing check cases/d150_con_50hz.yaml    what it does, before it runs
  drake-landing run cases/d150_con_50hz.yaml
  drake-landing model con --out con.bdf           its deck, a start for one of yours"""


def _expect_deck(path: Path) -> None:
    from fem.errors import InputError
    from fem.input_files import expect_file

    if path.suffix.lower() in (".yaml", ".yml"):
        raise InputError(f"{path}: is a YAML file, expected a Nastran deck")
    expect_file(path)


def _case(path: Path) -> "Case":
    """A case whose deck is there."""
    from drake_landing.case.deck_file import deck_file
    from drake_landing.case.reading import load_case

    case = load_case(path)
    with case.reading():
        deck_file(case.airframe)
    return case


def _default_folder(case: "Case") -> Path:
    return Path("out", case.name)


def _kept(case: "Case", folder: Path, out: Path | None, began: float) -> str:
    """What a run leaves that began at a time (s of the epoch) and is interrupted."""
    table = folder / "attachment_loads.csv"
    landed = table.is_file() and table.stat().st_mtime >= began
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

    began = time.time()
    folder = claim(out or _default_folder(case), f"run {case.name}")
    with (
        told_when_interrupted(lambda: _kept(case, folder, out, began)),
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


def guarded(command: Callable[..., Any], args: list[str] | None = None) -> int:
    """Exit status of a command; errors become one message on standard error."""
    from fem.exit_status import exit_status

    return exit_status(command, "drake-landing", args)
