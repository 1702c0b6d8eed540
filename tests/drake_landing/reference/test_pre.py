"""DLR-D150-PRE: counts, mass, symmetry, modes, and the reduction onto its nodes."""

import numpy as np
import pytest

from drake_landing.reference.d150 import build
from drake_landing.reference.d150.facts import facts, table
from fem.algebra.modes import normal_modes


@pytest.fixture(scope="module")
def modes(pre):
    structure = pre.structure
    return normal_modes(
        structure.stiffness, structure.mass, count=26, rigid_body=structure.rigid_body
    )


def test_13790_grids(pre):
    assert len(pre.model.grid_id) == 13790
    assert set(pre.model.interface) <= set(map(int, pre.model.grid_id))


def test_two_readers_have_nothing_to_say(pre):
    assert pre.bdf.nodes
    assert pre.complaints == []
    assert pre.structure.notices == []


def test_aircraft_weighs_72500_kg_at_25_percent_of_the_mean_chord(pre):
    mass, cg, inertia = pre.whole_aircraft()
    target = facts("overall")
    assert mass == pytest.approx(72500.0, rel=1e-5)
    assert cg[0] == pytest.approx(target["mass"]["x_cg"], abs=2e-3)
    assert cg[1] == pytest.approx(0.0, abs=1e-6)
    assert np.diag(inertia) == pytest.approx(
        [target["inertia"][axis] for axis in ("roll", "pitch", "yaw")], rel=0.1
    )


def test_every_lumped_mass_is_a_body(pre):
    for element in pre.bdf.masses.values():
        i11, i21, i22, i31, i32, i33 = element.I
        tensor = np.array([[i11, -i21, -i31], [-i21, i22, -i32], [-i31, -i32, i33]])
        assert element.mass > 0
        assert np.linalg.eigvalsh(tensor)[0] > 0


def test_shells_are_mirror_images(pre):
    shells = {
        frozenset(e.node_ids): pre.bdf.properties[e.Pid()].t
        for e in pre.bdf.elements.values()
        if e.type in ("CQUAD4", "CTRIA3")
    }
    assert len(pre.mirror) == len(pre.model.grid_id)
    for nodes, thickness in shells.items():
        assert shells[frozenset(pre.mirror[i] for i in nodes)] == thickness


def test_exactly_six_rigid_modes_and_wing_bending(pre, modes):
    assert modes.rigid == 6
    assert 2.0 < modes.frequency_hz[6] < 3.0
    tips = [pre.model.monitoring[f"wing_tip_{side}"] for side in ("left", "right")]
    left, right = pre.structure.operator(tips, [3]) @ modes.shape[:, 6]
    assert left == pytest.approx(right, rel=1e-4)
    assert abs(left) == pytest.approx(abs(modes.shape[:, 6]).max(), rel=0.1)


def test_as_many_modes_below_10_hz_as_in_the_paper(modes):
    assert np.sum(modes.frequency_hz[6:] < 10) == pytest.approx(19, rel=0.15)


def test_reference_nodes_are_free_for_a_reduction(pre):
    structure = pre.structure
    dof = structure.points.dof(
        np.array(pre.model.interface)[:, None], np.arange(1, 7)[None]
    )
    dependent = ~np.isin(dof, structure.elimination.f).all(axis=1)
    # Rigidly led: three monitoring points, the nose gear, two side-of-body ribs, two
    # pivots of the tailplane, the root of the fin.
    assert dependent.sum() == 9


def test_topology_1_holds_the_gears_on_the_center_box():
    one, two = (build("pre", t) for t in ("1", "2"))
    assert len(one.grid_id) == len(two.grid_id)
    assert one.deck != two.deck


def test_wing_area_between_the_spars_is_covered(pre):
    """The skins' area against that of the planform between the spars."""
    rows = table("wing_stiffness")
    middle = (rows.box_width[1:].to_numpy() + rows.box_width[:-1].to_numpy()) / 2
    planform = middle @ np.diff(rows.y)
    wing = set(pre.model.parts["wing_right"])
    area = sum(
        e.Area()
        for e in pre.bdf.elements.values()
        if e.type == "CQUAD4"
        and wing.issuperset(e.node_ids)
        and "skin" in pre.bdf.properties[e.Pid()].comment
        and abs(e.Normal()[2]) > 0.5
    )
    assert area / 2 == pytest.approx(planform, rel=0.03)
