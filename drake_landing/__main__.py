"""`python -m drake_landing` and `drake-landing`; see `drake_landing.cli`."""

from collections.abc import Callable
from typing import Any

from fem.exit_status import run_command


def _load() -> Callable[..., Any]:
    from drake_landing.cli import app

    return app


def main() -> None:
    """Entry point; Ctrl-C is one line even while packages are imported."""
    run_command(_load, "drake-landing")


if __name__ == "__main__":
    main()
