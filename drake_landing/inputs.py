"""The aircraft of a case: a user's deck with gears, or a built-in reference."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from drake_landing.case import Case
from drake_landing.gear import LandingGear
from fem.errors import InputError


@dataclass(frozen=True, kw_only=True)
class Aircraft:
    """What a case says of the aircraft, complete.

    Attributes:
        name: for tables and titles.
        topology: label of the gear attachment.
        deck: bulk-data file of the airframe.
        gears: in the axes of the deck.
        monitoring: point -> grid id.
        interface: grids that a reduction keeps, beside attachment and monitoring.
        notices: what the user should know.
    """

    name: str
    topology: str
    deck: Path
    gears: tuple[LandingGear, ...]
    monitoring: Mapping[str, int]
    interface: tuple[int, ...] = ()
    notices: tuple[str, ...] = ()

    @property
    def attachment_nodes(self) -> tuple[int, ...]:
        """Grids of all gears."""
        return tuple(node for gear in self.gears for node in gear.attachments.values())

    @property
    def nodes(self) -> dict[int, str]:
        """Grids that must exist -> what for."""
        wanted = {g: f"monitoring point {name}" for name, g in self.monitoring.items()}
        for gear in self.gears:
            for name, node in gear.attachments.items():
                wanted[node] = f"attachment node of gear {name}"
        return {**dict.fromkeys(self.interface, "interface grid"), **wanted}


def prepare_aircraft(case: Case, out: Path) -> Aircraft:
    """The aircraft of a case; a built-in one is written to `out/airframe.bdf`.

    Raises:
        InputError: the deck is not there, or the built-in model is unknown.
    """
    airframe = case.airframe
    if airframe.model is None:
        deck = airframe.deck
        if deck is None or not deck.is_file():
            raise InputError(f"airframe.deck: no such file: {deck}")
        assert case.gears != "d150"  # the case sees to it
        return Aircraft(
            name=deck.stem,
            topology=airframe.topology or "",
            deck=deck,
            gears=tuple(case.gears),
            monitoring=airframe.monitoring,
            interface=airframe.interface,
        )
    from drake_landing.aircraft import write_model

    out.mkdir(parents=True, exist_ok=True)
    model = write_model(airframe.model, out / "airframe.bdf", airframe.topology)
    return Aircraft(
        name=model.name,
        topology=model.topology,
        deck=out / "airframe.bdf",
        gears=model.gears if case.gears == "d150" else tuple(case.gears),
        monitoring={**model.monitoring, **airframe.monitoring},
        interface=tuple(sorted({*model.interface, *airframe.interface})),
    )


def write_model_deck(level: str, path: Path) -> str:
    """Writes a reference aircraft and says what was written.

    Raises:
        InputError: unknown level, or the folder does not exist.
    """
    from drake_landing.aircraft import write_model

    model = write_model(level, path)
    gears = sum(gear.mass for gear in model.gears)
    points = ", ".join(f"{name} {grid}" for name, grid in model.monitoring.items())
    return (
        f"{path}: {model.name}, {len(model.grid_id)} grids, topology {model.topology}; "
        f"airframe {model.masses['mass'].sum():,.0f} kg, gears {gears:,.0f} kg\n"
        f"monitoring points: {points}"
    )
