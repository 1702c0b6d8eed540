"""Elastic modes of a structure for pictures, and in words what moves in them."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.show.mesh import DrawnMesh
from fem.algebra.modes import ModesError, normal_modes
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]

_RIGID = 6
_NAMED_SHARE = 0.15  # of the kinetic energy: components that a mode is named after
_MIRROR_CELL = 1e-3  # m, within which a grid is the mirror image of another


@dataclass(frozen=True, kw_only=True)
class ShownModes:
    """Elastic modes.

    Attributes:
        frequency_hz: (m,).
        shape: (g, 3, m) displacements in the basic frame, mass-normalised.
        energy: (c, m) share of each component in the kinetic energy.
        symmetry: (m,) 1 symmetric about y = 0, -1 antisymmetric, 0 neither.
        names: (m,) what moves.
    """

    frequency_hz: Float64
    shape: Float64
    energy: Float64
    symmetry: npt.NDArray[np.int64]
    names: tuple[str, ...]

    def table(self, mesh: DrawnMesh) -> pd.DataFrame:
        """One row per mode: frequency, symmetry, shares of kinetic energy."""
        names = [c.name for c in mesh.components] + ["other"]
        return pd.DataFrame(
            {
                "mode": np.arange(1, len(self.names) + 1),
                "frequency_hz": self.frequency_hz,
                "symmetry": self.symmetry,
                "name": self.names,
                **{f"energy {n}": e for n, e in zip(names, self.energy)},
            }
        )


def shown_modes(structure: Structure, mesh: DrawnMesh, count: int) -> ShownModes:
    """The lowest elastic modes.

    Args:
        structure: free or supported.
        mesh: its picture.
        count: at most this many.

    Raises:
        InputError: the structure has no mass or moves without mass.
    """

    def solve():
        return normal_modes(
            structure.stiffness,
            structure.mass,
            count=min(count + _RIGID, structure.size),
            rigid_body=structure.rigid_body,
        )

    modes = structure.guarded(solve, dynamic=True, error=ModesError)
    elastic = slice(modes.rigid, modes.rigid + count)
    shape_f = modes.shape[:, elastic]
    grids = len(structure.points.grid_id)
    rows = structure.operator(structure.points.grid_id, (1, 2, 3), frame="basic")
    shape = (rows @ shape_f).reshape(grids, 3, -1)
    energy, symmetry = _energy(structure, mesh, shape_f), _symmetry(mesh.p, shape)
    return ShownModes(
        frequency_hz=modes.frequency_hz[elastic],
        shape=shape,
        energy=energy,
        symmetry=symmetry,
        names=_names(mesh, energy, symmetry),
    )


def motions(structure: Structure, mesh: DrawnMesh, shape_f: Float64) -> tuple[str, ...]:
    """Names of modes (f, m) by symmetry, components and their energy."""
    ids = structure.points.grid_id
    shape = structure.operator(ids, (1, 2, 3), frame="basic") @ shape_f
    symmetry = _symmetry(mesh.p, shape.reshape(len(ids), 3, -1))
    return _names(mesh, _energy(structure, mesh, shape_f), symmetry)


def _names(
    mesh: DrawnMesh, energy: Float64, symmetry: npt.NDArray[np.int64]
) -> tuple[str, ...]:
    labels = [c.name for c in mesh.components] + ["other"]
    return tuple(_name(e, s, labels) for e, s in zip(energy.T, symmetry))


def _energy(structure: Structure, mesh: DrawnMesh, shape_f: Float64) -> Float64:
    """(c + 1, m) shares of kinetic energy; the last row has no component."""
    motion = structure.shape(shape_f)
    per_row = motion * (structure.matrices.mass @ motion)
    grids = len(mesh.grid_component)
    per_grid = per_row[: 6 * grids].reshape(grids, 6, -1).sum(axis=1)
    shares = np.zeros((len(mesh.components) + 1, motion.shape[1]))
    owner = np.where(mesh.grid_component < 0, len(shares) - 1, mesh.grid_component)
    np.add.at(shares, owner, per_grid)
    return shares / np.maximum(shares.sum(axis=0), np.finfo(float).tiny)


def _symmetry(p: Float64, shape: Float64) -> npt.NDArray[np.int64]:
    """Compares the two sides of y = 0 where the mesh is its own mirror image."""
    keys = np.round(p / _MIRROR_CELL).astype(np.int64)
    at = {tuple(key): k for k, key in enumerate(keys.tolist())}
    image = np.array([at.get((x, -y, z), -1) for x, y, z in keys.tolist()])
    both = np.flatnonzero(image >= 0)
    if len(both) < 0.9 * len(p):
        return np.zeros(shape.shape[2], np.int64)
    mirrored = shape[image[both]] * np.array([1.0, -1.0, 1.0])[:, None]
    product = np.einsum("gim,gim->m", shape[both], mirrored)
    size = np.einsum("gim,gim->m", shape[both], shape[both])
    like = product / np.maximum(size, np.finfo(float).tiny)
    return np.where(like > 0.9, 1, np.where(like < -0.9, -1, 0))


def _name(energy: Float64, symmetry: int, labels: list[str]) -> str:
    order = [k for k in np.argsort(-energy) if energy[k] >= _NAMED_SHARE][:3]
    order = order or [int(np.argmax(energy))]
    kind = {1: "symmetric", -1: "antisymmetric", 0: ""}[int(symmetry)]
    moving = ", ".join(f"{labels[k]} {100 * energy[k]:.0f} %" for k in order)
    return f"{kind}: {moving}" if kind else moving
