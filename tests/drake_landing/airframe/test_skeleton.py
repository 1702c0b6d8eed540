"""Lines of an airframe for pictures."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from drake_landing.airframe.skeleton import Skeleton, element_edges, element_faces
from fem.deck.reader import read_deck


def plate(n: int) -> Skeleton:
    """n times n squares of 1 m with one mode, z = x."""
    x, y = np.meshgrid(np.arange(n + 1.0), np.arange(n + 1.0), indexing="ij")
    p = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    number = np.arange(x.size).reshape(x.shape)
    along = np.column_stack([number[:-1].ravel(), number[1:].ravel()])
    across = np.column_stack([number[:, :-1].ravel(), number[:, 1:].ravel()])
    shape = np.zeros((len(p), 3, 1))
    shape[:, 2, 0] = p[:, 0]
    return Skeleton(p=p, shape=shape, edges=np.vstack([along, across]))


def test_edges_of_the_tiny_aircraft() -> None:
    deck = read_deck(Path(__file__).parents[1] / "tiny_aircraft.bdf")
    ids = np.sort(deck.cards["GRID"]["id"].to_numpy())
    edges = ids[element_edges(deck.cards, ids)]
    assert len(edges) == 19 + 3  # bars and rigid elements
    assert [1, 2] in edges.tolist()
    assert [2, 51] in edges.tolist()


def test_a_coarse_net_stays_connected_and_keeps_its_extent() -> None:
    fine = plate(60)
    rows, coarse = fine.thinned(500)
    assert 150 < len(coarse.edges) <= 500
    assert np.array_equal(coarse.p, fine.p[rows])
    assert np.ptp(coarse.p, axis=0) == pytest.approx([60, 60, 0], abs=6)
    reached, front = {0}, {0}
    while front:
        touching = coarse.edges[np.isin(coarse.edges, list(front)).any(axis=1)]
        front = set(touching.ravel().tolist()) - reached
        reached |= front
    assert len(reached) == len(rows)


def test_a_small_net_stays_as_it_is() -> None:
    rows, same = plate(4).thinned(500)
    assert len(rows) == 25
    assert np.array_equal(same.edges, plate(4).edges)


def test_deformation() -> None:
    net = plate(3)
    moved = net.deformed(np.array([0.5]), 10.0)
    assert moved[:, 2] == pytest.approx(5 * net.p[:, 0])


def test_faces_are_merged_with_the_lines() -> None:
    fine = plate(60)
    number = np.arange(61 * 61).reshape(61, 61)
    corners = [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]
    a, b, c, d = (corner.ravel() for corner in corners)
    faces = np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    fine = replace(fine, faces=faces)
    _, coarse = fine.thinned(500)
    assert 0 < len(coarse.faces) < len(faces) / 4
    u, v = (coarse.p[coarse.faces[:, i]] - coarse.p[coarse.faces[:, 0]] for i in (1, 2))
    area = 0.5 * np.linalg.norm(np.cross(u, v), axis=1)
    assert area.min() > 0.0
    covered = np.ptp(coarse.p[:, 0]) * np.ptp(coarse.p[:, 1])
    assert area.sum() == pytest.approx(covered, rel=0.25)
    assert np.array_equal(fine.thinned(10**6)[1].faces.shape, faces.shape)


def test_a_quadrilateral_gives_two_triangles() -> None:
    corners = {"g1": [1], "g2": [2], "g3": [4], "g4": [3]}
    none = {name: [] for name in corners}
    cards = {
        "CQUAD4": pd.DataFrame(corners),
        "CTRIA3": pd.DataFrame(none)[["g1", "g2", "g3"]],
        "CSHEAR": pd.DataFrame(none),
    }
    faces = element_faces(cards, np.array([1, 2, 3, 4]))
    assert faces.tolist() == [[0, 1, 3], [0, 3, 2]]
