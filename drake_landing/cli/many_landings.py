"""`study` and `campaign`: many landings."""

import shlex
from pathlib import Path
from typing import Annotated

import typer

from drake_landing.cli.options import Reach, Trust, out_option


def study(
    name: Annotated[str, typer.Argument(help="modes, topology or full")],
    out: Annotated[Path | None, out_option("out/study/<name>")] = None,
) -> None:
    """The paper's studies: numbers of modes, gear topologies, the full aircraft."""
    from drake_landing.progress import reporter, told_when_interrupted
    from drake_landing.reference.studies import PLANS, run_study
    from drake_landing.reference.studies.findings import findings
    from fem.errors import InputError, nearest
    from fem.files.folders import claim

    if name not in PLANS:
        raise InputError(
            f"study: found '{name}', expected one of {', '.join(PLANS)}"
            + nearest(name, PLANS)
        )
    folder = claim(out or Path("out", "study", name), f"study {name}")
    again = "" if out is None else f" --out {shlex.quote(str(out))}"
    kept = f"landings and transients so far are kept; go on: study {name}{again}"
    with told_when_interrupted(lambda: kept), reporter() as progress:
        done = run_study(PLANS[name], folder, progress)
    for row in findings(done).to_dict("records"):
        print(f"{row['finding']}: {row['figures']} -- {row['holds']}")
    print(f"\nreport: {folder / 'report.html'}")


def campaign(
    file: Annotated[
        Path, typer.Argument(metavar="CAMPAIGN.yaml", help="see docs/campaigns.md")
    ],
    out: Annotated[Path | None, out_option("out/campaign/<name>")] = None,
    scheduler: Annotated[
        str,
        typer.Option("--scheduler", help="local, here, or tcp://host:port of Dask"),
    ] = "local",
    workers: Annotated[
        int | None, typer.Option("--workers", min=1, help="processes; default cores")
    ] = None,
    memory: Annotated[
        float, typer.Option("--memory", min=0.0, help="GB per worker; 0: no limit")
    ] = 0.0,
    report: Annotated[
        list[int] | None,
        typer.Option("--report", help="case whose whole process is run, with report"),
    ] = None,
    compare: Annotated[
        Path | None,
        typer.Option("--compare", help="folder of another campaign: what grew"),
    ] = None,
    include_path: Reach = None,
    trust: Trust = False,
) -> None:
    """Many landings: stress of every element, envelopes, critical cases; goes on."""
    from drake_landing.campaign.cases import load_campaign

    planned = load_campaign(file)  # what is wrong with it, before much is loaded
    from drake_landing.campaign.command import campaign_command
    from drake_landing.campaign.engine import Pool
    from fem.deck.text.source import include_reach

    pool = Pool(scheduler=scheduler, workers=workers, memory_gb=memory)
    with include_reach(include_path or [], trust=trust):
        failed = campaign_command(planned, file, out, pool, report or [], compare)
    if failed:
        raise typer.Exit(3)
