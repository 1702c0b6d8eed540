"""Laminates against closed forms and equilibrium; properties from decks."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fem.deck.reader import read_deck
from fem.properties.elasticity import orthotropic_plane, plane_stress
from fem.properties.laminate import Laminate
from fem.properties.shells import read_shell_properties


def laminate(thickness, angles, *, z0=None, plane=None, shear=None) -> Laminate:
    thickness = np.asarray(thickness, float)
    count = len(thickness)
    plane = orthotropic_plane(140e9, 10e9, 0.3, 5e9) if plane is None else plane
    shear = np.diag([1 / 5e9, 1 / 3e9]) if shear is None else shear
    return Laminate(
        z0=-0.5 * thickness.sum() if z0 is None else z0,
        thickness=thickness,
        angle=np.radians(np.asarray(angles, float)),
        plane=np.repeat(plane[None], count, axis=0),
        shear_flexibility=np.repeat(shear[None], count, axis=0),
        rho=np.full(count, 1600.0),
    )


def test_one_isotropic_material_in_plies_is_a_plate():
    plane, g, t = plane_stress(70e9, 0.3), 70e9 / 2.6, 0.01
    stack = laminate(
        [0.002, 0.005, 0.003], [0, 30, 75], plane=plane, shear=np.eye(2) / g
    )
    a, b, d = stack.stiffness()
    np.testing.assert_allclose(a, plane * t, rtol=1e-12, atol=1e-3)
    assert not b.any()
    np.testing.assert_allclose(d, plane * t**3 / 12, rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(
        stack.transverse_flexibility(),
        np.eye(2) / (5 / 6 * g * t),
        rtol=1e-12,
        atol=1e-20,
    )


def test_cross_ply_by_hand():
    """[0/90]: B11 = -B22 = (Q22 - Q11) t^2 / 4 with t the ply thickness times 1."""
    t = 0.001
    stack = laminate([t, t], [0, 90])
    q = orthotropic_plane(140e9, 10e9, 0.3, 5e9)
    a, b, d = stack.stiffness()
    assert a[0, 0] == pytest.approx((q[0, 0] + q[1, 1]) * t)
    assert a[0, 1] == pytest.approx(2 * q[0, 1] * t)
    assert b[0, 0] == pytest.approx((q[1, 1] - q[0, 0]) * t**2 / 2)
    assert b[1, 1] == pytest.approx(-b[0, 0])
    assert d[0, 0] == pytest.approx((q[0, 0] + q[1, 1]) * t**3 / 3)
    assert abs(a[0, 2]) < 1e-6 * a[0, 0]


def test_quasi_isotropic_membrane():
    a, _, _ = laminate([1e-3] * 3, [0, 60, -60]).stiffness()
    assert a[0, 0] == pytest.approx(a[1, 1])
    assert a[2, 2] == pytest.approx(0.5 * (a[0, 0] - a[0, 1]))
    assert abs(a[:2, 2]).max() < 1e-9 * a[0, 0]


def test_sandwich_shear_is_that_of_the_core():
    """Thin stiff faces: the core carries Q / d, flexibility t_core / (G d^2)."""
    plane = np.stack(
        [plane_stress(70e9, 0.3), plane_stress(7e4, 0.3), plane_stress(70e9, 0.3)]
    )
    g = np.array([27e9, 20e6, 27e9])
    faces, core = 1e-4, 0.02
    stack = Laminate(
        z0=-0.5 * core - faces,
        thickness=np.array([faces, core, faces]),
        angle=np.zeros(3),
        plane=plane,
        shear_flexibility=np.eye(2) / g[:, None, None],
        rho=np.zeros(3),
    )
    apart = core + faces
    assert stack.transverse_flexibility()[0, 0] == pytest.approx(
        core / (20e6 * apart**2), rel=1e-3
    )


@settings(max_examples=40, deadline=None)
@given(
    plies=st.lists(
        st.tuples(st.floats(1e-4, 1e-2), st.floats(-90, 90)), min_size=1, max_size=6
    ),
    z0=st.floats(-0.02, 0.02),
    seed=st.integers(0, 1000),
)
def test_ply_stresses_are_in_equilibrium_with_the_resultants(plies, z0, seed):
    """Sum of sigma t = N, sum of sigma t z (plus the curvature's part) = M."""
    thickness, angles = zip(*plies)
    stack = laminate(thickness, angles, z0=z0)
    a, b, d = stack.stiffness()
    joined = np.block([[a, b], [b, d]])
    flexible = np.linalg.inv(joined)
    resultant = np.random.default_rng(seed).normal(size=8)
    resultant[3:] *= 0.01
    ply = stack.recovery(flexible) @ resultant
    c, s = np.cos(stack.angle), np.sin(stack.angle)
    xx = c * c * ply[:, 0] + s * s * ply[:, 1] - 2 * c * s * ply[:, 2]
    yy = s * s * ply[:, 0] + c * c * ply[:, 1] + 2 * c * s * ply[:, 2]
    xy = c * s * (ply[:, 0] - ply[:, 1]) + (c * c - s * s) * ply[:, 2]
    stress = np.stack([xx, yy, xy], axis=1)
    t = stack.thickness
    scale = np.abs(joined) @ np.abs(flexible @ resultant[:6])
    np.testing.assert_allclose(t @ stress, resultant[:3], atol=1e-9 * scale[:3].max())
    curvature = (flexible @ resultant[:6])[3:]
    own = np.einsum("p,pij,j->i", t**3 / 12, stack.turned, curvature)
    np.testing.assert_allclose(
        (t * stack.middle) @ stress + own, resultant[3:6], atol=1e-9 * scale[3:].max()
    )


def test_interlaminar_shear_adds_up_to_the_shear_force_and_ends_at_zero():
    stack = laminate([0.001, 0.002, 0.0015], [0, 90, 20])
    at, coefficient = stack.shear_profile()
    np.testing.assert_allclose(at[[0, -1]], 0.0)
    t = stack.thickness
    total = np.einsum(
        "pia,pa->i", coefficient, np.stack([t, t**2 / 2, t**3 / 3], axis=1)
    )
    np.testing.assert_allclose(total, 1.0, rtol=1e-12)


def test_mass_height_of_an_unbalanced_stack():
    stack = laminate([0.001, 0.003], [0, 0], z0=0.0)
    assert stack.mass_height() == pytest.approx(0.002)
    assert laminate([0.001, 0.003], [0, 0]).mass_height() == 0.0


def _of_deck(tmp_path, lam, z0="", card="PCOMP"):
    number = ",{}" if card == "PCOMPG" else ""
    plies = "\n".join(
        f"{number.format(k)},1,.1,{angle},YES" for k, angle in ((1, 0.0), (2, 45.0))
    )
    deck = tmp_path / "laminate.bdf"
    deck.write_text(
        f"SOL 101\nCEND\nBEGIN BULK\n{card},1,{z0},,,,,,{lam}\n{plies}\n"
        "MAT8,1,1.+11,1.+10,.3,5.+9,4.+9,3.+9,1500.\nGRID,1\nGRID,2,,1.\n"
        "GRID,3,,1.,1.\nGRID,4,,0.,1.\nCQUAD4,1,1,1,2,3,4\nENDDATA\n"
    )
    return read_shell_properties(read_deck(deck), [1])[1]


@pytest.mark.parametrize("card", ["PCOMP", "PCOMPG"])
def test_options_of_a_laminate(tmp_path, card):
    """LAM: which of A, B, D and transverse shear the PSHELL behind it has (MSC).

    A symmetric stack has its bottom half of the whole thickness down, in all options.
    """
    plain = _of_deck(tmp_path, "", card=card)
    whole = _of_deck(tmp_path, "SYM", card=card)
    a, d = plain.membrane, whole.bending
    smeared = a * 0.2**2 / 12.0
    expected = {
        "MEM": (a, 0.0), "BEND": (0.0, plain.bending), "SMEAR": (a, smeared),
        "SYMEM": (2 * a, 0.0), "SYBEND": (0.0, d), "SYSMEAR": (2 * a, 8 * smeared),
    }  # fmt: skip
    assert np.abs(plain.coupling).max() > 0.0
    assert not whole.coupling.any()
    for lam, (membrane, bending) in expected.items():
        found = _of_deck(tmp_path, lam, card=card)
        np.testing.assert_allclose(found.membrane, membrane + 0 * a, rtol=1e-9)
        np.testing.assert_allclose(found.bending, bending + 0 * a, rtol=1e-9, atol=1e-3)
        assert not found.coupling.any()
        assert found.shear_flexibility.any() == lam.endswith("MEM")
        assert found.fibre[1] == -found.fibre[0] == found.thickness / 2
    moved = _of_deck(tmp_path, "SYM", z0="0.", card=card)
    steiner = d + whole.membrane * 0.2**2
    np.testing.assert_allclose(moved.bending, steiner, rtol=1e-9)


def test_blank_plies_repeat_the_ply_before(tmp_path):
    """Blank MID and T are those before; groups that are all blank are no plies."""
    deck = tmp_path / "laminate.bdf"
    deck.write_text(
        "SOL 101\nCEND\nBEGIN BULK\nPCOMP,1\n,1,.1,0.,YES,,,90.,YES\n,,,,,2,.2\n"
        "MAT8,1,1.+11,1.+10,.3,5.+9\nMAT1,2,7.+10,,.3\nGRID,1\nENDDATA\n"
    )
    row = read_deck(deck).cards["PCOMP"].iloc[0]
    assert row.mids.tolist() == [1, 1, 2]
    assert row.ts.tolist() == [0.1, 0.1, 0.2]
    assert row.thetas.tolist() == [0.0, 90.0, 0.0]
    assert row.z0 == pytest.approx(-0.2)
