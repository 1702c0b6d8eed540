"""Legs of gears from a reduced finite-element model of the leg."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drake_landing.reduced.legs import with_read_legs
from fem.errors import InputError
from fem.files.matrices import write_dmig
from fem.matrix_files.named import NamedMatrix
from tests.drake_landing.gears.test_legs import Rig, cantilever
from tests.drake_landing.landing_gears import aircraft_gears, changed

ROOT, AXLE, LENGTH = 11, 22, 2.4
MASS = 400.0


@pytest.fixture
def files(tmp_path):
    """DMIG and table of a free cantilever with the axle below its root."""
    at_axle = cantilever(LENGTH, (2e7, 3e7))
    carried = np.eye(6)  # motion of the axle by that of the root
    carried[:3, 3:] = [[0, -LENGTH, 0], [LENGTH, 0, 0], [0, 0, 0]]
    both = np.hstack([-carried, np.eye(6)])
    mass = np.kron(np.eye(2), np.diag([MASS / 2] * 3 + [10.0] * 3))
    labels = np.array([(g, c) for g in (ROOT, AXLE) for c in range(1, 7)])
    write_dmig(
        tmp_path / "leg.pch",
        [
            NamedMatrix(name=name, values=values, rows=labels, columns=labels)
            for name, values in (("KRED", both.T @ at_axle @ both), ("MRED", mass))
        ],
    )
    table = f"id,x,y,z\n{ROOT},17.7,-3.8,{LENGTH - 3.716}\n{AXLE},17.7,-3.8,-3.716\n"
    (tmp_path / "grids.csv").write_text(table)
    return {"files": [str(tmp_path / "leg.pch")], "grids": str(tmp_path / "grids.csv")}


def _gear(given, **more):
    reduced = {**given, "root": ROOT, "axle": AXLE} | more
    return changed(aircraft_gears()[1], leg={"reduced": reduced})


def test_leg_of_a_reduced_model_has_its_stiffness(files):
    nose = aircraft_gears()[0]
    (same, gear), notices = with_read_legs([nose, _gear(files)])
    assert same is nose
    assert notices == ()  # 400 kg lie between the piston's and those with the fitting
    expected = cantilever(LENGTH, (2e7, 3e7))
    assert_allclose(gear.leg.matrix.stiffness, expected, rtol=1e-6, atol=1.0)
    rig = Rig(gear.model_copy(update={"leg": None}), **gear.leg.model_dump())
    k = 3 * 2e7 / LENGTH**3
    assert_allclose(rig.law.stiffness[0, 0, 0], k * (2 * LENGTH / 3) ** 2, rtol=1e-6)


def test_a_mass_that_is_not_that_of_the_gear_is_told(files):
    heavy = _gear(files)
    light = {"mass": 30.0, "cg": heavy.piston.cg, "inertia": (1.0, 1.0, 1.0)}
    few = changed(heavy, piston=light, fitting=light)
    _, (notice,) = with_read_legs([few])
    assert notice.startswith("gears.main_left.leg.reduced: the matrices have a mass of")
    assert "400 kg" in notice


def test_a_leg_of_the_other_side_is_told(files):
    other = changed(
        aircraft_gears()[2], leg={"reduced": {**files, "root": ROOT, "axle": AXLE}}
    )
    _, (notice,) = with_read_legs([other])
    assert "grid 22 lies at 17.7, -3.8, -3.716, the end of the gear's leg at" in notice


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"axle": 23}, "axle: found grid 23, expected one of 11, 22"),
        ({"root": 1}, "root: found grid 1, expected one of 11, 22"),
        ({"root": AXLE, "axle": ROOT}, "turns against|moves freely|expected"),
        ({"stiffness": "KREX"}, "no stiffness matrix 'KREX'"),
        ({"files": ["nowhere.pch"]}, "nowhere.pch"),
    ],
)
def test_files_that_do_not_fit_are_named(files, changes, message):
    if "axle" in changes and "root" in changes:
        gear = with_read_legs([_gear(files, **changes)])[0][0]
        with pytest.raises(ValueError, match=message):
            Rig(gear.model_copy(update={"leg": None}), **gear.leg.model_dump())
        return
    with pytest.raises(InputError, match=message) as caught:
        with_read_legs([_gear(files, **changes)])
    assert str(caught.value).startswith("gears.main_left.leg.reduced: ")


def test_a_leg_whose_files_were_not_read_says_so(files):
    with pytest.raises(ValueError, match="files have not been read yet"):
        Rig(aircraft_gears()[1], **_gear(files).leg.model_dump())
