"""Printed results of shells from their resultants, in Nastran's columns.

Element axes. M follows Nastran: the stress at height z is N / t - 12 M z / t^3. Results
at more than one point (center, corners) or fibre stand side by side: the columns of
corner k start with `c<k>_`, those of the lower and upper fibre end with `_1` and `_2`.
"""

from dataclasses import dataclass, replace

import numpy as np

from fem.arrays import Float64, Int64
from fem.deck.records.shells import SHELL_STRAIN, SHELL_STRESS, at_fibres
from fem.elements.block import Recovery
from fem.elements.stress_measures import (
    plane_columns,
    plane_von_mises,
    plane_von_mises_strain,
)


def with_heat(matrix: Float64) -> Float64:
    """(e, c + 2, n): two quantities that do not depend on displacements."""
    return np.pad(matrix, ((0, 0), (0, 2), (0, 0)))


def point_names(columns: tuple[str, ...], points: int) -> tuple[str, ...]:
    """Columns of the center and of the corners 1 ... points - 1."""
    prefixes = ("", *(f"c{k}_" for k in range(1, points)))
    return tuple(f"{prefix}{name}" for prefix in prefixes for name in columns)


def stress_names(points: int) -> tuple[str, ...]:
    """Columns of stresses at both fibres of each point."""
    return point_names(at_fibres(SHELL_STRESS), points)


def strain_names(points: int) -> tuple[str, ...]:
    """Columns of strains at both fibres of each point."""
    return point_names(at_fibres(SHELL_STRAIN), points)


@dataclass(frozen=True, kw_only=True)
class FibreRecovery(Recovery):
    """Stresses or strains at two fibres from xx yy xy of each, per point.

    Attributes:
        fibre: (e, 2) printed first column.
        strain: strains instead of stresses.
    """

    fibre: Float64
    strain: bool = False

    def derive(self, linear: Float64) -> Float64:
        """(..., e, c) from (..., e, 6 p): xx yy xy at Z1 and Z2 of each point."""
        values = linear.reshape(*linear.shape[:-1], -1, 2, 3)
        xx, yy, xy = np.moveaxis(values, -1, 0)
        shear = 0.5 * xy if self.strain else xy
        measure = plane_von_mises_strain if self.strain else plane_von_mises
        fibre = np.broadcast_to(self.fibre[:, None, :], xx.shape)
        columns = (
            fibre,
            xx,
            yy,
            xy,
            *plane_columns(xx, yy, shear),
            measure(xx, yy, xy),
        )
        return np.stack(columns, axis=-1).reshape(*linear.shape[:-1], -1)


@dataclass(frozen=True, kw_only=True)
class PlyRecovery(Recovery):
    """Ply stresses or strains from the resultants N M Q at the element center.

    Attributes:
        laminate: (e,) which of the laminates.
        maps: per laminate (5 p, 8) from resultants in material axes to 11 22 12 1z 2z
            of p plies, NaN where a laminate has fewer. (A tuple: not one per element.)
        residual: per laminate (5 p, 2) what degree and gradient leave in free plies.
        strain: strains instead of stresses; the largest shear is then engineering.
    """

    laminate: Int64
    maps: tuple[Float64, ...]
    residual: tuple[Float64, ...]
    strain: bool = False

    def heated(self, relief: Float64, heat: Float64) -> tuple[Recovery, Float64]:
        """Degrees and gradients are two quantities more."""
        maps = tuple(np.hstack(pair) for pair in zip(self.maps, self.residual))
        return (
            replace(self, maps=maps, matrix=with_heat(self.matrix)),
            np.hstack([relief, heat]),
        )

    def derive(self, linear: Float64) -> Float64:
        """(..., e, 9 p) from (..., e, 8) resultants in material axes."""
        ply = np.einsum("eij,...ej->...ei", np.stack(self.maps)[self.laminate], linear)
        ply = ply.reshape(*ply.shape[:-1], -1, 5)
        half = 0.5 if self.strain else 1.0
        angle, major, minor = plane_columns(
            ply[..., 0], ply[..., 1], half * ply[..., 2]
        )
        largest = (major - minor) * (0.5 / half)
        derived = np.stack([angle, major, minor, largest], axis=-1)
        columns = np.concatenate([ply, derived], axis=-1)
        return columns.reshape(*linear.shape[:-1], -1)
