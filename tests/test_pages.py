"""Tables that programs put into the documentation."""

from pathlib import Path

import pandas as pd
import pytest

from benchmarks.page import DOCS, markdown, put


def test_a_table_takes_its_place(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("# P\n<!-- a -->\nold\n<!-- end of a -->\nrest\n")
    text = markdown(pd.DataFrame({"x": [1], "y": [r"\d"]}))
    put(page, "a", text)
    put(page, "a", text)
    assert page.read_text() == (
        "# P\n<!-- a -->\n| x | y |\n| --- | --- |\n| 1 | \\d |\n"
        "<!-- end of a -->\nrest\n"
    )
    with pytest.raises(ValueError, match="0 places named 'b'"):
        put(page, "b", text)


def test_the_aircraft_page_has_every_place_and_none_is_empty() -> None:
    text = (DOCS / "aircraft.md").read_text(encoding="utf-8")
    names = (
        *("aircraft size", "aircraft mass", "element shapes", "limit load"),
        *("mode counts", "named modes", "reduction errors", "pre modes"),
        *("full modes", "stages"),
    )
    for name in names:
        start, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->"
        assert text.count(start) == text.count(end) == 1, name
        inside = text[text.index(start) + len(start) : text.index(end)]
        assert "|" in inside, f"{name} is empty"
