"""What the sections of a case file have in common."""

from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr

from drake_landing.case.field_lines import Places


class Section(BaseModel):
    """Frozen; unknown keys are errors."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Document(Section):
    """What a whole file says; its fields know where they were written."""

    _places: Places = PrivateAttr(default=Places())

    @property
    def places(self) -> Places:
        """Where its fields were written."""
        return self._places

    def written_at(self, places: Places) -> Self:
        """Copy of the document with the places of its fields."""
        document = self.model_copy()
        document._places = places
        return document


def number(
    meaning: str,
    unit: str,
    default: float | None = None,
    *,
    gt: float | None = None,
    ge: float | None = None,
    lt: float | None = None,
    le: float | None = None,
) -> Any:
    """A field whose description ends with unit and range; required without default."""
    low = f"> {gt:g}" if gt is not None else f">= {ge:g}" if ge is not None else ""
    high = f"< {lt:g}" if lt is not None else f"<= {le:g}" if le is not None else ""
    limits = " and ".join(part for part in (low, high) if part)
    return Field(
        default=... if default is None else default,
        description=f"{meaning}, {unit}" + (f", {limits}" if limits else ""),
        gt=gt,
        ge=ge,
        lt=lt,
        le=le,
    )
