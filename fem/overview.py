"""What `fem` reads and writes, as a page section made from the program's own tables.

`python -m fem.overview docs/fem.md` puts the section between the marks of the page; a
test keeps both alike.
"""

import sys
from pathlib import Path

from fem.deck.catalogue import PASSED_OVER
from fem.deck.control.case_command_names import QUANTITIES
from fem.deck.control.param_names import DEFAULTS
from fem.deck.records import CARDS, Result, results
from fem.deck.unsupported import SUPPORTED
from fem.solution.options import WRITTEN

BEGIN, END = "<!-- tables: python -m fem.overview -->", "<!-- end of tables -->"


def groups() -> dict[str, list[str]]:
    """Supported cards by group."""
    found: dict[str, list[str]] = {card.group: [] for card in CARDS.values()}
    for name in SUPPORTED:
        found["Other" if name == "PARAM" else CARDS[name].group].append(name)
    return found


def _results() -> list[str]:
    """Rows of the tables of results; cards with like results share one."""
    rows: dict[Result, list[str]] = {}
    for card, result in results():
        rows.setdefault(result, []).append(card.name + result.table)
    return [
        _row(
            ", ".join(tables),
            ", ".join(result.kinds),
            " ".join(result.columns),
            result.remark,
        )
        for result, tables in rows.items()
    ]


def section() -> str:
    """Markdown of the section."""
    params = ", ".join(f"{name} {_short(DEFAULTS[name])}" for name in sorted(DEFAULTS))
    asked = list(dict.fromkeys(QUANTITIES.values()))
    missing = [name for name in asked if "yes" not in _marks(name)]
    return "\n".join(
        [
            "### Cards that are used",
            "",
            *_table("for", "cards"),
            *(_row(name, ", ".join(cards)) for name, cards in groups().items()),
            "",
            "### Cards that are passed over with a notice",
            "",
            *_table("for", "cards"),
            *(_row(name, ", ".join(cards)) for name, cards in PASSED_OVER.items()),
            "",
            "### Parameters that are used, with their defaults",
            "",
            f"{params}.",
            "",
            "### Requests of case control",
            "",
            *_table("request", "SOL 101", "103", "105", "108, 111", "109, 112"),
            *(_row(name, *_marks(name)) for name in asked if "yes" in _marks(name)),
            "",
            f"Not written, and said so: {', '.join(missing)}.",
            "",
            "### Element results in the file",
            "",
            *_table("table", "kinds", "columns", "remark"),
            *_results(),
        ]
    )


def _table(*heads: str) -> list[str]:
    return [_row(*heads), "|" + "---|" * len(heads)]


def _row(*cells: str) -> str:
    return f"| {' | '.join(cells)} |"


def _marks(quantity: str) -> list[str]:
    return ["yes" if quantity in WRITTEN[n] else "-" for n in (101, 103, 105, 108, 109)]


def _short(value: int | float | str) -> str:
    return value if isinstance(value, str) else f"{value:g}"


def with_section(page: str) -> str:
    """A page with the section between its marks.

    Raises:
        ValueError: the page has no marks.
    """
    head, mark, rest = page.partition(BEGIN)
    _, end, tail = rest.partition(END)
    if not (mark and end):
        raise ValueError(f"the page lacks the marks {BEGIN} and {END}")
    return f"{head}{BEGIN}\n{section()}\n{END}{tail}"


if __name__ == "__main__":
    target = Path(sys.argv[1])
    target.write_text(
        with_section(target.read_text(encoding="utf-8")), encoding="utf-8"
    )
