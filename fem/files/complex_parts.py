"""Complex results as Nastran's files have them: two real numbers for one."""

import numpy as np
import numpy.typing as npt

from fem.deck.control.subcase import Subcase

# Word 9 of a header, heading of PUNCH.
REAL, RECTANGULAR, POLAR = 1, 2, 3
HEADINGS = {
    REAL: "$REAL OUTPUT",
    RECTANGULAR: "$REAL-IMAGINARY OUTPUT",
    POLAR: "$MAGNITUDE-PHASE OUTPUT",
}


def form_of(case: Subcase, request: str, values: npt.NDArray | np.dtype) -> int:
    """REAL, RECTANGULAR or, where the request says PHASE, POLAR."""
    kind = values if isinstance(values, np.dtype) else values.dtype
    if not np.issubdtype(kind, np.complexfloating):
        return REAL
    return POLAR if "PHASE" in case.options.get(request, ()) else RECTANGULAR


def as_asked(values: npt.NDArray, form: int) -> npt.NDArray:
    """Values in the form asked for: in POLAR magnitudes and degrees are the parts."""
    if form != POLAR:
        return values
    return np.abs(values) + 1j * (np.degrees(np.angle(values)) % 360.0)
