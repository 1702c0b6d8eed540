"""Thinned histories keep what one looks for."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from drake_landing.report.histories import thinned


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=400), st.integers(4, 60))
def test_thinned_histories_keep_ends_and_extremes(
    values: list[float], most: int
) -> None:
    y = np.array(values)
    rows = thinned(y, most)
    assert len(rows) <= most + 2 or len(rows) == len(y)
    assert (np.diff(rows) > 0).all()
    assert rows[0] == 0
    assert rows[-1] == len(y) - 1
    assert y[rows].max() == y.max()
    assert y[rows].min() == y.min()
