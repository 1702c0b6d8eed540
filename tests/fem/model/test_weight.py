"""Weight table: rigid bodies in closed form, Nastran's conventions."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fem.model.weight import rigid_modes, weigh

FRAMES = """
CORD2R,1,,1.,2.,3.,2.,3.,5.
,4.,1.,2.
CORD2C,2,,-1.,-2.,.5,.3,-2.2,4.
,3.,1.,1.
"""
number = st.floats(-2.0, 2.0).map(lambda a: round(a, 3))


@settings(
    max_examples=15,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(
    x=st.lists(number, min_size=6, max_size=6),
    cd=st.sampled_from([0, 1, 2]),
    cid=st.sampled_from([-1, 0, 1, 2]),
)
def test_offset_mass_is_an_exact_rigid_body(model, x, cd, cid):
    grid, offset = np.array(x[:3]) + np.array([5.0, 4.0, 3.0]), np.array(x[3:])
    coordinates = ",".join(f"{v:.3f}" for v in offset)
    built = model(
        FRAMES
        + f"GRID,1,,{grid[0]:.3f},{grid[1]:.3f},{grid[2]:.3f},{cd}\n"
        + f"CONM2,1,1,{cid},7.,{coordinates}\n,.5,.1,.6,-.2,.05,.7"
    )
    tensor = np.array([[0.5, -0.1, 0.2], [-0.1, 0.6, -0.05], [0.2, -0.05, 0.7]])
    axes = np.eye(3)
    if cid > 0:
        axes = built.points.frames[cid].triads(grid)
    cg = offset if cid == -1 else grid + axes @ offset
    weight = weigh(built.points, built.matrices.mass, reference=[1.0, -1.0, 2.0])
    assert weight.total == pytest.approx(7.0, rel=1e-12)
    assert weight.center == pytest.approx(cg, rel=1e-10, abs=1e-10)
    expected = axes @ tensor @ axes.T
    assert weight.inertia == pytest.approx(expected, rel=1e-8, abs=1e-10)
    assert pytest.approx(np.linalg.eigvalsh(tensor), rel=1e-8) == weight.IQ


def test_table_about_a_reference_in_nastrans_signs(model):
    """MO of 2 kg at (1, 2, 3) about the origin, as Nastran's table prints it."""
    built = model("GRID,1,,1.,2.,3.\nCONM2,1,1,,2.")
    weight = weigh(built.points, built.matrices.mass)
    expected = [
        [2, 0, 0, 0, 6, -4],
        [0, 2, 0, -6, 0, 2],
        [0, 0, 2, 4, -2, 0],
        [0, -6, 4, 26, -4, -6],
        [6, 0, -2, -4, 20, -12],
        [-4, 2, 0, -6, -12, 10],
    ]
    assert pytest.approx(np.array(expected, dtype=float)) == weight.MO
    assert weight.cg == pytest.approx(np.array([[0, 2, 3], [1, 0, 3], [1, 2, 0.0]]))
    assert pytest.approx(np.zeros((3, 3)), abs=1e-12) == weight.IS


def test_products_of_inertia_have_nastrans_sign(model):
    """Two masses on the line x = y: I(S) shows + ∫ x y dm off the diagonal."""
    built = model("GRID,1,,1.,1.,0.\nGRID,2,,-1.,-1.,0.\nCONM2,1,1,,3.\nCONM2,2,2,,3.")
    weight = weigh(built.points, built.matrices.mass)
    assert weight.IS[0, 1] == pytest.approx(6.0)
    assert weight.inertia[0, 1] == pytest.approx(-6.0)


def test_mass_in_one_direction_only_and_wtmass(model):
    """A scalar mass in T1 counts for x alone, with its own center."""
    built = model(
        "PARAM,WTMASS,.1\nGRID,1,,0.,0.,0.\nGRID,2,,0.,4.,0.\nCONM2,1,1,,3.\n"
        "CMASS2,2,1.,2,1"
    )
    weight = weigh(built.points, built.matrices.mass, wtmass=0.1)
    assert weight.mass == pytest.approx([4.0, 3.0, 3.0])
    assert weight.cg[0] == pytest.approx([0.0, 1.0, 0.0])


def test_skew_directional_mass_turns_into_its_principal_axes(model):
    """A mass along one skew displacement axis: S finds that axis."""
    built = model(FRAMES + "GRID,1,,1.,2.,1.,1\nCONM2,1,1,,3.\nCMASS2,2,1.,1,1")
    weight = weigh(built.points, built.matrices.mass)
    assert sorted(weight.mass) == pytest.approx([3.0, 3.0, 4.0])
    heavy = weight.S[:, np.argmax(weight.mass)]
    assert abs(heavy @ built.points.rotation[0, :, 0]) == pytest.approx(1.0)


def test_rigid_modes_leave_scalar_points_at_rest(model):
    built = model("GRID,1,,1.,2.,1.\nSPOINT,5")
    assert np.all(rigid_modes(built.points, [0, 0, 0])[6] == 0.0)
