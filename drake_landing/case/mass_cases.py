"""Mass cases: what each adds to the deck's point masses, or takes from them."""

from pathlib import Path
from typing import Any, Self

from pydantic import Field, ValidationInfo, field_validator, model_validator

from drake_landing.case.section import Section

Span = tuple[int, int]


class Scaled(Section):
    """Point masses of which more or less is on board: fuel, payload."""

    elements: tuple[int | Span, ...] = Field(
        min_length=1, description="CONM2 ids, or [first, last]"
    )
    factor: float = Field(ge=0, le=100, description="on mass and inertia")


class MassCase(Section):
    """One loading of the airframe, by its point masses (CONM2) or by another deck."""

    deck: Path | None = Field(
        default=None, description="another deck, relative to the case file"
    )
    add: Path | None = Field(
        default=None, description="file of CONM2 that are added, relative to the case"
    )
    remove: tuple[int | Span, ...] = Field(
        default=(), description="CONM2 ids, or [first, last], that are left out"
    )
    scale: tuple[Scaled, ...] = Field(default=(), description="masses scaled")
    mass: float | None = Field(
        default=None,
        gt=0,
        description="of the aircraft with its gears, kg, that must come out to 1 %",
    )
    cg: tuple[float, float, float] | None = Field(
        default=None,
        description="of the aircraft with its gears extended, in the deck's axes, m, "
        "that must come out to cg_tolerance",
    )
    cg_tolerance: float = Field(default=0.05, gt=0, description="distance, m")

    @field_validator("deck", "add", mode="after")
    @classmethod
    def _there(cls, path: Path | None, info: ValidationInfo) -> Path | None:
        folder = (info.context or {}).get("folder")
        path = Path(folder, path) if path and folder else path
        if path and not path.is_file():
            raise ValueError(f"found {path}, expected a file that is there")
        return path

    @model_validator(mode="after")
    def _once(self) -> Self:
        spans = [*self.remove, *(e for s in self.scale for e in s.elements)]
        for one in spans:
            if isinstance(one, tuple) and one[1] < one[0]:
                raise ValueError(f"[{one[0]}, {one[1]}]: expected [first, last]")
        return self


def holds_id(spans: tuple[int | Span, ...], number: int) -> bool:
    """Whether ids and spans of ids hold a number."""
    return any(
        s[0] <= number <= s[1] if isinstance(s, tuple) else s == number for s in spans
    )


def known_mass_case(name: str | None, cases: dict[str, Any]) -> str | None:
    """The name, where there is such a mass case.

    Raises:
        ValueError: there is none.
    """
    from fem.errors import nearest

    if name is not None and name not in cases:
        known = ", ".join(cases) or "none, for mass_cases is empty"
        raise ValueError(
            f"mass_case: found '{name}', expected one of {known}{nearest(name, cases)}"
        )
    return name
