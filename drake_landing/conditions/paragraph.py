"""A paragraph of the rules: what it asks for, what the program does, what it needs."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

from drake_landing.conditions.ground import BookCase, Gear, GroundAircraft, Weight

Mark = Literal["read", "secondary", "memory", "-"]
Cases = Callable[[GroundAircraft], Iterator[BookCase]]
Need = Callable[[GroundAircraft], str]

_ROLE = "gears are told by place; else set conditions.roles.<gear>"
LARGEST_UNKNOWN = (
    "the largest vertical loads of the landing are not known (set conditions.vertical "
    "of every gear, or of none)"
)
TAIL_DOWN_UNKNOWN = (
    "the largest vertical loads tail-down are not known (landings find them: set no "
    "conditions.vertical)"
)
ANY: tuple[Weight, ...] = ("landing", "take_off")


@dataclass(frozen=True, kw_only=True)
class Paragraph:
    """One paragraph.

    Attributes:
        number: 25.479(d)(1).
        title: a few words.
        rule: what it asks for, in our own words.
        does: what the program does with it.
        mark: how its text is known: read, from a secondary source, or from memory.
        unsure: figures of the rule that are from memory where the rest was read.
        cases: its static load cases; None: it has none here.
        presets: of `scenario`, that show it dynamically.
        needs: what an aircraft must have; the first that is missing is named.
        design: weights at which it applies.
    """

    number: str
    title: str
    rule: str
    does: str
    mark: Mark = "read"
    unsure: str = ""
    cases: Cases | None = None
    presets: tuple[str, ...] = ()
    needs: tuple[Need, ...] = ()
    design: tuple[Weight, ...] = ANY

    @property
    def text(self) -> str:
        """How its text is known, and which figures less well."""
        return self.mark + (f"; from memory: {self.unsure}" if self.unsure else "")

    def missing(self, aircraft: GroundAircraft) -> str:
        """Why the static cases cannot be built; empty: they can."""
        if aircraft.design not in self.design:
            words = {"landing": "design landing weight", "take_off": "ramp weight"}
            return (
                f"asked for at the {words[self.design[0]]}: set 'conditions.weight: "
                f"{self.design[0]}' with an airframe of that weight"
            )
        return next((text for need in self.needs if (text := need(aircraft))), "")


def needs_mains(aircraft: GroundAircraft) -> str:
    """Main gears."""
    return "" if aircraft.mains else f"no main gear ({_ROLE}: main)"


def needs_brakes(aircraft: GroundAircraft) -> str:
    """Brakes on a main gear."""
    braked = any(gear.brake_torque for gear in aircraft.mains)
    return "" if braked else "no main gear has brakes (set gears.<name>.brake)"


def needs_nose(aircraft: GroundAircraft) -> str:
    """A nose gear."""
    return "" if aircraft.nose else f"no nose gear ({_ROLE}: nose, where it has one)"


def needs_tail(aircraft: GroundAircraft) -> str:
    """A tail wheel."""
    return "" if aircraft.tail else f"no tail wheel ({_ROLE}: tail, where it has one)"


def needs_sides(aircraft: GroundAircraft) -> str:
    """Main gears on both sides."""
    sides = {aircraft.side(gear) for gear in aircraft.mains}
    return "" if {-1.0, 1.0} <= sides else "no main gears on both sides (gears)"


def needs_largest(aircraft: GroundAircraft) -> str:
    """Largest vertical loads of the landing."""
    known = all(gear.largest is not None for gear in aircraft.mains)
    return "" if known else LARGEST_UNKNOWN


def needs_tail_down(aircraft: GroundAircraft) -> str:
    """Largest vertical loads of the tail-down landing."""
    known = all(gear.tail_down is not None for gear in aircraft.mains)
    return "" if known else TAIL_DOWN_UNKNOWN


def needs_steering(aircraft: GroundAircraft) -> str:
    """Torque of the steering."""
    known = aircraft.steering_torque is not None
    return "" if known else "no steering torque (set conditions.steering_torque)"


def needs_several_wheels(aircraft: GroundAircraft) -> str:
    """A main gear with more than one wheel."""
    several = any(gear.wheels > 1 for gear in aircraft.mains)
    return (
        ""
        if several
        else "no main gear has more than one wheel (gears.<name>.wheel_offsets)"
    )


def largest(gear: Gear, *, of: str = "largest") -> float:
    """Largest vertical load of a gear, N; `needs_largest` tells whether it is known."""
    value = getattr(gear, of)
    assert value is not None, f"{gear.name}: {of}"
    return float(value)
