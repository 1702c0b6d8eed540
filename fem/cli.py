"""Command line of the finite-element module.

Exit states are those of `fem.exit_status`.
"""

import contextlib
from collections.abc import Callable
from pathlib import Path
from time import perf_counter
from typing import Annotated

import typer
from rich.console import Console as Terminal
from rich.progress import Progress, TextColumn

from fem.errors import visible

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)


class RichConsole:
    """Lines, and a progress bar on a terminal."""

    def __init__(self) -> None:
        self._terminal = Terminal(highlight=False)
        self._progress: Progress | None = None

    def say(self, text: str) -> None:
        """Print lines as they are."""
        self.close()
        self._terminal.print(visible(text), markup=False, soft_wrap=True)

    def progress(self, task: str) -> Callable[[int, int], None]:
        """A bar with the remaining time; plain lines where there is no terminal."""
        self.close()
        if not self._terminal.is_terminal:
            self._terminal.print(f"{task} ...", markup=False)
            return PlainProgress(task, self.say)
        columns = (*Progress.get_default_columns(), TextColumn("{task.completed:.0f}"))
        bar = Progress(*columns, console=self._terminal, transient=True)
        self._progress = bar
        number = bar.add_task(task, total=None)
        bar.start()

        def update(done: int, total: int) -> None:
            bar.update(number, completed=done, total=total)
            if done >= total:
                bar.stop()

        return update

    def close(self) -> None:
        """Take a bar away."""
        if self._progress is not None:
            self._progress.stop()
            self._progress = None


class PlainProgress:
    """Lines on progress with the remaining time, the first after a while.

    Args:
        task: what goes on.
        say: receives the lines.
        clock: seconds.
    """

    def __init__(
        self,
        task: str,
        say: Callable[[str], None],
        clock: Callable[[], float] = perf_counter,
    ) -> None:
        self._task, self._say, self._clock = task, say, clock
        self._start: tuple[float, int] | None = None
        self._next = _QUIET_SECONDS

    def __call__(self, done: int, total: int) -> None:
        """Say something where the time has come."""
        now = self._clock()
        if self._start is None:
            self._start = (now, done)
            return
        begun, first = self._start
        if now - begun < self._next or done >= total or done <= first:
            return
        self._next = 2.0 * (now - begun) if self._next < 60.0 else self._next + 60.0
        left = (now - begun) / (done - first) * (total - done)
        self._say(f"{self._task}: {done} of {total}, {_duration(left)} left")


# Nobody waits for a line within the first seconds.
_QUIET_SECONDS = 10.0


def _duration(seconds: float) -> str:
    """ "45 s" or "3 min 20 s"."""
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"


@app.command()
def run(
    deck: Annotated[
        Path,
        typer.Argument(help="Nastran deck (SOL 101, 103, 105, 108, 109, 111, 112)."),
    ],
    out: Annotated[
        Path | None,
        typer.Option(help="Folder for results; default out/fem/<deck>, by name alone."),
    ] = None,
    sol: Annotated[
        int | None,
        typer.Option(
            "--sol",
            help="Solve the deck's subcases as this solution (101, 103, ...), whatever "
            "its own is.",
        ),
    ] = None,
    ignore: Annotated[
        str, typer.Option(help="Unsupported cards to go on without: CARD,CARD,...")
    ] = "",
    envelope: Annotated[
        bool, typer.Option(help="Extremes over time of all element results.")
    ] = False,
    bar_loads: Annotated[
        bool,
        typer.Option(
            help="Bars and beams in transients with what PLOAD1 does between their "
            "ends (Nastran's tables leave it out)."
        ),
    ] = True,
    op2: Annotated[
        bool | None,
        typer.Option(help="OP2 file; by default where PARAM POST is negative."),
    ] = None,
    paraview: Annotated[
        bool, typer.Option("--paraview", help="ParaView files (VTKHDF).")
    ] = False,
    f06: Annotated[
        bool, typer.Option("--f06", help="A listing like F06 (DIR/<deck>.f06).")
    ] = False,
    punch: Annotated[
        bool,
        typer.Option(
            "--punch",
            help="All results as PUNCH (DIR/<deck>.pch); requests with PUNCH write "
            "theirs without it.",
        ),
    ] = False,
    quality: Annotated[
        bool, typer.Option("--quality", help="Print the worst shapes of elements.")
    ] = False,
    include_path: Annotated[
        list[Path] | None,
        typer.Option(help="Folder that INCLUDE may read beside that of the deck."),
    ] = None,
    trust: Annotated[
        bool, typer.Option("--trust", help="INCLUDE may read any file.")
    ] = False,
    threads: Annotated[
        int | None, typer.Option(min=1, help="Threads of the sparse solver.")
    ] = None,
) -> None:
    """Solve a Nastran deck's own case control and write DIR/<deck>.h5."""
    from fem.input_files import expect_file

    expect_file(deck)
    from fem.deck.reader import read_deck
    from fem.deck.text.source import include_reach
    from fem.errors import InputError
    from fem.files.escaping import file_name
    from fem.files.export import export, wants_op2
    from fem.files.folders import claimed
    from fem.solution import Options, run_deck, solution_problems
    from fem.solution.override import as_solution

    console = RichConsole()
    with contextlib.ExitStack() as stack:
        stack.callback(console.close)
        stack.enter_context(include_reach(include_path or [], trust=trust))
        names = [name for name in ignore.replace(" ", "").split(",") if name]
        try:
            model = read_deck(deck, ignore=names)
        except InputError as error:
            # What makes the rest moot comes first.
            moot = [] if sol is not None else solution_problems(deck)
            raise InputError([*moot, *error.problems]) from None
        if sol is not None:
            model, told = as_solution(model, sol)
            console.say(f"notice: {'; '.join(told)}")
        folder = out if out is not None else Path("out", "fem", deck.stem)
        stack.enter_context(claimed(folder, "fem", file_name(deck.stem)))
        options = Options(
            threads=threads,
            envelope=envelope,
            bar_loads=bar_loads,
            quality=quality,
            console=console,
        )
        results = run_deck(model, folder / f"{deck.stem}.h5", options)
        wanted = wants_op2(model) if op2 is None else op2
        export(
            results,
            model,
            op2=wanted,
            paraview=paraview,
            say=console.say,
            f06=f06,
            punch=punch,
        )


def _status(arguments: list[str] | None) -> int:
    from fem.exit_status import exit_status

    return exit_status(app, "python -m fem", arguments)
