"""Isotropic materials of line elements, completed as Nastran does."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.references import column, refer, table, where
from fem.errors import InputError

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class Isotropic:
    """MAT1 values, one per user; units of the deck.

    Attributes:
        e, g, nu: (n,) Young's modulus, shear modulus, Poisson's ratio.
        rho: (n,) density.
        ge: (n,) structural damping coefficient.
        alpha, tref: (n,) expansion per degree, and the temperature without strain (NaN:
            blank).
    """

    e: Float64
    g: Float64
    nu: Float64
    rho: Float64
    ge: Float64
    alpha: Float64
    tref: Float64


def complete(e: Float64, g: Float64, nu: Float64) -> tuple[Float64, Float64, Float64]:
    """E, G and ν with the blank one of three (NaN) from E = 2 (1 + ν) G.

    Where two are blank both are zero, as Nastran's guide has it for MAT1.
    """
    e, g, nu = (np.array(v, float) for v in (e, g, nu))
    no_e, no_g, no_nu = np.isnan(e), np.isnan(g), np.isnan(nu)
    single = (no_e.astype(int) + no_g + no_nu) == 1
    with np.errstate(divide="ignore", invalid="ignore"):
        e_full = np.where(no_e & single, 2.0 * (1.0 + nu) * g, e)
        g_full = np.where(no_g & single, e / (2.0 * (1.0 + nu)), g)
        nu_full = np.where(no_nu & single, e / (2.0 * g) - 1.0, nu)
    return np.nan_to_num(e_full), np.nan_to_num(g_full), np.nan_to_num(nu_full)


def check_moduli(mat: pd.DataFrame, *, poisson: bool) -> None:
    """Refuse MAT1 cards (n rows) that are no elastic material.

    Args:
        mat: the cards.
        poisson: ν itself counts; else E and G alone, and ν only where one is blank:
            bending and torsion of bars need not fit together.

    Raises:
        InputError: E or G below zero; a given ν that is not between -1 and 1, or not
            a number; all of them. (Bars and plane stress know no other limit; solids
            have theirs at 0.5.)
    """
    given = mat["nu"].to_numpy(float)
    counts = poisson | mat[["e", "g"]].isna().any(axis=1).to_numpy()
    wrong_nu = counts & ~np.isnan(given) & ~((given > -1.0) & (given < 1.0))
    problems = [
        f"{where('MAT1', mat.iloc[i])}: NU {given[i]:g}, expected between -1 and 1"
        for i in np.flatnonzero(wrong_nu)
    ]
    for name in ("e", "g"):
        values = mat[name].to_numpy(float)
        problems += [
            f"{where('MAT1', mat.iloc[i])}: {name.upper()} {values[i]:g}, expected "
            "0 or more"
            for i in np.flatnonzero(values < 0.0)
        ]
    if problems:
        raise InputError(problems)


def isotropic(
    deck: "Deck", rows: pd.DataFrame, card: str, *, poisson: bool = False
) -> Isotropic:
    """MAT1 of each row's `mid`; `poisson`: ν itself counts, see `check_moduli`.

    Raises:
        InputError: materials that are not defined as MAT1, all of them.
    """
    mat = refer(rows, card, "mid", table(deck, "MAT1"), "MAT1")
    e, g, nu = complete(*(mat[c].to_numpy(float) for c in ("e", "g", "nu")))
    check_moduli(mat, poisson=poisson)
    return Isotropic(
        e=e,
        g=g,
        nu=nu,
        rho=column(mat, "rho"),
        ge=column(mat, "ge"),
        alpha=column(mat, "a"),
        tref=mat["tref"].to_numpy(float),
    )
