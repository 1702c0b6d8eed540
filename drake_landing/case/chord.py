"""The mean aerodynamic chord, over which centers of gravity are given."""

import numpy as np

from drake_landing.case.section import Section, number
from fem.arrays import Float64


class Chord(Section):
    """Where the mean aerodynamic chord lies."""

    leading_edge: float = number(
        "its coordinate along the deck's axis that points fore and aft", "m"
    )
    chord: float = number("its length", "m", gt=0)

    def percent(self, center: Float64, R_AB: Float64) -> float:
        """A center of gravity in % of the chord, aft of its leading edge.

        Args:
            center: (3,) in the deck's axes, m.
            R_AB: (3, 3).
        """
        aft = R_AB[0]
        along = float(np.sign(aft.sum())) * self.leading_edge
        return 100.0 * (float(center @ aft) - along) / self.chord
