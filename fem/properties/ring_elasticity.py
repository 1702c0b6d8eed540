"""Elasticity of bodies of revolution: MAT1, and MAT3 with its three axes.

Order radial, azimuthal, axial, shear; engineering shear strain.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.references import table, where
from fem.errors import InputError, Problems
from fem.properties.elasticity import isotropic_solid
from fem.properties.materials import complete

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class RingMaterial:
    """One material.

    Attributes:
        elasticity: (4, 4).
        rho, ge, tref: density, structural damping, temperature without strain
            (NaN: blank).
        alpha: (3,) strain per degree.
    """

    elasticity: Float64
    rho: float
    ge: float
    tref: float
    alpha: Float64


def ring_materials(deck: "Deck") -> dict[int, RingMaterial]:
    """Materials of the CTRIAX6 of a deck by id.

    Raises:
        InputError: constants of which no elasticity can be made.
    """
    used = set(table(deck, "CTRIAX6")["mid"].tolist())
    found, problems = {}, Problems()
    for card, make in (("MAT1", _isotropic), ("MAT3", _orthotropic)):
        rows = table(deck, card)
        for _, row in rows[rows["mid"].isin(used)].iterrows():
            with problems.gathered():
                found[int(row["mid"])] = make(row)
    problems.report()
    return found


def _isotropic(row: pd.Series) -> RingMaterial:
    """E and nu for normal strains, G of the card for shear."""
    e, g, nu = (float(v) for v in complete(*(row[c] for c in ("e", "g", "nu"))))
    if not (e > 0.0 and g > 0.0 and -1.0 < nu < 0.5):
        raise InputError(
            f"{where('MAT1', row)}: E {e:g}, G {g:g}, NU {nu:g}: expected E and G "
            "above 0 and NU between -1 and 0.5 for CTRIAX6"
        )
    elasticity = np.zeros((4, 4))
    elasticity[:3, :3] = isotropic_solid(e, nu)[:3, :3]
    elasticity[3, 3] = g
    return _material(row, elasticity, np.full(3, _number(row, "a")))


def _orthotropic(row: pd.Series) -> RingMaterial:
    """Strains in each direction from EX, ETH, EZ, NUXTH, NUTHZ and NUZX.

    NUij is the contraction along j under a stress along i.
    """
    ex, eth, ez, gzx = (float(row[name]) for name in ("ex", "eth", "ez", "gzx"))
    if min(ex, eth, ez, gzx) <= 0.0:
        raise InputError(
            f"{where('MAT3', row)}: EX {ex:g}, ETH {eth:g}, EZ {ez:g}, GZX {gzx:g}: "
            "expected positive moduli for CTRIAX6"
        )
    compliance = np.diag(1.0 / np.array([ex, eth, ez, gzx]))
    for i, j, value in (
        (0, 1, row["nuxth"] / ex),
        (1, 2, row["nuthz"] / eth),
        (2, 0, row["nuzx"] / ez),
    ):
        compliance[i, j] = compliance[j, i] = -value
    if np.linalg.eigvalsh(compliance)[0] <= 0.0:
        raise InputError(
            f"{where('MAT3', row)}: with these moduli and ratios the material would "
            "give energy away; expected smaller NUXTH, NUTHZ, NUZX"
        )
    alpha = np.array([_number(row, name) for name in ("ax", "ath", "az")])
    return _material(row, np.linalg.inv(compliance), alpha)


def _material(row: pd.Series, elasticity: Float64, alpha: Float64) -> RingMaterial:
    return RingMaterial(
        elasticity=elasticity,
        rho=_number(row, "rho"),
        ge=_number(row, "ge"),
        tref=float(row["tref"]),
        alpha=alpha,
    )


def _number(row: pd.Series, name: str) -> float:
    value = float(row[name])
    return 0.0 if np.isnan(value) else value
