"""The benchmark at aircraft scale: size, parts on a small model, verdicts."""

import numpy as np
import pytest

from benchmarks.__main__ import page, ratios
from benchmarks.machine import read_bandwidth
from benchmarks.other_solvers import calculix_input
from benchmarks.stiffened_aircraft import Size, mesh_of
from benchmarks.transient_scale import (
    PARTS,
    part_envelope,
    part_guyan,
    part_modes,
    part_step,
    table,
    verdict,
)

TINY = Size(around=16, along=12, wing=(4, 8), tail=(4, 4))


def test_model_has_the_size_of_an_aircraft():
    mesh = mesh_of(Size())
    assert mesh.count >= 34_000
    quads = np.concatenate(mesh.quads)
    assert len(quads) > 30_000
    # One piece: every grid is used, and no quadrilateral is degenerate.
    assert np.array_equal(np.unique(quads), np.arange(mesh.count))
    a, b, c, d = (mesh.xyz[quads[:, k]] for k in range(4))
    assert (np.linalg.norm(np.cross(c - a, d - b), axis=1) > 1e-4).all()


def test_steps_are_measured_against_the_bound():
    found = part_step(TINY, steps=6)
    assert found["ms per step (processor)"] > 0.0
    ratio = found["ms per step (processor)"] / found["bound, ms (processor)"]
    assert found["step over bound (processor)"] == pytest.approx(ratio)


def test_all_elements_are_in_the_envelope():
    mesh = mesh_of(TINY)
    elements = sum(map(len, mesh.quads)) + sum(len(pairs) for pairs, _ in mesh.bars)
    assert part_envelope(TINY, steps=4)["elements"] == elements


def test_free_model_has_six_rigid_modes_and_none_is_missed():
    found = part_modes(TINY, count=20)
    assert found["rigid-body modes"] == 6
    assert found["counted less found (Sturm)"] == 0
    assert found["largest residual"] < 1e-5


def test_reduction_keeps_what_was_chosen():
    assert part_guyan(TINY, grids=10)["columns"] == 60


def test_targets_that_are_missed_are_said():
    assert "MISSED" in verdict("step", "step over bound (processor)", 1.7)
    assert verdict("step", "step over bound (processor)", 1.5) == "at most 1.6"
    assert "MISSED" in verdict("block", "one case over one of 32", 3.9)
    assert verdict("block", "factorisation, s", 1.0) == ""
    assert "step" in PARTS


def test_page_compares_with_other_solvers():
    kept = {
        "step": {"ms per step (processor)": 100.0},
        "opensees": {"s per step (processor)": 2.0},
    }
    assert [round(value, 6) for _, value, _ in ratios(kept)] == [20.0]
    assert "20" in page(kept)
    assert "| step | ms per step (processor) | 100 |" in table(kept)
    assert "MISSED" not in page(kept)


def test_page_says_why_a_ratio_is_missed():
    kept = {
        "step": {"ms per step (processor)": 80.0, "bound, ms (processor)": 55.0},
        "opensees": {"s per step (processor)": 0.8},
    }
    text = page(kept)
    assert "| 10 | at least 15: MISSED |" in text
    assert "80 ms, of which 55 ms are the two reads" in text
    assert "would be 53 ms" in text


def test_input_of_calculix_has_all_shells():
    mesh = mesh_of(TINY)
    lines = calculix_input(mesh, 2).splitlines()
    first, last = lines.index("*ELEMENT,TYPE=S4,ELSET=SKIN"), "*MATERIAL,NAME=ALU"
    assert lines.index(last) - first - 1 == sum(map(len, mesh.quads))


def test_bandwidth_is_that_of_a_computer():
    found = read_bandwidth(1, rounds=2, megabytes=16)
    assert 1e8 < found.wall < 1e13
    assert 1e8 < found.process < 1e13
