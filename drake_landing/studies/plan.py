"""What each study runs: an aircraft, gear topologies, sets of modes."""

from dataclasses import dataclass, field

from drake_landing.case import Case, Selection, Simulation, Transient, parse_selection
from drake_landing.scenario import Scenario

_SCENARIO = Scenario(sink_rate=1.8288, forward_speed=67.0)  # 6 ft/s, three points
_SIMULATION = Simulation(duration=0.6)
# At 0.25 ms the integration costs 0.1 % of accuracy; at 0.5 ms 0.5 %.
_TRANSIENT = Transient(step=2.5e-4)


@dataclass(frozen=True, kw_only=True)
class Plan:
    """A study.

    Attributes:
        name: names its folder.
        title: one line.
        level: of the reference aircraft.
        topologies: gear attachments.
        selections: sets of elastic modes, as in a case.
        candidates: modes below this frequency are computed, Hz.
        reductions: bases of the error budget beside the full modes.
        scenario, simulation, transient: as in a case.
        points: monitoring points of figures and tables; results hold all.
    """

    name: str
    title: str
    level: str
    topologies: tuple[str, ...]
    selections: tuple[str, ...]
    candidates: float = 260.0
    reductions: tuple[str, ...] = ("guyan", "craig-bampton")
    scenario: Scenario = _SCENARIO
    simulation: Simulation = _SIMULATION
    transient: Transient = _TRANSIENT
    points: tuple[str, ...] = ("nose_tip", "cg", "tail_tip", "wing_tip_right")

    def case(self, topology: str) -> Case:
        """The case that all runs of a topology share; it selects all candidates."""
        return Case.model_validate(
            {
                "name": f"{self.name}_{topology}",
                "airframe": {
                    "model": self.level,
                    "topology": topology,
                    "select": f"below {self.candidates:g} Hz",
                },
                "scenario": self.scenario,
                "simulation": self.simulation,
                "transient": self.transient,
            }
        )


@dataclass(frozen=True, kw_only=True)
class RunName:
    """One landing of a study."""

    topology: str
    selection: str
    parsed: Selection = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "parsed", parse_selection(self.selection))

    def __str__(self) -> str:
        words = self.selection.replace(" ", "_").replace("<=_", "").replace("_%", "pc")
        return f"topology_{self.topology}_{words}"

    @property
    def words(self) -> str:
        """For titles."""
        kind, value = self.parsed.kind, self.parsed.value
        if kind == "count":
            return "rigid airframe" if value == 0 else f"lowest {value:g} modes"
        if kind == "relevance":
            return f"{value:g} most relevant modes"
        if kind == "pulses":
            return f"{value:g} modes made for the gears' pulses"
        return f"modes {self.selection}"


PLANS = {
    "modes": Plan(
        name="modes",
        title="How many eigenmodes: DLR-D150-PRE, 19, 73 and 210 modes",
        level="pre",
        topologies=("1", "2"),
        selections=(
            "count 19",
            "count 73",
            "count 210",
            "relevance 36",
            "relevance 73",
            "pulses 73",
        ),
    ),
    "topology": Plan(
        name="topology",
        title="Which attachment topology: DLR-D150-PRE, 73 modes",
        level="pre",
        topologies=("1", "2"),
        selections=("count 73", "relevance 73", "pulses 73"),
        reductions=(),
    ),
    "full": Plan(
        name="full",
        title="DLR-D150-FULL, gears distributed along the rear spar",
        level="full",
        topologies=("distributed",),
        selections=(
            *("count 0", "below 25 Hz", "below 50 Hz", "below 100 Hz", "below 150 Hz"),
            *("relevance 46", "relevance 93", "pulses 93"),
        ),
        candidates=200.0,
        reductions=(),
    ),
}
