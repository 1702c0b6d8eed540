"""Equivalent static cases: the load of an instant as forces on the full model.

Two loads stand for an instant. P - M ü balances to rounding, but in Nastran's scheme it
belongs to displacements averaged over three steps. K u reproduces the displacements of
the instant, hence every element force and stress, exactly; it is what is written here,
as FORCE and MOMENT. It is in equilibrium with itself, for rigid motions cost no energy.
A determinate support (six freedoms) holds the model and carries nothing.

Displacements are those of the screening, so that the static stresses agree with the
screened ones to rounding, and with the direct transient within the screening's error.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from drake_landing.campaign.setup import Prepared
from drake_landing.campaign.task import case_file
from drake_landing.transient.static_deck import StaticCase, write_static_deck
from fem.arrays import Float64


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
    structure = own.structure
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
    cases = [
        StaticCase(
            subtitle=f"case {i.case} at {i.time:.4f} s",
            label=i.why,
            load=equivalent_loads(own, displacement_at(own, folder, i)),
        )
        for i in instants
    ]
    write_static_deck(
        path,
        own.structure,
        own.aircraft.deck,
        own.aircraft.units,
        cases,
        title="equivalent static cases of landings",
    )
