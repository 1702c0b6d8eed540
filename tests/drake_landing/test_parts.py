"""Section loads are equilibrium, and equal to what the elements carry."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.cases_io import parse_case
from drake_landing.handover import AttachmentLoads
from drake_landing.inputs import Aircraft, prepare_aircraft
from drake_landing.parts import Section, section_load, section_operator
from drake_landing.practices import compare_practices
from drake_landing.response import transient_response
from fem.deck.reader import read_deck
from fem.observation import Observation
from fem.recovery import element_tables
from fem.structure import Structure

HERE = Path(__file__).parent
ANY = (-1e9, 1e9)
WING = Section(
    name="wing", boxes=(((0.0, 12.0), (0.5, 1e9), ANY),), point=(8.0, 0.0, 0.0)
)
ALL = Section(name="all", boxes=((ANY, ANY, ANY),), point=(3.0, 1.0, -2.0))


@pytest.fixture(scope="module")
def structure() -> Structure:
    return Structure.from_deck(read_deck(HERE / "tiny_aircraft.bdf"))


@pytest.fixture(scope="module")
def aircraft() -> Aircraft:
    text = HERE.joinpath("tiny_case.yaml").read_text()
    return prepare_aircraft(parse_case(text, folder=HERE), Path("unused"))


@pytest.fixture(scope="module")
def loads() -> AttachmentLoads:
    """Smooth pulses on the main gears, with drag and its moment."""
    time = 5e-4 * np.arange(301)
    load = np.zeros((301, 3, 6))
    pulse = np.sin(np.pi * time / 0.1) ** 2 * (time < 0.1)
    load[:, 1:, 2] = 2e4 * pulse[:, None]
    load[:, 1:, 0] = 5e3 * pulse[:, None]
    load[:, 1, 4] = -4e3 * pulse
    return AttachmentLoads(time=time, node_id=np.array([51, 52, 53]), load=load)


@pytest.fixture(scope="module")
def motion(structure: Structure, aircraft: Aircraft, loads: AttachmentLoads):
    """Accelerations, displacements and velocities of all freedoms."""
    watched = [Observation(q) for q in ("acceleration", "displacement", "velocity")]
    transient_response(structure, loads, aircraft.monitoring, observers=watched)
    return [w.history for w in watched]


def through(section: Section, structure: Structure, loads: AttachmentLoads, motion):
    points = structure.points
    places = {int(n): points.xyz[points.rows(int(n))] for n in loads.node_id}
    operator = section_operator(structure, section, places)
    inertia = (operator.of_acceleration @ motion[0].T).T
    return section_load(operator, inertia, loads.node_id, loads.load)


def test_the_whole_aircraft_is_in_equilibrium(
    structure: Structure, loads: AttachmentLoads, motion
) -> None:
    # The scheme balances averages over three steps; loads that vary smoothly differ
    # from these by their second difference.
    rest = through(ALL, structure, loads, motion)[2:-2]
    applied = np.abs(loads.load[:, :, 2].sum(axis=1)).max()
    assert np.abs(rest[:, :3]).max() < 1e-3 * applied
    assert np.abs(rest[:, 3:]).max() < 1e-3 * applied * 8.0


def test_a_section_carries_what_its_bar_carries(
    structure: Structure, loads: AttachmentLoads, motion
) -> None:
    passed = through(WING, structure, loads, motion)
    table = next(
        t
        for t in element_tables(structure.points, structure.blocks, "force")
        if t.table == "CBAR"
    )
    strained = motion[1] + structure.damping.stiffness_factor * motion[2]
    forces = table.of(structure.elimination.T @ strained.T)
    bar = forces[:, list(table.id).index(109)]
    columns = [c.lower().replace(" ", "_") for c in table.columns]
    shear = bar[:, next(i for i, c in enumerate(columns) if "shear" in c)]
    moment = bar[:, 0]
    for ours, theirs in ((passed[:, 2], shear), (passed[:, 3], moment)):
        size = np.abs(ours).max()
        sign = np.sign(ours @ theirs)
        assert np.abs(ours - sign * theirs)[2:-2].max() < 5e-3 * size


def test_practices(
    structure: Structure, aircraft: Aircraft, loads: AttachmentLoads
) -> None:
    table = compare_practices(structure, aircraft, loads, loads, [WING])
    hybrid = table[table["practice"] == "hybrid"].set_index("quantity")
    rigid = table[table["practice"] == "rigid loads"].set_index("quantity")
    # With the same loads the first and the last practice are one.
    np.testing.assert_allclose(rigid["peak"], hybrid["peak"])
    assert (hybrid["error"] == 0).all()
    slices = table[table["practice"] == "static slices"].set_index("quantity")
    # Rigid: acceleration of the centre from the total load, both mains at their peak.
    mass = structure.weight.total
    centre = 4e4 / mass
    assert slices["peak"]["centre z"] == pytest.approx(centre, rel=0.1)
    assert abs(slices["peak"]["right_tip z"]) < abs(hybrid["peak"]["right_tip z"])


def test_an_empty_section_is_refused(structure: Structure) -> None:
    nowhere = Section(
        name="nowhere", boxes=((ANY, (99.0, 100.0), ANY),), point=(0.0, 0.0, 0.0)
    )
    with pytest.raises(ValueError, match="nowhere"):
        section_operator(structure, nowhere, {})
