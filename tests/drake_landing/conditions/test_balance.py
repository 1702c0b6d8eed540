"""Static cases on the full model: equilibrium, and the written deck in another code."""

from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import pytest

from drake_landing.airframe.body import rigid_airframe
from drake_landing.case.reading import parse_case
from drake_landing.conditions.balance import holds
from drake_landing.conditions.build import on_ground
from drake_landing.conditions.poses import GearStand
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.condition_tables import standing
from drake_landing.process.explain import explain
from drake_landing.process.static_conditions import DECK, solve, write_tables
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.solution.run import run_deck

HERE = Path(__file__).resolve().parents[1]
CONDITIONS = """
conditions:
  steering_torque: 900
  vertical: {nose: 30e3, main_left: 60e3, main_right: 60e3}
"""


def tiny(conditions: str = CONDITIONS):
    """The beam aircraft with brakes."""
    text = (HERE / "tiny_case.yaml").read_text() + conditions
    text = text.replace(
        "    wheel: {mass: 20", "    brake: {torque: 8000}\n    wheel: {mass: 20"
    )
    return parse_case(text, folder=HERE)


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """Folder, structure and result of the tiny aircraft."""
    out = tmp_path_factory.mktemp("conditions")
    case = tiny()
    aircraft = prepare_aircraft(case, out)
    structure = aircraft.structure()
    ground = on_ground(
        rigid_airframe(structure, aircraft.multibody_nodes, np.eye(3)),
        aircraft.gears,
        np.eye(3),
        case.conditions,
    )
    return out, structure, solve(case, aircraft, structure, ground, out)


def test_every_case_is_in_equilibrium(found):
    _, _, result = found
    assert len(result.balances) > 80
    assert result.error < 1e-9


def test_loads_at_rest_carry_the_weight_and_need_no_acceleration_but_1_g(found):
    _, _, result = found
    rest = next(b for b in result.balances if b.case.paragraph == "25.495")
    assert rest.factors == pytest.approx([0.0, 0.5, 1.0], abs=1e-6)
    assert np.abs(rest.acceleration[3:]).max() < 1e-6


def test_only_what_lacks_data_is_left_out(found):
    _, _, result = found
    assert set(result.left_out) == {"25.497"}


def test_the_written_deck_has_the_same_stresses(found, tmp_path):
    out, _, result = found
    path = run_deck(read_deck(out / DECK), tmp_path / "static.h5")
    worst = result.worst
    assert len(worst) == 8
    with h5py.File(path) as file:
        assert len(file["static"]) == len(result.balances)
        for row in worst.itertuples():
            group = file[f"static/{row.case}/element_stress/{row.card}"]
            columns = list(group.attrs["columns"])
            at = int(np.flatnonzero(group["id"][:] == row.id)[0])
            value = dict(zip(columns, group["value"][at]))
            extremes = [c for c in columns if c.startswith(("smax", "smin"))]
            largest = max(abs(value[c]) for c in extremes)
            assert largest == pytest.approx(row.equivalent, rel=1e-6)


def test_one_gear_loads_the_attachment_with_ground_less_its_own_inertia(found):
    _, _, result = found
    number, balance = next(
        (k, b)
        for k, b in enumerate(result.balances, 1)
        if b.case.name == "one gear, main_right"
    )
    table = result.attachment_loads
    own = table[(table.case == number) & (table.node == 52)].iloc[0]
    posed = result.ground.poses["largest"]
    gear = posed.gears["main_right"]
    arm = gear.center - posed.whole.center
    a = balance.acceleration
    ground = posed.R_AG @ balance.case.loads[0].force
    wanted = ground - gear.mass * (a[:3] + np.cross(a[3:], arm))
    assert [own.fx, own.fy, own.fz] == pytest.approx(wanted)


def test_more_holds_than_six_share_the_load_by_the_airframe(found):
    out, structure, _ = found
    case = tiny()
    gears = list(prepare_aircraft(case, out).gears)
    data = gears[1].model_dump()
    data["further_attachments"] = [
        {"name": "stay", "node": 5, "directions": [(1.0, 0.0, 0.0)]}
    ]
    gears[1] = type(gears[1]).model_validate(data)
    held = holds(structure, gears)
    load = {g.name: np.zeros(6) for g in gears}
    load["main_right"] = np.array([1e4, 2e3, 6e4, 1e4, -5e4, 2e3])
    split = held.split(load)
    assert held.resultant @ split == pytest.approx(load["main_right"], rel=1e-9)
    # The gap along the stay closes: a rigid fitting follows its main node.
    seen = held.seen @ split
    own = [k for k, name in enumerate(held.gear) if name == "main_right"]
    at = {n: structure.points.xyz[structure.points.rows([n])[0]] for n in (52, 5)}
    u, turn = seen[own[:3]], seen[own[3:6]]
    assert seen[own[6]] == pytest.approx((u + np.cross(turn, at[5] - at[52]))[0])


def test_monitor_points_of_the_deck_are_in_static_equilibrium(found):
    """Loads and inertia outboard of the bar against what it carries, case by case."""
    table = found[2].monitors.set_index(["name", "quantity"])
    for quantity in ("F1", "F2", "F3", "M1", "M2", "M3"):
        outside, bar = (table.loc[(name, quantity)] for name in ("WING4", "BAR111"))
        size = table.loc["WING4"]["max"].abs().max()
        for end in ("min", "max"):
            assert bar[end] == pytest.approx(outside[end], abs=1e-6 * size)
    assert (table["max"] > 0.0).any()


_WITHOUT_UNIT = {  # counts, ids, shares and flags; `unit` says it where rows differ
    *("case", "case_of_min", "case_of_max", "rank", "id", "material", "node", "margin"),
    *("imbalance", "min", "max", "last_swing", "frame"),
}


def test_tables_say_units_and_name_their_cases(found, tmp_path):
    _, _, result = found
    write_tables(result, tmp_path)
    for path in tmp_path.glob("*.csv"):
        table = pd.read_csv(path)
        for column in table.select_dtypes("number"):
            told = "[" in column or column in _WITHOUT_UNIT
            assert told, f"{path.name}: {column}"
        if {"min", "max"} & set(table):
            assert table["unit"].notna().to_numpy().all(), path.name
        if path.stem == "gear_places":  # by pose
            continue
        cases = [c for c in table if c.startswith("case")]
        names = [c.replace("case", "name", 1) for c in cases]
        assert cases, path.name
        assert table[names].notna().to_numpy().all(), path.name


def test_on_all_wheels_the_tires_stand_on_one_plane(found):
    _, _, result = found
    posed = result.ground.poses["all_wheels"]
    heights = [place.ground[2] for place in posed.places.values()]
    assert heights == pytest.approx([-posed.height] * 3, abs=1e-9)
    assert np.ptp([p.ground[2] for p in result.ground.poses["largest"].places.values()])
    case = next(b.case for b in result.balances if b.case.name == "level, all gears")
    assert case.pose == "all_wheels"


def test_places_at_rest_give_the_loads_at_rest_by_hand(found):
    _, _, result = found
    rest = result.places[result.places.pose == "static"].set_index("gear")
    weight = result.ground.aircraft.weight
    nose, main = rest.loc["nose"], rest.loc["main_left"]
    base = main.ground_aft - nose.ground_aft
    assert nose.load_at_rest == pytest.approx(weight * main.ground_aft / base, rel=1e-6)
    lines = standing(result.places)
    assert f"wheelbase {base:.4f} m" in lines[0]
    assert f"{nose.cg_height:.4f} m above the ground" in lines[0]
    assert len(lines) == 5


def test_the_pose_at_rest_is_that_of_the_rigid_aircraft(found):
    """A soft mode of the airframe changes nothing."""
    out, structure, result = found
    aircraft = prepare_aircraft(tiny(), out)
    body = rigid_airframe(structure, aircraft.multibody_nodes, np.eye(3))
    k = len(body.node_id)
    soft = replace(
        body,
        frequency=np.array([1.0]),
        modal_mass=np.array([500.0]),
        modal_damping=np.zeros((1, 1)),
        translation=np.linspace(-0.5, 1.0, 3 * k).reshape(k, 3, 1),
        rotation=np.zeros((k, 3, 1)),
    )
    _, loads, _ = GearStand(soft, aircraft.gears, np.eye(3)).at_rest()
    static = {gear.name: gear.static for gear in result.ground.aircraft.gears}
    assert loads == pytest.approx(static)


def test_subcases_of_the_deck_have_labels_of_their_own(found):
    out, _, result = found
    lines = (out / DECK).read_text().splitlines()
    labels = [line for line in lines if line.startswith("  LABEL")]
    assert len(set(labels)) == len({b.case.name for b in result.balances})


def test_loads_of_zero_are_left_out_and_the_others_say_what_they_are(found):
    loads = found[2].gear_loads
    values = loads[["drag", "side", "vertical"]]
    values = values.join(loads.filter(like="moment"))
    assert values.abs().sum(axis=1).min() > 0.0
    of = loads.groupby("paragraph").what.unique()
    assert list(of["25.487(b)"]) == ["20 g on the unsprung parts"]
    assert "jack" in of["25.519(b)(1)"]


def test_loads_of_a_tow_are_told_apart(found):
    loads = found[2].gear_loads
    tow = loads[loads.paragraph == "25.509"]
    assert {"ground", "tow", "axle against the tow"} <= set(tow.what)
    # No two loads of a case on one gear at one place without a name of their own.
    assert not tow.duplicated(["case", "gear", "at", "what"]).any()


def test_unknown_gears_in_conditions_are_refused():
    case = tiny("\nconditions: {vertical: {main_rihgt: 1e5}}\n")
    with pytest.raises(InputError, match="did you mean 'main_right'"):
        on_ground(None, case.gears, np.eye(3), case.conditions)


def test_a_gear_ahead_of_the_center_of_gravity_is_no_tail_wheel():
    with pytest.raises(InputError, match=r"roles.nose: found tail.*expected nose or"):
        explain(tiny("\nconditions: {roles: {nose: tail}}\n"))


def test_check_finds_no_loads_of_landings_that_cannot_be_flown():
    text = explain(tiny("\nconditions: {rules: CS-23}\n"))
    assert "landings        none: " in text
    assert "loads of the landing: none without landings" in text


def test_check_lists_conditions_with_figures_and_what_cannot_apply():
    text = explain(tiny())
    assert "25.493(b)       2 cases: largest drag" in text
    assert "25.497          none: no tail wheel" in text


def test_check_says_how_the_landings_are_flown():
    """V_L1 = 50 m/s; V_L2 at 2000 m, ISA + 22.8 K: 57.4 m/s, level 1.25 of it."""
    text = explain(tiny("\nconditions: {stall_speed: 50, altitude: 2000}\n"))
    assert (
        "landings        1.829 m/s sink rate (take-off weight), level at 50.0 and 71.8 "
        "m/s, tail-down at 50.0 and 57.4 m/s" in text
    )
    lacking = explain(tiny("\nconditions: {rules: CS-23}\n"))
    assert "landings        none: conditions.wing_area: found none" in lacking
