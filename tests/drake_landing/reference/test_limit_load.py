"""The limit manoeuvre of 2.65 g: loads, equilibrium, strength."""

import numpy as np
import pytest

from benchmarks.limit_load import solve
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.limit_load import (
    GRAVITY,
    LOAD_FACTOR,
    SOURCE_ROOT_MOMENT,
    applied_loads,
    limit_load,
)


def test_loads_are_2_65_times_the_weight(con) -> None:
    load = applied_loads(con.structure)
    rigid = con.structure.rigid_body
    total = rigid.T @ con.structure.load(load[:, None])[:, 0]
    weight = facts("overall")["mass"]["total"] * GRAVITY
    gears = sum(gear.mass for gear in con.model.gears) * GRAVITY
    assert total[2] == pytest.approx(LOAD_FACTOR * (weight - gears), rel=1e-9)
    # Symmetric, and trimmed to a few percent of the mean chord.
    np.testing.assert_allclose(total[[1, 3, 5]], 0.0, atol=0.1)
    chord = facts("overall")["mean_chord"]["length"]
    assert abs(total[4]) < 0.05 * chord * LOAD_FACTOR * weight


def test_con_carries_the_moment_of_the_source(con) -> None:
    found = limit_load(con.structure)
    assert found.acceleration[2] == pytest.approx(LOAD_FACTOR * GRAVITY, rel=1e-6)
    # The aircraft is 1.5 % lighter than that of the source.
    assert found.root_moment == pytest.approx(0.985 * SOURCE_ROOT_MOMENT, rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("level", ["pre", "full"])
def test_the_shell_aircraft_is_sized(level: str) -> None:
    found = solve(level)
    assert found.root_moment == pytest.approx(0.985 * SOURCE_ROOT_MOMENT, rel=0.02)
    assert 1.0 < found.tip_deflection < 2.5, "3 to 7 % of the span"
    assert found.worst.margin > 0.05, "every sheet and bar holds at ultimate load"
    assert found.stress.stress.quantile(0.99) > 100e6, "it works for its living"
