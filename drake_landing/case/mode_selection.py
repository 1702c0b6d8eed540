"""Which elastic modes of an airframe a landing has: `count 40`, `below 50 Hz` ..."""

import re
from typing import Annotated, Any, Literal

from pydantic import (
    BeforeValidator,
    PlainSerializer,
    WithJsonSchema,
)

from drake_landing.case.section import Section

_SELECTION = (
    r"^\s*(?:(all)|count\s+(\d+)|below\s+(\d+(?:\.\d*)?)\s*Hz|relevance\s+(\d+)"
    r"|relevance\s+error\s*<=\s*(\d+(?:\.\d*)?)\s*%|pulses\s+(\d+))\s*$"
)


class Selection(Section):
    """Which elastic modes: all, the lowest, those below a frequency, or those that
    matter most under the gears' pulses: so many of them, or as many as an error needs;
    or shapes that are combined from them for these pulses.
    """

    kind: Literal["all", "count", "below", "relevance", "error", "pulses"]
    value: float = 0.0  # number of modes, Hz, or %

    def __str__(self) -> str:
        value = f"{self.value:g}"
        return {
            "all": "all",
            "below": f"below {value} Hz",
            "error": f"relevance error <= {value} %",
        }.get(self.kind, f"{self.kind} {value}")

    @property
    def by_relevance(self) -> bool:
        """The modes come from candidates, see `relevance` and `pulse_modes`."""
        return self.kind in ("relevance", "error", "pulses")


def parse_selection(text: Any) -> Any:
    """`all`, `count N`, `below F Hz`, `relevance N` or `error <= x %`, `pulses N`."""
    if isinstance(text, Selection):
        return text
    match = re.match(_SELECTION, text) if isinstance(text, str) else None
    if match is None:
        raise ValueError(
            "expected 'count N', 'below F Hz', 'all', 'relevance N', "
            "'relevance error <= x %' or 'pulses N'"
        )
    kinds = ("all", "count", "below", "relevance", "error", "pulses")
    kind, value = next((k, v) for k, v in zip(kinds, match.groups()) if v)
    return Selection(kind=kind, value=0.0 if kind == "all" else float(value))


SelectionText = Annotated[
    Selection,
    BeforeValidator(parse_selection),
    PlainSerializer(str),
    WithJsonSchema({"type": "string", "pattern": _SELECTION}),
]
