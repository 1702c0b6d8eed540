"""CHEXA with PCOMPS: commercial ply stresses, laminate theory, order of grids."""

import numpy as np
import pytest

from benchmarks.verification.runner import run
from fem.deck.reader import read_deck
from fem.elements.solids.hexa import hexa8
from fem.elements.solids.isoparametric import HEX_CORNERS
from fem.errors import InputError
from fem.model.structure import Structure
from fem.properties.elasticity import isotropic_solid

TWISTED = HEX_CORNERS + 0.15 * np.sin(np.arange(24.0).reshape(8, 3))
UNLIKE = "PCOMPS,2,{cordm},{psdir},,,20.\n,1,1,1.,,,,YES,ABS\n,2,2,3.,30.,,,YES,ABS\n"
SOFT = "MAT1,1,1.+6,,.3,2.,1.-5\nMAT1,2,5.+6,,.2,1.,1.-5\n"


def cards(xyz, order=range(8)):
    grids = [
        f"GRID,{i + 1},,{x!r},{y!r},{z!r}" for i, (x, y, z) in enumerate(xyz.tolist())
    ]
    nodes = [str(i + 1) for i in order]
    return "\n".join(
        [*grids, f"CHEXA,1,2,{','.join(nodes[:6])}", f",{','.join(nodes[6:])}", ""]
    )


def structure(tmp_path, bulk):
    path = tmp_path / "deck.bdf"
    path.write_text(f"SOL 101\nCEND\nBEGIN BULK\n{bulk}ENDDATA\n")
    return Structure.from_deck(read_deck(path))


def translations(found):
    """(24, 24) stiffness of grids 1 to 8."""
    at = (6 * np.arange(8)[:, None] + np.arange(3)).ravel()
    return found.matrices.stiffness[at][:, at].toarray()


ORDERS = [
    (0, 1, 2, 3, 4, 5, 6, 7),
    (1, 2, 3, 0, 5, 6, 7, 4),
    (0, 4, 5, 1, 3, 7, 6, 2),
    (0, 3, 7, 4, 1, 2, 6, 5),
    (7, 6, 5, 4, 3, 2, 1, 0),
]


@pytest.mark.parametrize("order", ORDERS)
def test_the_order_of_grids_does_not_matter(tmp_path, order):
    """Plies are stacked along z of the basic frame, wherever G1 to G4 lie."""
    laminate = UNLIKE.format(cordm=0, psdir=13) + SOFT
    reference = translations(structure(tmp_path, cards(TWISTED) + laminate))
    found = translations(structure(tmp_path, cards(TWISTED, order) + laminate))
    np.testing.assert_allclose(found, reference, atol=1e-9 * np.abs(reference).max())


def test_rigid_motions_cost_nothing_and_twins_of_one_ply_are_stiffer(tmp_path):
    """Shear that each ply has of its own stiffens, as in Simcenter Nastran."""
    laminate = UNLIKE.format(cordm=-1, psdir=31) + SOFT
    k = translations(structure(tmp_path, cards(TWISTED) + laminate))
    turned = [np.cross(axis, TWISTED) for axis in np.eye(3)]
    moved = [np.broadcast_to(axis, (8, 3)) for axis in np.eye(3)]
    rigid = np.reshape([*moved, *turned], (6, 24))
    assert np.abs(rigid @ k @ rigid.T).max() < 1e-9 * np.abs(k).max()
    assert np.sum(np.linalg.eigvalsh(k) > 1e-9 * np.abs(k).max()) == 18
    twins = "PCOMPS,2\n,1,1,1.\n,2,1,1.\n" + SOFT
    k2 = translations(structure(tmp_path, cards(HEX_CORNERS) + twins))
    one = hexa8(HEX_CORNERS[None], isotropic_solid(1e6, 0.3)[None]).stiffness[0]
    assert np.linalg.eigvalsh(k2 - one).min() > -1e-9 * np.abs(k).max()
    single = "PCOMPS,2\n,1,1,1.\n" + SOFT
    one = hexa8(TWISTED[None], isotropic_solid(1e6, 0.3)[None]).stiffness[0]
    k1 = translations(structure(tmp_path, cards(TWISTED) + single))
    np.testing.assert_allclose(k1, one, atol=1e-9 * np.abs(one).max())


def bar(load, laminate, more=""):
    """A brick of 2 x 2 x 2 that is free to contract, held at x = -1."""
    held = "SPC1,1,1,1,4,5,8\nSPC1,1,2,1,5\nSPC1,1,3,1,4\nSPC1,1,456,1,THRU,8\n"
    case = "SPC = 1\nLOAD = 1\nDISP = ALL\nSTRESS = ALL\nSTRAIN = ALL\n" + more
    text = cards(HEX_CORNERS) + held + laminate + load
    return run(f"SOL 101\nCEND\n{case}BEGIN BULK\n{text}ENDDATA\n")


NO_NU = "MAT1,1,1.+6,,0.\nMAT1,2,5.+6,,0.\n"
PLAIN = "PCOMPS,2,0,13\n,1,1,1.\n,2,2,3.\n"


def test_stretched_unlike_plies_share_their_strain():
    """E = (1 + 3 x 5)/4 MPa; stress of each ply its own modulus times the strain."""
    pull = [f"FORCE,1,{g},,{f!r},1.,0.,0.\n" for g, f in ((2, 125.0), (3, 125.0))]
    pull += [f"FORCE,1,{g},,{f!r},1.,0.,0.\n" for g, f in ((6, 375.0), (7, 375.0))]
    # One line of action at the centroid of stiffness: no bending is left to the hold.
    held = "SPC1,1,23,2,3,6,7\n"
    found = bar(
        "".join(pull) + held + "MPC,7,3,1,1.,2,1,-1.\nMPC,7,6,1,1.,2,1,-1.\n"
        "MPC,7,7,1,1.,2,1,-1.\n",
        PLAIN + NO_NU,
        "MPC = 7\n",
    )
    strain = 1000.0 / 4.0 / 4e6
    assert found["static/1/displacement"][1, 0] == pytest.approx(2.0 * strain)
    own = found["static/1/element_stress/CHEXA_COMPOSITE/value"][0].reshape(2, 7)
    np.testing.assert_allclose(own[:, 0], [1e6 * strain, 5e6 * strain])
    np.testing.assert_allclose(own[:, 1:6], 0.0, atol=1e-9)
    strains = found["static/1/element_strain/CHEXA_COMPOSITE/value"][0].reshape(2, 7)
    np.testing.assert_allclose(strains[:, 0], strain)


def test_pressed_unlike_plies_share_their_stress():
    """Through the thickness 1/E = (1/4 + 3/4/5)/MPa, 12 m2."""
    press = "".join(f"FORCE,1,{g},,-1000.,0.,0.,1.\n" for g in (5, 6, 7, 8))
    held = "SPC1,1,3,2,3\nSPC1,1,12,2,3,6,7\n"
    found = bar(press + held, PLAIN + NO_NU)
    expected = -2.0 * 1000.0 * (0.25 + 0.15) / 1e6
    assert found["static/1/displacement"][4, 2] == pytest.approx(expected)
    own = found["static/1/element_stress/CHEXA_COMPOSITE/value"][0].reshape(2, 7)
    np.testing.assert_allclose(own[:, 2], -1000.0)
    np.testing.assert_allclose(own[:, 6], 1000.0)


def test_bent_unlike_plies_are_a_composite_beam():
    """One element: EI about the centroid of stiffness, curvature M L / EI."""
    couple = "".join(
        f"FORCE,1,{g},,{f},1.,0.,0.\n"
        for g, f in ((2, -500.0), (3, -500.0), (6, 500.0), (7, 500.0))
    )
    found = bar(couple, PLAIN + NO_NU)
    u = found["static/1/displacement"][:, 0]
    slope = (u[5] - u[1]) / 2.0
    z = np.array([-1.0, -0.5, 1.0])
    modulus = np.array([1e6, 5e6])
    area = 2.0 * modulus @ np.diff(z)
    first = 2.0 * modulus @ np.diff(z**2) / 2.0
    second = 2.0 * modulus @ np.diff(z**3) / 3.0
    bending = second - first**2 / area
    assert slope == pytest.approx(2000.0 * 2.0 / bending, rel=1e-9)


def test_uniform_heat_leaves_like_expansion_without_stress(tmp_path):
    bulk = "TEMPD,5,120.\n" + UNLIKE.format(cordm=0, psdir=13) + SOFT
    found = bar("", bulk, "TEMP(LOAD) = 5\nLOAD = 0\n")
    own = found["static/1/element_stress/CHEXA_COMPOSITE/value"]
    assert np.abs(own).max() < 1e-6
    assert found["static/1/displacement"][6] == pytest.approx(
        [2e-3, 2e-3, 2e-3, 0, 0, 0]
    )
    other = bulk.replace("1.,1.-5", "1.,2.-5")
    with pytest.raises(InputError, match="expand differently"):
        bar("", other, "TEMP(LOAD) = 5\nLOAD = 0\n")


def test_mass_of_plies(tmp_path):
    found = structure(tmp_path, cards(HEX_CORNERS) + PLAIN + SOFT)
    assert found.weight.total == pytest.approx(8.0 * (0.25 * 2.0 + 0.75 * 1.0))


@pytest.mark.parametrize(
    ("laminate", "message"),
    [
        ("PCOMPS,2,0,13\n,1,1,1.,,,,,ABS\n,2,1,1.,,,,,REL\n", "fields TFLAG"),
        ("PCOMPS,2,0,14\n,1,1,1.\n", "PSDIR: found '14'"),
        ("PCOMPS,2\n,1,1,0.\n", "ply thickness T"),
        ("PCOMPS,2\n,1,9,1.\n", "MAT1 or MAT9 9 is not defined"),
        ("PCOMPS,2\n,1,1,1.\nPSOLID,2,1\n", "more than once|already"),
    ],
)
def test_what_is_no_laminate_is_named(tmp_path, laminate, message):
    with pytest.raises(InputError, match=message):
        _ = structure(tmp_path, cards(HEX_CORNERS) + laminate + SOFT).blocks


def test_mat11_has_its_moduli_and_ratios(tmp_path):
    """Compliance of its engineering constants, in the order xx yy zz xy yz zx."""
    material = (
        "MAT11,1,1.4+5,9.+3,8.+3,.3,.25,.4,5.+3\n,4.+3,3.+3,2.,1.-6,2.-5,3.-5,20.\n"
    )
    found = structure(tmp_path, cards(HEX_CORNERS) + "PSOLID,2,1\n" + material)
    block = found.blocks[0]
    s = np.linalg.inv(block.elasticity[0])
    np.testing.assert_allclose(
        1.0 / np.diag(s), [1.4e5, 9e3, 8e3, 5e3, 3e3, 4e3], rtol=1e-12
    )
    ratios = [-s[0, 1] * 1.4e5, -s[0, 2] * 1.4e5, -s[1, 2] * 9e3]
    np.testing.assert_allclose(ratios, [0.3, 0.25, 0.4], rtol=1e-12)
    bad = cards(HEX_CORNERS) + "PSOLID,2,1\n" + material.replace(".3,.25", "9.,.25")
    with pytest.raises(InputError, match="would give energy away"):
        structure(tmp_path, bad)
