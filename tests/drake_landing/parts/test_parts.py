"""Section loads are equilibrium, and equal to what the elements carry."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.case.reading import parse_case
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.parts.cuts import Cutter, mean_of_three
from drake_landing.parts.field_pictures import emptiest_corner
from drake_landing.parts.inventory import inventory
from drake_landing.parts.observers import PartsFound, PartsWatch
from drake_landing.parts.slices import (
    Slices,
    balanced,
    extreme_instants,
    slice_loads,
    static_slices,
)
from drake_landing.parts.stress import stress_point_notices, stresses
from drake_landing.parts.tables import (
    axial_elements,
    component_table,
    worst_elements,
)
from drake_landing.places import ANY, Beam, Places
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.transient.practices import HYBRID, RIGID, STATIC, compare_practices
from drake_landing.transient.response import transient_response
from fem.algebra.statics import inertia_relief
from fem.deck.reader import read_deck
from fem.model.structure import Structure
from fem.recovery.elements import element_tables
from fem.response.observation import Observation

HERE = Path(__file__).parents[1]
WING = Beam(
    name="wing",
    outward="starboard",
    stations=np.array([0.5, 2.5]),
    boxes=(((0.0, 12.0), ANY, ANY),),
    line=np.array([[8.0, 0.0, 0.0], [8.0, 10.0, 0.0]]),
)
AFT = Beam(name="all behind the cut", outward="aft", stations=np.array([4.0, 6.5, 9.0]))
GEARS = {"nose": [51], "left": [52], "right": [53]}


@pytest.fixture(scope="module")
def structure() -> Structure:
    return Structure.from_deck(read_deck(HERE / "tiny_aircraft.bdf"))


@pytest.fixture(scope="module")
def aircraft() -> Aircraft:
    text = HERE.joinpath("tiny_case.yaml").read_text()
    return prepare_aircraft(parse_case(text, folder=HERE), Path("unused"))


@pytest.fixture(scope="module")
def loads() -> AttachmentLoads:
    """Pulses on the main gears, with drag and its moment, rough enough to matter."""
    time = 5e-4 * np.arange(301)
    load = np.zeros((301, 3, 6))
    pulse = np.sin(np.pi * time / 0.1) * (time < 0.1)
    load[:, 1:, 2] = 2e4 * pulse[:, None]
    load[:, 1:, 0] = 5e3 * pulse[:, None]
    load[:, 1, 4] = -4e3 * pulse
    return AttachmentLoads(time=time, node_id=np.array([51, 52, 53]), load=load)


@pytest.fixture(scope="module")
def strained() -> list[Observation]:
    return [Observation("displacement"), Observation("velocity")]


@pytest.fixture(scope="module")
def watch(structure: Structure, aircraft: Aircraft, loads, strained) -> PartsWatch:
    """Ran with two load cases, the second half of the first."""
    places = Places(beams=(WING, AFT), equipment={})
    seen = PartsWatch(
        Cutter(structure),
        places,
        inventory(structure, {1: 1e8}),
        list(aircraft.monitoring.values()),
        loads.node_id,
    )
    transient_response(
        structure,
        loads,
        aircraft.monitoring,
        observers=[*seen.observers, *strained],
        further=[half(loads)],
    )
    return seen


@pytest.fixture(scope="module")
def found(watch: PartsWatch, loads: AttachmentLoads) -> PartsFound:
    return watch.collect([loads, half(loads)])


def half(loads: AttachmentLoads) -> AttachmentLoads:
    return AttachmentLoads(
        time=loads.time, node_id=loads.node_id, load=0.5 * loads.load
    )


def sliced(
    structure: Structure,
    loads: AttachmentLoads,
    instants: dict[int, str],
    watch: PartsWatch,
) -> Slices:
    still = balanced(structure, slice_loads(structure, loads, instants))
    return static_slices(
        structure, loads, instants, still, watch.stresses, watch.cuts, watch.grids
    )


def test_stresses_upon_steady_flight_add_up(
    structure: Structure,
    aircraft: Aircraft,
    loads: AttachmentLoads,
    found: PartsFound,
    strained: list[Observation],
) -> None:
    still = balanced(structure, slice_loads(structure, loads, {100: "peak"}))
    steady = still.displacement[:, 0]
    seen = PartsWatch(
        Cutter(structure),
        Places(equipment={}),
        inventory(structure, {}),
        [1],
        loads.node_id,
        steady=steady,
    )
    transient_response(structure, loads, aircraft.monitoring, observers=seen.observers)
    upon = seen.collect([loads])
    assert upon.total is not None
    u = strained[0].values[:, 0] + steady
    highest = seen.stresses.of(u.T)[..., 0].max(axis=0)
    np.testing.assert_allclose(upon.total.equivalent, highest, rtol=1e-9, atol=1e-3)
    assert upon.judged is upon.total
    alone = seen.stresses.of(strained[0].values[:, 0].T)[..., 0].max(axis=0)
    np.testing.assert_allclose(upon.landing.stress.equivalent, alone, atol=1e-3)
    np.testing.assert_allclose(found.judged.equivalent, alone, rtol=1e-6, atol=1e-3)


def test_the_whole_aircraft_is_in_equilibrium(found: PartsFound) -> None:
    # To the rounding of accelerations from differences of displacements.
    assert max(found.imbalance) < 1e-7


def test_a_section_carries_what_its_bar_carries(
    structure: Structure, found: PartsFound, strained
) -> None:
    cuts = found.cuts["wing"]
    passed = cuts.named(found.landing.sections["wing"])[:, 0]
    table = next(
        t
        for t in element_tables(structure.points, structure.blocks, "force")
        if t.table == "CBAR"
    )
    u, v = (o.values[:, 0] for o in strained)
    # The scheme's forces are means of three steps, like its loads.
    u = mean_of_three(u) + structure.damping.stiffness_factor * v
    forces = table.of(structure.elimination.T @ u.T)
    bar = forces[:, list(table.id).index(109)]
    columns = list(table.columns)
    shear = bar[:, columns.index("shear1")]
    ends = [bar[:, columns.index(f"bending_moment_{end}1")] for end in "ab"]
    moment = 0.75 * ends[0] + 0.25 * ends[1]  # the cut is a quarter along the bar
    for ours, theirs in ((passed[:, 0], shear), (passed[:, 1], moment)):
        size, sign = np.abs(ours).max(), np.sign(ours @ theirs)
        assert np.abs(ours - sign * theirs)[2:-2].max() < 1e-6 * size


def test_running_sums_equal_the_sum_of_what_lies_beyond(
    structure: Structure, found: PartsFound
) -> None:
    whole = found.landing.sections["wing"]
    outer = Beam(
        name="outer",
        outward="starboard",
        stations=WING.stations[1:],
        boxes=WING.boxes,
        line=WING.line,
    )
    alone = Cutter(structure).cuts(outer, [])
    both = found.cuts["wing"]
    # Inertia of the outer strip, whose moment refers to the same point.
    inertia = both.of_acceleration[6:]
    assert np.abs(inertia - alone.of_acceleration).max() < 1e-9
    np.testing.assert_allclose(both.point[1], alone.point[0])
    assert whole.shape == (301, 2, 6)


def test_both_sides_of_a_cut_feel_opposite_loads(
    structure: Structure, loads: AttachmentLoads, watch: PartsWatch, found: PartsFound
) -> None:
    aft = found.cuts["all behind the cut"]
    station = aft.beam.stations[1]
    fore = Beam(
        name="fore", outward="fore", stations=np.array([station]), line=aft.point[1:2]
    )
    cuts = Cutter(structure).cuts(fore, [51, 52, 53])
    moved = Observation("acceleration", cuts.of_acceleration)
    transient_response(structure, loads, {"center": 1}, observers=[moved])
    ahead = cuts.loads(moved.history, loads.node_id, mean_of_three(loads.load))[:, 0]
    behind = found.landing.sections["all behind the cut"][:, 1]
    size = np.abs(behind).max(axis=0)
    assert np.abs(ahead + behind).max() < 1e-6 * size.max()


def test_stresses_are_those_of_the_tables(
    structure: Structure, found: PartsFound, strained
) -> None:
    table = next(
        t
        for t in element_tables(structure.points, structure.blocks, "stress")
        if t.table == "CBAR"
    )
    u = strained[0].values[:, 0]
    values = table.of(structure.elimination.T @ u.T)
    ends = [k for k, n in enumerate(table.columns) if n.startswith(("smax", "smin"))]
    largest = np.abs(values[..., ends]).max(axis=(0, 2))
    stress = found.landing.stress.set_index("id").loc[table.id]
    rounding = 1e-9 * largest.max()
    np.testing.assert_allclose(stress.equivalent, largest, rtol=1e-9, atol=rounding)
    when = np.abs(values[..., ends]).max(axis=2).argmax(axis=0)
    bears = largest > rounding
    np.testing.assert_allclose(stress.time[bears], found.time[when][bears])


def test_the_second_load_case_is_half_the_first(found: PartsFound) -> None:
    first, second = (case.stress.equivalent for case in found.cases)
    np.testing.assert_allclose(second, 0.5 * first, rtol=1e-9)


def test_a_snapshot_holds_the_worst_stress(
    watch: PartsWatch, found: PartsFound
) -> None:
    for component, snapshot in found.worst.items():
        table = found.landing.stress
        worst = table[table.component == component].equivalent.max()
        stress = watch.stresses.of(snapshot.displacement[:, None])[0, :, 0]
        at = list(watch.stresses.id).index(snapshot.element)
        assert stress[at] == pytest.approx(worst)


def test_margins_come_from_the_allowable(found: PartsFound) -> None:
    worst = component_table(found.landing.stress, 1.5)
    row = worst.iloc[0]
    assert row.allowed == 1e8
    assert row.margin == pytest.approx(1e8 / (1.5 * row.equivalent) - 1.0)
    assert not found.landing.stress.set_index("id").axial_only[row.id]
    ten = worst_elements(found.landing.stress, 1.5, 3)
    assert (ten.groupby("component").equivalent.diff().dropna() <= 0.0).all()


def test_bars_without_stress_points_are_no_worst_elements(
    structure: Structure, found: PartsFound
) -> None:
    """The wings carry most and give no stress points, the fuselage does."""
    table = found.landing.stress.set_index("id")
    pid = structure.deck.cards["CBAR"].set_index("eid").pid
    assert (table.axial_only == (pid.loc[table.index] != 1)).all()
    worst = worst_elements(found.landing.stress, 1.5, 99)
    assert set(pid.loc[worst.id]) == {1}
    axial = axial_elements(found.landing.stress, 99)
    assert set(pid.loc[axial.id]) <= {2, 3}
    assert axial.margin.isna().all()
    assert len(axial)
    (text,) = stress_point_notices(structure)
    assert text.startswith(f"{int(table.axial_only.sum())} bars without")


def test_practices(
    structure: Structure,
    aircraft: Aircraft,
    loads: AttachmentLoads,
    watch: PartsWatch,
    found: PartsFound,
) -> None:
    instants = extreme_instants(loads, GEARS)
    # One instant: all pulses peak together.
    assert len(instants) == 1
    slices = sliced(structure, loads, instants, watch)
    done = compare_practices(found, slices, half(loads), aircraft.monitoring)
    by = done.table.set_index(["practice", "quantity"])
    assert (by.loc[HYBRID].error == 0).all()
    np.testing.assert_allclose(by.loc[RIGID].error, -0.5, rtol=1e-6)
    # Rigid: acceleration of the center from the total load at its peak.
    center = by.loc[(STATIC, "centre, z"), "value"]
    assert center == pytest.approx(4e4 / structure.weight.total, rel=0.1)
    tip = by.loc[(STATIC, "right tip, z"), "value"]
    assert abs(tip) < abs(by.loc[(HYBRID, "right tip, z"), "value"])


def test_static_sections_are_what_the_bars_carry(
    structure: Structure, loads: AttachmentLoads, watch: PartsWatch
) -> None:
    slices = sliced(structure, loads, {100: "peak"}, watch)
    cuts = watch.cuts["wing"]
    ours = cuts.named(slices.sections["wing"])[0, 0]
    pattern = structure.operator(loads.node_id, frame="basic")
    still = inertia_relief(
        structure.stiffness,
        structure.mass,
        pattern.T @ loads.load[100].reshape(-1, 1),
        rigid_body=structure.rigid_body,
    )
    (table,) = element_tables(structure.points, structure.blocks, "force", {109})
    bar = table.of(structure.elimination.T @ still.displacement)[0, 0]
    of = dict(zip(table.columns, bar))
    moment = 0.75 * of["bending_moment_a1"] + 0.25 * of["bending_moment_b1"]
    assert abs(ours[0]) == pytest.approx(abs(of["shear1"]))
    assert abs(ours[1]) == pytest.approx(abs(moment))


def test_a_beam_without_grids_is_refused(structure: Structure) -> None:
    nowhere = Beam(name="nowhere", outward="port", stations=np.array([-99.0]))
    with pytest.raises(ValueError, match="nowhere"):
        Cutter(structure).cuts(nowhere, [])


PLATE = """SOL 101
CEND
BEGIN BULK
MAT1,1,7.+10,,.3,2700.,,,,+
+,4.+8
MAT2,2,14.+10,2.1+10,,7.6923+10,,2.6923+10,2700.
PSHELL,1,2,.002,1,,1
PSHELL,2,1,.002,1,,1
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,,2.,0.,0.
GRID,6,,2.,1.,0.
CQUAD4,1,1,1,2,3,4
CQUAD4,2,2,2,5,6,3
ENDDATA
"""


def test_a_stiffened_sheet_has_the_stress_of_the_sheet(tmp_path: Path) -> None:
    # Stringers smeared into the membrane: its resultants are not those of the sheet.
    path = tmp_path / "plate.bdf"
    path.write_text(PLATE)
    model = Structure.from_deck(read_deck(path))
    strain = 1e-3
    u = np.zeros(model.points.size)
    u[::6] = strain * model.points.xyz[:, 0]
    free = u[model.elimination.f]
    found = stresses(model).of(free[:, None])[0]
    e, nu = 7e10, 0.3
    xx, yy = e / (1 - nu**2) * strain, nu * e / (1 - nu**2) * strain
    von_mises = np.sqrt(xx**2 - xx * yy + yy**2)
    np.testing.assert_allclose(found[:, 0], von_mises, rtol=1e-9)
    np.testing.assert_allclose(found[:, 1], xx, rtol=1e-9)
    rows = inventory(model, {}).elements
    assert rows.material.tolist() == [1, 1]
    assert rows.allowed.tolist() == [4e8, 4e8]
    assert inventory(model, {1: 3e8}).elements.allowed.tolist() == [3e8, 3e8]


LAMINATE = PLATE.replace(
    "PSHELL,1,2,.002,1,,1", "PCOMP,1,-.011\n,3,.01,0.,YES,1,.002,0.,YES"
)
LAMINATE = LAMINATE.replace("GRID,1,", "MAT8,3,2.+9,1.+6,0.,1.+6,3.+8,,90.\nGRID,1,")


def test_a_laminate_has_the_stress_of_its_isotropic_ply(tmp_path: Path) -> None:
    path = tmp_path / "laminate.bdf"
    path.write_text(LAMINATE)
    model = Structure.from_deck(read_deck(path))
    u = np.zeros(model.points.size)
    u[1::6] = 1e-3 * model.points.xyz[:, 1]
    found = stresses(model).of(u[model.elimination.f][:, None])[0]
    np.testing.assert_allclose(found[:, 0], found[0, 0], rtol=1e-9)
    np.testing.assert_allclose(found[:, 1], 7e10 / 0.91 * 1e-3, rtol=1e-6)
    assert inventory(model, {}).elements.material.tolist() == [1, 1]


def test_axes_of_a_picture_go_where_nothing_is_drawn() -> None:
    corners = np.array([[0.1, 0.1], [0.1, 0.9], [0.9, 0.9], [0.9, 0.1]])
    for i, corner in enumerate(corners):
        box = emptiest_corner(np.delete(corners, i, axis=0))
        assert (corner > box[:2]).all()
        assert (corner < box[2:]).all()
