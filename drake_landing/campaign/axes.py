"""The kinds of axis of a campaign: what a field of the case goes through.

A kind is a section of the campaign file, known by a key of its own, and says what its
values are: those that are combined with the values of other axes, or a distribution
that is sampled.
"""

from typing import Annotated, Any, Self

import numpy as np
from pydantic import Discriminator, Field, Tag, field_validator, model_validator

from drake_landing.case.section import Section
from fem.arrays import Float64
from fem.errors import nearest

Value = bool | int | float | str


class Range(Section):
    """Evenly spaced values, both ends among them."""

    start: float = Field(alias="from", description="first value")
    stop: float = Field(alias="to", description="last value")
    count: int = Field(ge=1, le=10_000, description="number of values")


class Scale(Section):
    """Factors on the values of the base case."""

    scale: tuple[float, ...] = Field(min_length=1, description="factors")


class Distribution(Section):
    """A distribution of scipy.stats, truncated."""

    distribution: str = Field(description="name in scipy.stats, e.g. norm, weibull_min")
    values: dict[str, float] = Field(
        default={}, description="its parameters by name: loc, scale, shapes (c, a, b)"
    )
    low: float | None = Field(default=None, description="values below are cut off")
    high: float | None = Field(default=None, description="values above are cut off")
    source: str = Field(default="", description="where the figures come from")

    @field_validator("distribution")
    @classmethod
    def _known(cls, name: str) -> str:
        import scipy.stats  # a second, for campaigns that draw

        known = [
            n
            for n in dir(scipy.stats)
            if isinstance(getattr(scipy.stats, n), scipy.stats.rv_continuous)
        ]
        if name not in known:
            raise ValueError(
                f"found '{name}', expected a continuous distribution of scipy.stats"
                + nearest(name, known)
            )
        return name

    @model_validator(mode="after")
    def _frozen(self) -> Self:
        import scipy.stats

        try:
            law = getattr(scipy.stats, self.distribution)(**self.values)
            inside = law.cdf(_or(self.high, float("inf"))) - law.cdf(
                _or(self.low, float("-inf"))
            )
        except TypeError as error:
            raise ValueError(f"values: {error}") from None
        if not inside > 0.0:
            raise ValueError(
                "nothing of the distribution lies between low and high, or its "
                "parameters are out of range"
            )
        return self


def _or(value: float | None, other: float) -> float:
    return other if value is None else value


def _kind(value: Any) -> str:
    if isinstance(value, list | tuple):
        return "(values)"
    if isinstance(value, dict):
        for key, kind in (("scale", "(scale)"), ("distribution", "(distribution)")):
            if key in value:
                return kind
        return "(range)"
    names = {Range: "(range)", Scale: "(scale)", Distribution: "(distribution)"}
    return names.get(type(value), "(values)")


Axis = Annotated[
    Annotated[tuple[Value, ...], Field(min_length=1), Tag("(values)")]
    | Annotated[Range, Tag("(range)")]
    | Annotated[Scale, Tag("(scale)")]
    | Annotated[Distribution, Tag("(distribution)")],
    Discriminator(_kind),
]


def combined_values(axis: Axis) -> list[Value]:
    """Values that are combined with those of other axes; none of a distribution."""
    if isinstance(axis, Range):
        return [float(x) for x in np.linspace(axis.start, axis.stop, axis.count)]
    if isinstance(axis, Scale):
        return list(axis.scale)
    return [] if isinstance(axis, Distribution) else list(axis)


def quantiles(axis: Distribution, share: Float64) -> Float64:
    """Values of a truncated distribution at shares (n,) of its probability."""
    import scipy.stats

    law = getattr(scipy.stats, axis.distribution)(**axis.values)
    low = 0.0 if axis.low is None else law.cdf(axis.low)
    high = 1.0 if axis.high is None else law.cdf(axis.high)
    return np.asarray(law.ppf(low + share * (high - low)))
