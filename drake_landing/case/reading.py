"""Case files: YAML in, every problem at once with its line and path.

A problem reads `landing.yaml:12: scenario.sink_rte: unknown key; did you mean
'sink_rate'?`.
"""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeVar, get_args

import yaml
from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

from drake_landing.case.document import document_text, read_document
from drake_landing.case.field_lines import Places
from drake_landing.case.schema import Case
from fem.errors import InputError, nearest
from fem.input_files import input_text

_MOST_BYTES = 20_000_000
_DIALECT = "https://json-schema.org/draft/2020-12/schema"

# What pydantic says of types, in words of people.
_PLAIN = {
    "string_type": "text",
    "float_type": "a number",
    "float_parsing": "a number",
    "int_type": "an integer",
    "int_parsing": "an integer",
    "int_parsing_size": "an integer of fewer digits",
    "int_from_float": "an integer",
    "bool_type": "true or false",
    "bool_parsing": "true or false",
    "list_type": "a list: [..., ...]",
    "tuple_type": "a list: [..., ...]",
    "path_type": "the name of a file",
    "finite_number": "a finite number",
}

_FIELD = re.compile(r"([a-z]\w*(?:\.\w+)*): ")

Loc = tuple[int | str, ...]
M = TypeVar("M", bound=BaseModel)


def load_case(path: str | Path) -> Case:
    """Reads and validates a case file; a deck's path is taken relative to it.

    Raises:
        InputError: the file cannot be read, or its content is not a valid case.
    """
    path = Path(path)
    text = read_text(path)
    if re.search(r"(?im)^\s*(begin\s+bulk|cend|enddata)", text):
        raise InputError(
            f"{path}: is a Nastran deck, expected a case file (YAML), which names the "
            "deck in airframe.deck"
        )
    return parse_case(text, file=str(path), folder=path.parent)


def parse_case(text: str, *, file: str = "<case>", folder: Path | None = None) -> Case:
    """Validates the text of a case.

    Args:
        text: YAML.
        file: how messages name the source.
        folder: of relative paths.
    """
    case, places = parse_model(Case, text, file=file, folder=folder)
    return case.written_at(places)


def parse_model(
    model: type[M], text: str, *, file: str, folder: Path | None = None
) -> tuple[M, Places]:
    """Validates YAML as a model; the places of its fields.

    Args:
        model: of the whole document.
        text: YAML.
        file: how messages name the source.
        folder: of relative paths.

    Raises:
        InputError: every problem, each with its line and field.
    """
    data, tree = read_document(text, file)
    if not isinstance(tree, yaml.MappingNode):
        raise InputError(
            f"{file}:1: expected a mapping of sections, found {_kind(data)}"
        )
    places = Places.from_yaml(file, tree, frozenset(model.model_fields))
    problems = [f"{file}:{line}: {text}" for line, text in _repeated_keys(tree)]
    data.pop("$schema", None)  # for editors
    try:
        found = model.model_validate(data, context={"folder": folder})
    except ValidationError as error:
        wrong = [_problem(model, places, e, data) for e in _separate(error)]
        problems += [f"{file}:{line}: {text}" for line, text in _joined(wrong)]
        raise InputError(problems) from None
    if problems:
        raise InputError(problems)
    return found, places


def case_text(case: Case) -> str:
    """The case as YAML, all defaults written out."""
    data = json.loads(case.model_dump_json())
    return document_text(data)


def schema_text() -> str:
    """JSON schema of a case file."""
    schema = {"$schema": _DIALECT, **Case.model_json_schema()}
    return json.dumps(schema, indent=2, ensure_ascii=False)


def read_text(path: Path) -> str:
    """Text of a case file.

    Raises:
        InputError: it cannot be read.
    """
    return input_text(path, "case file", _MOST_BYTES)


def _kind(data: Any) -> str:
    names = {dict: "a mapping", list: "a list", str: "a text"}
    return "nothing" if data is None else names.get(type(data), repr(data))


def _repeated_keys(node: yaml.Node, path: str = "") -> list[tuple[int, str]]:
    """YAML lets the last of equal keys win silently: that hides mistakes."""
    found: list[tuple[int, str]] = []
    if isinstance(node, yaml.MappingNode):
        seen: dict[str, int] = {}
        for key, value in node.value:
            line, name = key.start_mark.line + 1, f"{path}{key.value}"
            if key.value in seen:
                found.append((line, f"{name}: already given in line {seen[key.value]}"))
            seen.setdefault(key.value, line)
            found += _repeated_keys(value, f"{name}.")
    elif isinstance(node, yaml.SequenceNode):
        for i, value in enumerate(node.value):
            found += _repeated_keys(value, f"{path}{i}.")
    return found


def problems_of(
    model: type[BaseModel], error: ValidationError, data: dict[str, Any]
) -> list[str]:
    """Problems of data that come from no file, each `field: found, expected`."""
    found = [_problem(model, Places(), e, data) for e in _separate(error)]
    return [text for _, text in _joined(found)]


def _separate(error: ValidationError) -> list[dict[str, Any]]:
    """Its errors without those that follow from others.

    A list whose entries are wrong is counted as too short, too.
    """
    errors = [dict(e) for e in error.errors()]
    return [
        e
        for e in errors
        if e["type"] != "too_short"
        or not any(
            o["loc"] != e["loc"] and o["loc"][: len(e["loc"])] == e["loc"]
            for o in errors
        )
    ]


def _joined(wrong: list[tuple[int, str]]) -> list[tuple[int, str]]:
    """In the order of their lines; what the branches of a union expect in one."""
    found: dict[tuple[int, str], str] = {}
    for line, text in sorted(set(wrong)):
        key = line, text.partition(", expected ")[0]
        found[key] = _either(found[key], text) if key in found else text
    return [(line, text) for (line, _), text in found.items()]


def _either(one: str, other: str) -> str:
    """Two `found, expected (meaning)` of one value as one."""
    head, _, first = one.partition(", expected ")
    second = other.partition(", expected ")[2]
    places = (m.start() for m in re.finditer(r" \(", first))
    meaning = next((first[i:] for i in places if second.endswith(first[i:])), "")
    either = f"{first.removesuffix(meaning)}, or {second.removesuffix(meaning)}"
    return f"{head}, expected {either}{meaning}"


def _problem(
    model: type[BaseModel], places: Places, error: dict[str, Any], data: dict[str, Any]
) -> tuple[int, str]:
    """Line and text of one pydantic error."""
    models, field, loc = _resolve(model, error["loc"])
    path = ".".join(map(str, loc))
    text = _explain(error, models, field, loc)
    if not path:  # of the whole case: the text itself names the field
        return places.line(text.partition(":")[0]), text
    field_of_text = _FIELD.match(text)
    if field_of_text and f"{path}.{field_of_text[1]}" in places.lines:
        # Of a mapping, but the text names the field in it.
        where = f"{path}.{field_of_text[1]}"
        return places.line(where), f"{'.'.join(_by_name(loc, data))}.{text}"
    return places.line(path), f"{'.'.join(_by_name(loc, data))}: {text}"


def _by_name(loc: Loc, data: Any) -> Iterator[str]:
    """Steps of a path; what has a name in a list goes by it, `gears.nose.axle`."""
    for step in loc:
        try:
            data = data[step]
        except (LookupError, TypeError):
            data = None
        name = data.get("name") if isinstance(data, dict) else None
        named = isinstance(step, int) and isinstance(name, str) and name.isidentifier()
        yield str(name if named else step)


# Keys that are less alike than this are no misspelling of each other.
_ALIKE = 0.7


def _explain(
    error: dict[str, Any],
    models: list[type[BaseModel]],
    field: FieldInfo | None,
    loc: Loc,
) -> str:
    meaning = f" ({field.description})" if field and field.description else ""
    if error["type"] == "extra_forbidden":
        known = sorted({name for model in models for name in model.model_fields})
        clause = nearest(str(loc[-1]), known, _ALIKE)
        return "unknown key" + (clause or f"; known are {', '.join(known)}")
    if error["type"] == "missing":
        return f"missing{meaning}"
    message = str(error["msg"]).removeprefix("Value error, ")
    if error["type"] == "gear_kind":
        return f"kind: found {error['input'].get('kind')!r}, {message}"
    if error["type"] == "value_error" and not _is_scalar(error["input"]):
        return message
    if error["type"] in ("model_type", "dict_type"):
        message = "a mapping of keys and values"
    if error["type"] in ("too_short", "too_long"):
        limits, short = error["ctx"], error["type"] == "too_short"
        count = limits["min_length"] if short else limits["max_length"]
        found = f"found {limits['actual_length']} entries"
        return f"{found}, expected {count} or {'more' if short else 'fewer'}{meaning}"
    if error["type"] == "string_pattern_mismatch":
        message = f"text that matches {error['ctx']['pattern']}"
    message = _PLAIN.get(error["type"], message).removeprefix("Input should be ")
    if error["type"] == "literal_error" and isinstance(error["input"], str):
        choices = str(error["ctx"]["expected"]).replace("'", "").replace(" or ", ", ")
        message += nearest(error["input"], choices.split(", "))
    expected = message if message.startswith("expected") else f"expected {message}"
    return f"found {_show(error['input'])}, {expected}{meaning}"


def _is_scalar(value: Any) -> bool:
    return value is None or isinstance(value, str | int | float | bool)


def _show(value: Any) -> str:
    if value in ("true", "false"):  # see `document`
        return str(value)
    text = repr(value) if _is_scalar(value) else _kind(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _resolve(
    root: type[BaseModel], loc: Loc
) -> tuple[list[type[BaseModel]], FieldInfo | None, Loc]:
    """The models that hold the last key, its field, and the path without union tags."""
    models: list[type[BaseModel]] = [root]
    field: FieldInfo | None = None
    path: list[int | str] = []
    for i, step in enumerate(loc):
        if isinstance(step, int):
            path.append(step)
            continue
        fields = [m.model_fields[step] for m in models if step in m.model_fields]
        last = i == len(loc) - 1
        if not fields and not last and field is not None:
            if field.annotation and "dict" in str(field.annotation):
                path.append(step)
            continue  # a tag that pydantic adds for the branch of a union
        if not fields and field is not None and _is_tag(step, field):
            continue
        path.append(step)
        field = fields[0] if fields else None
        if not last:
            models = [m for f in fields for m in _models_in(f.annotation)]
    return models, field, tuple(path)


def _is_tag(step: str, field: FieldInfo) -> bool:
    """A branch of a union, not the key of a mapping."""
    if any(mark in step for mark in "[]('"):
        return True
    simple = re.fullmatch(r"(constrained-)?(float|int|str|bool)", step)
    return bool(simple) and "dict" not in str(field.annotation)


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [m for part in get_args(annotation) for m in _models_in(part)]
