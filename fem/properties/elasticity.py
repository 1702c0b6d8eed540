"""Elasticity matrices of MAT1, MAT2, MAT8 and MAT9 in their material axes.

Strains are engineering strains. Plane order xx yy xy, transverse xz yz, solid order
xx yy zz xy yz zx, all as Nastran has them. Where E, G and nu of a MAT1 contradict each
other, plates and solids take E and nu, transverse shear takes G, as MSC and NX Nastran
do (seen in their grid point forces).
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.references import column, table, where
from fem.errors import InputError, Problems, nearest
from fem.properties.failure import Strength
from fem.properties.materials import check_moduli, complete

if TYPE_CHECKING:
    from fem.deck.deck import Deck

CARDS = ("MAT1", "MAT2", "MAT8", "MAT9")


@dataclass(frozen=True, kw_only=True)
class Elasticity:
    """One material; None where the card does not define that kind of matrix.

    Attributes:
        mid, card: identification.
        plane: (3, 3) plane stress stiffness.
        shear: (2, 2) transverse shear stiffness; inf on the diagonal: rigid.
        solid: (6, 6) three-dimensional stiffness; None: a material of sheets, or one
            that cannot change its volume.
        rho, ge: density and structural damping coefficient.
        strength: allowable stresses of a ply.
        alpha: strain per degree, (6,) of solids, (3,) of others; zero: none.
        tref: temperature without strain; NaN: blank.
    """

    mid: int
    card: str
    plane: Float64 | None
    shear: Float64 | None
    solid: Float64 | None
    rho: float
    ge: float
    strength: Strength | None = None
    alpha: Float64 = field(default_factory=lambda: np.zeros(6))
    tref: float = 0.0

    @property
    def plane_alpha(self) -> Float64:
        """(3,) strain xx yy xy per degree."""
        return self.alpha if len(self.alpha) == 3 else self.alpha[[0, 1, 3]]

    @property
    def shear_flexibility(self) -> Float64:
        """(2, 2) inverse of the transverse shear stiffness; zero: rigid."""
        if self.shear is None or np.isinf(self.shear).any():
            stiffness = (
                np.full(2, np.inf) if self.shear is None else np.diag(self.shear)
            )
            return np.diag(1.0 / stiffness)
        return np.linalg.inv(self.shear)


def plane_stress(e: float, nu: float) -> Float64:
    """(3, 3) isotropic plane stress stiffness."""
    return (
        e
        / (1.0 - nu * nu)
        * np.array([[1.0, nu, 0.0], [nu, 1.0, 0.0], [0.0, 0.0, 0.5 * (1.0 - nu)]])
    )


def isotropic_solid(e: float, nu: float) -> Float64:
    """(6, 6) isotropic stiffness; nu < 0.5."""
    mu = e / (2.0 * (1.0 + nu))
    lame = e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    stiffness = np.diag([2.0 * mu] * 3 + [mu] * 3)
    stiffness[:3, :3] += lame
    return stiffness


def orthotropic_plane(e1: float, e2: float, nu12: float, g12: float) -> Float64:
    """(3, 3) plane stress stiffness of a lamina, nu21 = nu12 E2 / E1."""
    nu21 = nu12 * e2 / e1 if e1 else 0.0
    d = 1.0 - nu12 * nu21
    return np.array(
        [[e1 / d, nu12 * e2 / d, 0.0], [nu12 * e2 / d, e2 / d, 0.0], [0.0, 0.0, g12]]
    )


class ElasticityTable:
    """Materials of a deck by id, made when they are asked for.

    Raises:
        InputError: a material id that is defined twice.
    """

    def __init__(self, deck: "Deck") -> None:
        self._rows: dict[int, tuple[str, pd.Series]] = {}
        problems = Problems()
        for card in CARDS:
            for _, row in table(deck, card).iterrows():
                mid = int(row["mid"])
                if mid in self._rows:
                    problems.append(
                        f"{where(card, row)}: material {mid} is already defined by "
                        f"{where(*self._rows[mid])}"
                    )
                self._rows[mid] = (card, row)
        problems.report()
        self._made: dict[int, Elasticity] = {}

    @cached_property
    def ids(self) -> tuple[int, ...]:
        """Ids of all materials."""
        return tuple(sorted(self._rows))

    def problem(self, mid: int, cards: Iterable[str], user: str) -> str | None:
        """Problem of this reference, None where there is none."""
        cards = tuple(cards)
        if mid not in self._rows:
            hint = nearest(str(mid), [str(i) for i in self.ids])
            return f"{user}: material {mid} is not defined{hint}"
        if self._rows[mid][0] not in cards:
            return (
                f"{user}: material {mid} is a {self._rows[mid][0]}, expected "
                f"{' or '.join(cards)}"
            )
        return None

    def __getitem__(self, mid: int) -> Elasticity:
        if mid not in self._made:
            card, row = self._rows[mid]
            with np.errstate(over="ignore"):
                made = _MAKERS[card](row)
            for stiffness in (made.plane, made.solid):
                if stiffness is not None and not np.isfinite(stiffness).all():
                    raise InputError(
                        f"{where(card, row)}: the stiffness is beyond what can be "
                        "computed with"
                    )
            self._made[mid] = made
        return self._made[mid]


def _value(row: pd.Series, name: str) -> float:
    value = float(row[name])
    return 0.0 if np.isnan(value) else value


def _mat1(row: pd.Series) -> Elasticity:
    given = [np.array([float(row[k])]) for k in ("e", "g", "nu")]
    e, g, nu = (float(v[0]) for v in complete(*given))
    check_moduli(pd.DataFrame([row]), poisson=True)
    if not (-1.0 < nu < 1.0):
        raise InputError(
            f"{where('MAT1', row)}: Poisson's ratio {nu:g} (from E {e:g} and G {g:g} "
            "where blank), expected between -1 and 1"
        )
    return Elasticity(
        mid=int(row["mid"]),
        card="MAT1",
        plane=plane_stress(e, nu),
        shear=np.diag([g, g]) if g > 0.0 else None,
        solid=isotropic_solid(e, nu) if nu < 0.5 else None,
        rho=_value(row, "rho"),
        ge=_value(row, "ge"),
        strength=_strength(row, "st sc st sc ss", (e, e, g)),
        alpha=_value(row, "a") * np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]),
        tref=float(row["tref"]),
    )


def _mat2(row: pd.Series) -> Elasticity:
    g11, g12, g13, g22, g23, g33 = (
        _value(row, f"g{k}") for k in ("11", "12", "13", "22", "23", "33")
    )
    transverse = np.array([[g11, g12], [g12, g22]])
    return Elasticity(
        mid=int(row["mid"]),
        card="MAT2",
        plane=np.array([[g11, g12, g13], [g12, g22, g23], [g13, g23, g33]]),
        # For PSHELL MID3 the guide reads G11, G12, G22 as the transverse stiffness.
        shear=transverse if np.linalg.det(transverse) > 0.0 else None,
        solid=None,
        rho=_value(row, "rho"),
        ge=_value(row, "ge"),
        strength=_strength(row, "st sc st sc ss", (g11, g22, g33)),
        alpha=np.array([_value(row, k) for k in ("a1", "a2", "a3")]),
        tref=float(row["tref"]),
    )


def _mat8(row: pd.Series) -> Elasticity:
    transverse = [_value(row, k) or np.inf for k in ("g1z", "g2z")]
    e1, e2, nu12, g12 = (_value(row, k) for k in ("e1", "e2", "nu12", "g12"))
    limit = np.sqrt(e1 / e2) if e1 > 0.0 and e2 > 0.0 else np.inf
    if not abs(nu12) < limit:
        raise InputError(
            f"{where('MAT8', row)}: NU12 {nu12:g}, expected below {limit:g}, the root "
            "of E1 / E2: beyond it the sheet has no positive stiffness"
        )
    return Elasticity(
        mid=int(row["mid"]),
        card="MAT8",
        plane=orthotropic_plane(e1, e2, nu12, g12),
        shear=np.array([[transverse[0], 0.0], [0.0, transverse[1]]]),
        solid=None,
        rho=_value(row, "rho"),
        ge=_value(row, "ge"),
        strength=_strength(row, "xt xc yt yc s", (e1, e2, g12)),
        alpha=np.array([_value(row, "a1"), _value(row, "a2"), 0.0]),
        tref=float(row["tref"]),
    )


def _strength(
    row: pd.Series, fields: str, moduli: tuple[float, float, float]
) -> Strength:
    """Strengths of a material card; a blank compression is like tension."""
    xt, xc, yt, yc, s = (abs(float(row[name])) for name in fields.split())
    xc, yc = xt if np.isnan(xc) else xc, yt if np.isnan(yc) else yc
    values = np.array([xt, xc, yt, yc, s])
    if float(row.get("strn", 0.0)) == 1.0:
        strain = values
    else:
        stiff = np.repeat(moduli, (2, 2, 1))
        strain = np.divide(values, stiff, out=np.full(5, np.nan), where=stiff > 0.0)
    return Strength(
        xt=xt,
        xc=xc,
        yt=yt,
        yc=yc,
        s=s,
        f12=float(np.nan_to_num(row.get("f12", 0.0))),
        strain=tuple(strain.tolist()),
    )


def _mat9(row: pd.Series) -> Elasticity:
    return Elasticity(
        mid=int(row["mid"]),
        card="MAT9",
        plane=None,
        shear=None,
        solid=np.nan_to_num(np.array(row["gs"], float).reshape(6, 6)),
        rho=column(pd.DataFrame([row]), "rho")[0],
        ge=_value(row, "ge"),
        alpha=np.array(row["alphas"], float),
        tref=float(row["tref"]),
    )


_MAKERS = {"MAT1": _mat1, "MAT2": _mat2, "MAT8": _mat8, "MAT9": _mat9}
