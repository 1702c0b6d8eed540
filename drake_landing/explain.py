"""What a case will do, in words: the deck is read and checked, nothing is solved."""

from pathlib import Path
from tempfile import TemporaryDirectory

from drake_landing.airframe import check_nodes
from drake_landing.case import Case
from drake_landing.inputs import prepare_aircraft


def explain(case: Case) -> str:
    """Lines about the aircraft, the run and what it costs.

    Raises:
        InputError: the deck cannot be read, or lacks grids that the case names.
    """
    with TemporaryDirectory() as folder:
        aircraft = prepare_aircraft(case, Path(folder))
        structure = aircraft.structure()
        check_nodes(structure, aircraft)
    mass = structure.weight.total
    x, y, z = structure.weight.center.round(3) + 0.0  # no minus zero
    gears = sum(gear.mass for gear in aircraft.gears)
    s, run = aircraft.scenario, case.simulation
    energy = 0.5 * (mass + gears) * s.sink_rate**2
    steps = case.transient_duration / case.transient.step
    lines = [
        f"aircraft: {aircraft.name}, {len(structure.points.grid_id)} grids, "
        f"{structure.size} free freedoms",
        f"mass: airframe {mass:,.1f} kg at x {x:.3f}, y {y:.3f}, z {z:.3f} m, "
        f"{len(aircraft.gears)} gears {gears:,.1f} kg, together {mass + gears:,.1f} kg",
        f"multibody: elastic modes '{case.airframe.select}' of the "
        f"{case.airframe.basis} basis, {run.duration:g} s with {run.integrator}",
        f"scenario: {s.story}; {s.lift_story}; energy of the sink rate "
        f"{energy / 1e3:.1f} kJ",
        f"direct transient: {steps:.0f} steps of {case.transient.step:g} s",
        "monitoring points: "
        + ", ".join(f"{name} ({grid})" for name, grid in aircraft.monitoring.items()),
        "attachment nodes: "
        + ", ".join(f"{gear.name} ({gear.attachment_node})" for gear in aircraft.gears),
    ]
    lines += [f"note: {notice}" for notice in structure.notices]
    return "\n".join(lines)
