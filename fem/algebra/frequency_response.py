"""Harmonic response: (-ω² M + i ω B + (1 + i G) K + i K4) u = P at each frequency.

Directly, a factorisation per frequency: without damping of the real matrix
A = K - ω² M; with it, of the real symmetric one of twice the size that belongs to the
real and imaginary parts,

    [A  -C] [ x]   [ Re P]
    [-C -A] [ y] = [-Im P],    C = ω B + G K + K4,  u = x + i y,

with the second row negated where the matrices are not symmetric anyway. Or in modal
coordinates, where the matrices are small and dense.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.algebra.linear_solver import (
    Factorization,
    SingularMatrixError,
    SolverName,
    factorize,
)
from fem.algebra.modes import Modes
from fem.arrays import Float64

Complex128 = npt.NDArray[np.complex128]

_SOLVED = 1e-6  # of the load: what may be left of it


@dataclass(frozen=True, kw_only=True)
class HarmonicMatrices:
    """Matrices (n, n) of the equation above.

    Attributes:
        stiffness, mass: K and M.
        viscous: B; None: none.
        structural: G K + K4; None: none.
        symmetric: whether they are (transfer functions are not).
        varying: the matrices at a frequency in Hz, where they depend on it; the others
            are nominal then, those that modes belong to.
    """

    stiffness: sp.csr_matrix
    mass: sp.csr_matrix
    viscous: sp.csr_matrix | None = None
    structural: sp.csr_matrix | None = None
    symmetric: bool = True
    varying: "Callable[[float], HarmonicMatrices] | None" = None

    def at(self, hertz: float) -> "HarmonicMatrices":
        """The matrices at a frequency."""
        return self if self.varying is None else self.varying(hertz)

    def loss(self, omega: float) -> sp.csr_matrix | None:
        """C at an angular frequency; None where there is no damping."""
        parts = []
        if self.viscous is not None and self.viscous.nnz and omega:
            parts.append(omega * self.viscous)
        if self.structural is not None and self.structural.nnz:
            parts.append(self.structural)
        return sp.csr_matrix(sum(parts[1:], parts[0])) if parts else None


def direct_response(
    matrices: HarmonicMatrices,
    frequency_hz: Float64,
    load: Callable[[int], Complex128],
    *,
    solver: SolverName | None = None,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> Complex128:
    """Displacements (f, n) at frequencies (f,).

    Args:
        matrices: of the free freedoms.
        frequency_hz: Hz.
        load: (n,) at the k-th frequency.
        solver: as in `factorize`.
        progress: told how many frequencies are done.

    Raises:
        SingularMatrixError: at a frequency of the undamped structure.
    """
    n = len(matrices.mass.indptr) - 1
    found = np.zeros((len(frequency_hz), n), complex)
    for k, hertz in enumerate(frequency_hz):
        omega = 2.0 * np.pi * float(hertz)
        own = matrices.at(float(hertz))
        dynamic = sp.csr_matrix(own.stiffness - omega**2 * own.mass)
        loss, p = own.loss(omega), load(k)
        sign = -1.0 if own.symmetric else 1.0
        whole = dynamic
        if loss is not None:
            rows = [[dynamic, -loss], [sign * loss, sign * dynamic]]
            whole = sp.csr_matrix(sp.bmat(rows))
        kind = "symmetric" if own.symmetric else "general"
        with factorize(whole, kind=kind, solver=solver) as factor:
            if loss is None:
                found[k] = _refined(factor, whole, p.real)
                found[k] += 1j * _refined(factor, whole, p.imag)
            else:
                x = _refined(factor, whole, np.concatenate([p.real, sign * p.imag]))
                found[k] = x[:n] + 1j * x[n:]
        progress(k + 1, len(frequency_hz))
    return found


def _refined(factor: Factorization, matrix: sp.csr_matrix, right: Float64) -> Float64:
    """A solution, once improved: pivots of indefinite matrices may be replaced.

    Raises:
        SingularMatrixError: it is none.
    """
    x = factor.solve(right)
    x = x + factor.solve(right - matrix @ x)
    rest = np.linalg.norm(right - matrix @ x)
    if not rest <= _SOLVED * np.linalg.norm(right):
        raise SingularMatrixError(None)
    return x


def modal_response(
    modes: Modes,
    matrices: HarmonicMatrices,
    frequency_hz: Float64,
    load: Complex128,
    *,
    ratio: Float64 | None = None,
    hysteretic: bool = False,
) -> Complex128:
    """Amplitudes (f, m) of mass-normalised modes.

    Args:
        modes: with residual vectors, where there are any.
        matrices: viscous and structural are projected on the modes.
        frequency_hz: (f,) Hz.
        load: (m, f) modal loads, shapesᵀ P.
        ratio: (m,) damping ratios of the modes, None: none.
        hysteretic: they are structural, 2 ζ i K, instead of viscous (PARAM KDAMP -1).

    Raises:
        np.linalg.LinAlgError: at a frequency of an undamped mode.
    """
    shape, square = modes.shape, modes.eigenvalue
    damping = np.zeros((2, len(square), len(square)))  # viscous, structural
    if ratio is not None:
        own = 2.0 * ratio
        damping[int(hysteretic)] = np.diag(
            own * square if hysteretic else own * np.sqrt(np.abs(square))
        )
    nominal = damping + _projected(shape, matrices)
    found = np.empty((len(frequency_hz), len(square)), complex)
    for k, hertz in enumerate(frequency_hz):
        omega = 2.0 * np.pi * float(hertz)
        matrix, (viscous, structural) = np.diag(square - omega**2), nominal
        if matrices.varying is not None:
            there = matrices.varying(float(hertz))
            change = sp.csr_matrix(there.stiffness - matrices.stiffness)
            matrix = matrix + shape.T @ (change @ shape)
            viscous, structural = damping + _projected(shape, there)
        dynamic = matrix + 1j * (omega * viscous + structural)
        if (np.abs(dynamic).sum(axis=1) < _RESONANT * omega**2).any():
            raise np.linalg.LinAlgError("a frequency is that of an undamped mode")
        found[k] = np.linalg.solve(dynamic, load[:, k])
    return found


# Stiffness of a mode over its inertia, beyond 1, that is rounding of its frequency.
_RESONANT = 1e-10


def _projected(shape: Float64, matrices: HarmonicMatrices) -> Float64:
    """(2, m, m) viscous and structural damping of shapes (n, m)."""
    found = np.zeros((2, shape.shape[1], shape.shape[1]))
    for own, matrix in zip(found, (matrices.viscous, matrices.structural)):
        if matrix is not None:
            own += shape.T @ (matrix @ shape)
    return found
