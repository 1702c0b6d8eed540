"""CSHEAR: uniform shear, equilibrium, Garvey's cases joining smoothly, rods."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fem.elements.shells.shear_panel import ShearPanel, panel_shape
from fem.properties.materials import Isotropic

E, NU, T = 7e10, 0.3, 0.002
G = E / 2.6


def panel(corners, rods=0.0) -> ShearPanel:
    one = np.ones(1)
    return ShearPanel(
        card="CSHEAR",
        id=np.array([1]),
        dof=np.arange(12)[None],
        pid=np.array([1]),
        corners=np.asarray(corners, float)[None],
        thickness=T * one,
        nsm=0.0 * one,
        rods=np.full((1, 4), rods),
        material=Isotropic(
            e=E * one,
            g=G * one,
            nu=NU * one,
            rho=2700 * one,
            ge=0 * one,
            alpha=0 * one,
            tref=0 * one,
        ),
    )


def convex(seed, warp):
    rng = np.random.default_rng(seed)
    flat = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) + rng.uniform(-0.25, 0.25, (4, 2))
    xyz = np.c_[flat, warp * rng.uniform(-1, 1, 4)]
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return xyz @ turn.T, rng


def test_rectangle_in_uniform_shear():
    a, b, gamma = 2.0, 0.5, 1e-3
    block = panel([[0, 0, 0], [a, 0, 0], [a, b, 0], [0, b, 0]])
    u = np.zeros((4, 3))
    u[2:, 0] = gamma * b
    force = block.stiffness()[0] @ u.ravel()
    flow = G * T * gamma
    half = 0.5 * flow * np.array([[-a, -b, 0], [-a, b, 0], [a, b, 0], [a, -b, 0]])
    np.testing.assert_allclose(force.reshape(4, 3), half, rtol=1e-12, atol=1e-9)
    linear = block.stresses().matrix @ u.ravel()
    np.testing.assert_allclose(block.stresses().derive(linear), G * gamma, rtol=1e-12)
    forces = dict(zip(block.forces().columns, block.forces().matrix[0] @ u.ravel()))
    assert forces["shear12"] == pytest.approx(flow)
    assert forces["f21"] == pytest.approx(0.5 * flow * a)
    assert forces["f32"] == pytest.approx(-0.5 * flow * b)
    assert forces["kick1"] == 0.0


def test_stretching_needs_rods():
    square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    u = np.array([0, 0, 0, 1e-3, 0, 0, 1e-3, 0, 0, 0, 0, 0])
    assert np.abs(panel(square).stiffness()[0] @ u).max() < 1e-6
    force = panel(square, rods=1e-4).stiffness()[0] @ u
    assert force[3] == pytest.approx(E * 1e-4 * 1e-3)


@settings(max_examples=50, deadline=None)
@given(seed=st.integers(0, 10**6), warp=st.floats(0.0, 0.2))
def test_rigid_motion_needs_no_force(seed, warp):
    xyz, rng = convex(seed, warp)
    block = panel(xyz, rods=1e-4)
    shift, turn = rng.normal(size=3), rng.normal(size=3)
    u = (shift + np.cross(turn, xyz)).ravel()
    stiffness = block.stiffness()[0]
    scale = np.abs(stiffness) @ np.abs(u)
    assert np.abs(stiffness @ u).max() <= 1e-10 * scale.max()
    assert np.linalg.eigvalsh(stiffness)[0] > -1e-9 * np.abs(stiffness).max()


@settings(max_examples=50, deadline=None)
@given(seed=st.integers(0, 10**6))
def test_side_forces_add_up_to_the_corner_forces(seed):
    """A flat panel: the two side forces at each corner give its nodal force.

    Exactly, unless sides within 1 % of parallel are taken as parallel.
    """
    xyz, rng = convex(seed, 0.0)
    block = panel(xyz)
    u = rng.normal(size=12)
    nodal = (block.stiffness()[0] @ u).reshape(4, 3)
    f = dict(zip(block.forces().columns, block.forces().matrix[0] @ u))
    t = np.roll(xyz, -1, axis=0) - xyz
    t /= np.linalg.norm(t, axis=1)[:, None]
    parallel = min(np.abs(np.cross(t[k], t[k + 2])).max() for k in (0, 1)) < 0.02
    expected = np.stack(
        [
            -f["f21"] * t[0] + f["f41"] * t[3],
            f["f12"] * t[0] - f["f32"] * t[1],
            f["f23"] * t[1] - f["f43"] * t[2],
            f["f34"] * t[2] - f["f14"] * t[3],
        ]
    )
    scale = np.abs(nodal).max()
    assert np.abs(nodal.sum(axis=0)).max() < 1e-9 * scale
    assert np.abs(nodal - expected).max() < (0.03 if parallel else 1e-9) * scale


@pytest.mark.parametrize("bend", ["1-2 and 3-4", "1-4 and 2-3", "both"])
def test_cases_join_at_parallel_sides(bend):
    """Sides just beyond and just within the limit of parallel: nearly the same."""

    def flexibility(slope):
        # Sides 1-2 and 3-4 parallel up to the slope; 1-4 and 2-3 likewise for "both".
        right = 1.1 if bend == "both" else 1.3
        rise = 0.9 * (1.0 + slope)
        corners = np.array([[0, 0, 0], [1.0, 0, 0], [right, rise, 0], [0.1, 0.9, 0]])
        if bend == "1-4 and 2-3":
            corners = corners[[3, 0, 1, 2]]
        return panel_shape(corners[None], np.array([NU])).flexibility[0]

    inside, outside = flexibility(0.006), flexibility(0.016)
    assert outside == pytest.approx(inside, rel=0.04)


def test_mass():
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    mass = panel(square).mass(coupled=True)[0]
    np.testing.assert_allclose(mass, np.eye(12) * 2700 * T / 4)
