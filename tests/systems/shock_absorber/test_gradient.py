"""A diagram with a shock absorber converts to AutoDiffXd: gradients of a landing."""

import numpy as np
import pytest
from pydrake.autodiffutils import AutoDiffXd
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator_
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import LinearSystem

from systems.shock_absorber.gas_spring import GasSpring
from systems.shock_absorber.shock_absorber import ShockAbsorber
from systems.shock_absorber.strut_parameters import ShockAbsorberParameters

MASS, SINK_RATE, STEP = 20e3, 2.0, 2e-3
PARAMETERS = ShockAbsorberParameters(
    gas=GasSpring(precharge=45e3, gas_length=0.52),
    max_stroke=0.47,
    compression_damping=6e4,
    rebound_damping=2e5,
    thermal_time=10.0,
    seal_friction=0.05,
)


def rig():
    """A mass that runs onto a strut: stroke and rate, m s'' = -force."""
    builder = DiagramBuilder()
    zero, one = np.zeros((2, 1)), np.eye(2)
    mass = LinearSystem(
        [[0.0, 1.0], [0.0, 0.0]], [[0.0], [-1.0 / MASS]], one, zero, 0.0
    )
    builder.AddNamedSystem("mass", mass)
    strut = builder.AddNamedSystem("strut", ShockAbsorber(PARAMETERS))
    builder.Connect(mass.get_output_port(), strut.GetInputPort("strut_state"))
    builder.Connect(strut.GetOutputPort("force"), mass.get_input_port())
    return builder.Build()


def peak_force(diagram, T, precharge, damping):
    """Largest strut force at the steps of a landing, N."""
    simulator = Simulator_[T](diagram)
    context = simulator.get_mutable_context()
    strut = diagram.GetSubsystemByName("strut")
    own = strut.GetMyMutableContextFromRoot(context)
    tunables = own.get_mutable_numeric_parameter(0)
    tunables.SetAtIndex(0, precharge)
    tunables.SetAtIndex(3, damping)
    mass = diagram.GetSubsystemByName("mass").GetMyMutableContextFromRoot(context)
    mass.SetContinuousState(np.array([T(0.0), T(SINK_RATE)]))
    integrator = ResetIntegratorFromFlags(simulator, "runge_kutta3", STEP)
    integrator.set_fixed_step_mode(True)
    force, found = strut.GetOutputPort("force"), []
    for i in range(1, 80):
        simulator.AdvanceTo(i * STEP)
        found.append(force.Eval(own)[0])
    return max(found)


def test_gradient_of_the_peak_force_is_that_of_differences():
    diagram = rig()
    at = (45e3, 6e4)
    exact = peak_force(
        diagram.ToAutoDiffXd(),
        AutoDiffXd,
        AutoDiffXd(at[0], [1.0, 0.0]),
        AutoDiffXd(at[1], [0.0, 1.0]),
    )
    assert exact.value() == pytest.approx(peak_force(diagram, float, *at), rel=1e-9)
    for i, derivative in enumerate(exact.derivatives()):
        h = np.array(at)[i] * 1e-4 * np.eye(2)[i]
        above, below = (peak_force(diagram, float, *(at + d)) for d in (h, -h))
        assert derivative == pytest.approx((above - below) / (2 * h[i]), rel=1e-4)
