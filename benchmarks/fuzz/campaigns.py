"""Campaign files, damaged: their cases, or a message."""

import random
from pathlib import Path

from benchmarks.fuzz import cases
from benchmarks.fuzz.mutations import mutate_bytes, mutate_values
from benchmarks.fuzz.outcome import Outcome
from fem.errors import InputError

_TEXT = """\
name: tried
base: plain.yaml
axes:
  scenario.sink_rate: {from: 0.6, to: 1.2, count: 3}
  gears.main_*.tyre.stiffness: [4.0e+5, 5.0e+5]
  scenario.pitch: {distribution: norm, values: {loc: 1, scale: 1}, low: 0, high: 3}
samples: 2
table:
  file: table.csv
  source: measured
  columns: {speed: scenario.forward_speed}
confirm: {sample: 2, most: 1}
"""


def seeds(folder: Path) -> list[Path]:
    """A campaign and its table; either is damaged.

    Args:
        folder: for them, their case and deck.
    """
    cases.seeds(folder)
    campaign, table = folder / "campaign.yaml", folder / "table.csv"
    campaign.write_text(_TEXT, encoding="utf-8")
    table.write_text("speed,other\n40.0,a\n45.5,b\n", encoding="utf-8")
    return [campaign, table]


def damaged(seed: Path, rng: random.Random, place: Path) -> None:
    """See `cases.damaged`."""
    change = rng.choice([mutate_bytes, mutate_values])
    place.write_bytes(change(seed.read_bytes(), rng))


def outcome(path: Path) -> tuple[Outcome, str]:
    """All cases of the campaign, or problems."""
    from drake_landing.campaign.cases import load_campaign
    from drake_landing.campaign.run import expand

    if path.suffix == ".csv":
        campaign = path.with_name("tried_with_table.yaml")
        campaign.write_text(_TEXT.replace("table.csv", path.name), encoding="utf-8")
        path = campaign
    try:
        rows, found = expand(load_campaign(path))
    except InputError:
        return Outcome.message, ""
    alike = len(rows) == len(found) > 0
    return (Outcome.right, "") if alike else (Outcome.bad, "no cases, no message")
