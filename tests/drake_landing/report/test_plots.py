"""Axes of pictures say enough numbers to be read."""

import re

import pytest

from drake_landing.report.svg_plots import panels, svg


@pytest.mark.parametrize(
    ("limits", "numbers"),
    [
        ((2.0, 200.0), {"2", "5", "10", "20", "50", "100", "200"}),
        ((30.0, 80.0), {"30", "40", "50", "60", "70", "80"}),
        ((1.0, 1e5), {"1", "10", "100", "1000", "10000", "100000"}),
    ],
)
def test_logarithmic_axes_have_numbers(limits, numbers: set[str]) -> None:
    with panels(1, 1) as (figure, grid):
        grid[0][0].set_xscale("log")
        grid[0][0].set_xlim(*limits)
        grid[0][0].set_yticks([])
        drawn = svg(figure, "logarithmic")
    assert set(re.findall(r"<text [^>]*>([\d.e+]+)</text>", drawn)) == numbers
