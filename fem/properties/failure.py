"""Failure indices of plies and of their bonding, as PCOMP's FT and SB ask for them.

An index of one means failure. Theories in Nastran's form, with the stresses s1 s2 t12
of a ply in its axes and its strengths X, Y (tension or compression, by the sign) and S:

    HILL  s1²/X² - s1 s2/X² + s2²/Y² + t12²/S², X of the product by its sign
    HOFF  s1 (1/Xt - 1/Xc) + s2 (1/Yt - 1/Yc) + s1²/(Xt Xc) + s2²/(Yt Yc) + t12²/S²
          - s1 s2/(Xt Xc)
    TSAI  the same with + 2 F12 s1 s2 as its last term (Tsai-Wu)
    STRN  the largest of |e1|/X, |e2|/Y and |g12|/S, X ... strains: those of MAT8 where
          its STRN is 1, else strengths over moduli

The bonding index is the larger of both interlaminar shear stresses over SB.

Reference: MSC Nastran Quick Reference Guide, PCOMP; Reference Guide, composites.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64

THEORIES = ("HILL", "HOFF", "TSAI", "STRN")
Values = Float64 | float


@dataclass(frozen=True, kw_only=True)
class Strength:
    """Allowable stresses, positive; NaN where the material gives none.

    Attributes:
        xt, xc, yt, yc, s: tension and compression along 1 and 2, shear.
        f12: Tsai-Wu's interaction, 1 over stress squared.
        strain: (5,) xt xc yt yc s as strains.
    """

    xt: float
    xc: float
    yt: float
    yc: float
    s: float
    f12: float
    strain: tuple[float, ...]

    def suffices_for(self, theory: str) -> bool:
        """Whether everything is there, and positive, that a theory needs."""
        if theory == "STRN":
            return all(value > 0.0 for value in self.strain)
        return all(v > 0.0 for v in (self.xt, self.xc, self.yt, self.yc, self.s))


@dataclass(frozen=True, kw_only=True)
class Failure:
    """Strengths and criterion of one laminate.

    Attributes:
        theory: one of THEORIES, '' for none.
        plies: strengths from the bottom to the top.
        bond: SB, allowable shear of the bonding; 0 for none.
    """

    theory: str
    plies: tuple[Strength, ...]
    bond: float

    def ply_index(self, stress: Float64, strain: Float64) -> Float64:
        """(..., p) from stresses and strains (..., p, 3) in ply axes."""
        if self.theory == "STRN":
            return max_strain(strain, np.array([ply.strain for ply in self.plies]).T)
        names = ("xt", "xc", "yt", "yc", "s", "f12")
        values = [np.array([getattr(p, name) for p in self.plies]) for name in names]
        if self.theory == "HILL":
            return hill(stress, *values[:5])
        if self.theory == "HOFF":
            values[5] = -0.5 / (values[0] * values[1])
        if self.theory in ("HOFF", "TSAI"):
            return tsai_wu(stress, *values)
        return np.full(stress.shape[:-1], np.nan)

    def bond_index(self, shear: Float64) -> Float64:
        """(..., p) from the interlaminar shear stresses (..., p, 2)."""
        if self.bond > 0.0:
            return np.abs(shear).max(axis=-1) / self.bond
        return np.full(shear.shape[:-1], np.nan)


def hill(
    stress: Float64, xt: Values, xc: Values, yt: Values, yc: Values, s: Values
) -> Float64:
    """Hill's index (..., p) of stresses (..., p, 3), strengths (p,)."""
    s1, s2, t12 = np.moveaxis(stress, -1, 0)
    x, y = np.where(s1 > 0.0, xt, xc), np.where(s2 > 0.0, yt, yc)
    product = s1 * s2
    of_product = np.where(product > 0.0, xt, xc)
    return (s1 / x) ** 2 - product / of_product**2 + (s2 / y) ** 2 + (t12 / s) ** 2


def tsai_wu(
    stress: Float64,
    xt: Values,
    xc: Values,
    yt: Values,
    yc: Values,
    s: Values,
    f12: Values,
) -> Float64:
    """Tsai-Wu's index (..., p) of stresses (..., p, 3), strengths (p,)."""
    linear, square = tsai_wu_parts(stress, xt, xc, yt, yc, s, f12)
    return linear + square


def tsai_wu_parts(
    stress: Float64,
    xt: Values,
    xc: Values,
    yt: Values,
    yc: Values,
    s: Values,
    f12: Values,
) -> tuple[Float64, Float64]:
    """Linear and quadratic part of Tsai-Wu's index in the stress."""
    s1, s2, t12 = np.moveaxis(stress, -1, 0)
    linear = s1 * (1.0 / xt - 1.0 / xc) + s2 * (1.0 / yt - 1.0 / yc)
    square = s1**2 / (xt * xc) + s2**2 / (yt * yc) + (t12 / s) ** 2
    return linear, square + 2.0 * f12 * s1 * s2


def max_strain(strain: Float64, allowable: Sequence[Values] | Float64) -> Float64:
    """Largest strain over its allowable (..., p), of (..., p, 3) and (5, p)."""
    e1, e2, g12 = np.moveaxis(strain, -1, 0)
    xt, xc, yt, yc, s = allowable
    along = np.abs(e1) / np.where(e1 > 0.0, xt, xc)
    across = np.abs(e2) / np.where(e2 > 0.0, yt, yc)
    return np.maximum(np.maximum(along, across), np.abs(g12) / s)
