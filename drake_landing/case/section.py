"""What the sections of a case file have in common."""

from typing import Any

from pydantic import BaseModel, ConfigDict, Field


class Section(BaseModel):
    """Frozen; unknown keys are errors."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


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
