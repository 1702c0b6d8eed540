"""Aircraft that a program writes: the built-in ones, and a user's own.

`airframe: {model: NAME}` in a case asks the registry for the aircraft NAME. The D150 is
there as con, pre and full; another package adds its own by an entry point in the group
`drake_landing.aircraft`, or a notebook by `register`:

    register("glider", "my_package.glider:GLIDER")

where `GLIDER` is a `ParametricAircraft`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from importlib.metadata import entry_points
from pathlib import Path
from typing import TYPE_CHECKING

from fem.arrays import Float64
from fem.errors import InputError, nearest

if TYPE_CHECKING:
    from drake_landing.gears.landing_gear import LandingGear
    from drake_landing.places import Places
    from fem.model.structure import Structure

GROUP = "drake_landing.aircraft"


@dataclass(frozen=True, kw_only=True)
class WrittenAircraft:
    """What a parametric aircraft says of the deck that it wrote.

    Attributes:
        name: for tables and titles, "DLR-D150-CON".
        topology: how its gears are attached.
        gears: in the axes of the deck, SI.
        gear_sets: other gears for it, by the name that a case gives in `gears`.
        monitoring: point -> grid id.
        interface: grids that a reduction keeps, beside attachment and monitoring.
        lift_nodes: grids that carry the lift.
        story: one paragraph for whoever asked for the deck.
    """

    name: str
    topology: str
    gears: tuple[LandingGear, ...]
    monitoring: Mapping[str, int]
    gear_sets: Mapping[str, tuple[LandingGear, ...]] = field(default_factory=dict)
    interface: tuple[int, ...] = ()
    lift_nodes: tuple[int, ...] = ()
    story: str = ""


@dataclass(frozen=True, kw_only=True)
class ParametricAircraft:
    """An aircraft that writes its own deck, in SI units.

    Attributes:
        name: in `airframe.model`.
        topologies: gear attachments that it knows, the first is the default.
        write: writes the deck to a path, in a topology (None: the default), and says
            what it wrote; `InputError` for a topology that it does not know.
        places: where one looks at its structure; None: as at any deck.
        steady_load: (f, 1) loads of steady flight at 1 g, N, N m; None: not known.
    """

    name: str
    topologies: tuple[str, ...]
    write: Callable[[Path, str | None], WrittenAircraft]
    places: Callable[[Structure], Places] | None = None
    steady_load: Callable[[Structure], Float64] | None = None


@dataclass
class _Registry:
    homes: dict[str, str] = field(default_factory=dict)
    asked: bool = False

    def all(self) -> dict[str, str]:
        """Name -> module:attribute, entry points of other packages among them."""
        if not self.asked:
            self.asked = True
            for point in entry_points(group=GROUP):
                self.homes.setdefault(point.name, point.value)
        return self.homes


_REGISTRY = _Registry(
    {level: f"drake_landing.reference.d150.levels:{level.upper()}"
     for level in ("con", "pre", "full")}
)  # fmt: skip


def register(name: str, home: str) -> None:
    """Adds an aircraft.

    Args:
        name: in `airframe.model`.
        home: "module:attribute" of a `ParametricAircraft`, imported when it is used.

    Raises:
        ValueError: the name belongs to another aircraft, or `home` has no colon.
    """
    if ":" not in home:
        raise ValueError(f"home: found '{home}', expected module:attribute")
    if _REGISTRY.all().setdefault(name, home) != home:
        raise ValueError(f"aircraft '{name}' is registered: {_REGISTRY.all()[name]}")


def registered() -> tuple[str, ...]:
    """Names that a case may give."""
    return tuple(_REGISTRY.all())


def parametric_aircraft(name: str) -> ParametricAircraft:
    """The aircraft of a name.

    Raises:
        InputError: none of this name.
    """
    homes = _REGISTRY.all()
    if name not in homes:
        raise InputError(
            f"model: found '{name}', expected one of {', '.join(homes)}"
            + nearest(name, homes)
        )
    module, _, attribute = homes[name].partition(":")
    return getattr(import_module(module), attribute)
