"""The programs on the page about landing gears run."""

import re
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs" / "gears.md"


def test_programs_find_a_load(capsys):
    programs = re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)
    assert len(programs) == 2
    for program in programs:
        exec(program, {})
        printed = capsys.readouterr().out
        assert 50.0 < float(printed.split(" kN")[0]) < 300.0


def test_modules_and_helpers_that_the_page_names_exist():
    root, text = PAGE.parents[1], PAGE.read_text()
    for module in re.findall(r"`((?:systems|drake_landing)/[\w/]+\.py)`", text):
        assert (root / module).is_file(), module
    for link in re.findall(r"\]\((\w+\.md)\)", text):
        assert (PAGE.parent / link).is_file(), link
