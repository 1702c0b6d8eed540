"""The lattice aircraft of `lattice_aircraft`, landed by this project's systems.

Airframe, shock absorbers and tires are the ordinary systems; the point masses are
`point_wheels`. The oleo of the case has its full preload at stroke zero and an
extension stop beyond it; a shock absorber has the stop from zero stroke on and is in
balance there. They are one law when stroke is counted from the balance, s_0 =
preload/stiffness of the stop earlier; within s_0 the forces differ by less than the
tenth of the preload by which the gas stiffens there.
"""

from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig
from pydrake.systems.framework import Diagram, DiagramBuilder
from pydrake.systems.primitives import LogVectorOutput, VectorLogSink

from benchmarks.lattice_aircraft import (
    DURATION,
    GAS_EXPONENT,
    GAS_LENGTH,
    GEARS,
    MASS,
    OLEO_LENGTH,
    SIDE_DAMPING,
    SIDE_STIFFNESS,
    SINK_RATE,
    STIFFNESS_DAMPING,
    STOP_STIFFNESS,
    STROKE,
    TIP,
    TIRE_DAMPING,
    PointGear,
    lattice,
    reduced,
)
from benchmarks.point_wheels import PointWheel, PointWheels
from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.airframe.modal_body import ModalBody
from systems.shock_absorber.gas_spring import GasSpring
from systems.shock_absorber.shock_absorber import ShockAbsorber
from systems.shock_absorber.strut_parameters import ShockAbsorberParameters
from systems.tire.slip import SineSlip
from systems.tire.tire import Tire
from systems.tire.tire_parameters import TireParameters
from systems.tools.table import Table

TIP_NODE = 9
_RADIUS = 0.5  # m, any: the case has a point


def modal_body() -> ModalBody:
    """Gears are nodes 1, 2, 3, in the order of GEARS; the tip is TIP_NODE."""
    model, modes = lattice(), reduced()
    middles = [model.xyz[rows].mean(axis=0) for rows in model.faces.values()]
    tip = model.row(TIP)
    n = len(modes.frequency)
    translation, rotation = modes.interface[:, :3], modes.interface[:, 3:]
    of_tip = modes.shape.reshape(-1, 3, n)[tip]
    return ModalBody(
        mass=MASS,
        p_BG=modes.p_G,
        inertia_G=modes.inertia,
        frequency=modes.frequency,
        modal_mass=np.ones(n),
        modal_damping=np.diag(STIFFNESS_DAMPING * (2 * np.pi * modes.frequency) ** 2),
        node_id=np.array([1, 2, 3, TIP_NODE]),
        p_BN=np.array([*middles, model.xyz[tip]]),
        translation=np.concatenate([translation, of_tip[None]]),
        rotation=np.concatenate([rotation, np.zeros((1, 3, n))]),
    )


def _preloaded_stroke(gear: PointGear) -> float:
    return gear.preload / STOP_STIFFNESS


def _absorber(gear: PointGear) -> ShockAbsorberParameters:
    before = _preloaded_stroke(gear)
    length = GAS_LENGTH + before
    precharge = gear.preload * (GAS_LENGTH / length) ** GAS_EXPONENT
    return ShockAbsorberParameters(
        gas=GasSpring(precharge=precharge, gas_length=length, exponent=GAS_EXPONENT),
        max_stroke=STROKE + before,
        compression_damping=gear.orifice,
        rebound_damping=gear.orifice,
        extension_stop_stiffness=STOP_STIFFNESS,
        bottoming_stop_stiffness=STOP_STIFFNESS,
        stop_damping=0.0,
    )


def _tire(gear: PointGear) -> TireParameters:
    return TireParameters(
        radius=_RADIUS,
        stiffness=gear.tire,
        damping=Table((0.0, 1.0), (0.0, TIRE_DAMPING * gear.tire), extend=True),
        slip=SineSlip(peak=0.0),
    )


@dataclass(frozen=True, kw_only=True)
class LatticeLanding:
    """The diagram; loggers "oleo_<gear>", "tire_<gear>" (N) and "tip" (m/s²)."""

    diagram: Diagram
    airframe: FlexibleAirframe
    wheels: PointWheels
    loggers: dict[str, VectorLogSink]


def make_landing(body: ModalBody) -> LatticeLanding:
    """The landing of a body with the nodes of `modal_body`."""
    builder = DiagramBuilder()
    airframe = builder.AddNamedSystem(
        "airframe", FlexibleAirframe(body, [1, 2, 3], [TIP_NODE])
    )
    wheels = builder.AddNamedSystem(
        "wheels",
        PointWheels(
            [
                PointWheel(
                    name=gear.name,
                    mass=gear.wheel,
                    length=OLEO_LENGTH + _preloaded_stroke(gear),
                    side_stiffness=SIDE_STIFFNESS,
                    side_damping=SIDE_DAMPING,
                )
                for gear in GEARS
            ]
        ),
    )
    for port in ("node_pose", "node_velocity"):
        builder.Connect(airframe.GetOutputPort(port), wheels.GetInputPort(port))
    builder.Connect(
        wheels.GetOutputPort("wrench"), airframe.GetInputPort("attachment_wrench")
    )
    ports = {"tip": airframe.GetOutputPort("monitor_acceleration")}
    absorber_system, tire_system = cast(Any, ShockAbsorber), cast(Any, Tire)
    for gear in GEARS:
        absorber = builder.AddSystem(absorber_system(_absorber(gear)))
        tire = builder.AddSystem(tire_system(_tire(gear)))
        for source, system, target, output in (
            (f"strut_{gear.name}", absorber, "strut_state", "force"),
            (f"wheel_{gear.name}", tire, "wheel", "wrench"),
        ):
            builder.Connect(wheels.GetOutputPort(source), system.GetInputPort(target))
            back = source if system is absorber else f"tire_{gear.name}"
            builder.Connect(system.GetOutputPort(output), wheels.GetInputPort(back))
        ports[f"oleo_{gear.name}"] = absorber.GetOutputPort("force")
        ports[f"tire_{gear.name}"] = tire.GetOutputPort("wrench")
    loggers = {name: LogVectorOutput(port, builder) for name, port in ports.items()}
    return LatticeLanding(
        diagram=builder.Build(), airframe=airframe, wheels=wheels, loggers=loggers
    )


@dataclass(frozen=True, kw_only=True)
class Landed:
    """Largest magnitudes, N and m/s²: "oleo_<gear>", "tire_<gear>", "tip"."""

    peaks: dict[str, float]
    evaluations: int


def land(landing: LatticeLanding, scheme: str, accuracy: float) -> Landed:
    """One second of the case."""
    simulator = Simulator(landing.diagram)
    config = SimulatorConfig(
        integration_scheme=scheme, accuracy=accuracy, max_step_size=5e-3
    )
    ApplySimulatorConfig(config, simulator)
    root = simulator.get_mutable_context()
    model = lattice()
    tops = np.array([model.xyz[rows].mean(axis=0) for rows in model.faces.values()])
    height = _RADIUS + OLEO_LENGTH
    up = np.array([0.0, 0.0, 1.0])
    landing.airframe.set_state(
        landing.airframe.GetMyMutableContextFromRoot(root),
        p_WG=reduced().p_G + height * up,
        v_WG=-SINK_RATE * up,
    )
    places = tops + _RADIUS * up
    velocities = np.tile(-SINK_RATE * up, 3)
    landing.wheels.GetMyMutableContextFromRoot(root).SetContinuousState(
        np.concatenate([places.ravel(), velocities])
    )
    simulator.Initialize()
    simulator.AdvanceTo(DURATION)
    row = {"tip": 2, "oleo": 0, "tire": 5}
    peaks = {
        name: float(np.abs(log.FindLog(root).data()[row[name.split("_")[0]]]).max())
        for name, log in landing.loggers.items()
    }
    evaluations = simulator.get_integrator().get_num_derivative_evaluations()
    return Landed(peaks=peaks, evaluations=evaluations)
