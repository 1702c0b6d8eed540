"""Lift in flight and after touchdown: gravity acts, and wing nodes carry the aircraft.

The default of a landing is simpler: lift equals weight, neither acts.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import Adder

from drake_landing.gears.bodies import mass_points
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.gears.mass_center import mass_center
from systems.airframe.distributed_load import DistributedLoad, trimmed_shares
from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.airframe.modal_body import ModalBody
from systems.airframe.quasi_steady_lift import QuasiSteadyLift, Surface
from systems.tools.checks import require
from systems.tools.table import Table

Float64 = npt.NDArray[np.float64]

STANDARD_GRAVITY = 9.80665
"""m/s²"""

AFT = (1.0, 0.0, 0.0)
"""Along the runway, W."""


@dataclass(frozen=True, kw_only=True)
class Motion:
    """How lift follows the motion, see `QuasiSteadyLift`.

    Attributes:
        area: of the wing, m².
        slope: lift coefficient over angle of attack, 1/rad.
        density: of the air, kg/m³.
        pitch_damping: N m s/rad.
        tail: a further surface.
        downwash, lag: at the tail; 1, s.
    """

    area: float
    slope: float
    density: float = 1.225
    pitch_damping: float = 0.0
    tail: Surface | None = None
    downwash: float = 0.0
    lag: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Lift:
    """Lift over nodes of the airframe.

    Attributes:
        nodes: grids that carry it; its resultant passes the aircraft's center of
            gravity, which they must surround.
        factor: lift over weight, constant or a table over time (s), e.g. `decaying`.
        shares: of each node before the trim; default equal.
        motion: how it follows the motion; default not at all.
        reverse_thrust: grids of the engines, and their force aft (N) over time (s).

    Raises:
        ValueError: a value is out of range.
    """

    nodes: Sequence[int]
    factor: float | Table = 1.0
    shares: Sequence[float] | None = None
    motion: Motion | None = None
    reverse_thrust: tuple[Sequence[int], Table] | None = None

    def __post_init__(self) -> None:
        if not len(self.nodes):
            raise ValueError("lift: no nodes, expected those of the wing")
        if isinstance(self.factor, Table):
            if min(self.factor.y) < 0.0:
                raise ValueError(
                    f"lift: factor {min(self.factor.y)} in the table, expected >= 0"
                )
        else:
            require("lift", "factor", self.factor, "", at_least=0.0)


def decaying(
    factor: float = 1.0, *, start: float = 0.0, duration: float, remaining: float = 0.0
) -> Table:
    """Lift over weight that falls linearly from a time on, as spoilers come out.

    Args:
        factor: before.
        start: s, when it begins to fall.
        duration: s, that the fall takes.
        remaining: factor after it.
    """
    require("lift", "start", start, "s", at_least=0.0)
    require("lift", "duration", duration, "s", above=0.0)
    return Table((start, start + duration), (factor, remaining))


def aircraft_mass_center(
    body: ModalBody, gears: Sequence[LandingGear]
) -> tuple[float, Float64]:
    """Mass (kg) and center of gravity (3,) in B (m) with all gears, extended."""
    points = [point for gear in gears for point in mass_points(gear)]
    return mass_center([(body.mass, body.p_BG), *points])


def AddLift(
    builder: DiagramBuilder,
    airframe: FlexibleAirframe,
    body: ModalBody,
    gears: Sequence[LandingGear],
    lift: Lift,
    gravity: float,
) -> tuple[DistributedLoad | QuasiSteadyLift, DistributedLoad | None]:
    """Adds the systems `lift` and `reverse_thrust`, for the airframe's `external_load`.

    Args:
        builder: that already holds the airframe.
        airframe: of this body.
        body, gears: what is to be carried.
        lift: by which nodes, how much of the weight.
        gravity: m/s².

    Raises:
        ValueError: a node is not one of the body's, or the nodes do not surround the
            center of gravity.
    """
    mass, center = aircraft_mass_center(body, gears)
    rows = body.rows(lift.nodes)
    shares = trimmed_shares(body.p_BN[rows], center, lift.shares)
    weight = mass * gravity
    if isinstance(lift.factor, Table):
        force = Table(lift.factor.x, [weight * y for y in lift.factor.y])
    else:
        force = weight * lift.factor
    motion = lift.motion
    if motion is None:
        system = DistributedLoad(body, lift.nodes, shares, force)
    else:
        wing = Surface(
            nodes=lift.nodes, shares=shares, area=motion.area, slope=motion.slope
        )
        system = QuasiSteadyLift(
            body,
            force,
            wing,
            motion.tail,
            downwash=motion.downwash,
            lag=motion.lag,
            pitch_damping=motion.pitch_damping,
            density=motion.density,
        )
    builder.AddNamedSystem("lift", system)
    thrust = None
    if lift.reverse_thrust is not None:
        engines, table = lift.reverse_thrust
        equal = np.full(len(engines), 1.0 / len(engines))
        thrust = DistributedLoad(body, engines, equal, table, AFT)
        builder.AddNamedSystem("reverse_thrust", thrust)
    loads = [load for load in (system, thrust) if load is not None]
    for load in loads:
        for i in range(load.num_input_ports()):
            target = load.get_input_port(i)
            builder.Connect(airframe.GetOutputPort(target.get_name()), target)
    target = airframe.GetInputPort("external_load")
    if thrust is None:
        builder.Connect(system.GetOutputPort("load"), target)
    else:
        both = builder.AddNamedSystem("external_forces", Adder(2, target.size()))
        for i, load in enumerate(loads):
            builder.Connect(load.GetOutputPort("load"), both.get_input_port(i))
        builder.Connect(both.get_output_port(), target)
    return system, thrust
