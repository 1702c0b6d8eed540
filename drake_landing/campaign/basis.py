"""What the full model answers to the amplitudes of a landing, without a transient.

With the modal amplitudes q(t) of the landing itself and the loads P(t) of the gears on
the airframe, the displacements of the full model are

    u = Σ φ_i (q_i - q_i(0)) + Σ ψ_j P_j.

ψ_j is the static answer to a unit load at a freedom of an attachment, balanced by the
inertia of the rigid airframe, less what the modes φ hold of it: it makes up for all
modes that the multibody model leaves out, at low frequency (mode acceleration). Without
it the stresses near the gears are wrong by tens of per cent. Everything that is linear
in u becomes a matrix on the amplitudes z = (q - q(0), P): stresses of all elements, and
section loads, for which

    P - M ü = P - M (Φ_r Φ_rᵀ + Φ Φᵀ) P + M Σ φ_i ω_i² q_i

(damping within the structure left out). Φ_r are the rigid motions, mass-normalised.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from drake_landing.airframe.basis import Basis
from drake_landing.landing.handover import AttachmentLoads, smooth_curve
from drake_landing.landing.history import LandingHistory
from drake_landing.parts.cuts import BeamCuts
from drake_landing.parts.monitors import Station
from drake_landing.parts.slices import balanced
from drake_landing.parts.stress_rows import StressMaps
from fem.arrays import Float64, Int64
from fem.model.structure import Structure


@dataclass(frozen=True, kw_only=True)
class ScreeningBasis:
    """Columns of the amplitudes and what follows from them.

    Attributes:
        node_id: (k,) loaded nodes, ascending; each has six columns after the modes.
        modes: n, number of modes.
        shape: (f, n + 6 k) displacements of the free set.
        stress: per part of `Stresses` (e per_element, n + 6 k), single precision.
        sections: beam -> (cuts, 6, n + 6 k) section loads.
        monitors: monitor point of the deck -> (q, n + 6 k) its loads.
    """

    node_id: Int64
    modes: int
    shape: Float64 = field(repr=False)
    stress: tuple[np.ndarray, ...] = field(repr=False)
    sections: Mapping[str, Float64] = field(repr=False)
    monitors: Mapping[str, Float64] = field(default_factory=dict, repr=False)

    def section_loads(self, beam: str, amplitudes: Float64) -> Float64:
        """(t, cuts, 6) under amplitudes (n + 6 k, t)."""
        return np.moveaxis(self.sections[beam] @ amplitudes, -1, 0)


def screening_basis(
    structure: Structure,
    basis: Basis,
    node_id: Int64,
    maps: StressMaps,
    cuts: Mapping[str, BeamCuts],
    stations: Sequence[Station] = (),
) -> ScreeningBasis:
    """Static answers, stress modes and section loads of a full model.

    Args:
        structure: free-flying.
        basis: elastic modes of the multibody model, mass-normalised.
        node_id: grids that the gears load, ascending.
        maps: of all elements with stresses.
        cuts: beam -> its cuts, made with these loaded nodes.
        stations: monitor points of the deck, likewise.
    """
    pattern = np.asarray(structure.operator(node_id, frame="basic").T.toarray())
    mass, shape = structure.mass, basis.shape
    static = balanced(structure, pattern).displacement
    for _ in range(
        2
    ):  # once leaves rounding where answer and modes are nearly parallel
        static -= shape @ (shape.T @ (mass @ static))
    columns = np.hstack([shape, static])
    return ScreeningBasis(
        node_id=node_id,
        modes=shape.shape[1],
        shape=columns,
        stress=tuple(
            np.ascontiguousarray(rows, dtype=np.float32) for rows in maps.of(columns)
        ),
        sections={
            name: _sections(structure, basis, node_id, pattern, cut)
            for name, cut in cuts.items()
        },
        monitors={
            s.name: _monitor(structure, basis, node_id, pattern, columns, s)
            for s in stations
        },
    )


def _sections(
    structure: Structure,
    basis: Basis,
    node_id: Int64,
    pattern: Float64,
    cuts: BeamCuts,
) -> Float64:
    """(cuts, 6, n + 6 k): every column is an instant of its own for the cuts."""
    motion = _motion(structure, basis, pattern)
    inertia = np.asarray(cuts.of_acceleration @ motion).T
    load = _unit_loads(basis, node_id)
    return np.moveaxis(cuts.loads(inertia, node_id, load), 0, -1)


def _monitor(
    structure: Structure,
    basis: Basis,
    node_id: Int64,
    pattern: Float64,
    columns: Float64,
    station: Station,
) -> Float64:
    """(q, n + 6 k), likewise; elastic forces by the displacements of the columns."""
    moved = station.moved(columns, _motion(structure, basis, pattern))
    return station.values(moved, _unit_loads(basis, node_id)).T


def _motion(structure: Structure, basis: Basis, pattern: Float64) -> Float64:
    """(f, n + 6 k) accelerations that each amplitude stands for."""
    omega2 = (2.0 * np.pi * basis.frequency_hz) ** 2
    rigid = basis.rigid_modes(structure.mass)
    taken = rigid @ (rigid.T @ pattern) + basis.shape @ (basis.shape.T @ pattern)
    return np.hstack([-basis.shape * omega2, taken])


def _unit_loads(basis: Basis, node_id: Int64) -> Float64:
    """(n + 6 k, k, 6) loads that each amplitude stands for."""
    n, k = basis.shape.shape[1], len(node_id)
    load = np.zeros((n + 6 * k, k, 6))
    load[n:] = np.eye(6 * k).reshape(6 * k, k, 6)
    return load


def amplitudes(
    basis: ScreeningBasis, history: LandingHistory, loads: AttachmentLoads
) -> Float64:
    """(n + 6 k, t) amplitudes of a landing on the time grid of its loads.

    Args:
        basis: of the airframe that flew.
        history: of the landing; its modes are those of the basis.
        loads: of it, resampled, on the nodes of the basis (others are refused).

    Raises:
        ValueError: other nodes, or another number of modes.
    """
    if not np.array_equal(loads.node_id, basis.node_id):
        raise ValueError(
            f"loads act on grids {loads.node_id.tolist()}, not {basis.node_id.tolist()}"
        )
    if history.amplitudes.shape[1] != basis.modes:
        raise ValueError(
            f"the landing has {history.amplitudes.shape[1]} modes, the basis "
            f"{basis.modes}"
        )
    inside = np.minimum(loads.time, history.time[-1])
    q = smooth_curve(history.time, history.amplitudes)(inside).T
    return np.vstack([q - q[:, :1], loads.load.reshape(len(loads.time), -1).T])
