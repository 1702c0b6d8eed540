"""`new`, `check`, `conditions`: a case is written, explained, loaded by the rules."""

import shlex
from pathlib import Path
from typing import Annotated

import typer

from drake_landing.cli.options import (
    Reach,
    Trust,
    default_folder,
    expect_deck,
    out_option,
    read_case,
)
from drake_landing.terminal import show as show_lines


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
    expect_deck(deck)
    from drake_landing.process.new_case import Stated, new_case
    from fem.deck.text.source import include_reach
    from fem.errors import InputError
    from fem.files.atomic import write_aside

    if case.exists():
        raise InputError(f"{case}: is there already, and is left as it is")
    with include_reach(include_path or [], trust=trust):
        text = new_case(deck, case, Stated(units=units, forward=forward, up=up))
    write_aside(case, lambda to: to.write_text(text, encoding="utf-8") and None)
    again = shlex.quote(str(case))
    print(f"{case}: replace what is marked GUESS, then drake-landing check {again}")


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
    from fem.deck.text.source import include_reach
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
    checked = read_case(case)
    from drake_landing.process.explain import explain
    from drake_landing.transient.step_error import StepRefused

    with include_reach(include_path or [], trust=trust):
        try:
            show_lines(explain(checked, default_folder(checked), thorough=thorough))
        except StepRefused as refused:
            show_lines(refused.explanation)
            raise
    if everything:
        print(f"\nall values, defaults included:\n\n{case_text(checked)}", end="")
    else:
        name = shlex.quote(str(case))
        print(f"run it: drake-landing run {name}; all its values: check --all {name}")


def conditions(
    case: Annotated[Path, typer.Argument(help="case file (YAML)")],
    out: Annotated[Path | None, out_option("out/conditions/<name of the case>")] = None,
    include_path: Reach = None,
    trust: Trust = False,
) -> None:
    """Ground-load conditions of CS-25 or CS-23 as balanced static cases."""
    loaded = read_case(case)
    from drake_landing.process.static_conditions import run_conditions, summary
    from drake_landing.progress import reporter
    from fem.deck.text.source import include_reach
    from fem.files.folders import claim

    folder = out or Path("out", "conditions", loaded.name)
    folder = claim(folder, f"conditions {loaded.name}")
    with include_reach(include_path or [], trust=trust), reporter() as progress:
        result = run_conditions(loaded, folder, progress)
    show_lines(summary(result, loaded, folder))
