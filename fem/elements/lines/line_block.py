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
from fem.elements.lines.pins import condense
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
    def extent(self) -> Float64:
        """(e,) length between the ends; of CBEAM, between its shear centres."""
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

    @cached_property
    def _map(self) -> Float64:
        return self.geometry.grid_to_end()

    @cached_property
    def _at_ends(self) -> Float64:
        return condense(self.end_stiffness, self.released)[0]

    def stiffness(self) -> Float64:
        return congruence(self._map, self._at_ends)

    def structural_damping(self) -> Float64 | None:
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
