"""The rules by name, and what each paragraph asks of an aircraft."""

from collections.abc import Sequence

import numpy as np

from drake_landing.case.conditions import Conditions
from drake_landing.conditions.build import OnGround
from drake_landing.conditions.cs23 import CS23
from drake_landing.conditions.cs25 import CS25
from drake_landing.conditions.ground import BookCase
from drake_landing.conditions.paragraph import (
    LARGEST_UNKNOWN,
    TAIL_DOWN_UNKNOWN,
    Paragraph,
)
from fem.arrays import Float64

RULES: dict[str, tuple[Paragraph, ...]] = {"CS-25": CS25, "CS-23": CS23}
_OF_LANDING = (LARGEST_UNKNOWN, TAIL_DOWN_UNKNOWN)


def condition_figures(
    conditions: Conditions, ground: OnGround, *, landings: bool = True
) -> list[tuple[str, str]]:
    """Each paragraph with static cases: its largest loads, or why it has none.

    Args:
        conditions: of the case.
        ground: the aircraft; where the largest vertical loads are not known, that is
            said instead of their figures.
        landings: whether the landings that give them can be flown.
    """
    rows = []
    for paragraph in RULES[conditions.rules]:
        if paragraph.cases is None:
            continue
        missing = paragraph.missing(ground.aircraft)
        if missing in _OF_LANDING:
            found = "conditions finds them" if landings else "none without landings"
            rows.append((paragraph.number, f"loads of the landing: {found}"))
        elif missing:
            rows.append((paragraph.number, f"none: {missing}"))
        else:
            cases = list(paragraph.cases(ground.aircraft))
            rows.append((paragraph.number, _largest_loads(cases)))
    return rows


def _largest_loads(cases: Sequence[BookCase]) -> str:
    """Number of cases, and the largest sums on a gear."""
    sums = []
    for case in cases:
        of_gear: dict[str, Float64] = {}
        for one in case.loads:
            before = of_gear.get(one.gear, np.zeros(3))
            of_gear[one.gear] = before + one.force
        sums += [(gear, *force) for gear, force in of_gear.items()]
    texts = []
    for column, word in enumerate(("drag", "side", "vertical"), 1):
        gear, *force = max(sums, key=lambda row: abs(row[column]))
        if abs(force[column - 1]) > 1.0:
            texts.append(f"{word} {force[column - 1] / 1e3:.1f} kN ({gear})")
    many = f"{len(cases)} case{'s' * (len(cases) != 1)}"
    return f"{many}: largest {', '.join(texts)}"
