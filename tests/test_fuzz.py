"""A fast share of `make fuzz`."""

import pytest

from benchmarks.fuzz.__main__ import fuzz

COUNTS = {"matrices": 60, "decks": 25, "campaigns": 12}


@pytest.mark.timeout(300)
@pytest.mark.parametrize(("kind", "count"), COUNTS.items(), ids=COUNTS)
def test_damaged_files_give_a_message_or_an_answer(kind, count, capsys):
    assert fuzz(200.0, 1000, [kind], count) == 0, capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.timeout(300)
@pytest.mark.parametrize("kind", ["cases", "cpacs"])
def test_damaged_files_of_slower_kinds(kind, capsys):
    assert fuzz(200.0, 1000, [kind], 10) == 0, capsys.readouterr().out
