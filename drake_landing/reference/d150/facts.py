"""The facts of the reference aircraft, read from the files of `data/`.

A fact in YAML is a mapping with a `value` and its `source`; `facts("wing")` gives the
plain values under the same names. `table("wing_ribs")` gives a CSV file. What the
sources are is said in `data/README.md`.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from importlib import resources
from typing import Any

import pandas as pd
import yaml

SOURCES = ("S1", "S2", "P", "DEC", "AC", "REG", "KNOW", "EST")


def _text(file_name: str) -> str:
    folder = resources.files("drake_landing.reference.d150") / "data"
    return (folder / file_name).read_text(encoding="utf-8")


@cache
def raw(name: str) -> dict[str, Any]:
    """The file `data/<name>.yaml` with sources, units and notes."""
    return yaml.safe_load(_text(f"{name}.yaml"))


def facts(name: str) -> dict[str, Any]:
    """The plain values of `data/<name>.yaml`, SI units and degrees."""
    return _facts.get(name) or _own_facts(name)


def table(name: str) -> pd.DataFrame:
    """The file `data/<name>.csv`, SI units; columns `source` and `estimate` last."""
    return _tables[name] if name in _tables else _own_table(name)


@contextmanager
def replaced(
    facts: Mapping[str, dict[str, Any]], tables: Mapping[str, pd.DataFrame]
) -> Iterator[None]:
    """Other facts and tables of these names for a while: another aircraft's."""
    before = dict(_facts), dict(_tables)
    _facts.update(facts)
    _tables.update(tables)
    try:
        yield
    finally:
        for own, kept in zip((_facts, _tables), before):
            own.clear()
            own.update(kept)


_facts: dict[str, dict[str, Any]] = {}
_tables: dict[str, pd.DataFrame] = {}


@cache
def _own_facts(name: str) -> dict[str, Any]:
    return _plain(raw(name))


@cache
def _own_table(name: str) -> pd.DataFrame:
    with resources.as_file(
        resources.files("drake_landing.reference.d150") / "data" / f"{name}.csv"
    ) as path:
        return pd.read_csv(path)


def leaves(tree: Any, path: str = "") -> Iterator[tuple[str, dict[str, Any]]]:
    """Every fact of a raw file: its dotted name and its mapping."""
    if isinstance(tree, dict):
        if "value" in tree:
            yield path, tree
        else:
            for key, branch in tree.items():
                yield from leaves(branch, f"{path}.{key}".lstrip("."))


def _plain(tree: Any) -> Any:
    if not isinstance(tree, dict):
        return tree
    if "value" in tree:
        return tree["value"]
    return {key: _plain(branch) for key, branch in tree.items()}
