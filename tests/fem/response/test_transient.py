"""Direct transient: literal formula, closed forms, order, energy, blocks, observers."""

import threading
import time as clock

import numpy as np
import pytest
import scipy.sparse as sp

from fem.algebra.damping import Damping
from fem.algebra.linear_solver import SingularMatrixError, pardiso_is_available
from fem.response.direct import (
    GeneralizedAlpha,
    NastranScheme,
    TransientLoad,
    direct_transient,
    sampled_load,
)
from fem.response.observation import Observation
from fem.response.time_grid import step_groups

QUANTITIES = ("displacement", "velocity", "acceleration")
SCHEMES = [NastranScheme(), GeneralizedAlpha(0.8), GeneralizedAlpha(1.0)]


def random_system(n=10, seed=0):
    """K, M (with offsets of masses), B', load patterns."""
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(n, n))
    mass = sp.lil_matrix(sp.diags(rng.uniform(1.0, 2.0, n)))
    mass[3, 4] = mass[4, 3] = 0.2
    damper = sp.random(n, n, 0.1, random_state=seed)
    pattern = rng.normal(size=(n, 2)) * (rng.random((n, 1)) < 0.5)
    return (
        sp.csr_matrix(100.0 * root @ root.T),
        sp.csr_matrix(mass),
        sp.csr_matrix(damper @ damper.T),
        sp.csr_matrix(pattern),
    )


def wave(time):
    return np.stack([np.sin(3 * time) + 1, time**2])


def respond(*matrices, **keywords):
    """Histories (t, n) of u, v, a."""
    observers = [Observation(quantity) for quantity in QUANTITIES]
    run = direct_transient(*matrices, observers=observers, **keywords)
    return run, [observer.history for observer in observers]


def literal_nastran(stiffness, mass, damping, steps, load, u0, v0):
    """The formula as it is written in the theory, with dense matrices."""
    k, m, b = stiffness.toarray(), mass.toarray(), damping.toarray()
    kept = {quantity: [] for quantity in QUANTITIES}
    past, old = None, None
    for group in step_groups(steps):
        h = group.step
        a1 = m / h**2 + b / (2 * h) + k / 3
        a2 = 2 * m / h**2 - k / 3
        a3 = -m / h**2 + b / (2 * h) - k / 3
        if past is None:
            u, before = u0, u0 - v0 * h
            p_before, p = k @ before + b @ v0, k @ u0 + b @ v0
        else:
            u, v = past[2], (past[2] - past[1]) / old
            a = (past[2] - 2 * past[1] + past[0]) / old**2
            before = u - h * v + h * h / 2 * a
            p_before, p = m @ a + b @ (v - h * a) + k @ before, load(group.start)
        history = [before, u]
        for n in range(group.count + group.last):
            p_next = load(group.time(n + 1))
            right = (p_next + p + p_before) / 3 + a2 @ history[-1] + a3 @ history[-2]
            history.append(np.linalg.solve(a1, right))
            p_before, p = p, p_next
        for n in group.outputs:
            behind, here, ahead = history[n : n + 3]
            given = n == 0 and past is None
            kept["displacement"].append(here)
            kept["velocity"].append(v0 if given else (ahead - behind) / (2 * h))
            kept["acceleration"].append((ahead - 2 * here + behind) / h**2)
        past, old = history[-3:], h
    return [np.array(kept[quantity]) for quantity in QUANTITIES]


@pytest.mark.parametrize("solver", ["superlu", None])
@pytest.mark.parametrize(
    "steps",
    [
        [(100, 0.01, 1)],
        [(70, 0.01, 3), (50, 0.02, 7), (3, 0.004, 1)],
        [(1, 0.1), (1, 0.2), (40, 0.05)],
    ],
)
@pytest.mark.parametrize(
    ("stiff", "heavy", "damper"),
    [(0.0, 0.0, 0), (0.02, 0.0, 0), (0.0, 0.0, 1), (0.01, 0.3, 1)],
)
def test_nastran_scheme_equals_its_formula(solver, steps, stiff, heavy, damper):
    k, m, b, pattern = random_system()
    damping = Damping(
        stiffness_factor=stiff, mass_factor=heavy, other=b if damper else None
    )
    rng = np.random.default_rng(1)
    u0, v0 = 0.1 * rng.normal(size=(2, 10))

    def load(time):
        return pattern @ wave(np.array([time]))[:, 0]

    expected = literal_nastran(k, m, damping.matrix(k, m), steps, load, u0, v0)
    _, found = respond(
        k,
        m,
        damping,
        steps=steps,
        load=TransientLoad(pattern, wave),
        u0=u0,
        v0=v0,
        solver=solver,
    )
    for ours, theirs in zip(found, expected):
        np.testing.assert_allclose(ours, theirs, atol=1e-9 * np.abs(theirs).max())


def test_step_response_of_one_mass_is_the_discrete_closed_form():
    """u'' + ω² u = ω² from rest: 1 + A cos nθ + B sin nθ with Newmark's θ (β = 1/3)."""
    omega, h = 7.0, 0.05
    one = sp.csr_matrix([[1.0]])
    load = TransientLoad(one, lambda t: np.full((1, len(t)), omega**2))
    _, (u, _, _) = respond(omega**2 * one, one, steps=[(200, h)], load=load)
    ratio = (omega * h) ** 2
    theta = np.arccos((1 - ratio / 6) / (1 + ratio / 3))
    # After two steps the load is steady: u = 1 + A cos nθ + B sin nθ through u1, u2.
    n = np.arange(201)
    basis = np.stack([np.cos(n * theta), np.sin(n * theta)], axis=1)
    amplitudes = np.linalg.solve(basis[1:3], u[1:3, 0] - 1)
    np.testing.assert_allclose(u[1:, 0], 1 + basis[1:] @ amplitudes, atol=1e-11)
    first = (ratio / 3) / (1 + ratio / 3)
    assert u[1, 0] == pytest.approx(first, rel=1e-12)


def exact_damped(omega, zeta, time):
    """u, v, a of u'' + 2ζω u' + ω² u = ω² (1 - cos 2t)/2 from rest."""
    drive = 2.0
    forced = omega**2 / (omega**2 - drive**2 + 2j * zeta * omega * drive)

    def particular(t):
        e = forced * np.exp(1j * drive * t)
        return (
            0.5 - 0.5 * e.real,
            -0.5 * (1j * drive * e).real,
            0.5 * drive**2 * e.real,
        )

    s = omega * (-zeta + 1j * np.sqrt(1 - zeta**2))
    u_start, v_start, _ = particular(np.zeros(1))
    # Homogeneous part Re(c e^{st}) with c from the initial values.
    c_real = -u_start[0]
    c = c_real + 1j * ((-v_start[0] - s.real * c_real) / -s.imag)
    e = c * np.exp(s * time)
    parts = particular(time)
    return [parts[0] + e.real, parts[1] + (s * e).real, parts[2] + (s * s * e).real]


@pytest.mark.parametrize("scheme", SCHEMES, ids=repr)
def test_both_schemes_converge_with_order_two(scheme):
    omega, zeta = 9.0, 0.05
    one = sp.csr_matrix([[1.0]])
    load = TransientLoad(one, lambda t: omega**2 * np.sin(t)[None] ** 2)
    errors = []
    for count in (200, 400):
        run, histories = respond(
            omega**2 * one,
            one,
            2 * zeta * omega * one,
            steps=[(count, 2.0 / count)],
            load=load,
            scheme=scheme,
        )
        exact = exact_damped(omega, zeta, run.time)
        # Nastran's start replaces the loads of t <= 0; here they are zero anyway.
        errors.append(
            [
                np.abs(h[2:, 0] - e[2:]).max() / np.abs(e).max()
                for h, e in zip(histories, exact)
            ]
        )
    orders = np.log2(np.array(errors[0]) / np.array(errors[1]))
    assert np.all(np.array(errors[1]) < 5e-3)
    np.testing.assert_allclose(orders, 2.0, atol=0.15)


def test_nastran_scheme_keeps_its_discrete_energy():
    """Newmark β = 1/3, γ = 1/2 conserves ½ Δ'(M + h²K/12)Δ + ½ ū'Kū without damping."""
    k, m, _, _ = random_system()
    rng = np.random.default_rng(2)
    h = 0.05
    _, (u, _, _) = respond(
        k, m, steps=[(500, h)], u0=rng.normal(size=10), v0=rng.normal(size=10)
    )
    delta = np.diff(u, axis=0)[2:] / h
    middle = 0.5 * (u[1:] + u[:-1])[2:]
    modified = m + h * h / 12 * k
    energy = 0.5 * np.einsum("ti,ti->t", delta, (modified @ delta.T).T)
    energy += 0.5 * np.einsum("ti,ti->t", middle, (k @ middle.T).T)
    np.testing.assert_allclose(energy, energy[0], rtol=1e-10)


def test_generalised_alpha_damps_high_frequencies_as_chosen():
    """At ωh -> infinity the amplitude shrinks by rho_inf per step."""
    one = sp.csr_matrix([[1.0]])
    for rho in (0.5, 0.9):
        _, (u, _, _) = respond(
            1e12 * one,
            one,
            steps=[(60, 1.0)],
            u0=np.ones(1),
            scheme=GeneralizedAlpha(rho),
        )
        # The first steps: later the multiple root shows, a power of n times rho^n.
        np.testing.assert_allclose(u[:4, 0], (-rho) ** np.arange(4), rtol=0.03)


@pytest.mark.parametrize("scheme", SCHEMES, ids=repr)
def test_free_body_gains_the_impulse(scheme):
    """Two masses on a spring, free: total momentum is the integral of the force."""
    k = sp.csr_matrix(1e4 * np.array([[1.0, -1.0], [-1.0, 1.0]]))
    m = sp.csr_matrix(np.diag([2.0, 3.0]))
    load = sampled_load(
        np.array([[1.0], [0.0]]), np.array([0.0, 0.1, 0.3]), np.array([[0.0, 5.0, 0.0]])
    )
    _, (_, v, _) = respond(k, m, steps=[(500, 1e-3)], load=load, scheme=scheme)
    momentum = v @ np.array([2.0, 3.0])
    assert momentum[-1] == pytest.approx(0.75, rel=1e-9)


@pytest.mark.parametrize("scheme", SCHEMES, ids=repr)
def test_block_of_load_cases_equals_single_cases(scheme):
    k, m, b, pattern = random_system()
    scales = np.array([1.0, -2.0, 0.3, 0.0, 7.0])
    v0 = np.random.default_rng(4).normal(size=(5, 10))
    block = TransientLoad(pattern, lambda t: scales[:, None, None] * wave(t))
    steps = [(90, 0.01, 4), (30, 0.02, 1)]
    _, together = respond(k, m, b, steps=steps, load=block, v0=v0, scheme=scheme)
    for case, scale in enumerate(scales):
        single = TransientLoad(pattern, lambda t, s=scale: s * wave(t))
        _, alone = respond(
            k, m, b, steps=steps, load=single, v0=v0[case], scheme=scheme
        )
        for many, one in zip(together, alone):
            np.testing.assert_allclose(
                many[:, case], one, atol=1e-10 * np.abs(many).max()
            )


@pytest.mark.skipif(not pardiso_is_available(), reason="MKL is absent")
@pytest.mark.parametrize("scheme", SCHEMES, ids=repr)
def test_both_solvers_agree(scheme):
    k, m, b, pattern = random_system()
    results = [
        respond(
            k,
            m,
            b,
            steps=[(200, 0.01)],
            load=TransientLoad(pattern, wave),
            scheme=scheme,
            solver=solver,
        )[1]
        for solver in ("pardiso", "superlu")
    ]
    for one, other in zip(*results):
        np.testing.assert_allclose(one, other, atol=1e-10 * np.abs(one).max())


@pytest.mark.parametrize("scheme", SCHEMES, ids=repr)
def test_observers_of_rows_see_the_rows_of_the_whole(scheme):
    k, m, b, pattern = random_system()
    dense = np.random.default_rng(5).normal(size=(3, 10))
    dense[0] = 2.0 * (np.arange(10) == 7)
    operator = sp.csr_matrix(dense)
    parts = [Observation(quantity, operator) for quantity in QUANTITIES]
    sparse = [Observation(quantity, operator[:1]) for quantity in QUANTITIES]
    whole = [Observation(quantity) for quantity in QUANTITIES]
    direct_transient(
        k,
        m,
        b,
        steps=[(130, 0.01, 3), (40, 0.02, 9)],
        load=TransientLoad(pattern, wave),
        v0=np.ones(10),
        observers=[*parts, *whole, *sparse],
        scheme=scheme,
    )
    for part, full, row in zip(parts, whole, sparse):
        expected = full.history @ operator.toarray().T
        np.testing.assert_allclose(part.history, expected, atol=1e-10)
        np.testing.assert_allclose(row.history, expected[:, :1], atol=1e-10)


def test_damping_matrix_that_is_a_multiple_of_stiffness_is_recognised():
    k, m, b, _ = random_system()
    found = Damping.from_matrix(0.03 * k, k)
    assert found.other is None
    assert found.stiffness_factor == pytest.approx(0.03, rel=1e-12)
    mixed = Damping.from_matrix(0.03 * k + b, k)
    np.testing.assert_allclose(
        mixed.matrix(k, m).toarray(), (0.03 * k + b).toarray(), rtol=1e-12
    )


def test_progress_and_memory_are_told():
    k, m, _, _ = random_system()
    seen, lines = [], []
    run = direct_transient(
        k,
        m,
        steps=[(5, 0.1), (3, 0.2)],
        progress=lambda done, total: seen.append((done, total)),
        inform=lines.append,
    )
    assert seen[-1] == (8, 8)
    assert run.steps == 8
    assert run.nnz_factor > 0
    assert "8 steps, 10 freedoms" in lines[0]


def test_bad_arguments_are_named():
    k, m, _, pattern = random_system()
    with pytest.raises(ValueError, match="stride"):
        direct_transient(k, m, steps=[(5, -0.1)])
    with pytest.raises(ValueError, match="no time steps"):
        direct_transient(k, m, steps=[])
    with pytest.raises(ValueError, match="u0"):
        direct_transient(k, m, steps=[(5, 0.1)], u0=np.zeros(3))
    with pytest.raises(ValueError, match="NaN"):
        direct_transient(
            k,
            m,
            steps=[(5, 0.1)],
            load=TransientLoad(pattern, lambda t: np.full((2, len(t)), np.nan)),
        )
    with pytest.raises(ValueError, match="rho_inf"):
        GeneralizedAlpha(1.5)
    with pytest.raises(SingularMatrixError):
        direct_transient(
            sp.csr_matrix((2, 2)), sp.csr_matrix(np.diag([1.0, 0.0])), steps=[(5, 0.1)]
        )


class _Slow:
    """Takes a while over each chunk, then keeps what the chunk holds by then."""

    def begin(self, time, cases, size):
        self.thread, self.kept = set(), np.zeros((len(time), cases, size))

    def observe(self, chunk):
        self.thread.add(threading.get_ident())
        clock.sleep(0.002)
        rows = slice(chunk.first, chunk.first + len(chunk.time))
        self.kept[rows] = chunk.get("displacement")

    def memory_bytes(self, times, cases, size):
        return 8 * times * cases * size


@pytest.mark.parametrize("scheme", SCHEMES[:2])
def test_chunks_stand_still_while_they_are_observed(monkeypatch, scheme):
    """Steps go on beside a slow observer, in other memory."""
    monkeypatch.setattr(f"{type(scheme).__module__}.window_length", lambda *_: 4)
    stiffness, mass, _, pattern = random_system()
    slow, quick = _Slow(), Observation("displacement")
    for observer in (quick, slow):
        direct_transient(
            stiffness,
            mass,
            steps=[(37, 1e-2), (10, 2e-2, 3)],
            load=TransientLoad(pattern, wave),
            observers=[observer],
            scheme=scheme,
        )
    assert (slow.kept == quick.values).all()
    assert slow.thread == slow.thread - {threading.get_ident()}


class _Failing(_Slow):
    def observe(self, chunk):
        raise ArithmeticError("of the observer")


@pytest.mark.parametrize("steps", [3, 200])
def test_errors_of_observers_are_raised(steps):
    stiffness, mass, _, pattern = random_system()
    with pytest.raises(ArithmeticError, match="of the observer"):
        direct_transient(
            stiffness,
            mass,
            steps=[(steps, 1e-2)],
            load=TransientLoad(pattern, wave),
            observers=[_Failing()],
        )
