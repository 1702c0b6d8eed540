"""Kinds of fields that the data of gears have, with their checks."""

from itertools import pairwise
from typing import Annotated, Any, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
)

Vector3 = tuple[float, float, float]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]


def _ascending(table: list[tuple[float, float]]) -> list[tuple[float, float]]:
    for (before, _), (after, _) in pairwise(table):
        if not after > before:
            raise ValueError(
                f"found {after:g} after {before:g}, expected strictly ascending "
                "abscissae"
            )
    return table


Table = Annotated[
    list[tuple[float, float]], Field(min_length=2), AfterValidator(_ascending)
]


def one_of(**given: object) -> None:
    """Checks that exactly one of some fields is given; None stands for absent.

    Raises:
        ValueError: none or several are.
    """
    found = [name for name, value in given.items() if value is not None]
    if len(found) != 1:
        first = (found or list(given))[0]
        raise ValueError(
            f"{first}: found {' and '.join(found) or 'none'}, expected one of "
            f"{', '.join(given)}"
        )


class Data(BaseModel):
    """Frozen; unknown keys are errors."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    def changed(self, **values: Any) -> Self:
        """Copy with other values, checked as those of a case are.

        Args:
            values: by field; pydantic's `model_copy` takes names that no field has.

        Raises:
            ValidationError: an unknown field, or a value out of its range.
        """
        given = {name: getattr(self, name) for name in self.model_fields_set}
        return type(self).model_validate({**given, **values})
