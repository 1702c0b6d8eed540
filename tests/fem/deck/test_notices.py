"""Many notices of one kind are one line."""

from fem.errors import by_kind

CW = [f"PBEAM {i} (wing.bdf:{i + 7}): warping (CW) is ignored" for i in range(296)]


def test_notices_of_one_kind_are_one_line_with_their_number() -> None:
    assert by_kind(["first", *CW, "last", "first"]) == [
        "first",
        f"{CW[0]} (and 295 more of this kind)",
        "last",
    ]


def test_few_notices_and_other_kinds_are_told_one_by_one() -> None:
    few = [*CW[:3], "PBEAM 3 (wing.bdf:9): shear relief S1, S2 is ignored"]
    assert by_kind(few) == few
    assert by_kind([]) == []
