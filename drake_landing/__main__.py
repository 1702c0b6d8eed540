"""`python -m drake_landing` and `drake-landing`; see `drake_landing.cli`."""

import sys


def main() -> None:
    """Entry point; Ctrl-C is one line even while packages are imported."""
    try:
        from drake_landing.cli import main as run

        run()
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        sys.exit(130)


if __name__ == "__main__":
    main()
