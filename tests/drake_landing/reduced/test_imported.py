"""A user's own matrices: out of the solver, back in, and the same landing."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from drake_landing.airframe.body import AirframeModel, load_airframe
from drake_landing.case.axes import rotation_AB
from drake_landing.case.reading import parse_case
from drake_landing.case.schema import Case
from drake_landing.cli import app, guarded
from drake_landing.landing.handover import smooth_curve
from drake_landing.landing.history import LandingHistory
from drake_landing.landing.run import build_landing, fly
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.explain import explain
from drake_landing.process.run import run_case
from drake_landing.reduced.imported import read_reduced
from drake_landing.reduced.make import reduce_structure
from drake_landing.reduced.report import grid_table
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.files.matrices import write_op4
from fem.model.structure import Structure

TINY = Path(__file__).parents[1]
CASE = TINY.joinpath("tiny_case.yaml").read_text()
KEPT = (1, 3, 5, 7, 9, 22, 24, 32, 34, 51, 52, 53)
NAMES = {
    "stiffness": "KRED",
    "mass": "MRED",
    "damping": "BRED",
    "recovery": "RRED",
}


@pytest.fixture(scope="module")
def reduced(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The tiny aircraft reduced to some grids, in all formats."""
    out = tmp_path_factory.mktemp("reduced")
    grids = ",".join(map(str, KEPT))
    line = ["reduce", str(TINY / "tiny_aircraft.bdf"), "--interface", grids]
    assert guarded(app, [*line, "--out", str(out)]) == 0
    return out


def case_of(airframe: str) -> Case:
    text = CASE.replace("deck: tiny_aircraft.bdf", airframe)
    return parse_case(text.replace("duration: 0.4", "duration: 0.15"), folder=TINY)


def landing(case: Case, folder: Path) -> tuple[AirframeModel, LandingHistory]:
    aircraft = prepare_aircraft(case, folder)
    airframe = load_airframe(case.airframe, aircraft)
    points, R_AB = aircraft.monitoring, rotation_AB(case.airframe.axes)
    built = build_landing(
        airframe.body, aircraft.gears, points, R_AB, aircraft.scenario
    )
    return airframe, fly(built, aircraft.scenario, case.simulation, points, R_AB)


@pytest.fixture(scope="module")
def direct(
    tmp_path_factory: pytest.TempPathFactory,
) -> tuple[AirframeModel, LandingHistory]:
    """The same reduction by the case itself."""
    kept = f"deck: tiny_aircraft.bdf\n  basis: guyan\n  interface: {list(KEPT)}"
    return landing(case_of(kept), tmp_path_factory.mktemp("direct"))


def matrices(folder: Path, file: str) -> str:
    files = f"files: [{folder / file}], grids: {folder / 'grids.csv'}"
    return f"matrices: {{{files}}}"


@pytest.mark.parametrize(
    ("file", "tolerance"),
    [("reduced.op4", 1e-9), ("reduced.h5", 1e-9), ("reduced.pch", 1e-4)],
)
def test_the_landing_is_the_same(
    reduced: Path, direct, tmp_path: Path, file: str, tolerance: float
) -> None:
    airframe, history = landing(case_of(matrices(reduced, file)), tmp_path)
    expected_airframe, expected_history = direct
    np.testing.assert_allclose(
        airframe.body.frequency, expected_airframe.body.frequency, rtol=tolerance
    )
    time = np.linspace(0.0, 0.15, 301)
    for found, expected in (
        (history.attachment, expected_history.attachment),
        (history.monitoring, expected_history.monitoring),
    ):
        for name, table in expected.items():
            curve = smooth_curve(expected_history.time, table.to_numpy())(time)
            other = smooth_curve(history.time, found[name].to_numpy())(time)
            difference = np.abs(other - curve).max()
            assert difference < tolerance * np.abs(curve).max()


@pytest.mark.parametrize("file", ["reduced.op4", "reduced.h5", "reduced.pch"])
def test_check_accepts_more_fixed_interface_modes_than_interface(
    tmp_path: Path, file: str
) -> None:
    """Generalised coordinates take no part in rigid motions."""
    line = ["reduce", str(TINY / "tiny_aircraft.bdf"), "--interface", "51,52,53"]
    line += ["--basis", "craig-bampton", "--out", str(tmp_path)]
    assert guarded(app, line) == 0
    case = case_of(matrices(tmp_path, file))
    points = {"nose": 51, "tail": 52}
    airframe = case.airframe.model_copy(update={"monitoring": points})
    told = explain(case.model_copy(update={"airframe": airframe}), tmp_path)
    assert "6 rigid-body motions, no mechanism" in told


@pytest.mark.usefixtures("blank_curves")
def test_the_whole_process_runs_on_matrices(reduced: Path, tmp_path: Path) -> None:
    result = run_case(case_of(matrices(reduced, "reduced.h5")), tmp_path)
    # The direct transient runs on the matrices, whose modes the landing selects from.
    assert result.comparison.correlation.max() > 0.95
    assert (tmp_path / "report.html").is_file()


def test_rows_in_any_order_of_the_table(tmp_path: Path) -> None:
    """OUTPUT4 has no names: the table says what its rows are."""
    deck = read_deck(TINY / "tiny_aircraft.bdf")
    model = reduce_structure(
        Structure.from_deck(deck), KEPT[:-3], "craig-bampton"
    ).model
    order = np.random.default_rng(1).permutation(len(model.grid_id))
    table = grid_table(model).iloc[order]
    starts = np.concatenate([[0], np.cumsum(model.kept.sum(axis=1))])
    rows = np.concatenate(
        [np.arange(starts[k], starts[k + 1]) for k in order]
        + [np.arange(starts[-1], model.size)]
    )
    table.to_csv(tmp_path / "grids.csv", index=False)
    shuffled = [
        type(m)(name=m.name, values=m.values[np.ix_(rows, rows)])
        for m in model.matrices()[:3]
    ]
    write_op4(tmp_path / "m.op4", shuffled, binary=True)
    found = read_reduced([tmp_path / "m.op4"], tmp_path / "grids.csv", NAMES)
    np.testing.assert_array_equal(found.grid_id, model.grid_id)
    np.testing.assert_array_equal(found.mass, model.mass)
    scale = np.abs(model.stiffness).max()
    assert np.abs(found.stiffness - model.stiffness).max() < 1e-12 * scale


def test_grids_that_follow_come_back(tmp_path: Path) -> None:
    """The conceptual aircraft's gears hang on rigid elements."""
    from drake_landing.reference.d150 import write_model

    write_model("con", tmp_path / "con.bdf")
    out = tmp_path / "out"
    grids = "10001,10018,10040,10060,10087,11004,11010,11030,12004,12010,12030"
    gears = "17001 THRU 17003, 19001 THRU 19003"
    line = ["reduce", str(tmp_path / "con.bdf"), "--compare", "3", "--out", str(out)]
    assert guarded(app, [*line, "--interface", f"{grids}, {gears}"]) == 0
    case = parse_case(
        "name: x\nairframe:\n  model: con\n  select: count 4\n"
        "scenario: {sink_rate: 1, forward_speed: 50}\n"
    )
    aircraft = prepare_aircraft(case, tmp_path / "a")
    gear_list = [g.model_dump(mode="json") for g in aircraft.gears]
    import yaml

    text = yaml.safe_dump(
        {
            "name": "y",
            "airframe": {
                "matrices": {
                    "files": [str(out / "reduced.pch")],
                    "grids": str(out / "grids.csv"),
                },
                "select": "count 4",
                "monitoring": {"nose": 19001, "cg": 19002},
            },
            "gears": gear_list,
            "scenario": {"sink_rate": 1, "forward_speed": 50},
        }
    )
    other = parse_case(text)
    (tmp_path / "b").mkdir()
    found = load_airframe(other.airframe, prepare_aircraft(other, tmp_path / "b"))
    full = load_airframe(case.airframe, aircraft)
    np.testing.assert_allclose(
        found.body.frequency, full.body.frequency, rtol=4e-2
    )  # few grids
    assert found.body.mass == pytest.approx(full.body.mass, rel=1e-8)
    np.testing.assert_allclose(found.body.p_BG, full.body.p_BG, atol=1e-6)
    assert any("digits of the file" in notice for notice in found.notices)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda t: t.drop(columns="x"), "expected id, x, y, z"),
        (lambda t: t.iloc[1:], "that the interface table lacks"),
        (lambda t: pd.concat([t, t.iloc[:1]]), "there twice"),
        (lambda t: t.assign(x=t.x + 0.01 * t.id), "positions are not theirs"),
        (lambda t: t.assign(components="1237"), "expected digits 1-6"),
        (lambda t: t.assign(y="left"), "found 'left'"),
    ],
)
def test_bad_tables(reduced: Path, tmp_path: Path, change, words: str) -> None:
    table = pd.read_csv(reduced / "grids.csv", dtype={"components": str})
    change(table).to_csv(tmp_path / "grids.csv", index=False)
    with pytest.raises(InputError, match=words):
        read_reduced([reduced / "reduced.pch"], tmp_path / "grids.csv", NAMES)


def test_wrong_names_and_files(reduced: Path, tmp_path: Path) -> None:
    grids = reduced / "grids.csv"
    with pytest.raises(InputError, match=r"no mass matrix 'MRD'.*did you mean 'MRED'"):
        read_reduced([reduced / "reduced.op4"], grids, {**NAMES, "mass": "MRD"})
    with pytest.raises(InputError, match="no such file"):
        read_reduced([tmp_path / "gone.op4"], grids, NAMES)
    with pytest.raises(InputError, match="give one of `model`"):
        parse_case(CASE.replace("deck:", "model: con\n  deck:"))
