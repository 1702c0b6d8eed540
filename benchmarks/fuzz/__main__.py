"""Damages matrix files, decks and cases for a time: tried, message, right, bad.

    python -m benchmarks.fuzz [SECONDS] [SEED]

What ends in neither a message nor an answer is kept in out/fuzz, with its seed in its
name; the exit status is then 1.
"""

import random
import shutil
import sys
import tempfile
import time
import traceback
from collections import Counter
from pathlib import Path

from benchmarks.fuzz import matrices
from benchmarks.fuzz.mutations import mutate_bytes
from benchmarks.fuzz.outcome import Outcome
from drake_landing.case.reading import load_case
from fem.deck.reader import read_deck
from fem.errors import InputError

_CASES = Path(__file__).parents[2] / "cases"
_KEPT = Path("out", "fuzz")


def _reading(read):
    def outcome(path: Path) -> Outcome:
        try:
            read(path)
        except InputError:
            return Outcome.message
        return Outcome.right

    return outcome


def _changed(seed: Path, rng: random.Random, place: Path) -> None:
    place.write_bytes(mutate_bytes(seed.read_bytes(), rng))


def main(seconds: float, first: int) -> int:
    """Exit status.

    Args:
        seconds: how long.
        first: seed.
    """
    found: dict[str, Counter[str]] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        good = folder / "good"
        good.mkdir()
        kinds = {
            "matrices": (matrices.seeds(good), matrices.damaged, matrices.outcome),
            "cases": (sorted(_CASES.glob("*.yaml")), _changed, _reading(load_case)),
            "decks": ([_CASES / "commuter/wing.inc"], _changed, _reading(read_deck)),
        }
        end, seed = time.monotonic() + seconds, first
        while time.monotonic() < end:
            for kind, (seeds, damage, outcome) in kinds.items():
                rng = random.Random(f"{kind}{seed}")
                source = rng.choice(seeds)
                place = folder / f"tried{source.suffix}"
                damage(source, rng, place)
                try:
                    result = outcome(place)
                except Exception:
                    result = Outcome.bad
                    print(f"{kind}, seed {seed}:\n{traceback.format_exc(limit=-3)}")
                if result is Outcome.bad:
                    _KEPT.mkdir(parents=True, exist_ok=True)
                    shutil.copy(place, _KEPT / f"{kind}_{seed}{source.suffix}")
                found.setdefault(kind, Counter())[result.value] += 1
            seed += 1
    print(f"seeds {first} to {seed - 1}")
    for kind, counts in found.items():
        figures = ", ".join(f"{o.value} {counts[o.value]}" for o in Outcome)
        print(f"{kind}: tried {counts.total()}, {figures}")
    return int(any(counts["bad"] for counts in found.values()))


if __name__ == "__main__":
    length = float(sys.argv[1]) if len(sys.argv) > 1 else 1500.0
    start = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    sys.exit(main(length, start))
