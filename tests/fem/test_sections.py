"""Cross-sections against closed forms and against areas of the guide."""

import math

import numpy as np
import pytest
from pyNastran.bdf.cards.properties.bars import PBARL

from fem.cross_sections.library import DIMENSIONS, section

EXAMPLES: dict[str, tuple[float, ...]] = {
    "ROD": (0.1,),
    "TUBE": (0.1, 0.08),
    "TUBE2": (0.1, 0.02),
    "BAR": (0.1, 0.2),
    "BOX": (0.2, 0.3, 0.01, 0.02),
    "BOX1": (0.2, 0.3, 0.01, 0.015, 0.02, 0.01),
    "I": (0.2, 0.1, 0.08, 0.006, 0.01, 0.012),
    "I1": (0.1, 0.01, 0.18, 0.2),
    "T": (0.1, 0.12, 0.01, 0.008),
    "T1": (0.1, 0.12, 0.01, 0.008),
    "T2": (0.1, 0.12, 0.01, 0.008),
    "L": (0.1, 0.12, 0.005, 0.006),
    "CHAN": (0.1, 0.2, 0.006, 0.01),
    "CHAN1": (0.1, 0.01, 0.18, 0.2),
    "CHAN2": (0.01, 0.012, 0.1, 0.2),
    "CROSS": (0.1, 0.01, 0.12, 0.008),
    "H": (0.1, 0.02, 0.12, 0.01),
    "Z": (0.1, 0.01, 0.18, 0.2),
    "HEXA": (0.25, 1.0, math.sqrt(3) / 2),
    "HAT": (0.1, 0.01, 0.1, 0.03),
    "HAT1": (0.16, 0.11, 0.1, 0.01, 0.012),
    "DBOX": (0.3, 0.2, 0.1, 0.01, 0.011, 0.012, 0.013, 0.014, 0.015, 0.016),
}


@pytest.mark.parametrize("kind", DIMENSIONS)
def test_area_agrees_with_the_guide(kind):
    dims = EXAMPLES[kind]
    theirs = PBARL(1, 1, kind, list(dims)).Area()
    assert section(kind, dims).constants.area == pytest.approx(theirs, rel=1e-12)


@pytest.mark.parametrize("kind", DIMENSIONS)
def test_constants_scale_with_the_size(kind):
    small = section(kind, EXAMPLES[kind]).constants
    large = section(kind, [3.0 * d for d in EXAMPLES[kind]]).constants
    for name, power in (("area", 2), ("i1", 4), ("i2", 4), ("j", 4), ("k1", 0)):
        expected = getattr(small, name) * 3.0**power
        assert getattr(large, name) == pytest.approx(expected, rel=1e-9)
    assert small.i12**2 < small.i1 * small.i2
    assert 0.0 < small.j < small.i1 + small.i2 + 1e-12
    assert 0.0 < min(small.k1, small.k2) <= max(small.k1, small.k2) < 1.0


def test_rectangle():
    c = section("BAR", (0.1, 0.2)).constants
    assert c.i1 == pytest.approx(0.1 * 0.2**3 / 12)
    assert c.i2 == pytest.approx(0.2 * 0.1**3 / 12)
    # Series of Timoshenko and Goodier, art. 109: 0.22868 b^3 h for h = 2 b.
    assert c.j == pytest.approx(0.228682 * 0.1**3 * 0.2, rel=1e-4)
    assert (c.k1, c.k2) == pytest.approx((5 / 6, 5 / 6), rel=1e-4)


def test_round_sections():
    c = section("TUBE", (0.1, 0.08)).constants
    assert c.j == pytest.approx(math.pi / 2 * (0.1**4 - 0.08**4))
    assert section("TUBE2", (0.1, 0.02)).constants.i1 == pytest.approx(c.i1)
    # Cowper: thin tube with nu 0.3: 2 (1 + nu) / (4 + 3 nu).
    thin = section("TUBE", (0.1, 0.0999)).constants
    assert thin.k1 == pytest.approx(2.6 / 4.9, rel=1e-3)


def test_torsion_of_a_thin_closed_section_is_bredts():
    b, h, t = 0.2, 0.3, 0.002
    c = section("BOX", (b, h, t, t)).constants
    bredt = 4 * ((b - t) * (h - t)) ** 2 * t / (2 * (b - t + h - t))
    # The corners add four tenths of a percent.
    assert c.j == pytest.approx(bredt, rel=6e-3)
    assert c.j > bredt


def test_torsion_of_a_thin_open_section():
    c = section("CHAN", (0.1, 0.2, 0.002, 0.002)).constants
    middle = 2 * (0.1 - 0.001) + 0.2 - 0.002
    assert c.j == pytest.approx(middle * 0.002**3 / 3, rel=1e-2)


def test_shear_centre_of_a_thin_channel():
    b, h, t = 0.1, 0.2, 0.001
    c = section("CHAN", (b + t / 2, h + t, t, t)).constants
    # From the middle of the web, away from the flanges: 3 b^2 / (6 b + h).
    e = 3 * b**2 / (6 * b + h)
    from_web = c.centroid[1] + c.shear_centre[1] - t / 2
    assert from_web == pytest.approx(-e, rel=5e-3)
    assert c.shear_centre[0] == 0.0


def test_shear_centre_of_a_tee_and_an_angle_is_where_the_walls_meet():
    tee = section("T", (0.1, 0.1, 0.002, 0.002)).constants
    assert tee.centroid[0] + tee.shear_centre[0] == pytest.approx(0.099, abs=2e-4)
    angle = section("L", (0.1, 0.1, 0.002, 0.002)).constants
    corner = angle.centroid + angle.shear_centre
    np.testing.assert_allclose(corner, [0.001, 0.001], atol=2e-4)


def test_shear_factor_of_a_web_is_its_share_of_the_area():
    c = section("I", (0.3, 0.1, 0.1, 0.002, 0.002, 0.002)).constants
    assert c.k1 == pytest.approx(0.296 * 0.002 / c.area, rel=0.05)


def test_product_of_inertia_of_a_zee():
    flange, tw, inner, h = EXAMPLES["Z"]
    t = (h - inner) / 2
    expected = -2 * flange * t * (h - t) / 2 * (flange + tw) / 2
    assert section("Z", EXAMPLES["Z"]).constants.i12 == pytest.approx(expected)


@pytest.mark.parametrize(
    ("kind", "dims", "message"),
    [
        ("BOXX", (1.0,), "did you mean 'BOX"),
        ("BOX", (1.0, 1.0, 0.1), "3 dimensions, expected 4"),
        ("BOX", (1.0, 1.0, 0.6, 0.1), "walls thicker"),
        ("TUBE", (1.0, 1.0), "inner radius"),
        ("BAR", (1.0, 0.0), "without thickness"),
        ("HEXA", (0.6, 1.0, 1.0), "DIM2 > 2 DIM1"),
        ("I", (0.2, 0.1, 0.1, 0.01, 0.1, 0.1), "without thickness"),
    ],
)
def test_impossible_sections_are_named(kind, dims, message):
    with pytest.raises(ValueError, match=message):
        section(kind, dims)
