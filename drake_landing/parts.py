"""What the parts see: loads that pass through a section of the airframe.

A section cuts off a part of the airframe. What passes through it is what the cut-off
part needs beside the loads on it to move as it does:

    F = Σ (M ü - P),    moment about the section's point likewise,

the sum over the grids of the part, M ü with the mass matrix of the full model: no
element is asked, shells and beams are cut alike, the damping forces are in. Signs: the
load of the rest of the airframe on the part, axes B.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]
Box = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]

COMPONENTS = ("fx", "fy", "fz", "mx", "my", "mz")


@dataclass(frozen=True, kw_only=True)
class Section:
    """A cut.

    Attributes:
        name: e.g. wing_root_right.
        boxes: ranges of x, y, z in B, m; grids in any of them are the part.
        point: (3,) of reference for the moments, m.
    """

    name: str
    boxes: tuple[Box, ...]
    point: tuple[float, float, float]

    def grids(self, structure: Structure) -> Int64:
        """Grid ids of the part."""
        p = structure.points.xyz
        inside = np.zeros(len(p), bool)
        for box in self.boxes:
            low, high = np.array(box).T
            inside |= np.all((p >= low) & (p <= high), axis=1)
        return structure.points.grid_id[inside]


_ANY = (-1e9, 1e9)

# Of the D150: at the side of body, and before and behind the wing box.
D150_SECTIONS = (
    Section(
        name="wing_root_right",
        boxes=(((10.0, 27.0), (1.9, 20.0), _ANY),),
        point=(15.85, 1.9, -1.2),
    ),
    Section(
        name="fuselage_front",
        boxes=(((-5.0, 12.7), (-2.2, 2.2), _ANY),),
        point=(12.7, 0.0, 0.0),
    ),
    Section(
        name="fuselage_rear",
        boxes=(((18.4, 27.0), (-2.2, 2.2), _ANY), ((27.0, 45.0), _ANY, _ANY)),
        point=(18.4, 0.0, 0.0),
    ),
)


@dataclass(frozen=True, kw_only=True)
class SectionOperator:
    """Loads through a section as linear maps.

    Attributes:
        of_acceleration: (6, f) on the accelerations of the free set.
        of_load: node -> (6, 6) on force and moment at an attachment node, B.
    """

    of_acceleration: sp.csr_matrix
    of_load: Mapping[int, Float64]


def section_operator(
    structure: Structure, section: Section, loaded: Mapping[int, Float64]
) -> SectionOperator:
    """Maps of a section.

    Args:
        structure: the full model.
        section: the cut.
        loaded: node -> (3,) position in B of every node that loads act on, m.

    Raises:
        ValueError: the boxes hold no grid.
    """
    grids = section.grids(structure)
    if not len(grids):
        raise ValueError(f"section {section.name}: no grid of the model is inside")
    points = structure.points
    point = np.array(section.point)
    gather = _resultant(points.xyz[points.rows(grids)] - point)
    dof = points.dof(grids[:, None], np.arange(1, 7)[None, :]).reshape(-1)
    # Forces of the g-set turned into basic axes, then added up about the point.
    turn = sp.csr_matrix(points.basic_rotation()[dof])
    mass = structure.matrices.mass
    of_acceleration = sp.csr_matrix(
        sp.csr_matrix(gather) @ turn @ mass @ structure.elimination.T
    )
    inside = set(grids.tolist())
    of_load = {
        node: -_resultant((place - point)[None])
        for node, place in loaded.items()
        if node in inside
    }
    return SectionOperator(of_acceleration=of_acceleration, of_load=of_load)


def section_load(
    operator: SectionOperator, inertia: Float64, node_id: Int64, load: Float64
) -> Float64:
    """(t, 6) force and moment through a section, columns `COMPONENTS`.

    Args:
        operator: of the section.
        inertia: (t, 6) `of_acceleration` times the accelerations.
        node_id: (k,) loaded nodes.
        load: (t, k, 6) on them, B.
    """
    total = inertia.copy()
    for k, node in enumerate(node_id):
        if int(node) in operator.of_load:
            total += load[:, k] @ operator.of_load[int(node)].T
    return total


def _resultant(arms: Float64) -> Float64:
    """(6, 6 k) force and moment about the origin of forces and moments at arms."""
    k = len(arms)
    matrix = np.zeros((6, k, 6))
    matrix[:3, :, :3] = np.eye(3)[:, None, :]
    matrix[3:, :, 3:] = np.eye(3)[:, None, :]
    x, y, z = arms.T
    matrix[3, :, 1], matrix[3, :, 2] = -z, y
    matrix[4, :, 0], matrix[4, :, 2] = z, -x
    matrix[5, :, 0], matrix[5, :, 1] = -y, x
    return matrix.reshape(6, 6 * k)
