"""Command line: `drake-landing`.

Exit status 0 on success, 2 on bad input (one message on standard error), 1 on an
internal failure. Heavy packages are imported by the commands that need them.
"""

import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from drake_landing.case import Case
    from drake_landing.process import ProcessResult

app = typer.Typer(
    name="drake-landing",
    help="Aircraft landing loads: multibody simulation of the touchdown in Drake, then "
    "the direct transient response of the full Nastran model.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

Out = Annotated[
    Path | None,
    typer.Option("--out", help="folder of the results; default out/<case name>"),
]


@app.command()
def demo(out: Out = None) -> None:
    """The conceptual aircraft touches down: the whole process, no input needed."""
    from importlib.resources import files

    from drake_landing.cases_io import parse_case

    text = files("drake_landing").joinpath("demo.yaml").read_text(encoding="utf-8")
    _run(parse_case(text, file="demo.yaml"), out)


@app.command()
def run(
    case: Annotated[Path, typer.Argument(help="case file (YAML)")], out: Out = None
) -> None:
    """The whole process for a case: landing, direct transient, comparison, report."""
    from drake_landing.cases_io import load_case

    _run(load_case(case), out)


@app.command()
def check(
    case: Annotated[Path | None, typer.Argument(help="case file (YAML)")] = None,
    schema: Annotated[
        bool, typer.Option("--schema", help="print the JSON schema of case files")
    ] = False,
) -> None:
    """Validates and explains a case without running it."""
    from drake_landing.cases_io import case_text, load_case, schema_text
    from fem.errors import InputError

    if schema:
        print(schema_text())
        return
    if case is None:
        raise InputError("check: give a case file, or --schema")
    checked = load_case(case)
    from drake_landing.explain import explain

    explained = explain(checked)
    print(f"{case_text(checked)}\n{explained}")


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
) -> None:
    """Writes a reference aircraft, or one from a CPACS file, as a Nastran deck."""
    from drake_landing.inputs import write_model_deck
    from fem.errors import InputError

    if level == "from-cpacs":
        if source is None:
            raise InputError("model from-cpacs: give a CPACS file")
        from drake_landing.aircraft.cpacs import write_cpacs_model

        print(write_cpacs_model(source, cpacs_level, out).story(out))
        return
    if source is not None:
        raise InputError(f"model {level}: found {source}; only from-cpacs takes a file")
    print(write_model_deck(level, out))


@app.command()
def show(
    deck: Annotated[Path, typer.Argument(metavar="MODEL.bdf", help="Nastran deck")],
    out: Annotated[
        Path | None, typer.Option("--out", help="folder; default out/<deck name>")
    ] = None,
    modes: Annotated[int, typer.Option("--modes", help="elastic modes to show")] = 10,
) -> None:
    """Pictures of a deck: mesh by component, modes, a viewer that needs no server."""
    from drake_landing.show import show_model

    show_model(deck, out or Path("out", deck.stem), modes)


@app.command()
def study(
    name: Annotated[str, typer.Argument(help="modes, topology or full")],
    out: Out = None,
) -> None:
    """The paper's studies: numbers of modes, gear topologies, the full aircraft."""
    from drake_landing.progress import reporter
    from drake_landing.studies import PLANS, run_study
    from drake_landing.studies.findings import findings
    from fem.errors import InputError, nearest

    if name not in PLANS:
        raise InputError(
            f"study: found '{name}', expected one of {', '.join(PLANS)}"
            + nearest(name, PLANS)
        )
    folder = out or Path("out", name)
    with reporter() as progress:
        done = run_study(PLANS[name], folder, progress)
    for row in findings(done).to_dict("records"):
        print(f"{row['finding']}: {row['figures']} -- {row['holds']}")
    print(f"\nreport: {folder / 'report.html'}")


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
    out: Annotated[
        Path | None, typer.Option("--out", help="folder; default out/<deck name>")
    ] = None,
    highest: Annotated[
        float, typer.Option("--highest", help="craig-bampton: interior modes to, Hz")
    ] = 150.0,
    count: Annotated[
        int, typer.Option("--count", help="dynamic: generalised coordinates")
    ] = 60,
    compare: Annotated[
        float, typer.Option("--compare", help="modes compared with the full model, Hz")
    ] = 50.0,
) -> None:
    """Reduces a deck to interface grids; checks; HDF5, DMIG punch and OUTPUT4."""
    from drake_landing.reduced.command import reduce_deck

    folder = out or Path("out", deck.stem)
    options = {"highest_hz": highest, "count": count, "compare_hz": compare}
    print(reduce_deck(deck, folder, basis=basis, interface=interface, **options))


def _run(case: "Case", out: Path | None) -> None:
    from drake_landing.process import run_case
    from drake_landing.progress import reporter

    folder = out or Path("out", case.name)
    with reporter() as progress:
        result = run_case(case, folder, progress)
    print(_summary(result, folder))


def _summary(result: "ProcessResult", folder: Path) -> str:
    from drake_landing.summary import key_figures, story

    figures = key_figures(result)
    width = max(len(name) for name, _ in figures)
    lines = [story(result), ""]
    lines += [f"  {name:<{width}}  {value}" for name, value in figures]
    if result.notices:
        lines += ["", *(f"note: {notice}" for notice in result.notices)]
    return "\n".join([*lines, "", f"report: {folder / 'report.html'}"])


def main() -> None:
    """Entry point: runs the command and turns errors into exit states."""
    sys.exit(guarded(app))


def guarded(command: Callable[..., Any], args: list[str] | None = None) -> int:
    """Exit status of a command; errors become one message on standard error."""
    from fem.errors import InputError

    try:
        result = command(args=args, standalone_mode=False)
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except typer.Exit as stop:
        return stop.exit_code
    except (KeyboardInterrupt, typer.Abort):
        print("interrupted", file=sys.stderr)
        return 130
    except OSError as error:
        print(f"error: {_os_problem(error)}", file=sys.stderr)
        return 2
    except (Exception, SystemExit) as error:  # Drake's checks exit
        if (show := getattr(error, "show", None)) is not None:  # usage, from click
            show(file=sys.stderr)
            return 2
        return _internal_failure(error)
    return result if isinstance(result, int) else 0


def _os_problem(error: OSError) -> str:
    place = f"{error.filename}: " if error.filename else ""
    return place + (error.strerror or str(error))


def _internal_failure(error: BaseException) -> int:
    """A bug: one line for the user, the traceback on request."""
    print(
        f"internal failure: {type(error).__name__}: {error}\n"
        "(set DRAKE_LANDING_TRACEBACK=1 for the traceback)",
        file=sys.stderr,
    )
    if os.environ.get("DRAKE_LANDING_TRACEBACK"):
        raise error
    return 1
