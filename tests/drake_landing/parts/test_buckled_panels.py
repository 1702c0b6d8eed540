"""Panels that buckle first: two columns in closed form, a panel a place, the cache."""

import numpy as np
import pytest

import fem
from drake_landing.cache import Cache
from drake_landing.parts.buckling import buckled_panels, with_margin
from drake_landing.parts.inventory import inventory
from fem.algebra.statics import solve_static

YOUNG, EULER = 7e10, np.pi**2 * 7e10 / 4.0  # of inertia 1, fixed-free, length 1

DECK = """\
SOL 101
CEND
SPC = 1
BEGIN BULK
MAT1,1,7.+10,,.3,2700.
PBAR,1,1,.01,2.-6,3.-6,4.-6
PBAR,2,1,.01,4.-6,5.-6,4.-6
SPC1,1,123456,1,21
"""


@pytest.fixture(scope="module")
def columns(tmp_path_factory):
    """Two columns of ten bars, grids 1 to 11 and 21 to 31."""
    lines = [DECK]
    for first, pid, y in ((1, 1, 0.0), (21, 2, 1.0)):
        lines += [f"GRID,{first + k},,{k / 10},{y},0.\n" for k in range(11)]
        lines += [
            f"CBAR,{first + k},{pid},{first + k},{first + k + 1},0.,1.,0.\n"
            for k in range(10)
        ]
    path = tmp_path_factory.mktemp("columns") / "deck.bdf"
    path.write_text("".join(lines) + "ENDDATA\n")
    return fem.Structure.from_deck(fem.read_deck(path))


def states(structure):
    """(f, 2) under 1 kN on both columns, and on the second alone."""
    tips = structure.operator([11, 31], (1,))
    load = -1e3 * np.array([[1.0, 1.0], [0.0, 1.0]]).T
    return solve_static(structure.stiffness, np.asarray(tips.T @ load))


def found(structure, count=3, cache=None):
    return buckled_panels(
        structure,
        inventory(structure, {}),
        states(structure),
        {0.1: "both", 0.2: "the second"},
        count,
        cache or Cache(None),
    )


def test_each_place_has_its_lowest_factor(columns):
    table = found(columns).table
    assert table.factor[0] == pytest.approx(EULER * 2e-6 / 1e3, rel=1e-4)
    assert table.id[0] < 20
    assert table.reason[0] == "both"
    second = table[table.id > 20].iloc[0]
    assert second.factor == pytest.approx(EULER * 4e-6 / 1e3, rel=1e-4)
    assert second.y == pytest.approx(1.0)
    assert set(table.component) == {"bars"}
    assert (table.elements > 1).all()


def test_margins_hold_for_the_ultimate_factor(columns):
    table = with_margin(found(columns), 1.5)
    assert table.margin.to_numpy() == pytest.approx(table.factor / 1.5 - 1.0)


def test_the_lowest_mode_is_shown(columns):
    first = found(columns)
    assert first.complete
    assert np.abs(first.shape).max() == pytest.approx(1.0)
    assert first.work.max() == pytest.approx(1.0)
    assert first.work.idxmax() == first.table.id[0]
    # All of the work is done on the first column.
    assert first.work[first.work.index > 20].max() < 1e-9


def test_an_answer_is_found_again(columns, tmp_path):
    cache = Cache(tmp_path)
    first = found(columns, cache=cache)
    again = found(columns, cache=cache)
    assert list(tmp_path.glob("buckling-*"))
    assert again.table.equals(first.table)


def test_the_table_ends_where_modes_of_few_panels_fill_a_case(columns):
    """There are two columns: of six modes of a case none tells of a third panel."""
    asked = found(columns, count=3)
    assert len(asked.table) == 2
    assert asked.known_below > asked.table.factor.max()
    assert np.isfinite(asked.known_below)


@pytest.mark.parametrize("order", [[0, 1], [1, 0]])
def test_the_order_of_the_cases_does_not_matter(columns, order):
    """Above the panels of the cases before nothing is looked for."""
    state, names = states(columns), {0.1: "both", 0.2: "the second"}
    chosen = dict([list(names.items())[k] for k in order])
    elements = inventory(columns, {})
    panels = buckled_panels(columns, elements, state[:, order], chosen, 1, Cache(None))
    assert panels.table.factor[0] == pytest.approx(EULER * 2e-6 / 1e3, rel=1e-4)
    assert panels.table.reason[0] == "both"
    assert panels.complete


def test_tension_buckles_nothing(columns):
    nothing = buckled_panels(
        columns,
        inventory(columns, {}),
        -states(columns)[:, :1],
        {0.1: "pull"},
        3,
        Cache(None),
    )
    assert nothing.table.empty
    assert not nothing.shape.any()
