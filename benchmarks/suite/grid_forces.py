"""Each element of a deck under the displacements of another program's file.

    python -m benchmarks.suite.grid_forces DECK OP2

Where a file holds displacements and grid point forces, -K u of every element must be
the forces that the element has there: an element with another formula is found, where
displacements alone only say that something differs.
"""

import argparse
import logging
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from fem.arrays import Float64
from fem.deck.reader import read_deck
from fem.deck.text.source import include_reach
from fem.model.structure import Structure


def main() -> None:
    """One line per element: the largest difference over its largest force."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.suite.grid_forces")
    parser.add_argument("deck", type=Path)
    parser.add_argument("op2", type=Path)
    asked = parser.parse_args()
    with include_reach([asked.deck.parent]):
        structure = Structure(read_deck(asked.deck))
    for (element, card), value in sorted(compared(structure, asked.op2).items()):
        print(f"{element:8d} {card:8s} {value:.1e}")


def compared(structure: Structure, op2: Path) -> dict[tuple[int, str], float]:
    """Largest difference of forces of an element over the largest of them, all states.

    Args:
        structure: of the deck.
        op2: with displacements (or shapes) and grid point forces.
    """
    worst: dict[tuple[int, str], float] = {}
    for u, forces in _states(structure, op2):
        for block in structure.blocks:
            stiffness = block.stiffness()
            if stiffness is None:
                continue
            turn = structure.points.basic_rotation()
            turned = turn if block.frame == "basic" else None
            moved = u if turned is None else turned @ u
            for number, dof, own in zip(np.atleast_1d(block.id), block.dof, stiffness):
                ours = np.zeros(len(u), u.dtype)
                np.add.at(ours, dof, -(own @ moved[dof]))
                ours = ours if turned is None else turned.T @ ours
                key = int(number), block.card
                value = _difference(structure, ours, forces.get(int(number), {}))
                worst[key] = max(worst.get(key, 0.0), value)
    return worst


def _difference(
    structure: Structure, ours: Float64, theirs: Mapping[int, Float64]
) -> float:
    grids = {*structure.points.grid_id.tolist()}
    theirs = {grid: row for grid, row in theirs.items() if grid in grids}
    if not theirs:
        return 0.0
    rows = structure.points.rows(list(theirs))
    found = ours[: 6 * len(structure.points.grid_id)].reshape(-1, 6)[rows]
    printed = np.array(list(theirs.values()))
    size = np.abs(printed).max()
    return float(np.abs(found - printed).max() / size) if size else 0.0


def _states(structure: Structure, op2: Path) -> list[tuple[Any, dict]]:
    """(g,) displacements and {element: {grid: (6,) force}} of all states."""
    from pyNastran.op2.op2 import read_op2

    logging.disable(logging.WARNING)
    model = read_op2(str(op2), build_dataframe=False, debug=None)
    logging.disable(logging.NOTSET)
    shapes = model.displacements or model.eigenvectors
    points = structure.points
    states = []
    for key, table in shapes.items():
        forces = model.grid_point_forces.get(key)
        if forces is None:
            continue
        ids = table.node_gridtype[:, 0]
        known = np.isin(ids, points.grid_id)
        rows = points.rows(ids[known])
        for k, values in enumerate(table.data):
            u = np.zeros((len(points.grid_id), 6), values.dtype)
            u[rows] = values[known]
            whole = np.zeros(points.size, values.dtype)
            whole[: u.size] = u.ravel()
            states.append((whole, _by_element(forces, k)))
    return states


def _by_element(forces: Any, state: int) -> dict[int, dict[int, Float64]]:
    pairs, names = forces.node_element, forces.element_names
    pairs = pairs if pairs.ndim == 2 else pairs[state]
    names = names if names.ndim == 1 else names[state]
    found: dict[int, dict[int, Float64]] = {}
    for (grid, element), name, row in zip(pairs, names, forces.data[state]):
        if element > 0 and not str(name).strip().startswith(("APP", "F-OF")):
            found.setdefault(int(element), {}).setdefault(int(grid), row)
    return found


if __name__ == "__main__":
    main()
