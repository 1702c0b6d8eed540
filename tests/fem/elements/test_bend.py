"""CBEND: rigid motion, closed forms, the four ways to give an arc, a stored result."""

import numpy as np
import pytest

from fem.errors import InputError
from fem.model.weight import rigid_modes

GRIDS = "GRID,1,,0.,10.,0.\nGRID,2,,10.,0.,0.\nGRID,3,,0.,0.,0.\n"
MATERIAL = "MAT1,2,1.+7,,.3,.05\n"
PBEND = "PBEND,1,2,.1,.01,.02,.03,{rb},{theta},+\n+,,,,,,,,,+\n+,{more}\n"


def bend(orientation: str, rb="", theta="", more="1.,1.") -> str:
    text = GRIDS + MATERIAL + f"CBEND,1,1,1,2,{orientation}\n"
    return text + PBEND.format(rb=rb, theta=theta, more=more)


def tip(block, force: np.ndarray) -> np.ndarray:
    """(6,) displacement of end B with end A clamped."""
    return np.linalg.solve(block.stiffness()[0][6:, 6:], force)


WAYS = {
    "center by a vector": bend("0.,-1.,0.,1"),
    "center by a grid": bend("3,,,1"),
    "tangent": bend("1.,0.,0.,2"),
    "radius": bend("10.,0.,0.,3", rb="10."),
    "angle": bend("10.,0.,0.,4", theta="90."),
}


@pytest.mark.parametrize("way", list(WAYS))
def test_an_arc_is_the_same_however_it_is_given(model, way):
    (block,) = model(WAYS[way]).blocks
    (other,) = model(WAYS["radius"]).blocks
    size = np.abs(other.stiffness()).max()
    np.testing.assert_allclose(block.stiffness(), other.stiffness(), atol=1e-9 * size)
    mass = 0.05 * 0.1 * 10.0 * np.pi / 2
    assert np.trace(block.mass(coupled=False)[0]) == pytest.approx(3.0 * mass)


@pytest.mark.parametrize("more", ["1.,1.", ",,,.5,.3,.02"])
def test_rigid_motions_cost_nothing(model, more):
    """With the line of centroids off the grids, too (RC, ZC, DELTAN)."""
    made = model(bend("10.,0.,0.,3", rb="10.5" if ".5" in more else "10.", more=more))
    (block,) = made.blocks
    stiffness = block.stiffness()[0]
    value = np.linalg.eigvalsh(stiffness)
    rigid = rigid_modes(made.points, np.zeros(3))[block.dof[0]]
    assert np.abs(stiffness @ rigid).max() < 1e-11 * value[-1]
    assert np.abs(value[:6]).max() < 1e-12 * value[-1] < 1e-6 * value[6] * value[-1]


def test_strain_energy_and_forces_of_a_quarter_circle_against_msc(model):
    """Their deck b3bend: 100 along x at B; energy 39.33274, moment 1000 at A."""
    text = bend("10.,0.,0.,3", rb="10.").replace(".02,.03", ".01,.02")
    (block,) = model(text).blocks
    force = np.array([100.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    u = tip(block, force)
    assert 0.5 * force @ u == pytest.approx(39.33274, rel=2e-7)
    found = block.forces().matrix[0][:, 6:] @ u
    theirs = [1000.0, 0, 0, 0, 100.0, 0, 0, 0, 100.0, 0, 0, 0]
    np.testing.assert_allclose(found, theirs, atol=1e-8)


def test_a_quarter_circle_sags_as_castigliano_says(model):
    """Across its plane: P R^3 (pi / (4 E I2) + (3 pi / 4 - 2) / (G J))."""
    (block,) = model(bend("10.,0.,0.,3", rb="10.", more="")).blocks
    e, g = 1e7, 1e7 / 2.6
    flexible = np.pi / (4 * e * 0.02) + (0.75 * np.pi - 2.0) / (g * 0.03)
    assert tip(block, np.eye(6)[2])[2] == pytest.approx(1000.0 * flexible, rel=1e-9)


def test_many_pieces_of_an_arc_are_the_arc(model):
    """Force at the end of four elements of one grid line each."""
    angles = np.radians([90.0, 70.0, 40.0, 15.0, 0.0])
    text = MATERIAL + PBEND.format(rb="10.", theta="", more="1.,1.")
    for k, angle in enumerate(angles, start=1):
        x, y = 10.0 * np.cos(angle), 10.0 * np.sin(angle)
        text += f"GRID,{k},,{x:.12f},{y:.12f},0.\n"
        if k > 1:
            text += f"CBEND,{k},1,{k - 1},{k},20.,20.,0.,3\n"
    made = model(text)
    stiffness = made.matrices.stiffness.toarray()[6:, 6:]
    whole = np.linalg.inv(stiffness)[-6:, -6:]
    (one,) = model(WAYS["radius"]).blocks
    expected = np.linalg.inv(one.stiffness()[0][6:, 6:])
    np.testing.assert_allclose(whole, expected, atol=1e-8 * np.abs(expected).max())


def test_arcs_that_cannot_be_are_refused(model):
    for text in (
        bend("10.,0.,0.,3", rb="7."),  # less than half the chord
        bend("1.,-1.,0.,3", rb="10."),  # along the chord
        bend("10.,0.,0.,4", theta="0."),
    ):
        with pytest.raises(InputError, match="no arc"):
            model(text)
    with pytest.raises(InputError, match=r"or FSI 1 or 2 of a pipe \(3"):
        model(bend("3,,,1").replace("PBEND,1,2,.1", "PBEND,1,2,3"))
    with pytest.raises(InputError, match=r"RM 0\.01, T 0\.02, expected T above 0"):
        model(bend("3,,,1").replace("PBEND,1,2,.1", "PBEND,1,2,1"))


PIPE = """\
GRID,1,,0.,0.,0.
GRID,2,,1.,1.,0.
MAT1,2,1.+7,,.3
CBEND,1,1,1,2,1.,0.,0.,3
PBEND,1,2,2,.1,{t},{p},1.
"""


def test_a_pipe_moves_as_in_a_commercial_code(model):
    """MSC Nastran's demonstration problem d200obus, CBEND 6911 (printed digits)."""
    (block,) = model(PIPE.format(t=0.05, p=100.0)).blocks
    moved = tip(block, np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]))
    printed = [
        *(1.740756e-4, -7.588704e-5, 7.730167e-4),
        *(6.890472e-4, -3.034299e-4, -2.499627e-4),
    ]
    assert moved == pytest.approx(printed, rel=1e-6)


def test_two_bends_one_a_pipe_move_as_in_a_commercial_code(model):
    """MSC's api3, grid 6904 at 0 Hz; DELTAN 0 leaves bending and stretching apart."""
    text = """\
GRID,1,,0.,0.,0.,,123456
GRID,2,,1.,0.,0.,,123456
GRID,3,,0.,1.,0.,,123456
GRID,4,,1.,1.,0.
CBEND,1,1,1,4,3,,,1
CBEND,2,2,1,4,2,,,1
PBEND,1,1,1.,.0833,.0833,.05
,-.5,-.5,-.5,.5,.5,.5,.5,-.5
,,,,,,0.
PBEND,2,1,1,.3285,.4845
MAT1,1,1.+7,4.+6,.25
"""
    (block,) = model(text).blocks
    joined = sum(matrix[6:, 6:] for matrix in block.stiffness())
    moved = np.linalg.solve(joined, [2.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    # The real part of a response with GE 0.03333, in the plane of the arcs.
    assert moved[[0, 1, 5]] / (1.0 + 0.03333**2) == pytest.approx(
        [7.9505315e-7, -5.2565719e-7, -8.1916903e-7], rel=1e-6
    )


def test_thin_pipes_flatten_and_pressure_stiffens_them(model):
    """Rotation under a moment grows by k of ASME III NB-3687.2."""

    def turned(t: float, p: float) -> float:
        (block,) = model(PIPE.format(t=t, p=p)).blocks
        return tip(block, np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0]))[5]

    t, inertia = 0.002, np.pi / 4 * (0.101**4 - 0.099**4)
    k = 1.65 * 0.1**2 / t
    assert turned(t, 0.0) == pytest.approx(k * np.pi / 2 / (1e7 * inertia), rel=0.02)
    eased = 1.0 + 6.0 * 300.0 * 0.1 / (t * 1e7) * 50.0 ** (4 / 3) * 10.0 ** (1 / 3)
    assert turned(t, 0.0) / turned(t, 300.0) == pytest.approx(eased)
