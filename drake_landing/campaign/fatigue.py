"""Stress cycles of a history, and the damage they do.

Rainflow counting as in ASTM E1049-85 (2017), 5.4.4, by the `rainflow` package; damage
by Miner's sum with an S-N curve N = (reference / range)^slope of the user's own. No
mean-stress correction: ranges alone count, which is said in the tables.
"""

import numpy as np
import pandas as pd
import rainflow

from drake_landing.campaign.schema import Fatigue
from fem.arrays import Float64


def cycles(history: Float64) -> pd.DataFrame:
    """Rainflow cycles of a history (t,).

    Returns:
        Columns `range`, `mean` (units of the history), `count` (1 or 0.5).

    >>> cycles(np.array([0.0, 2.0, 1.0, 3.0]))
       range  mean  count
    0    1.0   1.5    1.0
    1    3.0   1.5    0.5
    """
    found = [(c[0], c[1], c[2]) for c in rainflow.extract_cycles(history)]
    return pd.DataFrame(found, columns=["range", "mean", "count"])


def damage(found: pd.DataFrame, curve: Fatigue) -> float:
    """Miner's sum of cycles: 1 means failure."""
    ranges = found["range"].to_numpy(float)
    counted = np.where(ranges > curve.endurance, found["count"].to_numpy(float), 0.0)
    return float(np.sum(counted * (ranges / curve.reference_stress) ** curve.slope))
