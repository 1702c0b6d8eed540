"""`drake-landing campaign`: from the file to the folder of results, in words."""

import shlex
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from drake_landing.airframe.mass_cases import loaded
from drake_landing.campaign.cases import BaseCase
from drake_landing.campaign.combinations import case_rows
from drake_landing.campaign.compare import compare_campaigns
from drake_landing.campaign.confirm import confirmed_file
from drake_landing.campaign.critical_decks import write_critical_decks
from drake_landing.campaign.engine import Pool
from drake_landing.campaign.run import (
    CampaignResult,
    expand,
    failure_message,
    run_campaign,
)
from drake_landing.campaign.schema import Campaign
from drake_landing.campaign.task import case_file
from drake_landing.case.schema import Case
from drake_landing.csv_tables import write_csv
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.run import run_case
from drake_landing.progress import reporter, told_when_interrupted
from drake_landing.terminal import show
from fem.errors import InputError, Problems
from fem.files.folders import claim


def campaign_command(
    campaign: Campaign,
    file: Path,
    out: Path | None,
    pool: Pool,
    reports: Sequence[int],
    compare: Path | None,
) -> int:
    """Runs or goes on with a campaign, prints what it found.

    Returns:
        Cases that have no result that can be trusted.

    Raises:
        InputError: campaign, case, deck or gears are at fault.
    """
    folder = claim(out or Path("out", "campaign", campaign.name), f"campaign {file}")
    if reports:
        _reports(campaign, folder, reports)
    with (
        told_when_interrupted(lambda: _kept(campaign, file, folder, out)),
        reporter() as progress,
    ):
        result = run_campaign(campaign, folder, pool, progress)
        decks = write_critical_decks(result)
    show(_summary(result, len(decks)))
    if compare is not None:
        for name, table in compare_campaigns(compare, folder).items():
            write_csv(folder / f"compared_{name}.csv", table.reset_index())
            show(f"\n{name}, before and after:\n{table.head(10).to_string()}")
    print(f"\npage: {folder / 'campaign.html'}")
    return len(result.failed)


def _kept(campaign: Campaign, file: Path, folder: Path, out: Path | None) -> str:
    """How far a campaign got, and how to go on with it."""
    cases, numbers = folder / "cases", case_rows(campaign).index
    flown = sum(case_file(cases, int(n)).is_file() for n in numbers)
    confirmed = sum(confirmed_file(cases, int(n)).is_file() for n in numbers)
    given = "" if out is None else f" --out {shlex.quote(str(out))}"
    return (
        f"{flown} of {len(numbers)} landings and {confirmed} direct transients are "
        f"done and kept in {folder}; to go on: drake-landing campaign "
        f"{shlex.quote(str(file))}{given}"
    )


_FIRST = 3  # cases that are named
_USUAL = 2.0  # s, of a landing that goes on until it has shown its extremes
_FLY = 5.0  # s of processor time for a second of landing, some 80 modes
_STEP = 2e-7  # s of processor time for a step of a landing in a block, per freedom


def explain_campaign(campaign: Campaign) -> str:
    """How many cases, of which airframes, and what they will cost.

    Raises:
        InputError: every problem of every case, or of every airframe.
    """
    rows, cases = expand(campaign)
    places = BaseCase(campaign.base).case.places
    with places.located():
        airframes, freedoms = _airframes(cases)
    given = [case.simulation.duration for case in cases]
    duration = [d if isinstance(d, float | int) else _USUAL for d in given]
    steps = max(1.0, duration[0] / cases[0].transient.step)
    confirmed = min(len(rows), campaign.confirm.sample + campaign.confirm.most)
    minutes = _STEP * freedoms * steps * confirmed / 60.0
    axes = "\n".join(
        f"    {name}: {', '.join(map(_short, rows[name].unique()[:6]))}"
        + (" ..." if rows[name].nunique() > 6 else "")
        for name in rows.columns
    )
    return (
        f"{campaign.name}: {len(rows)} landings of {campaign.base}\n{axes}\n"
        f"{airframes}\n"
        f"  landings    about {_FLY * sum(duration):.0f} s of processor time to fly, "
        f"files of {1e-6 * steps * 4 * 120 * len(rows):.0f} MB\n"
        f"  confirmed   {campaign.confirm.sample} drawn at random and at most "
        f"{campaign.confirm.most} that decide: {confirmed} direct transients of "
        f"at most {steps:.0f} steps, at most {campaign.confirm.block} together, some "
        f"{minutes:.1g} min of processor time\n"
        f"run it: drake-landing campaign {shlex.quote(campaign.places.file)}"
    )


def _airframes(cases: Sequence[Case]) -> tuple[str, int]:
    """A line on each airframe, and how many freedoms the largest has.

    Each is built: a mass case may miss the mass that it should have.

    Raises:
        InputError: of all airframes.
    """
    distinct = {case.airframe.model_dump_json(): case for case in reversed(cases)}
    problems, lines, freedoms = Problems(), [], 0
    with TemporaryDirectory() as folder:
        for i, case in enumerate(reversed(distinct.values())):
            with problems.gathered():
                aircraft = prepare_aircraft(case, Path(folder, str(i)))
                structure = aircraft.structure()
                mass = loaded(structure, aircraft.gears).mass
                name = case.airframe.mass_case or aircraft.name
                lines.append(
                    f"  {'' if i else 'airframes':<12}{name}, {mass:,.0f} kg with gears"
                )
                freedoms = max(freedoms, structure.size)
    problems.report()
    return "\n".join(lines), freedoms


def _short(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _reports(campaign: Campaign, folder: Path, numbers: Sequence[int]) -> None:
    """The whole process of some cases."""
    _, cases = expand(campaign)
    unknown = [n for n in numbers if not 0 <= n < len(cases)]
    if unknown:
        raise InputError(
            f"--report: found {n}, expected a case from 0 to {len(cases) - 1}"
            for n in unknown
        )
    for number in numbers:
        place = folder / "reports" / f"{number:06d}"
        with reporter() as progress:
            run_case(cases[number], place, progress)


def _summary(result: CampaignResult, decks: int) -> str:
    lines = [
        f"{len(result.flown)} of {len(result.design)} landings done, "
        f"{len(result.sample) + len(result.critical)} confirmed by direct transients"
    ]
    done = {*result.sample, *result.critical}
    open_ = result.within_band[~result.within_band.index.isin(done)]
    if len(open_):
        first = ", ".join(
            f"case {n} ({count} element{'s' * (count > 1)})"
            for n, count in open_.elements.head(_FIRST).items()
        )
        most = result.campaign.confirm.most + len(open_)
        lines.append(
            f"{len(open_)} more landings lie within the screening's error of some "
            f"element's largest stress: {first}{', ...' * (len(open_) > _FIRST)}; "
            f"'confirm.most: {most}' confirms them all"
        )
    if not result.errors.empty:
        worst = result.errors["peak"].abs().max()
        lines.append(f"screening: components' largest stresses within {worst:.1%}")
    lines += [f"case {n}: {failure_message(result, n)}" for n in result.failed[:10]]
    if len(result.failed) > 10:
        lines.append(f"... {len(result.failed)} cases failed or are suspect")
    if decks:
        of = f"deck{'s' * (decks > 1)} of equivalent static cases"
        lines.append(f"{decks} {of} in static/")
    return "\n".join(lines)
