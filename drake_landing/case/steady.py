"""Steady flight at 1 g, as a case gives it for a deck of the user's."""

from typing import Self

from pydantic import Field, model_validator

from drake_landing.case.section import Section
from drake_landing.input_paths import InputPath


class Steady(Section):
    """Loads that carry the aircraft; its inertia, and its gears, balance them."""

    load: int | None = Field(
        default=None,
        gt=0,
        description="load set of the deck (LOAD, or FORCE, MOMENT, PLOAD4 ...): the "
        "external loads of steady flight, without weight; of `file` where one is given",
    )
    file: InputPath | None = Field(
        default=None,
        description="instead: a file of FORCE and MOMENT in the units of the deck, "
        "relative to the case file; with `load` one of its sets, else all of it",
    )
    nodes: tuple[int, ...] = Field(
        default=(),
        description="instead: grids that carry the lift, round the center of gravity",
    )
    shares: tuple[float, ...] | None = Field(
        default=None,
        description="of each node, >= 0, tilted such that the resultant passes the "
        "center of gravity; default equal",
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.load is None and self.file is None) == (not self.nodes):
            raise ValueError("steady: give either load, file or nodes")
        if self.shares is not None and len(self.shares) != len(self.nodes):
            raise ValueError(
                f"shares: {len(self.shares)} for {len(self.nodes)} nodes, expected one "
                "each"
            )
        return self
