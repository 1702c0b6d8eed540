"""CBAR, CBEAM, rods, bushings: rigid motion, closed forms, mass, other solvers."""

import json
from pathlib import Path

import numpy as np
import pytest
import scipy.linalg
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.sparse.linalg import spsolve

from fem.model.weight import rigid_modes, weigh

# One of each line element between grids with frames of all kinds.
FRAMES = """
CORD2R,1,,1.,2.,3.,2.,3.,5.
,4.,1.,2.
CORD2C,2,,-1.,-2.,.5,.3,-2.2,4.
,3.,1.,1.
CORD2S,3,,.1,-2.,-3.,1.,1.,1.
,0.,4.,1.
MAT1,1,7.+10,,.33,2700.,,,.02
PBAR,1,1,2.-3,3.-6,5.-6,4.-6,.3
,.1,.2,-.1,.2,.1,-.2,-.1,-.2
,.8,.6
PBAR,2,1,2.-3,3.-6,5.-6,4.-6
,
,,,1.-6
PBEAM,3,1,2.-3,3.-6,5.-6,1.-6,4.-6,.5
,.1,.2,-.1,.2,.1,-.2,-.1,-.2
,YES,1.,1.-3,2.-6,3.-6,.5-6,2.-6,.1
,,,,,,,,
,.9,.8,,,.02,.03
,.01,.02,.03,.01,.04,.05,-.02,.03
PROD,4,1,1.-3,2.-6,,.2
PTUBE,5,1,.1,.01,.1
PBUSH,6,K,1.+6,2.+6,3.+6,1.+4,2.+4,3.+4
PVISC,7,3.,4.
"""


def _grids(xyz: np.ndarray, cd: list[int]) -> str:
    return "\n".join(
        f"GRID,{i + 1},,{x[0]:.6f},{x[1]:.6f},{x[2]:.6f},{c}"
        for i, (x, c) in enumerate(zip(xyz, cd))
    )


def _elements(v: np.ndarray, w: np.ndarray, offt: str) -> str:
    v_text = ",".join(f"{a:.6f}" for a in v)
    w_text = ",".join(f"{a:.6f}" for a in w.reshape(-1))
    return f"""
CBAR,1,1,1,2,{v_text},{offt}
,,,{w_text}
CBAR,2,2,2,3,1,,,{offt}
,45,6,{w_text}
CBEAM,3,3,3,4,{v_text},{offt}
,,,{w_text}
CROD,4,4,1,4
CONROD,5,2,4,1,1.-3,2.-5
CTUBE,6,5,1,3
CBUSH,7,6,1,3,{v_text}
,.3
CBUSH,8,6,2,4,,,,2
,,1,.1,.2,.3
CVISC,9,7,1,4
"""


coordinate = st.floats(-3.0, 3.0).map(lambda a: round(a, 3))


@settings(
    max_examples=15,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(
    noise=st.lists(coordinate, min_size=12, max_size=12),
    offsets=st.lists(st.floats(-0.3, 0.3), min_size=6, max_size=6),
    cd=st.lists(st.sampled_from([0, 1, 2, 3]), min_size=4, max_size=4),
    offt=st.sampled_from(["GGG", "BGG", "GGO", "GOG", "BOO"]),
)
def test_rigid_motion_gives_no_force_and_no_energy(model, noise, offsets, cd, offt):
    corners = np.array([[0, 0, 0], [9, 0, 0], [0, 9, 0], [9, 9, 9]], float)
    xyz = corners + np.reshape(noise, (4, 3))
    bulk = _grids(xyz, cd) + FRAMES
    bulk += _elements(np.array([0.9, 0.4, 7.0]), np.reshape(offsets, (2, 3)), offt)
    built = model(bulk)
    modes = rigid_modes(built.points, xyz.mean(axis=0))
    for matrix in (built.matrices.stiffness, built.matrices.damping):
        energy = np.einsum("gi,gi->i", modes, matrix @ modes)
        # Energy of the same motions if nothing cancelled.
        scale = np.einsum("gi,gi->i", abs(modes), abs(matrix) @ abs(modes))
        assert np.all(np.abs(energy) <= 1e-13 * scale)
        assert abs(matrix - matrix.T).max() == 0.0
    for block in built.blocks:
        recovery = block.forces()
        if recovery is None or block.frame != "basic":
            continue
        basic = (built.points.basic_rotation() @ modes)[block.dof]
        force = np.einsum("ecn,enm->ecm", recovery.matrix, basic)
        scale = np.abs(recovery.matrix).max() * np.abs(basic).max()
        assert np.abs(force).max() <= 1e-10 * scale


BEAM_ALONG_X = """
MAT1,1,2.1+11,8.+10,,7850.
GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.
SPC1,1,123456,1
"""
TIP = slice(6, 12)


def _tip(built, component: int) -> np.ndarray:
    """Displacement of the tip by a unit force or moment there."""
    load = np.zeros(built.points.size)
    load[6 + component - 1] = 1.0
    t = built.elimination.T
    u = t @ spsolve(
        built.elimination.reduce(built.matrices.stiffness).tocsc(), t.T @ load
    )
    return u[TIP]


@pytest.mark.parametrize("card", ["bar", "beam"])
def test_timoshenko_cantilever(model, card):
    section = {
        "bar": "CBAR,1,1,1,2,0.,1.,0.\nPBAR,1,1,.01,4.-6,9.-6,5.-6\n,\n,.5,.8",
        "beam": "CBEAM,1,1,1,2,0.,1.,0.\nPBEAM,1,1,.01,4.-6,9.-6,,5.-6\n,\n,.5,.8",
    }[card]
    built = model(BEAM_ALONG_X + section, "SPC=1")
    e, g, length = 2.1e11, 8e10, 2.0
    for component, inertia, factor in ((2, 4e-6, 0.5), (3, 9e-6, 0.8)):
        expected = length**3 / (3 * e * inertia) + length / (factor * g * 0.01)
        assert _tip(built, component)[component - 1] == pytest.approx(
            expected, rel=1e-9
        )
    assert _tip(built, 1)[0] == pytest.approx(length / (e * 0.01), rel=1e-9)
    assert _tip(built, 4)[3] == pytest.approx(length / (g * 5e-6), rel=1e-9)
    assert _tip(built, 2)[5] == pytest.approx(length**2 / (2 * e * 4e-6), rel=1e-9)
    assert _tip(built, 3)[4] == pytest.approx(-(length**2) / (2 * e * 9e-6), rel=1e-9)


def test_product_of_inertia_bends_across_the_load(model):
    """(v, w) = L³ (I2, -I12) / (3 E (I1 I2 - I12²)) by a force in y."""
    built = model(
        BEAM_ALONG_X + "CBAR,1,1,1,2,0.,1.,0.\nPBAR,1,1,.01,4.-6,9.-6,5.-6\n,\n,,,2.-6",
        "SPC=1",
    )
    i1, i2, i12 = 4e-6, 9e-6, 2e-6
    common = 2.0**3 / (3 * 2.1e11 * (i1 * i2 - i12**2))
    along_y = _tip(built, 2)
    assert along_y[1] == pytest.approx(common * i2, rel=1e-9)
    assert along_y[2] == pytest.approx(-common * i12, rel=1e-9)
    assert _tip(built, 3)[2] == pytest.approx(common * i1, rel=1e-9)


def test_one_tapered_beam_equals_many_prismatic_ones(model):
    """A and I linear between stations; 400 prismatic slices converge with 1/n²."""
    one = model(
        BEAM_ALONG_X
        + "CBEAM,1,1,1,2,0.,1.,0.\n"
        + "PBEAM,1,1,.02,8.-6,9.-6,,5.-6\n,\n"
        + ",NO,.5,.012,4.-6,6.-6,,3.-6\n"
        + ",NO,1.,.01,1.-6,3.-6,,2.-6\n,0.,0.",
        "SPC=1",
    )
    count = 400
    bulk = ["MAT1,1,2.1+11,8.+10", "SPC1,1,123456,1", "GRID,1,,0.,0.,0."]
    for k in range(count):
        x = (k + 0.5) / count
        a, i1, i2, j = (
            np.interp(x, [0, 0.5, 1], v)
            for v in (
                [0.02, 0.012, 0.01],
                [8e-6, 4e-6, 1e-6],
                [9e-6, 6e-6, 3e-6],
                [5e-6, 3e-6, 2e-6],
            )
        )
        bulk += [
            f"GRID,{k + 2},,{2 * (k + 1) / count:.6f},0.,0.",
            f"CBAR,{k + 1},{k + 1},{k + 1},{k + 2},0.,1.,0.",
            f"PBAR*,{k + 1},1,{a:.12E},{i1:.12E}",
            f"*,{i2:.12E},{j:.12E}",
        ]
    many = model("\n".join(bulk), "SPC=1")
    t = many.elimination.T
    stiffness = many.elimination.reduce(many.matrices.stiffness).tocsc()
    loads = np.zeros((many.points.size, 6))
    loads[-6:] = np.eye(6)
    fine = (t @ spsolve(stiffness, t.T @ loads))[-6:]
    coarse = np.column_stack([_tip(one, c) for c in range(1, 7)])
    scale = np.sqrt(np.outer(np.diag(fine), np.diag(fine)))
    assert np.abs((coarse - fine) / scale).max() < 2e-5


def test_neutral_axis_offset_couples_axial_force_and_bending(model):
    """An axial force at the shear center bends by its arm about the neutral axis."""
    built = model(
        BEAM_ALONG_X
        + "CBEAM,1,1,1,2,0.,1.,0.\nPBEAM,1,1,.01,4.-6,9.-6,,5.-6\n,\n,0.,0.\n"
        + ",,,,,.05,.03,.05,.03",
        "SPC=1",
    )
    e, length = 2.1e11, 2.0
    tip = _tip(built, 1)
    axial = length / e * (1 / 0.01 + 0.05**2 / 4e-6 + 0.03**2 / 9e-6)
    assert tip[0] == pytest.approx(axial, rel=1e-9)
    assert tip[5] == pytest.approx(length * 0.05 / (e * 4e-6), rel=1e-9)
    assert tip[4] == pytest.approx(-length * 0.03 / (e * 9e-6), rel=1e-9)
    stress = built.blocks[0].stresses()
    u = np.zeros(12)
    u[6:] = tip
    ends = stress.derive(np.einsum("ecn,n->ec", stress.matrix, u))
    # Points C-F all lie at the shear center: N/A and the bending of its offset.
    expected = 1 / 0.01 + 0.05**2 / 4e-6 + 0.03**2 / 9e-6
    assert ends == pytest.approx(np.full((1, 12), expected), rel=1e-9)


@pytest.mark.parametrize("coupmass", [-1, 1])
@pytest.mark.parametrize("card", ["bar", "beam", "rod"])
def test_mass_and_its_center_are_exact(model, card, coupmass):
    bulk = {
        "bar": "CBAR,1,1,1,2,0.,1.,0.\n,,,0.,.1,.2,0.,.1,.2\n"
        "PBAR,1,1,.01,4.-6,9.-6,5.-6,3.",
        "beam": "CBEAM,1,1,1,2,0.,1.,0.\n,,,0.,.1,.2,0.,.1,.2\n"
        "PBEAM,1,1,.01,4.-6,9.-6,,5.-6,2.\n,\n,NO,1.,.01,4.-6,9.-6,,5.-6,4.\n"
        ",\n,0.,0.",
        "rod": "CONROD,1,1,2,1,.01,5.-6,,3.",
    }[card]
    built = model(BEAM_ALONG_X + f"PARAM,COUPMASS,{coupmass}\n" + bulk)
    weight = weigh(built.points, built.matrices.mass)
    total = 2.0 * (78.5 + 3.0)
    assert weight.mass == pytest.approx(np.full(3, total), rel=1e-12)
    x = 1.0 if card != "beam" else 1.0 + (4.0 - 2.0) * 2.0**2 / 12 / total
    offset = [0.0, 0.0] if card == "rod" else [0.1, 0.2]
    assert weight.center == pytest.approx([x, *offset], rel=1e-12, abs=1e-12)


def test_beam_torsional_inertia_is_lumped_and_nsi_added(model):
    built = model(
        BEAM_ALONG_X
        + "CBEAM,1,1,1,2,0.,1.,0.\nPBEAM,1,1,.01,4.-6,9.-6,,5.-6\n,\n,0.,0.,,,.7,.7"
    )
    expected = 0.5 * 2.0 * (7850.0 * 13e-6 + 0.7)
    assert built.matrices.mass[3, 3] == pytest.approx(expected, rel=1e-12)
    assert built.matrices.mass[4, 4] == 0.0


def test_pin_flags_release_and_mechanisms_stay_finite(model):
    """Propped at the hinge: a bar released in bending at B acts as a cantilever rod."""
    built = model(
        BEAM_ALONG_X + "CBAR,1,1,1,2,0.,1.,0.\n,456,456\nPBAR,1,1,.01,4.-6,9.-6,5.-6"
    )
    k = built.matrices.stiffness.toarray()
    axial = 2.1e11 * 0.01 / 2.0
    expected = np.zeros((12, 12))
    expected[np.ix_([0, 6], [0, 6])] = axial * np.array([[1, -1], [-1, 1]])
    assert np.abs(k - expected).max() < 1e-9 * axial


def test_bar_split_in_two_gives_the_same_static_answer(model):
    whole = model(
        BEAM_ALONG_X + "CBAR,1,1,1,2,0.,1.,0.\nPBAR,1,1,.01,4.-6,9.-6,5.-6\n,\n,.5,.8",
        "SPC=1",
    )
    split = model(
        "MAT1,1,2.1+11,8.+10,,7850.\nGRID,1,,0.,0.,0.\nGRID,3,,2.,0.,0.\n"
        "GRID,2,,.7,0.,0.\nSPC1,1,123456,1\nCBAR,1,1,1,2,0.,1.,0.\n"
        "CBAR,2,1,3,2,0.,1.,0.\nPBAR,1,1,.01,4.-6,9.-6,5.-6\n,\n,.5,.8",
        "SPC=1",
    )
    t = split.elimination.T
    stiffness = split.elimination.reduce(split.matrices.stiffness).tocsc()
    load = np.zeros((split.points.size, 6))
    load[12:] = np.eye(6)
    u = (t @ spsolve(stiffness, t.T @ load))[12:]
    assert u == pytest.approx(
        np.column_stack([_tip(whole, c) for c in range(1, 7)]), rel=1e-8, abs=1e-18
    )


def test_bushing_between_coincident_grids_in_its_frame(model):
    built = model(
        "CORD2R,5,,0.,0.,0.,0.,1.,0.\n,0.,0.,1.\nGRID,1,,1.,2.,3.\nGRID,2,,1.,2.,3.\n"
        "CBUSH,1,1,1,2,,,,5\nPBUSH,1,K,1.,2.,3.,4.,5.,6.\n,,B,.1,.2,.3\n,,GE,.02,.03\n"
        "CBUSH,2,2,1,,,,,0\nPBUSH,2,K,10.\n,,GE,.5"
    )
    k = built.matrices.stiffness.toarray()
    # CID 5 has its x along basic z, y along basic x, z along basic y.
    assert np.diag(k)[6:] == pytest.approx([2.0, 3.0, 1.0, 5.0, 6.0, 4.0])
    assert k[0, 0] == pytest.approx(12.0)
    assert np.diag(built.matrices.damping.toarray())[6:9] == pytest.approx(
        [0.2, 0.3, 0.1]
    )
    k4 = np.diag(built.matrices.structural_damping.toarray())
    assert k4[6:] == pytest.approx([0.06, 0, 0.02, 0, 0, 0], abs=1e-15)
    assert k4[0] == pytest.approx(0.06 + 5.0)


def test_scalar_elements_between_grids_points_and_ground(model):
    built = model(
        "GRID,1,,0.,0.,0.\nSPOINT,7\nCELAS2,1,5.,1,3,7\nCELAS2,2,2.,7\nPELAS,3,4.,.1,9.\n"
        "CELAS1,3,3,1,6\nCDAMP2,4,.5,7\nCMASS2,5,3.,7\nCMASS2,6,2.,1,1,1,2"
    )
    k = built.matrices.stiffness.toarray()
    assert k[2, 2] == 5.0
    assert k[2, 6] == -5.0
    assert k[6, 6] == 7.0
    assert k[5, 5] == 4.0
    assert built.matrices.structural_damping[5, 5] == pytest.approx(0.4)
    assert built.matrices.damping[6, 6] == 0.5
    assert built.matrices.mass[6, 6] == 3.0
    assert built.matrices.mass[0, 1] == -2.0
    stress = next(b for b in built.blocks if b.card == "CELAS1").stresses()
    assert stress.matrix[0, 0, 0] == pytest.approx(36.0)


@pytest.mark.parametrize(
    ("name", "count"),
    [
        ("beams/001_ten_bar_truss/modes.dat", 8),
        ("beams/002_svanberg_beam/modes.dat", 10),
        ("beams/003_svanberg_bar/modes.dat", 10),
        ("beams/004_72_bar_truss/modes.dat", 10),
        ("reduction/cantilever_bar/noReduction.dat", 10),
        ("truss_frame/full.dat", 30),
    ],
)
def test_frequencies_of_other_solvers(reference_model, references: Path, name, count):
    """MSC and NX, lumped and coupled masses, bars, beams, rods, CMASS, RBE2."""
    expected = json.loads((references / "expected.json").read_text())
    folder, rest = name.split("/", 1)
    if folder == "reduction":
        folder, rest = name.rsplit("/", 1)
    figures = expected[folder][rest] if folder in expected else expected[name]
    hz = np.ravel(figures["modes_hz"])[:count]
    ours = _frequencies(reference_model(name), count)
    elastic = hz > 1e-3
    assert ours[elastic] == pytest.approx(hz[elastic], rel=5e-6)
    assert np.abs(ours[~elastic]).max(initial=0.0) < 1e-3


def test_cantilever_with_offset_mass_as_nastran95_and_opensees(reference_model):
    hz = _frequencies(reference_model("cantilever/cant_a_modes.bdf"), 4)
    assert hz == pytest.approx([14.0331, 28.0550, 90.4983, 180.7624], rel=4e-6)


def _frequencies(built, count: int) -> np.ndarray:
    """Lowest frequencies in Hz by a dense solve that bears massless freedoms."""
    k = built.elimination.reduce(built.matrices.stiffness).toarray()
    m = built.elimination.reduce(built.matrices.mass).toarray()
    shift = 1e-4 * np.trace(k) / np.trace(m)
    inverse = scipy.linalg.eigh(m, k + shift * m, eigvals_only=True)[::-1][:count]
    return np.sqrt(np.abs(1.0 / inverse - shift)) / (2 * np.pi)


@pytest.mark.parametrize(
    "deck", ["static_solid_shell_bar", "static_solid_shell_bar_xyz"]
)
def test_forces_and_stresses_of_nx(reference_model, references: Path, deck):
    """NX's own displacements give NX's own bar, beam and rod results."""
    op2 = pytest.importorskip("pyNastran.op2.op2")
    theirs = op2.read_op2(
        str(references / f"solid_shell_bar/{deck}.op2"), debug=None, log=None
    )
    built = reference_model(f"solid_shell_bar/{deck}.bdf")
    table = theirs.displacements[1]
    u = np.zeros(built.points.size)
    rows = built.points.rows(table.node_gridtype[:, 0])
    u[(6 * rows[:, None] + np.arange(6)).reshape(-1)] = table.data[0].reshape(-1)
    u = built.points.basic_rotation() @ u
    for block in built.blocks:
        if block.card not in ("CBAR", "CBEAM", "CROD"):
            continue
        name = block.card.lower()
        force = getattr(theirs.op2_results.force, f"{name}_force")[1].data[0]
        stress = getattr(theirs.op2_results.stress, f"{name}_stress")[1].data[0]
        if name == "cbeam":
            force, stress = force[:, 1:].reshape(1, -1), stress[:, :6].reshape(1, -1)
        if name == "cbar":
            stress = np.delete(stress, [7, 14], axis=1)
        if name == "crod":
            stress = stress[:, ::2]
        for recovery, expected in ((block.forces(), force), (block.stresses(), stress)):
            linear = np.einsum("ecn,en->ec", recovery.matrix, u[block.dof])
            ours = recovery.derive(linear)
            # Displacements in single precision: small forces lose digits.
            assert ours == pytest.approx(expected, rel=1e-5, abs=1e-6 * expected.max())
