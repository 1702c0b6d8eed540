"""What a case says about the parts that are to be looked at. SI units, deck axes B."""

from typing import Literal

from pydantic import Field

from drake_landing.case.labels import Label
from drake_landing.case.section import Section, number

Range = tuple[float, float]
Span = tuple[int, int]


class Within(Section):
    """Ranges of x, y, z of the deck that grids must lie in; absent: everywhere."""

    x: Range | None = None
    y: Range | None = None
    z: Range | None = None


class Beam(Section):
    """A part of the airframe that is cut at stations: wing, fuselage, ...

    All coordinates are those of the deck's basic frame.
    """

    name: Label = Field(description="e.g. right wing")
    outward: Literal["aft", "fore", "starboard", "port", "up", "down"] = Field(
        description="where the part that is cut off lies, as seen from the cut"
    )
    first: float = number(
        "coordinate of the first cut along the deck's axis that points aft, to "
        "starboard or up, or against it",
        "m",
    )
    last: float = number("of the last cut", "m")
    count: int = Field(default=16, ge=2, le=200, description="number of cuts")
    grid: int | None = Field(
        default=None,
        description="a grid of the part beyond its last cut: of what the cuts take "
        "off, the connected piece that holds this grid belongs to the part",
    )
    within: tuple[Within, ...] = Field(
        default=(),
        description="boxes; grids in any of them belong to the part. Without boxes and "
        "grid every connected piece beyond the cuts is a part of its own",
    )
    line: tuple[tuple[float, float, float], ...] | None = Field(
        default=None,
        min_length=1,
        description="points of a line that moments refer to, where it meets the cuts; "
        "without, the EA-weighted center of the elements that cross",
    )


class Component(Section):
    """Elements that belong to a component: those that fit any of these."""

    properties: tuple[int | Span, ...] = Field(
        default=(), description="property ids, or [first, last]"
    )
    elements: tuple[int | Span, ...] = Field(
        default=(), description="element ids, or [first, last]"
    )
    sets: tuple[int, ...] = Field(default=(), description="SET1 of element ids")
    materials: tuple[int, ...] = Field(default=(), description="material ids")
    files: tuple[str, ...] = Field(
        default=(), description="names of files whose elements they are, INCLUDE"
    )


class Panel(Section):
    """A point between two stiff ones, e.g. in the middle of a frame bay."""

    name: Label
    grid: int = Field(description="of the panel's middle")
    beside: tuple[int, ...] = Field(
        description="grids of its neighbours on the frames", min_length=1
    )


class Parts(Section):
    """Allowables and places of the parts. The built-in models have their own."""

    ultimate_factor: float = number(
        "margins of safety hold for stresses times this factor", "-", 1.5, gt=0, le=10
    )
    buckling: int = Field(
        default=0,
        ge=0,
        le=50,
        description="how many panels are sought that buckle first: load factors of the "
        "static cases of the instants when a gear's load is extreme; 0: none",
    )
    allowables: dict[int, float] = Field(
        default={},
        description="material id -> allowable stress, Pa; otherwise ST of MAT1",
    )
    components: dict[Label, Component] = Field(
        default={},
        description="name -> what belongs to it; of several that fit an element the "
        "first has it. The rest is named by groups of the deck's program, banners, "
        "INCLUDE files, kinds of elements",
    )
    beams: tuple[Beam, ...] = Field(
        default=(),
        description="cuts for section loads; without, every part that stands out of "
        "the airframe is cut",
    )
    panels: tuple[Panel, ...] = Field(
        default=(), description="panel middles, beside their frames"
    )
    equipment: dict[Label, int] = Field(
        default={},
        description="name and grid id of places that carry equipment: floor, rails",
    )
