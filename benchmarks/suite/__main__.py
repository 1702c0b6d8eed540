"""python -m benchmarks.suite DIR"""

import argparse
import json
import re
from collections import Counter
from dataclasses import asdict
from pathlib import Path

from benchmarks.suite.decks import VERDICTS, Outcome, judge, pairs


def main() -> None:
    """Judge all decks of a folder, say what is missing most."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.suite")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", default="", help="part of the deck's path")
    parser.add_argument("--seconds", type=float, default=60.0, help="for one deck")
    parser.add_argument("--json", type=Path, help="file for all outcomes")
    asked = parser.parse_args()
    outcomes = []
    for deck, reference in pairs(asked.folder):
        if asked.only not in str(deck):
            continue
        outcome = judge(deck, reference, asked.folder, asked.seconds)
        outcomes.append(outcome)
        why = "; ".join(outcome.why[:4])
        print(f"{outcome.verdict:18s}{outcome.deck}: {why}"[:400], flush=True)
    print(summary(outcomes))
    if asked.json:
        asked.json.write_text(json.dumps([asdict(o) for o in outcomes], indent=1))


def summary(outcomes: list[Outcome]) -> str:
    """Counts, tables that differ, and reasons of refusals, most frequent first."""
    count = Counter(outcome.verdict for outcome in outcomes)
    lines = ["", ", ".join(f"{name} {count[name]}" for name in VERDICTS), ""]
    differing = Counter(name for o in outcomes for name in o.beyond)
    lines += [f"{n:4d} x differs: {name}" for name, n in differing.most_common()]
    refused = [o for o in outcomes if o.verdict == "refused"]
    reasons = Counter(kind for o in refused for kind in kinds(o.why))
    alone = Counter(k for o in refused for k in kinds(o.why) if len(kinds(o.why)) == 1)
    lines += [
        f"{n:4d} x refused ({alone[kind]} by this alone): {kind}"
        for kind, n in reasons.most_common(40)
    ]
    return "\n".join(lines)


def kinds(problems: list[str]) -> set[str]:
    """Problems without their places and numbers."""
    plain = (re.sub(r"^\S+?:(\d+:)?\s*", "", text) for text in problems)
    return {re.sub(r"-?\d[\d.,e+-]*", "N", text)[:90] for text in plain}


if __name__ == "__main__":
    main()
