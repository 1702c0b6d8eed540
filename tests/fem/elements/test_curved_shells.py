"""CQUAD8 and CTRIA6: rank, laminates, pressure, mass, plates, files, refusals.

Patch tests, cylinder, roof and hemisphere: benchmarks/verification/curved_shells.py.
"""

import logging

import h5py
import numpy as np
import pytest
from pyNastran.op2.op2 import OP2

import fem
from benchmarks.verification.curved_shells import (
    meshes,
    mindlin_deflection,
    shear_error,
    supported_quarter,
)
from benchmarks.verification.macneal_harder import statics
from benchmarks.verification.mesh import rectangle
from fem.errors import InputError
from fem.files.op2 import write_op2
from fem.files.paraview import write_paraview
from fem.model.weight import rigid_modes

STEEL = "MAT1,1,2.+11,,.3,7800.\n"
GRIDS = """\
GRID,1,,0.,0.,0.
GRID,2,,1.,.1,.1
GRID,3,,1.2,.9,.3
GRID,4,,-.1,1.,.1
GRID,5,,.52,-.03,.08
GRID,6,,1.15,.5,.25
GRID,7,,.5,1.02,.24
GRID,8,,-.08,.5,.02
GRID,9,,.56,.47,.2
"""
ELEMENTS = {
    "CQUAD8": "CQUAD8,1,1,1,2,3,4,5,6,+\n+,7,8,,,,,{theta},{zoffs}\n",
    "CTRIA6": "CTRIA6,1,1,1,2,4,5,9,8,+\n+,{theta},{zoffs}\n",
}
cards = pytest.mark.parametrize("card", list(ELEMENTS))


def element(card: str, theta: float = 20.0, zoffs: float = 0.05) -> str:
    return ELEMENTS[card].format(theta=theta, zoffs=zoffs)


@cards
def test_a_curved_element_has_six_motions_without_energy(model, card):
    """Those of a rigid body, with offset and K6ROT; no spurious ones."""
    made = model(GRIDS + element(card) + "PSHELL,1,1,.02,1,,1\n" + STEEL)
    (block,) = made.blocks
    stiffness = block.stiffness()[0]
    value = np.linalg.eigvalsh(stiffness)
    assert np.abs(value[:6]).max() < 1e-13 * value[-1]
    assert value[6] > 1e-9 * value[-1]
    rigid = rigid_modes(made.points, np.zeros(3))[block.dof[0]]
    assert np.abs(stiffness @ rigid).max() < 1e-11 * value[-1]
    for kind in ("force", "stress", "strain"):
        matrix = block.recovery(kind).matrix[0]
        assert np.abs(matrix @ rigid).max() < 1e-10 * np.abs(matrix).max()


@cards
def test_mass_is_that_of_the_area_lumped_and_coupled(model, card):
    made = model(GRIDS + element(card) + "PSHELL,1,1,.02,1,,1,,3.\n" + STEEL)
    (block,) = made.blocks
    motions = rigid_modes(made.points, np.zeros(3))[block.dof[0]]
    bodies = [
        motions.T @ block.mass(coupled=coupled)[0] @ motions for coupled in (0, 1)
    ]
    total = float(block.extent[0] * (7800.0 * 0.02 + 3.0))
    for body in bodies:
        np.testing.assert_allclose(body[:3, :3], total * np.eye(3), atol=1e-12 * total)
    lumped = np.diag(block.mass(coupled=False)[0]).reshape(-1, 6)
    # All of it at the mid-sides.
    corners = len(lumped) // 2
    assert (lumped[corners:, :3] > 0.0).all()
    assert not lumped[:corners].any()
    # The center of gravity hardly depends on the lumping.
    np.testing.assert_allclose(bodies[0][:3, 3:], bodies[1][:3, 3:], atol=0.02 * total)


@cards
@pytest.mark.parametrize("theta", [0.0, 35.0])
def test_plies_of_one_material_are_a_plate_of_it(model, card, theta):
    plate = model(GRIDS + element(card, theta) + "PSHELL,1,1,.02,1,,1\n" + STEEL)
    plies = "PCOMP,1,,,,,,,,+\n+,1,.005,0.,YES,1,.01,30.,YES,+\n+,1,.005,90.,YES\n"
    laminate = model(GRIDS + element(card, theta) + plies + STEEL)
    ours, theirs = (made.blocks[0].stiffness() for made in (laminate, plate))
    np.testing.assert_allclose(ours, theirs, atol=2e-6 * np.abs(theirs).max())
    assert ours.shape == theirs.shape


@cards
def test_the_material_turns_with_mcid_as_with_theta(model, card):
    """On a flat rectangle both say the same direction."""
    flat = "".join(
        f"GRID,{k},,{x},{y},0.\n"
        for k, (x, y) in enumerate(
            [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0), (1.0, 0.0), (2.0, 0.5),
             (1.0, 1.0), (0.0, 0.5), (1.0, 0.5)], 1)
    )  # fmt: skip
    rest = "PSHELL,1,8,.02,8,,8\nMAT8,8,1.4+11,9.+9,.3,5.+9,5.+9,3.+9\n"
    c, s = np.cos(np.radians(30.0)), np.sin(np.radians(30.0))
    frame = f"CORD2R,7,,0.,0.,0.,0.,0.,1.\n,{c:.7f},{s:.7f},0.\n"
    by_angle = model(flat + ELEMENTS[card].format(theta=30.0, zoffs=0.0) + rest)
    by_frame = model(flat + ELEMENTS[card].format(theta=7, zoffs=0.0) + frame + rest)
    ours, theirs = (m.blocks[0].stiffness() for m in (by_frame, by_angle))
    np.testing.assert_allclose(ours, theirs, atol=1e-6 * np.abs(theirs).max())


@pytest.mark.parametrize("thickness", [0.2, 2e-4])
def test_plates_do_not_lock(thickness):
    """Navier's plate with shear, four elements on a quarter, thick and very thin."""
    for mesh, error in zip(meshes(*rectangle(2, 2)), (4e-3, 4e-2)):
        ours = float(statics(supported_quarter(mesh, thickness))[0, 2])
        assert ours == pytest.approx(mindlin_deflection(thickness), rel=error)


@pytest.mark.parametrize("thickness", [0.2, 2e-4])
def test_shear_forces_of_quadrilaterals_do_not_alternate(thickness):
    """Four by four on a quarter, thick and very thin."""
    assert shear_error(meshes(*rectangle(4, 4))[0], thickness) < 0.02


@pytest.fixture
def results(tmp_path):
    """A strip of two CQUAD8 and one of two CTRIA6, PSHELL and PCOMP, under pressure."""
    grids = "".join(
        f"GRID,{1 + i + 5 * j},,{0.5 * i},{0.5 * j},{0.05 * i * i}\n"
        for j in range(3)
        for i in range(5)
    )
    path = tmp_path / "model.bdf"
    path.write_text(
        "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nDISP = ALL\nSTRESS = ALL\nFORCE = ALL\n"
        f"BEGIN BULK\nPARAM,POST,-1\n{grids}"
        "CQUAD8,1,1,1,3,13,11,2,8,+\n+,12,6\nCQUAD8,2,2,3,5,15,13,4,10,+\n+,14,8\n"
        "CTRIA6,3,1,1,3,13,2,8,7\nCTRIA6,4,2,3,5,15,4,10,9\n"
        "PSHELL,1,1,.02,1,,1\nPCOMP,2,,,,,,,,+\n+,1,.01,0.,YES,1,.01,45.,YES\n"
        f"{STEEL}SPC1,1,123456,1,6,11\nPLOAD4,2,1,1000.,,,,THRU,4\nENDDATA\n"
    )
    deck = fem.read_deck(path)
    file = fem.run_deck(deck, tmp_path / "model.h5")
    return file, fem.Structure.from_deck(deck), tmp_path


def test_op2_files_are_read_back_by_pynastran(results):
    file, structure, folder = results
    assert write_op2(file, structure, folder / "model.op2") == []
    logging.disable(logging.WARNING)
    try:
        op2 = OP2(debug=None)
        op2.read_op2(str(folder / "model.op2"))
    finally:
        logging.disable(logging.NOTSET)
    with h5py.File(file) as ours:
        for name, card, points in (
            ("cquad8", "CQUAD8", 5),
            ("ctria6", "CTRIA6", 4),
        ):
            table = ours[f"static/1/element_stress/{card}"]
            columns = [str(c) for c in table.attrs["columns"]]
            theirs = getattr(op2.op2_results.stress, f"{name}_stress")[1]
            theirs = theirs.data[0].reshape(-1, points, 2, 8)[..., 1]  # oxx
            mine = table["value"][:, [columns.index("oxx_1"), columns.index("oxx_2")]]
            np.testing.assert_allclose(theirs[:, 0], mine, rtol=1e-6)
            plies = getattr(op2.op2_results.stress, f"{name}_composite_stress")[1]
            assert (
                plies.element_layer[:, 0].tolist() == [2 * (card[-1] == "8") or 4] * 2
            )


def test_paraview_gets_quadratic_cells(results):
    file, structure, folder = results
    (path,) = write_paraview(file, structure, folder / "paraview")
    with h5py.File(path) as mesh:
        assert sorted(set(mesh["VTKHDF/Types"][:])) == [22, 23]
        assert np.diff(mesh["VTKHDF/Offsets"][:]).tolist() == [8, 8, 6, 6]
        assert np.isfinite(mesh["VTKHDF/CellData/von_mises"][:]).all()


def test_pressure_is_in_equilibrium_with_the_supports(results):
    """Its resultant is p times the projected area, in each direction."""
    with h5py.File(results[0]) as ours:
        force = ours["static/1/spc_force"][:].sum(axis=0)
    # z = x² / 5 over a strip 2 x 1, and over the triangles below its two diagonals.
    rise = 0.2 * 2.0**2 + 0.4 * (1.0 / 3.0 + 5.0 / 6.0)
    np.testing.assert_allclose(force[2], -1000.0 * (2.0 + 1.0), rtol=1e-9)
    assert force[0] == pytest.approx(1000.0 * rise, rel=1e-9)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("CQUAD8,1,1,1,2,3,4,7,6,+\n+,5,8\n", "CQUAD8 1: it is folded over"),
        ("CQUAD8,1,1,1,2,4,3,5,6,+\n+,7,8\n", "CQUAD8 1: .*out of order"),
        ("CTRIA6,1,5,1,2,4,5,9,8\n", "PSHELL or PCOMP 5 is not defined"),
        ("CQUAD8,1,1,1,2,3,4,5,6,+\n+,7,77\n", "CQUAD8 1: grid 77 is not defined"),
    ],
)
def test_impossible_elements_are_refused(model, text, message):
    with pytest.raises(InputError, match=message):
        model(GRIDS + text + "PSHELL,1,1,.02,1,,1\n" + STEEL)


@pytest.mark.parametrize("grids", ["5,,+\n+,7,8", ",6,+\n+,,", ",,+\n+,,"])
def test_a_mid_side_left_out_follows_its_corners(model, grids):
    """In its plane the element with that mid-side tied to the mean of its corners.

    Its bending is another: shear would lock with rotations that are linear on edges.
    """
    flat = "".join(
        f"GRID,{line.split(',')[1]},,{','.join(line.split(',')[3:5])},0.\n"
        for line in GRIDS.splitlines()
    ).replace("GRID,6,,1.15,.5", "GRID,6,,1.1,.5")
    # In the middle of their edges, as the element has them.
    flat = flat.replace("GRID,5,,.52,-.03", "GRID,5,,.5,.05")
    flat = flat.replace("GRID,7,,.5,1.02", "GRID,7,,.55,.95")
    flat = flat.replace("GRID,8,,-.08,.5", "GRID,8,,-.05,.5")
    flat = flat.replace("GRID,9,,.56,.47,0.\n", "")
    shell = "PARAM,K6ROT,0.\nPSHELL,1,1,.02,1,,1\n" + STEEL
    given = grids.replace("+\n+,", "").split(",")
    (whole,) = model(flat + element("CQUAD8", zoffs=0.0) + shell).blocks
    made_card = f"CQUAD8,1,1,1,2,3,4,{grids},,,,,20.\n"
    made = model(flat + made_card + shell)
    (part,) = made.blocks
    follow = np.zeros((8, 4 + sum(map(bool, given))))
    follow[:4, :4] = np.eye(4)
    at = 4
    for k, grid in enumerate(given):
        if grid:
            follow[4 + k, at], at = 1.0, at + 1
        else:
            follow[4 + k, [k, (k + 1) % 4]] = 0.5
    tie = np.kron(follow, np.eye(6))
    expected = tie.T @ whole.stiffness()[0] @ tie
    size = np.abs(expected).max()
    plane = np.ix_(*2 * [np.arange(len(expected)) % 6 < 2])
    found = part.stiffness()[0]
    np.testing.assert_allclose(found[plane], expected[plane], atol=1e-10 * size)
    # Six rigid motions, and the rotations about the normal, which are AUTOSPC's.
    (held,) = model(flat + made_card + shell.replace("K6ROT,0.", "K6ROT,100.")).blocks
    value = np.linalg.eigvalsh(held.stiffness()[0])
    free = 6 + len(value) // 6
    assert np.abs(value[:free]).max() < 1e-11 * value[-1] < value[free] * 1e-2
    total = part.mass(coupled=False)[0][::6, ::6].sum()
    assert total == pytest.approx(whole.mass(coupled=False)[0][::6, ::6].sum())


@pytest.mark.parametrize("left_out", [(0,), (0, 2), (1, 3), (0, 1, 2, 3)])
@cards
def test_plates_without_some_mid_sides_do_not_lock(model, card, left_out):
    """A thin strip under a moment at its end: M L^2 / (2 E I), M = 1, no Poisson.

    A mid-side on one of two sides only bends and twists the elements: 6 % in four.
    """
    corners, width, thick = 4 if card == "CQUAD8" else 3, 1.0, 0.01
    place: dict[tuple[float, float], int] = {}

    def grid(x: float, y: float) -> int:
        return place.setdefault((x, y), len(place) + 1)

    elements = []
    for i in range(4):
        square = [(i, 0.0), (i + 1, 0.0), (i + 1, width), (i, width)]
        halves = [square] if corners == 4 else [square[:3], square[2:] + square[:1]]
        for tip in halves:
            sides = [(np.array(a) + b) / 2 for a, b in zip(tip, [*tip[1:], tip[0]])]
            ids = [grid(*map(float, p)) for p in tip]
            # Edges along x count as 0 and 2, those along y as 1 and 3.
            for p in sides:
                number = 0 if p[1] == 0.0 else 2 if p[1] == width else 1
                number = 3 if number == 1 and p[0] == 0.0 else number
                ids.append("" if number in left_out else grid(*map(float, p)))
            head, tail = ids[:6], ids[6:]
            text = f"{card},{len(elements) + 1},1,{','.join(map(str, head))}"
            elements.append(text + (f"\n,{','.join(map(str, tail))}" if tail else ""))
    deck = "".join(f"GRID,{n},,{x},{y},0.\n" for (x, y), n in place.items())
    deck += "\n".join(elements)
    deck += f"\nPSHELL,1,1,{thick},1,,1\nMAT1,1,1.+7,,0.\n"
    stiffness = model(deck).matrices.stiffness.toarray()
    held = [
        6 * (n - 1) + k
        for (x, _), n in place.items()
        for k in range(6)
        if x == 0.0 or k == 5
    ]
    free = np.setdiff1d(np.arange(len(stiffness)), held)
    load, u = np.zeros((2, len(stiffness)))
    load[[6 * (place[4.0, y] - 1) + 4 for y in (0.0, width)]] = -0.5
    u[free] = np.linalg.solve(stiffness[np.ix_(free, free)], load[free])
    exact = 4.0**2 / 2.0 / (1e7 * width * thick**3 / 12.0)
    assert u[6 * (place[4.0, 0.0] - 1) + 2] == pytest.approx(exact, rel=0.07)


def test_triangles_without_mid_sides_are_sound(model):
    made = model(GRIDS + "CTRIA6,1,1,1,2,4,,9\nPSHELL,1,1,.02,1,,1\n" + STEEL)
    (block,) = made.blocks
    stiffness = block.stiffness()[0]
    value = np.linalg.eigvalsh(stiffness)
    rigid = rigid_modes(made.points, np.zeros(3))[block.dof[0]]
    assert block.dof.shape == (1, 24)
    assert np.abs(stiffness @ rigid).max() < 1e-11 * value[-1]
    assert value[6] > 1e-9 * value[-1]


@pytest.mark.parametrize("card", ["CQUAD8,1,1,1,2,3,4,5,6,+\n+,7,8,,,,,3",
                                  "CTRIA6,1,1,1,2,4,5,9,8,+\n+,3"])  # fmt: skip
def test_the_material_axis_of_an_isotropic_element_may_be_its_normal(model, card):
    flat = "".join(
        ",".join([*line.split(",")[:5], "0."]) + "\n" for line in GRIDS.splitlines()
    )
    system = "CORD2R,3,,0.,0.,0.,1.,0.,0.,+\n+,0.,0.,1.\n"  # x along z of the deck
    shell = "PSHELL,1,1,.02,1,,1\n" + STEEL
    (with_mcid,) = model(flat + system + card + "\n" + shell).blocks
    (plain,) = model(flat + card[:-1] + "\n" + shell).blocks
    np.testing.assert_array_equal(with_mcid.stiffness(), plain.stiffness())
    laminate = "PCOMP,1\n+,2,.02,0.\nMAT8,2,1.+11,1.+10,.3,5.+9,,,7800.\n"
    with pytest.raises(InputError, match="normal to the element"):
        model(flat + system + card + "\n" + laminate)


@pytest.mark.parametrize("card", ["CTRIA6", "CQUAD8"])
def test_few_elements_without_mid_sides_bend_where_shear_is_rigid(model, card):
    """A square held at three corners, a force at the fourth, MID3 blank.

    As many ties of shear as freedoms would hold it (3e-7). CTRIA6 deflects as MSC's do
    (deck api3 of pyNastran, grid 7504); CTRIA3 4.56e-3, a fine mesh of a square with
    two clamped edges 5e-3.
    """
    square = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,1.,1.,0.\n"
    cut = ["1,2,4", "4,3,1"] if card == "CTRIA6" else ["1,2,4,3"]
    shells = "".join(f"{card},{k + 1},1,{ids}\n" for k, ids in enumerate(cut))
    section = "PSHELL,1,1,.05,1\nMAT1,1,1.+7,,.25\nPARAM,K6ROT,0.\n"
    stiffness = model(square + shells + section).matrices.stiffness.toarray()
    free = stiffness[20:23, 20:23]
    deflection = np.linalg.solve(free, [2.0, 0.0, 0.0])[0]
    if card == "CTRIA6":
        assert deflection == pytest.approx(2.8355606e-3, rel=1e-6)
    assert 1e-3 < deflection < 6e-3
