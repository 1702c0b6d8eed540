"""A campaign from its file to its tables and page: one readable story.

    design -> airframes prepared -> landings flown and screened -> a random sample and
    the critical landings confirmed by direct transients -> envelopes, hulls, critical
    cases, statistics -> page

Everything that was computed is found again by a later run in the same folder.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import h5py
import numpy as np
import pandas as pd

from drake_landing.cache import content_key
from drake_landing.campaign.cases import BaseCase
from drake_landing.campaign.combinations import case_rows
from drake_landing.campaign.confirm import (
    BlockTask,
    block_tasks,
    confirmed_file,
    run_block,
)
from drake_landing.campaign.engine import Engine, Pool, engine
from drake_landing.campaign.schema import Campaign
from drake_landing.campaign.selection import last_peak, screening_errors, to_confirm
from drake_landing.campaign.setup import Prepared, airframe_key, prepare
from drake_landing.campaign.task import (
    LandingTask,
    case_file,
    failure_file,
    run_task,
    write_failure,
)
from drake_landing.case.reading import case_text
from drake_landing.case.schema import Case
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.progress import Reporter, Silent
from fem.errors import InputError


@dataclass(frozen=True, kw_only=True)
class CampaignResult:
    """What a campaign found.

    Attributes:
        campaign: as validated.
        folder: of all files.
        design: one row per case, see `design`.
        status: of each case: done, suspect or failed.
        errors: of the screening, see `selection.screening_errors`.
        sample, critical: landings that were confirmed: at random, and because they
            decide.
        within_band: landings that should be confirmed; more than `critical` where
            `confirm.most` is not enough.
        unconfirmed: landings whose direct transient failed, and why.
        prepared: airframes by key.
        of_case: case -> key of its airframe.
        tables: by name, see `docs/campaigns.md`; SI units.
    """

    campaign: Campaign
    folder: Path
    design: pd.DataFrame = field(repr=False)
    status: pd.Series = field(repr=False)
    errors: pd.DataFrame = field(repr=False)
    sample: tuple[int, ...]
    critical: tuple[int, ...]
    within_band: pd.DataFrame = field(repr=False)
    unconfirmed: dict[int, str] = field(repr=False)
    prepared: dict[str, Prepared] = field(repr=False)
    of_case: dict[int, str] = field(repr=False)
    tables: Mapping[str, pd.DataFrame] = field(default_factory=dict, repr=False)

    @property
    def cases(self) -> Path:
        """Folder of the case files."""
        return self.folder / "cases"

    @property
    def flown(self) -> list[int]:
        """Landings with a result that can be trusted."""
        return [int(n) for n, s in self.status.items() if s == "done"]

    @property
    def failed(self) -> list[int]:
        """Cases without a result, or with one that cannot be trusted or confirmed."""
        flown = [int(n) for n, s in self.status.items() if s != "done"]
        return sorted({*flown, *self.unconfirmed})


def expand(campaign: Campaign) -> tuple[pd.DataFrame, list[Case]]:
    """All cases of a campaign, validated.

    Raises:
        InputError: every problem of every case, each once, with file and line.
    """
    base = BaseCase(campaign.base)
    if isinstance(base.case.gears, str) and any(
        path.startswith("gears.") for path in campaign.axes
    ):
        base = base.with_gears(_named_gears(base.case))
    rows = case_rows(campaign)
    cases, problems = [], {}
    for number, values in zip(rows.index, rows.to_dict("records")):
        name = f"{campaign.name}_{number:06d}"
        try:
            cases.append(base.case_of(values, campaign.axes, name))
        except InputError as error:
            for text in error.problems:
                problems.setdefault(campaign.places.named(text), number)
    if problems:
        raise InputError(
            f"{text} (first in case {number})" for text, number in problems.items()
        )
    return rows, cases


def run_campaign(
    campaign: Campaign,
    out: Path | str,
    pool: Pool | None = None,
    progress: Reporter | None = None,
) -> CampaignResult:
    """Runs a campaign, or goes on with one, and writes all its files.

    Args:
        campaign: validated, of `load_campaign`.
        out: folder.
        pool: where tasks run; default: all cores of this machine, in processes that
            import the main module again (`if __name__ == "__main__":`).
        progress: told the stages.

    Raises:
        InputError: the campaign, a case, deck or gears are at fault. Landings that fail
            raise nothing: they are listed.
    """
    tell, out = progress or Silent(), Path(out)
    tell.stage("expanding the campaign")
    rows, cases = expand(campaign)
    prepared, of_case = _prepare(cases, out, tell)
    tasks = _tasks(cases, prepared, of_case, out / "cases")
    with engine(pool or Pool()) as pool_:
        _fly(pool_, tasks, tell)
        status = _statuses(tasks)
        flown = [n for n in status.index if status[n] == "done"]
        sample = _sample(campaign, flown)
        confirm = partial(_confirm, campaign, pool_, tasks, prepared, of_case, tell)
        missed = confirm(_sample_peaks(sample, prepared, of_case, out), "sample")
        sample = [n for n in sample if n not in missed]
        errors, wanted = _decide(campaign, flown, sample, prepared, of_case, out)
        critical = [n for n in wanted.index if n not in {*sample, *missed}]
        critical = [int(n) for n in critical[: campaign.confirm.most]]
        peaks = wanted["last_peak"].loc[critical].to_dict()
        missed |= confirm(peaks, "critical")
        critical = [n for n in critical if n not in missed]
    result = CampaignResult(
        campaign=campaign,
        folder=out,
        design=rows,
        status=status,
        errors=errors,
        sample=tuple(sample),
        critical=tuple(critical),
        within_band=wanted,
        unconfirmed=missed,
        prepared=prepared,
        of_case=of_case,
    )
    from drake_landing.campaign.page import write_page
    from drake_landing.campaign.tables import write_tables

    tell.stage("tables")
    result = replace(result, tables=write_tables(result))
    tell.stage("page")
    write_page(result, out / "campaign.html")
    return result


def _named_gears(case: Case):
    from tempfile import TemporaryDirectory

    with case.reading(), TemporaryDirectory() as folder:
        return prepare_aircraft(case, Path(folder)).gears


def _prepare(
    cases: Sequence[Case], out: Path, tell: Reporter
) -> tuple[dict[str, Prepared], dict[int, str]]:
    prepared: dict[str, Prepared] = {}
    of_case = {}
    for number, case in enumerate(cases):
        key = airframe_key(case)
        of_case[number] = key
        if key not in prepared:
            place = out / "airframes" / f"{len(prepared):03d}"
            prepared[key] = prepare(case, place, tell)
    return prepared, of_case


def _tasks(
    cases: Sequence[Case],
    prepared: dict[str, Prepared],
    of_case: dict[int, str],
    folder: Path,
) -> list[LandingTask]:
    folder.mkdir(parents=True, exist_ok=True)
    tasks = []
    for number, case in enumerate(cases):
        own = prepared[of_case[number]]
        gears = own.aircraft.gears if isinstance(case.gears, str) else case.gears
        # The name holds the case's number, which is no part of its physics.
        plain = case.model_copy(update={"name": "case"})
        tasks.append(
            LandingTask(
                number=number,
                text=case_text(case),
                key=content_key(own.key, case_text(plain)),
                gears=tuple(gears),
                monitoring=dict(own.aircraft.monitoring),
                lift_nodes=own.aircraft.lift_nodes,
                setup=own.landing,
                folder=folder,
                step=case.transient.step,
                scheme=case.transient.scheme,
            )
        )
    return tasks


def _has(path: Path, key: str, until: float = 0.0) -> bool:
    """A complete file of this very content; of a transient, one that is long enough."""
    try:
        with h5py.File(path) as file:
            found = file.attrs.get("key") == key
            return bool(found and file.attrs.get("until", until) >= until)
    except OSError:
        return False


def _fly(pool: Engine, tasks: Sequence[LandingTask], tell: Reporter) -> None:
    for task in tasks:
        # A transient of another content must not stand for that of this landing.
        old = confirmed_file(task.folder, task.number)
        if old.is_file() and not _has(old, task.transient_key):
            old.unlink()
    missing = [t for t in tasks if not _has(case_file(t.folder, t.number), t.key)]
    found = len(tasks) - len(missing)
    tell.stage(
        f"{len(missing)} landings" + (f" ({found} are there already)" if found else "")
    )

    def lost(task: LandingTask, why: str) -> None:
        write_failure(task.folder, task.number, task.key, why)

    for _ in pool.run(run_task, missing, lost, tell):
        pass


def _statuses(tasks: Sequence[LandingTask]) -> pd.Series:
    found = {}
    for task in tasks:
        path = case_file(task.folder, task.number)
        if _has(path, task.key):
            with h5py.File(path) as file:
                found[task.number] = str(file.attrs["status"])
        else:
            found[task.number] = "failed"
    series = pd.Series(found, name="status", dtype=object)
    series.index.name = "case"
    return series


def _sample(campaign: Campaign, flown: Sequence[int]) -> list[int]:
    """Drawn at random, the same ones whatever failed elsewhere in the list's order."""
    rng = np.random.default_rng([campaign.seed, 1])
    order = rng.permutation(len(flown))
    return sorted(int(flown[i]) for i in order[: campaign.confirm.sample])


def _confirm(
    campaign: Campaign,
    pool: Engine,
    tasks: Sequence[LandingTask],
    prepared: dict[str, Prepared],
    of_case: dict[int, str],
    tell: Reporter,
    peaks: Mapping[int, float],
    what: str,
) -> dict[int, str]:
    """Direct transients of landings that have none yet, in blocks of one airframe.

    Args:
        peaks: landing -> last peak that its transient must hold, s; other arguments as
            in `run_campaign`.
        what: for the user.

    Returns:
        Landings that could not be integrated, and why.
    """
    key_of = {t.number: t.transient_key for t in tasks}
    folder = tasks[0].folder if tasks else Path()
    ends = {n: at + campaign.confirm.tail for n, at in peaks.items()}
    missing = [
        n
        for n, end in ends.items()
        if not _has(confirmed_file(folder, n), key_of[n], until=end)
    ]
    tell.stage(f"direct transients of {len(missing)} landings ({what})")
    alike: dict[tuple[str, float, str], list[int]] = {}
    for n in missing:
        kind = (of_case[n], tasks[n].step, tasks[n].scheme)
        alike.setdefault(kind, []).append(n)
    blocks = [
        block
        for (key, _, scheme), members in alike.items()
        for block in block_tasks(
            BlockTask(
                numbers=tuple(members),
                ends=tuple(ends[n] for n in members),
                keys=tuple(key_of[n] for n in members),
                landing=prepared[key].landing,
                transient=prepared[key].transient,
                folder=folder,
                scheme=scheme,
            ),
            campaign.confirm.block,
        )
    ]
    failed: list[tuple[BlockTask, str]] = []
    for _ in pool.run(run_block, blocks, lambda *found: failed.append(found), tell):
        pass
    # One landing that cannot be integrated must not take its block with it.
    again = [one for block, _ in failed if len(block.numbers) > 1 for one in block.each]
    failed = [found for found in failed if len(found[0].numbers) == 1]
    for _ in pool.run(run_block, again, lambda *found: failed.append(found), tell):
        pass
    return {task.numbers[0]: f"no direct transient: {why}" for task, why in failed}


def _sample_peaks(
    sample: Sequence[int],
    prepared: dict[str, Prepared],
    of_case: dict[int, str],
    out: Path,
) -> dict[int, float]:
    """Landing -> when all its elements have peaked whose error is to be measured."""
    component = {
        key: own.setup.elements.component.astype(str).tolist()
        for key, own in prepared.items()
    }
    return {n: last_peak(out / "cases", n, component[of_case[n]]) for n in sample}


def _decide(
    campaign: Campaign,
    flown: Sequence[int],
    sample: Sequence[int],
    prepared: dict[str, Prepared],
    of_case: dict[int, str],
    out: Path,
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Errors of the screening, and the landings that decide; airframe by airframe."""
    folder, errors, wanted = out / "cases", [], []
    confirmed = [n for n in sample if confirmed_file(folder, n).is_file()]
    for key, own in prepared.items():
        component = own.setup.elements.component.astype(str).tolist()
        mine = [n for n in flown if of_case[n] == key]
        drawn = [n for n in confirmed if of_case[n] == key]
        found = screening_errors(folder, drawn, component, campaign.confirm.confidence)
        band = found["band"].to_dict() if len(found) else {}
        errors.append(found.assign(airframe=own.aircraft.name))
        wanted.append(to_confirm(folder, mine, component, band))
    both = pd.concat(wanted) if wanted else pd.DataFrame({"elements": []})
    return pd.concat(errors), both.sort_values(
        "elements", ascending=False, kind="stable"
    )


def failure_message(result: CampaignResult, number: int) -> str:
    """Why a case has no result that can be trusted."""
    import json

    if number in result.unconfirmed:
        return result.unconfirmed[number]
    path = failure_file(result.cases, number)
    if path.is_file():
        return str(json.loads(path.read_text(encoding="utf-8"))["message"])
    path = case_file(result.cases, number)
    if path.is_file():
        with h5py.File(path) as file:
            return str(file.attrs["remark"])
    return "no file"
