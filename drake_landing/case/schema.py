"""A landing case: everything that one run of the process depends on, validated.

Every field says its meaning, unit and range; `reading` reads it from YAML and reports
problems with their line, `drake-landing check --schema` prints it as a JSON schema.
Lengths in m, speeds in m/s, angles in degrees, times in s.
"""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import (
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    PlainSerializer,
    PrivateAttr,
    Tag,
    ValidationInfo,
    WithJsonSchema,
    field_validator,
    model_validator,
)

from drake_landing.case.bushing import Bushing
from drake_landing.case.chord import Chord
from drake_landing.case.conditions import Conditions
from drake_landing.case.damping import AirframeDamping
from drake_landing.case.deck_frame import Axes
from drake_landing.case.design_values import with_design_values
from drake_landing.case.field_lines import Places
from drake_landing.case.labels import Label, OneLine
from drake_landing.case.mass_cases import MassCase, mass_case_of
from drake_landing.case.parts import Parts
from drake_landing.case.scenario import Scenario as Scenario
from drake_landing.case.section import Section, number
from drake_landing.case.steady import Steady
from drake_landing.files import relative_to_case
from drake_landing.gears.data import AnyGear
from drake_landing.integrators import DEFAULT, Integrator
from drake_landing.parametric import registered
from fem.deck.source import include_reach
from fem.errors import nearest

UnitSystem = Literal["SI", "mm-t-N", "in-lbf"]
Basis = Literal["full-modes", "craig-bampton", "guyan"]
_SELECTION = (
    r"^\s*(?:(all)|count\s+(\d+)|below\s+(\d+(?:\.\d*)?)\s*Hz|relevance\s+(\d+)"
    r"|relevance\s+error\s*<=\s*(\d+(?:\.\d*)?)\s*%|pulses\s+(\d+))\s*$"
)


# The name of a known set, or a list; tags are in parentheses, see `reading`.
Gears = Annotated[
    Annotated[Literal["d150", "d150-paper"], Tag("(name)")]
    | Annotated[tuple[AnyGear, ...], Tag("(list)")],
    Discriminator(lambda value: "(name)" if isinstance(value, str) else "(list)"),
]


class Selection(Section):
    """Which elastic modes: all, the lowest, those below a frequency, or those that
    matter most under the gears' pulses: so many of them, or as many as an error needs;
    or shapes that are combined from them for these pulses.
    """

    kind: Literal["all", "count", "below", "relevance", "error", "pulses"]
    value: float = 0.0  # number of modes, Hz, or %

    def __str__(self) -> str:
        value = f"{self.value:g}"
        return {
            "all": "all",
            "below": f"below {value} Hz",
            "error": f"relevance error <= {value} %",
        }.get(self.kind, f"{self.kind} {value}")

    @property
    def by_relevance(self) -> bool:
        """The modes come from candidates, see `relevance` and `pulse_modes`."""
        return self.kind in ("relevance", "error", "pulses")


def parse_selection(text: Any) -> Any:
    """`all`, `count N`, `below F Hz`, `relevance N` or `error <= x %`, `pulses N`."""
    if isinstance(text, Selection):
        return text
    match = re.match(_SELECTION, text) if isinstance(text, str) else None
    if match is None:
        raise ValueError(
            "expected 'count N', 'below F Hz', 'all', 'relevance N', "
            "'relevance error <= x %' or 'pulses N'"
        )
    kinds = ("all", "count", "below", "relevance", "error", "pulses")
    kind, value = next((k, v) for k, v in zip(kinds, match.groups()) if v)
    return Selection(kind=kind, value=0.0 if kind == "all" else float(value))


SelectionText = Annotated[
    Selection,
    BeforeValidator(parse_selection),
    PlainSerializer(str),
    WithJsonSchema({"type": "string", "pattern": _SELECTION}),
]


class Matrices(Section):
    """Reduced matrices of the user's own, instead of a deck: basic frame."""

    files: tuple[Path, ...] = Field(
        description="DMIG (punch), OUTPUT4 or HDF5 of MSC Nastran, relative to the "
        "case file",
        min_length=1,
    )
    grids: Path = Field(
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

    @field_validator("files", "grids", mode="after")
    @classmethod
    def _relative_to_case(cls, found: Any, info: ValidationInfo) -> Any:
        return relative_to_case(found, info.context)


class Airframe(Section):
    """The airframe's finite-element model and its modal body."""

    model: str | None = Field(
        default=None,
        description="a parametric aircraft, instead of `deck`: con, pre or full, the "
        "reference aircraft, or one that another package registers",
        json_schema_extra={"examples": list(registered())},
    )
    topology: OneLine | None = Field(
        default=None,
        description="how the built-in model holds its gears: 1, 2 or distributed, by "
        "default the model's first; for a deck a mere label of the result tables",
        coerce_numbers_to_str=True,
        json_schema_extra={
            "anyOf": [{"type": t} for t in ("string", "integer", "null")]
        },
    )
    deck: Path | None = Field(
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
    include_paths: tuple[Path, ...] = Field(
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

    @field_validator("deck", "include_paths", mode="after")
    @classmethod
    def _relative_to_case(cls, found: Any, info: ValidationInfo) -> Any:
        return relative_to_case(found, info.context)

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


Duration = Annotated[
    Annotated[Literal["auto"], Tag("(name)")]
    | Annotated[float, Field(gt=0, le=60), Tag("(number)")],
    Discriminator(lambda value: "(name)" if isinstance(value, str) else "(number)"),
]


class Simulation(Section):
    """The multibody run."""

    duration: Duration = Field(
        default="auto",
        description="from just above touchdown, s, > 0 and <= 60; auto: until the last "
        "swing of the airframe brings no extreme of loads, accelerations, section "
        "loads or stresses any more, at most 5 s",
    )
    integrator: Integrator = Field(
        default=DEFAULT, description="Drake's integration scheme"
    )
    accuracy: float = number(
        "error control of the integrator; 1e-3 keeps peak loads within 0.1 %",
        "in units of the state",
        1e-3,
        gt=0,
        le=1e-2,
    )
    max_step: float = number("largest step", "s", 5e-3, ge=1e-9, le=0.1)
    slow_modes_above: float | None = Field(
        default=None,
        gt=0,
        description="Hz; faster modes follow the loads by flexibility and damping "
        "alone, which allows far larger steps; default: none do",
    )
    clearance: float = number(
        "height of the lowest tire over the runway at start", "m", 5e-3, gt=0, le=1
    )


class Transient(Section):
    """The direct transient response of the full model."""

    step: float = number("time step", "s", 5e-4, ge=1e-6, le=0.01)
    accept: float = number(
        "error of peak accelerations through the step that is accepted; more than 10 "
        "is refused without it",
        "%",
        10.0,
        gt=0,
        le=100,
    )
    scheme: Literal["nastran", "generalised-alpha"] = Field(
        default="nastran", description="time integration"
    )
    duration: float | None = Field(
        default=None, gt=0, le=60, description="s; default: that of the simulation"
    )


def _named_schema(schema: dict[str, Any]) -> None:
    """Case files may name the schema that editors check them against."""
    named = {"type": "string", "description": "where editors find this schema"}
    schema["properties"] = {"$schema": named, **schema["properties"]}


class Case(Section):
    """One landing, from the deck to the comparison."""

    model_config = ConfigDict(json_schema_extra=_named_schema)

    name: str = Field(
        pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,79}$",
        description="names the run and its folder: letters, digits, . _ -",
    )
    title: OneLine = Field(default="", description="one line for the report")
    airframe: Airframe
    gears: Gears = Field(
        default="d150",
        description="list of landing gears, or d150: those of the reference aircraft; "
        "d150-paper: the same with the simpler laws of the paper's studies",
    )
    bushing: Bushing | None = Field(
        default=None,
        description="elastic fittings between gears and airframe; default none: held "
        "without play",
    )
    scenario: Scenario
    simulation: Simulation = Simulation()
    transient: Transient = Transient()
    parts: Parts = Parts()
    conditions: Conditions = Conditions()
    _places: Places = PrivateAttr(default=Places())

    @property
    def places(self) -> Places:
        """Where its fields were written."""
        return self._places

    @contextmanager
    def reading(self) -> Iterator[None]:
        """Errors within say file and line; INCLUDE reaches what the case adds."""
        with self.places.located(), include_reach(self.airframe.include_paths):
            yield

    def written_at(self, places: Places) -> Self:
        """The same case, with the places of its fields."""
        case = self.model_copy()
        case._places = places
        return case

    @model_validator(mode="before")
    @classmethod
    def _design_values(cls, data: Any) -> Any:
        return with_design_values(data)

    @model_validator(mode="after")
    def _bushing_in_flight(self) -> Self:
        if self.bushing and self.scenario.gravity:
            raise ValueError(
                "bushing: found one where gravity acts, expected lift: equal: states "
                "of rest are found with gears that are held without play"
            )
        return self

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if isinstance(self.gears, str):
            if not self.airframe.model:
                raise ValueError(
                    "gears: a deck of your own needs its list of gears; d150 belongs "
                    "to the built-in models"
                )
            return self
        names = [gear.name for gear in self.gears]
        if not names:
            raise ValueError("gears: at least one landing gear is needed")
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise ValueError(f"gears: name {', '.join(twice)} is used more than once")
        return self

    def transient_duration(self, landing: float) -> float:
        """Of the direct transient response, s: never beyond the landing's."""
        return min(self.transient.duration or landing, landing)
