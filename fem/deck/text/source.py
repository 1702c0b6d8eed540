"""Lines of a deck with all its INCLUDE files, each with the place it comes from.

A deck of other people must not read what its user can read: INCLUDE reaches the folder
of the deck, all below it, and folders that the user adds (`--include-path`,
`airframe.include_paths`); `--trust` lifts that. Links count where they lead. Depth,
number and size of files are limited.
"""

import os
import shlex
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from fem.errors import InputError

_LONGEST_PATH = 20  # lines over which the path of an INCLUDE may be split


_DEEPEST = 20  # INCLUDEs within each other
_MOST_FILES = 2_000
_MOST_BYTES = 4_000_000_000  # of all files; a deck of ten million grids has less
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")
_LONGEST_LINE = 10_000  # characters; a path on one line may be long


@dataclass(frozen=True)
class Reach:
    """Folders that INCLUDE may read beside that of the deck.

    Attributes:
        folders: that the user adds, searched too.
        everything: no limits of place.
    """

    folders: tuple[Path, ...] = ()
    everything: bool = False


_reach: ContextVar[Reach] = ContextVar("reach", default=Reach())  # noqa: B039 (frozen)


@contextmanager
def include_reach(
    folders: Sequence[Path] = (), *, trust: bool = False
) -> Iterator[None]:
    """Decks that are read within may include files of these folders.

    Args:
        folders: beside the deck's own.
        trust: any file.
    """
    outer = _reach.get()
    reach = Reach((*outer.folders, *folders), trust or outer.everything)
    token = _reach.set(reach)
    try:
        yield
    finally:
        _reach.reset(token)


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
    files: int = 0
    bytes: int = 0


def read_source(path: Path) -> Source:
    """Read a deck and, in place, the files that it includes.

    Raises:
        InputError: the deck is missing, a folder, binary, includes itself or what
            it may not.
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
    if len(parents) > _DEEPEST:
        raise InputError(f"{shown}: INCLUDE more than {_DEEPEST} deep")
    source.files += 1
    if source.files > _MOST_FILES:
        raise InputError(f"{shown}: INCLUDE of more than {_MOST_FILES:,} files")
    texts = _text(source, path, shown).split("\n")
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
        folders = (path.parent, home, *_reach.get().folders, Path.cwd())
        found = _find(name, folders) if name else None
        if found is None:
            source.lines.append(Line(text.strip(), shown, start, missing=True))
            continue
        file, how = found
        _check_reach(file, home, f"{shown}:{start}")
        if how:
            source.notices.append(
                f"{shown}:{start}: INCLUDE '{name}' is not there; {file}, {how}, "
                "is read"
            )
        _append(source, file, str(file), home, (*parents, resolved))


def _check_reach(file: Path, home: Path, place: str) -> None:
    """An INCLUDE stays where it may read."""
    reach = _reach.get()
    resolved = file.resolve()
    allowed = [folder.resolve() for folder in (home, *reach.folders)]
    if reach.everything or any(resolved.is_relative_to(a) for a in allowed):
        return
    raise InputError(
        f"{place}: INCLUDE of {file}, outside the folder of the deck; if that is "
        f"meant: --include-path {shlex.quote(str(resolved.parent))}, "
        "airframe.include_paths of a case, or --trust"
    )


def found_file(name: str, deck: Path) -> Path:
    """A file that a deck names, as INCLUDE would find it.

    Raises:
        InputError: there is none, or it is where a deck may not read.
    """
    folders = (deck.parent, *_reach.get().folders, Path.cwd())
    found = _find(name, folders)
    if found is None:
        raise InputError(f"{deck}: the file {name} is not there")
    _check_reach(found[0], deck.parent, str(deck))
    return found[0]


def _text(source: Source, path: Path, shown: str) -> str:
    try:
        if path.exists() and not (path.is_file() or path.is_dir()):
            raise InputError(f"{shown}: is a device, expected a file")
        source.bytes += path.stat().st_size
        if source.bytes > _MOST_BYTES:
            size = f"{source.bytes / 1e9:,.1f} GB"
            raise InputError(f"{shown}: the deck and its INCLUDEs have {size}")
        data = path.read_bytes()
    except FileNotFoundError:
        raise InputError(f"{shown}: no such file") from None
    except OSError as error:
        raise InputError(f"{shown}: {error.strerror}") from None
    if b"\0" in data:
        kind = "text in UTF-16" if data[:2] in _UTF_16 else "not a text file"
        raise InputError(f"{shown}: {kind}; expected a Nastran deck")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    if len(text) > _LONGEST_LINE and (longest := max(map(len, text.split("\n")))) > (
        _LONGEST_LINE
    ):
        raise InputError(f"{shown}: a line of {longest:,} characters")
    return text


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
