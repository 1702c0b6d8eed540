"""Cross-sections against closed forms and against areas of the guide."""

import math
from itertools import pairwise

import numpy as np
import pytest
from pyNastran.bdf.cards.properties.bars import PBARL

from benchmarks.verification.runner import run
from fem.cross_sections.analysis import analyse
from fem.cross_sections.library import _divide, analysed, section
from fem.cross_sections.shapes import DIMENSIONS
from fem.cross_sections.shear_factors import ROUND, SOURCES, library_values

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


# Entries PBAR and PBEAM that Nastran prints for PBARL and PBEAML: j, k1, k2.
PRINTED = [
    ("ROD", (1.0,), (1.5708, 0.9, 0.9), "NX 2019.2"),
    ("TUBE", (0.2, 0.195), (2.4206e-4, 0.5, 0.5), "MSC 2005"),
    ("TUBE", (0.6, 0.598), (2.7008e-3, 0.5, 0.5), "MSC 2005"),
    ("BOX", (0.6, 0.2, 0.0025, 0.0025), (8.7582e-5, 0.24528, 0.74843), "MSC 2005"),
    ("BOX", (0.05, 0.5, 0.001, 0.001), (2.1819e-6, 0.90876, 0.087591), "MSC 2005"),
    ("BOX", (0.5, 0.05, 0.001, 0.001), (2.1819e-6, 0.087591, 0.90876), "MSC 2005"),
    ("BOX", (6.0, 1.0, 0.1, 0.1), (0.8292971, 0.1176471, 0.8529412), "NX 8.5"),
    ("BOX", (6.0, 1.0, 0.05, 0.05), (0.46305, 0.13043, 0.85507), "NX 8.5"),
]


@pytest.mark.parametrize(("kind", "dims", "printed", "program"), PRINTED)
def test_constants_are_those_that_nastran_prints(kind, dims, printed, program):
    c = section(kind, dims).constants
    assert (c.j, c.k1, c.k2) == pytest.approx(printed, rel=5e-5)


def test_a_cantilever_of_round_section_bends_and_shears():
    """Euler's deflection and that of the shear with 0.9 of the area."""
    deck = (
        "SOL 101\nCEND\nSPC=1\nLOAD=2\nDISP=ALL\nBEGIN BULK\n"
        "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nCBAR,9,4,1,2,0.,1.,0.\n"
        "PBARL,4,5,,ROD\n,.5\nMAT1,5,1.0+7,,.25\n"
        "SPC1,1,123456,1\nFORCE,2,2,,100.,0.,1.,0.\nENDDATA\n"
    )
    area, inertia, e = math.pi / 4, math.pi / 64, 1e7
    expected = 100 * 8 / (3 * e * inertia) + 100 * 2 / (0.9 * area * e / 2.5)
    tip = run(deck)["static/1/displacement"][1, 1]
    assert tip == pytest.approx(expected, rel=1e-12)


def test_shapes_that_are_one_section_have_one_set_of_constants():
    """A box by four or six dimensions; a channel by inner or outer height, turned."""
    box = library_values("BOX", (3.0, 2.0, 0.1, 0.2), 1.0)
    assert library_values("BOX1", (3.0, 2.0, 0.1, 0.1, 0.2, 0.2), 1.0) == box
    chan = section("CHAN", (0.1, 0.2, 0.006, 0.01)).constants
    same = section("CHAN1", (0.094, 0.006, 0.18, 0.2)).constants
    turned = section("CHAN2", (0.01, 0.006, 0.1, 0.2)).constants
    assert (same.k1, same.k2, same.j) == pytest.approx((chan.k1, chan.k2, chan.j))
    assert (turned.k1, turned.k2, turned.j) == pytest.approx((chan.k2, chan.k1, chan.j))


@pytest.mark.parametrize("kind", [k for k in SOURCES if k not in ROUND])
def test_library_and_finite_elements_agree_on_the_torsion_of_thin_walls(kind):
    """Only the corners of the walls differ, of the order of thickness over length."""
    thin = {
        "BAR": (0.1, 0.2),
        "BOX": (0.2, 0.3, 0.002, 0.002),
        "BOX1": (0.2, 0.3, 0.002, 0.002, 0.002, 0.002),
        "L": (0.1, 0.1, 0.001, 0.001),
        "CHAN": (0.1, 0.2, 0.002, 0.002),
        "CHAN1": (0.1, 0.002, 0.196, 0.2),
        "CHAN2": (0.002, 0.002, 0.1, 0.2),
    }[kind]
    assert section(kind, thin).constants.j == pytest.approx(
        analysed(kind, thin).constants.j, rel=0.012
    )


def test_shear_center_of_a_thin_channel():
    b, h, t = 0.1, 0.2, 0.001
    c = section("CHAN", (b + t / 2, h + t, t, t)).constants
    # From the middle of the web, away from the flanges: 3 b^2 / (6 b + h).
    e = 3 * b**2 / (6 * b + h)
    from_web = c.centroid[1] + c.shear_center[1] - t / 2
    assert from_web == pytest.approx(-e, rel=5e-3)
    assert c.shear_center[0] == 0.0


def test_shear_center_of_a_tee_and_an_angle_is_where_the_walls_meet():
    tee = section("T", (0.1, 0.1, 0.002, 0.002)).constants
    assert tee.centroid[0] + tee.shear_center[0] == pytest.approx(0.099, abs=2e-4)
    angle = section("L", (0.1, 0.1, 0.002, 0.002)).constants
    corner = angle.centroid + angle.shear_center
    np.testing.assert_allclose(corner, [0.001, 0.001], atol=2e-4)


def test_finite_elements_give_a_round_bar_six_sevenths():
    """The exact factor without Poisson's ratio, which MSC's finite elements have too.

    MSC's cantilever of radius 0.3 in `bar_grid_point_forces` of pyNastran's models
    shears with 0.857 of the area: 1.684e-5 of shear at the tip.
    """
    n = 24
    angle = np.linspace(-np.pi / 4, np.pi / 4, n + 1)
    # A square in the middle of a disc, and four sectors round it.
    quads = [np.array([[-0.4, -0.4], [0.4, -0.4], [0.4, 0.4], [-0.4, 0.4]])]
    inner = np.stack([np.full(n + 1, 0.4), 0.4 * np.linspace(-1, 1, n + 1)], axis=1)
    square = _divide(quads[0], n, n)
    outer = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    rings = [inner + s * (outer - inner) for s in np.linspace(0, 1, n + 1)]
    cells = [
        np.stack([a[:-1], b[:-1], b[1:], a[1:]], axis=1) for a, b in pairwise(rings)
    ]
    sector = np.concatenate(cells)
    turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    parts = [square]
    for _ in range(4):
        parts.append(sector)
        sector = sector @ turn
    c = analyse(np.concatenate(parts))
    assert c.area == pytest.approx(np.pi, rel=1e-3)
    assert (c.k1, c.k2) == pytest.approx((6 / 7, 6 / 7), rel=2e-3)


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
