"""Lift in flight and after touchdown: gravity acts, and wing nodes carry the aircraft.

The default of a landing is simpler: lift equals weight, neither acts.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from pydrake.systems.framework import DiagramBuilder

from drake_landing.gears.bodies import mass_points
from drake_landing.gears.data import LandingGear
from drake_landing.gears.mass_center import mass_center
from systems.airframe.distributed_load import DistributedLoad, trimmed_shares
from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.airframe.modal_body import ModalBody
from systems.tools.checks import require
from systems.tools.table import Table

Float64 = npt.NDArray[np.float64]

STANDARD_GRAVITY = 9.80665
"""m/s²"""


@dataclass(frozen=True, kw_only=True)
class Lift:
    """Lift over nodes of the airframe.

    Attributes:
        nodes: grids that carry it; its resultant passes the aircraft's centre of
            gravity, which they must surround.
        factor: lift over weight, constant or a table over time (s), e.g. `decaying`.
        shares: of each node before the trim; default equal.

    Raises:
        ValueError: a value is out of range.
    """

    nodes: Sequence[int]
    factor: float | Table = 1.0
    shares: Sequence[float] | None = None

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
    """Mass (kg) and centre of gravity (3,) in B (m) with all gears, extended."""
    points = [point for gear in gears for point in mass_points(gear)]
    return mass_center([(body.mass, body.p_BG), *points])


def AddLift(
    builder: DiagramBuilder,
    airframe: FlexibleAirframe,
    body: ModalBody,
    gears: Sequence[LandingGear],
    lift: Lift,
    gravity: float,
) -> DistributedLoad:
    """Adds the system `lift` and connects it to the airframe's `external_load`.

    Args:
        builder: that already holds the airframe.
        airframe: of this body.
        body, gears: what is to be carried.
        lift: by which nodes, how much of the weight.
        gravity: m/s².

    Raises:
        ValueError: a node is not one of the body's, or the nodes do not surround the
            centre of gravity.
    """
    mass, center = aircraft_mass_center(body, gears)
    rows = body.rows(lift.nodes)
    shares = trimmed_shares(body.p_BN[rows], center, lift.shares)
    weight = mass * gravity
    if isinstance(lift.factor, Table):
        force = Table(lift.factor.x, [weight * y for y in lift.factor.y])
    else:
        force = weight * lift.factor
    system = DistributedLoad(body, lift.nodes, shares, force)
    builder.AddNamedSystem("lift", system)
    for port in ("pose", "modal_amplitudes"):
        source = airframe.GetOutputPort(port)
        builder.Connect(source, system.GetInputPort(port))
    load = system.GetOutputPort("load")
    builder.Connect(load, airframe.GetInputPort("external_load"))
    return system
