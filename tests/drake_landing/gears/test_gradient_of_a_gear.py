"""A whole gear converts to AutoDiffXd: gradients of a landing."""

import numpy as np
import pytest
from pydrake.autodiffutils import AutoDiffXd, ExtractGradient

from drake_landing.gears.drop_rig import drop_rig
from drake_landing.reference.d150.gears import landing_gears
from tests.drake_landing.landing_gears import levered_main


@pytest.mark.parametrize("kind", ["elastic leg", "levered"])
def test_gradient_of_the_peak_force_of_a_gear_is_that_of_differences(kind):
    gear = landing_gears()[2] if kind == "elastic leg" else levered_main()
    rig = drop_rig(gear, mass=32e3, p_BA=[17.6, gear.axle[1], -1.05])
    at = np.array([45e3, 45e3])

    def peak(rig, values):
        return rig.peak_force(
            sink_rate=2.0,
            speed=67.0,
            duration=0.06,
            precharge=values[0],
            compression_damping=values[1],
        )

    seeded = [AutoDiffXd(x, row) for x, row in zip(at, np.eye(2))]
    exact = peak(rig.ToAutoDiffXd(), seeded)
    assert exact.value() == pytest.approx(peak(rig, at), rel=1e-9)
    for i, slope in enumerate(ExtractGradient(np.array([exact])).ravel()):
        h = 1e-4 * at * np.eye(2)[i]
        above, below = peak(rig, at + h), peak(rig, at - h)
        assert slope == pytest.approx((above - below) / (2 * h[i]), rel=1e-4)
