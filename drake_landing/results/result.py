"""What a run of the process found."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.body import AirframeModel
from drake_landing.case.axes import vertical_axis
from drake_landing.case.schema import Case
from drake_landing.landing.handover import AttachmentLoads, smooth_curve
from drake_landing.landing.history import POINT, LandingHistory
from drake_landing.parts.buckling import BuckledPanels
from drake_landing.parts.observers import PartsFound
from drake_landing.results.provenance import Provenance
from drake_landing.results.stages import Stages
from drake_landing.results.truncation import Truncation
from drake_landing.transient.practices import Practices
from drake_landing.transient.step_error import StepError
from fem.recovery.envelope import Envelope


@dataclass(frozen=True, kw_only=True)
class ProcessResult:
    """What a run of the process found.

    Attributes:
        case: as validated.
        aircraft: deck, gears and monitoring points of the case.
        airframe: finite-element model, its modes, and the modal body.
        history: the multibody run.
        loads: attachment loads on the grid of the transient, as handed over.
        response: acceleration of the monitoring points, direct transient, B.
        envelopes: extremes of all element forces and stresses in the transient.
        parts: what the parts see.
        step: what the time step of the transient is expected to cost.
        swing: period of the lowest elastic mode within bounds, s.
        truncation: what the modes that are left out cost.
        deck_checked: what reading the written deck back has shown.
        late: extremes in the last swing, see `late_extremes`.
        practices: the three practices side by side, where they were asked for.
        buckled: the panels that buckle first, where they were asked for.
        comparison: table of `comparison.csv`.
        gears: table of `gears.csv`.
        notices: what the user should know.
        stages: what each stage took.
        provenance: how the run was made.
    """

    case: Case
    aircraft: Aircraft
    airframe: AirframeModel
    history: LandingHistory
    loads: AttachmentLoads
    response: dict[str, pd.DataFrame]
    envelopes: tuple[Envelope, ...]
    comparison: pd.DataFrame
    gears: pd.DataFrame
    parts: PartsFound
    step: StepError
    swing: float
    late: pd.DataFrame
    truncation: Truncation
    deck_checked: str
    provenance: Provenance
    practices: Practices | None = None
    buckled: BuckledPanels | None = None
    notices: tuple[str, ...] = ()
    stages: Stages = field(default_factory=Stages, repr=False)

    @property
    def vertical(self) -> str:
        """The axis of the deck that is vertical: x, y or z."""
        return vertical_axis(self.airframe.R_AB)

    @property
    def seconds(self) -> Mapping[str, float]:
        """Stage -> wall time, s."""
        return self.stages.seconds

    @property
    def multibody_on_grid(self) -> dict[str, pd.DataFrame]:
        """Accelerations of the multibody run at the instants of the transient."""
        return on_grid(self.history, self.loads.time)


def on_grid(history: LandingHistory, time: np.ndarray) -> dict[str, pd.DataFrame]:
    """Accelerations of the multibody run at given instants."""
    index = pd.Index(time, name="time")
    inside = np.minimum(time, history.time[-1])
    return {
        point: pd.DataFrame(
            smooth_curve(history.time, table.to_numpy())(inside),
            columns=list(POINT),
            index=index,
        )
        for point, table in history.monitoring.items()
    }
