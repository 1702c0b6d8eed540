"""Checked reductions, found again by the content of what they were made from."""

from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path

import numpy as np
import pandas as pd

from drake_landing.cache import Arrays, Cache, content_key
from drake_landing.reduced.checks import ReductionChecks, check_reduction
from drake_landing.reduced.make import Method, reduce_structure
from drake_landing.reduced.model import ReducedModel
from fem.algebra.linear_solver import SingularMatrixError
from fem.algebra.modes import ModesError
from fem.model.structure import Structure

# Of the program that makes them: entries of another one are never found.
_VERSION = 2
_TABLES = ("mass", "rigid", "modes", "counts")
_TEXTS = ("source", "notices")


def checked_reduction(
    structure: Structure,
    grids: Sequence[int],
    method: Method,
    *,
    highest_hz: float,
    count: int,
    compare_hz: float,
    cache: Cache,
) -> tuple[ReducedModel, ReductionChecks]:
    """A reduced model with its checks, computed where the cache has none.

    Args:
        structure, grids, method, highest_hz, count: see `reduce_structure`.
        compare_hz: modes of the full model up to here are compared.
        cache: where it is kept: by the deck's text, its matrices, and these settings.

    Raises:
        InputError: see `reduce_structure`.
    """
    damping = structure.damping
    key = content_key(
        *(_VERSION, Path(structure.deck.path).name, _text(structure)),
        *(structure.stiffness, structure.mass),
        *(damping.stiffness_factor, damping.mass_factor, damping.other),
        *(sorted({int(i) for i in grids}), method, highest_hz, count, compare_hz),
    )

    def build() -> Arrays:
        reduced = reduce_structure(
            structure, grids, method, highest_hz=highest_hz, count=count
        )
        checks = structure.guarded(
            lambda: check_reduction(structure, reduced, compare_hz),
            dynamic=True,  # a stick without rotary inertia spins without mass
            error=(SingularMatrixError, ModesError),
        )
        return _arrays(reduced.model, checks)

    return _restored(cache.arrays("reduction", key, build))


def _text(structure: Structure) -> str:
    """The deck's own file: its comments name what moves in the modes."""
    path = Path(structure.deck.path)
    return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""


def _arrays(model: ReducedModel, checks: ReductionChecks) -> Arrays:
    found: Arrays = {
        f"model-{item.name}": np.asarray(getattr(model, item.name))
        for item in fields(ReducedModel)
        if item.name not in _TEXTS
    }
    found["model-source"] = np.array([model.source])
    found["model-notices"] = np.array([*model.notices], dtype=str)
    found["rigid_modes"] = np.array(checks.rigid_modes)
    for name in _TABLES:
        table: pd.DataFrame = getattr(checks, name)
        found[f"{name}-columns"] = np.array([*table.columns])
        for k, column in enumerate(table.columns):
            values = table[column].to_numpy()
            found[f"{name}-{k}"] = (
                values if values.dtype.kind in "if" else _words(values)
            )
    return found


def _words(values: np.ndarray) -> np.ndarray:
    return np.array([str(value) for value in values], dtype=str)


def _restored(found: Arrays) -> tuple[ReducedModel, ReductionChecks]:
    parts = {
        item.name: found[f"model-{item.name}"]
        for item in fields(ReducedModel)
        if item.name not in _TEXTS
    }
    model = ReducedModel(
        **parts,
        source=str(found["model-source"][0]),
        notices=tuple(map(str, found["model-notices"])),
    )
    tables = {
        name: pd.DataFrame(
            {
                str(column): _column(found[f"{name}-{k}"])
                for k, column in enumerate(found[f"{name}-columns"])
            }
        )
        for name in _TABLES
    }
    return model, ReductionChecks(**tables, rigid_modes=int(found["rigid_modes"]))


def _column(values: np.ndarray) -> np.ndarray | list[str]:
    return values if values.dtype.kind in "if" else [str(value) for value in values]
