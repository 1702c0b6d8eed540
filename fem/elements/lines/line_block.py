"""What CBAR and CBEAM have in common: two ends, offsets, pins, stresses over E."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import numpy.typing as npt

from fem.arrays import Float64, Int64
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock, some
from fem.elements.lines.line_geometry import LineGeometry, congruence
from fem.elements.lines.line_preload import line_differential
from fem.elements.lines.pins import condense
from fem.elements.lines.rod import stretched
from fem.elements.preload import turning_arm
from fem.properties.materials import Isotropic


@dataclass(frozen=True, kw_only=True)
class LineBlock(DenseBlock, ABC):
    """Elements with 12 freedoms between two grids, basic axes, to be extended.

    Attributes:
        pid: (e,) property ids.
        geometry: ends, offsets and axes.
        material: per element.
        released: (e, 12) freedoms at the ends that pin flags release.
    """

    pid: Int64
    geometry: LineGeometry
    material: Isotropic
    released: npt.NDArray[np.bool_]

    @property
    def axis(self) -> Float64:
        """(e, 3) from the first to the second end."""
        return self.geometry.R_BE[:, :, 0]

    @property
    def length(self) -> Float64:
        """(e,) between the ends."""
        return self.geometry.length

    @property
    def tref(self) -> Float64:
        """(e,) temperature without strain."""
        return self.material.tref

    def expansion(self) -> Float64:
        """(e, 12), see `DenseBlock`."""
        return stretched(self.axis, self.material.alpha * self.length)

    def bent(self, gradient: Float64) -> Float64:
        """(e, 12) displacements of freely bent elements, end A held.

        Args:
            gradient: (e, 2, 2) temperature per length along y and z (first index), at
                A and B; linear between. The warm side is the longer one.
        """
        length, e = self.length[:, None], len(self.id)
        curvature = -self.material.alpha[:, None, None] * gradient  # of v and w
        slope = 0.5 * length * curvature.sum(axis=2)
        across = length**2 * (curvature[..., 0] / 3.0 + curvature[..., 1] / 6.0)
        zero = np.zeros(e)
        move = np.stack([zero, across[:, 0], across[:, 1]], axis=1)
        turn = np.stack([zero, -slope[:, 1], slope[:, 0]], axis=1)
        R_BE, found = self.geometry.R_BE, np.zeros((e, 12))
        theta = np.einsum("eij,ej->ei", R_BE, turn)
        # The grid of end B moves with it, less what its offset adds.
        found[:, 6:9] = np.einsum("eij,ej->ei", R_BE, move) - np.cross(
            theta, self.geometry.offset_b
        )
        found[:, 9:] = theta
        return found

    @property
    def extent(self) -> Float64:
        """(e,) length between the ends; of CBEAM, between its shear centers."""
        return self.geometry.length

    @abstractmethod
    def _stiffness_at_ends(self) -> Float64:
        """(e, 12, 12) stiffness at the ends in element axes, before pins release."""

    @abstractmethod
    def stresses(self) -> Recovery:
        """Stresses at the stress points of both ends."""

    @cached_property
    def end_stiffness(self) -> Float64:
        """(e, 12, 12) stiffness at the ends in element axes, before pins release."""
        return self._stiffness_at_ends()

    @abstractmethod
    def preload_section(self) -> tuple[Float64, Float64]:
        """(e, 2) shear ratios and (e,) polar radius squared, see `line_preload`."""

    @cached_property
    def _map(self) -> Float64:
        return self.geometry.grid_to_end()

    @cached_property
    def _condensed(self) -> tuple[Float64, Float64]:
        return condense(self.end_stiffness, self.released)

    def _widened(self, matrix: Float64) -> Float64:
        """A matrix (e, 12, 12) at the ends for all freedoms that the ends have."""
        return matrix

    @property
    def _at_ends(self) -> Float64:
        return self._condensed[0]

    def stiffness(self) -> Float64:
        """(e, n, n) of the grids: that of the ends with pins and offsets."""
        return congruence(self._map, self._at_ends)

    def differential_stiffness(
        self, motion: Float64, load: Float64 | None = None
    ) -> Float64:
        """(e, 12, 12) of the section forces, and of the arms that offsets are.

        A section without torsional stiffness says nothing of its twist: no thrust turns
        it (the differential stiffness of NASTRAN-95's bar, which has J for the polar
        moment, likewise). Which component AUTOSPC holds does so not count.
        """
        geometry = self.geometry
        force = np.einsum("eij,ej->ei", self._at_ends @ self._map, motion)[:, :12]
        if load is not None:
            force -= np.einsum("eij,ej->ei", geometry.end_forces(), load[:, :12])
        ratio, polar = self.preload_section()
        polar = np.where(self.end_stiffness[:, 3, 3] > 0.0, polar, 0.0)
        at_ends = self._widened(line_differential(geometry.length, force, ratio, polar))
        matrix = congruence(self._condensed[1] @ self._map, at_ends)
        for k, arm in ((0, geometry.offset_a), (6, geometry.offset_b)):
            tip = np.einsum("eij,ej->ei", geometry.R_BE, force[:, k : k + 3])
            rows = slice(k + 3, k + 6)
            matrix[:, rows, rows] += turning_arm(tip, arm)
        return matrix

    def structural_damping(self) -> Float64 | None:
        """(e,) GE of the material."""
        return some(self.material.ge)

    def strains(self) -> Recovery:
        """Stresses over Young's modulus."""
        stress = self.stresses()
        return replace(stress, matrix=stress.matrix * self._per_modulus)

    @property
    def _per_modulus(self) -> Float64:
        """(e, 1, 1) 1/E; no strain is printed where E is zero."""
        return per_modulus(self.material)


def per_modulus(material: Isotropic) -> Float64:
    """(e, 1, 1) 1 / E, 0 where a material has none."""
    e = material.e
    return np.divide(1.0, e, out=np.zeros_like(e), where=e != 0.0)[:, None, None]
