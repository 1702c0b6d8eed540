"""A store of costly arrays, found again by the content that they were computed from.

An entry is a folder `<kind>-<key>` with one `.npy` file per array and `entry.json`,
which lists checksums, has one of its own, and is written last. Arrays with NaN are
never kept. The key is a hash of everything that the arrays depend on: matrices,
settings, and the version of this format. Changed
input has another key; an entry that is damaged, incomplete or of another format is
deleted and computed anew. Nothing else is ever trusted or kept open, so the folder may
be deleted at any time.

Location: the environment's DRAKE_LANDING_CACHE, else the user's cache folder (Linux:
~/.cache/drake-landing). DRAKE_LANDING_CACHE=off keeps nothing. Entries that have not
been used for longest are deleted where all take more than DRAKE_LANDING_CACHE_GB, by
default 8.
"""

import hashlib
import json
import math
import os
import shutil
import tempfile
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import cache as once
from importlib.resources import files
from pathlib import Path

import numpy as np
import numpy.typing as npt
import platformdirs
import scipy.sparse as sp

from fem.errors import InputError

Arrays = dict[str, npt.NDArray]

FORMAT = 2  # of entries, and of what the program stores in them
_MANIFEST = "entry.json"
_CHUNK = 1 << 24
_ASIDE = ".part-"
_ABANDONED = 86_400.0  # s after which what is written aside has no writer any more


class Cache:
    """Entries in one folder.

    Args:
        folder: made when it is needed; None: nothing is kept.
        limit_gb: size beyond which the longest unused entries go.
    """

    def __init__(self, folder: Path | None, limit_gb: float = 8.0) -> None:
        self.folder = folder
        self.limit_gb = limit_gb

    @classmethod
    def of_user(cls) -> "Cache":
        """The cache where environment and platform say.

        Raises:
            InputError: DRAKE_LANDING_CACHE_GB is no size.
        """
        place = os.environ.get("DRAKE_LANDING_CACHE", "")
        limit = _gigabytes(os.environ.get("DRAKE_LANDING_CACHE_GB", ""))
        if place.lower() == "off":
            return cls(None)
        folder = Path(place or platformdirs.user_cache_dir("drake-landing"))
        return cls(folder, limit)

    def arrays(self, kind: str, key: str, build: Callable[[], Arrays]) -> Arrays:
        """The arrays of an entry; built, and kept, where there is no sound one.

        Args:
            kind: what they are, for people who look into the folder.
            key: of `content_key`.
            build: computes them.
        """
        found = self.find(kind, key)
        if found is not None:
            return found
        arrays = build()
        self.keep(kind, key, arrays)
        return arrays

    def find(self, kind: str, key: str) -> Arrays | None:
        """The arrays of an entry, None where there is no sound one."""
        return self._load(self.folder / f"{kind}-{key}") if self.folder else None

    def keep(self, kind: str, key: str, arrays: Mapping[str, npt.NDArray]) -> None:
        """Makes or replaces an entry; arrays with NaN are not kept."""
        if self.folder is None or any(map(_has_nan, arrays.values())):
            return
        place = self.folder / f"{kind}-{key}"
        with suppress(OSError):  # a full or read-only disk costs time, not the result
            self._store(place, arrays)
            self._make_room(keep=place)

    def entries(self) -> dict[str, int]:
        """Name of each entry -> bytes, the longest unused one first."""
        return {place.name: size for _, size, place in sorted(self._entries())}

    def clear(self) -> None:
        """Deletes all entries."""
        for _, _, place in self._entries():
            shutil.rmtree(place, ignore_errors=True)

    def _entries(self) -> list[tuple[float, int, Path]]:
        """Time of last use, bytes and folder of each."""
        if self.folder is None or not self.folder.is_dir():
            return []
        found = []
        for place in self.folder.iterdir():
            with suppress(OSError):  # another process deletes it
                if (place / _MANIFEST).is_file():
                    size = sum(f.stat().st_size for f in place.iterdir())
                    found.append((place.stat().st_mtime, size, place))
        return found

    def _load(self, place: Path) -> Arrays | None:
        if not place.is_dir():
            return None
        try:
            manifest = json.loads((place / _MANIFEST).read_text(encoding="utf-8"))
            checksums = manifest["arrays"]
            if manifest != _manifest(checksums):
                raise ValueError("damaged, or of another format")
            arrays = {}
            for name, checksum in checksums.items():
                if _checksum(place / f"{name}.npy") != checksum:
                    raise ValueError("damaged")
                arrays[name] = np.load(place / f"{name}.npy", allow_pickle=False)
            os.utime(place)
        except (
            OSError,
            LookupError,
            ValueError,
            TypeError,
            AttributeError,
            RecursionError,
        ):
            shutil.rmtree(place, ignore_errors=True)
            return None
        return arrays

    def _store(self, place: Path, arrays: Mapping[str, npt.NDArray]) -> None:
        """Written aside, then renamed: a reader never meets half an entry."""
        place.parent.mkdir(parents=True, exist_ok=True)
        aside = Path(tempfile.mkdtemp(prefix=_ASIDE, dir=place.parent))
        try:
            checksums = {}
            for name, values in arrays.items():
                file = aside / f"{name}.npy"
                np.save(file, values, allow_pickle=False)
                checksums[name] = _checksum(file)
            text = json.dumps(_manifest(checksums), indent=1)
            (aside / _MANIFEST).write_text(text, encoding="utf-8")
            shutil.rmtree(place, ignore_errors=True)
            aside.rename(place)
        finally:
            shutil.rmtree(aside, ignore_errors=True)

    def _make_room(self, keep: Path) -> None:
        for left in keep.parent.glob(f"{_ASIDE}*"):  # by a process that was killed
            if time.time() - left.stat().st_mtime > _ABANDONED:
                shutil.rmtree(left, ignore_errors=True)
        entries = self._entries()
        total = sum(size for _, size, _ in entries)
        for _, size, place in sorted(entries):
            if total <= 1e9 * self.limit_gb:
                return
            if place != keep:
                shutil.rmtree(place, ignore_errors=True)
                total -= size


def content_key(*parts: object) -> str:
    """32 hexadecimal digits of the content of parts.

    Args:
        parts: None, numbers, strings, arrays, sparse matrices, and tuples, lists and
            dictionaries of these.
    """
    digest = hashlib.blake2b(digest_size=16)
    _feed(digest, [FORMAT, *parts])
    return digest.hexdigest()


def _feed(digest: "hashlib._Hash", part: object) -> None:
    """Everything with its type and size: different parts give different bytes."""
    if part is None or isinstance(part, bool | int | float | str):
        digest.update(f"{type(part).__name__}:{part!r};".encode())
    elif isinstance(part, np.generic):
        _feed(digest, part.item())
    elif isinstance(part, np.ndarray):
        digest.update(f"array:{part.dtype.str}{part.shape};".encode())
        digest.update(np.ascontiguousarray(part).data.cast("B") if part.size else b"")
    elif sp.issparse(part):
        matrix = sp.csr_matrix(part)
        matrix.sum_duplicates()
        matrix.sort_indices()
        _feed(digest, ["sparse", list(matrix.shape), matrix.data])
        _feed(digest, [matrix.indices.astype(np.int64), matrix.indptr.astype(np.int64)])
    elif isinstance(part, Mapping):
        digest.update(f"map:{len(part)};".encode())
        for key, value in part.items():
            _feed(digest, [key, value])
    elif isinstance(part, list | tuple):
        digest.update(f"list:{len(part)};".encode())
        for item in part:
            _feed(digest, item)
    else:
        raise TypeError(f"{type(part).__name__} has no content key")


def _gigabytes(text: str) -> float:
    """A size of the environment, by default 8."""
    try:
        size = float(text or 8.0)
    except ValueError:
        size = math.nan
    if not 0.0 <= size < math.inf:
        raise InputError(
            f"DRAKE_LANDING_CACHE_GB: found '{text}', expected gigabytes, a number "
            "of 0 or more"
        )
    return size


def _has_nan(values: npt.NDArray) -> bool:
    return values.dtype.kind in "fc" and bool(np.isnan(values).any())


def _manifest(checksums: Mapping[str, str]) -> dict[str, object]:
    """What is written of an entry, with a checksum of its own."""
    own = content_key(dict(checksums))
    return {"format": FORMAT, "arrays": dict(checksums), "checksum": own}


def _checksum(file: Path) -> str:
    digest = hashlib.blake2b(digest_size=16)
    with file.open("rb") as stream:
        while block := stream.read(_CHUNK):
            digest.update(block)
    return digest.hexdigest()


@once
def source_key(*packages: str) -> str:
    """Hash of the program text of packages and of all below them."""
    texts = [
        file.read_text(encoding="utf-8")
        for package in packages
        for file in sorted(Path(str(files(package))).rglob("*.py"))
    ]
    return content_key(texts)
