"""Components that a case names: by properties, elements, sets, materials or files."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.case.parts import Component
from fem.errors import InputError, Problems, nearest
from fem.model.structure import Structure

Bool = npt.NDArray[np.bool_]


def members(
    structure: Structure, elements: pd.DataFrame, components: Mapping[str, Component]
) -> dict[str, Bool]:
    """(e,) which elements belong to each component; the first that fits has them.

    Args:
        structure: of the deck.
        elements: columns `id`, `pid`, `material`, `file`.
        components: by name.

    Raises:
        InputError: what a component names and the deck has not.
    """
    free = np.ones(len(elements), bool)
    found: dict[str, Bool] = {}
    problems = Problems()
    for name, component in components.items():
        own = np.zeros(len(elements), bool)
        for key, chosen, there in (
            ("properties", component.properties, elements.pid),
            ("materials", component.materials, elements.material),
            ("elements", component.elements, elements.id),
            ("sets", _members(structure, component.sets), elements.id),
            ("files", component.files, elements.file.map(lambda f: Path(f).name)),
        ):
            for item in chosen:
                fits = _fits(item, there)
                if not fits.any():
                    known = [str(k) for k in there.unique()]
                    problems.append(
                        f"parts.components.{name}.{key}: found {_said(item)}, no "
                        f"element of the deck has it{nearest(str(item), known)}"
                    )
                own |= fits
        found[name] = own & free
        free &= ~own
    problems.report()
    return found


def _fits(item: object, there: pd.Series) -> Bool:
    if isinstance(item, tuple):
        first, last = item
        return ((there >= first) & (there <= last)).to_numpy(bool)
    if isinstance(item, frozenset):
        return there.isin(item).to_numpy(bool)
    return (there == item).to_numpy(bool)


def _said(item: object) -> str:
    if isinstance(item, tuple):
        return f"{item[0]} to {item[1]}"
    return "a set" if isinstance(item, frozenset) else str(item)


def _members(structure: Structure, sets: Sequence[int]) -> list[frozenset[int]]:
    """Ids of SET1 cards.

    Raises:
        InputError: sets that are not there.
    """
    table = structure.deck.cards["SET1"]
    known = {int(sid): frozenset(ids) for sid, ids in zip(table.sid, table.ids)}
    if missing := [s for s in sets if s not in known]:
        names = list(map(str, known))
        raise InputError(
            f"parts.components: found set {s}, expected a SET1 of the deck"
            + nearest(str(s), names)
            for s in missing
        )
    return [known[s] for s in sets]
