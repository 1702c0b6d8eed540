"""python -m benchmarks.suite DIR"""

import argparse
import json
import re
from collections import Counter
from dataclasses import asdict
from pathlib import Path

from benchmarks.suite.decks import VERDICTS, Outcome, decks, judge


def main() -> None:
    """Judge all decks of a folder, say what is missing most."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.suite")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", default="", help="part of the deck's path")
    parser.add_argument("--seconds", type=float, default=60.0, help="for one deck")
    parser.add_argument("--json", type=Path, help="file for all outcomes")
    parser.add_argument(
        "--all", action="store_true", help="decks without results beside them, too"
    )
    asked = parser.parse_args()
    outcomes = []
    for deck, references in decks(asked.folder):
        if asked.only not in str(deck) or not (references or asked.all):
            continue
        outcome = judge(deck, references, asked.folder, asked.seconds)
        outcomes.append(outcome)
        why = "; ".join(outcome.why[:4])
        verdict = outcome.verdict if outcome.declared else "other solution"
        print(f"{verdict:18s}{outcome.deck}: {why}"[:400], flush=True)
    print(summary(outcomes))
    if asked.json:
        asked.json.write_text(json.dumps([asdict(o) for o in outcomes], indent=1))


def summary(outcomes: list[Outcome]) -> str:
    """Counts, tables that differ, and reasons of refusals, most frequent first."""
    lines = ["", *_by_solution(outcomes), ""]
    differing = Counter(name for o in outcomes for name in o.beyond)
    lines += [f"{n:4d} x differs: {name}" for name, n in differing.most_common()]
    refused = [o for o in outcomes if o.verdict == "refused" and o.declared]
    reasons = Counter(kind for o in refused for kind in kinds(o.why))
    alone = Counter(k for o in refused for k in kinds(o.why) if len(kinds(o.why)) == 1)
    lines += [
        f"{n:4d} x refused ({alone[kind]} by this alone): {kind}"
        for kind, n in reasons.most_common(40)
    ]
    return "\n".join(lines)


def _by_solution(outcomes: list[Outcome]) -> list[str]:
    """Verdicts of the decks in the solutions here; the others are counted apart."""
    declared = [o for o in outcomes if o.declared]
    lines = [_counts("all", declared)]
    for number in sorted({o.solution for o in declared}):
        own = [o for o in declared if o.solution == number]
        lines.append(_counts(f"SOL {number}" if number else "SOL unknown", own))
    others = Counter(o.solution for o in outcomes if not o.declared)
    said = ", ".join(f"{number} ({n})" for number, n in sorted(others.items()))
    crashed = sum(o.verdict == "crashed" for o in outcomes if not o.declared)
    lines.append(f"other solutions: {sum(others.values())}, crashed {crashed}; {said}")
    return lines


def _counts(name: str, outcomes: list[Outcome]) -> str:
    count = Counter(outcome.verdict for outcome in outcomes)
    return f"{name}: " + ", ".join(
        f"{verdict} {count[verdict]}" for verdict in VERDICTS
    )


def kinds(problems: list[str]) -> set[str]:
    """Problems without their places and numbers."""
    plain = (re.sub(r"^\S+?:(\d+:)?\s*", "", text) for text in problems)
    return {re.sub(r"-?\d[\d.,e+-]*", "N", text)[:90] for text in plain}


if __name__ == "__main__":
    main()
