"""What a case says about the parts that are to be looked at. SI units, deck axes B."""

from typing import Literal, Self

from pydantic import Field, model_validator

from drake_landing.case.section import Section, number

Range = tuple[float, float]


class Within(Section):
    """Ranges of x, y, z that grids must lie in; absent: everywhere."""

    x: Range | None = None
    y: Range | None = None
    z: Range | None = None


class Beam(Section):
    """A part of the airframe that is cut at stations: wing, fuselage, ..."""

    name: str = Field(description="e.g. right wing")
    outward: Literal["aft", "fore", "starboard", "port"] = Field(
        description="where the part that is cut off lies, as seen from the cut"
    )
    first: float = number("coordinate of the first cut: along aft or starboard", "m")
    last: float = number("of the last cut", "m")
    count: int = Field(default=16, ge=2, le=200, description="number of cuts")
    within: tuple[Within, ...] = Field(
        default=(),
        description="boxes along aft, starboard and up; grids in any of them belong "
        "to the part; none: all grids beyond the cut",
    )

    @model_validator(mode="after")
    def _outward(self) -> Self:
        ahead = self.last - self.first
        if ahead == 0 or (ahead > 0) != (self.outward in ("aft", "starboard")):
            raise ValueError(
                f"first {self.first:g} and last {self.last:g}: the last cut must lie "
                f"{self.outward} of the first"
            )
        return self


class Panel(Section):
    """A point between two stiff ones, e.g. in the middle of a frame bay."""

    name: str
    grid: int = Field(description="of the panel's middle")
    beside: tuple[int, ...] = Field(
        description="grids of its neighbours on the frames", min_length=1
    )


class Parts(Section):
    """What the parts see: allowables and places. The built-in models have their own."""

    ultimate_factor: float = number(
        "margins of safety hold for stresses times this factor", "-", 1.5, gt=0, le=10
    )
    allowables: dict[int, float] = Field(
        default={},
        description="material id -> allowable stress, Pa; otherwise ST of MAT1",
    )
    beams: tuple[Beam, ...] = Field(
        default=(),
        description="cuts for section loads; without, the whole airframe is cut across "
        "span and length",
    )
    panels: tuple[Panel, ...] = Field(
        default=(), description="panel middles, beside their frames"
    )
    equipment: dict[str, int] = Field(
        default={},
        description="name and grid id of places that carry equipment: floor, rails",
    )
