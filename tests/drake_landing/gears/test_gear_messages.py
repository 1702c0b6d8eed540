"""Every field of every kind of gear: a wrong value is one message that names it.

Fields and their limits are those of the models, so that new ones are covered.
"""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import pytest
import yaml
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from drake_landing.case.reading import parse_case
from drake_landing.gears.landing_gear import BogieGear, LeveredGear, TelescopicGear
from fem.errors import InputError

HERE = Path(__file__).parents[1]
CASE = yaml.safe_load((HERE / "tiny_case.yaml").read_text(encoding="utf-8"))
MAIN = CASE["gears"][1]
PART = MAIN["piston"]
OF_PISTON = ("axle", "piston")
COMMON = {name: value for name, value in MAIN.items() if name not in OF_PISTON}
GEARS = {
    TelescopicGear: MAIN,
    LeveredGear: COMMON
    | {
        "kind": "levered",
        "axle": [8.9, 2.0, -1.25],
        "pivot": [8.3, 2.0, -1.0],
        "absorber_upper": [8.7, 2.0, -0.3],
        "absorber_lower": [8.7, 2.0, -1.1],
        "arm": PART,
    },
    BogieGear: COMMON
    | {
        "kind": "bogie",
        "pivot": [8.6, 2.0, -1.25],
        "axle_positions": [[8.2, 2.0, -1.25], [9.0, 2.0, -1.25]],
        "piston": PART,
        "beam": PART,
    },
}
# What must stand beside a field of an optional part.
PARTS: dict[str, Any] = {
    "cylinder": PART,
    "further_attachments": [{"name": "stay", "node": 7, "directions": [[1, 0, 0]]}],
    "tyres": {"main_right_left": {}},
    "orifices": {"piston_area": 0.01, "main": 1e-4},
    "damping_map": {
        "strokes": [0.0, 0.2],
        "rates": [1.0, 2.0],
        "compression": [[1.0, 2.0], [1.0, 2.0]],
        "rebound": [[1.0, 2.0], [1.0, 2.0]],
    },
    "second_chamber": {"precharge_force": 1e4, "gas_length": 0.1},
    "beam": PART,
    "fore_aft": {"frequency": 12.0},
    "lateral": {"frequency": 12.0},
    "torsion": {"frequency": 12.0},
    "matrix": {"stiffness": [[float(i == j) for j in range(6)] for i in range(6)]},
    "reduced": {"files": ["k.pch"], "grids": "g.csv", "root": 1, "axle": 2},
    "brake": {"torque": 1.0},
}
LEG_BEAM = {
    "cylinder_bending": 1e6,
    "piston_bending": 1e6,
    "cylinder_length": 1.0,
    "overhang": 0.5,
    "bearing_distance": 0.3,
}
Path_ = tuple[str, ...]


def fields(model: type[BaseModel], above: Path_ = ()) -> Iterator[tuple[Path_, Any]]:
    """Path and field of every value, inside optional parts too."""
    for name, field in model.model_fields.items():
        if name in ("name", "kind", "bodies"):  # kinds and model files: own tests
            continue
        inner = models_in(field.annotation)
        if inner:
            yield from fields(inner[0], (*above, name))
        else:
            yield (*above, name), field


def models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [m for part in get_args(annotation) for m in models_in(part)]


def wrong_values(field: FieldInfo) -> list[Any]:
    """Of the wrong type, and beyond each limit that the field has."""
    textual = any(word in str(field.annotation) for word in ("str", "Path"))
    found: list[Any] = [[1.0] if textual else "x"]
    if textual or "list" in str(field.annotation) or "tuple" in str(field.annotation):
        return found
    for limit in [*field.metadata, *limits_in(field.annotation)]:
        for name, beyond in (("gt", 0.0), ("ge", -1.0), ("lt", 0.0), ("le", 1.0)):
            if (bound := getattr(limit, name, None)) is not None:
                found.append(bound + beyond)
    return found


def limits_in(annotation: Any) -> Iterator[Any]:
    for part in (*get_args(annotation), *getattr(annotation, "__metadata__", ())):
        yield from getattr(part, "metadata", [part])
        yield from limits_in(part)


def with_value(gear: dict[str, Any], path: Path_, value: Any) -> dict[str, Any]:
    """The gear with a value there, and what must stand beside it."""
    changed = json.loads(json.dumps(gear))  # nothing is shared
    at = changed
    for i, name in enumerate(path[:-1]):
        of_leg = name == "beam" and path[i - 1] == "leg"
        part = LEG_BEAM if of_leg else PARTS.get(name, {})
        at = at.setdefault(name, json.loads(json.dumps(part)))
        if isinstance(at, list):
            at = at[0]
        if name == "tyres":
            at = at["main_right_left"]
    at[path[-1]] = value
    return changed


@pytest.mark.parametrize("kind", GEARS, ids=lambda kind: kind.__name__)
def test_a_wrong_value_of_any_field_is_one_message_with_line_and_field(kind):
    shared = {path for path, _ in fields(TelescopicGear)}
    faults = []
    for path, field in fields(kind):
        if kind is not TelescopicGear and path in shared:
            continue  # once is enough
        for value in wrong_values(field):
            gear = with_value(GEARS[kind], path, value)
            text = yaml.safe_dump(CASE | {"gears": [gear]}, sort_keys=False)
            problems = problems_of(text)
            if len(problems) != 1 or not names(problems[0], path, text):
                faults.append((".".join(path), value, problems))
    assert not faults, "\n".join(map(str, faults))


def problems_of(text: str) -> list[str]:
    try:
        parse_case(text, file="wrong.yaml", folder=HERE)
    except InputError as error:
        return list(error.problems)
    return []


def names(problem: str, path: Path_, text: str) -> bool:
    """File, line of the field, field, found, expected."""
    file, line, what = problem.split(":", 2)
    steps = what.split(": ")[0].split(".")
    return (
        file == "wrong.yaml"
        and path[-1] in "".join(text.splitlines()[int(line) - 2 : int(line)])
        and steps[0].strip() == "gears"
        and path[-1] in steps
        and "found" in what
        and "expected" in what
    )
