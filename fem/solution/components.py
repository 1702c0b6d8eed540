"""Which freedoms of a structure its superelements condense, and by which modes."""

import numpy as np

from fem.algebra.components import Component
from fem.arrays import Int64
from fem.deck.control.subcase import Subcase
from fem.deck.deck import Superelement
from fem.deck.superelements.subcases import subcase_of
from fem.errors import InputError
from fem.model.structure import Structure
from fem.solution.eigrl import request


def components_of(structure: Structure) -> list[Component]:
    """Parts that a dynamic solution reduces, in their order.

    Those whose modes have a free boundary stay as they are.
    """
    return [
        _component(structure, part)
        for part in structure.deck.components
        if not part.free
    ]


def component_notices(structure: Structure) -> list[str]:
    """Notices of what the reduction of superelements means for the results."""
    lines = []
    for part in structure.deck.components:
        if part.free:
            lines.append(
                f"superelement {part.number}: modes with a free boundary (CSET, "
                "SECSET) are not made; it is kept whole, which is more accurate"
            )
        elif not len(part.generalised) and not part.count:
            lines.append(
                f"superelement {part.number}: its {len(part.interior)} interior points "
                "follow its boundary statically (no QSET): what moves in it between "
                "the boundary points is lost"
            )
    return lines


def _component(structure: Structure, part: Superelement) -> Component:
    points, f = structure.points, structure.elimination.f
    rows = np.concatenate(
        [points.dof(int(i), _components(structure, int(i))) for i in part.interior]
        or [np.zeros(0, np.int64)]
    )
    held = [_freedoms(structure, *pair) for pair in part.kept]
    if held:
        rows = np.setdiff1d(rows, np.concatenate(held))
    interior = np.flatnonzero(np.isin(f, rows))
    names = np.concatenate(
        [np.zeros(0, np.int64), *(_freedoms(structure, *p) for p in part.generalised)]
    )
    wanted = len(names) + part.count
    case = subcase_of(part.number, structure.deck.case_control)
    if not wanted:
        return Component(interior=interior, generalised=names)
    count, highest = _modes(structure, part, case)
    count = wanted if count is None else min(count, wanted)
    count = min(count, len(interior))
    return Component(
        interior=interior, count=count, highest_hz=highest, generalised=names
    )


def _freedoms(structure: Structure, point: int, digits: str) -> Int64:
    """Rows of the g-set of a point's components."""
    return structure.points.dof(point, [int(c) for c in digits if c != "0"] or [0])


def _components(structure: Structure, point: int) -> list[int]:
    is_grid = np.isin(point, structure.points.grid_id)
    return [1, 2, 3, 4, 5, 6] if is_grid else [0]


def _modes(
    structure: Structure, part: Superelement, case: Subcase
) -> tuple[int | None, float | None]:
    """Number and limit (Hz) of the modes that the METHOD of a superelement asks for.

    Raises:
        InputError: there is no such card.
    """
    for table in (part.methods, structure.deck.cards["EIGRL"]):
        if table is None:
            continue
        found = table[table["sid"] == case.method]
        if not found.empty:
            count, (_, high) = request(found.iloc[0])
            return count, high
    raise InputError(
        f"{structure.deck.path}: subcase {case.id}: METHOD = {case.method or 'nothing'}"
        f" for the modes of superelement {part.number}: expected an EIGRL card of its "
        "bulk data"
    )
