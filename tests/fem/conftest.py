"""Models from a few lines of bulk data."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from fem.constraints.elimination import Elimination, eliminate
from fem.deck.deck import Deck
from fem.deck.reader import read_deck
from fem.elements.block import ElementBlock
from fem.elements.registry import read_elements
from fem.geometry.points import Points
from fem.model.assembly import Matrices, assemble
from fem.model.direct_input import read_direct
from fem.model.points import read_points


@dataclass(frozen=True)
class Model:
    """A deck with everything that its first subcase selects, put together."""

    deck: Deck
    points: Points
    blocks: list[ElementBlock]
    matrices: Matrices
    elimination: Elimination


def build_model(path: Path) -> Model:
    """The model of a deck, without AUTOSPC."""
    deck = read_deck(path)
    points = read_points(deck)
    case = deck.case_control[0]
    blocks = read_elements(deck, points, nsm=case.nsm)
    matrices = assemble(
        points,
        blocks,
        coupled=int(deck.param("COUPMASS")) > 0,
        wtmass=float(deck.param("WTMASS")),
        direct=read_direct(
            deck, points, k2gg=case.k2gg, m2gg=case.m2gg, b2gg=case.b2gg
        ),
    )
    elimination = eliminate(deck, points, spc=case.spc, mpc=case.mpc)
    return Model(deck, points, blocks, matrices, elimination)


@pytest.fixture
def model(tmp_path: Path) -> Callable[..., Model]:
    """Function from bulk data (and case control) to a Model."""

    def make(bulk: str, case: str = "") -> Model:
        path = tmp_path / "model.bdf"
        path.write_text(f"SOL 101\nCEND\n{case}\nBEGIN BULK\n{bulk}\nENDDATA\n")
        return build_model(path)

    return make


@pytest.fixture
def reference_model(references: Path) -> Callable[[str], Model]:
    """Function from a path within the reference decks to a Model."""

    def make(name: str) -> Model:
        return build_model(references / name)

    return make
