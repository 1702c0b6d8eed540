"""What `run` would refuse in `parts` of a case, `check` says, all of it at once."""

import pytest

from drake_landing.process.explain import explain
from fem.errors import InputError
from tests.drake_landing.one_aircraft import SI, case_of

PARTS = """
parts:
  allowables: {999: 3.0e+8}
  components: {wing: {properties: [998]}}
  beams:
    - {name: inward, outward: starboard, first: 3.0, last: 1.0, count: 3}
    - {name: nowhere, outward: starboard, first: 1.0, last: 3.0, count: 3, grid: 997}
  equipment: {radio: 996}
"""


def test_check_refuses_parts_that_the_deck_does_not_have(tmp_path):
    case = case_of(tmp_path, SI, ("name: one\n", "name: one" + PARTS))
    with pytest.raises(InputError) as caught:
        explain(case, tmp_path)
    found = sorted(caught.value.problems)
    expected = (
        "grid 996 is not in", "grid 997 is not in", "must lie starboard of the first",
        "the deck has no material 999", "found 998, no element of the deck has it",
    )  # fmt: skip
    assert len(found) == len(expected)
    for words in expected:
        assert sum(words in text for text in found) == 1
    assert all(text.startswith("case.yaml:") for text in found)
