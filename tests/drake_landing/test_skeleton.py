"""Lines of an airframe for pictures."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.skeleton import Skeleton, element_edges
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
    deck = read_deck(Path(__file__).with_name("tiny_aircraft.bdf"))
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
