"""The complete SOL 109 deck of a landing: the user's model under the attachment loads.

The bulk data of the model is copied, its INCLUDEs in place, so that the deck is
self-contained; executive and case control are replaced, save the selections that belong
to the model (constraints, direct input matrices, parameters). Every load component of
every attachment node is one TLOAD1 with its DAREA, in the node's displacement frame,
and TABLED1. Real numbers are written in large fields with ten digits.
"""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from textwrap import wrap

import numpy as np
import numpy.typing as npt

from drake_landing.landing.handover import AttachmentLoads
from fem.deck.control.subcase import Subcase
from fem.deck.text.lexer import RawCard, read_cards, without_cards
from fem.deck.text.sections import Sections, split_sections
from fem.deck.text.source import Line, read_source
from fem.errors import InputError
from fem.files.atomic import written_aside
from fem.files.escaping import comment

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_FIRST_ID = 900001
_WIDTH = 72  # characters of a line of Nastran's
_PER_LINE = 8  # entries of a SET or grid list per line


def transient_deck(
    source: Path,
    loads: AttachmentLoads,
    rotation: Float64,
    *,
    output: Sequence[int],
    selections: Sequence[str] = (),
    title: str = "LANDING",
    head: Sequence[str] = (),
    elements: Sequence[int] = (),
    left_out: Collection[str] = (),
    params: Mapping[str, float] | None = None,
    dropped: Collection[str] = (),
) -> Iterable[str]:
    """Lines of the deck.

    Args:
        source: the user's deck, with or without executive and case control.
        loads: on the even grid of the transient, basic axes.
        rotation: (k, 3, 3) R_BD of the attachment nodes, columns are the displacement
            axes in the basic frame.
        output: grids whose displacements and accelerations are printed.
        selections: case control lines of the model, such as "SPC = 1".
        title: first line of every page.
        head: remarks at the top.
        elements: whose forces and stresses are printed.
        left_out: names of cards of the source that were ignored.
        params: PARAM values that are added.
        dropped: PARAM names of the source that are left out.

    Raises:
        InputError: the source cannot be read.
    """
    sections = split_sections(read_source(source).lines, str(source))
    params = params or {}
    bulk, parts = model_lines(
        sections,
        lambda card: (
            card.name in left_out or (card.name == "PARAM" and card.field(1) in dropped)
        ),
    )
    time, load = loads.held()
    components = np.concatenate(
        [
            np.einsum("kba,tkb->tka", rotation, load[..., :3]),
            np.einsum("kba,tkb->tka", rotation, load[..., 3:]),
        ],
        axis=-1,
    )
    first = free_ids(bulk, 2 + components[0].size)
    for text in head:
        yield from (f"$ {line}" for line in wrap(comment(text), _WIDTH - 2))
    title = comment(title)[:60].upper().rstrip(", ")
    yield from ("SOL 109", "CEND", f"TITLE = {title}", *selections)
    yield from (
        line.text
        for line in sections.case_control
        if (words := [w.strip() for w in line.text.upper().split(",")])[0] == "PARAM"
        and words[1] not in dropped
    )
    yield from _set_lines(1, sorted(output))
    yield from ("DISPLACEMENT = 1", "ACCELERATION = 1")
    if elements:
        yield from _set_lines(2, sorted(elements))
        yield from ("FORCE = 2", "STRESS = 2")
    yield from (f"DLOAD = {first}", f"TSTEP = {first}", "BEGIN BULK")
    yield from _step_cards(first, len(loads.time) - 1, loads.step)
    yield from _load_cards(first, loads.node_id, time, components)
    for name, value in params.items():
        yield _large("PARAM", name, float(value))[0]
        yield "*"
    yield "$ The model"
    yield from (line.text for line in bulk)
    yield from parts
    yield "ENDDATA"


def write_transient_deck(path: Path, lines: Iterable[str]) -> None:
    """Writes the file, complete or not at all."""
    with written_aside(path) as part, part.open("w", encoding="utf-8") as file:
        file.writelines(line + "\n" for line in lines)


def model_selections(subcase: Subcase) -> list[str]:
    """Case control lines of what belongs to the model rather than to its loading."""
    names = ("spc", "mpc", "nsm", "massset", "suport1", "k2gg", "m2gg", "b2gg")
    return [
        f"{name.upper()} = {getattr(subcase, name)}"
        for name in names
        if getattr(subcase, name)
    ]


def model_lines(
    sections: Sections, drop: Callable[[RawCard], bool]
) -> tuple[list[Line], list[str]]:
    """Main bulk data, and lines of the sections after it, without ENDDATA.

    Args:
        sections: of the deck.
        drop: cards that are left out.

    Raises:
        InputError: an INCLUDE is not there.
    """
    parts = []
    for begin, lines in sections.parts():
        own = without_cards(until_enddata(lines), drop)
        parts += [begin, *(line.text for line in own)]
    return without_cards(until_enddata(sections.bulk), drop), parts


def until_enddata(lines: Sequence[Line]) -> list[Line]:
    """The bulk data without ENDDATA.

    Raises:
        InputError: an INCLUDE is not there.
    """
    words = [line.text[:8].upper().strip() for line in lines]
    end = words.index("ENDDATA") if "ENDDATA" in words else len(words)
    missing = [line for line in lines[:end] if line.missing]
    if missing:
        raise InputError(
            f"{line.file}:{line.number}: the file of {line.text} is not there"
            for line in missing
        )
    return list(lines[:end])


def free_ids(bulk: Sequence[Line], count: int) -> int:
    """First of that many ids that no card has in its first field."""
    used = {
        int(card.field(1)) for card in read_cards(bulk).cards if card.field(1).isdigit()
    }
    first = _FIRST_ID
    while clash := [i for i in range(first, first + count) if i in used]:
        first = clash[-1] + 1
    return first


def _step_cards(sid: int, count: int, step: float) -> list[str]:
    return [_large("TSTEP", sid, count, float(step), 1)[0], "*"]


def _load_cards(
    first: int, node_id: Int64, time: Float64, components: Float64
) -> Iterable[str]:
    sid = first + 1
    summands: list[float | int] = []
    cards: list[str] = []
    for k, node in enumerate(node_id.tolist()):
        for c in range(6):
            history = components[:, k, c]
            if not np.any(history):
                continue
            summands += [1.0, sid]
            cards.append(f"TLOAD1  {sid:8d}{sid:8d}{'':16}{sid:8d}")
            cards.append(f"DAREA   {sid:8d}{node:8d}{c + 1:8d}{'1.':>8}")
            cards += _table(sid, time, history)
            sid += 1
    if not summands:
        raise InputError(
            "simulation.duration: no attachment load is different from zero: the gears "
            "do not touch the runway within it, expected longer"
        )
    yield from _large("DLOAD", first, 1.0, *summands)
    yield from cards


def _table(tid: int, time: Float64, values: Float64) -> list[str]:
    pairs = np.column_stack([time, values]).ravel().tolist()
    head = [_large("TABLED1", tid)[0], "*"]
    return head + _large("", *pairs, "ENDT")


def _large(name: str, *fields: float | int | str) -> list[str]:
    """A card in large fields: four of sixteen characters per line."""
    texts = [_field(value) for value in fields]
    rows = [texts[i : i + 4] for i in range(0, len(texts), 4)]
    heads = [f"{name + '*':8}"] + ["*       "] * (len(rows) - 1)
    lines = [(h + "".join(f"{t:>16}" for t in row)) for h, row in zip(heads, rows)]
    # Small and large lines come in pairs: a card has an even number of half rows.
    return lines if len(lines) % 2 == 0 or not name else [*lines, "*"]


def _field(value: float | int | str) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, int):
        return str(value)
    # Three-digit exponents do not fit, and mean nothing here.
    return f"{value if abs(value) > 1e-30 else 0.0:.9e}"


def _set_lines(number: int, ids: Sequence[int]) -> list[str]:
    rows = [ids[i : i + _PER_LINE] for i in range(0, len(ids), _PER_LINE)]
    texts = [", ".join(map(str, row)) for row in rows]
    return [f"SET {number} = " + ",\n".join(texts)] if texts else []
