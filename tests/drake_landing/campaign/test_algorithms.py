"""Hulls, covers, exceedance, cycles, designs: what needs no landing."""

from itertools import combinations
from pathlib import Path

import h5py
import numpy as np
import pytest
import scipy.stats
from hypothesis import given, settings
from hypothesis import strategies as st

from drake_landing.campaign import section_envelopes
from drake_landing.campaign.axes import Distribution, quantiles
from drake_landing.campaign.combinations import case_rows
from drake_landing.campaign.confirm import SHARED_WORK, blocks_by_end
from drake_landing.campaign.fatigue import cycles, damage
from drake_landing.campaign.hulls import DIRECTIONS, hull_rows
from drake_landing.campaign.schema import Campaign, Fatigue
from drake_landing.campaign.set_cover import candidates, greedy_cover
from drake_landing.campaign.statistics import exceedance
from drake_landing.campaign.task import PAIRS
from drake_landing.parts.cuts import NAMED


@given(
    ends=st.lists(st.floats(0.1, 5.0), min_size=1, max_size=9),
    most=st.integers(1, 5),
)
@settings(max_examples=60)
def test_blocks_that_end_together_cost_least(ends, most) -> None:
    """All ways to cut are tried: no one is cheaper."""
    ends = sorted(ends)

    def work(blocks):
        return sum(part[-1] * (SHARED_WORK + len(part)) for part in blocks)

    def ways(left):
        if not left:
            yield []
        for size in range(1, min(most, len(left)) + 1):
            for rest in ways(left[size:]):
                yield [left[:size], *rest]

    found = [ends[block] for block in blocks_by_end(ends, most)]
    assert [end for block in found for end in block] == ends
    assert max(map(len, found)) <= most
    assert work(found) == pytest.approx(min(map(work, ways(ends))), rel=1e-12)


def test_hull_of_a_circle_keeps_its_size() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 5000, endpoint=False)
    points = np.column_stack([1e3 * np.cos(angle), 1e6 * np.sin(angle)])
    found = hull_rows(points)
    assert len(found) <= DIRECTIONS
    # 64 directions hold a circle within 1 - cos(pi/64).
    assert np.ptp(points[found], axis=0) == pytest.approx([2e3, 2e6], rel=1.3e-3)


@pytest.mark.parametrize(
    ("points", "rows"),
    [
        (np.zeros((0, 2)), []),
        (np.ones((4, 2)), [0]),
        (np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), [0, 2]),
        (np.array([[0.0, 5.0], [3.0, 5.0], [1.0, 5.0]]), [0, 1]),
        (np.array([[np.nan, 0.0], [1.0, 2.0]]), [1]),
    ],
)
def test_hulls_without_area(points: np.ndarray, rows: list[int]) -> None:
    assert sorted(hull_rows(points).tolist()) == rows


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000))
def test_cover_is_complete_and_near_the_shortest(seed: int) -> None:
    rng = np.random.default_rng(seed)
    stress = rng.random((7, 12))
    largest = stress.max(axis=0)
    found = candidates(enumerate(stress), largest, 0.1)
    cover = greedy_cover(found)
    covered = np.unique(np.concatenate([found[n] for n in cover.case]))
    assert len(covered) == 12
    assert cover.share[-1] == 1.0
    shortest = next(
        k
        for k in range(1, 8)
        for chosen in combinations(range(7), k)
        if len(np.unique(np.concatenate([found.get(n, []) for n in chosen]))) == 12
    )
    assert len(cover.case) <= (1.0 + np.log(12)) * shortest


def test_cover_does_not_depend_on_order() -> None:
    rng = np.random.default_rng(1)
    stress = rng.random((20, 300))
    found = candidates(enumerate(stress), stress.max(axis=0), 0.05)
    other = dict(reversed(list(found.items())))
    assert greedy_cover(found, 0.95) == greedy_cover(other, 0.95)


def test_exceedance_bounds_hold_as_often_as_they_say() -> None:
    rng = np.random.default_rng(2)
    inside = []
    for _ in range(400):
        table = exceedance(rng.random(30), confidence=0.9)
        exact = 1.0 - table.value.iloc[4]  # share of a uniform law above the 5th
        inside.append(table.low.iloc[4] <= exact <= table.high.iloc[4])
    # 90 % of 400 draws, three standard deviations of a binomial count.
    assert np.mean(inside) == pytest.approx(0.9, abs=0.045)


def test_rainflow_of_the_standard() -> None:
    """ASTM E1049-85, figure 6: ranges 3, 4, 6, 8, 9 with 0.5, 1.5, 0.5, 1, 0.5."""
    history = np.array([-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0])
    counted = cycles(history).groupby("range")["count"].sum()
    assert counted.to_dict() == {3.0: 0.5, 4.0: 1.5, 6.0: 0.5, 8.0: 1.0, 9.0: 0.5}
    curve = Fatigue(reference_stress=10.0, slope=2.0, source="test")
    expected = (0.5 * 9 + 1.5 * 16 + 0.5 * 36 + 64 + 0.5 * 81) / 100.0
    assert damage(cycles(history), curve) == pytest.approx(expected)


def test_truncated_distribution_has_the_right_quantiles() -> None:
    axis = Distribution(
        distribution="norm", values={"loc": 1.0, "scale": 2.0}, low=0.0, high=4.0
    )
    share = np.linspace(0.01, 0.99, 9)
    law = scipy.stats.truncnorm(-0.5, 1.5, loc=1.0, scale=2.0)
    assert quantiles(axis, share) == pytest.approx(law.ppf(share), rel=1e-9)


def _campaign(folder: Path, **fields: object) -> Campaign:
    (folder / "case.yaml").write_text("name: x\n")
    data = {"name": "c", "base": "case.yaml", **fields}
    return Campaign.model_validate(data, context={"folder": folder})


def test_design_is_product_times_samples_and_repeats(tmp_path: Path) -> None:
    axes = {
        "scenario.preset": ["a", "b"],
        "scenario.sink_rate": {"from": 1.0, "to": 3.0, "count": 3},
        "scenario.pitch": {"distribution": "uniform", "values": {"scale": 8.0}},
    }
    campaign = _campaign(tmp_path, axes=axes, samples=5, seed=3)
    rows = case_rows(campaign)
    assert len(rows) == 2 * 3 * 5
    assert rows.equals(case_rows(campaign))
    # A latin hypercube has one sample in each fifth of the distribution.
    fifths = (rows["scenario.pitch"].astype(float) // 1.6).to_numpy().reshape(6, 5)
    assert (np.sort(fifths, axis=1) == np.arange(5)).all()


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({}, "axes: found none"),
        ({"axes": {"scenario.pitch": {"distribution": "nrm"}}}, "did you mean 'norm'"),
        (
            {"axes": {"scenario.pitch": {"distribution": "norm"}}},
            "samples: found 0",
        ),
        ({"axes": {"scenario.pitch": [1]}, "samples": 3}, "no axis has a distribution"),
        (
            {
                "axes": {
                    "scenario.pitch": {
                        "distribution": "uniform",
                        "low": 3.0,
                        "high": 4.0,
                    }
                },
                "samples": 1,
            },
            "nothing of the distribution",
        ),
        (
            {
                "axes": {
                    "scenario.sink_rate": {"from": 1.0, "to": 3.0, "count": 3},
                    "scenario.pitch": {"distribution": "norm"},
                },
                "samples": 100_000,
            },
            "3 x 100000 = 300000 cases, expected at most 200000",
        ),
    ],
)
def test_wrong_axes_are_refused(
    fields: dict[str, object], said: str, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match=said):
        _campaign(tmp_path, **fields)


def _landing(file: h5py.File, rng: np.random.Generator) -> h5py.Group:
    """Section loads of a landing, two cuts, as a case file holds them."""
    group = file.create_group(f"landing{len(file)}")
    group["station"] = [1.0, 2.0]
    for name in ("min", "max", "time_of_min", "time_of_max"):
        group[name] = rng.standard_normal((2, len(NAMED)))
    kinds = [(c, p) for c in range(2) for p in range(len(PAIRS))]
    group["hull_of"] = np.repeat(np.array(kinds), 5, axis=0)
    group["hull"] = rng.standard_normal((5 * len(kinds), 3))
    group["min"].attrs["columns"] = " ".join(NAMED)
    group["hull"].attrs["pairs"] = "; ".join("-".join(p) for p in PAIRS)
    return group


def test_section_envelopes_thin_out_without_losing_corners(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Support of the common hull in every direction, and the landings of extremes."""
    monkeypatch.setattr(section_envelopes, "_MOST", 100)
    rng = np.random.default_rng(5)
    with h5py.File("none", "w", driver="core", backing_store=False) as file:
        landings = [_landing(file, rng) for _ in range(40)]
        loads = [section_envelopes.SectionLoads.from_hdf5(group) for group in landings]
        own = section_envelopes.SectionEnvelope.from_loads(loads[0])
        for number, landing in enumerate(loads):
            own.add(landing, number)
        assert sum(map(len, own.corners)) <= 100 + 60
        low = np.array([g["min"][:] for g in landings])
        every = np.array([g["hull"][:] for g in landings]).reshape(40, 6, 5, 3)
    extremes, corners = own.tables("wing")
    assert extremes["min"].to_numpy() == pytest.approx(low.min(axis=0).ravel())
    assert (extremes["case_of_min"] == low.argmin(axis=0).ravel()).all()
    angle = np.linspace(0.0, 2.0 * np.pi, 37)
    directions = np.stack([np.cos(angle), np.sin(angle)])
    assert len(corners.groupby(["station", "pair"])) == 6
    for k, (_, found) in enumerate(corners.groupby(["station", "pair"], sort=False)):
        given = every[:, k, :, 1:].reshape(-1, 2) @ directions
        kept = found[["x", "y"]].to_numpy() @ directions
        assert kept.max(axis=0) == pytest.approx(given.max(axis=0), rel=5e-3)
