"""Harmonic excitation: load patterns times complex functions of frequency.

    RLOAD1  P = A (C(f) + i D(f)) exp(i (θ - 2 π f τ))
    RLOAD2  P = A B(f) exp(i (φ(f) + θ - 2 π f τ))

with A of DAREA or static loads, θ of DPHASE and τ of DELAY; φ and θ in degrees.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.sparse as sp

from fem.arrays import Float64
from fem.deck.case_control import Subcase
from fem.deck.references import where
from fem.errors import InputError
from fem.geometry.points import Points
from fem.loads.dynamic import load_factors, of_freedoms, pattern_of, table_function

if TYPE_CHECKING:
    from fem.deck.deck import Deck

Complex128 = npt.NDArray[np.complex128]


@dataclass(frozen=True, kw_only=True)
class HarmonicExcitation:
    """P(f) = sum of patterns times factors, g-set, displacement frames.

    Attributes:
        pattern: (g, k) sparse.
        factor: (k, f) at the frequencies.
    """

    pattern: sp.csr_matrix
    factor: Complex128


def harmonic_excitation(
    deck: "Deck",
    points: Points,
    subcase: Subcase,
    frequency_hz: Float64,
    mass_gg: sp.csr_matrix | None = None,
) -> HarmonicExcitation:
    """Excitation that a subcase selects with DLOAD.

    Raises:
        InputError: enforced motion, undefined sets or tables; all of them.
    """
    factors = load_factors(deck, subcase.dload, ("RLOAD1", "RLOAD2"))
    columns: list[Float64] = []
    rows_f: list[Complex128] = []
    problems: list[str] = []
    for name in ("RLOAD1", "RLOAD2"):
        rows = deck.cards[name]
        for _, row in rows[rows["sid"].isin(factors)].iterrows():
            try:
                function = _function(deck, name, row, frequency_hz)
                spatial = factors[row["sid"]] * pattern_of(
                    deck, points, subcase, name, row, mass_gg
                )
            except InputError as error:
                problems += error.problems
                continue
            delay = of_freedoms(deck, points, row, "delay", "DELAY", "t")
            phase = of_freedoms(deck, points, row, "phase", "DPHASE", "th")
            used = np.flatnonzero(spatial)
            for pair in np.unique(np.c_[delay, phase][used], axis=0):
                same = (delay == pair[0]) & (phase == pair[1])
                columns.append(np.where(same, spatial, 0.0))
                angle = np.radians(pair[1]) - 2.0 * np.pi * frequency_hz * pair[0]
                rows_f.append(function * np.exp(1j * angle))
    if problems:
        raise InputError(problems)
    pattern = np.stack(columns, axis=1) if columns else np.zeros((points.size, 0))
    factor = np.array(rows_f, complex).reshape(len(columns), len(frequency_hz))
    return HarmonicExcitation(pattern=sp.csr_matrix(pattern), factor=factor)


def _function(
    deck: "Deck", name: str, row: pd.Series, frequency_hz: Float64
) -> Complex128:
    """(f,) without phase and delay."""
    if row["type"] != "LOAD":
        raise InputError(
            f"{where(name, row)}: TYPE {row['type']} (enforced motion) is not "
            "supported, expected LOAD"
        )

    def of(kind: str) -> Float64:
        tid = int(row[f"{kind}id"])
        if not tid:
            return np.full(len(frequency_hz), float(row[kind]))
        return table_function(deck, tid)(frequency_hz)

    if name == "RLOAD1":
        return (of("tc") + 1j * of("td")).astype(np.complex128)
    return (of("tb") * np.exp(1j * np.radians(of("tp")))).astype(np.complex128)
