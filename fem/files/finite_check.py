"""Numbers that are none are not written: the first of them is named."""

from collections.abc import Sequence

import numpy as np

from fem.arrays import Float64
from fem.errors import InputError

_WHY = (
    "products of the deck's numbers leave the range of double precision (1e-308 to "
    "1e308); expected loads, stiffness, masses and steps of one consistent system of "
    "units"
)


def require_finite(
    name: str,
    values: Float64,
    labels: Sequence[str] = (),
    time: Float64 | None = None,
    *,
    blanks: bool = False,
) -> None:
    """Refuse infinite values, and NaN except as `blanks`.

    Args:
        name: what it is, for the message: a dataset of the result file.
        values: (n,), or (t, n) at times.
        labels: (n,) where each stands.
        time: (t,) s.
        blanks: NaN stands for what does not exist.

    Raises:
        InputError: quantity, place and time of the first that is not finite.
    """
    bad = np.isinf(values) if blanks else ~np.isfinite(values)
    if not bad.any():
        return
    at = np.unravel_index(int(np.argmax(bad)), bad.shape)
    place = f" at {labels[int(at[-1])]}" if len(labels) else ""
    when = "" if time is None or len(at) < 2 else f", t = {time[int(at[0])]:.6g} s"
    found = float(np.asarray(values)[at])
    raise InputError(f"{name} is {found:g}{place}{when}: {_WHY}")
