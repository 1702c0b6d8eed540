"""DLR-D150-CON: counts, mass, symmetry, and what a second reader says of the deck."""

import numpy as np
import pytest

from drake_landing.cli import app, guarded
from drake_landing.reference.d150 import build, write_model
from drake_landing.reference.d150.facts import facts
from fem.algebra.modes import normal_modes
from fem.errors import InputError


def test_614_grids_of_which_261_are_interface_nodes(con):
    grids = set(con.bdf.nodes)
    assert len(grids) == 614
    assert len(con.model.interface) == 261
    assert set(con.model.interface) <= grids
    outline = [
        i for part, ids in con.model.parts.items() for i in ids if "outl" in part
    ]
    fuselage = con.model.parts["outline fuselage"]
    assert (len(outline) - len(fuselage), len(fuselage)) == (198, 155)


def test_two_readers_have_nothing_to_say(con):
    assert con.bdf.nodes
    assert con.complaints == []
    assert con.structure.notices == []
    assert con.structure.damping_notices == []


def test_exactly_six_rigid_modes_and_first_wing_bending(con):
    structure = con.structure
    modes = normal_modes(
        structure.stiffness,
        structure.mass,
        count=30,
        rigid_body=structure.rigid_body,
    )
    assert modes.rigid == 6
    first = modes.frequency_hz[6]
    assert 2.0 < first < 2.6
    tips = [con.model.monitoring[f"wing_tip_{side}"] for side in ("left", "right")]
    left, right = structure.operator(tips, [3]) @ modes.shape[:, 6]
    assert left == pytest.approx(right, rel=1e-4)
    # The check list of a beam model of this aircraft: 14 elastic modes below 10 Hz.
    assert 12 <= np.sum(modes.frequency_hz[6:] < 10) <= 18


def test_more_than_300_modes_exist(con):
    assert con.structure.size > 1000
    mass = con.structure.mass.toarray()
    assert np.linalg.eigvalsh(mass / np.sqrt(np.outer(*[mass.diagonal()] * 2)))[0] > 0


def test_monitoring_points_and_attachments_stand_where_they_should(con):
    at = {i: n.get_position() for i, n in con.bdf.nodes.items()}
    monitoring, attachment = con.model.monitoring, con.model.attachment
    assert at[monitoring["nose_tip"]][0] == 0.0
    assert at[monitoring["tail_tip"]][0] == pytest.approx(37.57)
    assert at[monitoring["wing_tip_right"]][1] == pytest.approx(16.963, abs=1e-3)
    assert at[monitoring["wing_tip_left"]][1] == pytest.approx(-16.963, abs=1e-3)
    assert at[monitoring["fin_tip"]][2] == pytest.approx(7.823, abs=1e-3)
    assert at[attachment["nose"]] == pytest.approx([5.07, 0.0, -1.6])
    assert con.model.position_of(attachment["nose"]) == pytest.approx([5.07, 0, -1.6])
    with pytest.raises(ValueError, match="DLR-D150-CON: no grid 999999999"):
        con.model.position_of(999999999)
    assert at[attachment["main_left"]] == pytest.approx([17.6, -3.795, -1.05])


def test_aircraft_weighs_72500_kg_at_25_percent_of_the_mean_chord(con):
    mass, cg, inertia = con.whole_aircraft()
    target = facts("overall")
    assert mass == pytest.approx(72500.0, rel=1e-6)
    assert cg[0] == pytest.approx(target["mass"]["x_cg"], abs=1e-3)
    assert cg[1] == pytest.approx(0.0, abs=1e-6)
    assert np.diag(inertia) == pytest.approx(
        [target["inertia"][axis] for axis in ("roll", "pitch", "yaw")], rel=0.1
    )


def test_every_lumped_mass_is_a_body(con):
    for element in con.bdf.masses.values():
        i11, i21, i22, i31, i32, i33 = element.I
        tensor = np.array([[i11, -i21, -i31], [-i21, i22, -i32], [-i31, -i32, i33]])
        assert element.mass > 0
        principal = np.linalg.eigvalsh(tensor)
        assert principal[0] > 0


def test_mass_table_adds_up_to_the_deck(con):
    deck = sum(e.mass for e in con.bdf.masses.values())
    assert con.model.masses.mass.sum() == pytest.approx(deck, rel=1e-7)
    gears = sum(gear.mass for gear in con.model.gears)
    assert deck + gears == pytest.approx(72500.0, rel=1e-7)


def test_grids_are_mirror_images(con):
    assert len(con.mirror) == len(con.model.grid_id)


def test_masses_are_mirror_images(con):
    here = _masses_by_node(con, np.ones(3))
    there = _masses_by_node(con, np.array([1.0, -1.0, 1.0]))
    for node, twin in con.mirror.items():
        if node in here:
            assert here[node] == pytest.approx(there[twin], rel=1e-6, abs=1e-6)


def test_bars_are_mirror_images(con):
    bars = {}
    for e in con.bdf.elements.values():
        if e.type == "CBAR":
            p = con.bdf.properties[e.pid_ref.pid if e.pid_ref else e.pid]
            values = (p.A, p.i1, p.i2, p.j)
            bars[frozenset((e.ga, e.gb))] = values
    for ends, values in bars.items():
        twin = frozenset(con.mirror[i] for i in ends)
        assert bars[twin] == values


def test_topologies_differ_in_the_main_gear_only():
    one, two = (set(build("con", t).deck.split("\n")) for t in ("1", "2"))
    rigid = [line for line in one ^ two if line.startswith("RBE2")]
    assert len(rigid) == 4
    titles = [line for line in one ^ two if "topology" in line]
    assert len(titles) + len(rigid) == len(one ^ two)


def test_command_chooses_the_topology(tmp_path, capsys):
    out = tmp_path / "a.bdf"
    assert guarded(app, ["model", "con", "--topology", "2", "--out", str(out)]) == 0
    assert "gear topology 2" in out.read_text()
    line = ["model", "con", "--topology", "distributed", "--out", str(out)]
    assert guarded(app, line) == 2
    assert "expected one of 1, 2" in capsys.readouterr().err


def test_write_model_writes_the_deck(tmp_path):
    model = write_model("con", tmp_path / "d150.bdf")
    assert (tmp_path / "d150.bdf").read_text() == model.deck
    assert [p.name for p in tmp_path.iterdir()] == ["d150.bdf"]
    assert model.name == "DLR-D150-CON"


def test_bad_requests_are_explained(tmp_path):
    with pytest.raises(InputError, match="did you mean 'con'"):
        build("cone")
    with pytest.raises(InputError, match="topology: found '7', expected one of 1, 2"):
        build("con", "7")
    with pytest.raises(InputError, match="does not exist"):
        write_model("con", tmp_path / "none" / "d150.bdf")


def _masses_by_node(con, flip):
    """Node -> mass, first moment, diagonal of inertia; summed over its CONM2."""
    sums: dict[int, np.ndarray] = {}
    for e in con.bdf.masses.values():
        own = np.array([e.I[0], e.I[2], e.I[5]])
        row = np.concatenate([[e.mass], e.mass * np.array(e.X) * flip, own])
        sums[e.nid] = sums.get(e.nid, 0.0) + row
    return sums
