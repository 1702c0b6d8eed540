"""Damping of the airframe that the case gives, beside or instead of the deck's."""

from typing import Literal, Self

from pydantic import Field, model_validator

from drake_landing.case.section import Section


class AirframeDamping(Section):
    """Viscous damping of the whole airframe, B = ALPHA1 M + (ALPHA2 + G/W3) K.

    Multibody model and direct transient have the same.
    """

    deck: Literal["keep", "drop"] = Field(
        default="keep",
        description="keep: what the deck gives by PARAM G, W3, W4, ALPHA1 and ALPHA2 "
        "acts too; drop: it does not. Dampers and B2GG act in any case",
    )
    g: float | None = Field(
        default=None, gt=0, le=0.5, description="structural damping G, 1; needs w3"
    )
    w3: float | None = Field(
        default=None,
        gt=0,
        description="circular frequency at which G holds, rad/s: there the damping "
        "ratio is G/2",
    )
    alpha1: float | None = Field(
        default=None, ge=0, description="Rayleigh: factor on the mass, 1/s"
    )
    alpha2: float | None = Field(
        default=None, ge=0, description="Rayleigh: factor on the stiffness, s"
    )
    ratio: dict[float, float] | None = Field(
        default=None,
        description="damping ratios (of critical, 0 to 0.5) over frequency, Hz, e.g. "
        "{4: 0.015, 40: 0.03}: met by the nearest Rayleigh damping; exactly by one or "
        "two where factors >= 0 can, and how nearly is said",
    )

    @model_validator(mode="after")
    def _complete(self) -> Self:
        if (self.g is None) != (self.w3 is None):
            raise ValueError("g and w3 belong together: G holds at the frequency W3")
        for hz, ratio in (self.ratio or {}).items():
            if not (0.0 < hz <= 1000.0 and 0.0 < ratio <= 0.5):
                raise ValueError(
                    f"ratio: found {hz:g}: {ratio:g}, expected frequencies above 0 and "
                    "up to 1000 Hz and ratios above 0 and up to 0.5"
                )
        return self
