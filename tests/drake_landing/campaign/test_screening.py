"""Extremes from few instants are those of all instants."""

import numpy as np
import pytest
import scipy.sparse as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from drake_landing.campaign.basis import ScreeningBasis
from drake_landing.campaign.screening import screen
from drake_landing.parts.stress_maps import StressPart
from drake_landing.parts.stress_rows import StressRows

_ELEMENTS = 40


def _rows(kind: str, points: int, isotropic: np.ndarray) -> StressRows:
    part = StressPart(
        id=np.arange(_ELEMENTS), operator=sp.csr_matrix((0, 0)), pieces=()
    )
    k = 3 * points if kind == "sheet" else points
    return StressRows(kind=kind, part=part, isotropic=isotropic, per_element=k)


def _measures(rows: StressRows, sigma: np.ndarray) -> tuple[np.ndarray, ...]:
    """(e, t) equivalent, largest and smallest principal stress, the plain way."""
    if rows.kind == "line":
        own = sigma.reshape(_ELEMENTS, rows.points, -1)
        high, low = own.max(axis=1), own.min(axis=1)
        return np.maximum(high, -low), high, low
    x, y, xy = np.moveaxis(sigma.reshape(_ELEMENTS, rows.points, 3, -1), 2, 0)
    radius = np.hypot((x - y) / 2, xy)
    first, second = (x + y) / 2 + radius, (x + y) / 2 - radius
    mises = np.sqrt(first**2 - first * second + second**2)
    largest = np.maximum(np.abs(first), np.abs(second))
    plain = rows.isotropic[:, None, None]
    equivalent = np.where(plain, mises, largest).max(axis=1)
    return equivalent, first.max(axis=1), second.min(axis=1)


@settings(max_examples=30, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    kind=st.sampled_from(["sheet", "line"]),
    points=st.integers(1, 3),
    modes=st.integers(1, 11),
    instants=st.integers(1, 120),
    steady=st.booleans(),
    rough=st.booleans(),
)
def test_no_extreme_is_missed(
    seed: int,
    kind: str,
    points: int,
    modes: int,
    instants: int,
    steady: bool,
    rough: bool,
) -> None:
    """Smooth amplitudes, as landings have, and noise, where bounds are of no use."""
    rng = np.random.default_rng(seed)
    rows = _rows(kind, points, rng.random(_ELEMENTS) < 0.5)
    k = rows.per_element * _ELEMENTS
    q = rng.standard_normal((modes, instants))
    if not rough:
        time = 0.05 * np.arange(instants)
        q = np.sin(np.outer(rng.uniform(0.2, 9.0, modes), time) + 6.0 * q[:, :1])
    stress = rng.standard_normal((k, modes)).astype(np.float32)
    still = rng.standard_normal(k) if steady else np.zeros(k)
    basis = ScreeningBasis(
        node_id=np.zeros(0, np.int64),
        modes=modes,
        shape=np.zeros((0, modes)),
        stress=(stress,),
        sections={},
    )
    found = screen(basis, [rows], q, [still] if steady else None)
    equivalent, high, low = _measures(rows, stress @ q + still[:, None])
    # Single precision of sums of eleven terms.
    near = {"rel": 2e-5, "abs": 2e-5 * equivalent.max()}
    assert found.equivalent == pytest.approx(equivalent.max(axis=1), **near)
    assert found.high == pytest.approx(np.maximum(high.max(axis=1), 0.0), **near)
    assert found.low == pytest.approx(np.minimum(low.min(axis=1), 0.0), **near)
    assert found.when.max() < instants
    at = equivalent[np.arange(_ELEMENTS), found.when]
    assert at == pytest.approx(equivalent.max(axis=1), **near)
