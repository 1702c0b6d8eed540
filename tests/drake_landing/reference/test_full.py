"""DLR-D150-FULL: counts, mass, symmetry, modes."""

import numpy as np
import pytest

from drake_landing.reference.d150.facts import facts
from fem.algebra.modes import normal_modes

ELEMENTS = ("CQUAD4", "CTRIA3", "CBAR", "CBUSH", "CONM2")


def _cards(model, *names):
    starts = tuple(f"{name:<8}" for name in names) + tuple(f"{n}*" for n in names)
    return [line for line in model.deck.split("\n") if line.startswith(starts)]


def test_grids_and_elements_as_in_the_paper(full):
    assert len(full.model.grid_id) == pytest.approx(34268, rel=0.005)
    assert len(_cards(full.model, *ELEMENTS)) == pytest.approx(44535, rel=0.005)


def test_mass_table_closes_at_72500_kg(full):
    masses = full.model.masses
    gears = sum(gear.mass for gear in full.model.gears)
    assert masses.mass.sum() + gears == pytest.approx(72500.0, rel=1e-6)


def test_grids_are_mirror_images(full):
    assert set(full.mirror.values()) == set(full.mirror)


@pytest.mark.slow
def test_aircraft_weighs_72500_kg_at_25_percent_of_the_mean_chord(full):
    mass, cg, inertia = full.whole_aircraft()
    target = facts("overall")
    assert full.complaints == []
    assert mass == pytest.approx(72500.0, rel=1e-3)
    assert cg[0] == pytest.approx(target["mass"]["x_cg"], abs=0.02)
    assert cg[1] == pytest.approx(0.0, abs=1e-6)
    assert np.diag(inertia) == pytest.approx(
        [target["inertia"][axis] for axis in ("roll", "pitch", "yaw")], rel=0.1
    )


@pytest.mark.slow
def test_shells_are_mirror_images(full):
    shells = {
        frozenset(e.node_ids): e.Pid()
        for e in full.bdf.elements.values()
        if e.type in ("CQUAD4", "CTRIA3")
    }
    for nodes, pid in shells.items():
        assert shells[frozenset(full.mirror[i] for i in nodes)] == pid


@pytest.mark.slow
def test_exactly_six_rigid_modes_and_wing_bending(full):
    structure = full.structure
    modes = normal_modes(
        structure.stiffness, structure.mass, count=12, rigid_body=structure.rigid_body
    )
    assert modes.rigid == 6
    assert 2.0 < modes.frequency_hz[6] < 3.0
    tips = [full.model.monitoring[f"wing_tip_{side}"] for side in ("left", "right")]
    left, right = structure.operator(tips, [3]) @ modes.shape[:, 6]
    assert left == pytest.approx(right, rel=1e-4)
