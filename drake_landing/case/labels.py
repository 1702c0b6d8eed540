"""Names that a user gives to places and parts: one line that can be printed."""

from typing import Annotated

from pydantic import AfterValidator

_LONGEST = 80


def _label(text: str) -> str:
    if not text.strip():
        raise ValueError("expected a name")
    if len(text) > _LONGEST:
        raise ValueError(f"has {len(text)} characters, expected at most {_LONGEST}")
    if not text.isprintable():
        raise ValueError("expected a name in one line, without control characters")
    return text


Label = Annotated[str, AfterValidator(_label)]
