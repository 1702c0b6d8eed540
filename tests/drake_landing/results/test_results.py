"""Result files read back what was written, and are whole or absent."""

from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import pytest

from drake_landing.csv_tables import write_csv
from drake_landing.landing.history import (
    ATTACHMENT,
    STRUT,
    TIRE,
    LandingHistory,
    gear_peaks,
)
from drake_landing.parts.observers import CaseFound, PartsFound
from drake_landing.places import Places
from drake_landing.results.provenance import Provenance
from drake_landing.results.result_files import write_history_csv, write_results
from fem.files.atomic import write_aside
from systems.airframe.modal_body import ModalBody

TIME = np.linspace(0, 1, 11)


def table(columns: tuple[str, ...], scale: float = 1.0) -> pd.DataFrame:
    values = np.outer(np.sin(np.pi * TIME), scale * np.arange(1, len(columns) + 1))
    return pd.DataFrame(values, columns=columns, index=TIME)


@pytest.fixture
def history() -> LandingHistory:
    return LandingHistory(
        attachment_node={"nose": 7, "main": 3},
        wheels={"nose": ("nose",), "main": ("main_left", "main_right")},
        attachment={"nose": table(ATTACHMENT), "main": table(ATTACHMENT, -2)},
        tire={w: table(TIRE) for w in ("nose", "main_left", "main_right")},
        strut={g: table(STRUT) for g in ("nose", "main")},
        monitoring={"tail": table(("x", "y", "z"))},
        motion=table(("qw", "qx", "qy", "qz", "px", "py", "pz")),
        bodies={"nose_fitting": np.zeros((11, 7))},
        amplitudes=np.zeros((11, 2)),
        energy=table(("airframe", "balance")),
    )


@pytest.fixture
def body() -> ModalBody:
    return ModalBody(
        mass=2.0,
        p_BG=np.zeros(3),
        inertia_G=np.eye(3),
        frequency=np.array([3.0, 5.0]),
        modal_mass=np.ones(2),
        modal_damping=np.zeros((2, 2)),
        node_id=np.array([3, 7]),
        p_BN=np.zeros((2, 3)),
        translation=np.zeros((2, 3, 2)),
        rotation=np.zeros((2, 3, 2)),
    )


def test_loads_are_ordered_by_node_and_added_on_a_shared_node(
    history: LandingHistory,
) -> None:
    loads = history.attachment_loads()
    assert loads.node_id.tolist() == [3, 7]
    assert loads.load[:, 0] == pytest.approx(history.attachment["main"].to_numpy())
    shared = {**history.__dict__, "attachment_node": {"nose": 3, "main": 3}}
    summed = LandingHistory(**shared).attachment_loads()
    assert summed.load[:, 0] == pytest.approx(loads.load.sum(axis=1))


def test_gear_peaks_sum_the_wheels_and_keep_the_sign(history: LandingHistory) -> None:
    peaks = gear_peaks("r", history).set_index(["gear", "quantity"])
    assert list(gear_peaks("r", history).columns) == [
        *("run", "gear", "quantity", "peak", "time")
    ]
    assert peaks.loc[("main", "tyre_vertical"), "peak"] == pytest.approx(4.0)
    assert peaks.loc[("nose", "tyre_vertical"), "peak"] == pytest.approx(2.0)
    assert peaks.loc[("main", "attachment_fz"), "peak"] == pytest.approx(-6.0)
    assert peaks.loc[("main", "attachment_fz"), "time"] == pytest.approx(0.5)


def parts() -> PartsFound:
    """Of an airframe that is looked at nowhere."""
    case = CaseFound(
        sections={},
        acceleration={7: np.ones((2, 3))},
        stress=pd.DataFrame(
            {"id": [1], **{key: [1.0] for key in ("equivalent", "time", "largest")}}
        ).assign(smallest=-1.0, axial_only=False),
    )
    return PartsFound(
        time=np.arange(2.0),
        cuts={},
        places=Places(equipment={}),
        cases=(case,),
        worst={},
        imbalance=(0.0, 0.0),
    )


def test_results_file_reads_back(
    tmp_path: Path, history: LandingHistory, body: ModalBody
) -> None:
    path = tmp_path / "results.h5"
    comparison = pd.DataFrame({"point": ["tail"], "rms_error": [np.nan], "modes": [2]})
    write_results(
        path,
        case="name: x\n",
        body=body,
        R_AB=np.eye(3),
        history=history,
        loads=history.attachment_loads(),
        response={"tail": table(("x", "y", "z"))},
        envelopes=(),
        comparison=comparison,
        gears=gear_peaks("r", history),
        parts=parts(),
        provenance=Provenance(
            facts={"load case": "x"}, files=(), gears="[]", gears_sha256="0"
        ),
        seconds=1.0,
    )
    with h5py.File(path) as file:
        assert file.attrs["case"] == "name: x\n"
        assert "drake" in file["versions"].attrs
        assert file["parts/acceleration/7"].shape == (2, 3)
        assert file["parts/stress/smallest"][:].tolist() == [-1.0]
        stroke = file["multibody/strut/main/value"]
        assert stroke.attrs["units"].tolist() == ["m", "m/s", "N"]
        assert set(file["multibody/energy/value"].attrs["units"]) == {"J"}
        assert stroke[:] == pytest.approx(history.strut["main"].to_numpy())
        assert file["attachment_loads/load"].shape == (11, 2, 6)
        assert file["comparison/point"].asstr()[:].tolist() == ["tail"]
        assert np.isnan(file["comparison/rms_error"][0])
        assert file["fe/monitoring/tail/time"][-1] == 1.0
    assert [p.name for p in tmp_path.iterdir()] == ["results.h5"]


def test_interrupted_writing_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_text("old")

    def broken(to: Path) -> None:
        to.write_text("half")
        raise OSError("disk full")

    with pytest.raises(OSError, match="disk full"):
        write_aside(path, broken)
    assert path.read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.txt"]


def test_csv_tables_read_back(tmp_path: Path, history: LandingHistory) -> None:
    write_history_csv(tmp_path / "tires.csv", history.tire)
    read = pd.read_csv(tmp_path / "tires.csv", index_col="time [s]")
    assert read["main_left_vertical [N]"].to_numpy() == pytest.approx(
        history.tire["main_left"]["vertical"].to_numpy()
    )
    write_csv(tmp_path / "t.csv", pd.DataFrame({"a": [np.nan, 1 / 3, -0.0]}))
    assert (tmp_path / "t.csv").read_text() == 'a\n""\n0.333333333\n0\n'
