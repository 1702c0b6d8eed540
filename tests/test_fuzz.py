"""A fast share of `make fuzz`."""

from benchmarks.fuzz.__main__ import main


def test_damaged_files_give_a_message_or_an_answer(capsys):
    assert main(3.0, 1000) == 0, capsys.readouterr().out
