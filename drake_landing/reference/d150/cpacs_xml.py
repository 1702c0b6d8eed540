"""Values of CPACS elements."""

import math
from collections.abc import Mapping
from typing import Any, TypeVar

from lxml import etree

T = TypeVar("T")
_LARGEST = 1e15  # stiffness in Pa; nothing of an aircraft is larger


def number(node: Any, name: str, default: float | None = None) -> float:
    """The number in a child of an element, in the unit of the file (CPACS: SI).

    Args:
        node: element of lxml.
        name: of the child.
        default: where the child is missing or empty; None: it is needed.

    Raises:
        ValueError: no number is there; says the line.
    """
    text = node.findtext(name)
    if default is not None and not (text or "").strip():
        return default
    return value_of(text, node, name)


def value_of(text: str | None, node: Any, name: str) -> float:
    """A finite number.

    Args:
        text: of the file.
        node, name: where it stands, for the message.

    Raises:
        ValueError: it is none; says the line.
    """
    try:
        value = float(text or "")
    except ValueError:
        value = math.nan
    if abs(value) <= _LARGEST:
        return value
    raise ValueError(f"{place(node)} has {name} {text!r}, expected a number") from None


def child(node: Any, path: str) -> Any:
    """An element below another.

    Raises:
        ValueError: it is not there; says the line.
    """
    found = node.find(path)
    if found is None:
        raise ValueError(f"{place(node)} has no {path}")
    return found


def looked_up(table: Mapping[Any, T], key: str | None, node: Any, what: str) -> T:
    """The element that another one refers to.

    Raises:
        ValueError: the file does not have it; says the line.
    """
    if key not in table:
        raise ValueError(f"{place(node)}: {what} {key!r} is not in the file")
    return table[key]


def place(node: Any) -> str:
    """Path of an element in its file, for messages."""
    return f"line {node.sourceline}: <{etree.QName(node).localname}>"
