"""Malformed decks, run: a clear message or a right answer, in time.

Two hundred mutations of a deck with statics, modes and a transient go through the
command line. What ends well has finite results, and its loads, inertia not being asked
for in statics, are carried by its supports.
"""

import random
from pathlib import Path

import h5py
import numpy as np
import pytest
from mixed_structure import every_solution
from mutations import mutate

import fem
from fem.cli import _status
from fem.model.points import read_points


def unbalance(path: Path, results: Path) -> float:
    """Resultant of loads and reactions of the first static subcase over the largest."""
    points = read_points(fem.read_deck(path))
    with h5py.File(results) as file:
        values = []
        file.visititems(
            lambda _, item: (
                values.append(item[()]) if isinstance(item, h5py.Dataset) else None
            )
        )
        for value in values:
            assert value.dtype.kind != "f" or np.isfinite(value).all()
        statics = file.get("static")
        if not statics:
            return 0.0
        found = next(iter(statics.values()))
        if "applied_load" not in found or "spc_force" not in found:
            return 0.0
        force = found["applied_load"][:, :3] + found["spc_force"][:, :3]
        largest = np.abs(found["spc_force"][:, :3]).max()
    resultant = np.einsum("gij,gj->i", points.rotation, force)
    return float(np.abs(resultant).max() / max(largest, 1e-30))


def test_the_deck_is_good(tmp_path, capsys):
    path = tmp_path / "model.bdf"
    path.write_text(every_solution())
    assert _status([str(path), "--out", str(tmp_path)]) == 0
    assert "direct transient" in capsys.readouterr().out
    assert unbalance(path, tmp_path / "model.h5") < 1e-8


@pytest.mark.timeout(30)
@pytest.mark.parametrize(
    "seed",
    [pytest.param(k, marks=[pytest.mark.slow] * (k >= 40)) for k in range(200)],
)
def test_a_malformed_deck_ends_in_a_message_or_a_right_answer(seed, tmp_path, capsys):
    path = tmp_path / "model.bdf"
    path.write_text(mutate(every_solution(), random.Random(seed)), encoding="utf-8")
    status = _status([str(path), "--out", str(tmp_path)])
    error = capsys.readouterr().err
    assert "Traceback" not in error
    if status == 0:
        assert unbalance(path, tmp_path / "model.h5") < 1e-6
    else:
        assert status == 2
        assert error.startswith("error: ")
        assert len(error) > 20
        assert [p.name for p in tmp_path.iterdir()] == ["model.bdf"]
