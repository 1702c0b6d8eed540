"""Equivalent static cases: the load of an instant as forces on the full model.

Two loads stand for an instant. P - M ü balances to rounding, but in Nastran's scheme it
belongs to displacements averaged over three steps. K u reproduces the displacements of
the instant, hence every element force and stress, exactly; it is what is written here,
as FORCE and MOMENT. It is in equilibrium with itself, for rigid motions cost no energy.
A determinate support (six freedoms) holds the model and carries nothing.

Displacements are those of the screening, so that the static stresses agree with the
screened ones to rounding, and with the direct transient within the screening's error.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from drake_landing.campaign.setup import Prepared
from drake_landing.campaign.task import case_file
from drake_landing.transient.deck import model_selections
from fem.algebra.statics import determinate_rows
from fem.arrays import Float64
from fem.deck.sections import split_sections
from fem.deck.source import read_source
from fem.deck.units import units_of
from fem.files.aside import written_aside
from fem.files.deck_writer import real

_LEAST = 1e-9  # of the largest force or moment: below, nothing is written
_FIRST_ID = 900001


@dataclass(frozen=True, kw_only=True)
class Instant:
    """A landing at an instant.

    Attributes:
        case: number of the landing.
        time: s.
        why: what is extreme then.
    """

    case: int
    time: float
    why: str


def displacement_at(own: Prepared, folder: Path, instant: Instant) -> Float64:
    """(f,) displacements of the free set by the screening, increments to the start."""
    with h5py.File(case_file(folder, instant.case)) as file:
        time = np.asarray(file["loads/time"])
        at = int(np.abs(time - instant.time).argmin())
        load = np.asarray(file["loads/load"][at]).ravel()
        q = np.asarray(file["loads/amplitudes"][:, at], float)
    return own.shape @ np.concatenate([q, load])


def equivalent_loads(own: Prepared, displacement: Float64) -> Float64:
    """(g,) K u on the rows of the g-set, displacement frames, N and N m.

    The free set's rows carry all of it: dependent grids move with them, and forces on
    independent freedoms do the same work.
    """
    structure = own.airframe.structure
    force = np.zeros(structure.points.size)
    force[structure.elimination.f] = structure.stiffness @ displacement
    return force


def static_deck(
    own: Prepared, folder: Path, instants: Sequence[Instant], path: Path
) -> None:
    """Writes a complete SOL 101 deck, one subcase per instant, in the deck's units.

    Args:
        own: the airframe.
        folder: of the case files.
        instants: which.
        path: of the deck.
    """
    loads = [equivalent_loads(own, displacement_at(own, folder, i)) for i in instants]
    with written_aside(path) as part, part.open("w", encoding="utf-8") as file:
        file.writelines(line + "\n" for line in _lines(own, instants, loads))


def _lines(
    own: Prepared, instants: Sequence[Instant], loads: Iterable[Float64]
) -> Iterator[str]:
    structure, source = own.airframe.structure, own.aircraft.deck
    sections = split_sections(read_source(source).lines, str(source))
    selections = model_selections(structure.subcase)
    yield from ("SOL 101", "CEND", "TITLE = EQUIVALENT STATIC CASES OF LANDINGS")
    yield from (s for s in selections if not s.startswith("SPC"))
    spc = _FIRST_ID
    yield f"SPC = {spc}"
    yield from ("DISPLACEMENT = ALL", "STRESS = ALL", "FORCE = ALL")
    for k, instant in enumerate(instants):
        yield f"SUBCASE {k + 1}"
        yield f"  SUBTITLE = CASE {instant.case} AT {instant.time:.4f} S"
        yield f"  LABEL = {instant.why.upper()[:60]}"
        yield f"  LOAD = {spc + 1 + k}"
    yield "BEGIN BULK"
    yield "$ A determinate support: its reactions vanish."
    yield from _support(own, spc, len(instants))
    for k, load in enumerate(loads):
        yield from _cards(own, spc + 1 + k, load)
    yield "$ The model"
    for line in sections.bulk:
        if line.text[:8].upper().strip() == "ENDDATA":
            break
        yield line.text
    yield "ENDDATA"


def _support(own: Prepared, sid: int, count: int) -> Iterator[str]:
    """Six freedoms that hold the model, beside whatever the deck holds."""
    structure = own.airframe.structure
    held, other = sid, structure.subcase.spc
    if other:
        held = sid + 1 + count
        yield f"SPCADD,{sid},{held},{other}"
    rows = structure.elimination.f[determinate_rows(structure.rigid_body)]
    for row in rows.tolist():
        grid, component = divmod(int(row), 6)
        yield f"SPC1,{held},{component + 1},{structure.points.grid_id[grid]}"


def _cards(own: Prepared, sid: int, load: Float64) -> Iterator[str]:
    """FORCE and MOMENT in displacement frames, in the units of the deck."""
    points, units = own.airframe.structure.points, units_of(own.aircraft.units)
    grids = len(points.grid_id)
    table = load[: 6 * grids].reshape(grids, 2, 3).copy()
    table /= np.array([units.force, units.moment])[:, None]
    frames = own.airframe.structure.deck.cards["GRID"].set_index("id")["cd"]
    for kind, values in (("FORCE", table[:, 0]), ("MOMENT", table[:, 1])):
        size = np.abs(values).max(axis=1)
        for i in np.flatnonzero(size > _LEAST * size.max(initial=0.0)).tolist():
            grid = int(points.grid_id[i])
            x, y, z = (real(float(v), 16) for v in values[i])
            yield f"{kind + '*':8}{sid:16d}{grid:16d}{int(frames[grid]):16d}{'1.':>16}"
            yield f"{'*':8}{x:>16}{y:>16}{z:>16}"
