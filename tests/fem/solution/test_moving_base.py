"""Enforced motion in SOL 109 and 112: an oscillator on a moving base, closed forms."""

import h5py
import numpy as np
import pytest

import fem
from fem.errors import InputError
from fem.solution import run_deck

K, M = 1000.0, 2.0
OMEGA = np.sqrt(K / M)
STEPS, H = 2000, 5e-4
OSCILLATOR = f"""\
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
CELAS2,1,{K},1,1,2,1
CMASS2,3,{M},2,1
CMASS2,4,.5,1,1
SPC1,1,123456,1
SPC1,1,23456,2
SPCD,9,1,1,.5
TSTEP,3,{STEPS},{H},1
EIGRL,1,,,1
"""
CASE = """\
SPC = 1
DLOAD = 5
TSTEP = 3
DISP = ALL
ACCELERATION = ALL
SPCFORCES = ALL
FORCE = ALL
METHOD = 1
"""


@pytest.fixture
def solve(tmp_path):
    def go(sol, bulk, case=CASE):
        path = tmp_path / "deck.bdf"
        path.write_text(f"SOL {sol}\nCEND\n{case}BEGIN BULK\n{bulk}\nENDDATA\n")
        out = run_deck(fem.read_deck(path), tmp_path / "deck.h5")
        with h5py.File(out) as file:
            group = file["transient/1"]
            names = ("time", "displacement", "acceleration", "spc_force")
            found = {name: group[name][()] for name in names}
            found["spring"] = group["element_force/CELAS2/value"][()]
        return found

    return go


def of_base(found, name, grid):
    return found[name].reshape(STEPS + 1, -1, 6)[:, grid, 0]


@pytest.mark.parametrize("sol", [109, 112])
def test_a_base_that_is_accelerated_drags_the_oscillator(solve, sol):
    """a = 6 from rest: z = u - s = -(a / w^2)(1 - cos w t), reaction M u'' + m a."""
    bulk = OSCILLATOR + "TABLED1,7\n,0.,12.,100.,12.,ENDT\nTLOAD1,5,9,,ACCE,7\n"
    found = solve(sol, bulk)
    t = found["time"]
    base, own = (of_base(found, "displacement", k) for k in (0, 1))
    np.testing.assert_allclose(base, 3.0 * t * t, atol=1e-9)
    z = -6.0 / OMEGA**2 * (1.0 - np.cos(OMEGA * t))
    np.testing.assert_allclose(own - base, z, atol=0.02 * np.abs(z).max())
    np.testing.assert_allclose(of_base(found, "acceleration", 0)[1:-1], 6.0, rtol=1e-6)
    np.testing.assert_allclose(
        of_base(found, "spc_force", 0), K * (base - own) + 0.5 * 6.0, rtol=1e-6
    )
    spring = np.abs(found["spring"].ravel())
    np.testing.assert_allclose(spring, np.abs(K * (own - base)), rtol=1e-6)


@pytest.mark.parametrize("sol", [109, 112])
@pytest.mark.parametrize(("kind", "order"), [("DISP", 0), ("VELO", 1), ("ACCE", 2)])
def test_kinds_of_motion_give_one_answer(solve, sol, kind, order):
    """s = S (p t - sin p t) from rest, by its derivatives; no jump at the begin."""
    p, size = 15.0, 0.01
    t = np.arange(STEPS + 2) * H
    given = [p * t - np.sin(p * t), p * (1 - np.cos(p * t)), p * p * np.sin(p * t)]
    # TABLED1 with a point at each step, SPCD 0.5.
    points = [f"{a:.10e},{2 * size * b:.10e}" for a, b in zip(t, given[order])]
    points.append("ENDT")
    rows = [",".join(points[k : k + 4]) for k in range(0, len(points), 4)]
    bulk = OSCILLATOR + "TABLED1,7\n," + "\n,".join(rows) + "\n"
    found = solve(sol, bulk + f"TLOAD1,5,9,,{kind},7\n")
    t = found["time"]
    np.testing.assert_allclose(
        of_base(found, "displacement", 0), size * (p * t - np.sin(p * t)), atol=1e-6
    )
    # z'' + w^2 z = -s'' = -S p^2 sin p t
    ratio = size * p * p / (OMEGA**2 - p * p)
    z = -ratio * (np.sin(p * t) - p / OMEGA * np.sin(OMEGA * t))
    ours = of_base(found, "displacement", 1) - of_base(found, "displacement", 0)
    np.testing.assert_allclose(ours, z, atol=5e-3 * np.abs(z).max())


def test_motion_of_what_no_spc_holds_is_named(solve):
    bulk = OSCILLATOR.replace("SPCD,9,1,1,.5", "SPCD,9,2,1,.5")
    bulk += "TABLED1,7\n,0.,1.,100.,1.,ENDT\nTLOAD1,5,9,,DISP,7\n"
    with pytest.raises(InputError, match="which no SPC holds"):
        solve(109, bulk)
