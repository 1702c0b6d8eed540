"""Case files, damaged: `check` explains them, or says what is wrong."""

import random
import shutil
from pathlib import Path

from benchmarks.fuzz.mutations import mutate_bytes, mutate_values
from benchmarks.fuzz.outcome import Outcome, of_command

_TESTS = Path(__file__).parents[2] / "tests" / "drake_landing"
# What the tiny case leaves out, so that mutations reach it.
_MORE = """\
parts:
  equipment: {battery: 4}
  panels: [{name: floor, grid: 5, beside: [4, 6]}]
  beams: [{name: wing, outward: starboard, first: 1.0, last: 4.0, count: 2}]
"""


def seeds(folder: Path) -> list[Path]:
    """Two good cases with their deck.

    Args:
        folder: for them.
    """
    shutil.copy(_TESTS / "tiny_aircraft.bdf", folder)
    text = (_TESTS / "tiny_case.yaml").read_text(encoding="utf-8")
    plain, more = folder / "plain.yaml", folder / "more.yaml"
    plain.write_text(text, encoding="utf-8")
    scenario = "{preset: two_point, sink_rate: 1.2, pitch: 4, lift: weight}"
    fuller = text.replace("{sink_rate: 1.2, forward_speed: 40}", scenario)
    more.write_text(fuller + _MORE, encoding="utf-8")
    return [plain, more]


def damaged(seed: Path, rng: random.Random, place: Path) -> None:
    """Writes a damaged copy of a case: bytes, or numbers that are absurd but finite.

    Args:
        seed: good file.
        rng: decides what happens to it.
        place: of the copy, beside the deck.
    """
    change = rng.choice([mutate_bytes, mutate_values, mutate_values])
    place.write_bytes(change(seed.read_bytes(), rng))


def outcome(path: Path) -> tuple[Outcome, str]:
    """Of `drake-landing check`."""
    from drake_landing.cli import app

    return of_command(app, "check", path)
