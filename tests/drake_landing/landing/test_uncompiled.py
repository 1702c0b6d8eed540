"""A landing without compiled laws, through which a debugger can step."""

import json
import os
import subprocess
import sys

import pytest
from numpy.testing import assert_allclose

from drake_landing.landing.diagram import MakeLandingDiagram
from systems.tools.compiled import COMPILES
from tests.drake_landing.landing_gears import aircraft_gears
from tests.drake_landing.landing_run import land
from tests.systems.synthetic_body import aircraft_body

SCRIPT = """
import json
from tests.drake_landing.landing.test_uncompiled import COMPILES, last_loads
print(json.dumps([COMPILES, last_loads()]))
"""


def last_loads() -> list[float]:
    """N, N m, while the gears are being compressed."""
    landing = MakeLandingDiagram(aircraft_body(3), aircraft_gears())
    run = land(landing, duration=0.02, step=2e-3)
    return run["attachment.load_in_airframe_axes"][:, -1].tolist()


@pytest.mark.skipif(not COMPILES, reason="NUMBA_DISABLE_JIT is set")
def test_landing_without_compilation_has_the_same_loads():
    env = {**os.environ, "NUMBA_DISABLE_JIT": "1", "PYTHONPATH": os.getcwd()}
    run = [sys.executable, "-c", SCRIPT]
    done = subprocess.run(run, env=env, capture_output=True, text=True, check=True)
    compiles, loads = json.loads(done.stdout)
    assert not compiles
    expected = last_loads()
    largest = max(map(abs, expected))
    assert largest > 1e4
    # Sums of compiled laws are reordered.
    assert_allclose(loads, expected, rtol=0.0, atol=1e-9 * largest)
