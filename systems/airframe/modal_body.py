"""The modal body: all that the multibody side needs to know of a flexible airframe.

It is made by the reduction of a finite-element model, or read from elsewhere. Frame B
is the basic frame of that model; shapes and inertia are those of mean axes (free-free
elastic modes, which carry neither momentum nor moment of momentum).
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class ModalBody:
    """A free-free body with n elastic modes, known at k nodes.

    Attributes:
        mass: kg.
        p_BG: (3,) center of gravity in B, m.
        inertia_G: (3, 3) moment of inertia about the center of gravity, B axes, kg m².
        frequency: (n,) natural frequencies of the elastic modes, Hz, ascending.
        modal_mass: (n,) kg (kg m² for a rotation-normalised mode).
        modal_damping: (n, n) projection of the viscous damping matrix, kg/s.
        node_id: (k,) grid ids of the deck, ascending.
        p_BN: (k, 3) node positions in B, m.
        translation: (k, 3, n) modal displacement of the nodes in B axes, m per unit
            amplitude.
        rotation: (k, 3, n) modal rotation of the nodes in B axes, rad per unit
            amplitude.

    Raises:
        ValueError: a shape or sign is inconsistent; the message names the attribute.
    """

    mass: float
    p_BG: Float64
    inertia_G: Float64
    frequency: Float64
    modal_mass: Float64
    modal_damping: Float64
    node_id: Int64
    p_BN: Float64
    translation: Float64
    rotation: Float64

    def __post_init__(self) -> None:
        n, k = len(self.frequency), len(self.node_id)
        shapes = {
            "p_BG": (3,),
            "inertia_G": (3, 3),
            "modal_mass": (n,),
            "modal_damping": (n, n),
            "p_BN": (k, 3),
            "translation": (k, 3, n),
            "rotation": (k, 3, n),
        }
        for name, shape in shapes.items():
            found = np.shape(getattr(self, name))
            if found != shape:
                raise ValueError(f"modal body: {name} has shape {found}, not {shape}")
        if not self.mass > 0:
            raise ValueError(f"modal body: mass {self.mass} kg, expected > 0")
        if np.any(np.linalg.eigvalsh(self.inertia_G) <= 0):
            raise ValueError("modal body: inertia_G is not positive definite")
        if np.any(self.frequency <= 0) or np.any(self.modal_mass <= 0):
            raise ValueError(
                "modal body: elastic modes need frequency > 0 and modal_mass > 0; "
                "rigid-body modes do not belong to it"
            )
        if np.any(np.diff(self.node_id) <= 0):
            raise ValueError("modal body: node_id must be strictly ascending")

    @property
    def n(self) -> int:
        """Number of elastic modes."""
        return len(self.frequency)

    def rows(self, node_id: npt.ArrayLike) -> Int64:
        """Rows of the given nodes.

        Raises:
            ValueError: a node is not one of the body's; the message names it.
        """
        wanted = np.atleast_1d(np.asarray(node_id, dtype=np.int64))
        row = np.searchsorted(self.node_id, wanted)
        row = np.minimum(row, len(self.node_id) - 1)
        missing = wanted[self.node_id[row] != wanted]
        if missing.size:
            raise ValueError(f"modal body: no node {missing.tolist()}")
        return row
