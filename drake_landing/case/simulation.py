"""How a landing and the direct transient after it are computed."""

from typing import Annotated, Literal

from pydantic import (
    Discriminator,
    Field,
    Tag,
)

from drake_landing.case.section import Section, number
from drake_landing.landing_integrators import DEFAULT, Integrator

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
