"""RSSCON: an edge of a shell clamped between the faces of a solid.

A grid of the shell lies on the line from grid A to grid B of the solid, at a share λ of
it; d is the line's direction, L its length:

    u = (1 - λ) u_A + λ u_B,    θ - d (d · θ) = d x (u_B - u_A) / L

The rotation about the line remains the shell's. MSC's rs321h has these relations at
corner grids to the printed digits; at mid-side grids, which are clamped alike here, its
rotations follow another rule (tip of the plate 0.6 % softer). The grid of the shell may
be one of the solid's, whose rotations then follow. By elements, the grids of the shell
look for the pairs of the solid whose line runs across the shell through them; grids may
lie 5 % of its length beside it.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.constraints.equations import Equations, dense_equations
from fem.deck.records import topologies
from fem.deck.references import table, where
from fem.elements.lines.line_geometry import skew
from fem.errors import InputError, Problems
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_BESIDE = 0.05
_ACROSS = 0.7  # cosine between line and normal of the shell, at least


@dataclass(frozen=True)
class _Tie:
    """A grid of a shell between two of a solid: ids."""

    shell: int
    a: int
    b: int


def read_shell_to_solid(deck: "Deck", points: Points) -> list[Equations]:
    """Equations of all RSSCON.

    Raises:
        InputError: elements that are not there, an edge that does not lie in the solid.
    """
    equations, problems, done = [], Problems(), set()
    for _, row in table(deck, "RSSCON").iterrows():
        ties = []
        with problems.gathered(where("RSSCON", row)):
            ties = list(_ties(deck, points, row))
        for tie in ties:
            # Neighbours share a grid.
            if tie.shell not in done:
                done.add(tie.shell)
                equations.append(_equations(points, tie, f"RSSCON {row['eid']}"))
    problems.report()
    return equations


def _ties(deck: "Deck", points: Points, row: pd.Series) -> Iterator[_Tie]:
    if row["type"] == "GRID":
        for end in "12":
            shell, a, b = (int(row[f"{name}{end}"]) for name in "sab")
            if shell:
                if not a or not b:
                    raise InputError(f"ES{end} {shell} needs EA{end} and EB{end}")
                yield _Tie(shell, a, b)
        return
    shell = _grids(deck, int(row["shell"]), "surface")
    solid = _grids(deck, int(row["solid"]), "solid")
    found = list(_by_place(points, shell, solid))
    if len(found) < 2:
        raise InputError(
            f"no edge of the shell {row['shell']} lies between grids of the solid "
            f"{row['solid']}; expected it on lines from face to face"
        )
    yield from found


def _grids(deck: "Deck", eid: int, kind: str) -> list[int]:
    """Grids of an element, corners first."""
    for name, topology in topologies(kind).items():
        rows = table(deck, name)
        own = rows[rows["eid"] == eid] if len(rows) else rows
        if len(own):
            values = [np.ravel(own.iloc[0][c]) for c in topology.grids]
            return [int(g) for g in np.concatenate(values) if g > 0]
    raise AssertionError(f"{kind} {eid}: references are checked before")


def _by_place(points: Points, shell: list[int], solid: list[int]) -> Iterator[_Tie]:
    """Grids of a shell that lie between two of a solid, across the shell."""
    count = 3 if len(shell) in (3, 6) else 4
    corners = points.xyz[points.rows(shell[:count])]
    normal = np.cross(corners[1] - corners[0], corners[-1] - corners[0])
    normal /= np.linalg.norm(normal)
    at = points.xyz[points.rows(solid)]
    i, j = np.triu_indices(len(solid), 1)
    line = at[j] - at[i]
    length = np.linalg.norm(line, axis=1)
    across = np.abs(line @ normal) > _ACROSS * length
    for grid in shell:
        to = points.xyz[points.rows(grid)] - at[i]
        share = np.einsum("ij,ij->i", to, line) / length**2
        beside = np.linalg.norm(to - share[:, None] * line, axis=1)
        inside = (share > -_BESIDE) & (share < 1.0 + _BESIDE)
        fits = np.flatnonzero(across & inside & (beside <= _BESIDE * length))
        if len(fits):
            # From face to face: a mid-side grid may lie between.
            best = fits[np.argmax(length[fits])]
            yield _Tie(grid, solid[i[best]], solid[j[best]])


def _equations(points: Points, tie: _Tie, source: str) -> Equations:
    row, *solid = points.rows([tie.shell, tie.a, tie.b])
    x, a, b = points.xyz[[row, *solid]]
    line = b - a
    length = np.linalg.norm(line)
    if not length:
        raise InputError(f"{source}: EA and EB of grid {tie.shell} coincide")
    share = (x - a) @ line / length**2
    to_shell = points.rotation[row].T
    # Translations of A and B, rotations of the shell's own grid; displacement frames.
    matrix = np.zeros((6, 9))
    columns = np.concatenate([*(6 * at + np.arange(3) for at in solid), []])
    columns = np.append(columns, 6 * row + 3 + np.arange(3)).astype(np.int64)
    d = line / length
    across = to_shell @ skew(d) / length
    for k, (at, part, sign) in enumerate(zip(solid, (1.0 - share, share), (-1.0, 1.0))):
        own = slice(3 * k, 3 * k + 3)
        matrix[:3, own] = part * to_shell @ points.rotation[at]
        matrix[3:, own] = sign * across @ points.rotation[at]
    # One rotation is free: that nearest to the line; the others follow it.
    d = to_shell @ d
    kept = int(np.argmax(np.abs(d)))
    lean = d / d[kept]
    matrix[3:] -= np.outer(lean, matrix[3 + kept])
    matrix[3:, 6 + kept] += lean
    matrix[np.abs(matrix) < 1e-14] = 0.0
    wanted = np.ones(6, bool)
    wanted[3 + kept] = False
    wanted[:3] &= tie.shell not in (tie.a, tie.b)
    rows = np.flatnonzero(wanted & ~points.ps[row])
    return dense_equations(6 * row + rows, columns, matrix[rows], source)
