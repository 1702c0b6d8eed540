"""Where the basic frame of a deck points."""

from typing import Annotated, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from drake_landing.case.section import Section


def _unsigned(axis: object) -> object:
    return axis.removeprefix("+") if isinstance(axis, str) else axis


Axis = Annotated[Literal["x", "y", "z", "-x", "-y", "-z"], BeforeValidator(_unsigned)]


class Axes(Section):
    """Where the deck's basic frame points."""

    forward: Axis = Field(default="-x", description="direction of flight")
    up: Axis = Field(default="z", description="up, in level attitude")

    @model_validator(mode="after")
    def _perpendicular(self) -> Self:
        if self.forward[-1] == self.up[-1]:
            raise ValueError(
                f"forward {self.forward} and up {self.up} must be different axes"
            )
        return self
