"""How a command ends: its exit status, and at most one message on standard error.

0    success
1    the system (disk, memory) or the program failed
2    bad input: what a user can mend
128+ ended by a signal: 130 Ctrl-C, 143 SIGTERM, 129 SIGHUP; 141 nobody reads on
"""

import errno
import io
import os
import signal
import sys
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from types import FrameType
from typing import Any, NoReturn

from fem.errors import InputError, visible

_SIGNALS = tuple(
    getattr(signal, name)
    for name in ("SIGINT", "SIGTERM", "SIGHUP")
    if hasattr(signal, name)
)
_NOBODY_READS = 141  # as of programs that SIGPIPE ends
_CODES = "ENOSPC EDQUOT EFBIG EROFS EIO ENOMEM EMFILE ENFILE"
_SYSTEM_FAILURES = {getattr(errno, name, None) for name in _CODES.split()}


def run_command(load: Callable[[], Callable[..., Any]], name: str) -> NoReturn:
    """Runs a command of click or typer and leaves the process.

    Args:
        load: imports and returns it; signals count from here on.
        name: of the program, for usage messages.
    """
    # Workers take no modules from the working directory: it may be somebody else's.
    os.environ["PYTHONSAFEPATH"] = "1"
    if isinstance(sys.stdout, io.TextIOWrapper):  # names may have what it cannot show
        sys.stdout.reconfigure(errors="backslashreplace")
    status = exit_status(lambda **options: load()(**options), name)
    for number in _SIGNALS:  # nothing is left that could be interrupted
        signal.signal(number, signal.SIG_IGN)
    # Where the interrupt met code that was made from text (a dataclass being defined),
    # Python would still end as by Ctrl-C; the next text that it runs makes it forget.
    exec("")
    sys.exit(_flushed(status))


def exit_status(
    command: Callable[..., Any], name: str, arguments: Sequence[str] | None = None
) -> int:
    """Exit status of a command of click or typer; errors become one message.

    Args:
        command: the application.
        name: of the program.
        arguments: default those of the process.
    """
    with _noted_signals() as seen:
        status = _status(command, name, arguments, seen)
    if status > 128 and seen:
        print(_words(seen[0]), file=sys.stderr)
    return status


def _status(
    command: Callable[..., Any],
    name: str,
    arguments: Sequence[str] | None,
    seen: list[int],
) -> int:
    try:
        given = None if arguments is None else list(arguments)
        result = command(args=given, prog_name=name, standalone_mode=False)
    except (Exception, KeyboardInterrupt, SystemExit) as error:  # Drake's checks exit
        if seen:  # libraries make errors of their own of the exception
            return 128 + seen[0]
        return _failure(error)
    status = result if isinstance(result, int) else 0
    return 128 + seen[0] if status and seen else status


def _failure(error: BaseException) -> int:
    if isinstance(error, InputError):
        return _say(f"error: {error}", 2)
    if isinstance(error, BrokenPipeError) or _pipe_of(error):
        return _NOBODY_READS
    if isinstance(error, OSError):
        return _say(f"error: {_place(error)}", 1 if is_system_failure(error) else 2)
    if isinstance(error, MemoryError):
        return _say(f"error: out of memory: {error}".rstrip(": "), 1)
    if (show := getattr(error, "show", None)) is not None:  # usage, from click
        show(file=sys.stderr)
        return 2
    if isinstance(error, KeyboardInterrupt):
        return _say(_words(signal.SIGINT), 130)
    if isinstance(error, SystemExit) and error.code == 0:  # shell completion
        return 0
    if getattr(error, "for_users", False):
        return _say(f"error: {error}", 1)
    if os.environ.get("DRAKE_LANDING_TRACEBACK"):
        traceback.print_exception(error)
    return _say(
        f"internal failure: {type(error).__name__}: {error}\n"
        "(set DRAKE_LANDING_TRACEBACK=1 for the traceback)",
        1,
    )


def _say(text: str, status: int) -> int:
    print(visible(text), file=sys.stderr)
    return status


def _place(error: OSError) -> str:
    place = f"{error.filename}: " if error.filename else ""
    return place + (error.strerror or str(error) or type(error).__name__)


def is_system_failure(error: BaseException) -> bool:
    """Disk full, quota, read-only, files beyond a limit: no fault of the input."""
    return isinstance(error, OSError) and error.errno in _SYSTEM_FAILURES


def _pipe_of(error: BaseException) -> bool:
    """Click exits where its output is no longer read."""
    return isinstance(error, SystemExit) and isinstance(
        error.__context__, BrokenPipeError
    )


def _words(number: int) -> str:
    if number == signal.SIGINT:
        return "interrupted"
    return f"ended by {signal.Signals(number).name}"


@contextmanager
def _noted_signals() -> Iterator[list[int]]:
    """Signals so far, each of which interrupts like Ctrl-C; ignored ones stay so."""
    seen: list[int] = []

    def note(number: int, frame: FrameType | None) -> None:
        seen.append(number)
        signal.default_int_handler(number, frame)

    before = {number: signal.getsignal(number) for number in _SIGNALS}
    ours = [n for n in _SIGNALS if before[n] is not signal.SIG_IGN]
    for number in ours:
        signal.signal(number, note)
    try:
        yield seen
    finally:
        for number in ours:
            signal.signal(number, before[number])


def _flushed(status: int) -> int:
    """Exit status after all output has gone where it should."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        status = _NOBODY_READS
    except OSError as error:
        status = _say(f"error: standard output: {error.strerror or error}", 1)
    else:
        return status
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())  # the interpreter flushes once more
    return status
