"""A campaign of very many stub landings: scheduler, tables, page, memory.

    python -m benchmarks.campaign_scale [--landings 100000] [--elements 200]

The landings are made up (random stresses, section loads and peaks in the layout of a
case file); all that comes after a landing is the campaign's own: tasks on workers of
this machine, files found again, tables, page.
"""

import argparse
import tempfile
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter, process_time
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pandas as pd

from benchmarks.machine import description, load, peak_memory
from drake_landing.campaign.engine import Pool, engine
from drake_landing.campaign.page import write_page
from drake_landing.campaign.run import CampaignResult
from drake_landing.campaign.schema import Campaign
from drake_landing.campaign.selection import to_confirm
from drake_landing.campaign.tables import write_tables
from drake_landing.campaign.task import PAIRS, case_file
from drake_landing.parts.cuts import NAMED
from drake_landing.progress import Silent
from fem.files.atomic_hdf5 import written_hdf5

_CUTS = 6


@dataclass(frozen=True)
class Stub:
    """A landing that is made up."""

    folder: Path
    number: int
    elements: int


def make(stub: Stub) -> int:
    """Writes its case file."""
    rng = np.random.default_rng(stub.number)
    size = 1.0 + rng.random()
    with written_hdf5(case_file(stub.folder, stub.number)) as file:
        file.attrs.update(case=stub.number, key="stub", status="done", remark="")
        for name in ("equivalent", "high", "low", "time"):
            values = size * rng.random(stub.elements, np.float32)
            file.create_dataset(f"stress/{name}", data=1e8 * values)
        own = file.create_group("sections/wing")
        own["station"] = np.arange(_CUTS, dtype=float)
        for name in ("min", "max", "time_of_min", "time_of_max"):
            own[name] = size * rng.standard_normal((_CUTS, len(NAMED)))
        kinds = [(c, p) for c in range(_CUTS) for p in range(len(PAIRS))]
        own["hull_of"] = np.repeat(np.array(kinds, np.int32), 4, axis=0)
        own["hull"] = size * rng.standard_normal((4 * len(kinds), 3))
        own["min"].attrs["columns"] = " ".join(NAMED)
        own["hull"].attrs["pairs"] = "; ".join("-".join(p) for p in PAIRS)
        file.create_group("monitor_points")
        for group, names in (("gears", 9), ("points", 18)):
            labels = [f"{group}.{i}" for i in range(names)]
            file[f"{group}/name"] = np.array(labels, "S64")
            file[f"{group}/peak"] = size * rng.random(names)
    return stub.number


def _campaign(folder: Path, landings: int, elements: int) -> CampaignResult:
    """What a campaign would know of them."""
    base = folder / "case.yaml"
    base.write_text("")
    drawn = {"distribution": "norm", "values": {"loc": 1.5, "scale": 0.3}}
    campaign = Campaign.model_validate(
        {
            "name": "stubs",
            "base": str(base),
            "axes": {"scenario.sink_rate": drawn},
            "samples": landings,
        }
    )
    ids = np.arange(1, elements + 1)
    table = pd.DataFrame(
        {
            "id": ids,
            "card": "CQUAD4",
            "component": [f"part {i % 12}" for i in ids],
            "material": 1,
            "x": ids * 0.1,
            "y": 0.0,
            "z": 0.0,
            "allowed": 4e8,
            "axial_only": False,
        }
    )
    own: Any = SimpleNamespace(
        aircraft=SimpleNamespace(name="stub"),
        setup=SimpleNamespace(elements=table, stations=()),
        ultimate_factor=1.5,
    )
    numbers = pd.RangeIndex(landings, name="case")
    sink = np.random.default_rng(0).normal(1.5, 0.3, landings)
    return CampaignResult(
        campaign=campaign,
        folder=folder,
        design=pd.DataFrame({"scenario.sink_rate": sink}, index=numbers, dtype=object),
        status=pd.Series("done", index=numbers, name="status", dtype=object),
        errors=pd.DataFrame(index=pd.Index([], name="component")),
        sample=(),
        critical=(),
        within_band=pd.DataFrame({"elements": []}),
        unconfirmed={},
        prepared={"stub": own},
        of_case=dict.fromkeys(range(landings), "stub"),
    )


def main() -> None:
    """Prints a table of what each part takes."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--landings", type=int, default=100_000)
    options.add_argument("--elements", type=int, default=200)
    options.add_argument("--workers", type=int, default=2)
    given = options.parse_args()
    print(f"{given.landings} landings, {description()}, load {load():.1f}")
    print("| part | s wall | s processor of the main process | GB |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "cases").mkdir()
        stubs = [
            Stub(folder / "cases", i, given.elements) for i in range(given.landings)
        ]
        found = _campaign(folder, given.landings, given.elements)
        component = found.prepared["stub"].setup.elements.component.tolist()

        def run() -> int:
            with engine(Pool(workers=given.workers)) as pool:
                done = pool.run(make, stubs, lambda *lost: print(lost), Silent())
                return sum(1 for _ in done)

        def tables() -> int:
            made = write_tables(found)
            object.__setattr__(found, "tables", made)
            return len(made["cases"])

        parts = {
            "scheduler and files": run,
            "which to confirm": lambda: len(
                to_confirm(found.cases, found.flown, component, {})
            ),
            "tables": tables,
            "page": lambda: write_page(found, folder / "campaign.html"),
        }
        for what, part in parts.items():
            wall, processor = perf_counter(), process_time()
            cast(Any, part)()
            print(
                f"| {what} | {perf_counter() - wall:.1f} | "
                f"{process_time() - processor:.1f} | {peak_memory() / 1e9:.2f} |",
                flush=True,
            )
        page = (folder / "campaign.html").stat().st_size / 1e6
        files = sum(p.stat().st_size for p in (folder / "cases").iterdir()) / 1e6
        print(f"page {page:.1f} MB, case files {files:.0f} MB")


if __name__ == "__main__":
    main()
