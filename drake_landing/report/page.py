"""Puts text, pictures and tables of a run together on one page without outer files."""

import base64
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path
from typing import Any

import pandas as pd
from jinja2 import Environment, StrictUndefined
from markupsafe import Markup

from fem.files.atomic import write_aside

_LONG = 24  # letters of a word


@dataclass(frozen=True, kw_only=True)
class Cell:
    """One cell of a table; numbers are set flush right."""

    text: str
    number: bool = False

    @property
    def long(self) -> bool:
        """Whether a word may have to be broken to fit a page."""
        return max(map(len, self.text.split()), default=0) > _LONG


@dataclass(frozen=True, kw_only=True)
class Block:
    """A picture, a table, or text to be unfolded.

    Attributes:
        caption: of the picture or table, summary of the text.
        svg: picture as SVG text.
        png: picture as base64 text.
        alt: what the PNG shows, in words.
        heads, rows: table.
        fold: the table is to be unfolded.
        pre: preformatted text.
        items: lines of a list.
    """

    caption: str = ""
    svg: str = ""
    png: str = ""
    alt: str = ""
    fold: bool = False
    heads: Sequence[str] = ()
    rows: Sequence[Sequence[Cell]] = ()
    pre: str = ""
    items: Sequence[str] = ()


@dataclass(frozen=True, kw_only=True)
class Section:
    """A titled part of the page."""

    id: str
    title: str
    text: str = ""
    blocks: Sequence[Block] = ()


@dataclass(frozen=True, kw_only=True)
class Page:
    """All that a page shows; `beside` names files of its folder and what they are."""

    name: str
    title: str
    story: str
    key_figures: Sequence[tuple[str, str]]
    sections: Sequence[Section]
    beside: Sequence[tuple[str, str]] = ()
    footer: str = ""
    extra: dict[str, Any] = field(default_factory=dict)


def write_page(path: Path, page: Page) -> None:
    """Writes a self-contained HTML file."""
    folder = files("drake_landing.report")
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters["css_text"] = _css_text
    template = environment.from_string(
        folder.joinpath("report.html.j2").read_text(encoding="utf-8")
    )
    text = template.render(
        vars(page) | {"style": folder.joinpath("style.css").read_text(encoding="utf-8")}
    )
    write_aside(path, lambda to: to.write_text(text, encoding="utf-8") and None)


def _css_text(text: str) -> Markup:
    """Text as it stands within a CSS string; nothing in it can end string or style."""
    return Markup("".join(c if c.isalnum() else f"\\{ord(c):x} " for c in text))


def table_block(
    table: pd.DataFrame,
    heads: dict[str, str],
    formats: dict[str, str],
    caption: str = "",
    *,
    fold: bool = False,
) -> Block:
    """A table of chosen columns.

    Args:
        table: rows.
        heads: column -> heading, in the order of the page.
        formats: column -> format specification of its numbers.
        caption: above the table.
        fold: to be unfolded.
    """
    rows = [
        [_cell(row[column], formats.get(column, "")) for column in heads]
        for row in table.to_dict("records")
    ]
    return Block(heads=list(heads.values()), rows=rows, caption=caption, fold=fold)


def png_block(path: Path, caption: str) -> Block:
    """A PNG picture set into the page."""
    data = base64.b64encode(path.read_bytes()).decode("ascii")
    return Block(png=data, alt=caption, caption=caption)


def pairs_block(pairs: Iterable[tuple[str, str]], caption: str = "") -> Block:
    """A table of two columns: what, and its value."""
    rows = [[Cell(text=what), Cell(text=value)] for what, value in pairs]
    return Block(rows=rows, caption=caption)


def _cell(value: Any, spec: str) -> Cell:
    if isinstance(value, float) and math.isnan(value):
        return Cell(text="–", number=True)
    if isinstance(value, int | float):
        sign = "+" if spec.startswith("+") else ""
        spec = f"{sign}z{spec.removeprefix(sign)}" if spec else ""
        return Cell(text=format(value, spec), number=True)
    return Cell(text=str(value))
