"""A deck in mm, t, N is the aircraft that it is in SI; wrong units are noticed."""

from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.body import AirframeModel, load_airframe
from drake_landing.airframe.deck_units import check_units
from drake_landing.case.reading import parse_case
from drake_landing.case.schema import Case
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.landing_deck import write_landing_deck
from drake_landing.reduced.command import reduce_deck
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.structure import Structure
from fem.solution import run_deck

HERE = Path(__file__).parents[1]
TEXT = HERE.joinpath("tiny_case.yaml").read_text()
MM = ("deck: tiny_aircraft.bdf", "deck: tiny_aircraft_mm.bdf\n  units: mm-t-N")


def case_of(*change: str) -> Case:
    text = TEXT.replace(*change) if change else TEXT
    return parse_case(text, file="case.yaml", folder=HERE)


def loaded(case: Case, out: Path) -> tuple[Aircraft, AirframeModel]:
    aircraft = prepare_aircraft(case, out)
    return aircraft, load_airframe(case.airframe, aircraft)


@pytest.fixture(scope="module")
def models(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple]:
    out = tmp_path_factory.mktemp("units")
    return {"SI": loaded(case_of(), out), "mm": loaded(case_of(*MM), out)}


def test_the_modal_body_does_not_depend_on_the_units_of_the_deck(models: dict) -> None:
    si, mm = (models[name][1].body for name in ("SI", "mm"))
    assert mm.mass == pytest.approx(si.mass, rel=1e-9)
    assert mm.frequency == pytest.approx(si.frequency, rel=1e-6)
    assert mm.inertia_G == pytest.approx(si.inertia_G, rel=1e-6, abs=1e-3)
    assert mm.p_BN == pytest.approx(si.p_BN, abs=1e-9)
    for name in ("translation", "rotation"):
        a, b = np.abs(getattr(si, name)), np.abs(getattr(mm, name))
        assert b == pytest.approx(a, rel=1e-4, abs=1e-5 * a.max())


def test_the_deck_of_the_landing_is_in_the_units_of_the_user(
    models: dict, tmp_path: Path
) -> None:
    """Its own solution gives the same motion, in mm."""
    time = np.linspace(0.0, 0.1, 201)
    load = np.zeros((len(time), 2, 6))
    load[:, 0, 2] = 1e4 * np.sin(np.pi * time / 0.1)
    load[:, 1, 4] = 2e3 * np.sin(2 * np.pi * time / 0.1)
    loads = AttachmentLoads(time=time, node_id=np.array([52, 51]), load=load)
    tip = {}
    for name, case in (("SI", case_of()), ("mm", case_of(*MM))):
        deck = tmp_path / f"{name}.bdf"
        write_landing_deck(deck, case, *models[name], loads)
        results = run_deck(read_deck(deck), tmp_path / f"{name}.h5")
        with h5py.File(results) as file:
            tip[name] = file["transient/1/acceleration"][:, -1, :3]
    assert np.abs(tip["SI"]).max() > 1.0
    error = np.abs(tip["mm"] / 1e3 - tip["SI"]).max()
    assert error < 1e-5 * np.abs(tip["SI"]).max()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ((MM[0], "deck: tiny_aircraft_mm.bdf"), ["found SI", "expected mm-t-N"]),
        ((MM[0], MM[0] + "\n  units: mm-t-N"), ["found mm-t-N", "expected SI"]),
    ],
    ids=["mm as SI", "SI as mm"],
)
def test_wrong_units_are_noticed(
    change: tuple[str, str], words: list[str], tmp_path: Path
) -> None:
    case = case_of(*change)
    aircraft = prepare_aircraft(case, tmp_path)
    with pytest.raises(InputError) as caught, case.places.located():
        check_units(aircraft.structure(), aircraft)
    message = str(caught.value)
    assert message.startswith("case.yaml:")
    assert "airframe.units: " in message
    assert all(word in message for word in words), message


def test_gears_written_for_wrong_units_are_not_believed(tmp_path: Path) -> None:
    """The deck's size and materials decide, not the gears that came from elsewhere."""
    case = case_of(*MM)
    aircraft = prepare_aircraft(case, tmp_path)
    structure = aircraft.structure()
    far = [
        gear.model_copy(update={"axle": tuple(1e3 * np.array(gear.axles[0]))})
        for gear in aircraft.gears
    ]
    with pytest.raises(InputError) as caught:
        check_units(structure, replace(aircraft, gears=tuple(far)))
    assert "gears: gears lie up to" in str(caught.value)
    assert "They fit a deck in SI" in str(caught.value)
    assert "new --units mm-t-N" in str(caught.value)


def test_materials_of_other_units_are_a_remark(tmp_path: Path) -> None:
    """Of the size of an aircraft in both, as decks in inches are in mm."""
    case = case_of(*MM)
    aircraft = prepare_aircraft(case, tmp_path)
    structure = aircraft.structure()
    assert check_units(structure, aircraft) == ()
    deck = structure.deck
    soft = deck.cards["MAT1"].assign(e=1e7 * 1e6)  # psi, taken for MPa
    psi = Structure.from_deck(replace(deck, cards={**deck.cards, "MAT1": soft}))
    (remark,) = check_units(psi, aircraft)
    assert "they look like in-lbf" in remark


def test_matrices_may_have_units_too(tmp_path: Path) -> None:
    """Reduced in mm, they are the aircraft that SI reduces to."""
    bodies = {}
    for name, units in (("tiny_aircraft", "SI"), ("tiny_aircraft_mm", "mm-t-N")):
        folder = tmp_path / name
        options = {"highest_hz": 150.0, "count": 0, "compare_hz": 20.0}
        grids = "1, 5, 9, 24, 34, 51, 52, 53"
        reduce_deck(
            HERE / f"{name}.bdf",
            folder,
            basis="craig-bampton",
            interface=grids,
            **options,
        )
        files = f"files: [{folder / 'reduced.h5'}], grids: {folder / 'grids.csv'}"
        source = f"matrices: {{{files}}}\n  units: {units}"
        bodies[units] = loaded(case_of(MM[0], source), tmp_path)[1].body
    si, mm = bodies["SI"], bodies["mm-t-N"]
    assert mm.mass == pytest.approx(si.mass, rel=1e-9)
    assert mm.frequency == pytest.approx(si.frequency, rel=1e-6)
    a = np.abs(si.rotation)
    assert np.abs(mm.rotation) == pytest.approx(a, rel=1e-4, abs=1e-5 * a.max())


def test_units_are_for_decks(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"units: found mm-t-N, expected SI"):
        parse_case(
            "name: a\nairframe: {model: con, units: mm-t-N}\nscenario: {sink_rate: 1}"
        )
