"""How often what is exceeded in the landings of a campaign, with confidence bounds.

Only meaningful where the landings were drawn at random; the tables say when they were
not.
"""

import numpy as np
import pandas as pd

from fem.arrays import Float64


def exceedance(values: Float64, confidence: float = 0.9) -> pd.DataFrame:
    """Share of landings in which each of the values found is exceeded.

    Args:
        values: (n,) one of each landing; NaN is left out.
        confidence: of the two-sided bounds (Clopper and Pearson, Biometrika 26, 1934).

    Returns:
        Rows by falling value; columns `value`, `share` (k/(n+1) of the k-th largest,
        Weibull's plotting position), `low`, `high`.
    """
    import scipy.stats

    ordered = np.sort(values[np.isfinite(values)])[::-1]
    n = len(ordered)
    k = np.arange(1, n + 1)
    tail = (1.0 - confidence) / 2.0
    # The k-th largest of n: the share above it is distributed as Beta(k, n + 1 - k).
    law = scipy.stats.beta(k, n + 1 - k)
    return pd.DataFrame(
        {
            "value": ordered,
            "share": k / (n + 1.0),
            "low": law.ppf(tail) if n else ordered,
            "high": law.ppf(1.0 - tail) if n else ordered,
        }
    )


def exceedance_tables(quantities: pd.DataFrame) -> pd.DataFrame:
    """Exceedances of many quantities: `quantity` and the columns of `exceedance`.

    Args:
        quantities: one row a landing, one column a quantity; magnitudes are taken.
    """
    tables = [
        exceedance(quantities[name].abs().to_numpy(float)).assign(quantity=name)
        for name in quantities.columns
    ]
    if not tables:
        return pd.DataFrame(columns=["quantity", "value", "share", "low", "high"])
    found = pd.concat(tables, ignore_index=True)
    return pd.DataFrame(found, columns=["quantity", "value", "share", "low", "high"])
