"""Names in few characters."""

from hypothesis import given, settings
from hypothesis import strategies as st

from drake_landing.conditions.labels import labels

WAYS = ("(i) held at the axle", "(ii) by inertia")
WIDTH = 60
TOWED = "two flat: 25.509 towed at main gears, forward at 30° to starboard"


def test_pairs_that_differ_at_the_end_stay_apart():
    found = labels([f"{TOWED}, {way}" for way in WAYS], WIDTH)
    assert found[0].endswith("fwd at 30 deg to stbd, (i) axle")
    assert found[1] == "two flat: 25.509 tow mains, fwd 30 deg to stbd, (ii) inertia"
    assert not any(".." in text for text in found)
    assert max(map(len, found)) <= WIDTH


def test_short_names_stay_as_they_are():
    assert labels(["turn, load to starboard"], 60) == ["turn, load to starboard"]


@settings(max_examples=30)
@given(st.lists(st.text("ab", min_size=1, max_size=60), unique=True, max_size=30))
def test_names_that_differ_stay_different(names: list[str]):
    found = labels(names, 20)
    assert len({text.upper() for text in found}) == len(names)
    assert all(len(text) <= 20 for text in found)
