"""Runs all cases and writes docs/verification.md; exit status 1 where one misses."""

import argparse
import sys
from itertools import groupby
from pathlib import Path
from time import process_time

from benchmarks.verification.cases import CASES, REFERENCES
from benchmarks.verification.table import page, plain_table

PAGE = Path(__file__).resolve().parents[2] / "docs" / "verification.md"


def main(arguments: list[str] | None = None) -> int:
    """Run the cases.

    Returns:
        Exit status: 1 where a result is outside its target.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--references", type=Path, default=REFERENCES)
    parser.add_argument("--out", type=Path, default=PAGE, help="page to write")
    parser.add_argument("--only", default="", help="part of the names of cases to run")
    options = parser.parse_args(arguments)
    groups, misses = [], []
    for heading, cases in groupby(CASES, key=lambda case: case.group):
        rows, skipped = [], []
        for case in cases:
            if options.only not in case.name:
                continue
            start = process_time()
            found = case.rows(options.references)
            if found is None:
                skipped.append(case.name)
                continue
            rows += found
            bad = [row for row in found if not row.ok]
            misses += bad
            print(
                f"{case.name:32s} {len(found):4d} comparisons, {len(bad)} outside "
                f"their target, {process_time() - start:.1f} s",
                flush=True,
            )
        groups.append((heading, rows, skipped))
    if not options.only:
        options.out.parent.mkdir(parents=True, exist_ok=True)
        options.out.write_text(page(groups))
        print(options.out)
    if misses:
        print(plain_table(misses))
    return 1 if misses else 0


if __name__ == "__main__":
    sys.exit(main())
