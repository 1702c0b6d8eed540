"""The program on the page about landing gears runs."""

import re
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs" / "gears.md"


def test_gear_put_together_by_hand_carries_a_load(capsys):
    (program,) = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
    exec(program, {})
    printed = capsys.readouterr().out
    assert 50.0 < float(printed.split(" kN")[0]) < 300.0


def test_modules_and_helpers_that_the_page_names_exist():
    root, text = PAGE.parents[1], PAGE.read_text()
    for module in re.findall(r"`((?:systems|drake_landing)/[\w/]+\.py)`", text):
        assert (root / module).is_file(), module
    for link in re.findall(r"\]\((\w+\.md)\)", text):
        assert (PAGE.parent / link).is_file(), link
