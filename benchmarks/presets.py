"""Plausibility of the loads of every preset of CS-25, and what each run keeps.

    OPENBLAS_NUM_THREADS=1 python -m benchmarks.presets [con|pre] [HZ]

Peaks per gear of the reference aircraft (maximum take-off mass; sink rates are those of
the presets, for the design landing mass) against the static ratios of the paragraphs,
and the errors of energy, momentum and symmetry. `vertical` is over the static load of
the gear. Drag and side are over the vertical load of the same instant; the static
ratios of CS-25 stand in brackets. `stop` is the acceleration of the unsprung parts as
they reach their extension stops in the air, over g (25.487: 20). Errors are over the
sink energy and momentum, for rolling over those of 3.048 m/s; symmetry over the largest
attachment load.
"""

import os
import sys

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import time
from pathlib import Path
from tempfile import TemporaryDirectory

import pandas as pd
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig

from drake_landing.audit import Audit, audit, gear_loads
from drake_landing.cases_io import parse_case
from drake_landing.lift import STANDARD_GRAVITY
from drake_landing.presets import PRESETS, Preset, PresetName
from drake_landing.scenario import Scenario
from drake_landing.start import make_scenario_diagram, set_scenario_state
from systems.modal_body import ModalBody


def reference_aircraft(level: str, below_hz: float):
    """Modal body and gears of a built-in aircraft."""
    from drake_landing.airframe import load_airframe
    from drake_landing.inputs import prepare_aircraft

    text = (
        f"name: presets\nairframe: {{model: {level}, select: below {below_hz:g} Hz}}\n"
        "scenario: {sink_rate: 1}\n"
    )
    case = parse_case(text)
    with TemporaryDirectory() as folder:
        aircraft = prepare_aircraft(case, Path(folder))
        return load_airframe(case.airframe, aircraft).body, aircraft.gears


def run_preset(
    name: PresetName, body: ModalBody, gears, duration: float, accuracy: float = 1e-5
) -> tuple[Audit, pd.DataFrame, float]:
    """Errors, table of peaks, processor seconds."""
    scenario = Scenario.model_validate({"preset": name})
    landing = make_scenario_diagram(body, gears, scenario)
    simulator = Simulator(landing.diagram)
    config = SimulatorConfig(
        integration_scheme="runge_kutta3", accuracy=accuracy, max_step_size=5e-3
    )
    ApplySimulatorConfig(config, simulator)
    context = simulator.get_mutable_context()
    set_scenario_state(landing, context, scenario)
    start = time.process_time()
    simulator.Initialize()
    simulator.AdvanceTo(duration)
    seconds = time.process_time() - start
    return audit(landing, context, scenario), gear_loads(landing, context), seconds


def static_loads(body: ModalBody, gears) -> dict[str, float]:
    """Vertical load of each gear at rest, N."""
    scenario = Scenario.model_validate({"preset": "taxi_bump"})
    landing = make_scenario_diagram(body, gears, scenario)
    context = landing.diagram.CreateDefaultContext()
    set_scenario_state(landing, context, scenario)
    loads = {}
    for gear in gears:
        tires = [landing.tires[wheel] for wheel in gear.wheel_names]
        ports = [(t.GetOutputPort("contact"), t) for t in tires]
        contacts = [p.Eval(t.GetMyContextFromRoot(context)) for p, t in ports]
        loads[gear.name] = float(sum(contact[1] for contact in contacts))
    return loads


def _row(name: str, preset: Preset, gear: str, peaks: pd.Series, static: float) -> str:
    ratios = preset.static_ratios
    drag, side = (
        f"{peaks[f'{q}_ratio']:.2f}" + (f" ({ratios[q]:g})" if q in ratios else "")
        for q in ("drag", "side")
    )
    stop = peaks["extension"] / STANDARD_GRAVITY
    cells = [
        f"{name} ({preset.paragraph})",
        gear,
        f"{peaks['vertical'] / 1e3:.0f}",
        f"{peaks['vertical'] / static:.2f}",
        f"{peaks['drag'] / 1e3:.0f}",
        drag,
        f"{peaks['spring_back'] / 1e3:.0f}",
        f"{peaks['side'] / 1e3:.0f}",
        side,
        f"{peaks['stroke']:.3f}",
        f"{stop:.1f}",
    ]
    return "| " + " | ".join(cells) + " |"


def main(level: str = "con", below_hz: float = 50.0) -> None:
    """Prints both tables."""
    body, gears = reference_aircraft(level, below_hz)
    static = static_loads(body, gears)
    mass = body.mass + sum(gear.mass for gear in gears)
    print(f"D150 {level}, {mass / 1e3:.1f} t, {body.n} elastic modes\n")
    print(
        "| preset | gear | vertical, kN | over static | drag, kN | drag ratio | "
        "spring-back, kN | side, kN | side ratio | stroke, m | stop, g |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    audits = []
    for name, preset in PRESETS.items():
        found, peaks, seconds = run_preset(name, body, gears, preset.duration)
        for gear in peaks.index:
            print(_row(name, preset, gear, peaks.loc[gear], static[gear]), flush=True)
        symmetry = f"{found.symmetry:.1e}" if preset.symmetric else "-"
        momentum = abs(found.momentum).max()
        audits.append(
            f"| {name} | {found.energy:.1e} | {momentum:.1e} | {symmetry} | "
            f"{preset.duration:g} | {seconds:.1f} |"
        )
    print("\n| preset | energy | momentum | symmetry | duration, s | processor, s |")
    print("|---|---|---|---|---|---|")
    print("\n".join(audits))


if __name__ == "__main__":
    arguments = sys.argv[1:]
    main(*arguments[:1], *map(float, arguments[1:2]))
