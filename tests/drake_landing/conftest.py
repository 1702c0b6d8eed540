"""Fixtures for tests of whole runs."""

from typing import TextIO

import pytest
from matplotlib.figure import Figure


@pytest.fixture
def blank_curves(monkeypatch: pytest.MonkeyPatch) -> None:
    """Reports without curves and pictures, which take more time than a short run.

    For tests whose claim is not the look of the report.
    """

    def blank(figure: Figure, out: TextIO, **_: object) -> None:
        out.write('<svg width="1pt" height="1pt"></svg>')

    monkeypatch.setattr(Figure, "savefig", blank)
    monkeypatch.setenv("DRAKE_LANDING_PICTURES", "off")
