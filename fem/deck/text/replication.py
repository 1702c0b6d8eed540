"""Replication: cards that repeat the one before with some fields changed.

`=` copies a field, `*(x)` or `*x` adds x to it, `==` copies the rest of the row, and a
line `=(n)` or `=n` repeats the last replication n times.
"""

import re
from collections.abc import Sequence

from fem.deck.text.values import Malformed, integer, real

_REPEAT = re.compile(r"=\(?(\d{1,6})\)?$")
_STEP = re.compile(r"\*\(?([^()]+)\)?$")


def repetitions(head: str) -> int | None:
    """n of a line `=(n)`, 1 for a line that begins with `=`; None for other lines."""
    if head == "=":
        return 1
    match = _REPEAT.match(head)
    return int(match.group(1)) if match else None


def replicate(before: Sequence[str], rule: Sequence[str]) -> list[str]:
    """Fields of the next card from those of the last one (name first).

    Args:
        before: name and data fields of the card before.
        rule: data fields of the replication line.

    Raises:
        Malformed: an increment of something that is no number.
    """
    row = list(before[:9]) + [""] * (9 - len(before))
    fields = [row[0]]
    for index, text in enumerate(rule, start=1):
        if text == "==":
            fields += row[index:]
            break
        if text == "=":
            fields.append(row[index])
        elif (match := _STEP.match(text)) is not None:
            fields.append(_sum(row[index], match.group(1)))
        else:
            fields.append(text)
    while len(fields) > 1 and not fields[-1]:
        fields.pop()
    return fields


def _sum(text: str, step: str) -> str:
    for convert in (integer, real):
        try:
            return repr(convert(text or "0") + convert(step)).upper()
        except Malformed:
            continue
    raise Malformed(f"cannot add {step} to '{text}'")
