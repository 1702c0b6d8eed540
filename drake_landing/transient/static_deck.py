"""A complete SOL 101 deck: the user's model under forces and moments, case by case.

The bulk data of the model is copied, its INCLUDEs in place. Loads stand in displacement
frames and in the units of the deck. The free airframe is held by six freedoms that
carry nothing, where a load is in equilibrium with itself, or by its own inertia
(PARAM,INREL,-2).
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from textwrap import wrap

import numpy as np

from drake_landing.transient.deck import free_ids, model_lines, model_selections
from fem.algebra.statics import determinate_rows
from fem.arrays import Float64
from fem.deck.text.sections import split_sections
from fem.deck.text.source import read_source
from fem.deck.units import units_of
from fem.files.atomic import written_aside
from fem.files.deck_writer import card
from fem.model.structure import Structure

_LEAST = 1e-9  # of the largest force or moment: below, nothing is written
_WIDTH = 72  # characters of a line of Nastran's
LABEL_WIDTH = 60
"""Characters of a subtitle or label; `°` takes four of them."""


@dataclass(frozen=True, kw_only=True)
class StaticCase:
    """A subcase.

    Attributes:
        subtitle, label: what it is.
        load: (g,) on the rows of the g-set, displacement frames, N and N m.
    """

    subtitle: str
    label: str
    load: Float64 = field(repr=False)


def write_static_deck(
    path: Path,
    structure: Structure,
    source: Path,
    units: str,
    cases: Sequence[StaticCase],
    *,
    title: str,
    relief: bool = False,
    head: Sequence[str] = (),
) -> None:
    """Writes the deck, complete or not at all.

    Args:
        path: of the file.
        structure: the full model, SI.
        source: the user's deck.
        units: of the deck.
        cases: one subcase each.
        title: first line of every page.
        relief: loads are balanced by inertia; else they are in equilibrium.
        head: remarks at the top.

    Raises:
        InputError: the source cannot be read.
    """
    lines = _lines(structure, source, units, cases, title, relief, head)
    with written_aside(path) as part, part.open("w", encoding="utf-8") as file:
        file.writelines(line + "\n" for line in lines)


def _lines(
    structure: Structure,
    source: Path,
    units: str,
    cases: Sequence[StaticCase],
    title: str,
    relief: bool,
    head: Sequence[str],
) -> Iterator[str]:
    sections = split_sections(read_source(source).lines, str(source))
    left_out: Collection[str] = structure.deck.ignored
    bulk, parts = model_lines(
        sections,
        lambda read: (
            read.name in left_out
            or (read.name == "PARAM" and read.field(1).upper() == "INREL")
        ),
    )
    first = free_ids(bulk, len(cases) + 2)
    for text in head:
        yield from (f"$ {line}" for line in wrap(text, _WIDTH - 2))
    selections = model_selections(structure.subcase)
    yield from ("SOL 101", "CEND", f"TITLE = {title[:LABEL_WIDTH].upper()}")
    yield from (s for s in selections if relief or not s.startswith("SPC"))
    if not relief:
        yield f"SPC = {first}"
    yield from ("DISPLACEMENT = ALL", "STRESS = ALL", "FORCE = ALL")
    yield from (
        line.text
        for line in sections.case_control
        if line.text.upper().lstrip().startswith("PARAM") and "INREL" not in line.text
    )
    for k, case in enumerate(cases):
        yield f"SUBCASE {k + 1}"
        yield f"  SUBTITLE = {_ascii(case.subtitle)}"
        yield f"  LABEL = {_ascii(case.label)}"
        yield f"  LOAD = {first + 2 + k}"
    yield "BEGIN BULK"
    if relief:
        yield "PARAM,INREL,-2"
    else:
        yield "$ A determinate support: its reactions vanish."
        yield from _support(structure, first)
    for k, case in enumerate(cases):
        yield from _cards(structure, units, first + 2 + k, case.load)
    yield "$ The model"
    yield from (line.text for line in bulk)
    yield from parts
    yield "ENDDATA"


def _ascii(text: str) -> str:
    """As case control takes it; a comma at the end would continue the line."""
    plain = text.upper().replace("°", " DEG").encode("ascii", "replace").decode()
    return plain[:LABEL_WIDTH].strip(" ,")


def _support(structure: Structure, sid: int) -> Iterator[str]:
    """Six freedoms that hold the model, beside whatever the deck holds."""
    held, other = sid, structure.subcase.spc
    if other:
        held = sid + 1
        yield card("SPCADD", sid, held, other)
    rows = structure.elimination.f[determinate_rows(structure.rigid_body)]
    for row in rows.tolist():
        grid, component = divmod(int(row), 6)
        yield card("SPC1", held, component + 1, int(structure.points.grid_id[grid]))


def _cards(structure: Structure, units: str, sid: int, load: Float64) -> Iterator[str]:
    """FORCE and MOMENT in displacement frames, in the units of the deck."""
    points, of = structure.points, units_of(units)
    grids = len(points.grid_id)
    table = load[: 6 * grids].reshape(grids, 2, 3).copy()
    table /= np.array([of.force, of.moment])[:, None]
    frames = structure.deck.cards["GRID"].set_index("id")["cd"]
    for kind, values in (("FORCE", table[:, 0]), ("MOMENT", table[:, 1])):
        size = np.abs(values).max(axis=1)
        for i in np.flatnonzero(size > _LEAST * size.max(initial=0.0)).tolist():
            grid = int(points.grid_id[i])
            frame, value = int(frames[grid]), values[i].tolist()
            yield card(kind, sid, grid, frame, 1.0, *value, wide=True)
