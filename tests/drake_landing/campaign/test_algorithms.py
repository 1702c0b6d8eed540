"""Hulls, covers, exceedance, cycles, designs: what needs no landing."""

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
import scipy.stats
from hypothesis import given, settings
from hypothesis import strategies as st

from drake_landing.campaign.cover import candidates, greedy_cover
from drake_landing.campaign.design import design, quantiles
from drake_landing.campaign.fatigue import cycles, damage
from drake_landing.campaign.hulls import DIRECTIONS, hull_rows
from drake_landing.campaign.schema import Campaign, Distribution, Fatigue
from drake_landing.campaign.statistics import exceedance


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
    rows = design(campaign)
    assert len(rows) == 2 * 3 * 5
    assert rows.equals(design(campaign))
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
    ],
)
def test_wrong_axes_are_refused(
    fields: dict[str, object], said: str, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match=said):
        _campaign(tmp_path, **fields)
