"""Largest values of a landing in its file, by names as users give them."""

from types import SimpleNamespace

import h5py
import pandas as pd

from drake_landing.campaign import task
from drake_landing.campaign.tables import _peaks


def test_peaks_keep_names_of_any_script_and_length(tmp_path, monkeypatch):
    gears = pd.DataFrame({"gear": ["nose"], "quantity": ["fz"], "peak": [1.0]})
    monkeypatch.setattr(task, "gear_peaks", lambda *_: gears.assign(time=0.1))
    name = "Flügelspitze 機 " + "x" * 60
    history = SimpleNamespace(monitoring={name: pd.DataFrame({"z": [1.0, -2.0]})})
    path = tmp_path / "case.h5"
    with h5py.File(path, "w") as file:
        task._write_peaks(file, SimpleNamespace(name="a"), history)
    assert _peaks(path) == {"gear:nose.fz": 1.0, f"point:{name}.z": 2.0}
    with h5py.File(path, "w") as file:
        task._write_peaks(
            file, SimpleNamespace(name="a"), SimpleNamespace(monitoring={})
        )
    assert _peaks(path) == {"gear:nose.fz": 1.0}
