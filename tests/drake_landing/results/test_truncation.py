"""What modes that are left out cost, and what lies above them in a history."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.airframe.basis import elastic_basis
from drake_landing.airframe.load_shapes import load_model
from drake_landing.airframe.selection import expected_pulses, modal_model
from drake_landing.airframe.truncation import (
    WANTED,
    below,
    frequency_for,
    load_errors,
    point_errors,
)
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.explain import explain
from drake_landing.results.truncation import low_passed
from tests.drake_landing.one_aircraft import SI, case_of


@pytest.fixture(scope="module")
def known(tmp_path_factory: pytest.TempPathFactory):
    folder = tmp_path_factory.mktemp("model")
    case = case_of(folder)
    aircraft = prepare_aircraft(case, folder)
    structure = aircraft.structure()
    pulses = expected_pulses(structure, case.airframe, aircraft, case.scenario)
    return case, aircraft, structure, load_model(structure, aircraft), pulses


def test_the_proposed_frequency_keeps_the_error_and_no_lower_one(known) -> None:
    *_, shapes, pulses = known
    hz = frequency_for(shapes, pulses)
    assert hz is not None
    assert point_errors(shapes, below(shapes, hz), pulses).max() <= WANTED
    assert point_errors(shapes, below(shapes, hz - 5.0), pulses).max() > WANTED
    assert point_errors(shapes, shapes, pulses).max() < 1e-12


def test_shapes_of_loads_tell_the_error_of_eigenmodes(known) -> None:
    case, aircraft, structure, shapes, pulses = known
    for hz in (15.0, 40.0):
        text = case.airframe.model_copy(
            update={"select": case.airframe.select.model_copy(update=_below(hz))}
        )
        modes = modal_model(structure, elastic_basis(structure, text, []), aircraft)
        told = point_errors(shapes, below(shapes, hz), pulses)
        found = point_errors(shapes, modes, pulses)
        assert told == pytest.approx(found, rel=0.05, abs=5e-3)


def _below(hz: float) -> dict:
    return {"kind": "below", "value": hz}


def test_errors_of_gear_loads_follow_the_flexibility_left_out(known) -> None:
    _, _, structure, shapes, _ = known
    nodes = sorted(shapes.attachment)
    load = {n: np.zeros((1, 6)) for n in nodes}
    load[nodes[1]][0, 2] = 1e4
    closing = {n: 0.2 for n in nodes}
    largest = {n: 1e4 for n in nodes}
    none = load_errors(shapes, shapes, load, closing, largest)
    assert max(none.values()) < 1e-12
    rigid = shapes.of(np.arange(6))
    found = load_errors(shapes, rigid, load, closing, largest)
    # Static answer of the free airframe in mean axes, by inertia relief.
    pattern = structure.operator([nodes[1]], (3,), frame="basic").toarray()[0] * 1e4
    motion = structure.rigid_body
    mass = structure.mass
    gram = motion.T @ (mass @ motion)
    balanced = pattern - mass @ motion @ np.linalg.solve(gram, motion.T @ pattern)
    u = np.linalg.lstsq(structure.stiffness.toarray(), balanced, rcond=1e-12)[0]
    u -= motion @ np.linalg.solve(gram, motion.T @ (mass @ u))
    moved = structure.operator([nodes[1]], (1, 2, 3), frame="basic") @ u
    assert found[nodes[1]] == pytest.approx(np.linalg.norm(moved) / 0.2, rel=1e-3)
    # A gear in the air has no error, one that is hardly loaded none of its own load.
    lightly = load_errors(
        shapes, rigid, load, {**closing, nodes[0]: 1e-6}, {**largest, nodes[0]: 0.0}
    )
    assert lightly == {n: found[n] for n in nodes if n != nodes[0]}
    stiffness = 1e4 / 0.2
    for closed in (1e-3, 1e-5):
        touched = {**largest, nodes[0]: stiffness * closed}
        lightly = load_errors(
            shapes, rigid, load, {**closing, nodes[0]: closed}, touched
        )
        assert lightly[nodes[0]] == pytest.approx(10.0 * found[nodes[0]])


def test_low_pass_keeps_what_is_below_and_takes_what_is_above() -> None:
    time = 5e-4 * np.arange(4001)
    slow, fast = np.sin(2 * np.pi * 8 * time), 0.7 * np.sin(2 * np.pi * 250 * time)
    found = low_passed((slow + fast)[:, None], 5e-4, 50.0)[:, 0]
    assert np.abs(found - slow)[200:-200].max() < 0.01
    assert low_passed(slow[:, None], 5e-4, 0.0)[:, 0] == pytest.approx(slow)


def test_check_tells_the_error_of_a_selection_by_frequency(tmp_path: Path) -> None:
    case = case_of(tmp_path, SI, ("select: count 5", "select: below 10 Hz"))
    assert "accelerations expected to be up to" in explain(case, tmp_path)
