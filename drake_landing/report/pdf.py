"""The report as PDF, by a browser that is there."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from fem.errors import InputError
from fem.files.atomic import written_aside

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome", "msedge")
_SECONDS = 180.0
_FLAGS = (
    *("--headless", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update"),
    *("--disable-sync", "--no-pdf-header-footer"),
)


def browser() -> str:
    """A browser of the Chromium family: `DRAKE_LANDING_BROWSER`, or found in PATH.

    Raises:
        InputError: there is none.
    """
    wanted = os.environ.get("DRAKE_LANDING_BROWSER")
    for name in (wanted,) if wanted else BROWSERS:
        if found := shutil.which(name):
            return found
    raise InputError(
        f"--pdf: found no browser ({wanted or ', '.join(BROWSERS)}); give one by "
        "DRAKE_LANDING_BROWSER, or print report.html from yours"
    )


def write_pdf(page: Path, path: Path) -> None:
    """Prints a page with its own print style.

    Args:
        page: HTML file.
        path: of the PDF file, which appears complete or not at all.

    Raises:
        InputError: the browser could not print.
    """
    with tempfile.TemporaryDirectory() as profile, written_aside(path) as part:
        command = [browser(), *_FLAGS, *_sandbox(), f"--user-data-dir={profile}"]
        command += [f"--print-to-pdf={part.resolve()}", page.resolve().as_uri()]
        try:
            done = subprocess.run(
                command, capture_output=True, text=True, timeout=_SECONDS, check=False
            )
        except subprocess.TimeoutExpired:
            raise InputError(f"--pdf: {command[0]} took over {_SECONDS:g} s") from None
        if not part.is_file() or part.read_bytes()[:5] != b"%PDF-":
            last = (done.stderr.strip().splitlines() or ["no message"])[-1]
            raise InputError(f"--pdf: {command[0]} wrote no PDF: {last}")


def _sandbox() -> list[str]:
    """Chromium refuses its sandbox to the superuser, as in containers."""
    root = hasattr(os, "geteuid") and os.geteuid() == 0
    return ["--no-sandbox"] if root else []
