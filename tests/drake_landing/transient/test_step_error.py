"""What a time step costs is known before the transient."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from drake_landing.airframe.basis import elastic_basis
from drake_landing.airframe.load_shapes import load_model
from drake_landing.airframe.selection import expected_pulses, modal_model
from drake_landing.case.airframe import Airframe
from drake_landing.case.schema import Case
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.explain import explain
from drake_landing.transient.response import transient_response
from drake_landing.transient.step_error import (
    StepRefused,
    expected_step_error,
    step_error,
)
from fem.errors import InputError
from tests.drake_landing.one_aircraft import SI, case_of


def case_with(folder: Path, transient: str) -> Case:
    return case_of(folder, SI, ("step: 5.0e-4", transient))


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory):
    folder = tmp_path_factory.mktemp("model")
    case = case_with(folder, "step: 5.0e-4")
    aircraft = prepare_aircraft(case, folder)
    structure = aircraft.structure()
    pulses = expected_pulses(structure, case.airframe, aircraft, case.scenario)
    return structure, aircraft, load_model(structure, aircraft), pulses


def peaks(structure, aircraft, pulses, step: float, scheme: str) -> np.ndarray:
    """(2, p, 3) extremes of the direct transient under the pulses."""
    nodes = [int(n) for pulse in pulses for n in pulse.node_id]
    load = np.concatenate([pulse.load for pulse in pulses]).transpose(1, 0, 2)
    order = np.argsort(nodes)
    time = pulses[0].step * np.arange(len(load))
    loads = AttachmentLoads(
        time=time, node_id=np.array(nodes)[order], load=load[:, order]
    ).resampled(step, float(time[-1]))
    found = transient_response(structure, loads, aircraft.monitoring, scheme)
    values = np.stack([table.to_numpy() for table in found.values()])
    return np.stack([values.max(axis=1), values.min(axis=1)])


@pytest.mark.parametrize("scheme", ["nastran", "generalised-alpha"])
def test_expected_error_is_that_of_the_transient(scheme: str, model) -> None:
    structure, aircraft, shapes, pulses = model
    fine = peaks(structure, aircraft, pulses, 1e-4, scheme)
    size = np.abs(fine).max(axis=0)
    counts = size > 0.05 * size.max()
    for step in (1e-3, 4e-3):
        coarse = peaks(structure, aircraft, pulses, step, scheme)
        missed = (np.abs(coarse - fine).max(axis=0) / size)[counts].max()
        found = step_error(shapes, pulses, list(aircraft.monitoring), step, scheme)
        assert found.error == pytest.approx(missed, rel=0.15, abs=2e-3)


def test_shapes_of_loads_have_the_lowest_modes(model) -> None:
    structure, aircraft, shapes, _ = model
    basis = elastic_basis(
        structure, Airframe(deck=Path(), monitoring={"nose": 1}, select="count 5"), []
    )
    exact = modal_model(structure, basis, aircraft)
    assert shapes.frequency_hz[6:11] == pytest.approx(exact.frequency_hz[6:11])
    assert shapes.damping[6:11] == pytest.approx(exact.damping[6:11])
    assert np.abs(shapes.monitor[..., 6:11]) == pytest.approx(
        np.abs(exact.monitor[..., 6:11]), abs=1e-6
    )


def test_error_falls_with_the_square_of_the_step(model) -> None:
    _, aircraft, shapes, pulses = model
    names = list(aircraft.monitoring)
    found = [step_error(shapes, pulses, names, h).error for h in (1e-3, 5e-4)]
    assert 2.5 < found[0] / found[1] < 6.0


def test_large_steps_are_warned_of_and_then_refused(tmp_path: Path) -> None:
    refused = case_with(tmp_path, "step: 0.01")
    with pytest.raises(InputError) as caught:
        explain(refused, tmp_path)
    message = str(caught.value)
    assert "transient.step" in message
    assert "case.yaml:" in message
    assert "accept:" in message
    percent = float(message.split("accept: ")[1].split("'")[0])
    taken = explain(case_with(tmp_path, f"step: 0.01, accept: {percent:g}"), tmp_path)
    assert "note: case.yaml:" in taken
    assert "would bring that below 2 %" in taken
    good = explain(case_with(tmp_path, "step: 5.0e-4"), tmp_path)
    assert "peak accelerations expected to be" in good
    assert "transient.step" not in good


def test_a_stiff_local_motion_is_named_with_remedies(tmp_path: Path) -> None:
    """A gear's grid of 5 kg on a spring of 400 Hz: k = (2 pi f)² m."""
    hz, mass = 400.0, 5.0
    k = (2.0 * np.pi * hz) ** 2 * mass
    fitting = (
        f"GRID,99,,3.9,1.2,0.1\nCONM2,99,99,,{mass}\n"
        f"CELAS2,99,{k:.1f},11,3,99,3\nRBAR,98,11,99,123456,,,12456"
    )
    case = case_of(
        tmp_path,
        replace(SI, more={"fitting": fitting}),
        ("tip: 12}", "tip: 12, gear: 99}"),
        ("attachment_node: 11", "attachment_node: 99"),
        ("step: 5.0e-4", "step: 1.0e-3"),
    )
    aircraft = prepare_aircraft(case, tmp_path)
    structure = aircraft.structure()
    shapes = load_model(structure, aircraft)
    pulses = expected_pulses(structure, case.airframe, aircraft, case.scenario)
    with pytest.raises(StepRefused) as refused:
        expected_step_error(case, aircraft, structure, shapes, pulses)
    found = refused.value.found
    assert found.cause is not None
    # Somewhat above, as the airframe yields.
    assert found.cause.frequency_hz == pytest.approx(hz, rel=0.03)
    assert found.cause.grid == 99
    assert found.cause.share > 0.9
    assert found.cause.slower < 0.1 < 0.4 < found.error
    assert "is at grid 99" in str(refused.value)
    assert "another grid for the point 'gear'" in str(refused.value)
    # Pulses between their samples are no matter: a step that is small enough is found.
    assert found.enough == 1e-4
    assert "'step: 0.0001'" in str(refused.value)
