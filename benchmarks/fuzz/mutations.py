"""What befalls files: bits flipped, parts cut, doubled, moved; numbers that lie."""

import random
import re

_NUMBER = re.compile(rb"-?\d+\.?\d*(?:[EeDd][+-]?\d+)?")
_NUMBERS = [
    b"0",
    b"-1",
    b"1",
    b"2147483647",
    b"99999999",
    b"-99999999999",
    b"1e308",
    b"1.0E+400",
    b"NaN",
    b"inf",
    b"1.",
    b"",
    b"0.5",
    b"010",
    b"yes",
]
_BYTES = [b"\0", b"\xff", b"\n", b"*", b"$", b"'", b'"', b"\t", b",", b"[", b"{", b"&"]


def mutate_bytes(data: bytes, rng: random.Random) -> bytes:
    """A file with one, two or four places changed.

    Args:
        data: of a good file.
        rng: decides all.
    """
    for _ in range(rng.choice([1, 1, 2, 4])):
        data = rng.choice(_ACTIONS)(data, rng)
    return data


_ABSURD = [
    *("0", "-1", "0.0", "1e-300", "1e300", "-1e300", "1e15", "-1e9", "1e9", "1e6"),
    *("1000000000", "2147483648", "-2147483649", "99999999999999999999", "1e-9"),
]


def mutate_values(data: bytes, rng: random.Random) -> bytes:
    """A file with one, two or three numbers that are absurd but finite.

    Args:
        data: of a good file.
        rng: decides all.
    """
    for _ in range(rng.choice([1, 1, 2, 3])):
        found = list(_NUMBER.finditer(data))
        if not found:
            return data
        match = rng.choice(found)
        new = rng.choice(_ABSURD).encode()
        data = data[: match.start()] + new + data[match.end() :]
    return data


def _flip(data: bytes, rng: random.Random) -> bytes:
    changed = bytearray(data)
    for _ in range(rng.choice([1, 3, 10])):
        if changed:
            changed[rng.randrange(len(changed))] ^= 1 << rng.randrange(8)
    return bytes(changed)


def _cut(data: bytes, rng: random.Random) -> bytes:
    return data[: rng.randrange(len(data) + 1)]


def _remove(data: bytes, rng: random.Random) -> bytes:
    at = rng.randrange(len(data) + 1)
    return data[:at] + data[at + rng.choice([1, 8, 100]) :]


def _double(data: bytes, rng: random.Random) -> bytes:
    at, length = rng.randrange(len(data) + 1), rng.choice([4, 80, 1000])
    return data[: at + length] + data[at:]


def _insert(data: bytes, rng: random.Random) -> bytes:
    at = rng.randrange(len(data) + 1)
    return data[:at] + rng.choice(_BYTES) * rng.choice([1, 1, 1, 50]) + data[at:]


def _number(data: bytes, rng: random.Random) -> bytes:
    """One of the numbers of a text."""
    found = list(_NUMBER.finditer(data))
    if not found:
        return data
    match = rng.choice(found)
    new = rng.choice(_NUMBERS).rjust(len(match[0]))
    return data[: match.start()] + new + data[match.end() :]


def _word(data: bytes, rng: random.Random) -> bytes:
    """Four or eight bytes of a binary file."""
    size = rng.choice([4, 8])
    at = rng.randrange(max(1, len(data) // size)) * size
    value = rng.choice([0, -1, 1, 2**31 - 1, -(2**31), 10_000_000, 255])
    new = value.to_bytes(size, rng.choice(["little", "little", "big"]), signed=True)
    return data[:at] + new + data[at + size :]


def _line(data: bytes, rng: random.Random) -> bytes:
    """A line lost, doubled or moved."""
    lines = data.split(b"\n")
    line = lines.pop(rng.randrange(len(lines)))
    for _ in range(rng.choice([0, 1, 1, 2])):
        lines.insert(rng.randrange(len(lines) + 1), line)
    return b"\n".join(lines)


_ACTIONS = [_flip, _cut, _remove, _double, _insert, _number, _number, _word, _line]
