"""Bases: rounding of a condensation is no support; residual vectors by themselves."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.airframe import basis as room
from drake_landing.airframe.basis import (
    elastic_basis,
    residual_basis,
    with_residual_vectors,
)
from drake_landing.airframe.selection import modal_model
from drake_landing.cache import Cache
from drake_landing.case.airframe import Airframe
from fem.deck.reader import read_deck
from fem.model.structure import Structure

DECK = Path(__file__).parents[1] / "tiny_aircraft.bdf"
GEARS = [51, 52, 53]


@pytest.fixture(scope="module")
def structure() -> Structure:
    return Structure.from_deck(read_deck(DECK))


def airframe(basis: str, select: str) -> Airframe:
    return Airframe.model_validate(
        {"deck": DECK, "basis": basis, "select": select, "monitoring": {"nose": 51}}
    )


def test_rounding_of_what_is_condensed_is_no_support(structure: Structure) -> None:
    rng = np.random.default_rng(4)
    rigid = rng.normal(size=(40, 6))
    q, _ = np.linalg.qr(rigid)
    free = np.eye(40) - q @ q.T
    noise = rng.normal(size=(40, 40)) * 1e-7
    rounded = free @ np.diag(rng.uniform(1, 9, 40)) @ free + noise + noise.T
    assert np.abs(rounded @ rigid).max() > 1e-7
    clean = room._without_rounding(rounded, rigid, structure)
    assert np.abs(clean @ rigid).max() < 1e-13
    np.testing.assert_allclose(clean, clean.T, atol=1e-15)
    np.testing.assert_allclose(clean, rounded, atol=1e-5)


def test_a_held_structure_stays_held(
    structure: Structure, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(room, "rigid_energy", lambda *_: np.array([1e-6]))
    stiffness = np.eye(12)
    assert room._without_rounding(stiffness, np.eye(12)[:, :6], structure) is stiffness


def test_guyan_keeps_masses_at_the_interface(structure: Structure) -> None:
    full = elastic_basis(structure, airframe("full-modes", "count 20"), [])
    kept = structure.points.grid_id.tolist()
    reduced = elastic_basis(structure, airframe("guyan", "count 20"), kept)
    np.testing.assert_allclose(reduced.frequency_hz, full.frequency_hz, rtol=1e-8)


def test_residual_vectors_complete_a_basis(
    structure: Structure, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    few = elastic_basis(structure, airframe("full-modes", "count 10"), [])
    added = residual_basis(structure, few, GEARS, cache=Cache(tmp_path))
    assert 0 < added.shape.shape[1] <= 18
    both = with_residual_vectors(structure, few, GEARS)
    np.testing.assert_array_equal(both.shape[:, :10], few.shape)
    np.testing.assert_allclose(both.frequency_hz[10:], added.frequency_hz)
    gram = both.shape.T @ (structure.mass @ both.shape)
    np.testing.assert_allclose(gram, np.eye(len(gram)), atol=1e-9)

    def never(*_args: object) -> None:
        raise AssertionError("was to come from the cache")

    monkeypatch.setattr(room, "residual_vectors", never)
    again = residual_basis(structure, few, GEARS, cache=Cache(tmp_path))
    np.testing.assert_array_equal(again.shape, added.shape)


def test_models_join(structure: Structure) -> None:
    from drake_landing.case.reading import parse_case
    from drake_landing.process.aircraft import prepare_aircraft

    text = DECK.with_name("tiny_case.yaml").read_text()
    aircraft = prepare_aircraft(parse_case(text, folder=DECK.parent), Path("unused"))
    few = elastic_basis(structure, airframe("full-modes", "count 10"), [])
    added = residual_basis(structure, few, list(aircraft.attachment_nodes))
    one, two = (modal_model(structure, b, aircraft) for b in (few, added))
    both = one.with_more(two)
    whole = with_residual_vectors(structure, few, list(aircraft.attachment_nodes))
    direct = modal_model(structure, whole, aircraft)
    np.testing.assert_allclose(both.frequency_hz, direct.frequency_hz)
    np.testing.assert_allclose(both.monitor, direct.monitor, atol=1e-12)
    np.testing.assert_allclose(both.damping, direct.damping, rtol=1e-9)
