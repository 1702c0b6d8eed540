"""Results of a landing in its file, by names as users give them."""

from types import SimpleNamespace

import h5py
import numpy as np
import pandas as pd

from drake_landing.campaign import task
from drake_landing.campaign.tables import _peaks
from fem.files.escaping import group_name


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


def test_parts_whose_names_are_paths_keep_their_section_loads(tmp_path, monkeypatch):
    monkeypatch.setattr(
        task, "_write_extremes", lambda own, *_: own.create_group("min")
    )
    beams = ["a/../b", "..", ".", "right wing"]
    cuts = SimpleNamespace(named=lambda z: z, beam=SimpleNamespace(stations=[1.0]))
    basis = SimpleNamespace(section_loads=lambda beam, z: z)
    setup = SimpleNamespace(cuts=dict.fromkeys(beams, cuts), basis=basis)
    with h5py.File(tmp_path / "case.h5", "w") as file:
        task._write_sections(file, setup, np.zeros(1), None)
        assert [g.attrs["name"] for g in file["sections"].values()] == sorted(
            beams, key=group_name
        )
        assert all("min" in group for group in file["sections"].values())
