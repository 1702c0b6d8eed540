"""Monitor points of a deck: against grid point forces, statics and section loads."""

import numpy as np
import pytest

from drake_landing.parts.monitors import stations
from drake_landing.parts.slices import balanced
from fem.deck.reader import read_deck
from fem.deck.units import in_si, units_of
from fem.model.structure import Structure
from fem.recovery.grid_forces import grid_balance
from fem.recovery.monitor_points import monitor_points

# A free bar of five grids with an arm at its end, in a frame of its own at grid 4.
DECK = """\
SOL 103
CEND
BEGIN BULK
CORD2R,7,,0.,0.,0.,0.,1.,0.
,0.,0.,1.
CORD2C,8,,1.,0.,0.,1.,0.,1.
,2.,0.,0.
MAT1,1,7.+10,,.3,2700.
PBAR,1,1,.01,4.-5,6.-5,8.-5
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,.1
GRID,3,,2.,0.,.1
GRID,4,,3.,.1,.2,7
GRID,5,,4.,.1,.3
GRID,6,,4.,1.1,.3
CBAR,11,1,1,2,0.,0.,1.
CBAR,12,1,2,3,0.,0.,1.
CBAR,13,1,3,4,0.,0.,1.
CBAR,14,1,4,5,0.,0.,1.
CBAR,15,1,5,6,0.,0.,1.
CONM2,21,1,,40.,.1,.2,.3
,5.,,6.,,,7.
CONM2,26,6,,20.
,3.,,4.,,,5.
SET1,100,3,THRU,6
SET1,101,3,99
SET1,102,13
SET1,103,3,4,5
SET1,104,6
AECOMP  OUTER   SET1    100
AECOMP,SHORT,SET1,103
AECOMP,TIP,SET1,104
AECOMPL,BOTH,SHORT,TIP
AECOMP,BOXES,CAERO1,1001
MONPNT1 OUTER   Wing Integrated Load to Butline 2
        123456  OUTER           2.      0.      .1
MONPNT1,TURNED,Label in free fields,+M
+M,35,BOTH,,2.,0.,.1,7
MONPNT1 AERO    Air
        123456  BOXES
MONPNT3 CUT3    Outboard of grid 3
        123456  101     102             2.      0.      .1      SMAD
MONPNT3 CUT3B
        123456  101     102             2.      0.      .1
MONPNT3 PART
        123456  101     102             2.      0.      .1      S
MONPNT3 ROUND
        135     101     102     8       1.      0.      .1      SMAD    +
+       8
"""
LOADED = (1, 4, 6)


@pytest.fixture(scope="module")
def structure(tmp_path_factory):
    path = tmp_path_factory.mktemp("monitors") / "deck.bdf"
    path.write_text(DECK + "ENDDATA\n")
    return Structure.from_deck(read_deck(path))


@pytest.fixture(scope="module")
def answer(structure):
    """Loads (3, 6), B, at three nodes; rigid acceleration and displacements."""
    load = np.random.default_rng(3).normal(size=(3, 6)) * [3e3, 3e3, 3e3, 1e3, 1e3, 1e3]
    operator = structure.operator(LOADED, frame="basic")
    found = balanced(structure, np.asarray(operator.T @ load.ravel())[:, None])
    return load, found


def of(structure, answer) -> dict[str, np.ndarray]:
    load, found = answer
    values = {}
    for s in stations(structure, LOADED)[0]:
        moved = found.motion if s.of_displacement is None else found.displacement
        maps = s.of_acceleration if s.of_displacement is None else s.of_displacement
        values[s.name] = s.values((maps @ moved).T, load[None])[0]
    return values


def test_names_labels_axes_and_what_is_left_out(structure):
    found = monitor_points(structure)
    assert [p.name for p in found.points] == [
        "OUTER", "TURNED", "CUT3", "CUT3B", "ROUND"
    ]  # fmt: skip
    labels = [p.label for p in found.points[:3]]
    assert labels == [
        "WING INTEGRATED LOAD TO BUTLINE 2",
        "LABEL IN FREE FIELDS",
        "OUTBOARD OF GRID 3",
    ]
    assert found.points[1].axes == (2, 4)
    assert found.points[4].axes == (0, 2, 4)
    text = " | ".join(found.notices)
    assert "MONPNT1 AERO: not summed: AECOMP BOXES is of CAERO1" in text
    assert "MONPNT3 PART: not summed: XFLAG S leaves some kinds" in text


def test_monpnt1_is_what_the_cut_element_carries(structure, answer):
    """Loads and inertia of all grids outboard against forces of the bar inboard."""
    found = of(structure, answer)
    none = np.zeros(6, bool)
    balance = grid_balance(
        structure.points, structure.blocks, loaded=none, spc=none, mpc=none
    )
    u = structure.displacement(answer[1].displacement[:, 0])
    force = (balance.elements @ u).reshape(-1, 6)
    row = np.flatnonzero((balance.grid_id == 3) & (balance.element_id == 12))
    # The bar 12 pushes grid 3 with what the outboard part leaves over, reversed.
    assert found["OUTER"] == pytest.approx(-force[row[0]], rel=1e-6, abs=1e-4)
    at_3 = np.flatnonzero((balance.grid_id == 3) & (balance.element_id == 13))
    assert found["CUT3"] == pytest.approx(force[at_3[0]], rel=1e-9, abs=1e-6)


def test_the_rest_of_the_elements_is_what_a_blank_xflag_sums(structure, answer):
    """A + B = -C: bar 12 is the only element at grid 3 that is not in the set."""
    found = of(structure, answer)
    assert found["CUT3B"] == pytest.approx(found["OUTER"], rel=1e-6, abs=1e-4)


def test_loads_come_along_the_frame_cd(structure, answer):
    """Frame 7: its axis 3 is B's y, its axis 1 B's z, its axis 2 B's x."""
    found = of(structure, answer)
    assert found["TURNED"] == pytest.approx(found["OUTER"][[1, 3]], rel=1e-9)
    # In the cylindrical frame 8 the point lies at radius 1, angle 0, 0.1 up.
    point = next(p for p in monitor_points(structure).points if p.name == "ROUND")
    assert point.point == pytest.approx([2.0, 0.0, 0.1])
    assert found["ROUND"] == pytest.approx(found["CUT3"][[0, 2, 4]], rel=1e-9)


def test_points_of_one_name_are_told_apart_and_units_are_converted(tmp_path):
    text = DECK.replace("MONPNT3 CUT3    Outboard", "MONPNT3 OUTER   Outboard")
    path = tmp_path / "deck.bdf"
    path.write_text(text + "ENDDATA\n")
    deck = read_deck(path)
    names = [s.name for s in stations(Structure.from_deck(deck), LOADED)[0]]
    assert names == ["OUTER (MONPNT1)", "TURNED", "OUTER (MONPNT3)", "CUT3B", "ROUND"]
    in_metres = Structure.from_deck(in_si(deck, units_of("mm-t-N")))
    points = monitor_points(in_metres).points
    assert points[0].point == pytest.approx([2e-3, 0.0, 1e-4])
    assert points[-1].point == pytest.approx([2e-3, 0.0, 1e-4])  # cylindrical frame
