"""Dynamic excitation: tables, pulses, delays, combinations, initial state, steps."""

import numpy as np
import pytest

from fem.errors import InputError
from fem.loads import dynamic_excitation, initial_conditions, time_steps
from fem.loads.time_functions import Delayed, Pulse, Table

BASE = """\
GRID,1
GRID,2,,1.
SPOINT,91
DAREA,7,2,3,10.,91,,2.
DAREA,7,2,3,1.
TABLED1,1
,0.,0.,1.,2.,ENDT
FORCE,3,2,,5.,0.,1.,0.
"""
CASE = "DLOAD = 5\nTSTEP = 1"


def excitation(model, bulk: str, case: str = CASE):
    m = model(BASE + bulk, case)
    return m, dynamic_excitation(m.deck, m.points, m.deck.case_control[0])


def test_table_is_linear_and_goes_on_with_its_end_segments():
    table = Table(np.array([0.0, 1.0, 3.0]), np.array([0.0, 2.0, 0.0]))
    np.testing.assert_allclose(
        table(np.array([-1.0, 0.0, 0.25, 1.0, 2.0, 3.0, 4.0])),
        [-2.0, 0.0, 0.5, 2.0, 1.0, 0.0, -1.0],
    )
    flat = Table(table.x, table.y + 1.0, flat=True)
    np.testing.assert_allclose(flat(np.array([-1.0, 4.0])), [1.0, 1.0])


def test_at_a_jump_the_mean_counts_also_after_rounding():
    table = Table(np.array([0.0, 0.3, 0.3, 1.0]), np.array([1.0, 1.0, 5.0, 5.0]))
    times = np.array([0.3, 0.1 + 0.2, 0.29, 0.31, 1.5])
    np.testing.assert_allclose(table(times), [3.0, 3.0, 1.0, 5.0, 5.0])
    ends = Table(np.array([0.0, 0.0, 1.0, 1.0]), np.array([0.0, 2.0, 2.0, 0.0]))
    np.testing.assert_allclose(ends(np.array([-1, 0, 0.5, 1, 2.0])), [0, 1, 2, 1, 0])


def test_logarithmic_axes():
    x, y = np.array([1.0, 100.0]), np.array([1.0, 10.0])
    t = np.array([10.0])
    assert Table(x, y, log_x=True, log_y=True)(t)[0] == pytest.approx(10**0.5)
    assert Table(x, y, log_x=True)(t)[0] == pytest.approx(5.5)
    assert Table(x, y, log_y=True)(t)[0] == pytest.approx(10 ** (9 / 99))


def test_pulse_is_the_formula_of_tload2():
    pulse = Pulse(
        start=1.0, end=3.0, frequency=0.5, phase=-90.0, growth=-0.2, power=2.0
    )
    t = np.linspace(0.0, 4.0, 41)
    s = t - 1.0
    expected = s**2 * np.exp(-0.2 * s) * np.cos(2 * np.pi * 0.5 * s - np.pi / 2)
    inside = (t >= 1.0 - 1e-12) & (t <= 3.0 + 1e-12)
    np.testing.assert_allclose(pulse(t), np.where(inside, expected, 0.0), atol=1e-14)
    # The ends belong to the pulse.
    step = Pulse(start=0.1, end=0.3)
    np.testing.assert_allclose(step(np.array([0.1, 0.1 + 0.2, 0.31])), [1, 1, 0])


def test_delay_shifts_a_function():
    pulse = Pulse(start=0.0, end=1.0)
    np.testing.assert_allclose(
        Delayed(pulse, 2.0)(np.array([1.9, 2.5, 3.1])), [0.0, 1.0, 0.0]
    )


def test_dload_scales_areas_and_functions(model):
    bulk = "TLOAD1,6,7,,,1\nTLOAD2,16,7,,,0.,9.,.25,-90.\nDLOAD,5,2.,3.,6,4.,16\n"
    m, load = excitation(model, bulk)
    dof = m.points.dof([2, 91], [3, 0])
    pattern = load.pattern.toarray()[dof]
    np.testing.assert_allclose(pattern, [[66.0, 88.0], [12.0, 16.0]])
    t = np.array([0.0, 0.5, 1.0])
    values = load.evaluate(t)
    np.testing.assert_allclose(values, [2 * t, np.sin(np.pi / 2 * t)], atol=1e-14)


def test_tload_may_be_selected_without_dload(model):
    _, load = excitation(model, "TLOAD1,5,7,,,1\n")
    assert load.pattern.shape[1] == 1


def test_delay_set_splits_a_pattern(model):
    m, load = excitation(model, "TLOAD1,5,7,4,,1\nDELAY,4,91,,.5\n")
    assert load.pattern.shape[1] == 2
    values = load.pattern @ load.evaluate([0.75])
    dof = m.points.dof([2, 91], [3, 0])
    np.testing.assert_allclose(values[dof, 0], [11 * 1.5, 2 * 0.5])
    _, common = excitation(model, "TLOAD1,5,7,.5,,1\n")
    np.testing.assert_allclose(common.evaluate([0.75]), [[0.5]])


def test_static_loads_through_lseq_or_directly(model):
    m, load = excitation(
        model, "TLOAD1,5,8,,,1\nLSEQ,9,8,3\nTSTEP,1,5,.1", CASE + "\nLOADSET=9"
    )
    row = m.points.dof(2, 2)
    assert load.pattern.toarray()[row, 0] == 5.0
    m, load = excitation(model, "TLOAD1,5,3,,,1\n")
    assert load.pattern.toarray()[row, 0] == 5.0
    # DAREA and LSEQ of one number add up.
    m, load = excitation(
        model, "TLOAD1,5,7,,,1\nLSEQ,9,7,3\nTSTEP,1,5,.1", CASE + "\nLOADSET=9"
    )
    assert load.pattern.toarray()[m.points.dof(2, [2, 3]), 0].tolist() == [5.0, 11.0]


@pytest.mark.parametrize(
    ("bulk", "message"),
    [
        ("TLOAD1,5,77,,,1", "EXCITEID 77 has no DAREA"),
        ("TLOAD1,5,7,,DISP,1", "enforced motion"),
        ("TLOAD1,5,7,88,,1", "DELAY 88 is not defined"),
        ("TLOAD2,5,7,,,2.,1.", "T1 2, T2 1 must ascend"),
        ("", "5 is no TLOAD1 or TLOAD2"),
        ("TLOAD1,5,7,,,2\nTABLED1,2,LOG\n,0.,1.,1.,2.,ENDT", "XAXIS LOG"),
    ],
)
def test_faults_are_named(model, bulk, message):
    with pytest.raises(InputError, match=message):
        excitation(model, bulk)


def test_no_dload_is_no_load(model):
    _, load = excitation(model, "", "TSTEP=1")
    assert load.pattern.shape[1] == 0
    assert load.evaluate([0.0, 1.0]).shape == (0, 2)


def test_initial_conditions_and_steps(model):
    bulk = BASE + "TIC,4,2,1,.1,.2\nTIC,4,91,,,.3\nTSTEP,1,10,.1,5\n,,20,.05,2\n"
    m = model(bulk, "IC = 4\nTSTEP = 1")
    case = m.deck.case_control[0]
    u0, v0 = initial_conditions(m.deck, m.points, case)
    dof = m.points.dof([2, 91], [1, 0])
    assert u0[dof].tolist() == [0.1, 0.0]
    assert v0[dof].tolist() == [0.2, 0.3]
    assert abs(u0).sum() + abs(v0).sum() == pytest.approx(0.6)
    assert time_steps(m.deck, case) == [(10, 0.1, 5), (20, 0.05, 2)]


def test_steps_that_are_not_there_are_named(model):
    m = model(BASE, "TSTEP = 3")
    with pytest.raises(InputError, match="TSTEP = 3, expected one of none"):
        time_steps(m.deck, m.deck.case_control[0])


@pytest.mark.parametrize(
    ("card", "at", "value"),
    [
        ("TABLED2,2,1.\n,0.,5.,2.,9.,ENDT", 2.0, 7.0),
        ("TABLED3,2,1.,2.\n,0.,5.,2.,9.,ENDT", 3.0, 7.0),
        ("TABLED4,2,1.,2.,0.,3.\n,5.,1.,2.,ENDT", 3.0, 8.0),
        ("TABLED4,2,1.,2.,0.,3.\n,5.,1.,2.,ENDT", 4.0, 8.0),
    ],
)
def test_tables_with_a_shifted_argument(model, card, at, value):
    _, found = excitation(model, f"TLOAD1,5,7,,,2\nDAREA,7,2,1,1.\n{card}\n")
    assert found.evaluate([at])[0, 0] == pytest.approx(value)
