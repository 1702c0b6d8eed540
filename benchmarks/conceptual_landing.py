"""The conceptual reference aircraft's modal body and gears, for timing."""

import tempfile
from functools import cache
from importlib.resources import files
from pathlib import Path

from drake_landing.airframe.body import load_airframe
from drake_landing.case.reading import parse_case
from drake_landing.landing.diagram import LandingDiagram, MakeLandingDiagram
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.reference.d150.gears import landing_gears
from systems.airframe.modal_body import ModalBody

SINK_RATE = 1.8288  # m/s


@cache
def _aircraft(modes: int):
    text = files("drake_landing").joinpath("demo.yaml").read_text(encoding="utf-8")
    case = parse_case(text.replace("count 1", f"count {modes}"), file="demo.yaml")
    with tempfile.TemporaryDirectory() as folder:
        aircraft = prepare_aircraft(case, Path(folder))
        return load_airframe(case.airframe, aircraft).body, aircraft


def modal_body(modes: int) -> ModalBody:
    """Its lowest elastic modes."""
    return _aircraft(modes)[0]


def make_landing(
    body: ModalBody, modes: int, energy_budget: bool = True, gears: str = "paper"
) -> LandingDiagram:
    """Its diagram, with the monitoring points of the model.

    Args:
        body: of `modal_body(modes)`, or made from it.
        modes: as there.
        energy_budget: with the audit.
        gears: `paper`, `legs` (the same on elastic legs) or `d150`.
    """
    aircraft = _aircraft(modes)[1]
    chosen = landing_gears(paper=gears != "d150")
    if gears == "legs":
        legs = [gear.leg for gear in landing_gears()]
        chosen = [g.model_copy(update={"leg": leg}) for g, leg in zip(chosen, legs)]
    return MakeLandingDiagram(
        body,
        chosen,
        monitor_nodes=list(aircraft.monitoring.values()),
        energy_budget=energy_budget,
    )
