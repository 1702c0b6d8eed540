"""Each system's docstring has one table of exactly its ports, with sizes."""

import importlib
import inspect
import pkgutil
import re

import numpy as np
import pytest
from pydrake.systems.framework import LeafSystem, PortDataType

import systems
from systems.airframe.distributed_load import DistributedLoad
from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.airframe.modal_recovery import ModalRecovery
from systems.airframe.quasi_steady_lift import QuasiSteadyLift, Surface
from systems.attachment.attachment import Attachment, RigidAttachment
from systems.attachment.bushing_attachment import BushingAttachment
from systems.gear.bogie_pitch import BogiePitch, BogiePitchParameters
from systems.gear.brake import Brake, BrakeParameters
from systems.gear.elastic_legs import ElasticLeg, ElasticLegs
from systems.gear.energy_budget import EnergyBudget
from systems.gear.gear_forces import GearForces
from systems.gear.lever_strut import LeverStrut
from systems.gear.wheel_kinematics import WheelKinematics
from systems.shock_absorber.gas_spring import GasSpring
from systems.shock_absorber.shock_absorber import ShockAbsorber
from systems.shock_absorber.side_load import SideLoad
from systems.shock_absorber.strut_parameters import ShockAbsorberParameters
from systems.tire.tire import Tire
from systems.tire.tire_parameters import TireParameters
from tests.systems.small_gears import two_gears
from tests.systems.synthetic_body import LEFT_GEAR, RIGHT_GEAR, aircraft_body

PLANT, FITTINGS, WHEELS, STRUTS, SPINS = two_gears()
BODY = aircraft_body(4)
GAS = GasSpring(precharge=1e4, gas_length=0.5, area=0.02)
ABSORBER = ShockAbsorberParameters(
    gas=GAS, max_stroke=0.4, compression_damping=1e4, rebound_damping=1e4
)
# A lever strut over any revolute joint: only its ports are looked at.
LEVER = LeverStrut.over(SPINS["left"], [0.0, 0.0, 1.0], [0.4, 0.0, 0.0])
# Any revolute joint as the hinge of a leg.
LEG = ElasticLeg(
    hinges=[SPINS["left"]],
    strut=STRUTS["left"],
    start=0.0,
    end=0.4,
    stiffness=np.full((2, 1, 1), 1e6),
    damping=np.zeros((2, 1, 1)),
    free_play=np.zeros(1),
)
MIXED = {"left": LEVER, "right": STRUTS["right"]}
SIZES = {
    "nq + nv": PLANT.num_multibody_states(),
    "nv": PLANT.num_velocities(),
    "6 k nv": 12 * PLANT.num_velocities(),
    "n": 4,
    "k": 1,
    "6 + n": 10,
    **{f"{factor} {k}": 2 * factor for factor in (6, 12) for k in ("k", "k_a", "k_m")},
    **{f"(6 {k})²": 144 for k in ("k", "k_a")},
    "c": 3,
    "s": 2,
    **{f"{factor} n": 4 * factor for factor in (2, 3, 4, 6, 12)},
    **{f"{factor} s": 2 * factor for factor in (2, 3)},
}
SYSTEMS = {
    Tire: lambda: Tire([TireParameters(radius=0.5, stiffness=1e6)] * 4),
    ShockAbsorber: lambda: ShockAbsorber([ABSORBER] * 4),
    Brake: lambda: Brake(BrakeParameters(torque=1e3)),
    BogiePitch: lambda: BogiePitch(BogiePitchParameters()),
    SideLoad: lambda: SideLoad([{wheel: 0.0} for wheel in WHEELS], list(WHEELS)),
    WheelKinematics: lambda: WheelKinematics(PLANT, WHEELS, MIXED, SPINS, SPINS),
    GearForces: lambda: GearForces(
        PLANT, WHEELS, MIXED, SPINS, SPINS, elastic_legs=True
    ),
    ElasticLegs: lambda: ElasticLegs(PLANT, {"left": LEG}, {"left": [0]}),
    FlexibleAirframe: lambda: FlexibleAirframe(
        BODY, [LEFT_GEAR, RIGHT_GEAR], [LEFT_GEAR, RIGHT_GEAR]
    ),
    RigidAttachment: lambda: RigidAttachment(PLANT, list(FITTINGS.values())),
    BushingAttachment: lambda: BushingAttachment(PLANT, list(FITTINGS.values())),
    DistributedLoad: lambda: DistributedLoad(BODY, [LEFT_GEAR], [1.0], 1e3),
    QuasiSteadyLift: lambda: QuasiSteadyLift(
        BODY, 1e3, Surface(nodes=[LEFT_GEAR], shares=[1.0], area=1.0, slope=5.0)
    ),
    ModalRecovery: lambda: ModalRecovery(np.ones((3, 4))),
    EnergyBudget: lambda: EnergyBudget(PLANT, ["a"], ["a"], ["a"]),
}


def _table(kind):
    """Port of the docstring, with a pattern for its name -> size."""
    if issubclass(kind, Attachment):  # ports of the base
        kind = Attachment
    rows = re.findall(r"\| (in|out) (.+?) \| (.+?) \|", kind.__doc__)
    found = {}
    for side, names, size in rows:
        for name in re.findall(r"`([^`]+)`", names)[:1]:
            pattern = re.sub(r"<\w+>", r"(.+)", name)
            found[side, pattern] = size
    return found


def _ports(system):
    for side, count, get in (
        ("in", system.num_input_ports(), system.get_input_port),
        ("out", system.num_output_ports(), system.get_output_port),
    ):
        for i in range(count):
            port = get(i)
            vector = port.get_data_type() == PortDataType.kVectorValued
            yield side, port.get_name(), port.size() if vector else "abstract"


@pytest.mark.parametrize("kind", SYSTEMS, ids=lambda kind: kind.__name__)
def test_docstring_has_one_table_of_exactly_the_ports(kind):
    table, used = _table(kind), set()
    for side, name, size in _ports(SYSTEMS[kind]()):
        # The longest pattern that fits: `wheel_jacobian` before `wheel_<name>`.
        fits = [p for s, p in table if s == side and re.fullmatch(p, name)]
        assert fits, f"{side} {name} is not in the table"
        row = side, max(fits, key=lambda p: len(p.replace("(.+)", "")))
        used.add(row)
        written = table[row]
        found = int(written) if written.isdigit() else SIZES.get(written, written)
        assert found == size, f"{side} {name}: {written} in the table, {size} in fact"
    assert used == set(table)


def test_every_system_is_looked_at():
    found = set()
    for module in pkgutil.walk_packages(systems.__path__, "systems."):
        contents = vars(importlib.import_module(module.name)).values()
        for value in contents:
            if inspect.isclass(value) and issubclass(value, LeafSystem):
                found.add(value)
    own = {kind for kind in found if kind.__module__.startswith("systems.")}
    assert own - {Attachment} == set(SYSTEMS)
