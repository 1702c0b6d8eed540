"""PLOAD2 and PLOAD4: resultants, distribution, faces of solids."""

import numpy as np
import pytest

from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.loads.faces import Faces, face_forces
from fem.loads.pressure import pload4
from fem.model.points import read_points

SQUARE = """\
GRID,1
GRID,2,,2.
GRID,3,,2.,3.
GRID,4,,0.,3.
MAT1,1,7.+10,,.3
PSHELL,1,1,.01,1,,1
"""


def test_uniform_pressure_on_a_rectangle_goes_to_its_corners(loaded):
    result = loaded(SQUARE + "CQUAD4,1,1,1,2,3,4\nPLOAD2,1,5.,1\n")
    for grid in (1, 2, 3, 4):
        np.testing.assert_allclose(result.at(grid), [0, 0, 7.5, 0, 0, 0], atol=1e-14)


def test_pressure_on_an_area_between_grids(loaded):
    quad = loaded(SQUARE + "PLOAD,1,5.,1,2,3,4\n").at(3)
    np.testing.assert_allclose(quad[:3], [0, 0, 7.5], atol=1e-14)
    triangle = loaded(SQUARE + "PLOAD,1,5.,1,4,2\n").at(4)
    np.testing.assert_allclose(triangle[:3], [0, 0, -5], atol=1e-14)


def test_uniform_pressure_on_a_triangle(loaded):
    result = loaded(SQUARE + "CTRIA3,1,1,1,4,2\nPLOAD4,1,1,5.\n")
    for grid in (1, 2, 4):
        np.testing.assert_allclose(result.at(grid)[2], -5.0, atol=1e-14)


def test_bilinear_pressure_has_its_center_of_pressure(loaded):
    # p = 1 + x + 2 y + 3 x y / ... given by its corners, which is all there is.
    bulk = "CQUAD4,1,1,1,2,3,4\nPLOAD4,1,1,1.,3.,9.,7.\n"
    result = loaded(SQUARE + bulk).resultant()
    # p = 1 + x + 2 y over 2 x 3.
    force = 6 * (1 + 1 + 3)
    m_x = (3 * 3 / 2) * 2 + 3 * 3 / 2 * 2 + 2 * 2 * 9
    m_y = -((2 * 3) + (8 / 3) * 3 + 2 * 2 * 4.5)
    np.testing.assert_allclose(result, [0, 0, force, m_x, m_y, 0], atol=1e-12)


def test_pressure_with_a_direction_acts_along_it_on_the_true_area(loaded):
    bulk = SQUARE + "CQUAD4,1,1,1,2,3,4\nPLOAD4,1,1,5.\n,,3.,0.,4.\n"
    np.testing.assert_allclose(
        loaded(bulk).resultant()[:3], 30 * np.array([0.6, 0, 0.8]), atol=1e-12
    )


def test_warped_quadrilateral_has_the_resultant_of_its_boundary(loaded):
    """The vector area of a surface depends on its edge alone."""
    bulk = SQUARE.replace("GRID,3,,2.,3.", "GRID,3,,2.,3.,.7")
    result = loaded(bulk + "CQUAD4,1,1,1,2,3,4\nPLOAD4,1,1,1.\n").resultant()
    xyz = np.array([[0, 0, 0], [2, 0, 0], [2, 3, 0.7], [0, 3, 0]])
    area = 0.5 * np.cross(xyz[2] - xyz[0], xyz[3] - xyz[1])
    np.testing.assert_allclose(result[:3], area, atol=1e-12)


def test_many_elements_by_thru(loaded):
    bulk = SQUARE + "CTRIA3,1,1,1,2,3\nCTRIA3,2,1,1,3,4\nPLOAD4,1,1,5.,,,,THRU,2\n"
    assert loaded(bulk).resultant()[2] == pytest.approx(30.0)


def test_edge_loads_are_named(loaded):
    bulk = SQUARE + "CQUAD4,1,1,1,2,3,4\nPLOAD4,1,1,5.\n,,,,,LINE\n"
    with pytest.raises(InputError, match="SORL LINE is not supported"):
        loaded(bulk)


HEXA = np.array(
    [[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], float
)
PENTA = np.array(
    [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], float
)
TETRA = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
PYRAM = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]], float)
MIDDLES = {
    "CHEXA": "01 12 23 30 04 15 26 37 45 56 67 74",
    "CPENTA": "01 12 20 03 14 25 34 45 53",
    "CTETRA": "01 12 20 03 13 23",
    "CPYRAM": "01 12 23 30 04 14 24 34",
}
# Pairs G1, G3 or G4 that name every face once.
ALL_FACES = {
    "CHEXA": [(1, 3), (5, 7), (1, 6), (2, 7), (3, 8), (4, 5)],
    "CPENTA": [(1, 0), (4, 0), (1, 5), (2, 6), (3, 4)],
    "CTETRA": [(1, 4), (1, 3), (2, 1), (3, 2)],
    "CPYRAM": [(1, 3), (1, 2), (2, 3), (3, 4), (4, 1)],
}
SHAPES = {"CHEXA": HEXA, "CPENTA": PENTA, "CTETRA": TETRA, "CPYRAM": PYRAM}


def solid(tmp_path, card: str, quadratic: bool, faces, pressure=2.0):
    """Points and total nodal forces (g, 3) of pressure on faces of a sheared solid."""
    shear = np.array([[1.0, 0.2, 0.1], [0.0, 1.1, 0.3], [0.2, 0.0, 0.9]])
    xyz = SHAPES[card] @ shear
    if quadratic:
        pairs = [(int(p[0]), int(p[1])) for p in MIDDLES[card].split()]
        xyz = np.concatenate([xyz, [(xyz[a] + xyz[b]) / 2 for a, b in pairs]])
    lines = [
        f"GRID,{k + 1},,{x:.8f},{y:.8f},{z:.8f}" for k, (x, y, z) in enumerate(xyz)
    ]
    nodes = [str(k + 1) for k in range(len(xyz))]
    rows = [nodes[:6]] + [nodes[k : k + 8] for k in range(6, len(nodes), 8)]
    lines.append(f"{card},1,1," + ",".join(rows[0]))
    lines += ["," + ",".join(row) for row in rows[1:]]
    lines += ["PSOLID,1,1", "MAT1,1,7.+10,,.3"]
    for g1, g34 in faces:
        lines.append(f"PLOAD4,1,1,{pressure},,,,{g1},{g34 or ''}")
    path = tmp_path / "a.bdf"
    path.write_text("\n".join(lines))
    deck = read_deck(path)
    points = read_points(deck)
    dof, value = pload4(deck, points, deck.cards["PLOAD4"])
    total = np.zeros(points.size)
    np.add.at(total, dof, value)
    return points, total.reshape(-1, 6)[:, :3]


@pytest.mark.parametrize("quadratic", [False, True])
@pytest.mark.parametrize("card", SHAPES)
def test_pressure_all_round_a_solid_has_no_resultant(tmp_path, card, quadratic):
    points, forces = solid(tmp_path, card, quadratic, ALL_FACES[card])
    np.testing.assert_allclose(forces.sum(axis=0), 0.0, atol=1e-7)
    moment = np.cross(points.xyz, forces).sum(axis=0)
    np.testing.assert_allclose(moment, 0.0, atol=1e-7)


@pytest.mark.parametrize("quadratic", [False, True])
@pytest.mark.parametrize("card", SHAPES)
def test_pressure_pushes_inwards(tmp_path, card, quadratic):
    points, _ = solid(tmp_path, card, quadratic, ALL_FACES[card][:1])
    center = points.xyz[: len(SHAPES[card])].mean(axis=0)
    for face in ALL_FACES[card]:
        _, forces = solid(tmp_path, card, quadratic, [face])
        loaded = np.linalg.norm(forces, axis=1) > 1e-9
        towards = center - points.xyz[loaded].mean(axis=0)
        assert forces.sum(axis=0) @ towards > 0.0


def test_quadratic_face_is_loaded_as_its_shape_functions_say(tmp_path):
    _, forces = solid(tmp_path, "CHEXA", True, [(1, 3)])
    size = np.linalg.norm(forces, axis=1)
    total = np.linalg.norm(forces.sum(axis=0))
    # Uniform pressure on eight nodes: corners -1/12, mid-sides 1/3.
    np.testing.assert_allclose(size[[0, 1, 2, 3]] / total, 1 / 12, rtol=1e-6)
    np.testing.assert_allclose(size[[8, 9, 10, 11]] / total, 1 / 3, rtol=1e-6)


def test_absent_mid_sides_fall_to_their_corners(tmp_path):
    points, _ = solid(tmp_path, "CHEXA", True, [(1, 3)])
    corners = np.array([[1, 2, 3, 4]])
    pressure, direction = np.array([[1.0, 2.0, 3.0, 5.0]]), np.full((1, 3), np.nan)
    results = []
    for middles in ([0, 0, 0, 0], [9, 0, 0, 12], [9, 10, 11, 12]):
        faces = Faces(
            corners=corners,
            middles=np.array([middles]),
            pressure=pressure,
            direction=direction,
        )
        at, forces = face_forces(points, faces)
        moment = np.cross(points.xyz[at], forces).sum(axis=0)
        results.append(np.concatenate([forces.sum(axis=0), moment]))
    np.testing.assert_allclose(results[1], results[0], atol=1e-12)
    np.testing.assert_allclose(results[2], results[0], atol=1e-12)


def test_grids_that_name_no_face_are_an_error(tmp_path):
    with pytest.raises(InputError, match="1, 2 name no face of CHEXA 1"):
        solid(tmp_path, "CHEXA", False, [(1, 2)])
