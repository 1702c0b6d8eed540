"""What befalls decks: slips of editors, programs and transfers, at random."""

import random

JUNK = [
    "X",
    "1.",
    "-1",
    "1.+",
    ",",
    "$",
    "*",
    "+",
    "THRU",
    "99999999999999",
    "é",
    "=",
    "",
]


def mutate(text: str, rng: random.Random) -> str:
    """A deck with one, two or four lines deleted, doubled, cut, joined or changed."""
    lines = text.split("\n")
    for _ in range(rng.choice([1, 1, 2, 4])):
        k = rng.randrange(len(lines))
        line = lines[k]
        at = rng.randrange(len(line) + 1)
        action = rng.randrange(9)
        if action == 0:
            del lines[k]
        elif action == 1:
            lines.insert(rng.randrange(len(lines)), line)
        elif action == 2:
            lines[k] = line[:at] + rng.choice(JUNK) + line[at:]
        elif action == 3:
            lines[k] = line[:at] + line[at + 1 :]
        elif action == 4:
            lines[k] = line[:at]
        elif action == 5:
            lines = lines[: k + 1]
        elif action == 6:
            fields = line.split(",")
            fields[rng.randrange(len(fields))] = rng.choice(JUNK)
            lines[k] = ",".join(fields)
        elif action == 7:
            other = rng.randrange(len(lines))
            lines[k], lines[other] = lines[other], lines[k]
        else:
            lines[k] = line + lines[(k + 1) % len(lines)]
        if not lines:
            return ""
    return "\n".join(lines)
