"""What a run has to keep: energy, momentum, symmetry; and the peaks that it found."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pandas as pd
from pydrake.systems.framework import Context
from scipy.interpolate import Akima1DInterpolator

from drake_landing.case.scenario import Scenario
from drake_landing.landing.diagram import LandingDiagram
from drake_landing.landing.handover import distinct_instants
from drake_landing.landing.lift import AFT, aircraft_mass_center
from drake_landing.landing.start import reference_energy

Float64 = npt.NDArray[np.float64]

_MIRROR = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])


@dataclass(frozen=True, kw_only=True)
class Audit:
    """How well a run keeps what nature keeps.

    Attributes:
        energy: largest deviation of the energy budget over the reference energy.
        momentum: (3,) change of momentum less the impulse of all forces, over the
            momentum of the sinking aircraft; world axes.
        symmetry: largest difference of mirrored attachment loads over the largest
            load; of gears named `<name>_left` and `<name>_right`, and of sideways
            loads on others. Only meaningful where the scenario is symmetric.
    """

    energy: float
    momentum: Float64
    symmetry: float


class Signals:
    """Logged signals of a run by "<system>.<port>", (size, t).

    Samples that events left a rounding error apart are dropped, all but the last.
    """

    def __init__(self, landing: LandingDiagram, context: Context) -> None:
        self._landing, self._context = landing, context
        first = next(iter(landing.loggers.values())).FindLog(context)
        self._keep = distinct_instants(first.sample_times())
        self.time = first.sample_times()[self._keep]

    def __getitem__(self, name: str) -> Float64:
        return self._landing.loggers[name].FindLog(self._context).data()[:, self._keep]


def audit(landing: LandingDiagram, context: Context, scenario: Scenario) -> Audit:
    """Audits a run that began with `set_scenario_state` in this context.

    Args:
        landing: with energy budget and loggers.
        context: after the run.
        scenario: that was run.
    """
    signals = Signals(landing, context)
    total = signals["energy_budget.total"][0]
    return Audit(
        energy=np.abs(total - total[0]).max() / reference_energy(landing, scenario),
        momentum=_momentum_error(landing, context, signals, scenario),
        symmetry=_asymmetry(landing, signals),
    )


def gear_loads(landing: LandingDiagram, context: Context) -> pd.DataFrame:
    """Peaks of each gear over a run, index gear.

    Columns: vertical, drag, tyre_forward, side (N, sums over the wheels; drag aft,
    tyre_forward the largest force of the runway forward, side of largest magnitude),
    spring_back (N, the largest load forward on the airframe at the gear's attachments,
    increment to the start, by the leg that swings forward again), drag_ratio and
    side_ratio (to the vertical load of the same instant, largest magnitude while the
    gear carries a tenth of its peak), stroke (m), extension (largest magnitude of the
    acceleration of the stroke with all wheels in the air, m/s², by differences: what
    the unsprung parts feel as they reach their stops), time (s, of the vertical peak).
    """
    signals = Signals(landing, context)
    attachments = [name for gear in landing.gears for name in gear.attachments]
    loads = signals["attachment.load_in_airframe_axes"].reshape(len(attachments), 6, -1)
    rows = {}
    for gear in landing.gears:
        contact = sum(signals[f"tire_{wheel}.contact"] for wheel in gear.wheel_names)
        vertical, drag, side = contact[1:4]
        stroke, rate = signals[f"strut_{gear.name}.strut"]
        aft = sum(loads[attachments.index(name), 0] for name in gear.attachments)
        in_air = contact[0] < 0
        loaded = vertical > max(0.1 * vertical.max(), 1.0)
        load = np.where(loaded, vertical, np.inf)
        rows[gear.name] = {
            "vertical": vertical.max(),
            "drag": drag.max(),
            "tyre_forward": max(-drag.min(), 0.0),
            "spring_back": max(-(aft - aft[0]).min(), 0.0),
            "side": side[np.abs(side).argmax()],
            "drag_ratio": (drag / load).max(),
            "side_ratio": (side / load)[np.abs(side / load).argmax()],
            "stroke": stroke.max(),
            "extension": np.abs(np.gradient(rate, signals.time) * in_air).max(),
            "time": signals.time[vertical.argmax()],
        }
    return pd.DataFrame(rows).T


def _momentum_error(
    landing: LandingDiagram, context: Context, signals: Signals, scenario: Scenario
) -> Float64:
    mass, _ = aircraft_mass_center(landing.body, landing.gears)
    forces = sum(signals[f"tire_{wheel}.wrench"][3:] for wheel in landing.tires)
    if landing.lift is not None:
        forces = forces + np.outer([0.0, 0.0, 1.0], signals["lift.force"][0])
    if landing.reverse_thrust is not None:
        forces = forces + np.outer(AFT, signals["reverse_thrust.force"][0])
    forces[2] -= mass * landing.gravity
    impulse = Akima1DInterpolator(signals.time, forces, axis=1).integrate(
        signals.time[0], signals.time[-1]
    )
    rolling = scenario.start == "rolling"
    sink, side = (0.0, 0.0) if rolling else (scenario.sink_rate, scenario.side_speed)
    airframe = landing.airframe.GetMyContextFromRoot(context)
    velocity = airframe.get_continuous_state_vector().CopyToVector()[7:10]
    states = signals["plant.state"]
    change = landing.body.mass * (velocity - [-scenario.forward_speed, side, -sink])
    change += _gear_momentum(landing, states[:, -1])
    change -= _gear_momentum(landing, states[:, 0])
    return (change - impulse) / (mass * scenario.sink_rate)


def _gear_momentum(landing: LandingDiagram, state: Float64) -> Float64:
    context = landing.plant.CreateDefaultContext()
    landing.plant.SetPositionsAndVelocities(context, state)
    momentum = landing.plant.CalcSpatialMomentumInWorldAboutPoint(context, np.zeros(3))
    return momentum.translational()


def _asymmetry(landing: LandingDiagram, signals: Signals) -> float:
    names = [name for gear in landing.gears for name in gear.attachments]
    loads = signals["attachment.load_in_airframe_axes"].reshape(len(names), 6, -1)
    by_name = dict(zip(names, loads))
    largest = 0.0
    for name, load in by_name.items():
        twin = name.replace("_left", "_right")
        if "_right" in name or twin not in by_name:
            continue
        mirrored = by_name[twin] * _MIRROR[:, None]
        largest = max(largest, float(np.abs(load - mirrored).max()))
    return largest / max(float(np.abs(loads).max()), 1e-300)
