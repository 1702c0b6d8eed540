"""Differential stiffness: what a rigid motion of loaded elements must do.

A rotation turns the forces of an element with it. Lines, panels and rods do so entry by
entry; shells and solids, which leave out products with strains, do the same work.
"""

import numpy as np
import pytest

import fem
from fem.model.differential import differential_stiffness

QUAD = "GRID,1,,0.,0.,0.\nGRID,2,,1.,.1,0.\nGRID,3,,1.2,1.1,{0}\nGRID,4,,-.1,.9,0.\n"
PAIR = "GRID,1,,0.,0.,0.\nGRID,2,,1.,.3,.2\n"
OFFSETS = ",,,.1,.05,-.07,.02,.11,-.03\n"
LINES = {
    "CROD": "CROD,1,1,1,2\nPROD,1,1,.01,1.-6\n",
    "CBAR": f"CBAR,1,1,1,2,0.,0.,1.\n{OFFSETS}PBAR,1,1,.01,2.-6,3.-6,4.-6\n",
    "CBAR with shear": "CBAR,1,1,1,2,0.,0.,1.\nPBAR,1,1,.01,2.-6,3.-6,4.-6\n"
    ",\n,.8,.7\n",
    "CBEAM": f"CBEAM,1,1,1,2,0.,0.,1.\n{OFFSETS}PBEAM,1,1,.01,2.-6,3.-6,0.,4.-6\n"
    ",\n,YES,1.,.02,3.-6,5.-6,0.,6.-6\n,\n,1.,1.\n,,,,,.01,.02,.03,.01\n",
}
SURFACES = {
    "CQUAD4": "CQUAD4,1,1,1,2,3,4,,{0}\nPSHELL,1,1,.01,1,,1\n",
    "CTRIA3": "CTRIA3,1,1,1,2,3,,{0}\nCTRIA3,2,1,1,3,4,,{0}\nPSHELL,1,1,.01,1,,1\n",
    "CQUADR": "CQUADR,1,1,1,2,3,4,,{0}\nPSHELL,1,1,.01,1,,1\n",
}
MIDDLES = (
    "GRID,5,,.5,.05,0.\nGRID,6,,1.1,.6,0.\nGRID,7,,.55,1.,0.\nGRID,8,,-.05,.45,0.\n"
)


@pytest.fixture
def structure(tmp_path):
    def make(bulk):
        path = tmp_path / "deck.bdf"
        head = "SOL 101\nCEND\nBEGIN BULK\nPARAM,AUTOSPC,NO\nPARAM,K6ROT,0.\n"
        path.write_text(f"{head}MAT1,1,7.+10,,.3,2700.\n{bulk}ENDDATA\n")
        return fem.Structure.from_deck(fem.read_deck(path))

    return make


def rotated(points, phi):
    """(g,) rigid rotation about the origin."""
    motion = np.zeros((len(points.xyz), 6))
    motion[:, :3], motion[:, 3:] = np.cross(phi, points.xyz), phi
    return motion.ravel()


def check_translation(model, matrix):
    shift = np.tile([1.0, 2.0, 3.0, 0.0, 0.0, 0.0], len(model.points.xyz))
    assert np.abs(matrix @ shift).max() < 1e-12 * np.abs(matrix).max()


@pytest.mark.parametrize("kind", LINES)
def test_forces_of_lines_turn_with_them(structure, kind):
    model = structure(PAIR + LINES[kind])
    random = np.random.default_rng(3)
    u, phi = 1e-3 * random.normal(size=12), random.normal(size=3)
    matrix = differential_stiffness(model.points, model.blocks, u)
    force = (model.matrices.stiffness @ u).reshape(-1, 2, 3)
    expected = np.cross(phi, force)
    expected[:, 1] *= 0.5  # semitangential moments
    if kind == "CROD":
        expected[:, 1] = 0.0  # its torque is not modelled
    found = (matrix @ rotated(model.points, phi)).reshape(-1, 2, 3)
    assert found == pytest.approx(expected, abs=1e-12 * np.abs(expected).max())
    check_translation(model, matrix)


def test_forces_of_shear_panels_turn_with_them(structure):
    model = structure(QUAD.format(".1") + "CSHEAR,1,1,1,2,3,4\nPSHEAR,1,1,.01,,.5,.3\n")
    random = np.random.default_rng(3)
    u, phi = 1e-3 * random.normal(size=24), random.normal(size=3)
    matrix = differential_stiffness(model.points, model.blocks, u)
    force = (model.matrices.stiffness @ u).reshape(-1, 6)[:, :3]
    found = (matrix @ rotated(model.points, phi)).reshape(-1, 6)[:, :3]
    scale = np.abs(force).max()
    assert found == pytest.approx(np.cross(phi, force), abs=1e-12 * scale)


def membrane_motion(points, height=0.0):
    """(g,) a state of uniform membrane strain in the plane z = height."""
    x, y = points.xyz[:, :2].T
    motion = np.zeros((len(x), 6))
    motion[:, 0], motion[:, 1] = 1e-3 * x + 4e-4 * y, 7e-4 * x - 5e-4 * y
    return motion.ravel()


def check_work(model, u, tolerance=1e-10):
    """The work of rigid rotations is that of the turned forces."""
    matrix = differential_stiffness(model.points, model.blocks, u)
    force = (model.matrices.stiffness @ u).reshape(-1, 6)
    random = np.random.default_rng(5)
    for phi in random.normal(size=(4, 3)):
        motion = rotated(model.points, phi)
        arm = model.points.xyz
        work = np.sum(np.cross(phi, arm) * np.cross(phi, force[:, :3]))
        found = motion @ (matrix @ motion)
        assert found == pytest.approx(work, rel=tolerance)
    check_translation(model, matrix)


@pytest.mark.parametrize("offset", ["", ".05"])
@pytest.mark.parametrize("kind", SURFACES)
def test_membrane_forces_do_the_work_of_turned_forces(structure, kind, offset):
    model = structure(QUAD.format("0.") + SURFACES[kind].format(offset))
    check_work(model, membrane_motion(model.points))


@pytest.mark.parametrize("offset", ["", ".05"])
def test_curved_shells_do_the_work_of_turned_forces(structure, offset):
    shell = f"CQUAD8,1,1,1,2,3,4,5,6\n,7,8,,,,,,{offset}\nPSHELL,1,1,.01,1,,1\n"
    model = structure(QUAD.format("0.") + MIDDLES + shell)
    check_work(model, membrane_motion(model.points))


@pytest.mark.parametrize(
    "cards",
    [
        "CHEXA,1,1,1,2,3,4,5,6\n,7,8\n",
        "CTETRA,1,1,1,2,3,5\n",
        "CPENTA,1,1,1,2,3,5,6,7\n",
    ],
)
def test_stresses_of_solids_do_the_work_of_turned_forces(structure, cards):
    upper = (
        "GRID,5,,0.,0.,1.05\nGRID,6,,1.15,.1,1.05\nGRID,7,,1.5,1.1,1.05\n"
        "GRID,8,,0.,.8,1.05\n"
    )
    model = structure(QUAD.format("0.") + upper + cards + "PSOLID,1,1\n")
    x, y, z = model.points.xyz.T
    motion = np.zeros((len(x), 6))
    motion[:, 0] = 1e-3 * x + 4e-4 * y - 2e-4 * z
    motion[:, 1] = 7e-4 * x - 5e-4 * y
    motion[:, 2] = 3e-4 * x + 6e-4 * z
    check_work(model, motion.ravel())
