"""Harmonic response against closed forms of small systems."""

import numpy as np
import pytest
import scipy.sparse as sp

from fem.algebra.frequency_response import (
    HarmonicMatrices,
    direct_response,
    modal_response,
)
from fem.algebra.modes import normal_modes
from fem.algebra.participation import participation

STIFF = np.array([[3.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.5]])
MASS = np.diag([1.0, 2.0, 0.5])
HERTZ = np.array([0.0, 0.05, 0.2, 0.31])
LOAD = np.array([1.0, 2.0 - 1.0j, 0.5j])


@pytest.mark.parametrize("solver", ["superlu", None])
@pytest.mark.parametrize(
    ("viscous", "structural"),
    [
        (None, None),
        (0.02 * STIFF, None),
        (None, 0.04 * STIFF),
        (0.1 * MASS, 0.3 * MASS),
    ],
)
def test_direct_response_solves_the_complex_equation(solver, viscous, structural):
    def own(matrix):
        return None if matrix is None else sp.csr_matrix(matrix)

    matrices = HarmonicMatrices(
        stiffness=sp.csr_matrix(STIFF),
        mass=sp.csr_matrix(MASS),
        viscous=own(viscous),
        structural=own(structural),
    )
    found = direct_response(matrices, HERTZ, lambda k: (k + 1) * LOAD, solver=solver)
    for k, hertz in enumerate(HERTZ):
        omega = 2.0 * np.pi * hertz
        dynamic = STIFF - omega**2 * MASS + 0.0j
        dynamic += 0.0 if viscous is None else 1j * omega * viscous
        dynamic += 0.0 if structural is None else 1j * structural
        assert found[k] == pytest.approx(
            np.linalg.solve(dynamic, (k + 1) * LOAD), rel=1e-10
        )


@pytest.mark.parametrize("hysteretic", [False, True])
def test_all_modes_give_the_direct_response(hysteretic):
    k, m = sp.csr_matrix(STIFF), sp.csr_matrix(MASS)
    modes = normal_modes(k, m, count=3)
    # Damping of a shape that modes diagonalise: 2 zeta of each is g, or b omega.
    coefficient = 0.06
    matrices = HarmonicMatrices(
        stiffness=k,
        mass=m,
        viscous=None if hysteretic else coefficient * k,
        structural=coefficient * k if hysteretic else None,
    )
    direct = direct_response(matrices, HERTZ, lambda i: LOAD)
    omega = 2.0 * np.pi * modes.frequency_hz
    ratio = np.full(3, 0.5 * coefficient) if hysteretic else 0.5 * coefficient * omega
    load = np.repeat((modes.shape.T @ LOAD)[:, None], len(HERTZ), axis=1)
    bare = HarmonicMatrices(stiffness=k, mass=m)
    amplitude = modal_response(
        modes, bare, HERTZ, load, ratio=ratio, hysteretic=hysteretic
    )
    assert amplitude @ modes.shape.T == pytest.approx(direct, rel=1e-9)
    projected = modal_response(modes, matrices, HERTZ, load)
    assert projected @ modes.shape.T == pytest.approx(direct, rel=1e-9)


def test_effective_masses_add_up_to_the_rigid_mass():
    k, m = sp.csr_matrix(STIFF), sp.csr_matrix(MASS)
    shapes = normal_modes(k, m, count=3).shape * [1.0, 3.0, -0.2]
    motions = np.array([[1.0, 0.0], [1.0, 1.0], [1.0, -2.0]])
    found = participation(m, shapes, motions)
    assert found.rigid == pytest.approx(motions.T @ MASS @ motions)
    assert found.effective.sum(axis=0) == pytest.approx(np.diag(found.rigid))
    assert shapes @ found.factor == pytest.approx(motions)


def test_an_undamped_mode_is_not_driven_at_its_own_frequency():
    """Whatever rounding leaves of its stiffness."""
    k, m = sp.csr_matrix(STIFF), sp.csr_matrix(MASS)
    modes = normal_modes(k, m, count=3)
    own = modes.frequency_hz * (1.0 + np.array([0.0, 1e-15, -3e-13]))
    bare = HarmonicMatrices(stiffness=k, mass=m)
    load = (modes.shape.T @ LOAD)[:, None]
    for hertz in own:
        with pytest.raises(np.linalg.LinAlgError):
            modal_response(modes, bare, np.array([hertz]), load)
        damped = modal_response(
            modes, bare, np.array([hertz]), load, ratio=np.full(3, 1e-6)
        )
        assert np.isfinite(damped).all()
