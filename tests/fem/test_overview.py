"""The page for Nastran users says what the program does."""

from pathlib import Path

import h5py
import pytest

import fem
from fem.deck.unsupported import SUPPORTED
from fem.overview import groups, with_section
from fem.solution import run_deck

PAGE = Path(__file__).parents[2] / "docs" / "fem.md"


def test_the_page_is_up_to_date():
    """Else: python -m fem.overview docs/fem.md."""
    text = PAGE.read_text(encoding="utf-8")
    assert with_section(text) == text


def test_each_supported_card_has_one_group():
    cards = [card for group in groups().values() for card in group]
    assert len(cards) == len(set(cards)) == len(SUPPORTED)
    assert all(groups().values())


def test_a_page_without_marks_is_refused():
    with pytest.raises(ValueError, match="lacks the marks"):
        with_section("nothing")


def test_columns_on_the_page_are_those_of_result_files(references, tmp_path):
    """Every table of a mixed deck has a row with the beginning of its columns."""
    rows = [
        line.split(" | ")
        for line in PAGE.read_text(encoding="utf-8").splitlines()
        if "|" in line
    ]
    deck = fem.read_deck(
        references / "solid_shell_bar" / "transient_solid_shell_bar.bdf"
    )
    seen = 0
    with h5py.File(run_deck(deck, tmp_path / "a.h5")) as file:
        for kind in ("force", "stress"):
            for name, group in file[f"transient/1/element_{kind}"].items():
                found = [
                    row[2].split()
                    for row in rows
                    if name in row[0].strip("| ").split(", ") and kind in row[1]
                ]
                assert found, name
                columns = [str(c) for c in group.attrs["columns"]]
                width = min(len(found[0]), len(columns))
                listed = found[0][:width]
                assert columns[:width] == listed or columns[0] in found[0], name
                seen += 1
    assert seen > 15
