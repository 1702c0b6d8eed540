"""Long lines go on below their values, and lose nothing."""

import re

from hypothesis import given
from hypothesis import strategies as st

from drake_landing.terminal import fitted

LINE = (
    "  gears       nose            telescopic, 1 wheel, 45.0 kg, stroke 0.25 m, at 151"
)


def test_what_is_too_long_hangs_below_its_value() -> None:
    assert fitted(LINE, 100) == LINE
    first, second = fitted(LINE, 60).split("\n")
    assert first == "  gears       nose            telescopic, 1 wheel, 45.0 kg,"
    assert second == "              stroke 0.25 m, at 151"


@given(st.text(st.sampled_from("ab,.- \n"), max_size=300), st.integers(20, 120))
def test_no_word_is_lost(text: str, width: int) -> None:
    found = fitted(text, width)
    assert found.split() == text.split()
    for line in found.split("\n"):
        # A word may be longer than the terminal, with what it hangs below.
        assert len(line) <= width or len(re.findall(r"\S+", line)) == 1
