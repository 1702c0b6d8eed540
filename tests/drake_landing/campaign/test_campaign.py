"""A campaign of a beam aircraft: screening, confirmation, resume, failures, decks."""

import errno
import shutil
import threading
import time as clock
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import psutil
import pytest

import drake_landing
from drake_landing.campaign import command, setup
from drake_landing.campaign.cases import load_campaign
from drake_landing.campaign.confirm import confirmed_file
from drake_landing.campaign.critical_decks import write_critical_decks
from drake_landing.campaign.engine import Pool
from drake_landing.campaign.page import write_page
from drake_landing.campaign.run import (
    CampaignResult,
    expand,
    failure_message,
    run_campaign,
)
from drake_landing.campaign.task import case_file
from drake_landing.cli import app
from drake_landing.progress import Silent
from drake_landing.report.pdf import browser
from fem import read_deck, run_deck
from fem.errors import InputError
from fem.files.atomic_hdf5 import written_hdf5

HERE = Path(__file__).parents[1]
CAMPAIGN = """\
name: tiny_campaign
base: case.yaml
axes:
  scenario.sink_rate: [0.6, 1.2]
  scenario.pitch: {distribution: norm, values: {loc: 1, scale: 1}, low: 0, high: 3}
samples: 2
confirm: {sample: 2, most: 1}
"""
_ALL = "select: all"


def _write(folder: Path, text: str = CAMPAIGN) -> Path:
    shutil.copy(HERE / "tiny_aircraft.bdf", folder)
    case = (HERE / "tiny_case.yaml").read_text().replace("select: count 6", _ALL)
    case = case.replace("duration: 0.4", "duration: 0.12, slow_modes_above: 150")
    (folder / "case.yaml").write_text(case)
    path = folder / "campaign.yaml"
    path.write_text(text)
    return path


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> CampaignResult:
    folder = tmp_path_factory.mktemp("campaign")
    campaign = load_campaign(_write(folder))
    return run_campaign(campaign, folder / "out", Pool(scheduler="here"))


def test_all_landings_are_done(result: CampaignResult) -> None:
    assert result.flown == [0, 1, 2, 3]
    cases = pd.read_parquet(result.folder / "tables" / "cases.parquet")
    assert cases["confirmed"].sum() == len({*result.sample, *result.critical}) >= 2
    vertical = cases["gear:main_left.tyre_vertical"].to_numpy()
    assert vertical[2:].min() > vertical[:2].max()  # twice the sink rate


def test_screening_with_all_modes_is_the_transient(result: CampaignResult) -> None:
    """What is left is the transient's step, and the modes that the landing slows."""
    assert result.errors["p99"].max() < 0.03
    assert result.errors["landings"].eq(2).all()


def test_static_answers_carry_what_modes_lack(result: CampaignResult) -> None:
    """Without them the stresses of a landing are far off at the gears."""
    number = result.sample[0]
    own = next(iter(result.prepared.values()))
    with h5py.File(case_file(result.cases, number)) as file:
        load = np.asarray(file["loads/load"])
        exact = np.asarray(file["stress/equivalent"])
    columns = own.setup.basis.stress[0][:, own.setup.basis.modes :]
    assert np.abs(columns).max() > 0.0
    assert np.abs(load).max() > 0.0
    assert exact.max() > 0.0


def test_envelope_holds_every_landing(result: CampaignResult) -> None:
    table = pd.read_parquet(result.folder / "tables" / "stress.parquet")
    for number in result.flown:
        path = confirmed_file(result.cases, number)
        path = path if path.is_file() else case_file(result.cases, number)
        with h5py.File(path) as file:
            own = np.asarray(file["stress/equivalent"], float)
        # Tables are sorted by element, files stand in the order of the setup.
        elements = next(iter(result.prepared.values())).setup.elements["id"]
        by_id = pd.Series(own, index=elements).sort_index().to_numpy()
        assert (table.equivalent.to_numpy() >= by_id * (1 - 1e-6)).all()


def test_monitor_points_of_the_deck_have_extremes_and_hulls(
    result: CampaignResult,
) -> None:
    folder = result.folder / "tables"
    table = pd.read_parquet(folder / "monitor_points.parquet")
    labels = set(table[table.name == "WING4"].label)
    assert labels == {"WING, STARBOARD, OUTBOARD OF THE SECOND BAY"}
    wide = table.pivot(index="quantity", columns="name", values="max")
    assert list(wide.index) == ["F1", "F2", "F3", "M1", "M2", "M3"]
    # Loads and inertia beyond the cut against the force of the bar there, which its
    # damping does not change here: both are quasi-static.
    for quantity in ("F3", "M1"):
        outside, bar = wide.loc[quantity, ["WING4", "BAR111"]]
        assert outside > 0.0
        assert bar == pytest.approx(outside, rel=1e-2)
    hulls = pd.read_parquet(folder / "monitor_hulls.parquet")
    own = hulls[(hulls.name == "WING4") & (hulls.pair == "F3-M1")]
    assert own.x.max() == pytest.approx(wide.loc["F3", "WING4"], rel=2e-3)
    assert set(own.case) <= set(result.flown)


def test_resume_computes_nothing_and_changes_nothing(result: CampaignResult) -> None:
    files = sorted(result.cases.glob("*.h5"))
    before = {f: f.stat().st_mtime_ns for f in files}
    tables = {p: p.read_bytes() for p in (result.folder / "tables").glob("*.parquet")}
    run_campaign(result.campaign, result.folder, Pool(scheduler="here"))
    assert {f: f.stat().st_mtime_ns for f in files} == before
    assert {p: p.read_bytes() for p in tables} == tables


def test_an_airframe_is_kept_and_a_damaged_one_made_again(
    result: CampaignResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Modes that left the cache and come out otherwise cannot part from landings."""
    made: list[str] = []

    def computed(*args: object) -> dict:
        made.append("airframe")
        return compute(*args)

    compute = setup._compute
    monkeypatch.setattr(setup, "_compute", computed)
    case, place = expand(result.campaign)[1][0], tmp_path / "000"
    monkeypatch.setenv("DRAKE_LANDING_CACHE", str(tmp_path / "mine"))
    first = setup.prepare(case, place, Silent())
    assert setup.prepare(case, place, Silent()).key == first.key
    assert made == ["airframe"]
    first.landing.path.write_bytes(b"damaged")
    again = setup.prepare(case, place, Silent())
    assert made == ["airframe"] * 2
    assert again.key == first.key
    (kept,) = place.glob("*.kept.json")
    inputs = kept.name.removesuffix(".kept.json")
    assert setup._kept(place, inputs) is not None
    for folder in (str(tmp_path / "stranger"), "off"):  # another secret, or none
        monkeypatch.setenv("DRAKE_LANDING_CACHE", folder)
        assert setup._kept(place, inputs) is None
    body = replace(again.setup.body, frequency=again.setup.body.frequency * (1 + 1e-15))
    other = replace(again.setup, body=body)  # the same inputs, modes made anew
    assert setup._key(inputs, again.setup) == first.key != setup._key(inputs, other)
    (place / "left.setup").touch()  # of another state of the airframe
    airframe = case.airframe.model_copy(update={"candidates": 100.0})
    thinner = case.model_copy(update={"airframe": airframe})
    assert setup.prepare(thinner, place, Silent()).key != first.key
    assert len([*place.glob("*.setup")]) == 3


def test_static_decks_reproduce_the_stresses(result: CampaignResult) -> None:
    """K u of an instant, solved by SOL 101, gives the screened stresses again."""
    (deck,) = write_critical_decks(result)
    instants = pd.read_csv(deck.parent / "instants.csv")
    path = run_deck(read_deck(deck), deck.parent / "fem")
    own = next(iter(result.prepared.values()))
    with h5py.File(path) as file:
        for row in instants.to_dict("records"):
            group = file[f"static/{row['subcase']}/element_stress/CBAR"]
            columns = list(group.attrs["columns"])
            value = np.asarray(group["value"])
            high = value[:, [k for k, n in enumerate(columns) if "smax" in n]]
            low = value[:, [k for k, n in enumerate(columns) if "smin" in n]]
            found = np.maximum(high.max(axis=1), -low.min(axis=1))
            with h5py.File(case_file(result.cases, row["case"])) as case:
                time = np.asarray(case["loads/time"])
                at = int(np.abs(time - row["time"]).argmin())
                load = np.asarray(case["loads/load"][at]).ravel()
                q = np.asarray(case["loads/amplitudes"][:, at], float)
            rows = own.setup.basis.stress[0].astype(float) @ np.concatenate([q, load])
            expected = np.abs(rows.reshape(len(found), -1)).max(axis=1)
            # Stress modes are kept in single precision.
            assert found == pytest.approx(expected, rel=1e-4, abs=1e-4 * found.max())


def test_a_case_that_cannot_be_flown_does_not_stop_the_others(tmp_path: Path) -> None:
    """The gears have no brakes: one of the two cases asks for them."""
    path = _write(
        tmp_path,
        "name: brakes\nbase: case.yaml\naxes:\n  scenario.braking: [0.0, 1.0]\n"
        "confirm: {sample: 0, most: 0}\n",
    )
    case = path.with_name("case.yaml")
    case.write_text(case.read_text().replace("duration: 0.12", "duration: 0.02"))
    found = run_campaign(load_campaign(path), tmp_path / "out", Pool(scheduler="here"))
    assert found.flown == [0]
    assert found.failed == [1]
    assert "no gear has a brake" in failure_message(found, 1)
    page = (tmp_path / "out" / "campaign.html").read_text()
    assert "no gear has a brake" in page
    assert "Not measured" in page


def _tables(folder: Path) -> dict[str, bytes]:
    return {p.name: p.read_bytes() for p in sorted((folder / "tables").iterdir())}


def _again(result: CampaignResult, folder: Path) -> CampaignResult:
    """Goes on with a copy of a campaign's folder."""
    shutil.copytree(result.folder, folder, dirs_exist_ok=True)
    return run_campaign(result.campaign, folder, Pool(scheduler="here"))


def test_a_landing_that_cannot_be_integrated_leaves_its_block_alone(
    result: CampaignResult, tmp_path: Path
) -> None:
    bad, good = result.sample
    shutil.copytree(result.folder, tmp_path, dirs_exist_ok=True)
    with h5py.File(case_file(tmp_path / "cases", bad), "a") as file:
        file["loads/load"][3] = np.nan
    for number in result.sample:
        confirmed_file(tmp_path / "cases", number).unlink()
    found = run_campaign(result.campaign, tmp_path, Pool(scheduler="here"))
    assert found.sample == (good,)
    assert found.failed == [bad]
    assert "NaN" in failure_message(found, bad)
    cases = pd.read_parquet(tmp_path / "tables" / "cases.parquet").set_index("case")
    assert "no direct transient" in cases.remark[bad]
    assert not cases.confirmed[bad]
    assert "no direct transient" in (tmp_path / "campaign.html").read_text()


def test_a_transient_of_another_landing_does_not_stand_for_it(
    result: CampaignResult, tmp_path: Path
) -> None:
    """A file of an earlier state of the campaign is not what is known of a case."""
    cases = tmp_path / "cases"
    shutil.copytree(result.cases, cases)
    left = next(n for n in result.flown if n not in {*result.sample, *result.critical})
    with h5py.File(confirmed_file(cases, left), "w") as file:
        file.attrs["key"] = "of another state"
    found = _again(result, tmp_path)
    assert not confirmed_file(cases, left).exists()
    assert _tables(found.folder) == _tables(result.folder)


def test_full_disk_ends_the_campaign_which_then_goes_on(
    result: CampaignResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written = []

    def full(path: Path):
        written.append(path)
        if len(written) > 2:
            raise OSError(errno.ENOSPC, "No space left on device", str(path))
        return written_hdf5(path)

    with monkeypatch.context() as patch:
        patch.setattr("drake_landing.campaign.task.written_hdf5", full)
        with pytest.raises(OSError, match="No space left"):
            run_campaign(result.campaign, tmp_path, Pool(scheduler="here"))
    there = sorted((tmp_path / "cases").glob("*.h5"))
    assert [p.name for p in there] == ["000000.h5", "000001.h5"]
    before = [p.stat().st_mtime_ns for p in there]
    run_campaign(result.campaign, tmp_path, Pool(scheduler="here"))
    assert [p.stat().st_mtime_ns for p in there] == before
    assert _tables(tmp_path) == _tables(result.folder)


@pytest.mark.slow
def test_two_workers_one_of_them_killed_find_the_same(
    result: CampaignResult, tmp_path: Path
) -> None:
    """Byte by byte; the task of the worker that dies is done by another."""
    cases, killed = tmp_path / "cases", []

    def kill() -> None:
        end = clock.monotonic() + 60.0
        while not list(cases.glob("*.h5")) and clock.monotonic() < end:
            clock.sleep(0.02)
        workers = [
            p
            for p in psutil.Process().children(recursive=True)
            if "spawn_main" in " ".join(p.cmdline())
        ]
        workers[0].kill()
        killed.append(workers[0].pid)

    thread = threading.Thread(target=kill)
    thread.start()
    found = run_campaign(result.campaign, tmp_path, Pool(workers=2))
    thread.join()
    assert len(killed) == 1
    assert found.failed == []
    assert _tables(tmp_path) == _tables(result.folder)


def test_every_problem_of_every_case_is_named_once(tmp_path: Path) -> None:
    text = CAMPAIGN.replace(
        "scenario.sink_rate: [0.6, 1.2]",
        "scenario.sink_rate: [0.6, -1.0]\n  gears.mian_left.tyre.stiffness: [1.0]"
        "\n  scenario.snk_rate: [1.0]",
    )
    with pytest.raises(InputError) as error:
        expand(load_campaign(_write(tmp_path, text)))
    said = "\n".join(error.value.problems)
    assert "campaign.yaml:" in said
    assert "did you mean 'main_left'" in said
    assert "axes.scenario.snk_rate: unknown key; did you mean 'sink_rate'" in said


def test_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = _write(tmp_path)
    app(["check", str(path)], standalone_mode=False)
    assert "4 landings" in capsys.readouterr().out


def test_check_weighs_every_mass_case(tmp_path: Path) -> None:
    text = CAMPAIGN.replace(
        "axes:\n", "axes:\n  airframe.mass_case: [light, heavy]\n", 1
    )
    path = _write(tmp_path, text)
    base = load_campaign(path).base
    cases = "mass_cases: {light: {}, heavy: {mass: 9e9}}"
    base.write_text(base.read_text().replace("airframe:\n", f"airframe:\n  {cases}\n"))
    with pytest.raises(
        InputError, match=r"case.yaml:\d+: .*heavy.mass: found .* 9,000,000"
    ):
        command.explain_campaign(load_campaign(path))


@pytest.fixture(scope="module")
def browser_page(result: CampaignResult, tmp_path_factory: pytest.TempPathFactory):
    """The page of a thousand landings, in a real browser."""
    playwright = pytest.importorskip("playwright.sync_api")
    try:
        program = browser()
    except InputError as error:
        pytest.skip(str(error))
    cases = pd.concat([result.tables["cases"]] * 250, ignore_index=True)
    cases["case"] = np.arange(len(cases))
    critical = pd.concat([result.tables["critical_cases"]] * 20, ignore_index=True)
    critical["case"] = np.arange(len(critical)) * 7
    many = {**result.tables, "cases": cases, "critical_cases": critical}
    path = tmp_path_factory.mktemp("page") / "campaign.html"
    write_page(replace(result, tables=many), path)
    with playwright.sync_playwright() as program_of:
        chromium = program_of.chromium.launch(
            executable_path=program, args=["--no-sandbox", "--disable-gpu"]
        )
        page = chromium.new_page()
        page.errors = []
        page.on("pageerror", lambda error: page.errors.append(error))
        page.on("request", lambda r: r.url.startswith("file:") or page.errors.append(r))
        page.goto(path.as_uri())
        page.wait_for_selector("body[data-ready=yes]")
        yield page
        chromium.close()


def test_page_shows_a_thousand_cases_without_network(browser_page) -> None:
    assert browser_page.errors == []
    assert browser_page.locator("#matrix circle").count() == 1000


def test_page_sorts_and_filters_critical_cases(browser_page) -> None:
    rows = browser_page.locator("#criticals tbody tr")
    every = rows.count()
    head = browser_page.locator("#criticals th").first
    head.click()
    first = int(rows.first.locator("td").first.inner_text())
    head.click()
    assert first > int(rows.first.locator("td").first.inner_text()) == 0
    browser_page.fill("#filter", "no such thing")
    assert rows.count() == 0
    browser_page.fill("#filter", "")
    assert rows.count() == every


def test_a_click_on_the_page_leads_to_the_case(browser_page) -> None:
    row = browser_page.locator("#criticals tbody tr").first
    case = row.locator("td").first.inner_text()
    row.click()
    shown = browser_page.locator("#case")
    assert shown.locator("h2").inner_text() == f"Case {case}"
    assert f"--report {case}" in shown.inner_text()
    assert "scenario.sink_rate" in shown.inner_text()
    browser_page.locator("#hull circle").first.click()
    assert shown.locator("h2").inner_text().startswith("Case ")
    assert browser_page.errors == []


def test_names_of_the_package_run_a_campaign(result: CampaignResult) -> None:
    assert drake_landing.run_campaign is run_campaign
    assert drake_landing.load_campaign is load_campaign
    assert set(result.tables) >= {"cases", "stress", "components", "section_hulls"}
    stored = pd.read_parquet(result.folder / "tables" / "stress.parquet")
    pd.testing.assert_frame_equal(stored, result.tables["stress"], check_dtype=False)


def test_an_interrupt_says_what_is_done_and_how_to_go_on(
    result: CampaignResult,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def interrupted(_campaign: object, folder: Path, *_more: object) -> None:
        shutil.copytree(result.cases, folder / "cases")
        case_file(folder / "cases", 1).unlink()
        raise KeyboardInterrupt

    monkeypatch.setattr(command, "run_campaign", interrupted)
    file = Path(result.campaign.places.file)
    with pytest.raises(KeyboardInterrupt):
        command.campaign_command(
            result.campaign, file, tmp_path / "my out", Pool(scheduler="here"), [], None
        )
    done = len(result.sample) + len(result.critical)
    assert capsys.readouterr().err.splitlines()[-1] == (
        f"3 of 4 landings and {done} direct transients are done and kept in "
        f"{tmp_path / 'my out'}; to go on: drake-landing campaign {file} --out "
        f"'{tmp_path / 'my out'}'"
    )
