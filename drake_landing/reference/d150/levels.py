"""The D150's levels of detail as parametric aircraft of the registry."""

from functools import partial
from pathlib import Path

from drake_landing.parametric import ParametricAircraft, WrittenAircraft
from drake_landing.reference.d150.gears import landing_gears
from drake_landing.reference.d150.generator import RECIPES, write_model
from drake_landing.reference.d150.reference_axis import reference_nodes
from drake_landing.reference.named_places import reference_places, steady_load


def level(name: str) -> ParametricAircraft:
    """The aircraft at the level con, pre or full."""
    return ParametricAircraft(
        name=name,
        topologies=RECIPES[name].topologies,
        write=partial(_write, name),
        places=partial(reference_places, level=name),
        steady_load=steady_load,
    )


def _write(name: str, path: Path, topology: str | None) -> WrittenAircraft:
    model = write_model(name, path, topology)
    gears = sum(gear.mass for gear in model.gears)
    points = ", ".join(f"{name} {grid}" for name, grid in model.monitoring.items())
    axes = reference_nodes()
    wing = {i for side in ("wing_left", "wing_right") for i in axes[side].ids}
    return WrittenAircraft(
        name=model.name,
        topology=model.topology,
        gears=model.gears,
        gear_sets={"d150-paper": landing_gears(paper=True)},
        monitoring=model.monitoring,
        interface=model.interface,
        lift_nodes=tuple(sorted(wing)),
        story=f"{path}: {model.name}, {len(model.grid_id)} grids, topology "
        f"{model.topology}; airframe {model.masses['mass'].sum():,.0f} kg, gears "
        f"{gears:,.0f} kg\nmonitoring points: {points}",
    )


CON, PRE, FULL = level("con"), level("pre"), level("full")
