"""Lines of a deck with all its INCLUDE files, each with the place it comes from."""

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from fem.errors import InputError

_LONGEST_PATH = 20  # lines over which the path of an INCLUDE may be split


class Line(NamedTuple):
    """One line of text, without tabs and line end.

    `missing` marks an INCLUDE whose file is not there; whether that matters depends on
    the section of the deck, which is not known yet.
    """

    text: str
    file: str
    number: int
    missing: bool = False


@dataclass
class Source:
    """All lines of a deck in reading order, and what was remarkable about them."""

    lines: list[Line] = field(default_factory=list)
    notices: list[str] = field(default_factory=list)


def read_source(path: Path) -> Source:
    """Read a deck and, in place, the files that it includes.

    Raises:
        InputError: the deck is missing, a folder, binary, or includes itself.
    """
    source = Source()
    _append(source, path, str(path), path.parent, ())
    return source


def _append(
    source: Source, path: Path, shown: str, home: Path, parents: tuple[Path, ...]
) -> None:
    resolved = path.resolve()
    if resolved in parents:
        raise InputError(f"{shown}: the file includes itself")
    texts = _text(path, shown).split("\n")
    number = 0
    while number < len(texts):
        text = texts[number].expandtabs(8).rstrip()
        number += 1
        first = text[:12].lstrip()[:7].upper()
        if first != "INCLUDE":
            source.lines.append(Line(text, shown, number))
            continue
        start = number
        name, number = _included_name(texts, number)
        found = _find(name, (path.parent, home, Path.cwd())) if name else None
        if found is None:
            source.lines.append(Line(text.strip(), shown, start, missing=True))
            continue
        file, how = found
        if how:
            source.notices.append(
                f"{shown}:{start}: INCLUDE '{name}' is not there; {file}, {how}, "
                "is read"
            )
        _append(source, file, str(file), home, (*parents, resolved))


def _text(path: Path, shown: str) -> str:
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        raise InputError(f"{shown}: no such file") from None
    except OSError as error:
        raise InputError(f"{shown}: {error.strerror}") from None
    if b"\0" in data:
        raise InputError(f"{shown}: not a text file; expected a Nastran deck")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _included_name(texts: list[str], number: int) -> tuple[str, int]:
    """File name of the INCLUDE that ends or begins at line `number`, and its last line.

    A quoted name may go on over several lines; without its closing quote it is empty.
    """
    rest = texts[number - 1].strip()[7:].strip().lstrip("=").strip()
    if not rest or rest[0] not in "'\"":
        return rest.split("$")[0].split(" ")[0].strip(), number
    quote, name = rest[0], rest[1:]
    last = number
    while quote not in name:
        if last == len(texts) or last - number > _LONGEST_PATH:
            return "", number
        name += texts[last].strip()
        last += 1
    return name.split(quote)[0].strip(), last


def _find(name: str, folders: tuple[Path, ...]) -> tuple[Path, str] | None:
    """The file of that name, and what led to it where it was not the name as it stands.

    `$NAME` and `${NAME}` are environment variables, as is the logical name before a
    colon (NAME:file).
    """
    wanted = Path(_without_variables(name).replace("\\", "/"))
    for folder in folders:
        if (file := _regardless_of_case(folder, wanted)) is not None:
            exact = str(file) == str(folder / wanted)
            return file, "" if exact else "whose name differs in letter case"
    for folder in folders[:2]:
        if (file := _regardless_of_case(folder, Path(wanted.name))) is not None:
            return file, "of the same name"
    return None


def _without_variables(name: str) -> str:
    logical, colon, rest = name.partition(":")
    # One letter is a drive.
    if colon and len(logical) > 1 and logical in os.environ:
        return f"{os.environ[logical]}/{rest}"
    return os.path.expandvars(name)


def _regardless_of_case(folder: Path, wanted: Path) -> Path | None:
    """The file of a path below a folder, each part as it stands or in other case."""
    try:
        if (folder / wanted).is_file():
            return folder / wanted
        found = Path(wanted.anchor) if wanted.is_absolute() else folder
        for part in wanted.parts[wanted.is_absolute() :]:
            if part in ("..", ".") or (found / part).exists():
                found = found / part
                continue
            alike = (f for f in found.iterdir() if f.name.lower() == part.lower())
            if (found := next(alike, None)) is None:
                return None
        return found if found.is_file() else None
    except (OSError, ValueError):
        return None
