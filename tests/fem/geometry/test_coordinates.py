"""Coordinate systems: axes, chains, cycles; results do not depend on the frame."""

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fem.deck.records import TABLES
from fem.errors import InputError
from fem.geometry.coordinates import BASIC, Frame, Frames, frame_from_points, resolve

CORD = list(TABLES["CORD"].columns)
GRID = list(TABLES["GRID"].columns)


def cord2(cid: int, kind: str, rid: int, abc) -> dict:
    names = [f"{p}{k}" for p in "abc" for k in "123"]
    row = dict.fromkeys(CORD, 0) | {"cid": cid, "type": kind, "form": 2, "rid": rid}
    return row | dict(zip(names, np.ravel(abc).tolist()))


def grids(*rows) -> pd.DataFrame:
    """Rows (id, cp, x1, x2, x3)."""
    return pd.DataFrame([(*row, 0, "", 0) for row in rows], columns=GRID)


def curvilinear(kind: str, local: np.ndarray) -> np.ndarray:
    """R, C or S coordinates of rectangular local ones, degrees."""
    x, y, z = local
    if kind == "R":
        return local
    if kind == "C":
        return np.array([np.hypot(x, y), np.degrees(np.arctan2(y, x)), z])
    r = np.linalg.norm(local)
    theta = np.degrees(np.arctan2(np.hypot(x, y), z))
    return np.array([r, theta, np.degrees(np.arctan2(y, x))])


numbers = st.floats(-10, 10).map(lambda x: round(x, 3))
triples = st.lists(numbers, min_size=9, max_size=9).map(
    lambda v: np.array(v).reshape(3, 3)
)
kinds = st.sampled_from("RCS")


@settings(max_examples=100, deadline=None)
@given(
    links=st.lists(st.tuples(kinds, triples), min_size=1, max_size=4),
    point=st.lists(numbers, min_size=3, max_size=3).map(np.array),
    backwards=st.booleans(),
)
def test_a_point_is_the_same_through_any_chain_of_frames(links, point, backwards):
    rows, parent, parent_id = [], BASIC, 0
    for cid, (kind, abc) in enumerate(links, start=1):
        frame = frame_from_points(kind, *abc)
        if frame is None or np.linalg.cond(frame.axes) > 2:
            return
        # The three points, written in the coordinates of the parent.
        local = [(p - parent.origin) @ parent.axes for p in abc]
        written = [curvilinear(parent.kind, p) for p in local]
        rows.append(cord2(cid, kind, parent_id, written))
        parent, parent_id = frame, cid
    coordinates = curvilinear(parent.kind, (point - parent.origin) @ parent.axes)
    cord = pd.DataFrame(rows[::-1] if backwards else rows)
    frames, xyz = resolve(cord, grids((1, parent_id, *coordinates)))
    # The axes of a chain lose the digits that near-collinear points cost.
    np.testing.assert_allclose(xyz[0], point, atol=1e-5)
    triad = frames.triads(np.array([parent_id]), xyz)[0]
    np.testing.assert_allclose(triad.T @ triad, np.eye(3), atol=1e-12)
    assert np.linalg.det(triad) == pytest.approx(1.0)


def test_axes_of_a_frame_follow_the_guide():
    frame = frame_from_points(
        "R", np.zeros(3), np.array([0, 2.0, 0]), np.array([3.0, 5, 0])
    )
    assert frame is not None
    # z along B, x towards C, y = z x x.
    np.testing.assert_allclose(
        frame.axes, [[1, 0, 0], [0, 0, 1], [0, -1, 0]], atol=1e-15
    )


def test_displacement_axes_turn_with_the_point():
    cylinder = Frame("C", np.zeros(3), np.eye(3))
    sphere = Frame("S", np.zeros(3), np.eye(3))
    np.testing.assert_allclose(
        cylinder.triads([0.0, 2.0, 5.0]), [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=1e-15
    )
    # At (1, 0, 0): r = x, theta = -z, phi = y.
    np.testing.assert_allclose(
        sphere.triads([1.0, 0.0, 0.0]), [[1, 0, 0], [0, 0, 1], [0, -1, 0]], atol=1e-15
    )


@pytest.mark.parametrize("kind", ["C", "S"])
def test_on_the_z_axis_the_rectangular_axes_serve(kind):
    frame = Frame(kind, np.ones(3), np.eye(3))
    np.testing.assert_array_equal(frame.triads([1.0, 1.0, 9.0]), np.eye(3))
    np.testing.assert_array_equal(frame.triads(frame.origin), np.eye(3))


def test_frames_by_grids_that_stand_in_frames():
    rows = [
        cord2(1, "C", 0, [[0, 0, 0], [0, 0, 1], [1, 0, 0]]),
        dict.fromkeys(CORD, 0)
        | {"cid": 2, "type": "R", "form": 1, "g1": 1, "g2": 2, "g3": 3},
    ]
    table = grids(
        (1, 1, 1.0, 90.0, 0.0),
        (2, 1, 1.0, 90.0, 1.0),
        (3, 1, 2.0, 90.0, 0.0),
        (4, 2, 1.0, 0.0, 0.0),
    )
    _, xyz = resolve(pd.DataFrame(rows), table)
    np.testing.assert_allclose(xyz[3], [0, 2, 0], atol=1e-15)


def test_cycles_and_undefined_frames_are_all_named():
    unit = [[0, 0, 0], [0, 0, 1], [1, 0, 0]]
    rows = [cord2(1, "R", 2, unit), cord2(2, "R", 1, unit), cord2(3, "R", 7, unit)]
    with pytest.raises(InputError) as caught:
        resolve(pd.DataFrame(rows), grids((1, 0, 0.0, 0.0, 0.0)))
    text = str(caught.value)
    assert "CORD2R 1: refers to coordinate system 2" in text
    assert "CORD2R 2: refers to coordinate system 1" in text
    assert "CORD2R 3: coordinate system 7 is not defined" in text


def test_unknown_frame_of_a_lookup_is_named():
    with pytest.raises(InputError, match="coordinate system 5"):
        Frames({})[5]
