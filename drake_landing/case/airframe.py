"""The airframe of a case: a deck, a built-in aircraft or matrices, and its modes."""

from typing import Literal, Self

from pydantic import (
    Field,
    field_validator,
    model_validator,
)

from drake_landing.case.chord import Chord
from drake_landing.case.damping import AirframeDamping
from drake_landing.case.deck_frame import Axes
from drake_landing.case.labels import Label, LineOrNumber, OneLine
from drake_landing.case.mass_cases import MassCase, mass_case_of
from drake_landing.case.mode_selection import Selection, SelectionText
from drake_landing.case.section import Section, number
from drake_landing.case.steady import Steady
from drake_landing.input_paths import InputPath
from drake_landing.parametric import registered
from fem.deck.text.source import include_reach
from fem.errors import nearest

UnitSystem = Literal["SI", "mm-t-N", "in-lbf"]
Basis = Literal["full-modes", "craig-bampton", "guyan"]


class Matrices(Section):
    """Reduced matrices of the user's own, instead of a deck: basic frame."""

    files: tuple[InputPath, ...] = Field(
        description="DMIG (punch), OUTPUT4 or HDF5 of MSC Nastran, relative to the "
        "case file",
        min_length=1,
    )
    grids: InputPath = Field(
        description="CSV table of the interface grids in the order of the matrices: "
        "id, x, y, z [, components]",
    )
    stiffness: OneLine = Field(default="KRED", description="name of K")
    mass: OneLine = Field(default="MRED", description="name of M")
    damping: OneLine = Field(default="BRED", description="name of B; may be absent")
    recovery: OneLine = Field(
        default="RRED",
        description="name of the motion of grids without components",
    )


class Airframe(Section):
    """The airframe's finite-element model and its modal body."""

    model: str | None = Field(
        default=None,
        description="a parametric aircraft, instead of `deck`: con, pre or full, the "
        "reference aircraft, or one that another package registers",
        json_schema_extra={"examples": list(registered())},
    )
    topology: LineOrNumber | None = Field(
        default=None,
        description="how the built-in model holds its gears: 1, 2 or distributed, by "
        "default the model's first; for a deck a mere label of the result tables",
        json_schema_extra={
            "anyOf": [{"type": t} for t in ("string", "integer", "null")]
        },
    )
    deck: InputPath | None = Field(
        default=None,
        description="Nastran bulk-data file, relative to the case file",
    )
    units: UnitSystem = Field(
        default="SI",
        description="units of the deck, or of the matrices: SI (m, kg, N), mm-t-N, or "
        "in-lbf (mass in lbf s²/in); all else in a case, gears included, is SI",
    )
    ignore: tuple[str, ...] = Field(
        default=(),
        description="cards of the deck to go on without: unsupported ones, or SPC1 of "
        "its own solution, which would hold an aircraft that should fly",
    )
    matrices: Matrices | None = Field(
        default=None,
        description="reduced matrices and their grids, instead of `deck`; the direct "
        "transient then runs on these",
    )
    axes: Axes = Field(default=Axes(), description="axes of the deck's basic frame")
    basis: Basis = Field(
        default="full-modes",
        description="reduction before the eigenmodes: full-modes (none), guyan, "
        "craig-bampton",
    )
    interface: tuple[int, ...] = Field(
        default=(),
        description="grids that a reduction keeps, beside the attachment nodes, the "
        "monitoring points and the deck's ASET",
    )
    fixed_interface_modes: SelectionText = Field(
        default=Selection(kind="below", value=150.0),
        json_schema_extra={"default": "below 150 Hz"},
        description="generalised coordinates of craig-bampton: count N, below F Hz",
    )
    select: SelectionText = Field(
        default=Selection(kind="below", value=50.0),
        json_schema_extra={"default": "below 50 Hz"},
        description="elastic modes of the multibody model: count N, below F Hz, all; "
        "relevance N, relevance error <= x %: those that the gears excite and the "
        "monitoring points feel most; pulses N: shapes combined from these",
    )
    candidates: float = number(
        "modes below this frequency are candidates where relevance selects",
        "Hz",
        260.0,
        gt=0,
        le=5000,
    )
    include_paths: tuple[InputPath, ...] = Field(
        default=(),
        description="folders that INCLUDE of the deck may read, beside its own",
    )
    damping: AirframeDamping | None = Field(
        default=None,
        description="damping beside the deck's, or instead of it; default: the deck's",
    )
    residual_vectors: bool = Field(
        default=False,
        description="add the static responses to loads at the attachment nodes that "
        "the selected modes lack (attachment modes); their high frequencies make the "
        "multibody run slower",
    )
    monitoring: dict[Label, int] = Field(
        default={},
        description="monitoring points: name and grid id; the built-in models have "
        "their own",
    )

    mass_cases: dict[Label, MassCase] = Field(
        default={},
        description="name -> what a loading of the airframe adds to its point masses, "
        "or takes from them",
    )
    mass_case: str | None = Field(
        default=None,
        description="which of mass_cases, or a MASSSET of the deck, by the labels of "
        "its BEGIN MASSID sections or as MASSSET 11; default the deck as it is. In a "
        "campaign an axis like others: airframe.mass_case: [full, empty]",
    )
    mac: Chord | None = Field(
        default=None,
        description="mean aerodynamic chord; centers of gravity are given in % of it",
    )
    steady: Steady | None = Field(
        default=None,
        description="steady flight at 1 g of a deck of the user's: stresses upon which "
        "margins are formed; the built-in models have their own",
    )

    @field_validator("model", mode="after")
    @classmethod
    def _registered(cls, model: str | None) -> str | None:
        if model is not None and model not in registered():
            names = registered()
            raise ValueError(
                f"found '{model}', expected one of {', '.join(names)}"
                + nearest(model, names)
            )
        return model

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        given = [x is not None for x in (self.model, self.deck, self.matrices)]
        if sum(given) != 1:
            names = ", ".join(registered())
            raise ValueError(
                f"give one of `model` ({names}), `deck` (a file) or `matrices`"
            )
        if self.mass_case and not self.matrices:
            with include_reach(self.include_paths):
                mass_case_of(self.mass_case, self.mass_cases, self.deck)
        if self.mass_case and self.matrices:
            raise ValueError("mass_case: found one with `matrices`, expected `deck`")
        if self.steady and self.model:
            raise ValueError(
                "steady: found one beside `model`, expected none: built-in models have "
                "their own"
            )
        if self.units != "SI" and self.model:
            raise ValueError(
                f"units: found {self.units}, expected SI: built-in models are in SI"
            )
        if self.fixed_interface_modes.by_relevance:
            raise ValueError(
                f"fixed_interface_modes: found '{self.fixed_interface_modes}', "
                "expected 'count N', 'below F Hz' or 'all'; relevance is for `select`"
            )
        if not self.model and not self.monitoring:
            raise ValueError(
                "a deck or matrices need `monitoring` points: name and grid id"
            )
        return self
