"""How commands end: states, one message, nothing of the interpreter's own."""

import errno
import os
import signal
import subprocess
import sys

import pytest

from fem.errors import InputError
from fem.exit_status import exit_status


class LandingStopped(RuntimeError):
    for_users = True


ENDS = {
    "input": (InputError("a.bdf:3: bad"), 2, "error: a.bdf:3: bad\n"),
    "disk full": (
        OSError(errno.ENOSPC, "No space left on device", "out/a.h5"),
        1,
        "error: out/a.h5: No space left on device\n",
    ),
    "quota": (OSError(errno.EDQUOT, "Disk quota exceeded"), 1, "error: Disk quota"),
    "read-only": (OSError(errno.EROFS, "Read-only file system", "a"), 1, "error: a: "),
    "absent": (OSError(errno.ENOENT, "No such file", "a"), 2, "error: a: No such"),
    "memory": (MemoryError("75 GiB"), 1, "error: out of memory: 75 GiB\n"),
    "memory, no more words": (MemoryError(), 1, "error: out of memory\n"),
    "for users": (LandingStopped("stopped"), 1, "error: stopped\n"),
    "bug": (ZeroDivisionError("oops"), 1, "internal failure: ZeroDivisionError: oops"),
    "pipe": (BrokenPipeError(errno.EPIPE, "Broken pipe"), 141, ""),
    "Ctrl-C": (KeyboardInterrupt(), 130, "interrupted\n"),
    "left": (SystemExit(0), 0, ""),
}


@pytest.mark.parametrize(("error", "status", "words"), ENDS.values(), ids=ENDS)
def test_errors_have_their_status(error, status, words, capsys):
    def command(**_):
        raise error

    assert exit_status(command, "x", []) == status
    told = capsys.readouterr().err
    assert told.startswith(words)
    assert bool(told) == bool(words)
    assert "Traceback" not in told


def _handler(number):
    """As it is; under nohup hanging up is ignored, also by the commands."""
    found = signal.getsignal(number)
    return signal.SIG_DFL if found is signal.SIG_IGN else found


@pytest.mark.parametrize(
    ("number", "status", "words"),
    [
        (signal.SIGINT, 130, "interrupted\n"),
        (signal.SIGTERM, 143, "ended by SIGTERM\n"),
        (signal.SIGHUP, 129, "ended by SIGHUP\n"),
    ],
)
def test_signals_are_one_line_whatever_libraries_make_of_them(
    number, status, words, capsys
):
    def command(**_):
        try:
            os.kill(os.getpid(), number)
            while True:
                pass
        except KeyboardInterrupt:
            raise RuntimeError("a library's own") from None

    signal.signal(number, before := _handler(number))
    assert exit_status(command, "x", []) == status
    assert capsys.readouterr().err == words
    assert signal.getsignal(number) is before


TEXT_INTERRUPTED = """
import os, signal
from fem.exit_status import run_command
if __name__ == "__main__":
    code = f"os.kill({os.getpid()}, signal.SIGTERM)\\nwhile True: pass"
    run_command(lambda: lambda **_: exec(code), "x")
"""


def test_interrupts_of_code_that_is_being_made_end_alike(tmp_path):
    """Python's own end would be that of Ctrl-C: dataclasses are made from text."""
    (tmp_path / "program.py").write_text(TEXT_INTERRUPTED)
    done = subprocess.run(
        [sys.executable, "-m", "program"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (143, "ended by SIGTERM\n")


def piped(line: str) -> tuple[int, str]:
    """Status of the command before the pipe, and standard error."""
    done = subprocess.run(
        ["bash", "-c", f"set -o pipefail; {line}"],
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stderr


def test_output_that_nobody_reads_ends_in_silence():
    line = f"{sys.executable} -m drake_landing check --schema | head -1"
    assert piped(line) in ((141, ""), (0, ""))


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no such device")
def test_output_that_cannot_be_written_is_said():
    status, told = piped(f"{sys.executable} -m drake_landing --version > /dev/full")
    assert status == 1
    assert told.startswith("error: ")
    assert told.endswith("No space left on device\n")
    assert told.count("\n") == 1


def test_what_two_readers_found_is_told_once() -> None:
    error = InputError(["a.bdf:3: bad", "a.bdf:4: bad", "a.bdf:3: bad"])
    assert error.problems == ("a.bdf:3: bad", "a.bdf:4: bad")
