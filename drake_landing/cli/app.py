"""The commands, in the order of the help."""

from collections.abc import Callable
from typing import Annotated, Any

import typer

from drake_landing.cli import cases, decks, many_landings, past_runs, running

app = typer.Typer(
    name="drake-landing",
    help="Aircraft landing loads: multibody simulation of the touchdown in Drake, then "
    "the direct transient response of the full Nastran model.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)


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


for _command in (
    running.demo,
    running.run,
    cases.new,
    cases.conditions,
    cases.check,
    decks.model,
    decks.show,
    many_landings.study,
    many_landings.campaign,
    decks.reduce,
    past_runs.show_run,
    past_runs.cache,
):
    app.command()(_command)


def guarded(command: Callable[..., Any], args: list[str] | None = None) -> int:
    """Exit status of a command; errors become one message on standard error."""
    from fem.exit_status import exit_status

    return exit_status(command, "drake-landing", args)
