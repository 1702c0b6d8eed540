"""A campaign file: a base case, what varies, what is confirmed; validated.

    name: hard_landings
    base: case.yaml
    axes:
      scenario.preset: [two_point, tail_down]
      scenario.sink_rate: {from: 1.0, to: 3.0, count: 5}
      scenario.pitch: {distribution: norm, values: {loc: 3, scale: 1}, low: 0, high: 8}
      gears.main_*.shock_absorber.precharge_force: {scale: [0.9, 1.0, 1.1]}
    samples: 20

Axes with values are combined with each other; those with a distribution are sampled
together (latin hypercube), `samples` times for every combination.
"""

import math
from typing import Annotated, Self

from pydantic import (
    Field,
    model_validator,
)

from drake_landing.campaign.axes import Axis, Distribution, combined_values
from drake_landing.case.labels import OneLine
from drake_landing.case.section import Document, Section, number
from drake_landing.input_paths import InputFile

MOST = 200_000  # cases; more would be described for an hour before the first flies
_PATH = r"^[A-Za-z_][\w*]*(\.[\w*-]+)+$"


class Table(Section):
    """Rows of measured values that belong together, drawn at random."""

    file: InputFile = Field(
        description="CSV with a header, relative to the campaign file"
    )
    columns: dict[str, str] = Field(
        min_length=1, description="column of the file -> field of the case"
    )
    source: OneLine = Field(description="where the rows come from")


class Confirm(Section):
    """The direct transient of chosen landings."""

    sample: int = Field(
        default=8,
        ge=0,
        description="landings drawn at random: their direct transients measure the "
        "error of the screening",
    )
    most: int = Field(
        default=64, ge=0, description="landings confirmed beside the sample, at most"
    )
    block: int = Field(
        default=32, ge=1, le=256, description="landings in one transient, at most"
    )
    confidence: float = number(
        "of the screening error that decides what is confirmed", "1", 0.99, gt=0, lt=1
    )
    tail: float = number(
        "how long a transient goes on after the last screened peak that decides",
        "s",
        0.05,
        ge=0,
    )


class Fatigue(Section):
    """Miner damage by an S-N curve of the user's own, N = (reference / range)^slope."""

    reference_stress: float = number("stress range at one cycle to failure", "Pa", gt=0)
    slope: float = number("of the S-N curve, log N over log range", "1", gt=0, le=50)
    endurance: float = number("ranges below do no damage", "Pa", 0.0, ge=0)
    source: OneLine = Field(description="where the curve comes from")


class Campaign(Document):
    """Many landings of one aircraft."""

    name: str = Field(
        pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,79}$",
        description="names the campaign and its folder: letters, digits, . _ -",
    )
    title: OneLine = Field(default="", description="one line for the page")
    base: InputFile = Field(description="case file, relative to the campaign file")
    axes: dict[Annotated[str, Field(pattern=_PATH)], Axis] = Field(
        default={},
        description="field of the case, with * for any name in a list -> its values",
    )
    table: Table | None = Field(
        default=None, description="rows of measured touchdowns, drawn at random"
    )
    samples: int = Field(
        default=0,
        ge=0,
        le=1_000_000,
        description="of the axes with a distribution and of the table, for each "
        "combination of the others",
    )
    seed: int = Field(default=0, ge=0, description="of all that is drawn at random")
    confirm: Confirm = Confirm()
    fatigue: Fatigue | None = Field(default=None, description="damage per component")
    elements_per_group: int = Field(
        default=3,
        ge=1,
        le=100,
        description="elements of a component whose histories are counted for fatigue",
    )

    @model_validator(mode="after")
    def _sampled(self) -> Self:
        drawn = [p for p, a in self.axes.items() if isinstance(a, Distribution)]
        if (drawn or self.table) and not self.samples:
            what = ", ".join([*drawn, *(["the table"] if self.table else [])])
            raise ValueError(f"samples: found 0, expected how often to draw {what}")
        if self.samples and not (drawn or self.table):
            raise ValueError(
                f"samples: found {self.samples}, but no axis has a distribution"
            )
        if not self.axes and self.table is None:
            raise ValueError("axes: found none, expected at least one, or a table")
        counts = [len(combined_values(axis)) or 1 for axis in self.axes.values()]
        cases = math.prod(counts) * max(self.samples, 1)
        if cases > MOST:
            factors = [f"{n}" for n in [*counts, self.samples] if n > 1]
            raise ValueError(
                f"axes: found {' x '.join(factors)} = {cases} cases, expected at most "
                f"{MOST}"
            )
        return self
