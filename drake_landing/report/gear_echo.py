"""All data of the landing gears as a table: field, meaning with unit, values."""

from collections.abc import Iterator, Sequence

import pandas as pd
from pydantic import BaseModel

from drake_landing.gears.landing_gear import LandingGear
from drake_landing.report.page import Block, table_block


def gear_echo(gears: Sequence[LandingGear], source: str) -> Block:
    """One row per field that any gear has a value of, one column per gear.

    Args:
        gears: as used, defaults written out.
        source: where the data are from.
    """
    rows: dict[str, dict[str, str]] = {}
    order: list[str] = []
    for i, gear in enumerate(gears):
        at = 0  # what only a later gear has stands where the data have it
        for path, meaning, value in _fields(gear):
            if path not in rows:
                rows[path] = {"field": path, "meaning": meaning}
                order.insert(at, path)
            at = order.index(path) + 1
            rows[path][f"gear{i}"] = value
    heads = {"field": "field", "meaning": "meaning and unit"}
    heads |= {f"gear{i}": g.name.replace("_", " ") for i, g in enumerate(gears)}
    table = pd.DataFrame([rows[path] for path in order], columns=list(heads)).fillna(
        "–"
    )
    caption = f"Gear data as used, in the deck's basic frame (B); from {source}"
    return table_block(table, heads, {}, caption, fold=True)


def _fields(model: BaseModel, at: str = "") -> Iterator[tuple[str, str, str]]:
    """Path, description, value of all that is given or has a default."""
    for name, info in type(model).model_fields.items():
        value = getattr(model, name)
        meaning = info.description or ""
        if isinstance(value, BaseModel):
            yield from _fields(value, f"{at}{name}.")
        elif _holds_models(value):
            for k, item in enumerate(value):
                yield from _fields(item, f"{at}{name}[{k}].")
        elif value is not None and value != ():
            yield f"{at}{name}", meaning, _text(value)


def _holds_models(value: object) -> bool:
    return isinstance(value, tuple) and any(isinstance(v, BaseModel) for v in value)


def _text(value: object) -> str:
    if isinstance(value, tuple):
        return "[" + ", ".join(map(_text, value)) + "]"
    return f"{value:g}" if isinstance(value, float) else str(value)
