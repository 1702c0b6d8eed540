"""The solve for the attachment loads against plain linear algebra."""

import itertools

import numpy as np
from numpy.testing import assert_allclose

from systems.attachment import attachment_solve


def test_solve_positive():
    rng = np.random.default_rng(0)
    root = rng.normal(size=(18, 18))
    A, b = root @ root.T + np.eye(18), rng.normal(size=18)
    found = attachment_solve.solve_positive(A, b)
    assert_allclose(found, np.linalg.solve(A, b), rtol=1e-9)


def test_matrix_that_is_not_positive_definite_gives_nan():
    A = np.diag([1.0, -1.0])
    assert np.isnan(attachment_solve.solve_positive(A, np.ones(2))).any()


def test_response_of_fittings_solves_their_blocks_of_the_mass_matrix():
    rng = np.random.default_rng(1)
    starts = np.array([0, 8, 17])
    mass = np.zeros((17, 17))
    for a, b in itertools.pairwise(starts):
        root = rng.normal(size=(b - a, b - a))
        mass[a:b, a:b] = root @ root.T + np.eye(b - a)
    rows = np.concatenate([np.arange(8, 14), np.arange(6)])  # order of fittings is free
    force = rng.normal(size=17)
    response, free = attachment_solve.fitting_response(mass, force, rows, starts)
    assert_allclose(response, np.linalg.inv(mass)[np.ix_(rows, rows)], atol=1e-10)
    assert_allclose(free, np.linalg.solve(mass, force)[rows], atol=1e-10)
