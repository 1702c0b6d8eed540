"""Points: numbering of the g-set, displacement frames, permanent constraints."""

from pathlib import Path

import numpy as np
import pytest

from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.geometry.points import Points
from fem.model.points import axis_notices, read_points

DECK = """\
CORD2C,1,,0.,0.,0.,0.,0.,1.
,1.,0.,0.
GRID,20,,0.,3.,0.,1,45
GRID,7,1,2.,90.,1.
SPOINT,5,91
"""


@pytest.fixture
def points(tmp_path: Path) -> Points:
    path = tmp_path / "a.bdf"
    path.write_text(DECK)
    return read_points(read_deck(path))


def test_grids_ascend_and_stand_in_the_basic_frame(points):
    assert points.grid_id.tolist() == [7, 20]
    np.testing.assert_allclose(points.xyz, [[0, 2, 1], [0, 3, 0]], atol=1e-15)
    assert points.ps.tolist() == [[False] * 6, [False] * 3 + [True, True, False]]
    assert points.size == 14


def test_rows_and_labels_of_the_g_set(points):
    assert points.dof([7, 20, 5, 91, 0], [1, 6, 0, 1, 3]).tolist() == [
        0,
        11,
        12,
        13,
        -1,
    ]
    assert points.dof(20, np.arange(1, 7)).tolist() == [6, 7, 8, 9, 10, 11]
    labels = [points.label(k) for k in (0, 11, 13)]
    assert labels == ["grid 7 T1", "grid 20 R3", "scalar point 91"]


def test_unknown_points_and_components_are_all_named(points):
    with pytest.raises(InputError, match=r"grids 8, 9 are not defined"):
        points.rows([7, 9, 8])
    with pytest.raises(InputError) as caught:
        points.dof([7, 20, 91], [0, 7, 2])
    assert len(caught.value.problems) == 3


def test_rotation_to_the_basic_frame(points):
    u = np.zeros(14)
    u[6:9], u[9:12], u[13] = [1, 2, 3], [4, 5, 6], 9
    basic = points.basic_rotation() @ u
    # Grid 20 lies on the y axis: r is y, theta is -x.
    np.testing.assert_allclose(basic[6:12], [-2, 1, 3, -5, 4, 6], atol=1e-14)
    assert basic[13] == 9
    r = points.basic_rotation()
    np.testing.assert_allclose((r.T @ r).toarray(), np.eye(14), atol=1e-14)


def test_undefined_displacement_frame_is_named(tmp_path):
    path = tmp_path / "a.bdf"
    path.write_text("GRID,1,,0.,0.,0.,9\n")
    with pytest.raises(InputError, match="coordinate system 9"):
        read_deck(path)


def test_model_of_scalar_points_alone(tmp_path):
    path = tmp_path / "a.bdf"
    path.write_text("SPOINT,1,THRU,3\n")
    points = read_points(read_deck(path))
    assert points.size == 3
    assert points.basic_rotation().shape == (3, 3)
    assert points.label(1) == "scalar point 2"


def test_grids_on_the_axis_of_their_system_are_said(tmp_path):
    """There r and theta have no direction: x and y of the system serve."""
    path = tmp_path / "a.bdf"
    path.write_text(
        "CORD2C,4,,1.,2.,3.,0.,0.,1.\n,0.,1.,0.\nGRID,7,,0.,0.,1.,4\n"
        "GRID,8,,1.,0.,1.,4\nGRID,9,,0.,0.,1.\n"
    )
    deck = read_deck(path)
    (notice,) = axis_notices(deck, read_points(deck))
    assert notice.startswith("GRID 7: on the z axis of its displacement system CD 4")
