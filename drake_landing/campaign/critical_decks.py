"""Static decks of the instants that size the sections and the components."""

from pathlib import Path

import pandas as pd

from drake_landing.campaign.run import CampaignResult
from drake_landing.campaign.static_cases import Instant, static_deck

_MOST = 30  # subcases of a deck


def sizing_instants(
    components: pd.DataFrame, sections: pd.DataFrame, of_case: dict[int, str], key: str
) -> list[Instant]:
    """Instants of one airframe at which a component or a root section is at its worst.

    Args:
        components: table of the campaign, worst margin first.
        sections: table of the campaign.
        of_case: case -> key of its airframe.
        key: of the airframe.
    """
    found: dict[tuple[int, float], list[str]] = {}

    def add(case: int, time: float, why: str) -> None:
        if of_case.get(case) == key:
            found.setdefault((case, round(float(time), 6)), []).append(why)

    for row in components.to_dict("records"):
        add(int(row["case"]), row["time"], f"{row['component']}")
    roots = sections.groupby(["beam", "quantity"], sort=False).first().reset_index()
    for row in roots.to_dict("records"):
        for end in ("min", "max"):
            add(
                int(row[f"case_of_{end}"]),
                row[f"time_of_{end}"],
                f"{row['beam']} {row['quantity']} {end}",
            )
    instants = [
        Instant(case=case, time=time, why="; ".join(why))
        for (case, time), why in found.items()
    ]
    return instants[:_MOST]


def write_critical_decks(result: CampaignResult) -> list[Path]:
    """One SOL 101 deck per airframe in `static/`, and `static/instants.csv`."""
    from drake_landing.campaign.compare import read_table
    from drake_landing.csv_tables import write_csv

    components = read_table(result.folder, "components")
    sections = read_table(result.folder, "sections")
    decks, rows = [], []
    for number, (key, own) in enumerate(result.prepared.items()):
        instants = sizing_instants(components, sections, result.of_case, key)
        if not instants:
            continue
        path = result.folder / "static" / f"airframe_{number:03d}.bdf"
        static_deck(own, result.cases, instants, path)
        decks.append(path)
        rows += [
            [path.name, k + 1, i.case, i.time, i.why] for k, i in enumerate(instants)
        ]
    heads = ["deck", "subcase", "case", "time", "why"]
    if rows:
        write_csv(
            result.folder / "static" / "instants.csv", pd.DataFrame(rows, columns=heads)
        )
    return decks
