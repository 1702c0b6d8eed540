"""Modal transient: exact against closed forms, equal to direct in the limit."""

import numpy as np
import pytest
import scipy.sparse as sp
from plain_models import beam

from fem.algebra.damping import Damping
from fem.algebra.modes import normal_modes
from fem.response.direct import GeneralizedAlpha, TransientLoad, direct_transient
from fem.response.modal import modal_damping, modal_transient, residual_vectors
from fem.response.observation import Observation

QUANTITIES = ("displacement", "velocity", "acceleration")


def histories(run, *arguments, **keywords):
    observers = [Observation(quantity) for quantity in QUANTITIES]
    run(*arguments, observers=observers, **keywords)
    return [observer.history for observer in observers], observers[0].time


def tip_load(size, function):
    pattern = sp.csr_matrix(([1.0], ([size - 2], [0])), (size, 1))
    return TransientLoad(pattern, lambda t: function(t)[None])


@pytest.mark.parametrize("zeta", [0.0, 0.05, 1.3])
def test_ramp_response_is_exact_for_any_step(zeta):
    """u'' + 2ζω u' + ω² u = t with u0, v0, at large and changing steps."""
    omega = 11.0
    one = sp.csr_matrix([[1.0]])
    modes = normal_modes(omega**2 * one, one, count=1)
    load = TransientLoad(one, lambda t: t[None])
    (u, v, a), time = histories(
        modal_transient,
        modes,
        one,
        steps=[(7, 0.31), (5, 0.17, 2)],
        load=load,
        ratio=zeta,
        u0=np.array([0.3]),
        v0=np.array([-2.0]),
    )
    particular = time / omega**2 - 2 * zeta / omega**3
    roots = np.roots([1, 2 * zeta * omega, omega**2]).astype(complex)
    start = np.array([0.3 + 2 * zeta / omega**3, -2.0 - 1 / omega**2])
    c = np.linalg.solve(np.array([[1, 1], roots]), start)
    e = c[:, None] * np.exp(roots[:, None] * time)
    np.testing.assert_allclose(u[:, 0], (particular + e.sum(0)).real, atol=1e-12)
    np.testing.assert_allclose(
        v[:, 0], (1 / omega**2 + (roots[:, None] * e).sum(0)).real, atol=1e-11
    )
    np.testing.assert_allclose(
        a[:, 0], (roots[:, None] ** 2 * e).sum(0).real, atol=1e-9
    )


@pytest.mark.parametrize("clamped", [True, False])
@pytest.mark.parametrize("damper", [0.0, 0.4])
def test_all_modes_equal_direct_integration(clamped, damper):
    """Proportional and, with a damper at the tip, non-proportional damping."""
    stiffness, mass = beam(4, clamped=clamped)
    n = stiffness.shape[0]
    other = sp.csr_matrix(([damper], ([n - 2], [n - 2])), (n, n)) if damper else None
    damping = Damping(stiffness_factor=2e-3, mass_factor=0.1, other=other)
    load = tip_load(n, lambda t: np.sin(8 * t) ** 2)
    modes = normal_modes(stiffness, mass, count=n)
    ours, _ = histories(
        modal_transient, modes, mass, damping, steps=[(2000, 1e-3, 20)], load=load
    )
    direct, _ = histories(
        direct_transient,
        stiffness,
        mass,
        damping,
        steps=[(16000, 1.25e-4, 160)],
        load=load,
        scheme=GeneralizedAlpha(0.9),
    )
    for mine, theirs, tolerance in zip(ours, direct, (1e-5, 1e-4, 2e-3)):
        np.testing.assert_allclose(mine, theirs, atol=tolerance * np.abs(theirs).max())


@pytest.mark.parametrize("clamped", [True, False])
def test_residual_vectors_make_the_static_part_exact(clamped):
    stiffness, mass = beam(12, clamped=clamped)
    n = stiffness.shape[0]
    rise = 0.5 * (1 - np.cos(np.linspace(0, np.pi, 301)))
    load = tip_load(n, lambda t: np.interp(t, np.linspace(0, 3.0, 301), rise))
    every = normal_modes(stiffness, mass, count=n)
    few = normal_modes(stiffness, mass, count=4)
    completed = residual_vectors(stiffness, mass, few, load.pattern)
    assert completed.count == 5
    gram = completed.shape.T @ (mass @ completed.shape)
    np.testing.assert_allclose(gram, np.eye(5), atol=1e-10)
    energy = completed.shape.T @ (stiffness @ completed.shape)
    np.testing.assert_allclose(
        np.diag(energy), completed.eigenvalue, atol=1e-7 * energy.max()
    )
    results = []
    for modes in (every, few, completed):
        (u, _, _), _ = histories(
            modal_transient, modes, mass, steps=[(300, 0.01)], load=load, ratio=0.02
        )
        # Slope at the loaded end, relative to the elastic motion.
        results.append(u[:, -1] - (u[:, 1] if not clamped else 0.0))
    exact, truncated, with_residual = results
    scale = np.abs(exact).max()
    assert np.abs(truncated - exact).max() > 20 * np.abs(with_residual - exact).max()
    assert np.abs(with_residual - exact).max() < 1e-3 * scale


def test_residual_vectors_of_all_modes_are_none():
    stiffness, mass = beam(3, clamped=True)
    modes = normal_modes(stiffness, mass, count=6)
    load = np.ones((6, 2))
    assert residual_vectors(stiffness, mass, modes, load).count == 6


def test_block_of_load_cases_and_operators():
    stiffness, mass = beam(5, clamped=True)
    modes = normal_modes(stiffness, mass, count=6)
    pattern = sp.csr_matrix(([1.0], ([8], [0])), (10, 1))
    scales = np.array([1.0, -3.0, 0.5])
    block = TransientLoad(pattern, lambda t: scales[:, None, None] * t)
    row = Observation("acceleration", sp.csr_matrix(([1.0], ([0], [8])), (1, 10)))
    whole = Observation("acceleration")
    modal_transient(
        modes, mass, steps=[(50, 0.01, 3)], load=block, observers=[row, whole]
    )
    np.testing.assert_allclose(row.values[:, :, 0], whole.values[:, :, 8])
    np.testing.assert_allclose(whole.values[:, 1], -3 * whole.values[:, 0], atol=1e-12)


def test_projected_damping_is_diagonal_for_proportional_damping():
    stiffness, mass = beam(5, clamped=True)
    modes = normal_modes(stiffness, mass, count=4)
    damping = Damping(stiffness_factor=0.01, mass_factor=0.2)
    full = modes.shape.T @ (damping.matrix(stiffness, mass) @ modes.shape)
    np.testing.assert_allclose(
        modal_damping(modes, damping), full, atol=1e-9 * full.max()
    )
