"""The frequencies of a harmonic response: FREQ, FREQ1 ... FREQ5.

FREQ3 (clustered between modes), FREQ4 (spread about them) and FREQ5 (fractions of them)
need natural frequencies, those of SOL 111. (Formulas from memory of Nastran's guide.)
"""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.checks import FREQUENCIES
from fem.deck.control.subcase import Subcase
from fem.deck.references import where
from fem.errors import InputError, Problems

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_OF_MODES = ("FREQ3", "FREQ4", "FREQ5")


def frequencies(
    deck: "Deck", subcase: Subcase, natural: Float64 | None = None
) -> Float64:
    """(f,) Hz, ascending: all cards of the set that FREQUENCY selects.

    Neighbours closer than PARAM DFREQ of the whole range count once.

    Args:
        deck: the deck.
        subcase: what is selected.
        natural: (m,) Hz of the elastic modes; None: there are none (SOL 108).

    Raises:
        InputError: there is no such set, or it needs modes.
    """
    sid = subcase.frequency
    found, problems = [np.zeros(0)], Problems()
    for name in FREQUENCIES:
        rows = deck.cards[name]
        for _, row in rows[rows["sid"] == sid].iterrows():
            if name in _OF_MODES and natural is None:
                problems.append(
                    f"{where(name, row)}: is given by natural frequencies, which SOL "
                    "108 has not; expected SOL 111, or FREQ, FREQ1, FREQ2"
                )
                continue
            found.append(_one(name, row, np.zeros(0) if natural is None else natural))
    problems.report()
    hertz = np.unique(np.concatenate(found))
    hertz = hertz[hertz >= 0.0]
    if not len(hertz):
        known = sorted({int(i) for c in FREQUENCIES for i in deck.cards[c]["sid"]})
        raise InputError(
            f"{deck.path}: subcase {subcase.id}: FREQUENCY = {sid or 'nothing'} gives "
            f"no frequency, expected a set of {', '.join(FREQUENCIES)}: "
            f"{known or 'none in the deck'}"
        )
    return _apart(hertz, float(deck.number("DFREQ")))


def _one(name: str, row: pd.Series, natural: Float64) -> Float64:
    """Hz of one card."""
    if name == "FREQ":
        return np.asarray(row["fs"], float)
    if name == "FREQ1":
        return row["f1"] + row["df"] * np.arange(int(row["ndf"]) + 1)
    if name == "FREQ2":
        return np.geomspace(row["f1"], row["f2"], int(row["nf"]) + 1)
    if name == "FREQ3":
        return _clustered(row, natural)
    chosen = natural[(natural >= row["f1"]) & (natural <= row["f2"])]
    if name == "FREQ4":
        spread = np.linspace(-row["fspd"], row["fspd"], int(row["nfm"]))
        factors = 1.0 + (spread if len(spread) > 1 else np.zeros(1))
    else:
        factors = np.asarray(row["frs"], float)
    return np.outer(chosen, factors).ravel()


def _clustered(row: pd.Series, natural: Float64) -> Float64:
    """FREQ3: between F1, the natural frequencies, F2; closer to the ends by CLUSTER."""
    low, high = float(row["f1"]), float(row["f1"] if np.isnan(row["f2"]) else row["f2"])
    inside = natural[(natural > low) & (natural < high)]
    stops = np.unique([low, *inside, high])
    turn, back = (np.log, np.exp) if row["type"] == "LOG" else (np.asarray, np.asarray)
    share = np.linspace(-1.0, 1.0, int(row["nef"]))
    share = np.sign(share) * np.abs(share) ** (1.0 / float(row["cluster"]))
    stops = turn(stops)
    if len(stops) == 1:
        return back(stops)
    a, b = stops[:-1, None], stops[1:, None]
    return back(0.5 * (a + b) + 0.5 * (b - a) * share).ravel()


def _apart(hertz: Float64, share: float) -> Float64:
    """Without those that follow another one within a share of the range."""
    least = share * (hertz[-1] - hertz[0])
    kept = [float(hertz[0])]
    for value in hertz[1:].tolist():
        if value - kept[-1] > least:
            kept.append(value)
    return np.array(kept)
