"""The landing run: a diagram, an initial state just above touchdown, logged signals.

The multibody model lives in the axes A (x aft, y to starboard, z up); what is logged of
the airframe is turned into the axes B of the deck, see `axes`.
"""

import time as clock
from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt
import pandas as pd
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig
from pydrake.systems.framework import Context, EventStatus

from drake_landing.case.axes import gear_in_A
from drake_landing.case.bushing import Bushing
from drake_landing.case.scenario import Scenario
from drake_landing.case.simulation import Simulation
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.gears.mounted import systems_of
from drake_landing.landing.diagram import LandingDiagram
from drake_landing.landing.handover import distinct_instants
from drake_landing.landing.history import (
    ATTACHMENT,
    BENDING,
    POINT,
    STRUT,
    TIRE,
    LandingHistory,
)
from drake_landing.landing.lift import AFT
from drake_landing.landing.one_gear import with_one_gear
from drake_landing.landing.settling import LIMIT, Settling, has_settled, swing_of
from drake_landing.landing.stall import StallWatch
from drake_landing.landing.start import (
    make_scenario_diagram,
    reference_energy,
    set_scenario_state,
)
from drake_landing.landing.threads import single_threaded_blas
from drake_landing.landing_integrators import IMPLICIT
from drake_landing.progress import Reporter, Silent
from fem.errors import InputError
from systems.airframe.modal_body import ModalBody
from systems.airframe.slow_modes import fastest_rate, with_slow_modes
from systems.tools.rotations import rotation_from_quaternion

Float64 = npt.NDArray[np.float64]

_POSE = ("qw", "qx", "qy", "qz", "px", "py", "pz")


# Modes faster than this (1/s) cost more steps than the loads do.
_FAST = 4000.0


class LandingError(RuntimeError):
    """The simulation could not be carried through; says when and what helps."""

    for_users = True  # no failure of the program


def build_landing(
    body: ModalBody,
    gears: Sequence[LandingGear],
    monitoring: Mapping[str, int],
    R_AB: Float64,
    scenario: Scenario,
    slow_modes_above: float | None = None,
    bushing: Bushing | None = None,
) -> LandingDiagram:
    """The diagram of an aircraft, for any number of runs.

    Args:
        body: in A.
        gears: in B, as in the case.
        monitoring: point -> grid id.
        R_AB: (3, 3).
        scenario: its runway, gravity, lift and brakes are part of the diagram.
        slow_modes_above: Hz; see `systems.airframe.slow_modes`.
        bushing: elastic fittings; default none.

    Raises:
        InputError: the gears cannot be built or held as they are described.
    """
    if slow_modes_above is not None:
        body = with_slow_modes(body, slow_modes_above)
    try:
        return make_scenario_diagram(
            body,
            [gear_in_A(gear, R_AB) for gear in gears],
            scenario,
            list(monitoring.values()),
            bushing=bushing and bushing.model_dump(),
        )
    except InputError:
        raise
    except ValueError as error:  # of a system, which knows no case
        raise InputError(f"gears: {error}") from None


def fast_mode_notices(body: ModalBody, simulation: Simulation) -> tuple[str, ...]:
    """Remarks on modes that bound the integrator's step."""
    bound = simulation.slow_modes_above
    if bound is not None:
        count = int((body.frequency > bound).sum())
        return (
            f"{count} of {body.n} modes lie above {bound:g} Hz and follow the loads by "
            "their flexibility and damping alone (simulation.slow_modes_above)",
        )
    rate = fastest_rate(body)
    if rate < _FAST or simulation.integrator == IMPLICIT:
        return ()
    return (
        f"the fastest of {body.n} modes, {body.frequency[-1]:.0f} Hz, moves at "
        f"{rate:.0f} 1/s and keeps the steps below about {2.5e6 / rate:.0f} µs; "
        "simulation.slow_modes_above: 300 would lift that, at errors of the loads "
        "below 0.1 %",
    )


def fly(
    landing: LandingDiagram,
    scenario: Scenario,
    simulation: Simulation,
    monitoring: Mapping[str, int],
    R_AB: Float64,
    progress: Reporter | None = None,
    settling: Settling | None = None,
) -> LandingHistory:
    """Simulates one landing.

    Args:
        landing: of `build_landing`, with the same monitoring points and axes.
        scenario: state at touchdown.
        simulation: duration and integrator.
        monitoring: point -> grid id.
        R_AB: (3, 3).
        progress: told the share of the duration.
        settling: how a run without a given duration ends; default by the modes that
            the body has.

    Raises:
        LandingError: the integrator gave up.
    """
    context = landing.diagram.CreateDefaultContext()
    start_state(landing, context, scenario, simulation.clearance)
    start = clock.process_time()
    simulator = _simulator(landing, context, simulation, progress or Silent())
    try:
        with single_threaded_blas():
            simulator.Initialize()
            if simulation.duration == "auto":
                settling = settling or Settling(swing=_swing(landing))
                _advance_until_settled(simulator, landing, settling)
            else:
                simulator.AdvanceTo(simulation.duration)
    except (RuntimeError, SystemExit) as error:  # Drake's checks exit
        raise LandingError(
            f"the landing simulation stopped at {context.get_time():.4f} s of "
            f"{_end(simulation):g} s: {error}; a larger simulation.accuracy, fewer "
            f"modes or the integrator {IMPLICIT} may help"
        ) from None
    integrator = simulator.get_integrator()
    figures = {
        "steps": float(integrator.get_num_steps_taken()),
        "evaluations": float(integrator.get_num_derivative_evaluations()),
        "processor_seconds": clock.process_time() - start,
        "sink_energy": reference_energy(landing, scenario),
    }
    history = _history(landing, context, monitoring, R_AB, figures)
    if scenario.one_gear is None:
        return history
    side, body = scenario.one_gear, landing.body
    return with_one_gear(history, body, landing.gears, side, monitoring, R_AB)


def _end(simulation: Simulation) -> float:
    """When a run ends at the latest, s."""
    return LIMIT if simulation.duration == "auto" else simulation.duration


def _swing(landing: LandingDiagram) -> float:
    frequency = landing.body.frequency
    return swing_of(float(frequency[0]) if len(frequency) else 0.0)


def _advance_until_settled(
    simulator: Simulator, landing: LandingDiagram, settling: Settling
) -> None:
    end = settling.first
    simulator.AdvanceTo(end)
    while end < LIMIT and not has_settled(
        landing, simulator.get_context(), settling.swing
    ):
        end = min(end + settling.swing, LIMIT)
        simulator.AdvanceTo(end)


def start_state(
    landing: LandingDiagram, context: Context, scenario: Scenario, clearance: float
) -> None:
    """The state of the scenario.

    Raises:
        InputError: the aircraft cannot stand as its gears are.
    """
    try:
        set_scenario_state(landing, context, scenario, clearance)
    except ValueError as error:
        raise InputError(f"scenario: {error}") from None


def _simulator(
    landing: LandingDiagram,
    context: Context,
    simulation: Simulation,
    progress: Reporter,
) -> Simulator:
    simulator = Simulator(landing.diagram, context)
    config = SimulatorConfig(
        integration_scheme=simulation.integrator,
        max_step_size=simulation.max_step,
        accuracy=simulation.accuracy,
        use_error_control=True,
    )
    ApplySimulatorConfig(config, simulator)
    context.SetAccuracy(simulation.accuracy)

    watch = StallWatch(landing)

    def tell(root: Context) -> EventStatus:
        watch.step(root)
        now = root.get_time()
        progress.share(now / _end(simulation), f"{now:.3f} s")
        return EventStatus.DidNothing()

    simulator.set_monitor(tell)
    return simulator


def _history(
    landing: LandingDiagram,
    context: Context,
    monitoring: Mapping[str, int],
    R_AB: Float64,
    figures: dict[str, float],
) -> LandingHistory:
    log = landing.loggers["airframe.pose"].FindLog(context)
    keep = distinct_instants(log.sample_times())
    index = pd.Index(log.sample_times()[keep], name="time")

    def signal(port: str) -> Float64:
        """(t, size) of a logged port."""
        return landing.loggers[port].FindLog(context).data().T[keep]

    def table(values: Float64, columns: Sequence[str]) -> pd.DataFrame:
        return pd.DataFrame(values, columns=list(columns), index=index)

    attachments = {n: g for gear in landing.gears for n, g in gear.attachments.items()}
    loads = signal("attachment.load_in_airframe_axes").reshape(len(keep), -1, 2, 3)
    points = signal("airframe.monitor_acceleration").reshape(len(keep), -1, 2, 3)
    return LandingHistory(
        attachment_node=attachments,
        wheels={gear.name: gear.wheel_names for gear in landing.gears},
        attachment={
            name: table((loads[:, i] @ R_AB).reshape(len(keep), 6), ATTACHMENT)
            for i, name in enumerate(attachments)
        },
        tire={
            wheel: table(_tire(landing, signal, gear.name, wheel), TIRE)
            for gear in landing.gears
            for wheel in gear.wheel_names
        },
        strut={
            gear.name: table(
                np.hstack(
                    [
                        signal(f"strut_{gear.name}.strut"),
                        signal(f"shock_absorber_{gear.name}.force"),
                    ]
                ),
                STRUT,
            )
            for gear in landing.gears
        },
        bending={
            name: table(signal(f"elastic_legs.deflection_{name}"), BENDING)
            for name, bodies in landing.bodies.items()
            if bodies.hinges
        },
        monitoring={
            point: table(points[:, i, 0] @ R_AB, POINT)
            for i, point in enumerate(monitoring)
        },
        motion=table(signal("airframe.pose"), _POSE),
        bodies=_body_poses(landing, signal("plant.state")),
        amplitudes=signal("airframe.modal_amplitudes"),
        energy=_energy(landing, signal, index),
        lift_change=_lift_change(landing, signal, R_AB),
        figures=figures,
    )


def _tire(landing: LandingDiagram, signal, gear: str, wheel: str) -> Float64:
    """Columns `TIRE`."""
    contact = signal(f"tire_{wheel}.contact")
    joint = landing.bodies[gear].spins[wheel]
    rate = signal("plant.state")[
        :, landing.plant.num_positions() + joint.velocity_start()
    ]
    # A wheel that rolls toward -x turns in the negative sense about the axle.
    return np.column_stack([contact, -rate])


def _body_poses(landing: LandingDiagram, states: Float64) -> dict[str, Float64]:
    """(t, 7) quaternion and position in W of every body of the gears."""
    plant = landing.plant
    context = plant.CreateDefaultContext()
    bodies = [
        body
        for gear in landing.bodies.values()
        for body in (
            gear.fitting,
            *(hinge.child_body() for hinge in gear.hinges.values()),
            *gear.parts.values(),
            *gear.wheels.values(),
        )
    ]
    found = {body.name(): np.empty((len(states), 7)) for body in bodies}
    for i, state in enumerate(states):
        plant.SetPositionsAndVelocities(context, state)
        for body in bodies:
            pose = plant.EvalBodyPoseInWorld(context, body)
            found[body.name()][i, :4] = pose.rotation().ToQuaternion().wxyz()
            found[body.name()][i, 4:] = pose.translation()
    return found


def _lift_change(landing: LandingDiagram, signal, R_AB: Float64) -> dict[int, Float64]:
    """Grid -> (t, 3) force that lift and reverse thrust have gained there, B."""
    if landing.lift is None:
        return {}
    turns = [rotation_from_quaternion(q) for q in signal("airframe.pose")[:, :4]]
    found: dict[int, Float64] = {}
    for name, load, direction in (
        ("lift", landing.lift, (0.0, 0.0, 1.0)),
        ("reverse_thrust", landing.reverse_thrust, AFT),
    ):
        if load is None:
            continue
        force = signal(f"{name}.node_force")
        change = force - force[0]
        if not change.any():
            continue
        in_B = np.array([np.array(direction) @ R_WA for R_WA in turns]) @ R_AB
        for i, node in enumerate(load.nodes):
            found[node] = found.get(node, 0.0) + change[:, i, None] * in_B
    return found


def _energy(landing: LandingDiagram, signal, index: pd.Index) -> pd.DataFrame:
    """Where the energy is; the gears' kinetic energy is what the others leave."""

    def stored(names: Sequence[str]) -> Float64:
        return np.sum([signal(f"{name}.energy")[:, 0] for name in names], axis=0)

    total = signal("energy_budget.total")[:, 0]
    parts = {
        "airframe": stored(["airframe"]),
        "shock absorbers": stored(list(systems_of(landing.shock_absorbers))),
        "tyres": stored(list(systems_of(landing.tires))),
    }
    if landing.pitch_dampers:
        parts["pitch dampers"] = stored(
            [f"pitch_damper_{gear}" for gear in landing.pitch_dampers]
        )
    if landing.elastic_legs is not None:
        parts["legs"] = stored(["elastic_legs"])
    if landing.lift is not None:
        parts["taken by the lift"] = -signal("energy_budget.supplied")[:, 0]
    parts["dissipated"] = signal("energy_budget.dissipated")[:, 0]
    parts["gears, moving"] = total - np.sum(list(parts.values()), axis=0)
    return pd.DataFrame({**parts, "balance": total - total[0]}, index=index)
