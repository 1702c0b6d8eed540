"""Plates in theory: independent figures where published ones are rounded or coarse.

`ritz_frequencies` and `ritz_deflection` are Rayleigh-Ritz solutions of Kirchhoff's
plate in products of Legendre polynomials, with factors for the clamped edges; with
14 by 14 terms they have five digits. `StepSeries` is Navier's series of a simply
supported Mindlin plate (no rotary inertia) under a sudden pressure.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.linalg
from numpy.polynomial import Legendre, Polynomial

Float64 = npt.NDArray[np.float64]


def _basis(terms: int, clamped: tuple[bool, bool]) -> list[Polynomial]:
    """Polynomials on [-1, 1] with double zeros at clamped ends (left, right)."""
    edge = Polynomial([1.0])
    for root, holds in zip((-1.0, 1.0), clamped):
        if holds:
            edge = edge * Polynomial([-root, 1.0]) ** 2
    return [edge * Legendre.basis(k).convert(kind=Polynomial) for k in range(terms)]


def _integrals(basis: list[Polynomial], length: float) -> dict[str, Float64]:
    """Integrals over the length of products of derivatives: keys "00", "11", "02"..."""
    x, w = np.polynomial.legendre.leggauss(2 * len(basis) + 6)
    scale = 2.0 / length
    values = [
        np.array([p.deriv(k)(x) if k else p(x) for p in basis]) * scale**k
        for k in range(3)
    ]
    return {
        f"{i}{j}": (values[i] * w) @ values[j].T / scale
        for i in range(3)
        for j in range(3)
    }


def _matrices(
    a: float,
    b: float,
    nu: float,
    x_edges: tuple[bool, bool],
    y_edges: tuple[bool, bool],
    terms: int,
) -> tuple[Float64, Float64]:
    """Bending energy over D and mass over ρ t of the products of both bases."""
    x = _integrals(_basis(terms, x_edges), a)
    y = _integrals(_basis(terms, y_edges), b)
    stiffness = (
        np.kron(x["22"], y["00"])
        + np.kron(x["00"], y["22"])
        + nu * (np.kron(x["20"], y["02"]) + np.kron(x["02"], y["20"]))
        + 2.0 * (1.0 - nu) * np.kron(x["11"], y["11"])
    )
    return stiffness, np.kron(x["00"], y["00"])


def ritz_frequencies(
    rigidity: float,
    mass: float,
    sides: tuple[float, float],
    nu: float,
    count: int,
    *,
    clamped: bool,
    terms: int = 14,
) -> Float64:
    """Elastic frequencies (Hz) of a rectangular plate, free or clamped at one edge.

    Args:
        rigidity: D, N m.
        mass: per area, kg/m².
        sides: lengths in x and y, m.
        nu: Poisson's ratio.
        count: how many.
        clamped: whether the edge x = 0 is clamped.
        terms: polynomials in each direction.
    """
    stiffness, inertia = _matrices(*sides, nu, (clamped, False), (False, False), terms)
    values = scipy.linalg.eigvalsh(stiffness, inertia)
    elastic = values[0 if clamped else 3 :][:count]
    return np.sqrt(elastic * rigidity / mass) / (2.0 * np.pi)


def ritz_deflection(a: float, b: float, nu: float, *, terms: int = 14) -> float:
    """Center deflection of a plate with all edges clamped: w D / (q a⁴)."""
    edges = (True, True)
    stiffness, _ = _matrices(a, b, nu, edges, edges, terms)
    x, w = np.polynomial.legendre.leggauss(2 * terms + 6)
    basis = _basis(terms, edges)
    mean = np.array([w @ p(x) for p in basis])
    load = np.kron(0.5 * a * mean, 0.5 * b * mean)
    middle = np.array([p(0.0) for p in basis])
    return float(np.kron(middle, middle) @ np.linalg.solve(stiffness, load) / a**4)


def ritz_buckling(
    aspect: float,
    forces: tuple[float, float, float],
    nu: float,
    *,
    stringer: tuple[float, float] = (0.0, 0.0),
    terms: int = 12,
) -> float:
    """Smallest positive k of a simply supported plate under k pi^2 D / b^2 forces.

    Args:
        aspect: length a over width b.
        forces: compression along x and y, and shear, in parts of that.
        nu: Poisson's ratio.
        stringer: along the middle, gamma = E I / (b D) and delta = A / (b t); it
            carries the strain of the sheet, and its load with it.
        terms: polynomials in each direction.
    """
    edge = Polynomial([1.0, 0.0, -1.0])
    basis = [edge * Legendre.basis(k).convert(kind=Polynomial) for k in range(terms)]
    x, y = _integrals(basis, aspect), _integrals(basis, 1.0)
    stiffness = (
        np.kron(x["22"], y["00"])
        + np.kron(x["00"], y["22"])
        + nu * (np.kron(x["20"], y["02"]) + np.kron(x["02"], y["20"]))
        + 2.0 * (1.0 - nu) * np.kron(x["11"], y["11"])
    )
    nxx, nyy, nxy = forces
    work = nxx * np.kron(x["11"], y["00"]) + nyy * np.kron(x["00"], y["11"])
    work -= nxy * (np.kron(x["10"], y["01"]) + np.kron(x["01"], y["10"]))
    gamma, delta = stringer
    middle = np.outer(*2 * [np.array([p(0.0) for p in basis])])
    stiffness += gamma * np.kron(x["22"], middle)
    work += nxx * delta * np.kron(x["11"], middle)
    values = scipy.linalg.eigvalsh(work, stiffness)
    return float(1.0 / values[-1] / np.pi**2)


@dataclass(frozen=True, kw_only=True)
class StepSeries:
    """Response of a simply supported square Mindlin plate to a sudden pressure.

    Attributes:
        young, nu, density: of the material.
        side, thickness: m.
        pressure: Pa.
        alpha, beta: Rayleigh damping, 1/s and s.
        terms: largest odd number of half waves.
    """

    young: float
    nu: float
    density: float
    side: float
    thickness: float
    pressure: float
    alpha: float = 0.0
    beta: float = 0.0
    terms: int = 79

    def _modes(self) -> tuple[Float64, ...]:
        """Wave numbers in x and y, load, static bending and shear amplitudes, ω."""
        odd = np.arange(1, self.terms + 1, 2)
        m, n = (x.ravel() for x in np.meshgrid(odd, odd))
        kx, ky = np.pi * m / self.side, np.pi * n / self.side
        k2 = kx**2 + ky**2
        t = self.thickness
        rigidity = self.young * t**3 / (12.0 * (1.0 - self.nu**2))
        shear = 5.0 / 6.0 * self.young / (2.0 * (1.0 + self.nu)) * t
        load = 16.0 * self.pressure / (np.pi**2 * m * n)
        bent = load / (rigidity * k2**2)
        whole = bent * (1.0 + rigidity * k2 / shear)
        omega = np.sqrt(load / whole / (self.density * t))
        return kx, ky, bent, whole, omega

    def _weights(self, x: float, y: float) -> tuple[Float64, Float64, Float64]:
        """Deflection and stress σ_x per mode at a point, and ω."""
        kx, ky, bent, whole, omega = self._modes()
        shape = np.sin(kx * x) * np.sin(ky * y)
        modulus = self.young / (1.0 - self.nu**2)
        curvature = (kx**2 + self.nu * ky**2) * bent
        return whole * shape, 0.5 * self.thickness * modulus * curvature * shape, omega

    def static(self) -> float:
        """Deflection of the center at rest, m."""
        return float(self._weights(0.5 * self.side, 0.5 * self.side)[0].sum())

    def histories(self, time: Float64, x: float, y: float) -> tuple[Float64, Float64]:
        """(t,) deflection and surface stress σ_x at a point."""
        deflection, stress, omega = self._weights(x, y)
        ratio = 0.5 * (self.alpha / omega + self.beta * omega)
        # Roots of s² + 2 ζ ω s + ω² = 0: no overflow beyond critical damping.
        root = np.emath.sqrt(ratio**2 - 1.0)
        first, second = omega * (root - ratio), omega * (-root - ratio)
        decay = second * np.exp(np.outer(time, first))
        decay = decay - first * np.exp(np.outer(time, second))
        response = (1.0 - decay / (second - first)).real
        return response @ deflection, response @ stress
