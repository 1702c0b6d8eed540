"""CBUSH: six springs and dashpots at a point between two grids, or to ground.

The spring-damper sits at GA + S (GB - GA), or at the offset S1 S2 S3 from GA in frame
OCID; both grids move its sides as rigid bodies, so that rigid motion is free of force
wherever it sits.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Bool, Float64, Int64
from fem.deck.records.scalars import BUSH_FORCE, BUSH_STRESS
from fem.deck.references import column, refer, table, where
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock
from fem.elements.lines.line_geometry import (
    axes_about,
    axes_from_vector,
    congruence,
    skew,
)
from fem.elements.lines.orientation import orientation_vectors
from fem.errors import Problems
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class Bushings(DenseBlock):
    """All CBUSH elements; 12 freedoms, basic axes, -1 for the side of ground.

    Attributes:
        motion: (e, 6, 12) motion of side B relative to side A at the spring, along the
            element axes.
        k, b: (e, 6) stiffness and damping along and about the element axes.
        ge: (e, 6) structural damping of each stiffness.
        m: (e,) mass, half to each grid.
        coefficients: (e, 4) SA ST EA ET for stresses and strains.
    """

    motion: Float64
    k: Float64
    b: Float64
    ge: Float64
    m: Float64
    coefficients: Float64

    def stiffness(self) -> Float64:
        """(e, 12, 12) of six springs along the element axes."""
        return self._along_axes(self.k)

    def structural_damping(self) -> Float64 | None:
        """(e, 12, 12) Σ GE K by component, None where all are zero."""
        return self._along_axes(self.ge * self.k) if np.any(self.ge) else None

    def damping(self) -> Float64 | None:
        """(e, 12, 12) of six dashpots along the element axes."""
        return self._along_axes(self.b) if np.any(self.b) else None

    def mass(self, *, coupled: bool) -> Float64 | None:
        """(e, 12, 12) half of M at each end, translations."""
        if not np.any(self.m):
            return None
        matrix = np.zeros((len(self.m), 12, 12))
        for i in (0, 1, 2, 6, 7, 8):
            matrix[:, i, i] = 0.5 * self.m
        return matrix

    def forces(self) -> Recovery:
        """Forces of the springs and, in motion, of the dashpots.

        In harmonic motion (K + i GE K + i w B) u, as MSC Nastran has them.
        """
        return self._recovery(BUSH_FORCE, np.ones_like(self.k))

    def stresses(self) -> Recovery:
        """Forces times the coefficients SA and ST of PBUSH (RCV), 1 by default."""
        stress = np.repeat(self.coefficients[:, :2], 3, axis=1)
        return self._recovery(BUSH_STRESS, stress)

    def strains(self) -> Recovery:
        """Deformations times the coefficients EA and ET of PBUSH (RCV)."""
        strain = np.repeat(self.coefficients[:, 2:], 3, axis=1)
        return Recovery(
            table=self.card,
            columns=BUSH_STRESS,
            matrix=strain[:, :, None] * self.motion,
            id=self.id,
        )

    def _recovery(self, columns: tuple[str, ...], factor: Float64) -> Recovery:
        """Forces along the axes times factors (e, 6)."""

        def map_of(values: Float64) -> Float64 | None:
            if not np.any(values):
                return None
            return (factor * values)[:, :, None] * self.motion

        return Recovery(
            table=self.card,
            columns=columns,
            matrix=(factor * self.k)[:, :, None] * self.motion,
            rate=map_of(self.b),
            loss=map_of(self.ge * self.k),
            id=self.id,
        )

    def _along_axes(self, values: Float64) -> Float64:
        return congruence(self.motion, values[:, :, None] * np.eye(6))


def read_cbush(deck: "Deck", points: Points) -> list[Bushings]:
    """The CBUSH block of a deck, or none.

    Raises:
        InputError: undefined references, element axes that are not defined.
    """
    rows = table(deck, "CBUSH").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    values = refer(rows, "CBUSH", "pid", table(deck, "PBUSH"), "PBUSH")
    lateral = np.any((_sixes(values, "ks") + _sixes(values, "bs"))[:, [1, 2, 4, 5]], 1)
    dof, motion = place_between(rows, "CBUSH", points, lateral)
    return [
        Bushings(
            card="CBUSH",
            id=rows["eid"].to_numpy(np.int64),
            dof=dof,
            motion=motion,
            k=_sixes(values, "ks"),
            b=_sixes(values, "bs"),
            ge=_damping_factors(_sixes(values, "ges")),
            m=column(values, "mass"),
            coefficients=np.stack(
                [column(values, name) for name in ("sa", "st", "ea", "et")], axis=1
            ),
        )
    ]


def place_between(
    rows: pd.DataFrame, card: str, points: Points, lateral: Bool | None = None
) -> tuple[Int64, Float64]:
    """Freedoms (e, 12) and relative motion (e, 6, 12) of springs between two grids.

    Args:
        rows: cards with ga, gb (0: ground), cid (-1: none), g0, x1, x2, x3, s and,
            where they may be offset, ocid, s1, s2, s3.
        card: their name.
        points: grids.
        lateral: (e,) True where the directions across the line matter.

    Raises:
        InputError: element axes that are not defined.
    """
    at_a = points.rows(rows["ga"].to_numpy(np.int64))
    gb = rows["gb"].to_numpy(np.int64)
    at_b = np.where(gb > 0, points.rows(np.where(gb > 0, gb, rows["ga"])), -1)
    xyz_a = points.xyz[at_a]
    between = np.where((at_b >= 0)[:, None], points.xyz[at_b] - xyz_a, 0.0)
    if lateral is None:
        lateral = np.zeros(len(rows), bool)
    axes = _axes(rows, card, lateral, points, between)
    place = _places(rows, points, between)
    freedoms = np.arange(6)
    dof_b = np.where((at_b >= 0)[:, None], 6 * at_b[:, None] + freedoms, -1)
    dof = np.hstack([6 * at_a[:, None] + freedoms, dof_b])
    return dof, relative_motion(axes, place, place - between)


def relative_motion(axes: Float64, from_a: Float64, from_b: Float64) -> Float64:
    """(e, 6, 12) motion of side B less that of side A at the spring, element axes.

    Args:
        axes: (e, 3, 3) R_BE.
        from_a, from_b: (e, 3) the spring's place from both grids, basic.
    """
    motion = np.zeros((len(axes), 6, 12))
    to_element = axes.transpose(0, 2, 1)
    for k, sign, lever in ((0, -1.0, from_a), (6, 1.0, from_b)):
        motion[:, :3, k : k + 3] = sign * to_element
        motion[:, :3, k + 3 : k + 6] = -sign * to_element @ skew(lever)
        motion[:, 3:, k + 3 : k + 6] = sign * to_element
    return motion


def _axes(
    rows: pd.DataFrame, card: str, lateral: Bool, points: Points, between: Float64
) -> Float64:
    """(e, 3, 3) element axes: CID, else the line AB with v, else AB alone."""
    cid = rows["cid"].to_numpy(np.int64)
    at_a = points.rows(rows["ga"].to_numpy(np.int64))
    axes = points.frames.triads(np.maximum(cid, 0), points.xyz[at_a])
    v = orientation_vectors(rows, points, np.zeros(len(rows), bool))
    has_v = np.any(v != 0.0, axis=1)
    apart = np.any(between != 0.0, axis=1)
    by_vector = (cid < 0) & apart & has_v
    by_line = (cid < 0) & apart & ~has_v
    with np.errstate(invalid="ignore", divide="ignore"):
        axes[by_vector] = axes_from_vector(between[by_vector], v[by_vector])
        axes[by_line] = axes_about(between[by_line])
    _refuse(rows, card, lateral, cid, apart, by_line, axes)
    return axes


def _refuse(
    rows: pd.DataFrame,
    card: str,
    lateral: Bool,
    cid: np.ndarray,
    apart: np.ndarray,
    by_line: np.ndarray,
    axes: Float64,
) -> None:
    problems = Problems()
    for i in range(len(rows)):
        if cid[i] < 0 and not apart[i]:
            reason = "its grids coincide or one is ground: CID is needed"
        elif by_line[i] and lateral[i]:
            reason = "lateral stiffness or damping needs axes: give CID, G0 or X1 X2 X3"
        elif np.isnan(axes[i]).any():
            reason = "the orientation vector is parallel to the element"
        else:
            continue
        problems.append(f"{where(card, rows.iloc[i])}: {reason}")
    problems.report()


def _places(rows: pd.DataFrame, points: Points, between: Float64) -> Float64:
    """(e, 3) the spring's place from grid A, basic."""
    share = rows["s"].to_numpy(float)
    share = np.where(np.isnan(share), 0.5, share)
    if "ocid" not in rows:
        return share[:, None] * between
    ocid = rows["ocid"].to_numpy(np.int64)
    at_a = points.rows(rows["ga"].to_numpy(np.int64))
    offset = np.stack([column(rows, f"s{i}") for i in (1, 2, 3)], axis=1)
    axes = points.frames.triads(np.maximum(ocid, 0), points.xyz[at_a])
    given = np.einsum("eij,ej->ei", axes, offset)
    return np.where((ocid >= 0)[:, None], given, share[:, None] * between)


def _damping_factors(ge: Float64) -> Float64:
    """GE1 alone holds for all six components, as Nastran's guide has it."""
    alone = ~np.any(ge[:, 1:], axis=1)
    return np.where(alone[:, None], ge[:, :1], ge)


def _sixes(values: pd.DataFrame, name: str) -> Float64:
    return np.nan_to_num(np.stack([np.asarray(v, float) for v in values[name]]))
