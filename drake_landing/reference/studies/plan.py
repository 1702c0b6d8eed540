"""What each study runs: an aircraft, gear topologies, sets of modes."""

from dataclasses import dataclass, field
from typing import get_args

from drake_landing.case.airframe import Basis
from drake_landing.case.mode_selection import Selection, parse_selection
from drake_landing.case.scenario import Scenario
from drake_landing.case.schema import Case
from drake_landing.case.simulation import Simulation, Transient

_SCENARIO = Scenario(sink_rate=1.8288, forward_speed=67.0)  # 6 ft/s, three points
_SIMULATION = Simulation(duration=0.6, accuracy=1e-4)
# At 0.25 ms the integration costs 0.1 % of accuracy; at 0.5 ms 0.5 %.
_TRANSIENT = Transient(step=2.5e-4)


FULL_MODES: Basis = "full-modes"
NAMES = {"full-modes": "full model", "guyan": "Guyan", "craig-bampton": "Craig-Bampton"}


@dataclass(frozen=True, kw_only=True)
class Plan:
    """A study.

    Attributes:
        name: names its folder.
        title: one line.
        level: of the reference aircraft.
        topologies: gear attachments.
        selections: sets of elastic modes, as in a case; those of a reduced model begin
            with its basis: `guyan count 73`.
        candidates: modes below this frequency are computed, Hz.
        further_bases: compared under the loads of a run, without landings of their own.
        counts: of modes in that comparison.
        scenario, simulation, transient: as in a case.
        points: monitoring points of figures and tables; results hold all.
    """

    name: str
    title: str
    level: str
    topologies: tuple[str, ...]
    selections: tuple[str, ...]
    candidates: float = 260.0
    further_bases: tuple[Basis, ...] = ()
    counts: tuple[int, ...] = (19, 73, 210)
    scenario: Scenario = _SCENARIO
    simulation: Simulation = _SIMULATION
    transient: Transient = _TRANSIENT
    points: tuple[str, ...] = ("nose_tip", "cg", "tail_tip", "wing_tip_right")

    @property
    def runs(self) -> list["RunName"]:
        """All landings, topology by topology."""
        return [
            RunName(topology=topology, selection=selection)
            for topology in self.topologies
            for selection in self.selections
        ]

    @property
    def reductions(self) -> tuple[Basis, ...]:
        """Bases of reduced models among the runs."""
        found: dict[Basis, None] = {run.basis: None for run in self.runs}
        return tuple(basis for basis in found if basis != FULL_MODES)

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
                "gears": "d150-paper",
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
    basis: Basis = field(init=False, repr=False, compare=False)
    parsed: Selection = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        first, _, rest = self.selection.partition(" ")
        reduced = first in get_args(Basis)
        object.__setattr__(self, "basis", first if reduced else FULL_MODES)
        text = rest if reduced else self.selection
        object.__setattr__(self, "parsed", parse_selection(text))

    def __str__(self) -> str:
        words = self.selection.replace(" ", "_").replace("<=_", "").replace("_%", "pc")
        return f"topology_{self.topology}_{words}"

    @property
    def words(self) -> str:
        """Name for titles."""
        kind, value = self.parsed.kind, self.parsed.value
        if kind == "count":
            said = "rigid airframe" if value == 0 else f"lowest {value:g} modes"
        elif kind == "relevance":
            said = f"{value:g} most relevant modes"
        elif kind == "pulses":
            said = f"{value:g} modes made for the gears' pulses"
        else:
            said = f"modes {self.parsed}"
        return said if self.basis == FULL_MODES else f"{NAMES[self.basis]}, {said}"


PLANS = {
    "modes": Plan(
        name="modes",
        title="How many eigenmodes: DLR-D150-PRE, 19, 73 and 210 modes",
        level="pre",
        topologies=("1", "2"),
        selections=(
            # The paper's practice: modes of a model reduced to its 261 nodes.
            *("guyan count 19", "guyan count 73", "guyan count 210"),
            *("count 19", "count 73", "count 210"),
            *("relevance 73", "pulses 36", "pulses 73"),
        ),
        further_bases=("craig-bampton",),
    ),
    "topology": Plan(
        name="topology",
        title="Which attachment topology: DLR-D150-PRE, 73 modes",
        level="pre",
        topologies=("1", "2"),
        selections=("guyan count 73", "count 73", "pulses 73"),
    ),
    "full": Plan(
        name="full",
        title="DLR-D150-FULL, gears distributed along the rear spar",
        level="full",
        topologies=("distributed",),
        selections=(
            *("count 0", "guyan count 38", "guyan count 95"),
            *("guyan count 192", "guyan count 270"),
            *("below 25 Hz", "below 50 Hz", "below 100 Hz", "below 150 Hz"),
            *("pulses 47", "pulses 95"),
        ),
        candidates=200.0,
        transient=Transient(step=5e-4),  # a step of 0.25 ms would take half an hour
        counts=(38, 95, 192, 270),
    ),
}
