"""What is said of axes and moments is so."""

import numpy as np
import pytest

from drake_landing.case.axes import moment_words, rotation_AB
from drake_landing.case.deck_frame import Axes

AFT, STARBOARD, UP = np.eye(3)  # in A
TURNS = {  # what turns, and whither
    "the starboard side up": (STARBOARD, UP),
    "the port side up": (-STARBOARD, UP),
    "the nose up": (-AFT, UP),
    "the nose down": (-AFT, -UP),
    "the nose to port": (-AFT, -STARBOARD),
    "the nose to starboard": (-AFT, STARBOARD),
}
SIGNED = [sign + axis for axis in "xyz" for sign in ("", "-")]


@pytest.mark.parametrize("forward", SIGNED)
def test_positive_moments_turn_as_they_say(forward: str) -> None:
    for up in (axis for axis in SIGNED if axis[-1] != forward[-1]):
        R_AB = rotation_AB(Axes.model_validate({"forward": forward, "up": up}))
        said = [text.split(" ", 1) for text in moment_words(R_AB).split(", ")]
        assert [name for name, _ in said] == ["Mx", "My", "Mz"]
        for (_, turn), axis in zip(said, R_AB.T):
            what, whither = TURNS[turn]
            assert np.cross(axis, what) @ whither == 1.0
