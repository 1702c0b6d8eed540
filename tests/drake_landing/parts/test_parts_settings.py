"""Places and allowables of a case; what is looked at where a case says nothing."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.case.parts import Parts
from drake_landing.case.reading import parse_case
from drake_landing.parts.case_places import places_of
from drake_landing.parts.cuts import Cutter
from drake_landing.parts.inventory import inventory
from drake_landing.parts.slices import balanced
from drake_landing.reference.d150 import write_model
from drake_landing.reference.named_places import reference_places, steady_load
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.structure import Structure

HERE = Path(__file__).parents[1]
TEXT = HERE.joinpath("tiny_case.yaml").read_text()
PARTS = """
parts:
  ultimate_factor: 1.25
  allowables: {1: 2.0e8}
  beams:
    - {name: left wing, outward: port, first: -1.0, last: -7.0, count: 4}
  panels:
    - {name: middle, grid: 5, beside: [4, 6]}
  equipment: {seat: 3}
"""


@pytest.fixture(scope="module")
def structure() -> Structure:
    return Structure.from_deck(read_deck(HERE / "tiny_aircraft.bdf"))


def found(structure: Structure, parts: Parts):
    return placed(structure, parts, np.eye(3), {"tail": 9}, None)


def placed(structure: Structure, parts: Parts, R_AB, monitoring, known):
    elements = inventory(structure, {})
    return places_of(
        Cutter(structure), parts, R_AB, monitoring, known, elements, [51, 52, 53]
    )


def test_a_case_names_its_places(structure: Structure) -> None:
    case = parse_case(TEXT + PARTS, folder=HERE)
    places = found(structure, case.parts)
    wing, tail = places.beams
    assert [wing.name, tail.name] == [
        *(f"left wing: part to port at x = {x} m" for x in ("8.00", "16.00"))
    ]
    assert wing.stations.tolist() == [-1.0, -3.0, -5.0, -7.0]
    assert tail.stations.tolist() == [-1.0]
    assert wing.across.tolist() == [-1.0, 0.0, 0.0]
    assert places.panels[0].beside == (4, 6)
    assert dict(places.equipment) == {"seat": 3}
    allowed = inventory(structure, case.parts.allowables).elements.allowed
    assert set(allowed) == {2e8}


def test_without_words_every_part_is_cut(structure: Structure) -> None:
    places = found(structure, Parts())
    assert [b.outward for b in places.beams] == [
        *("starboard", "starboard", "port", "port", "fore", "aft", "up")
    ]
    assert dict(places.equipment) == {"tail": 9}
    assert inventory(structure, {}).elements.allowed.isna().all()


def test_cuts_follow_the_axes_of_the_deck(structure: Structure) -> None:
    R_AB = np.array([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]])
    places = placed(structure, Parts(), R_AB, {"tail": 9}, None)
    aft = next(b for b in places.beams if b.outward == "aft")
    assert aft.axis == "x"
    assert aft.direction.tolist() == [-1.0, 0.0, 0.0]
    assert structure.weight.center[0] > aft.stations[0] > aft.stations[-1] > 0.0
    beam = {"name": "w", "outward": "port", "first": -1.0, "last": -7.0}
    with pytest.raises(InputError, match=r"toward y in the deck's axes"):
        placed(structure, Parts(beams=[beam]), R_AB, {"tail": 9}, None)


def test_places_that_are_not_there_are_named(structure: Structure) -> None:
    parts = Parts(equipment={"galley": 777})
    with pytest.raises(InputError, match=r"parts\.equipment\.galley: grid 777"):
        found(structure, parts)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("outward: port", "outward: left", "outward"),
        ("ultimate_factor: 1.25", "ultimate_factor: 0", "ultimate_factor"),
        ("beside: [4, 6]", "beside: []", "beside"),
        ("equipment:", "equipement:", "equipment"),
    ],
)
def test_wrong_places_are_refused(old: str, new: str, said: str) -> None:
    assert old in PARTS
    with pytest.raises(InputError, match=said):
        parse_case(TEXT + PARTS.replace(old, new), folder=HERE)


def test_steady_flight_of_the_reference_aircraft_is_balanced(tmp_path: Path) -> None:
    write_model("con", tmp_path / "con.bdf")
    model = Structure.from_deck(read_deck(tmp_path / "con.bdf"))
    known = reference_places(model, "con")
    places = placed(model, Parts(), np.eye(3), {}, known)
    assert [b.name for b in places.beams] == [
        *("right wing", "left wing", "forward fuselage", "rear fuselage"),
    ]
    still = balanced(model, steady_load(model))
    # 1 g upward: what the lift gives beside the gears' pull, nothing sideways.
    rows = model.operator([19002], (1, 2, 3), frame="basic") @ still.motion
    assert rows[2, 0] == pytest.approx(9.80665, rel=0.01)
    assert abs(rows[1, 0]) < 1e-6


COMPONENTS = """
parts:
  components:
    tail: {elements: [[112, 118], 119], sets: [7]}
    wing: {properties: [2]}
    rest: {materials: [1], files: [tiny_aircraft.bdf]}
"""


def test_a_case_names_components(tmp_path: Path) -> None:
    deck = HERE.joinpath("tiny_aircraft.bdf").read_text()
    path = tmp_path / "tiny_aircraft.bdf"
    path.write_text(deck.replace("ENDDATA", "SET1,7,101,THRU,102\nENDDATA"))
    structure = Structure.from_deck(read_deck(path))
    parts = parse_case(TEXT + COMPONENTS, folder=HERE).parts
    rows = inventory(structure, {}, parts.components).elements.set_index("id")
    assert set(rows.component) == {"tail", "wing", "rest"}
    assert set(rows.component[[101, 102]]) == {"tail"}
    bars = structure.deck.cards["CBAR"].set_index("eid")
    wing = bars.index[(bars.pid == 2)]
    assert set(rows.component[wing]) <= {"wing", "tail"}
    beams = placed(structure, parts, np.eye(3), {}, None).beams
    assert {b.name for b in beams} >= {"part to starboard at x = 8.00 m"}


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("properties: [2]", "properties: [22]", "wing.properties: found 22"),
        ("sets: [7]", "sets: [7]", "found set 7, expected a SET1"),
        ("[[112, 118], 119]", "[[912, 918]]", "tail.elements: found 912 to 918"),
    ],
)
def test_components_that_are_not_there(
    structure: Structure, old: str, new: str, said: str
) -> None:
    text = COMPONENTS if "sets" in old else COMPONENTS.replace(", sets: [7]", "")
    parts = parse_case(TEXT + text.replace(old, new), folder=HERE).parts
    with pytest.raises(InputError, match=said):
        inventory(structure, {}, parts.components)
