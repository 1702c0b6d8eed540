"""One stress per element and instant: equivalent, largest and smallest direct stress.

    sheets      von Mises, the larger of both fibres. The stress is that of the sheet
                itself, from its strains: a skin with stringers smeared into its
                membrane has resultants that are not its own
    laminates   by the strengths of their plies, where MAT8 or SB give any
                (`ply_strength`); else von Mises of the isotropic plies that bear; where
                there are none (MAT8 faces on a soft core), the largest principal stress
                of any ply
    bars        largest magnitude of the direct stress at the stress points, or axial;
                where no stress points are given the axial stress is not the worst of a
                bar that bends: `axial_only`
    solids      von Mises at the center

Largest and smallest are the principal or direct stresses. All of it is a sparse matrix
on displacements of the g-set, then a few array operations; during a transient a kernel
does both (`stress_extremes`).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from drake_landing.parts.ply_strength import laminate_limits
from drake_landing.parts.shell_stress import laminated, sheets
from drake_landing.parts.stress_maps import Float64, Int64, StressPart, StressPiece
from fem.elements.block import ElementBlock
from fem.elements.lines.bar import Bar
from fem.elements.lines.beam import Beam
from fem.elements.shells.shell import Shell
from fem.model.structure import Structure
from fem.recovery.elements import ElementTable, TablePiece, element_tables

_LARGEST = ("major", "smax", "axial")
_SMALLEST = ("minor", "smin", "axial")


@dataclass(frozen=True, kw_only=True)
class Stresses:
    """Stresses of all elements of a structure that have any.

    Attributes:
        parts: elements of one kind each.
        expand: (g, f) g-set from the free set.
        without_points: ids, see `without_stress_points`.
        limits: what laminates are measured against, in words.
    """

    parts: tuple[StressPart, ...]
    expand: sp.csr_matrix = field(repr=False)
    limits: str = ""
    without_points: Int64 = field(default_factory=lambda: np.zeros(0, np.int64))

    @cached_property
    def axial_only(self) -> npt.NDArray[np.bool_]:
        """(e,) bars that bend and of which the axial stress alone is known."""
        return np.isin(self.id, self.without_points)

    @cached_property
    def id(self) -> Int64:
        """(e,) elements, part by part."""
        ids = [part.id for part in self.parts]
        return np.concatenate(ids) if ids else np.zeros(0, np.int64)

    def of(self, displacement: Float64) -> Float64:
        """(c, e, 3) `MEASURES` under displacements (f, c)."""
        if not self.parts:
            return np.zeros((displacement.shape[1], 0, 3))
        moved = np.asarray(self.expand @ displacement)
        return np.concatenate([part.of(moved) for part in self.parts], axis=1)


def stresses(
    structure: Structure, allowables: Mapping[int, float] | None = None
) -> Stresses:
    """Linear maps of all elements with stresses.

    Args:
        structure: of the deck.
        allowables: material id -> Pa, of the case, before those of the deck.
    """
    limits = laminate_limits(structure.deck, allowables or {})
    found: list[StressPart] = []
    for block in structure.blocks:
        if isinstance(block, Shell) and block.property_card == "PCOMP":
            found += laminated(structure, block, limits)
        elif isinstance(block, Shell):
            found.append(sheets(structure, block))
        else:
            found += _printed(structure, block)
    return Stresses(
        parts=tuple(found),
        expand=structure.elimination.T,
        without_points=without_stress_points(structure),
        limits=repr(limits) if limits else "",
    )


def without_stress_points(structure: Structure) -> Int64:
    """Ids of bars that bend and whose property gives no stress points (C, D, E, F)."""
    found = [np.zeros(0, np.int64)]
    for block in structure.blocks:
        if isinstance(block, Bar | Beam):
            points = block.section.recovery.reshape(len(block.id), -1)
            bends = block.end_stiffness[:, (4, 5), (4, 5)].any(axis=1)
            found.append(block.id[bends & ~points.any(axis=1)])
    return np.concatenate(found)


def stress_point_notices(structure: Structure) -> list[str]:
    """A line that says of which bars the axial stress alone is known, if any."""
    count = len(without_stress_points(structure))
    if not count:
        return []
    return [
        f"{count} bar{'s' * (count > 1)} without stress recovery points: only the "
        "axial stress is known, which leaves out bending and is no part of the worst "
        "stresses; look at the section loads, or give C, D, E, F on PBAR (PBEAM), or "
        "shapes by PBARL (PBEAML)"
    ]


def _printed(structure: Structure, block: ElementBlock) -> list[StressPart]:
    """From Nastran's printed columns: bars, rods, solids."""
    found = []
    for table in element_tables(structure.points, [block], "stress"):
        if not any(n.startswith((*_LARGEST, "von_mises")) for n in table.columns):
            continue
        pieces, first = [], 0
        for piece in table.pieces:
            after = first + len(piece.place)
            pieces.append(
                StressPiece(
                    elements=slice(first, after),
                    rows=piece.rows,
                    evaluate=partial(_columns, table=table, piece=piece),
                )
            )
            first = after
        found.append(
            StressPart(
                id=table.id,
                operator=table.operator,
                pieces=tuple(pieces),
            )
        )
    return found


def _columns(linear: Float64, table: ElementTable, piece: TablePiece) -> Float64:
    """Measures from the printed columns of some elements."""
    shape = (*linear.shape[:-1], len(piece.place), -1)
    values = piece.recovery.derive(linear.reshape(shape))

    def those(prefixes: tuple[str, ...]) -> Float64:
        return values[
            ..., [k for k, n in enumerate(table.columns) if n.startswith(prefixes)]
        ]

    high, low = those(_LARGEST).max(axis=-1), those(_SMALLEST).min(axis=-1)
    equal = those(("von_mises",))
    if equal.shape[-1]:
        return np.stack([equal.max(axis=-1), high, low], axis=-1)
    return np.stack([np.maximum(np.abs(high), np.abs(low)), high, low], axis=-1)
