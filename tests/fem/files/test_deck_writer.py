"""Fields, cards and sets of the deck writer."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fem.deck.text.values import real as value_of
from fem.files.deck_writer import (
    card,
    case_set,
    id_ranges,
    real,
)

REALS = st.floats(
    allow_nan=False, allow_infinity=False, min_value=-1e30, max_value=1e30
)


@given(REALS.filter(lambda x: abs(x) > 1e-30))
def test_a_large_field_keeps_nine_digits(x):
    text = real(x, 16)
    assert len(text) <= 16
    assert "." in text
    assert value_of(text) == pytest.approx(x, rel=1e-9)


@given(REALS.filter(lambda x: abs(x) > 1e-30))
def test_a_small_field_keeps_three_digits(x):
    text = real(x, 8)
    assert len(text) <= 8
    assert value_of(text) == pytest.approx(x, rel=5e-3)


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0."), (1.0, "1."), (-0.25, "-.25"), (7.38e10, "7.38+10"), (4e-6, "4.-6")],
)
def test_reals_are_written_the_short_way(value, text):
    assert real(value, 8) == text


def test_a_number_that_is_none_is_refused():
    with pytest.raises(ValueError, match="finite"):
        real(math.nan, 8)


def test_small_fields_where_they_suffice():
    assert card("FORCE", 1, 2, 0, 1.5) == "FORCE   1       2       0       1.5"


def test_large_fields_where_precision_needs_them():
    lines = card("GRID", 1, None, -0.00123456789, 0.0, 0.0).split("\n")
    assert lines[0].startswith("GRID*")
    assert value_of(lines[0][40:56]) == -0.00123456789
    assert lines[1].startswith("*")


def test_blank_fields_at_the_end_are_dropped():
    assert card("RBE2", 1, 2, "123", None, None) == "RBE2    1       2       123"


def test_continuation_after_eight_fields():
    assert card("RBE2", *range(1, 11)).split("\n")[1] == "        9       10"


@given(st.sets(st.integers(1, 10**8 - 1), min_size=1, max_size=60))
def test_a_set_keeps_its_ids_on_short_lines(ids):
    text = case_set(7, ids)
    assert max(map(len, text.split("\n"))) <= 72
    found: set[int] = set()
    for part in text.split("=")[1].split(","):
        first, _, last = part.replace("\n", " ").partition("THRU")
        found |= set(range(int(first), int(last or first) + 1))
    assert found == ids


def test_runs_of_ids_become_ranges():
    assert id_ranges([5, 1, 2, 3, 9, 8]) == ["1 THRU 3", "5", "8", "9"]
