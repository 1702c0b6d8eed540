"""The page of all fields of a case and a campaign, from their JSON schemas."""

import json
from collections.abc import Iterator, Mapping
from typing import Any

from drake_landing.campaign.schema import Campaign
from drake_landing.case.reading import schema_text

Schema = Mapping[str, Any]

_HEAD = """# All fields of a case

Made from the schema that checks the files (`drake-landing check --schema`). A case is
YAML 1.2; units are SI, angles degrees, positions in the frame of the deck, unless a
field says otherwise. A field without a default must be given. A whole case with
comments for a deck of your own: `drake-landing new CASE.yaml --deck DECK.bdf`.
"""


def case_page() -> str:
    """Markdown: a table for each section of a case, then those of a campaign."""
    lines = [_HEAD]
    for title, schema in (
        ("Case", json.loads(schema_text())),
        ("Campaign", Campaign.model_json_schema()),
    ):
        lines += ["", f"## {title}", "", *_table(schema, title)]
        for name, section in schema["$defs"].items():
            if "properties" in section:
                lines += ["", f"### {title}: {name}", ""]
                lines += [" ".join(section.get("description", "").split()), ""]
                lines += _table(section, title)
    return "\n".join(lines) + "\n"


def _table(section: Schema, title: str) -> Iterator[str]:
    yield "| field | is | default | meaning, unit, range |"
    yield "|---|---|---|---|"
    required = section.get("required", ())
    for name, field in section["properties"].items():
        default = "" if name in required else _default(field)
        told = " ".join(field.get("description", "").split()).replace("|", "\\|")
        shown = name.replace("_", "\\_")  # a word in code style may be broken anywhere
        yield f"| {shown} | {_kind(field, title)} | {default} | {told} |"


def _default(field: Schema) -> str:
    if "default" not in field:
        return ""
    value = field["default"]
    if isinstance(value, dict) and value:
        return "as there"
    return "none" if value is None else f"`{json.dumps(value, ensure_ascii=False)}`"


def _kind(field: Schema, title: str) -> str:
    """What a value is, in a few words; sections by links."""
    if "$ref" in field:
        name = field["$ref"].rpartition("/")[2]
        return f"[{name}](#{title.lower()}-{name.lower()})"
    for key in ("anyOf", "oneOf", "allOf"):
        if key in field:
            kinds = [_kind(f, title) for f in field[key] if f.get("type") != "null"]
            return " or ".join(dict.fromkeys(kinds))
    if "enum" in field:
        return ", ".join(f"`{value}`" for value in field["enum"])
    if "const" in field:
        return f"`{field['const']}`"
    kind = field.get("type", "any value")
    if kind == "array":
        items = field.get("prefixItems")
        if items:
            return f"[{', '.join(_kind(item, title) for item in items)}]"
        return f"list of {_kind(field.get('items', {}), title)}"
    if kind == "object":
        inner = field.get("additionalProperties")
        if isinstance(inner, dict):
            return f"names with {_kind(inner, title)}"
        return "mapping"
    return {"string": "text", "boolean": "true, false"}.get(kind, kind)
