"""Steady flight at 1 g, as a case gives it for a deck of the user's."""

from typing import Self

from pydantic import Field, model_validator

from drake_landing.case.section import Section


class Steady(Section):
    """Loads that carry the aircraft; its inertia, and its gears, balance them."""

    load: int | None = Field(
        default=None,
        gt=0,
        description="load set of the deck (LOAD, or FORCE, MOMENT, PLOAD4 ...): the "
        "external loads of steady flight, without weight",
    )
    nodes: tuple[int, ...] = Field(
        default=(),
        description="instead: grids that carry the lift, round the centre of gravity",
    )
    shares: tuple[float, ...] | None = Field(
        default=None,
        description="of each node, >= 0, tilted such that the resultant passes the "
        "centre of gravity; default equal",
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.load is None) == (not self.nodes):
            raise ValueError("steady: give either load or nodes")
        if self.shares is not None and len(self.shares) != len(self.nodes):
            raise ValueError(
                f"shares: {len(self.shares)} for {len(self.nodes)} nodes, expected one "
                "each"
            )
        return self
