"""How the full model answers gear loads, in few shapes and without its eigenmodes.

Ritz vectors of the loads (E. L. Wilson, M.-W. Yuan, J. M. Dickens, Earthquake
Engineering and Structural Dynamics 10, 1982; from memory): the static answers of unit
loads at the attachment nodes, what their inertia forces cause in turn, and so on. With
A = K + σ M, which is regular though the airframe flies freely,

    X_0 = A⁻¹ P,   X_k+1 = A⁻¹ M X_k,

orthogonal to each other and to the rigid motions. One factorisation and some hundred
solutions give what these loads excite in the full model, local modes that they do not
excite left out; the lowest are its eigenmodes. Good for what is expected of a transient
before it is run.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.linalg
import scipy.sparse as sp

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.basis import Basis
from drake_landing.airframe.relevance import ModalModel
from drake_landing.airframe.selection import modal_model
from drake_landing.cache import Arrays, Cache, content_key
from fem.algebra.linear_solver import factorize
from fem.algebra.orthonormal import orthonormal_rest
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_MOST = 96  # vectors
_SHIFT = (2.0 * np.pi * 30.0) ** 2  # 1/s²: amid the frequencies that gears excite
# Hz: what is faster follows pulses of some 0.1 ms as if it had no mass. Turning of
# grids without inertia, as sticks with CONM2 have them, comes out of rounding up there.
_FASTEST = 1e4
_DEPENDENT = 1e-7  # what is left of a vector that others span


@dataclass(frozen=True, kw_only=True)
class LoadModel(ModalModel):
    """Rigid-body modes and shapes that gear loads excite.

    Attributes:
        seat: (n,) grid that holds most of the kinetic energy of each.
        share: (n,) of the kinetic energy that it holds.
    """

    seat: Int64
    share: Float64


def load_model(
    structure: Structure, aircraft: Aircraft, cache: Cache | None = None
) -> LoadModel:
    """Rigid-body modes and shapes that gear loads excite, at the aircraft's nodes.

    Args:
        structure: free-flying.
        aircraft: its gears and monitoring points.
        cache: where the same may be found.
    """
    nodes = sorted(set(aircraft.attachment_nodes))
    pattern = structure.operator(nodes, frame="basic").T
    points = structure.operator(list(aircraft.monitoring.values()), frame="basic")

    def build() -> Arrays:
        frequency, shape = load_shapes(structure, pattern.toarray())
        basis = Basis(
            frequency_hz=frequency,
            shape=shape,
            rigid=structure.rigid_body,
            freedoms=structure.size,
        )
        found = modal_model(structure, basis, aircraft)
        every = np.hstack([basis.rigid_modes(structure.mass), shape])
        seat, share = _seats(structure, every)
        return {
            "frequency_hz": found.frequency_hz,
            "damping": found.damping,
            "monitor": found.monitor,
            "attachment": np.array([found.attachment[n] for n in nodes]),
            "seat": seat,
            "share": share,
        }

    b = structure.damping
    key = content_key(
        *(structure.stiffness, structure.mass, b.other),
        *(b.stiffness_factor, b.mass_factor, pattern, points, _MOST, _SHIFT, _FASTEST),
    )
    arrays = (cache or Cache(None)).arrays("load-shapes", key, build)
    return LoadModel(
        seat=arrays["seat"],
        share=arrays["share"],
        frequency_hz=arrays["frequency_hz"],
        damping=arrays["damping"],
        monitor=arrays["monitor"],
        attachment=dict(zip(nodes, arrays["attachment"])),
    )


def _seats(structure: Structure, shape: Float64) -> tuple[Int64, Float64]:
    """Grid with most of the kinetic energy of each of the shapes (f, n), its share."""
    moved = structure.elimination.T @ shape
    energy = np.asarray(structure.matrices.mass @ moved) * moved
    grids = structure.points.grid_id
    of_grid = energy[: 6 * len(grids)].reshape(len(grids), 6, -1).sum(axis=1)
    most = of_grid.argmax(axis=0)
    share = np.take_along_axis(of_grid, most[None], axis=0)[0] / energy.sum(axis=0)
    return grids[most], share


def load_shapes(structure: Structure, loads: Float64) -> tuple[Float64, Float64]:
    """Frequencies (n,) Hz to 10 kHz, ascending, and mass-normalised shapes (f, n).

    Args:
        structure: free-flying.
        loads: (f, k) on the free set.
    """
    k, m = structure.stiffness, structure.mass
    gram = structure.rigid_body.T @ (m @ structure.rigid_body)
    rigid = structure.rigid_body @ np.linalg.inv(np.linalg.cholesky(gram)).T
    with factorize(sp.csr_matrix(k + _SHIFT * m), kind="symmetric") as factor:
        shape = _krylov(m, rigid, loads, factor.solve)
    values, turn = scipy.linalg.eigh(shape.T @ (k @ shape))
    frequency = np.sqrt(np.maximum(values, 0.0)) / (2.0 * np.pi)
    slow = frequency <= _FASTEST
    return frequency[slow], shape @ turn[:, slow]


def _krylov(
    mass: sp.csr_matrix,
    rigid: Float64,
    loads: Float64,
    solve: Callable[[Float64], Float64],
) -> Float64:
    """(f, n) M-orthonormal vectors, orthogonal to the rigid motions."""
    basis = rigid
    block = solve(loads)
    while len(block.T) and len(basis.T) < _MOST + len(rigid.T):
        block = orthonormal_rest(block, basis, mass, _DEPENDENT)[
            :, : _MOST + len(rigid.T)
        ]
        basis = np.hstack([basis, block])
        block = solve(mass @ block) if len(block.T) else block
    return basis[:, len(rigid.T) :][:, :_MOST]
