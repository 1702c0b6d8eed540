"""Harmonic excitation: load patterns times complex functions of frequency.

    RLOAD1  P = A (C(f) + i D(f)) exp(i (θ - 2 π f τ))
    RLOAD2  P = A B(f) exp(i (φ(f) + θ - 2 π f τ))

with A of DAREA or static loads, θ of DPHASE and τ of DELAY; φ and θ in degrees. Of TYPE
DISP, VELO or ACCE it is the motion of freedoms that SPCD cards name and SPC holds:
displacements are P, P / iω or -P / ω².
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.sparse as sp

from fem.arrays import Float64
from fem.deck.control.subcase import Subcase
from fem.deck.references import where
from fem.errors import InputError, Problems
from fem.geometry.points import Points
from fem.loads.dynamic import pattern_of
from fem.loads.dynamic_sets import MOTIONS, load_factors, of_freedoms
from fem.loads.enforced_motion import motion_of
from fem.loads.time_tables import table_function

if TYPE_CHECKING:
    from fem.deck.deck import Deck

Complex128 = npt.NDArray[np.complex128]


@dataclass(frozen=True, kw_only=True)
class HarmonicExcitation:
    """P(f) = sum of patterns times factors, g-set, displacement frames.

    Attributes:
        pattern: (g, k) sparse.
        factor: (k, f) at the frequencies.
        motion: (g, m) sparse, displacements of constrained freedoms.
        motion_factor: (m, f) at the frequencies.
    """

    pattern: sp.csr_matrix
    factor: Complex128
    motion: sp.csr_matrix
    motion_factor: Complex128


def harmonic_excitation(
    deck: "Deck",
    points: Points,
    subcase: Subcase,
    frequency_hz: Float64,
    mass_gg: sp.csr_matrix | None = None,
) -> HarmonicExcitation:
    """Excitation that a subcase selects with DLOAD.

    Raises:
        InputError: undefined sets or tables, motion without SPCD; all of them.
    """
    factors = load_factors(deck, subcase.dload, ("RLOAD1", "RLOAD2"))
    load, motion = _Sum(points.size), _Sum(points.size)
    problems = Problems()
    for name in ("RLOAD1", "RLOAD2"):
        rows = deck.cards[name]
        for _, row in rows[rows["sid"].isin(factors)].iterrows():
            order = MOTIONS.get(row["type"])
            with problems.gathered():
                function = _function(deck, name, row, frequency_hz)
                if order is None:
                    spatial = pattern_of(deck, points, subcase, name, row, mass_gg)
                else:
                    spatial = motion_of(deck, points, subcase, name, row)
                    function = _integrated(name, row, function, frequency_hz, order)
                delay = of_freedoms(deck, points, row, "delay", "DELAY", "t")
                phase = of_freedoms(deck, points, row, "phase", "DPHASE", "th")
                spatial = factors[row["sid"]] * spatial
                used = np.flatnonzero(spatial)
                for pair in np.unique(np.c_[delay, phase][used], axis=0):
                    same = (delay == pair[0]) & (phase == pair[1])
                    angle = np.radians(pair[1]) - 2.0 * np.pi * frequency_hz * pair[0]
                    whole = load if order is None else motion
                    part = np.where(same, spatial, 0.0)
                    whole.add(part, function * np.exp(1j * angle))
    problems.report()
    pattern, factor = load.result(len(frequency_hz))
    moved, motion_factor = motion.result(len(frequency_hz))
    return HarmonicExcitation(
        pattern=pattern, factor=factor, motion=moved, motion_factor=motion_factor
    )


class _Sum:
    """Sum of patterns (size,) times factors (f,), gathered one by one."""

    def __init__(self, size: int) -> None:
        self._size = size
        self._patterns: list[Float64] = []
        self._factors: list[Complex128] = []

    def add(self, pattern: Float64, factor: Complex128) -> None:
        self._patterns.append(pattern)
        self._factors.append(factor)

    def result(self, frequencies: int) -> tuple[sp.csr_matrix, Complex128]:
        """(size, k) and (k, f)."""
        k = len(self._patterns)
        pattern = np.stack(self._patterns, axis=1) if k else np.zeros((self._size, 0))
        factor = np.array(self._factors, complex).reshape(k, frequencies)
        return sp.csr_matrix(pattern), factor


def _integrated(
    name: str,
    row: pd.Series,
    function: Complex128,
    frequency_hz: Float64,
    order: int,
) -> Complex128:
    """(f,) displacements of a motion that is given as its derivative of an order.

    Raises:
        InputError: at 0 Hz there is none.
    """
    if order and (frequency_hz == 0.0).any():
        raise InputError(
            f"{where(name, row)}: TYPE {row['type']} at 0 Hz has no displacement; "
            "expected frequencies above 0"
        )
    return function / (2j * np.pi * frequency_hz) ** order


def _function(
    deck: "Deck", name: str, row: pd.Series, frequency_hz: Float64
) -> Complex128:
    """(f,) without phase and delay."""

    def of(kind: str) -> Float64:
        tid = int(row[f"{kind}id"])
        if not tid:
            return np.full(len(frequency_hz), float(row[kind]))
        return table_function(deck, tid)(frequency_hz)

    if name == "RLOAD1":
        return (of("tc") + 1j * of("td")).astype(np.complex128)
    return (of("tb") * np.exp(1j * np.radians(of("tp")))).astype(np.complex128)
