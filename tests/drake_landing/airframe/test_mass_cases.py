"""Mass cases and steady flight of a deck of one's own."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.airframe.mass_cases import loaded
from drake_landing.case.reading import parse_case
from drake_landing.parts.slices import balanced
from drake_landing.process.aircraft import prepare_aircraft
from fem.errors import InputError

HERE = Path(__file__).resolve().parents[1]
TINY = (HERE / "tiny_case.yaml").read_text()


def case_with(airframe: str, folder: Path):
    """The beam aircraft with more in its section `airframe`."""
    text = TINY.replace("  select: count 6\n", f"  select: count 6\n{airframe}")
    deck = HERE / "tiny_aircraft.bdf"
    return parse_case(text.replace("tiny_aircraft.bdf", str(deck)), folder=folder)


def masses() -> dict[int, float]:
    """CONM2 of the deck."""
    aircraft = prepare_aircraft(case_with("", HERE), HERE)
    rows = aircraft.read(aircraft.deck).cards["CONM2"]
    return dict(zip(rows.eid.tolist(), rows["m"].tolist()))


def test_three_mass_cases_weigh_what_they_add_scale_and_leave_out(tmp_path):
    (tmp_path / "fuel.bdf").write_text("CONM2,9001,24,,30.\nCONM2,9002,34,,30.\n")
    own = masses()
    one, two = sorted(own)[:2]
    cases = f"""  mass_cases:
    full: {{add: fuel.bdf}}
    less: {{scale: [{{elements: [{one}], factor: 0.5}}]}}
    none: {{remove: [{two}]}}
  mass_case: """
    found = {}
    for name in ("full", "less", "none"):
        aircraft = prepare_aircraft(case_with(cases + name + "\n", tmp_path), tmp_path)
        found[name] = aircraft.structure().rigid_mass.total
    plain = prepare_aircraft(case_with("", tmp_path), tmp_path).structure()
    total = plain.rigid_mass.total
    assert found["full"] == pytest.approx(total + 60.0)
    assert found["less"] == pytest.approx(total - 0.5 * own[one])
    assert found["none"] == pytest.approx(total - own[two])


def test_elements_keep_the_names_of_their_files(tmp_path):
    """Components go by them; a file that is interrupted by another one, too."""
    text = (HERE / "tiny_aircraft.bdf").read_text()
    control, bulk = text.split("BEGIN BULK\n")
    lines = bulk.splitlines(keepends=True)
    bars = [line for line in lines if line.startswith("CBAR")]
    inner = "wing's <i>.inc"
    outer = "".join(bars[:2]) + f'INCLUDE "{inner}"\n' + "".join(bars[4:])
    (tmp_path / "outer.inc").write_text(outer)
    (tmp_path / inner).write_text("".join(bars[2:4]))
    rest = "".join(line for line in lines if line not in bars)
    deck = tmp_path / "main.bdf"
    deck.write_text(f"{control}BEGIN BULK\nINCLUDE 'outer.inc'\n{rest}")
    (tmp_path / "fuel.bdf").write_text("CONM2,9001,24,,30.\n")
    given = f"  deck: {deck}\n  mass_cases: {{full: {{add: fuel.bdf}}}}\n"
    text = TINY.replace("  deck: tiny_aircraft.bdf\n", given + "  mass_case: full\n")
    aircraft = prepare_aircraft(parse_case(text, folder=tmp_path), tmp_path / "out")
    cards = aircraft.read(aircraft.deck).cards
    files = [Path(file).name for file in cards["CBAR"].file]
    plain = aircraft.read(deck).cards["CBAR"]
    assert files == [Path(file).name for file in plain.file]
    assert files.count(inner) == 2


def test_stiffness_is_that_of_the_deck(tmp_path):
    (tmp_path / "fuel.bdf").write_text("CONM2,9001,24,,30.\n")
    given = "  mass_cases: {full: {add: fuel.bdf}}\n  mass_case: full\n"
    other = prepare_aircraft(case_with(given, tmp_path), tmp_path).structure()
    plain = prepare_aircraft(case_with("", tmp_path), tmp_path).structure()
    assert abs(other.stiffness - plain.stiffness).max() == 0.0


def test_a_target_missed_by_more_than_a_percent_is_refused(tmp_path):
    given = "  mass_cases: {a: {mass: %g, cg: [%g, 0, 0.0]}}\n  mass_case: a\n"
    plain = prepare_aircraft(case_with("", tmp_path), tmp_path)
    whole = loaded(plain.structure(), plain.gears)
    near = given % (1.009 * whole.mass, whole.center[0])
    prepare_aircraft(case_with(near, tmp_path), tmp_path).structure()
    far = given % (1.011 * whole.mass, whole.center[0] + 0.3)
    aircraft = prepare_aircraft(case_with(far, tmp_path), tmp_path)
    with pytest.raises(InputError) as error:
        aircraft.structure()
    assert [p.split(":")[0] for p in error.value.problems] == [
        "airframe.mass_cases.a.mass",
        "airframe.mass_cases.a.cg",
    ]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("remove: [77777]", "no CONM2 has such an id"),
        ("scale: [{elements: [[8000, 8999]], factor: 2}]", "no CONM2"),
        ("add: beams.bdf", "found CBAR in beams.bdf, expected CONM2 alone"),
    ],
)
def test_what_does_not_fit_the_deck_is_named(tmp_path, given, message):
    (tmp_path / "beams.bdf").write_text("CBAR,9001,1,1,2,0.,0.,1.\n")
    text = f"  mass_cases: {{a: {{{given}}}}}\n  mass_case: a\n"
    with pytest.raises(InputError, match=message):
        prepare_aircraft(case_with(text, tmp_path), tmp_path)


def test_an_unknown_mass_case_names_the_nearest(tmp_path):
    text = "  mass_cases: {full: {}}\n  mass_case: ful\n"
    with pytest.raises(InputError, match="did you mean 'full'"):
        case_with(text, tmp_path)


def test_steady_flight_over_nodes_is_1_g_without_rotation(tmp_path):
    text = "  steady: {nodes: [24, 34, 1, 9]}\n"
    aircraft = prepare_aircraft(case_with(text, tmp_path), tmp_path)
    structure = aircraft.structure()
    load = aircraft.steady_load(structure)
    motion = balanced(structure, load).motion[:, 0]
    rigid = np.linalg.lstsq(structure.rigid_body, motion, rcond=None)[0]
    assert rigid == pytest.approx([0, 0, 9.80665, 0, 0, 0], abs=1e-6)


def test_a_load_set_must_carry_the_weight(tmp_path):
    lines = (
        (HERE / "tiny_aircraft.bdf")
        .read_text()
        .replace("ENDDATA", "FORCE,100,5,,1000.,0.,0.,1.\nENDDATA")
    )
    (tmp_path / "own.bdf").write_text(lines)
    text = TINY.replace("tiny_aircraft.bdf", "own.bdf").replace(
        "  select: count 6\n", "  select: count 6\n  steady: {load: 100}\n"
    )
    aircraft = prepare_aircraft(parse_case(text, folder=tmp_path), tmp_path)
    structure = aircraft.structure()
    with pytest.raises(InputError, match="carries 1 kN, expected the weight"):
        aircraft.steady_load(structure)


@pytest.mark.parametrize("name", ["take_off", "landing", "light"])
def test_mass_cases_of_the_reference_aircraft_fly_at_1_g(tmp_path, name):
    path = HERE.parents[1] / "cases" / "d150_masses.yaml"
    text = path.read_text().replace("mass_case: landing", f"mass_case: {name}")
    aircraft = prepare_aircraft(parse_case(text), tmp_path)
    structure = aircraft.structure()  # within 1 % of its target
    load = aircraft.steady_load(structure)
    rigid = structure.rigid_body
    force = rigid.T @ load[:, 0]
    inertia = rigid.T @ (structure.mass @ rigid)
    motion = np.linalg.solve(inertia, force)
    assert motion == pytest.approx([0, 0, 9.80665, 0, 0, 0], abs=1e-5)
    case = parse_case(text)
    assert case.scenario.sink_rate == (1.8288 if name == "take_off" else 3.048)
    if name == "take_off":  # the mass case of its source: 25.0 % of the chord
        assert case.airframe.mac is not None
        center = loaded(structure, aircraft.gears).center
        share = case.airframe.mac.percent(center, np.eye(3))
        assert share == pytest.approx(25.0, abs=0.1)


def massset_deck(folder: Path) -> None:
    """The beam aircraft with two fillings of its tanks."""
    text = (HERE / "tiny_aircraft.bdf").read_text()
    sets = "MASSSET,901,1.,1.,0,1.,1\nMASSSET,902,1.,1.,0,1.,1\n,0.5,2\n"
    more = (
        "BEGIN MASSID=1 LABEL='inner tanks'\nCONM2,9001,24,,30.\n"
        "BEGIN MASSID=2 LABEL='outer tanks'\nCONM2,9002,34,,20.\n"
    )
    assert "ENDDATA" in text
    (folder / "own.bdf").write_text(text.replace("ENDDATA", f"{sets}{more}ENDDATA"))


def massset_case(airframe: str, folder: Path):
    text = TINY.replace("tiny_aircraft.bdf", "own.bdf")
    text = text.replace("  select: count 6\n", f"  select: count 6\n{airframe}")
    return parse_case(text, folder=folder)


@pytest.mark.parametrize(
    ("given", "added"),
    [
        ("  mass_case: inner tanks\n", 30.0),
        ("  mass_case: inner tanks + outer tanks\n", 40.0),
        ("  mass_case: MASSSET 902\n", 40.0),
        ("  mass_cases: {full: {massset: 902, remove: []}}\n  mass_case: full\n", 40.0),
    ],
)
def test_masssets_of_a_deck_are_mass_cases_by_their_labels(tmp_path, given, added):
    massset_deck(tmp_path)
    plain = prepare_aircraft(massset_case("", tmp_path), tmp_path).structure()
    aircraft = prepare_aircraft(massset_case(given, tmp_path), tmp_path)
    total = aircraft.structure().rigid_mass.total
    assert total == pytest.approx(plain.rigid_mass.total + added, rel=1e-12)


def test_an_unknown_massset_lists_those_of_the_deck(tmp_path):
    massset_deck(tmp_path)
    with pytest.raises(InputError, match="MASSSET 901, MASSSET 902, inner tanks"):
        massset_case("  mass_case: inner\n", tmp_path)
    given = "  mass_cases: {a: {massset: 7}}\n  mass_case: a\n"
    with pytest.raises(InputError, match="massset: found 7, expected a MASSSET"):
        prepare_aircraft(massset_case(given, tmp_path), tmp_path)


@pytest.mark.parametrize("units", ["SI", "mm-t-N"])
def test_steady_flight_from_a_file_or_a_set_in_the_units_of_the_deck(tmp_path, units):
    """The lift of the nodes, written as forces with a moment, loads it alike."""
    name = "tiny_aircraft.bdf" if units == "SI" else "tiny_aircraft_mm.bdf"
    text = (HERE / name).read_text()
    base = TINY.replace("tiny_aircraft.bdf", "own.bdf").replace(
        "  select: count 6\n",
        f"  select: count 6\n  units: {units}\n  steady: STEADY\n",
    )
    (tmp_path / "own.bdf").write_text(text)

    def load(steady: str) -> np.ndarray:
        case = parse_case(base.replace("STEADY", steady), folder=tmp_path)
        aircraft = prepare_aircraft(case, tmp_path)
        return aircraft.steady_load(aircraft.structure())

    expected = load("{nodes: [24, 34, 1, 9]}")
    case = parse_case(base.replace("STEADY", "{nodes: [5]}"), folder=tmp_path)
    aircraft = prepare_aircraft(case, tmp_path)
    structure = aircraft.structure()
    whole = loaded(structure, aircraft.gears)
    weight = 9.80665 * whole.mass
    arm = 1e3 if units == "mm-t-N" else 1.0
    moment = -weight * (whole.center[0] - 8.0) * arm  # grid 5 lies at x = 8 m
    cards = f"FORCE,7,5,,{weight:.8g},0.,0.,1.\nMOMENT,7,5,,{moment:.8g},0.,1.,0.\n"
    (tmp_path / "lift.bdf").write_text(cards)
    rigid = structure.rigid_body
    for steady in ("{file: lift.bdf}", "{file: lift.bdf, load: 7}"):
        found = load(steady)
        error = rigid.T @ (found - expected)
        assert np.abs(error).max() < 1e-6 * weight
    (tmp_path / "own.bdf").write_text(text.replace("ENDDATA", f"{cards}ENDDATA"))
    error = rigid.T @ (load("{load: 7}") - expected)
    assert np.abs(error).max() < 1e-6 * weight


def test_a_file_of_loads_names_what_is_wrong(tmp_path):
    (tmp_path / "lift.bdf").write_text(
        "FORCE,7,777,,1.,0.,0.,1.\nGRAV,8,,1.,0.,0.,1.\n"
    )
    text = "  steady: {file: lift.bdf}\n"
    aircraft = prepare_aircraft(case_with(text, tmp_path), tmp_path)
    with pytest.raises(InputError) as error:
        aircraft.steady_load(aircraft.structure())
    assert "found GRAV, expected FORCE and MOMENT alone" in str(error.value)


def test_center_of_gravity_over_the_mean_chord():
    """Leading edge at 7 m, chord 2 m: 8.5 m is 75 %, whichever way the deck flies."""
    from drake_landing.case.chord import Chord

    aft = Chord(leading_edge=7.0, chord=2.0)
    assert aft.percent(np.array([8.5, 0.0, 0.0]), np.eye(3)) == pytest.approx(75.0)
    forward = np.diag([-1.0, -1.0, 1.0])  # the deck's x points forward
    turned = Chord(leading_edge=-7.0, chord=2.0)
    assert turned.percent(np.array([-8.5, 0.0, 0.0]), forward) == pytest.approx(75.0)


def test_design_weights_pair_with_sink_rates_and_speeds(tmp_path):
    """25.473(a): 10 ft/s at the landing, 6 ft/s at the take-off weight."""
    cases = "  mass_cases: {heavy: {design: take_off}, light: {design: landing}}\n"

    def of(name: str, scenario: str = "{preset: tail_down}"):
        text = TINY.replace("{sink_rate: 1.2, forward_speed: 40}", scenario)
        text = text.replace(
            "  select: count 6\n", f"  select: count 6\n{cases}  mass_case: {name}\n"
        ).replace("tiny_aircraft.bdf", str(HERE / "tiny_aircraft.bdf"))
        speeds = "conditions: {stall_speed: 50, altitude: 2000}\n"
        return parse_case(text + speeds, folder=tmp_path)

    heavy, light = of("heavy"), of("light")
    assert heavy.scenario.sink_rate == 1.8288
    assert light.scenario.sink_rate == 3.048
    assert heavy.conditions.weight == "take_off"
    assert light.conditions.weight == "landing"
    # ISA at 2000 m: 0.8217 of the density; 22.8 K hotter than 275.15 K.
    ratio = 0.8217 * 275.15 / (275.15 + 22.8)
    assert heavy.scenario.forward_speed == pytest.approx(50.0 / ratio**0.5, rel=1e-3)
    level = of("heavy", "{preset: two_point}").scenario.forward_speed
    assert level == pytest.approx(1.25 * heavy.scenario.forward_speed)
    given = of("heavy", "{preset: tail_down, sink_rate: 2.5, forward_speed: 44}")
    assert (given.scenario.sink_rate, given.scenario.forward_speed) == (2.5, 44.0)
