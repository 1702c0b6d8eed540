"""The aircraft on the ground as the rules speak of it, and the load cases they want.

Ground axes G: x aft, y to starboard, z up, square to the runway; places are relative to
the aircraft's center of gravity. A pose is how far shock absorbers and tires are
deflected, and the attitude. Forces are those of the ground on the aircraft: drag aft,
side to starboard, vertical up, N.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from drake_landing.landing.lift import STANDARD_GRAVITY
from fem.arrays import Float64

Role = Literal["nose", "main", "tail"]
Weight = Literal["landing", "take_off"]
PoseName = Literal[
    "static", "largest", "all_wheels", "reduced", "tail_down", "extended"
]
At = Literal["ground", "axle", "unsprung"]

STATES: dict[PoseName, str] = {
    "static": "at rest: static deflections and attitude",
    "largest": "level, deflections of the largest vertical load",
    "all_wheels": "all wheels on the ground, deflections of the landing on all wheels",
    "reduced": "level, 75 % of the deflections of the largest vertical load",
    "tail_down": "tail-down, deflections of the largest vertical load",
    "extended": "level, gears extended, off the ground",
}


@dataclass(frozen=True, kw_only=True)
class Gear:
    """A landing gear.

    Attributes:
        name: as in the case.
        role: nose, main or tail.
        static: vertical load at rest, N.
        largest: vertical load of the level landing on the main gears, of a nose gear
            that of the landing on all gears, N; None: not known.
        all_wheels: the same, landing on all gears at once; None: not known.
        tail_down: the same, landing tail-down; None: not known.
        time_to_peak: from touchdown to `largest`, s; None: not known.
        brake_torque: the most that all its brakes give together, N m; 0: no brakes.
        radius: of the rolling wheel, m.
        spin_inertia: of all its wheels, kg m².
        wheels: their number.
        scrub: mean distance of its wheels from their middle, seen from above, m.
        unsprung: mass below the shock absorber, kg.
    """

    name: str
    role: Role
    static: float
    largest: float | None = None
    all_wheels: float | None = None
    tail_down: float | None = None
    time_to_peak: float | None = None
    brake_torque: float = 0.0
    radius: float = 0.5
    spin_inertia: float = 0.0
    wheels: int = 1
    scrub: float = 0.0
    unsprung: float = 0.0


@dataclass(frozen=True, kw_only=True, eq=False)
class GearPlace:
    """Where a gear is in a pose, G, relative to the center of gravity.

    Attributes:
        ground: (3,) middle of its wheels' points on the ground, m.
        axle: (3,) middle of its axles, m.
        unsprung: (3,) center of gravity of what moves below the shock absorber, m.
        extension: (3,) unit vector in which it extends.
    """

    ground: Float64
    axle: Float64
    unsprung: Float64 = field(default_factory=lambda: np.zeros(3))
    extension: Float64 = field(default_factory=lambda: np.array([0.0, 0.0, -1.0]))


@dataclass(frozen=True, kw_only=True)
class GroundAircraft:
    """An aircraft on the ground.

    Attributes:
        mass: with gears, kg.
        design: which design weight that is.
        gears: in the order of the case.
        poses: pose -> gear -> where it is.
        steering_torque: full normal torque of the steering about the strut, N m.
        pitch_damping: ζ of pitch about the main contact, of the formula 25.493(e).
        wing_area: m², of CS-23.
        stall_speed: V_S0 in the landing, m/s, of CS-23 Appendix D.
        gravity: m/s².
    """

    mass: float
    design: Weight
    gears: tuple[Gear, ...]
    poses: Mapping[PoseName, Mapping[str, GearPlace]] = field(repr=False)
    steering_torque: float | None = None
    pitch_damping: float | None = None
    wing_area: float | None = None
    stall_speed: float | None = None
    gravity: float = STANDARD_GRAVITY

    @property
    def weight(self) -> float:
        """N."""
        return self.mass * self.gravity

    def of(self, *roles: Role) -> tuple[Gear, ...]:
        """Gears of these roles."""
        return tuple(gear for gear in self.gears if gear.role in roles)

    @property
    def mains(self) -> tuple[Gear, ...]:
        """Main gears."""
        return self.of("main")

    @property
    def nose(self) -> Gear | None:
        """The nose gear, if there is one."""
        return next(iter(self.of("nose")), None)

    @property
    def tail(self) -> Gear | None:
        """The tail gear, if there is one."""
        return next(iter(self.of("tail")), None)

    @property
    def braked(self) -> tuple[Gear, ...]:
        """Gears with brakes."""
        return tuple(gear for gear in self.gears if gear.brake_torque > 0.0)

    def side(self, gear: Gear) -> float:
        """-1 to port, 1 to starboard, 0 in the middle."""
        y = float(self.poses["static"][gear.name].ground[1])
        return 0.0 if abs(y) < 0.05 else float(np.sign(y))


@dataclass(frozen=True, kw_only=True, eq=False)
class GearLoad:
    """A load on a gear.

    Attributes:
        gear: its name.
        at: where it acts: the middle of its wheels on the ground, of its axles, or the
            center of gravity of the unsprung parts.
        force: (3,) N, G.
        moment: (3,) N m, G.
        what: kind of the load, where it is not that of the ground.
    """

    gear: str
    at: At
    force: Float64
    moment: Float64 = field(default_factory=lambda: np.zeros(3))
    what: str = ""


def load(
    gear: Gear | str,
    at: At,
    *,
    drag: float = 0.0,
    side: float = 0.0,
    vertical: float = 0.0,
    turning: float = 0.0,
    what: str = "",
) -> GearLoad:
    """A load by its components, N; `turning` about the up axis, N m."""
    return GearLoad(
        gear=gear if isinstance(gear, str) else gear.name,
        at=at,
        force=np.array([drag, side, vertical]),
        moment=np.array([0.0, 0.0, turning]),
        what=what,
    )


@dataclass(frozen=True, kw_only=True)
class BookCase:
    """A load case of the rules.

    Attributes:
        paragraph: 25.479(d)(1).
        name: what tells it from others of its paragraph.
        loads: on the gears.
        pose: see `STATES`.
        lift: over the weight, beside the loads; the 1 g state is scaled by it.
        note: how the rule is read here, or what is missing.
    """

    paragraph: str
    name: str
    loads: tuple[GearLoad, ...]
    pose: PoseName
    lift: float = 0.0
    note: str = ""

    @property
    def title(self) -> str:
        """Paragraph and name."""
        return f"{self.paragraph} {self.name}"
