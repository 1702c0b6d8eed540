"""What carries the aircraft while it lands: lift, its decay, reverse thrust."""

from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import (
    Discriminator,
    Field,
    Tag,
    model_validator,
)

from drake_landing.case.section import Section, number


class Tail(Section):
    """A lifting surface without force in the flight before touchdown."""

    nodes: tuple[int, ...] = Field(
        min_length=1, description="grids that carry it, in equal shares"
    )
    area: float = number("of the tailplane", "m²", gt=0)
    slope: float = number("lift coefficient over angle of attack", "1/rad", ge=1, le=10)
    downwash: float = number(
        "angle of the downwash over that of the wing", "1", 0.0, ge=0, lt=1
    )
    lag: float = number(
        "of the downwash, about its distance over the speed", "s", 0.0, ge=0, le=5
    )


class Following(Section):
    """Lift that follows angle of attack and speed, strip by strip."""

    area: float = number("of the wing", "m²", gt=0)
    slope: float = number("lift coefficient over angle of attack", "1/rad", ge=1, le=10)
    density: float = number("of the air", "kg/m³", 1.225, gt=0, le=2)
    pitch_damping: float = number(
        "moment against the pitch rate at the touchdown speed, beside what the strips "
        "give",
        "N m s/rad",
        0.0,
        ge=0,
    )
    tail: Tail | None = Field(default=None, description="default none")


class ReverseThrust(Section):
    """Force aft along the runway."""

    nodes: tuple[int, ...] = Field(
        min_length=1, description="grids of the engines, equal shares"
    )
    table: list[tuple[float, float]] = Field(
        min_length=2, description="time (s, ascending) against force of all, N"
    )

    @model_validator(mode="after")
    def _over_time(self) -> Self:
        times = [time for time, _ in self.table]
        if any(b <= a for a, b in pairwise(times)):
            raise ValueError(
                f"table: found the times {', '.join(f'{t:g}' for t in times)} s, "
                "expected strictly ascending ones"
            )
        if self.table[0][1] != 0.0:
            raise ValueError(
                f"table: begins with {self.table[0][1]:g} N, expected 0 N: the flight "
                "before touchdown is without"
            )
        return self


class Lift(Section):
    """Gravity acts, and nodes of the wing carry the aircraft."""

    nodes: tuple[int, ...] = Field(
        default=(),
        description="grids that carry the lift, round the center of gravity; the "
        "built-in models have their own",
    )
    shares: tuple[float, ...] | None = Field(
        default=None,
        description="of each node, >= 0, tilted such that the resultant passes the "
        "center of gravity; default equal",
    )
    factor: float = number("lift over weight at touchdown", "1", 1.0, ge=0, le=1.5)
    decay_start: float = number("when the lift begins to fall", "s", 0.0, ge=0)
    decay_duration: float | None = Field(
        default=None, gt=0, description="how long it falls, s; default: it stays"
    )
    remaining: float = number("lift over weight after the fall", "1", 0.0, ge=0, le=1.5)
    follows: Following | None = Field(
        default=None,
        description="how the lift changes with the motion of the aircraft, beside its "
        "fall; default: not at all",
    )
    reverse_thrust: ReverseThrust | None = Field(
        default=None, description="of the engines; default none"
    )

    @property
    def further_nodes(self) -> dict[int, str]:
        """Grids of tail and engines -> field that names them."""
        tail = self.follows.tail.nodes if self.follows and self.follows.tail else ()
        engines = self.reverse_thrust.nodes if self.reverse_thrust else ()
        return {
            **dict.fromkeys(tail, "follows.tail.nodes"),
            **dict.fromkeys(engines, "reverse_thrust.nodes"),
        }

    @model_validator(mode="after")
    def _carries(self) -> Self:
        if self.follows and not self.factor > 0:
            raise ValueError(
                f"factor: found {self.factor:g} beside follows, expected > 0: the lift "
                "of the flight before touchdown"
            )
        return self

    @model_validator(mode="after")
    def _falls_or_stays(self) -> Self:
        """What tells of a fall needs its duration, without which the lift stays."""
        told = [n for n in ("decay_start", "remaining") if n in self.model_fields_set]
        if told and self.decay_duration is None:
            raise ValueError(
                f"decay_duration: found none beside {' and '.join(told)}, expected how "
                "long the lift falls, s"
            )
        return self

    @model_validator(mode="after")
    def _one_share_each(self) -> Self:
        if self.shares is not None and len(self.shares) != len(self.nodes):
            raise ValueError(
                f"shares: {len(self.shares)} for {len(self.nodes)} nodes, expected one "
                "each"
            )
        return self


AnyLift = Annotated[
    Annotated[Literal["weight", "none"], Tag("(name)")]
    | Annotated[Lift, Tag("(lift)")],
    Discriminator(lambda value: "(name)" if isinstance(value, str) else "(lift)"),
]
