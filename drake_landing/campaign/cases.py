"""Cases of a campaign: the base case with some of its fields changed.

A field is a path, `scenario.sink_rate`; items of a list go by name, and `*` stands for
any: `gears.main_*.tyre.stiffness` is the tires of all main gears. Where the base case
has a set of gears by name, the fields of these gears are there to be changed, too.
"""

import copy
import json
from collections.abc import Iterator, Mapping, Sequence
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from drake_landing.campaign.axes import Scale, Value
from drake_landing.campaign.schema import Campaign
from drake_landing.case.document import read_document
from drake_landing.case.reading import (
    parse_case,
    parse_model,
    problems_of,
    read_text,
)
from drake_landing.case.schema import Case
from drake_landing.gears.landing_gear import LandingGear
from fem.errors import Problems, nearest

Data = dict[str, Any]


def load_campaign(path: Path | str) -> Campaign:
    """Reads and validates a campaign file.

    Raises:
        InputError: every problem with its line.
    """
    path = Path(path)
    text = read_text(path)
    campaign, places = parse_model(Campaign, text, file=str(path), folder=path.parent)
    return campaign.written_at(places)


def is_campaign(path: Path) -> bool:
    """Whether a file is a campaign rather than a case: it names a base case."""
    if not path.is_file():
        return False
    return any(line.startswith("base:") for line in read_text(path).splitlines())


class BaseCase:
    """The base case of a campaign, whose fields can be changed.

    Args:
        path: of the case file.
        gears: of the aircraft, where the case only names a set; None: not known yet.
    """

    def __init__(self, path: Path, gears: Sequence[LandingGear] | None = None) -> None:
        text = read_text(path)
        self.case = parse_case(text, file=str(path), folder=path.parent)
        self.folder = path.parent
        self._data: Data = read_document(text, str(path))[0]
        self._data.pop("$schema", None)
        if gears is not None:
            self._gears = [json.loads(g.model_dump_json(by_alias=True)) for g in gears]
        else:
            self._gears = None

    def with_gears(self, gears: Sequence[LandingGear]) -> "BaseCase":
        """The base case with the gears of a named set written out."""
        found = copy.copy(self)
        found._gears = [json.loads(g.model_dump_json(by_alias=True)) for g in gears]
        return found

    def case_of(
        self, values: Mapping[str, Value], axes: Mapping[str, object], name: str
    ) -> Case:
        """A case of the campaign.

        Args:
            values: field -> value, or factor where its axis scales.
            axes: of the campaign.
            name: of the case.

        Raises:
            InputError: a field that is not there, or a case that is not valid; every
                problem begins with the field.
        """
        data = copy.deepcopy(self._data)
        touches_gears = any(path.startswith("gears.") for path in values)
        if touches_gears and not isinstance(data.get("gears"), list):
            data["gears"] = copy.deepcopy(self._gears)
        data["name"] = name
        problems = Problems()
        for path, value in values.items():
            scaled = isinstance(axes.get(path), Scale)
            problems += _set(data, path, value, scaled)
        try:
            case = Case.model_validate(data, context={"folder": self.folder})
        except ValidationError as error:
            problems += [f"axes.{text}" for text in problems_of(Case, error, data)]
        problems.report()
        return case


def _set(data: Data, path: str, value: Value, scaled: bool) -> list[str]:
    """Changes all fields that a path means; problems in words."""
    steps = path.split(".")
    holders = [data]
    for i, step in enumerate(steps[:-1]):
        inner = [found for holder in holders for found in _children(holder, step)]
        if not inner and "*" not in step and isinstance(holders[0], dict):
            # A section of which the base case gives nothing.
            inner = [holder.setdefault(step, {}) for holder in holders]
        if not inner:
            known = [str(n) for holder in holders for n in _names(holder)]
            few = f", expected one of {', '.join(known)}" if 0 < len(known) < 9 else ""
            return [
                f"axes.{path}: nothing is called '{'.'.join(steps[: i + 1])}' in the "
                f"base case{nearest(step, known) or few}"
            ]
        holders = inner
    last = steps[-1]
    for holder in holders:
        if not isinstance(holder, dict):
            return [f"axes.{path}: found {holder!r} in place of a section"]
        if scaled:
            old = holder.get(last)
            if isinstance(old, bool) or not isinstance(old, int | float):
                return [
                    f"axes.{path}: found {old!r} in the base case, expected a number "
                    "that can be scaled"
                ]
            holder[last] = old * float(value)
        else:
            holder[last] = value
    return []


def _children(holder: Any, step: str) -> Iterator[Any]:
    """What a step of a path leads to."""
    if isinstance(holder, dict):
        for name, value in holder.items():
            if fnmatch(name, step) and isinstance(value, dict | list):
                yield value
    elif isinstance(holder, list):
        for i, item in enumerate(holder):
            name = item.get("name", "") if isinstance(item, dict) else ""
            if fnmatch(str(name), step) or step == str(i):
                yield item


def _names(holder: Any) -> Iterator[str]:
    if isinstance(holder, dict):
        yield from holder
    elif isinstance(holder, list):
        yield from (i["name"] for i in holder if isinstance(i, dict) and "name" in i)
