"""Tables of the documentation, written by the programs that compute them.

A page holds a table between the lines `<!-- name -->` and `<!-- end of name -->`.
"""

import re
from pathlib import Path

import pandas as pd

DOCS = Path(__file__).resolve().parents[1] / "docs"


def markdown(table: pd.DataFrame) -> str:
    """A table of texts and integers as Markdown."""
    head = [list(table.columns), ["---"] * len(table.columns)]
    body = table.astype(str).to_numpy().tolist()
    return "\n".join("| " + " | ".join(row) + " |" for row in [*head, *body])


def put(page: Path, name: str, text: str) -> None:
    """Replaces a table of a page.

    Raises:
        ValueError: the page has no place of that name.
    """
    old = page.read_text(encoding="utf-8")
    place = re.compile(f"<!-- {name} -->\n.*?<!-- end of {name} -->", re.DOTALL)
    new, count = place.subn(
        lambda _: f"<!-- {name} -->\n{text}\n<!-- end of {name} -->", old
    )
    if count != 1:
        raise ValueError(f"{page}: {count} places named '{name}', expected 1")
    page.write_text(new, encoding="utf-8")
