"""docs/conditions.md has the tables that the program would write."""

from benchmarks import presets
from drake_landing.conditions.cs23 import CS23
from drake_landing.conditions.cs25 import CS25


def test_the_page_has_the_presets_and_the_paragraphs_of_both_rules():
    page = presets.PAGE.read_text(encoding="utf-8")
    again = presets.put(page, "conditions", list(presets.conditions()))
    again = presets.put(again, "rules_cs25", list(presets.rules(CS25)))
    again = presets.put(again, "rules_cs23", list(presets.rules(CS23)))
    assert again == page
