"""Values of CPACS elements."""

from typing import Any

from lxml import etree


def number(node: Any, name: str) -> float:
    """The number in a child of an element, in the unit of the file (CPACS: SI).

    Args:
        node: element of lxml.
        name: of the child.

    Raises:
        ValueError: no number is there; says the line.
    """
    text = node.findtext(name)
    try:
        return float(text)
    except (TypeError, ValueError):
        raise ValueError(
            f"line {node.sourceline}: <{etree.QName(node).localname}> has {name} "
            f"{text!r}, expected a number"
        ) from None
