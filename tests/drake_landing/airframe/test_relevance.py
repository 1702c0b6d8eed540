"""Relevance ranks modes by what points feel, and knows what leaving out costs."""

from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.integrate import trapezoid

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.basis import Basis, elastic_basis
from drake_landing.airframe.body import load_airframe
from drake_landing.airframe.drop import drop_pulse
from drake_landing.airframe.oscillators import modal_accelerations
from drake_landing.airframe.pulses import is_symmetric, touchdown_pulses
from drake_landing.airframe.relevance import (
    ModalModel,
    Relevance,
    modal_pulse,
    response,
)
from drake_landing.airframe.selection import Candidates, modal_model, select_modes
from drake_landing.case.airframe import Airframe
from drake_landing.case.reading import parse_case
from drake_landing.case.schema import Case
from drake_landing.process.aircraft import prepare_aircraft
from fem.algebra.modes import Modes
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.structure import Structure
from fem.response.modal import modal_transient
from fem.response.observation import Observation
from fem.response.system import sampled_load

HERE = Path(__file__).parents[1]
TEXT = HERE.joinpath("tiny_case.yaml").read_text()


def tiny(select: str = "all", more: str = "", scenario: str = "") -> Case:
    text = TEXT.replace("select: count 6", f"select: {select}{more}")
    text = text.replace("forward_speed: 40", f"forward_speed: 40{scenario}")
    return parse_case(text, folder=HERE)


@pytest.fixture(scope="module")
def structure() -> Structure:
    return Structure.from_deck(read_deck(HERE / "tiny_aircraft.bdf"))


@pytest.fixture(scope="module")
def aircraft() -> Aircraft:
    return prepare_aircraft(tiny(), Path("unused"))


@pytest.fixture(scope="module")
def basis(structure: Structure, aircraft: Aircraft) -> Basis:
    return elastic_basis(structure, tiny().airframe, list(aircraft.nodes))


@pytest.fixture(scope="module")
def candidates(structure: Structure, basis: Basis, aircraft: Aircraft) -> Candidates:
    case = tiny()
    return Candidates.from_basis(
        structure, basis, case.airframe, aircraft, case.scenario
    )


@pytest.fixture(scope="module")
def relevance(candidates: Candidates) -> Relevance:
    return candidates.relevance


def test_modal_accelerations_are_exact_for_linear_pieces() -> None:
    # Against the general modal transient, an independent propagator of fem.
    rng = np.random.default_rng(1)
    frequency = np.array([0.0, 3.0, 40.0, 40.5, 900.0])
    omega = 2 * np.pi * frequency
    zeta = np.array([0.0, 0.02, 0.1, 1.0, 2.5])  # under, critically, overdamped
    step, count = 1e-3, 80
    force = np.cumsum(rng.normal(size=(count, 5)), axis=0)
    force[0] = 0.0
    ours = modal_accelerations(frequency, 2 * zeta * omega, force, step)
    modes = Modes(frequency_hz=frequency, shape=np.eye(5), rigid=1, sturm=())
    watched = Observation("acceleration", sp.eye(5, format="csr"))
    modal_transient(
        modes,
        sp.eye(5, format="csr"),
        sp.diags(2 * zeta * omega).tocsr(),
        steps=[(count - 1, step)],
        load=sampled_load(sp.eye(5), step * np.arange(count), force.T),
        observers=[watched],
    )
    np.testing.assert_allclose(ours, watched.history, rtol=0, atol=1e-9)


def test_a_dropped_gear_takes_the_momentum(aircraft: Aircraft) -> None:
    gear = aircraft.gears[1]
    pulse = drop_pulse(gear, 2000.0, 1.2, 40.0, step=5e-4, duration=0.25)
    velocity = 1.2 - trapezoid(pulse.vertical, pulse.time) / 2000.0
    rate = np.gradient(pulse.stroke, pulse.time)
    assert pulse.vertical[0] == pytest.approx(0.0, abs=1.0)
    assert -1.5 < velocity < 0.5  # stopped, or on the way up
    # The wheels end at the speed of rolling: the drag has spun them up.
    radius = gear.tyre.radius - 0.02
    spin = len(gear.wheel_names) * gear.wheel.spin_inertia * 40.0 / radius**2
    assert trapezoid(pulse.drag, pulse.time) == pytest.approx(spin, rel=0.15)
    assert pulse.stroke.max() < gear.shock_absorber.stroke + 0.01
    assert np.abs(rate).max() < 3.0


def test_symmetric_landings_leave_antisymmetric_modes_out(
    structure: Structure, basis: Basis, aircraft: Aircraft, relevance: Relevance
) -> None:
    model = modal_model(structure, basis, aircraft)
    half = len(relevance.order) // 4
    most = relevance.order[:half]
    lateral = np.abs(model.monitor[1, 1]) > 1e-6  # the center moves sideways
    assert not lateral[most].any()
    case = tiny(scenario=", roll: 3")
    assert not is_symmetric(case.scenario)
    rolled = Candidates.from_basis(
        structure, basis, case.airframe, aircraft, case.scenario
    ).relevance
    one, other = model.monitor[3, 2], model.monitor[4, 2]  # wing tips
    rolling = (np.abs(one + other) < 1e-6) & (np.abs(one) > 1e-6)
    assert rolling[rolled.order[:half]].any()
    assert not rolling[most].any()


def test_expected_errors_are_those_of_the_left_out_response(
    structure: Structure, basis: Basis, aircraft: Aircraft, relevance: Relevance
) -> None:
    model = modal_model(structure, basis, aircraft)
    case = tiny()
    points = structure.points
    pulses = touchdown_pulses(
        aircraft.gears,
        case.scenario,
        p_AN={n: points.xyz[points.rows(n)] for n in aircraft.attachment_nodes},
        mass=structure.weight.total,
        p_AG=structure.weight.center,
        R_AB=np.eye(3),
    )
    q = modal_pulse(model, pulses)
    whole = np.einsum("tn,pan->tpa", q, model.monitor)
    kept = np.concatenate([np.arange(6), relevance.order[:9]])
    part = np.einsum("tn,pan->tpa", q[:, kept], model.monitor[:, :, kept])
    lost = np.sqrt(((whole - part) ** 2).sum((0, 2)) / (whole**2).sum((0, 2)))
    np.testing.assert_allclose(
        relevance.error(relevance.order[:9]), lost, rtol=1e-6, atol=1e-9
    )


def test_relevant_modes_beat_the_lowest_ones(relevance: Relevance) -> None:
    # The same error with fewer than half the modes, at the worst point.
    lowest = relevance.error(relevance.elastic[:30]).max()
    assert relevance.count_for(lowest) <= 15
    errors = [relevance.error(relevance.order[:n]).max() for n in (5, 10, 20, 40, 114)]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] == 0.0


def test_a_mode_that_nobody_sees_comes_last() -> None:
    rng = np.random.default_rng(2)
    monitor = rng.normal(size=(2, 3, 4))
    monitor[:, :, 2] = 0.0
    model = ModalModel(
        frequency_hz=np.array([0.0, 4.0, 5.0, 6.0]),
        damping=np.full(4, 0.3),
        monitor=monitor,
        attachment={7: rng.normal(size=(6, 4))},
    )
    from drake_landing.airframe.pulses import GearPulses

    load = np.sin(np.linspace(0, 3, 200))[None, :, None] * rng.normal(size=6)
    pulse = GearPulses(names=("g",), node_id=np.array([7]), step=1e-3, load=load)
    ranked = Relevance.rank(model, ("a", "b"), [pulse])
    assert set(ranked.order) == {1, 2, 3}
    assert ranked.order[-1] == 2
    assert ranked.error(ranked.order[:2]).max() == 0.0


@pytest.mark.parametrize(
    ("select", "count"), [("relevance 12", 12), ("pulses 9", 9), ("below 20 Hz", 8)]
)
def test_case_selects(select: str, count: int, aircraft: Aircraft) -> None:
    case = tiny(select, "\n  candidates: 2000")
    model = load_airframe(case.airframe, aircraft, scenario=case.scenario)
    assert model.body.n == count
    assert np.all(np.diff(model.body.frequency) >= 0)
    told = any("expected truncation" in notice for notice in model.notices)
    assert told == case.airframe.select.by_relevance


def test_an_error_buys_as_many_modes_as_it_needs(
    candidates: Candidates, relevance: Relevance
) -> None:
    for percent in (5.0, 1.0):
        select = tiny(f"relevance error <= {percent:g} %").airframe.select
        n = len(select_modes(candidates, select).frequency_hz)
        assert relevance.error(relevance.order[:n]).max() <= percent / 100
        assert relevance.error(relevance.order[: n - 1]).max() > percent / 100


def test_residual_vectors_answer_statically_right(
    structure: Structure, aircraft: Aircraft
) -> None:
    plain = load_airframe(tiny("count 10").airframe, aircraft)
    case = tiny("count 10", "\n  residual_vectors: true")
    model = load_airframe(case.airframe, aircraft)
    assert model.body.n == 10 + 18
    np.testing.assert_allclose(model.body.frequency[:10], plain.body.frequency)
    every = load_airframe(tiny("all").airframe, aircraft).body

    def flexibility(body) -> float:
        shape = body.translation[body.rows(52)[0], 2]
        return float(np.sum(shape**2 / body.modal_mass / body.frequency**2))

    assert flexibility(model.body) == pytest.approx(flexibility(every), rel=1e-6)
    assert flexibility(plain.body) < 0.999 * flexibility(every)


def test_selections_read_as_written() -> None:
    for text in (
        "pulses 7",
        "relevance 40",
        "relevance error <= 2.5 %",
        "below 50 Hz",
        "all",
    ):
        assert str(Airframe(model="con", select=text).select) == text
    with pytest.raises(InputError, match="relevance error <= x %"):
        tiny("relevance error 3")
    with pytest.raises(InputError, match="relevance is for"):
        tiny("all", "\n  fixed_interface_modes: relevance 5")


def test_pulse_modes_are_a_modal_body(
    structure: Structure, candidates: Candidates, basis: Basis
) -> None:
    choice = candidates.choose(tiny("pulses 20").airframe.select)
    shape, frequency = choice.basis.shape, choice.basis.frequency_hz
    np.testing.assert_allclose(
        shape.T @ (structure.mass @ shape), np.eye(20), atol=1e-9
    )
    np.testing.assert_allclose(
        shape.T @ (structure.stiffness @ shape),
        np.diag((2 * np.pi * frequency) ** 2),
        atol=1e-8 * (2 * np.pi * frequency[-1]) ** 2,
    )
    rigid = structure.rigid_body
    assert np.abs(rigid.T @ (structure.mass @ shape)).max() < 1e-6 * rigid.shape[0]
    assert frequency[-1] <= basis.frequency_hz[-1]


def test_pulse_modes_converge(candidates: Candidates) -> None:
    # Under pulses other than those they were made for.
    whole = response(candidates.model, candidates.trials[-1])

    def missing(count: int) -> float:
        model = candidates.choose(tiny(f"pulses {count}").airframe.select).model
        lost = response(model, candidates.trials[-1]) - whole
        return float(np.sqrt((lost**2).sum() / (whole**2).sum()))

    errors = [missing(count) for count in (6, 12, 24, 48)]
    assert errors == sorted(errors, reverse=True)
    assert errors[2] < 2e-3
    assert errors[3] < 1e-5
