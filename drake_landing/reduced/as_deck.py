"""A reduced model as a deck: all that works on decks works on a user's matrices.

The file holds the grids and lines between neighbours for pictures; matrices and the
motion of following grids (MPC) are put in beside it, with all their digits.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.sparse.csgraph
from scipy.spatial.distance import cdist

from drake_landing.reduced.model import ReducedModel
from fem.deck.deck import Deck
from fem.deck.reader import read_deck
from fem.files.atomic import write_aside
from fem.files.deck_writer import DeckText, Section
from fem.matrix_files.named import NamedMatrix

_MPC = 1


def write_grids_deck(path: Path, model: ReducedModel) -> None:
    """The bulk data without the matrices."""
    grids, lines = Section("interface grids"), Section("lines for pictures")
    for i, p in zip(model.grid_id.tolist(), model.p.tolist()):
        grids.add("GRID", i, None, *map(float, p), wide=True)
    for i in model.generalised_id.tolist():
        grids.add("SPOINT", i)
    for k, (a, b) in enumerate(_neighbours(model.p)):
        ends = int(model.grid_id[a]), int(model.grid_id[b])
        lines.add("PLOTEL", k + 1, *ends)
    text = DeckText(
        title=f"interface of {model.source}",
        executive=["SOL 103"],
        case_control=["TITLE = REDUCED AIRFRAME"],
        sections=[grids, lines],
    ).text()
    write_aside(path, lambda part: part.write_text(text, encoding="utf-8"))


def deck_with_matrices(path: Path, model: ReducedModel) -> Deck:
    """The deck of that file with K2GG, M2GG, B2GG and MPC of a model."""
    deck = read_deck(path)
    file = {"file": str(path), "line": 1}
    matrices = [m for m in model.matrices() if m.name != "RRED"]
    dmig = [{**_dmig(matrix), **file} for matrix in matrices]
    mpc = [{**row, **file} for row in _followers(model)]
    cards = {
        **deck.cards,
        "DMIG": pd.DataFrame(dmig, columns=deck.cards["DMIG"].columns),
        "MPC": pd.DataFrame(mpc, columns=deck.cards["MPC"].columns),
    }
    subcase = replace(
        deck.case_control[0],
        k2gg="KRED",
        m2gg="MRED",
        b2gg="BRED" if model.damping.any() else "",
        mpc=_MPC if mpc else 0,
    )
    notices = (*deck.notices, *model.notices)
    return replace(deck, cards=cards, case_control=(subcase,), notices=notices)


def _dmig(matrix: NamedMatrix) -> dict:
    assert matrix.rows is not None
    i, j = np.nonzero(matrix.values)
    return {
        "name": matrix.name,
        "form": 6,
        "rowids": matrix.rows[i, 0],
        "rowcs": matrix.rows[i, 1],
        "colids": matrix.rows[j, 0],
        "colcs": matrix.rows[j, 1],
        "values": matrix.values[i, j],
    }


def _followers(model: ReducedModel) -> list[dict]:
    """One equation u_r - R u = 0 for each component that follows."""
    labels, rows = model.labels, []
    for (grid, component), row in zip(model.following.tolist(), model.recovery):
        used = np.flatnonzero(row)
        rows.append(
            {
                "sid": _MPC,
                "grids": np.concatenate([[grid], labels[used, 0]]),
                "comps": np.concatenate([[component], labels[used, 1]]),
                "coefficients": np.concatenate([[-1.0], row[used]]),
            }
        )
    return rows


def _neighbours(p: npt.NDArray[np.float64]) -> list[tuple[int, int]]:
    """Edges of the shortest net that connects all points."""
    # A distance of zero would be no edge at all.
    net = scipy.sparse.csgraph.minimum_spanning_tree(cdist(p, p) + 1e-9).tocoo()
    return list(zip(net.row.tolist(), net.col.tolist()))
