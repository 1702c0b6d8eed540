"""How an attempt ends."""

import contextlib
import io
from collections.abc import Callable
from enum import Enum
from typing import Any

from fem.exit_status import exit_status


class Outcome(Enum):
    """A message to the user, a right answer, or neither."""

    message = "message"
    right = "right"
    bad = "bad"


def of_command(command: Callable[..., Any], *words: object) -> tuple[Outcome, str]:
    """Of a command line: status 0 with what it said, or 2 with a message.

    Args:
        command: application of typer.
        words: its arguments.
    """
    told, said_so = io.StringIO(), io.StringIO()
    with contextlib.redirect_stderr(told), contextlib.redirect_stdout(said_so):
        status = exit_status(command, "tried", [str(word) for word in words])
    text = told.getvalue()
    if status == 0:
        return Outcome.right, said_so.getvalue()
    said = text.startswith("error: ") and len(text) > 15 and "Traceback" not in text
    if status == 2 and said:
        return Outcome.message, ""
    return Outcome.bad, f"status {status}: {text[-2000:]}"
