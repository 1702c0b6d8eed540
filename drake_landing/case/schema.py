"""A landing case: everything that one run of the process depends on, validated.

Every field says its meaning, unit and range; `reading` reads it from YAML and reports
problems with their line, `drake-landing check --schema` prints it as a JSON schema.
Lengths in m, speeds in m/s, angles in degrees, times in s.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, Any, Literal, Self

from pydantic import (
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    model_validator,
)

from drake_landing.case.airframe import Airframe
from drake_landing.case.bushing import Bushing
from drake_landing.case.conditions import Conditions
from drake_landing.case.design_values import with_design_values
from drake_landing.case.labels import OneLine
from drake_landing.case.parts import Parts
from drake_landing.case.scenario import Scenario
from drake_landing.case.section import Document
from drake_landing.case.simulation import Simulation, Transient
from drake_landing.gears.landing_gear import AnyGear
from fem.deck.text.source import include_reach

# The name of a known set, or a list; tags are in parentheses, see `reading`.
Gears = Annotated[
    Annotated[Literal["d150", "d150-paper"], Tag("(name)")]
    | Annotated[tuple[AnyGear, ...], Tag("(list)")],
    Discriminator(lambda value: "(name)" if isinstance(value, str) else "(list)"),
]


def _named_schema(schema: dict[str, Any]) -> None:
    """Case files may name the schema that editors check them against."""
    named = {"type": "string", "description": "where editors find this schema"}
    schema["properties"] = {"$schema": named, **schema["properties"]}


class Case(Document):
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

    @contextmanager
    def reading(self) -> Iterator[None]:
        """Errors within say file and line; INCLUDE reaches what the case adds."""
        with self.places.located(), include_reach(self.airframe.include_paths):
            yield

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
        """Duration of the direct transient, s: never beyond the landing's."""
        return min(self.transient.duration or landing, landing)
