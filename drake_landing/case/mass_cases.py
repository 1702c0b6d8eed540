"""Mass cases: what each adds to the deck's point masses, or takes from them."""

from collections.abc import Mapping
from pathlib import Path
from typing import Literal, Self

from pydantic import Field, model_validator

from drake_landing.case.section import Section
from drake_landing.input_paths import InputFile
from fem.errors import InputError, nearest

Span = tuple[int, int]


class Scaled(Section):
    """Point masses of which more or less is on board: fuel, payload."""

    elements: tuple[int | Span, ...] = Field(
        min_length=1, description="CONM2 ids, or [first, last]"
    )
    factor: float = Field(ge=0, le=100, description="on mass and inertia")


class MassCase(Section):
    """One loading of the airframe, by its point masses (CONM2) or by another deck."""

    deck: InputFile | None = Field(
        default=None, description="another deck, relative to the case file"
    )
    massset: int | None = Field(
        default=None,
        gt=0,
        description="MASSSET of the deck, which combines its BEGIN MASSID sections",
    )
    add: InputFile | None = Field(
        default=None, description="file of CONM2 that are added, relative to the case"
    )
    remove: tuple[int | Span, ...] = Field(
        default=(), description="CONM2 ids, or [first, last], that are left out"
    )
    scale: tuple[Scaled, ...] = Field(default=(), description="masses scaled")
    design: Literal["landing", "take_off"] | None = Field(
        default=None,
        description="which design weight this is: sets conditions.weight and the sink "
        "rate of presets (10 or 6 ft/s), where they are not given",
    )
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


def mass_case_of(
    name: str, cases: Mapping[str, MassCase], deck: Path | None
) -> MassCase:
    """A mass case by its name: one of the case file, or a MASSSET of the deck.

    Raises:
        InputError: there is none of that name, or the deck cannot be read.
    """
    if name in cases:
        return cases[name]
    from fem.deck.mass_increments import masssets_of  # heavy, and seldom needed

    known = masssets_of(deck) if deck is not None and deck.is_file() else {}
    if name in known:
        return MassCase(massset=known[name])
    names = [*cases, *known]
    if not names:
        raise InputError(
            f"mass_case: found '{name}', but there is none to choose: expected "
            "mass_cases in the case, or MASSSET in the deck"
        )
    raise InputError(
        f"mass_case: found '{name}', expected one of {', '.join(names)}"
        f"{nearest(name, names)}"
    )
