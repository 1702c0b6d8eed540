"""Rows as Markdown. Figures are rounded so that a repeated run writes the same page."""

from collections.abc import Iterable, Sequence
from itertools import groupby

from benchmarks.verification.row import Row

INTRODUCTION = """\
# Verification

Written by `make verify`. Every figure comes from a deck that is read, solved and
written as `python -m fem` does it. Differences are relative; those of histories and
fields are the largest one over the peak (single-precision files limit them to about
1e-7). Targets: five digits for bars, rods, masses, constraints, reduction and time
integration; 1 % for shells and solids on the same mesh and for the finest mesh of a
refinement; 1e-10 for patch tests and rigid motions; a dash marks a record only.

Where a published figure is itself rounded, coarse or at odds with its formula, it
stands in the table with a wider target, and the accurate figure beside it:

- FV12, FV16: the published frequencies are upper bounds from Ritz solutions with few
  terms, up to 1 % high; the accurate ones are Ritz solutions with 14 x 14 polynomials.
- 13T, 21T: the published peaks are 1.939 times a static value, the first mode alone;
  the accurate ones are Navier's series of a Mindlin plate with all modes.
- FV52: a solid on a supporting line yields without limit under refinement, its bending
  frequencies have no limit; on the usual mesh they are compared with another solver.
- Straight beam: the published twist 0.03208 is not what its formula gives (0.03411).
- Curved beam: plane elasticity gives 0.08857 in its plane, not 0.08734.
- Clamped plate with b/a = 5: 2.604 (a strip has 1/384), not 2.56.
- `transient_solid_shell_bar`: the OP2 file was made without the five elements CELAS1,
  CELAS2, CDAMP2, CONROD and CSHEAR of the deck: its loads add up to the mass without
  them, and it holds no results of theirs. They are left out in the comparison.
"""


def page(groups: Sequence[tuple[str, list[Row] | None, list[str]]]) -> str:
    """The whole page.

    Args:
        groups: heading, rows (None: skipped), names of skipped cases.
    """
    everything = [row for _, rows, _ in groups for row in rows or []]
    aimed = [row for row in everything if row.target is not None]
    misses = [row for row in aimed if not row.ok]
    parts = [INTRODUCTION]
    parts.append(
        f"{len(everything)} comparisons, {len(aimed)} with a target, "
        f"{len(aimed) - len(misses)} of them within it.\n"
    )
    if misses:
        parts += ["## Outside the target\n", plain_table(misses)]
    for heading, rows, skipped in groups:
        parts.append(f"## {heading}\n")
        if skipped:
            names = ", ".join(skipped)
            parts.append(f"Skipped, the reference decks are not there: {names}.\n")
        plain = [row for row in rows or [] if not row.mesh]
        refined = [row for row in rows or [] if row.mesh]
        if plain:
            parts.append(plain_table(plain))
        if refined:
            parts.append(convergence_table(refined))
    return "\n".join(parts)


def plain_table(rows: Iterable[Row]) -> str:
    """One line per row."""
    lines = [
        "| case | quantity | ours | theirs | difference | target | source |",
        "|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        name = f"{row.quantity}, {row.mesh}" if row.mesh else row.quantity
        theirs = "0" if row.theirs == 0.0 else _figure(row.theirs)
        ours = _difference(row) if row.theirs == 0.0 else _figure(row.ours)
        lines.append(
            f"| {row.case} | {name} | {ours} | {theirs} | {_difference(row)} "
            f"| {_target(row)} | {row.source} |"
        )
    return "\n".join(lines) + "\n"


def convergence_table(rows: Iterable[Row]) -> str:
    """One line per quantity: the differences mesh by mesh."""
    lines = [
        "| case | quantity | difference by mesh | ours, finest | theirs | target "
        "| source |",
        "|---|---|---|---|---|---|---|",
    ]
    for _, group in groupby(rows, key=lambda r: (r.case, r.quantity)):
        series = list(group)
        last = series[-1]
        meshes = ", ".join(f"{r.mesh}: {100 * r.difference:+.2f} %" for r in series)
        lines.append(
            f"| {last.case} | {last.quantity} | {meshes} | {_figure(last.ours)} "
            f"| {_figure(last.theirs)} | {_target(last)} | {last.source} |"
        )
    return "\n".join(lines) + "\n"


def _figure(value: float) -> str:
    return f"{value:.5g}" if value == value else "nan"


def _difference(row: Row) -> str:
    size = abs(row.difference)
    if row.target is not None and row.target <= 1e-10 and row.ok:
        return "< 1e-10" if row.target else "0"
    if size < 1e-6:
        return "< 1e-6"
    return f"{row.difference:+.1e}" if size < 1e-3 else f"{100 * row.difference:+.2f} %"


def _target(row: Row) -> str:
    if row.target is None:
        return "-"
    return f"{row.target:.0e}" if row.target < 1e-3 else f"{100 * row.target:g} %"
