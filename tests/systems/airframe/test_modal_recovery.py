"""Recovery of reduced stresses from modal amplitudes."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydrake.systems.framework import DiagramBuilder

from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.airframe.modal_recovery import AddModalRecovery, ModalRecovery
from tests.systems.synthetic_body import NOSE_GEAR, aircraft_body


def test_recovered_is_the_product():
    matrix = np.arange(6.0).reshape(2, 3)
    system = ModalRecovery(matrix)
    context = system.CreateDefaultContext()
    amplitudes = np.array([1.0, -2.0, 0.5])
    system.GetInputPort("modal_amplitudes").FixValue(context, amplitudes)
    found = system.GetOutputPort("recovered").Eval(context)
    assert_allclose(found, matrix @ amplitudes)


def test_sees_the_amplitudes_of_the_modal_body():
    """Not the scaled ones of the state: here nodal displacements are recovered."""
    body = aircraft_body(5)
    builder = DiagramBuilder()
    airframe = builder.AddNamedSystem("airframe", FlexibleAirframe(body, [NOSE_GEAR]))
    row = int(body.rows(NOSE_GEAR)[0])
    recovery = AddModalRecovery(builder, airframe, body.translation[row])
    diagram = builder.Build()
    context = diagram.CreateDefaultContext()
    eta = np.array([3.0, -1.0, 0.5, 2.0, 1.0])
    airframe.set_state(airframe.GetMyMutableContextFromRoot(context), p_WG=body.p_BG)
    own = airframe.GetMyMutableContextFromRoot(context)
    airframe.set_state(own, p_WG=body.p_BG, modal_amplitudes=eta)
    moved = airframe.GetOutputPort("node_pose").Eval(own)[9:] - body.p_BN[row]
    found = recovery.GetOutputPort("recovered").Eval(
        recovery.GetMyContextFromRoot(context)
    )
    assert_allclose(found, moved, atol=1e-13)


@pytest.mark.parametrize(
    ("matrix", "message"),
    [(np.ones(3), r"shape \(3,\)"), ([[1.0, np.nan]], "not finite")],
)
def test_bad_matrix(matrix, message):
    with pytest.raises(ValueError, match=message):
        ModalRecovery(matrix)


def test_matrix_must_have_a_column_for_each_mode():
    builder = DiagramBuilder()
    airframe = builder.AddSystem(FlexibleAirframe(aircraft_body(5), [NOSE_GEAR]))
    with pytest.raises(ValueError, match="4 columns, expected 5"):
        AddModalRecovery(builder, airframe, np.ones((2, 4)))
