"""Names that a user gives to places and parts: one line that can be printed."""

from typing import Annotated

from pydantic import AfterValidator, Field

_LONGEST = 80
_LONGEST_LINE = 1000


def _label(text: str) -> str:
    if not text.strip():
        raise ValueError("expected a name")
    return _line(text, _LONGEST)


def _line(text: str, longest: int = _LONGEST_LINE) -> str:
    if len(text) > longest:
        raise ValueError(f"has {len(text)} characters, expected at most {longest}")
    if not text.isprintable():
        raise ValueError("expected one line, without control characters")
    return text


Label = Annotated[str, AfterValidator(_label)]
OneLine = Annotated[str, AfterValidator(_line)]
LineOrNumber = Annotated[str, Field(coerce_numbers_to_str=True), AfterValidator(_line)]
