"""The whole process on the tiny aircraft, and what both models must agree on."""

import pickle
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import pytest

from drake_landing.airframe.body import AirframeModel, load_airframe, mass_properties
from drake_landing.case.airframe import Airframe
from drake_landing.case.reading import load_case, parse_case
from drake_landing.case.schema import Case
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.run import run_case
from drake_landing.progress import Silent
from drake_landing.results.comparison import COLUMNS
from drake_landing.results.result import ProcessResult
from drake_landing.results.summary import key_figures

HERE = Path(__file__).parents[1]
TEXT = HERE.joinpath("tiny_case.yaml").read_text()


def variant(*changes: tuple[str, str]) -> Case:
    text = TEXT
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return parse_case(text, folder=HERE)


class Stages(Silent):
    def __init__(self) -> None:
        self.texts: list[str] = []
        self.shares: list[float] = []

    def stage(self, text: str) -> None:
        self.texts.append(text)

    def share(self, done: float, text: str = "") -> None:
        self.shares.append(done)


@pytest.fixture(scope="module")
def stages() -> Stages:
    return Stages()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("run")


@pytest.fixture(scope="module")
def result(folder: Path, stages: Stages) -> ProcessResult:
    """Sixty of 114 elastic modes."""
    case = variant(
        ("select: count 6", "select: count 60"),
        ("duration: 0.4", "duration: 0.2, accuracy: 1.0e-4"),
        ("step: 5.0e-4", "step: 1.0e-4"),
    )
    return run_case(case, folder, stages)


def airframe(basis: str = "full-modes", select: str = "count 12") -> AirframeModel:
    case = variant(("select: count 6", f"select: {select}\n  basis: {basis}"))
    return load_airframe(case.airframe, prepare_aircraft(case, Path("unused")))


def test_multibody_and_transient_are_one_model(result: ProcessResult) -> None:
    # With all 114 modes 0.03 %; sixty leave the response above 200 Hz out, of which
    # the stiff fore and aft motion has more.
    table = result.comparison
    table = table[table["peak_fe"] > 0.05 * table["peak_fe"].max()]
    assert len(table) == 10
    assert table["rms_error"].max() < 1e-2
    assert table[table["axis"] == "z"]["rms_error"].max() < 1.5e-3


def test_tables_have_the_agreed_columns(result: ProcessResult, folder: Path) -> None:
    table = pd.read_csv(folder / "comparison.csv")
    assert list(table.columns) == COLUMNS
    assert len(table) == 15
    assert set(table["run"]) == {"tiny"}
    assert set(table["modes"]) == {60}
    gears = pd.read_csv(folder / "gears.csv")
    assert list(gears.columns) == [
        *("run", "gear", "quantity", "peak", "time", "unit", "last_swing"),
    ]
    assert set(gears["quantity"]) == {
        *("tyre_vertical", "tyre_drag", "stroke"),
        *(f"attachment_{c}" for c in ("fx", "fy", "fz", "mx", "my", "mz")),
    }


def test_files_are_complete(result: ProcessResult, folder: Path) -> None:
    assert {path.name for path in folder.iterdir()} == {
        *("results.h5", "report.html", "landing.html", "landing_sol109.bdf"),
        *("comparison.csv", "gears.csv", "attachment_loads.csv", "tyres.csv"),
        *("worst_elements.csv", "worst_stresses.csv", "section_loads.csv"),
        *("section_roots.csv", "accelerations_equipment.csv", "stages.csv"),
        *("late_extremes.csv", "README.txt", "histories.html"),
        *("monitor_points.csv", "monitor_histories.csv", "pictures"),
        *("struts.csv", "accelerations_multibody.csv", "accelerations_transient.csv"),
    }
    with h5py.File(folder / "results.h5") as file:
        assert file["fe/monitoring/tail/value"].shape == (2001, 3)
        assert file["attachment_loads/load"].shape == (2001, 3, 6)
        again = parse_case(file.attrs["case"])
        assert again.scenario == result.case.scenario


def test_readme_names_each_file(result: ProcessResult, folder: Path) -> None:
    text = (folder / "README.txt").read_text()
    named = [line.split("  ")[0] for line in text.split("\n\n")[1].splitlines()]
    assert set(named) == {path.name for path in folder.iterdir()}


def test_every_dataset_and_column_has_its_unit(
    result: ProcessResult, folder: Path
) -> None:
    missing = []

    def look(name: str, item: h5py.Group | h5py.Dataset) -> None:
        if not isinstance(item, h5py.Dataset):
            return
        if "unit" not in item.attrs:
            units = item.attrs.get("units", ())
            if len(units) != item.shape[-1] or not all(units):
                missing.append(name)

    with h5py.File(folder / "results.h5") as file:
        file.visititems(look)
    assert not missing
    for table in folder.glob("*.csv"):
        frame = pd.read_csv(table)
        if table.name in ("comparison.csv", "gears.csv"):  # agreed names
            continue
        for column in frame.select_dtypes("floating"):
            plain = column in _PLAIN or column.endswith("_slip")
            by_row = column in _BY_ROW and frame.unit.notna().all()
            assert column.endswith("]") or plain or by_row, (table.name, column)


_PLAIN = ("margin", "share")
_BY_ROW = ("value", "min", "max")


def test_report_is_self_contained(result: ProcessResult, folder: Path) -> None:
    page = (folder / "report.html").read_text()
    assert "<script" not in page
    assert all(part.startswith("data:") for part in page.split('src="')[1:])
    # Wing, tailplane, fin, forward and rear part: of two sides one; two pictures each,
    # and two more where loads act fore and aft, which are all that the fin carries.
    along = page.count('aria-label="section loads along the')
    aft = page.count("fore-and-aft shear along")
    assert aft >= 2
    assert along >= 5
    parts = 1 + 2 * along + len(result.response)
    assert page.count("<svg") == 6 + len(result.response) + parts
    for figure, value in key_figures(result):
        assert figure in page
        assert value.split(" (")[0] in page
    ids = [part.split('"')[0] for part in page.split(' id="')[1:]]
    assert len(ids) == len(set(ids))


def test_replay_holds_a_recording(folder: Path, result: ProcessResult) -> None:
    page = (folder / "landing.html").read_text()
    assert "deformation times" in page
    assert "times slower than real" in page
    assert "localhost" not in page.split("<script")[0]


def test_progress_tells_every_stage(stages: Stages, result: ProcessResult) -> None:
    told = [text.split(" (")[0] for text in stages.texts]
    # Parts of the transient are booked apart.
    booked = {name for name in result.seconds if name not in told}
    assert set(told) | booked == set(result.seconds)
    assert booked == {
        *("transient: factorisation", "transient: stresses, section loads"),
        "transient: extremes of all results",
    }
    table = result.stages.table()
    assert table["share"].iloc[:-1].sum() == pytest.approx(1.0)
    assert table["memory_gb"].is_monotonic_increasing
    assert max(stages.shares) == pytest.approx(1)


@pytest.mark.usefixtures("blank_curves")
def test_practices_and_a_page_without_pictures(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = variant(("duration: 0.4", "duration: 0.1"), ("step: 5.0e-4", "step: 1.0e-3"))
    monkeypatch.setenv("DRAKE_LANDING_CACHE", str(tmp_path / "cache"))
    done = run_case(case, tmp_path, practices=True)
    again = run_case(case, tmp_path, practices=True)
    assert done.practices is not None
    assert again.practices is not None
    # The second run has found the transient.
    assert "transient: factorisation" in done.seconds
    assert "transient: factorisation" not in again.seconds
    pd.testing.assert_frame_equal(again.practices.table, done.practices.table)
    pd.testing.assert_frame_equal(again.parts.judged, done.parts.judged)
    for one, other in zip(done.envelopes, again.envelopes):
        np.testing.assert_array_equal(one.largest, other.largest)
    table = pd.read_csv(tmp_path / "practices.csv")
    assert set(table.kind) == {"acceleration", "section load", "stress"}
    assert table.groupby(["kind", "quantity"]).practice.nunique().eq(3).all()
    page = (tmp_path / "report.html").read_text()
    assert "Three practices" in page
    assert "cannot draw off-screen" in page
    assert "<img" not in page


def test_five_key_figures(result: ProcessResult) -> None:
    figures = dict(key_figures(result))
    assert len(figures) == 5
    assert "kN (main" in figures["largest vertical tire load of a gear"]


def test_mass_properties_are_those_of_the_weight_table() -> None:
    model = airframe()
    mass, p_BG, inertia = mass_properties(model.structure)
    weight = model.structure.weight
    assert mass == pytest.approx(weight.total)
    assert p_BG == pytest.approx(weight.center, abs=1e-9)
    assert inertia == pytest.approx(weight.inertia, rel=1e-9, abs=1e-6)


def test_elastic_modes_carry_no_momentum() -> None:
    model = airframe()
    structure = model.structure
    coupling = structure.rigid_body.T @ (structure.mass @ model.basis.shape)
    size = np.sqrt(model.body.mass)  # of a mass-normalised rigid motion
    assert np.abs(coupling[:3]).max() < 1e-9 * size
    assert model.body.modal_mass == pytest.approx(1)


def test_damping_is_that_of_the_transient() -> None:
    body = airframe().body
    # PARAM,G over W3 times the stiffness
    expected = np.diag(0.03 / 50 * (2 * np.pi * body.frequency) ** 2)
    assert body.modal_damping == pytest.approx(expected, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("basis", ["guyan", "craig-bampton"])
def test_reduced_bases_meet_the_lowest_modes_from_above(basis: str) -> None:
    full, reduced = airframe().body, airframe(basis).body
    ratio = reduced.frequency[:6] / full.frequency[:6]
    limit = {"guyan": 0.25, "craig-bampton": 1e-3}[basis]
    assert np.all(ratio > 1 - 1e-9)
    assert np.all(ratio < 1 + limit)


def test_selection_below_a_frequency() -> None:
    body = airframe(select="below 20 Hz").body
    assert body.n > 3
    assert body.frequency[-1] < 20
    assert airframe(select=f"count {body.n + 1}").body.frequency[-1] > 20
    assert airframe(select="count 0").body.n == 0


def test_all_modes_of_a_basis() -> None:
    model = airframe("guyan", "all")
    assert model.body.n == model.basis.freedoms - 6


def test_too_many_modes_are_said() -> None:
    model = airframe("guyan", "count 5000")
    assert "asks for 5000 elastic modes" in model.notices[-1]


def test_airframe_in_other_axes_is_the_same_body() -> None:
    """The tiny deck as it stands, read as flying toward +y with x up."""
    case = variant()
    turned = Airframe.model_validate(
        {**case.airframe.model_dump(), "axes": {"forward": "y", "up": "x"}}
    )
    aircraft = prepare_aircraft(case, Path("unused"))
    plain = load_airframe(case.airframe, aircraft)
    other = load_airframe(turned, aircraft)
    R = other.R_AB
    assert (R @ [[0, 1], [-1, 0], [0, 0]]).T.tolist() == [[1, 0, 0], [0, 0, 1]]
    assert other.body.p_BN == pytest.approx(plain.body.p_BN @ R.T)
    assert other.body.inertia_G == pytest.approx(R @ plain.body.inertia_G @ R.T)
    assert np.abs(other.body.rotation) == pytest.approx(
        np.abs(np.einsum("ab,kbn->kan", R, plain.body.rotation)), rel=1e-6, abs=1e-9
    )


def test_case_of_the_demo_is_valid() -> None:
    import drake_landing

    case = load_case(Path(drake_landing.__file__).with_name("demo.yaml"))
    assert case.airframe.model == "con"
    assert str(case.airframe.select) == "count 1"


def test_written_deck_gives_the_same_accelerations(
    result: ProcessResult, folder: Path, tmp_path: Path
) -> None:
    """Its loads and answers are in the displacement frames of the grids."""
    done = subprocess.run(
        [sys.executable, "-m", "fem", folder / "landing_sol109.bdf", "--out", tmp_path],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    points = result.airframe.structure.points
    with h5py.File(tmp_path / "landing_sol109.h5") as file:
        at = file["transient/1"]
        assert at["time"][:] == pytest.approx(result.loads.time, abs=1e-9)
        grids = at["acceleration_grid_id"][:].tolist()
        for point, table in result.response.items():
            grid = result.aircraft.monitoring[point]
            R_BD = points.rotation[points.rows(grid)]
            found = at["acceleration"][:, grids.index(grid), :3] @ R_BD.T
            largest = np.abs(table.to_numpy()).max()
            assert np.abs(found - table.to_numpy()).max() < 1e-6 * largest


def test_extremes_of_all_elements_are_kept(result: ProcessResult, folder: Path) -> None:
    """The envelope of an element bounds what its worst row says."""
    worst = pd.read_csv(folder / "worst_elements.csv")
    assert list(worst.columns) == [
        *("result", "type", "column", "element", "value", "time [s]", "unit"),
        "last_swing",
    ]
    row = worst[(worst["result"] == "force") & (worst["column"] == "axial")].iloc[0]
    with h5py.File(folder / "results.h5") as file:
        group = file[f"envelope/element_force/{row['type']}"]
        column = list(group.attrs["columns"]).index("axial")
        at = list(group["id"]).index(row["element"])
        largest = max(abs(group["min"][:, column].min()), group["max"][:, column].max())
        extremes = group["min"][at, column], group["max"][at, column]
    assert max(map(abs, extremes)) == largest
    assert abs(row["value"]) == pytest.approx(largest, rel=1e-8)


def test_aircraft_can_be_sent_to_another_process(tmp_path: Path) -> None:
    """Studies fly their landings in processes of their own."""
    aircraft = prepare_aircraft(variant(), tmp_path)
    sent = pickle.loads(pickle.dumps(aircraft))
    grids = sent.read(sent.deck).cards["GRID"]
    assert grids.equals(aircraft.read(aircraft.deck).cards["GRID"])


def test_monitor_points_of_the_deck_are_stations(
    result: ProcessResult, folder: Path
) -> None:
    """Their MONPNT1 is the section load of the grids that it sums, in every file."""
    found = result.parts
    values = found.landing.monitors
    outside = np.isin(result.airframe.structure.points.grid_id, [23, 24])
    beam, cut = next(
        (name, k)
        for name, cuts in found.cuts.items()
        for k in range(len(cuts.point))
        if np.array_equal(cuts.strip >= k, outside)
    )
    section = found.landing.sections[beam][:, cut]
    size = np.abs(section).max()
    assert values["WING4"][:, :3] == pytest.approx(section[:, :3], abs=1e-9 * size)
    arm = found.cuts[beam].point[cut] - [8.0, 4.0, 0.0]
    moment = section[:, 3:] + np.cross(arm, section[:, :3])
    assert values["WING4"][:, 3:] == pytest.approx(moment, abs=1e-9 * size)
    # What the bar carries, but for what its damping does.
    rest = np.abs(values["BAR111"] - values["WING4"])[:, [2, 3]]
    assert rest.max() < 0.1 * np.abs(values["WING4"][:, [2, 3]]).max()
    table = pd.read_csv(folder / "monitor_points.csv")
    assert table.name.unique().tolist() == ["WING4", "BAR111"]
    assert table.label[0] == "WING, STARBOARD, OUTBOARD OF THE SECOND BAY"
    third = table[(table.name == "WING4") & (table.quantity == "F3")].iloc[0]
    assert third["max"] == pytest.approx(values["WING4"][:, 2].max())
    assert third["unit"] == "N"
    with h5py.File(folder / "results.h5") as file:
        group = file["parts/monitor_points/WING4"]
        assert np.array_equal(group["value"], values["WING4"])
        assert group.attrs["card"] == "MONPNT1"
    assert "Monitor points of the deck" in (folder / "report.html").read_text()
    assert "monitor_points.csv" in (folder / "README.txt").read_text()
