"""Shell, solid and panel cards: meaning of fields, messages, notices of quality."""

import numpy as np
import pytest

from fem.deck.reader import read_deck
from fem.elements.quality import quality_notices, quality_table
from fem.elements.registry import read_elements
from fem.elements.shells.material_axes import steep_systems
from fem.elements.shells.shell_normals import grid_normals
from fem.errors import InputError
from fem.model.points import read_points

SQUARE = """\
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
MAT1,1,7.+10,,.3,2700.
"""
ORTHO = "MAT8,8,1.4+11,1.+10,.3,5.+9,4.+9,3.+9,1600.\n"


@pytest.fixture
def blocks(tmp_path):
    def read(bulk, head=SQUARE):
        path = tmp_path / "a.bdf"
        path.write_text(f"BEGIN BULK\n{head}{bulk}\nENDDATA\n")
        deck = read_deck(path)
        return read_elements(deck, read_points(deck))

    return read


def stiffness(blocks, bulk, head=SQUARE):
    (block,) = blocks(bulk, head)
    return block.stiffness()[0]


def same(a, b):
    np.testing.assert_allclose(a, b, atol=1e-9 * np.abs(a).max())


def test_pshell_of_one_material_is_a_laminate_of_it(blocks):
    one = stiffness(blocks, "CQUAD4,1,1,1,2,3,4\nPSHELL,1,1,.01,1,,1")
    two = stiffness(blocks, "CQUAD4,1,1,1,2,3,4\nPCOMP,1\n,1,.004,30.,,1,.006")
    np.testing.assert_allclose(one, two, atol=1e-6 * np.abs(one).max())


def test_blank_materials(blocks):
    full = stiffness(blocks, "CQUAD4,1,1,1,2,3,4\nPSHELL,1,1,.01,1,,1")
    membrane = stiffness(blocks, "CQUAD4,1,1,1,2,3,4\nPSHELL,1,1,.01")
    bending = stiffness(blocks, "CQUAD4,1,1,1,2,3,4\nPSHELL,1,,.01,1,,1")
    same(full, membrane + bending)
    rigid = stiffness(blocks, "CQUAD4,1,1,1,2,3,4\nPSHELL,1,,.01,1")
    w = np.zeros(24)
    w[[8, 14]] = 1.0  # transverse shear
    assert w @ rigid @ w > w @ bending @ w > 0.0


def test_bending_ratio_and_shear_ratio(blocks):
    card = "CQUAD4,1,1,1,2,3,4\nPSHELL,1,,.01,1,{},1,{}"
    base = stiffness(blocks, card.format("1.", ".833333"))
    double = stiffness(blocks, card.format("2.", "1.666666"))
    same(2.0 * base, double)


@pytest.mark.parametrize("card", ["CQUAD4,1,1,1,2,3,4", "CTRIA3,1,1,1,2,3"])
def test_theta_and_material_system_mean_the_same(blocks, card):
    pcomp = ORTHO + "PCOMP,1\n,8,.001,0.,,8,.001,90.\n"
    turned = stiffness(blocks, f"{card},30.\n{pcomp}")
    c, s = np.cos(np.radians(30)), np.sin(np.radians(30))
    system = f"CORD2R,7,,0.,0.,0.,0.,0.,1.\n,{c:.7f},{s:.7f},.3\n"
    mcid = stiffness(blocks, f"{card},7\n{pcomp}{system}")
    np.testing.assert_allclose(turned, mcid, atol=1e-5 * np.abs(turned).max())
    other = stiffness(blocks, f"{card},0.\n{pcomp}")
    assert np.abs(other - turned).max() > 1e-2 * np.abs(turned).max()


@pytest.mark.parametrize("card", ["CQUAD4,1,1,1,2,3,4,7", "CTRIA3,1,1,1,2,3,7"])
def test_a_system_just_off_the_normal_is_projected_all_the_same(tmp_path, card):
    """x axis (3e-8, 4e-8, 1): the projection is at the angle of (3, 4)."""
    lamina = ORTHO + "PCOMP,1\n,8,.001,0.,,8,.001,90.,,8,.001,0.\n"
    system = "CORD2R,7,,0.,0.,0.,-4.,3.,0.\n,3.-8,4.-8,1.\n"
    path = tmp_path / "a.bdf"
    path.write_text(f"BEGIN BULK\n{SQUARE}{card}\n{lamina}{system}ENDDATA\n")
    deck = read_deck(path)
    points = read_points(deck)
    (block,) = read_elements(deck, points)
    assert np.tan(block.angle[0] + _of_x(block)) == pytest.approx(4 / 3)
    (said,) = steep_systems(deck, points)
    assert f"{card[:6]} 1: 5.0e-08 rad" in said


def _of_x(block):
    """Angle of the element x axis in the plane of the deck."""
    x, y, _ = block.shape.axes[0, 0]
    return np.arctan2(y, x)


def test_normals_at_grids_are_those_of_corners():
    """Two warped quadrilaterals: edges about a grid, each corner once."""
    xyz = np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0.3],
                    [0, 1, 0.2], [1, 1, 0], [2, 1, 0]], float)  # fmt: skip
    normals = grid_normals(xyz, [np.array([[0, 1, 4, 3], [1, 2, 5, 4]])], 20.0)
    own = np.cross([1, 0, 0], [0, 1, 0.2])
    np.testing.assert_allclose(normals[0], own / np.linalg.norm(own))
    left, right = np.array([0, 0, 1.0]), np.cross([1, 0, 0.3], [0, 1, 0])
    mean = left + right / np.linalg.norm(right)
    np.testing.assert_allclose(normals[1], mean / np.linalg.norm(mean))


def test_a_fold_is_judged_by_corners():
    """Four sheets whose elements are 25 degrees off their mean, their corners 16."""
    y, z = np.cos(np.radians(16)), np.sin(np.radians(16))
    row = np.array([[-1.0, 0, 0], [0, 0, 0], [1.0, 0, 0]])
    outer = [0, y, -z]
    # The far corners hang lower: elements are steeper than their corners at the ridge.
    hang = np.array([[0, 0, -0.3], [0, 0, 0], [0, 0, -0.3]])
    left, right = row + outer + hang, row + outer * np.array([1, -1, 1]) + hang
    xyz = np.concatenate([right, row, left])
    quads = np.array([[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]])
    np.testing.assert_allclose(grid_normals(xyz, [quads], 20.0)[4], [0, 0, 1.0])
    assert not grid_normals(xyz, [quads], 15.0)[4].any()


def test_symmetric_laminate_options(blocks):
    card = "CQUAD4,1,1,1,2,3,4\n" + ORTHO
    whole = stiffness(
        blocks,
        card + "PCOMP,1\n,8,.001,0.,,8,.002,45.\n,8,.002,45.,,8,.001,0.",
    )
    half = stiffness(blocks, card + "PCOMP,1,,,,,,,SYM\n,8,.001,0.,,8,.002,45.")
    same(whole, half)
    membrane = stiffness(blocks, card + "PCOMP,1,,,,,,,MEM\n,8,.001,0.,,8,.002,45.")
    assert not membrane[2].any()


@pytest.mark.parametrize("card", ["CQUAD4,1,1,1,2,3,4", "CTRIA3,1,1,1,2,3"])
def test_membrane_bending_coupling_by_mid4_is_an_offset(blocks, card):
    """G4 = -z0 G1 / T and D = I + z0^2 T: a plate at height z0 above the grids."""
    t, z0 = 0.01, 0.03
    plane = 7e10 / 0.91 * np.array([1.0, 0.3, 1.0, 0.35])
    g4 = -z0 / t * plane
    ratio = 1.0 + 12.0 * (z0 / t) ** 2
    coupled = stiffness(
        blocks,
        f"{card}\nPSHELL,1,1,{t},1,{ratio},1,,\n,,,2\n"
        f"MAT2,2,{g4[0]:.6e},{g4[1]:.6e},0.,{g4[2]:.6e},0.,{g4[3]:.6e}\nPARAM,K6ROT,0.",
    )
    fields = card.split(",")
    count = len(fields) - 3
    zoffs = ",".join([*fields, "0.", str(z0)])
    offset = stiffness(blocks, f"{zoffs}\nPSHELL,1,1,{t},1,,1\nPARAM,K6ROT,0.")
    assert count in (3, 4)
    np.testing.assert_allclose(coupled, offset, atol=1e-4 * np.abs(offset).max())


def test_corner_thickness(blocks):
    base = "CQUAD4,1,1,1,2,3,4,,,{}\nPSHELL,1,1,.01,1,,1"
    plain = stiffness(blocks, "CQUAD4,1,1,1,2,3,4\nPSHELL,1,1,.02,1,,1")
    same(plain, stiffness(blocks, base.format("\n,,,.02,.02,.02,.02")))
    same(plain, stiffness(blocks, base.format("\n,,1,2.,2.,2.,2.")))
    (block,) = blocks(base.format("\n,,,.02,.01,.01,.02"))
    assert block.section.thickness[0] == pytest.approx(0.015)
    assert block.mass(coupled=False)[0, ::6].sum() == pytest.approx(
        0.015 * 2700.0, rel=1e-9
    ) or block.mass(coupled=False)[0].trace() / 3 == pytest.approx(0.015 * 2700.0)


CUBE = """\
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,,0.,0.,1.
GRID,6,,1.,0.,1.
GRID,7,,1.,1.,1.
GRID,8,,0.,1.,1.
MAT1,1,7.+10,,.3,2700.
PSOLID,1,1
"""


def test_solids_are_read(blocks):
    found = blocks(
        "CHEXA,1,1,1,2,3,4,5,6\n,7,8\nCPENTA,2,1,1,2,3,5,6,7\nCTETRA,3,1,1,2,3,5\n"
        "CPYRAM,4,1,1,2,3,4,5",
        CUBE,
    )
    volume = {b.card: b.volume()[0] for b in found}
    assert volume == pytest.approx(
        {"CHEXA": 1.0, "CPENTA": 0.5, "CTETRA": 1 / 6, "CPYRAM": 1 / 3}
    )
    for block in found:
        mass = block.mass(coupled=False)[0]
        assert mass.trace() / 3 == pytest.approx(2700.0 * volume[block.card])


def test_material_system_of_a_solid_turns_mat9(blocks):
    mat9 = (
        "MAT9,9,3.+11,1.+10,1.+10,0.,0.,0.,2.+10\n,1.+10,0.,0.,0.,2.+10,0.,0.\n"
        ",5.+9,0.,0.,5.+9,0.,5.+9\n"
    )
    hexa = "CHEXA,1,2,1,2,3,4,5,6\n,7,8\n" + mat9
    system = "CORD2R,7,,0.,0.,0.,0.,0.,1.\n,0.,1.,0.\n"  # x along basic y
    basic = stiffness(blocks, hexa + "PSOLID,2,9,0", CUBE)
    turned = stiffness(blocks, hexa + system + "PSOLID,2,9,7", CUBE)
    element = stiffness(blocks, hexa + "PSOLID,2,9,-1", CUBE)
    same(basic, element)
    along_x, along_y = np.zeros((8, 3)), np.zeros((8, 3))
    along_x[[1, 2, 5, 6], 0] = 1.0
    along_y[[2, 3, 6, 7], 1] = 1.0
    energy = [
        u.ravel() @ k @ u.ravel() for k, u in ((basic, along_x), (turned, along_y))
    ]
    assert energy == pytest.approx([3e11, 3e11])


@pytest.mark.parametrize(
    ("bulk", "head", "words"),
    [
        ("CQUAD4,1,5,1,2,3,4\nPSHELL,1,1,.01", SQUARE, ["CQUAD4 1", "PCOMP 5"]),
        ("CQUAD4,1,1,1,2,3,4\nPSHELL,1,6,.01", SQUARE, ["PSHELL 1", " 6 "]),
        ("CQUAD4,1,1,1,2,3,4\nPSHELL,1", SQUARE, ["PSHELL 1", "MID1"]),
        ("CQUAD4,1,1,1,2,3,4\nPSHELL,1,1", SQUARE, ["CQUAD4 1", "thickness"]),
        ("CQUAD4,1,1,1,3,2,4\nPSHELL,1,1,.1", SQUARE, ["CQUAD4 1", "out of order"]),
        ("CTRIA3,1,1,1,2,2\nPSHELL,1,1,.1", SQUARE, ["CTRIA3 1"]),
        (
            "CQUAD4,1,1,1,2,3,4,9\nPSHELL,1,8,.1\nCORD2R,9,,0.,0.,0.,1.,0.,0.\n,0.,0.,1.",
            SQUARE + ORTHO,  # an isotropic sheet cannot care, and passes
            ["CQUAD4 1", "MCID 9", "normal to the element"],
        ),
        (
            "CQUAD4,1,1,1,2,3,4\nPCOMP,1,,,,,,,SMCORE\n,1,.1",
            SQUARE,
            ["PCOMP 1", "SMCORE"],
        ),
        ("CHEXA,1,1,1,2,3,4,6,5\n,8,7", CUBE, ["CHEXA 1", "Jacobian"]),
        ("CTETRA,1,1,1,2,3,4", CUBE, ["CTETRA 1", "Jacobian"]),
        ("CHEXA,1,3,1,2,3,4,5,6\n,7,8", CUBE, ["CHEXA 1", "PSOLID or PCOMPS 3"]),
        ("CSHEAR,1,1,1,2,4,3\nPSHEAR,1,1,.1", SQUARE, ["CSHEAR 1", "order"]),
        ("CSHEAR,1,1,1,2,3,4\nPSHEAR,1,1,0.", SQUARE, ["CSHEAR 1", "positive"]),
    ],
)
def test_bad_cards_are_named(blocks, bulk, head, words):
    with pytest.raises(InputError) as caught:
        blocks(bulk, head)
    for word in words:
        assert word in str(caught.value), str(caught.value)
    assert "a.bdf:" in str(caught.value)


def test_all_problems_come_together(blocks):
    with pytest.raises(InputError) as caught:
        blocks(
            "CQUAD4,1,1,1,3,2,4\nCTRIA3,2,1,1,2,2\nPSHELL,1,1,.1\nCTETRA,3,1,1,2,3,4",
            CUBE,
        )
    assert len(caught.value.problems) >= 3


def test_quality_of_a_long_warped_quadrilateral(blocks):
    head = SQUARE.replace("GRID,3,,1.,1.,0.", "GRID,3,,200.,1.,.9").replace(
        "GRID,2,,1.,0.,0.", "GRID,2,,200.,0.,0."
    )
    long = blocks("CQUAD4,1,1,1,2,3,4\nPSHELL,1,1,.1", head)
    assert quality_table(long).set_index("measure").loc["aspect", "worst"] > 190
    head = SQUARE.replace("GRID,3,,1.,1.,0.", "GRID,3,,1.,1.,.4")
    warped = blocks("CQUAD4,1,1,1,2,3,4\nPSHELL,1,1,.1", head)
    table = quality_table(warped).set_index("measure")
    assert table.loc["warp", "beyond"] == 1
    assert any("warp" in x and "element 1" in x for x in quality_notices(warped))


def test_good_shapes_are_not_mentioned(blocks):
    square = blocks("CQUAD4,1,1,1,2,3,4\nCTRIA3,2,1,1,2,3\nPSHELL,1,1,.1")
    assert quality_notices(square) == []
    table = quality_table(square)
    values = dict(zip(zip(table["card"], table["measure"]), table["worst"]))
    assert values["CQUAD4", "skew"] == pytest.approx(90.0)
    assert values["CQUAD4", "warp"] == pytest.approx(0.0)
    assert values["CTRIA3", "skew"] == pytest.approx(45.0)
