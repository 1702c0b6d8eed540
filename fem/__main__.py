"""`python -m fem DECK.bdf`; see `fem.cli`."""

from collections.abc import Callable
from typing import Any

from fem.exit_status import run_command


def _load() -> Callable[..., Any]:
    from fem.cli import app

    return app


def main() -> None:
    """Entry point."""
    run_command(_load, "python -m fem")


if __name__ == "__main__":
    main()
