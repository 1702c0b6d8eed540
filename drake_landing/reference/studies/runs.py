"""What a study found: its runs and what they say together."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.airframe.selection import Choice
from drake_landing.reference.studies.airframes import StudyAirframe
from drake_landing.reference.studies.budget import Budget
from drake_landing.reference.studies.landings import LandingResult
from drake_landing.reference.studies.plan import Plan, RunName

Float64 = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class StudyRun:
    """One landing and its transient.

    Attributes:
        name: topology and selection.
        choice: its elastic modes.
        landing: the multibody run.
        transient: (t, p, 3) accelerations, direct transient, all monitoring points.
        budget: parts of the difference.
    """

    name: RunName
    choice: Choice
    landing: LandingResult
    transient: Float64
    budget: Budget

    @property
    def time(self) -> Float64:
        """(t,) s."""
        return self.landing.loads.time


@dataclass(frozen=True, kw_only=True)
class Study:
    """All runs of a plan and what they say.

    Attributes:
        plan: what was asked for.
        airframes: topology -> airframe.
        points: names of all monitoring points, in the order of the arrays.
        runs: in the order of topologies and selections.
        comparison: table of `comparison.csv`.
        measures: as `comparison`, with times of peaks and Sprague-Geers parts.
        budgets: error budget, a row per run and point, vertical.
        convergence: modal truncation error over the number of modes.
        spectra: modes of bases beside those of the full model.
        bases: linear response of bases, also with residual vectors.
        gaps: differences that more modes do not close.
        gears: table of `gears.csv`.
        seconds: stage -> wall time.
    """

    plan: Plan
    airframes: Mapping[str, StudyAirframe]
    points: tuple[str, ...]
    runs: tuple[StudyRun, ...]
    comparison: pd.DataFrame
    measures: pd.DataFrame
    budgets: pd.DataFrame
    convergence: pd.DataFrame
    spectra: pd.DataFrame
    bases: pd.DataFrame
    gaps: pd.DataFrame
    gears: pd.DataFrame
    seconds: Mapping[str, float]
