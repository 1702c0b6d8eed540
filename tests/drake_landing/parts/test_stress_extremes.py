"""The compiled extremes of a transient against the stresses instant by instant."""

import numpy as np
import pytest

from drake_landing.parts.stress import stresses
from drake_landing.parts.stress_extremes import Steady, StressExtremes
from drake_landing.parts.stress_observer import StressWatch
from drake_landing.parts.stress_rows import stress_maps
from fem.algebra.extension import Extension
from fem.deck.reader import read_deck
from fem.model.structure import Structure
from fem.response.observation import StateChunk

# Bars, rods, sheets, a laminate and a solid; a grid follows four others (RBE3), a
# further one another (RBE2).
DECK = """\
SOL 101
CEND
SPC = 1
BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,.1
GRID,4,,0.,1.,0.
GRID,5,,2.,0.,.2
GRID,6,,2.,1.,0.
GRID,7,,.5,.5,1.
GRID,8,,0.,0.,-1.
GRID,9,,1.,0.,-1.
GRID,10,,1.,1.,-1.
GRID,11,,0.,1.,-1.
GRID,12,,.5,.5,2.
CONM2,20,12,,3.,.1,.2,.3
CONM2,21,7,,2.,.1
MAT1,1,7.+10,,.3,2700.
MAT8,2,1.+11,1.+10,.3,5.+9,,,1600.
PSHELL,1,1,.01,1,,1
PCOMP,2
,2,.001,0.,YES,2,.001,90.,YES
PCOMP,3
,1,.001,0.,YES,2,.001,45.,YES
PBAR,3,1,1.-3,1.-6,2.-6,3.-6
,.02,.03,-.02,.03,-.02,-.03,.02,-.03
PROD,4,1,1.-3
PSOLID,5,1
CQUAD4,1,1,1,2,3,4
CQUAD4,2,2,2,5,6,3
CTRIA3,3,3,2,5,3
CTRIA3,4,1,1,2,7
CBAR,5,3,1,2,0.,0.,1.
CBAR,6,3,7,12,1.,0.,0.
CROD,7,4,3,7
CHEXA,8,5,8,9,10,11,1,2
,3,4
RBE3,9,,7,123456,1.,123,1,2
,3,4
RBE2,10,7,123456,12
SPC1,1,12,8
ENDDATA
"""


@pytest.fixture(scope="module")
def structure(tmp_path_factory: pytest.TempPathFactory) -> Structure:
    path = tmp_path_factory.mktemp("deck") / "deck.bdf"
    path.write_text(DECK)
    return Structure.from_deck(read_deck(path))


def _chunks(window: np.ndarray, lengths: tuple[int, ...]) -> list[StateChunk]:
    found, first = [], 0
    for length in lengths:
        part = window[first : first + length]
        time = 0.1 * np.arange(first, first + length)
        found.append(StateChunk(first, time, {"displacement": part}))
        first += length
    return found


def _expected(structure: Structure, window: np.ndarray) -> np.ndarray:
    """(t, c, e, 3)."""
    t, c, f = window.shape
    found = stresses(structure).of(window.reshape(t * c, f).T)
    return found.reshape(t, c, *found.shape[1:])


@pytest.mark.parametrize("cases", [1, 3, 40])
@pytest.mark.parametrize("mode", ["plain", "all", "apart"])
def test_extremes_are_those_of_every_instant(
    structure: Structure, cases: int, mode: str
) -> None:
    lengths = (17, 1, 5)
    rng = np.random.default_rng(cases)
    window = 1e-3 * rng.standard_normal((sum(lengths), cases, structure.size))
    about = 1e-3 * rng.standard_normal(structure.size)
    maps = stress_maps(stresses(structure))
    assert {rows.kind for rows in maps.rows} >= {"sheet", "line"}
    given = window if mode == "plain" else window + about
    if mode == "apart":
        given = np.concatenate([window, window[:, :1] + about], axis=1)
    steady = (
        None
        if mode == "plain"
        else Steady(stress=maps.of(about), apart=mode == "apart")
    )
    watch = StressExtremes(maps.rows, maps.maps(), maps.extension, steady)
    watch.begin(0.1 * np.arange(sum(lengths)), cases, structure.size)
    for chunk in _chunks(window, lengths):
        watch.observe(chunk)
    expected, state = _expected(structure, given), watch.state
    scale = expected[..., 0].max()
    assert np.abs(state.equivalent.T - expected[..., 0].max(0)).max() < 1e-10 * scale
    strained = expected[..., 0].max(0) > 1e-6 * scale  # one bar is part of a rigid body
    assert strained.sum() >= 7 * cases
    same = expected[..., 0].argmax(0) == state.when.T
    assert same[strained].all()
    assert np.abs(state.high.T - expected[..., 1].max(0).clip(0)).max() < 1e-10 * scale
    assert np.abs(state.low.T - expected[..., 2].min(0).clip(None, 0)).max() < (
        1e-10 * scale
    )


@pytest.mark.parametrize("apart", [False, True])
def test_each_load_case_ends_at_its_own_time(structure: Structure, apart: bool) -> None:
    rng = np.random.default_rng(0)
    window = 1e-3 * rng.standard_normal((12, 3, structure.size))
    window[6:] *= 10.0  # what must not be seen
    maps, ends = stress_maps(stresses(structure)), (0.55, 2.0, 0.55)
    about = Steady(stress=maps.of(np.zeros(structure.size)), apart=apart)
    watch = StressExtremes(maps.rows, maps.maps(), maps.extension, about, until=ends)
    watch.begin(0.1 * np.arange(12), 3, structure.size)
    for chunk in _chunks(window, (5, 7)):
        watch.observe(chunk)
    every = _expected(structure, window)[..., 0]
    wanted = [every[:6, 0].max(0), every[:, 1].max(0), every[:6, 2].max(0)]
    wanted += wanted[:1] * apart
    off = np.abs(watch.state.equivalent.T - np.array(wanted)).max()
    assert off < 1e-10 * every.max()


def test_elements_at_a_constraint_hang_on_their_own_grids(structure: Structure) -> None:
    """The bar on the RBE3's grid has twelve freedoms, not those of four grids."""
    found = Extension.from_expansion(structure.elimination.T)
    assert found.dependent.shape[0] == 12
    maps = stress_maps(stresses(structure))
    assert max(int(np.diff(o.indptr).max()) for o in maps.operators) <= 24
    u = np.random.default_rng(1).standard_normal(structure.size)
    extended = found.extended(u)
    whole = structure.elimination.T @ u
    held = found.place < 0
    assert whole[~held] == pytest.approx(extended[found.place[~held]], rel=1e-14)
    assert not whole[held].any()


def test_mass_by_its_factors_is_the_mass(structure: Structure) -> None:
    """Also where grids depend on others, and where some do not move."""
    u, v = np.random.default_rng(2).standard_normal((2, 3, structure.size))
    out = np.empty_like(u)
    structure.mass_product.of_sum((2.0, u), (-0.5, v), out=out)
    expected = (structure.mass @ (2.0 * u - 0.5 * v).T).T
    assert np.abs(out - expected).max() < 1e-13 * np.abs(expected).max()
    assert structure.mass_product.dot(u) == pytest.approx((structure.mass @ u.T).T)


def test_snapshots_are_the_worst_instants(structure: Structure) -> None:
    every = stresses(structure)
    group = np.arange(len(every.id)) % 2
    about = np.full(structure.size, 1e-4)
    watch = StressWatch(every, group, np.full(len(every.id), np.nan), about)
    rng = np.random.default_rng(3)
    window = 1e-3 * rng.standard_normal((9, 1, structure.size))
    watch.begin(0.1 * np.arange(9), 1, structure.size)
    for chunk in _chunks(window, (4, 5)):
        watch.observe(chunk)
    total = _expected(structure, window + about)[:, 0, :, 0]
    for k in (0, 1):
        own = np.flatnonzero(group == k)
        at, e = np.unravel_index(total[:, own].argmax(), (9, len(own)))
        snapshot = watch.worst[k]
        assert snapshot.element == every.id[own[e]]
        assert snapshot.time == pytest.approx(0.1 * at)
        assert snapshot.displacement == pytest.approx(window[at, 0] + about)
    again = StressWatch(every, group, np.full(len(every.id), np.nan), about)
    again.restore(watch.arrays())
    assert (again.equivalent == watch.equivalent).all()
    assert (again.time == watch.time).all()
