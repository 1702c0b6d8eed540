"""Side load of a strut."""

import numpy as np
from numpy.testing import assert_allclose

from systems.shock_absorber.side_load import SideLoad


def test_side_load_is_the_sum_of_forces_across_the_strut():
    system = SideLoad(("left", "right"))
    context = system.CreateDefaultContext()
    axis = np.array([0.6, 0.0, 0.8])
    across = np.array([0.8, 0.0, -0.6])
    values = {
        "strut_axis": axis,
        "tire_left": [9.0, 9.0, 9.0, *(100.0 * axis + 30.0 * across)],
        "tire_right": [0.0, 0.0, 0.0, *(50.0 * axis + [0.0, 40.0, 0.0])],
    }
    for name, value in values.items():
        system.GetInputPort(name).FixValue(context, value)
    assert_allclose(system.GetOutputPort("side_load").Eval(context), 50.0)
