"""How a run was made: program, host, files and checksums; read back and verified.

Provenance.begin(case, aircraft, out)  ->  group `provenance` of results.h5
read_provenance(folder)  ->  lines, and which files are not what they were
"""

import hashlib
import importlib.metadata
import json
import os
import platform
import subprocess
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

import h5py
import numpy as np

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.case.schema import Case
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.versions import versions
from fem.algebra.linear_solver.pardiso import pardiso_is_available
from fem.errors import InputError

_GROUP = "provenance"
_OWN = Path(__file__).resolve().parents[2]


@dataclass(frozen=True, kw_only=True)
class FileMark:
    """A file that a run has read.

    Attributes:
        role: case, deck, include or matrices.
        path: relative to the folder of the results.
        sha256: of its bytes as they were read.
    """

    role: str
    path: str
    sha256: str


@dataclass(frozen=True, kw_only=True)
class Provenance:
    """What one run was made from.

    Attributes:
        facts: what -> value, in the order of reading.
        files: that were read.
        gears: all gear data as used, JSON, defaults written out.
        gears_sha256: of that text.
    """

    facts: dict[str, str]
    files: tuple[FileMark, ...]
    gears: str
    gears_sha256: str = field(default="")

    @classmethod
    def begin(cls, case: Case, aircraft: Aircraft, out: Path) -> "Provenance":
        """Provenance at the start of a run, before a file can change."""
        gears = gears_text(aircraft.gears)
        return cls(
            facts={
                "load case": case.name,
                "started": datetime.now().astimezone().isoformat(timespec="seconds"),
                **_program(),
                **_host(),
                "gear data": _gear_source(case),
            },
            files=tuple(_marks(case, aircraft, out)),
            gears=gears,
            gears_sha256=_sha256(gears.encode()),
        )

    def write(self, file: h5py.File, seconds: float) -> None:
        """Writes the group `provenance`; `seconds`: the duration of the run so far."""
        group = file.create_group(_GROUP)
        facts = self.facts | {"duration": f"{seconds:.1f} s until results.h5"}
        for name, value in facts.items():
            group.attrs[name] = value
        group.attrs["order"] = list(facts)
        text = h5py.string_dtype()
        for name in ("role", "path", "sha256"):
            column = [getattr(mark, name) for mark in self.files]
            group.create_dataset(f"files/{name}", data=column, dtype=text)
            group[f"files/{name}"].attrs["unit"] = "1"
        group.create_dataset("gears", data=self.gears, dtype=text)
        group["gears"].attrs["unit"] = "SI, see the schema of the case"
        group["gears"].attrs["sha256"] = self.gears_sha256

    def lines(self) -> list[tuple[str, str]]:
        """What, and its value: facts, files, gears."""
        marks = [(f"{m.role} {m.path}", f"sha256 {m.sha256}") for m in self.files]
        return [
            *self.facts.items(),
            *marks,
            ("gear data as used", f"sha256 {self.gears_sha256}"),
        ]

    def changes(self, folder: Path) -> list[str]:
        """Files of which the checksum is another now, or that are not there."""
        found = [_change(mark, folder) for mark in self.files]
        if _sha256(self.gears.encode()) != self.gears_sha256:
            found.append("results.h5: the gear data are not those of the run")
        return [text for text in found if text]


def read_provenance(folder: Path) -> Provenance:
    """Provenance of the results in a folder.

    Raises:
        InputError: it holds none.
    """
    path = folder / "results.h5"
    if not path.is_file():
        raise InputError(
            f"{folder}: found no results.h5, expected the results of a run"
        )
    try:
        with h5py.File(path) as file:
            if _GROUP not in file:
                raise InputError(
                    f"{path}: does not say how it was made (older program)"
                )
            group = file[_GROUP]
            columns = [
                group[f"files/{n}"].asstr()[:] for n in ("role", "path", "sha256")
            ]
            return Provenance(
                facts={
                    str(n): str(group.attrs[n])
                    for n in np.asarray(group.attrs["order"])
                },
                files=tuple(
                    FileMark(role=r, path=p, sha256=s) for r, p, s in zip(*columns)
                ),
                gears=group["gears"].asstr()[()],
                gears_sha256=str(group["gears"].attrs["sha256"]),
            )
    except InputError:
        raise
    except OSError as error:
        raise InputError(f"{path}: is no HDF5 file: {error}") from None
    except (LookupError, TypeError, ValueError, AttributeError, RuntimeError) as error:
        raise InputError(
            f"{path}: does not say how it was made as this program would: {error}"
        ) from None


def gears_text(gears: Sequence[LandingGear]) -> str:
    """All data of the gears, defaults written out; what is empty is left out."""
    data = [gear.model_dump(mode="json", exclude_none=True) for gear in gears]
    return json.dumps(data, indent=1, sort_keys=True)


def _gear_source(case: Case) -> str:
    if not isinstance(case.gears, str):
        return f"the case file {case.places.file}".rstrip()
    return (
        f"built-in set '{case.gears}': sources value by value at the head of "
        "drake_landing/reference/d150/data/gears.yaml, abbreviations in its README.md"
    )


def _program() -> dict[str, str]:
    found = versions()
    mkl = importlib.metadata.version("mkl") if pardiso_is_available() else ""
    solver = f"PARDISO of MKL {mkl}" if mkl else f"SuperLU of scipy {found['scipy']}"
    return {
        "program": f"drake-landing {found.pop('drake-landing')}, commit {_commit()}",
        "Drake": found.pop("drake"),
        "linear solver": solver,
        "packages": ", ".join(f"{k} {v}" for k, v in found.items()),
    }


def _commit() -> str:
    """Commit of the source tree or of the installation, marked where files differ."""
    try:
        git = ["git", "--no-optional-locks", "-C", str(_OWN)]  # writes nothing
        top = _output([*git, "rev-parse", "--show-toplevel"])
        if Path(top).resolve() == _OWN:
            changed = _output([*git, "status", "--porcelain", "-uno"])
            head = _output([*git, "rev-parse", "HEAD"])
            return head + (", with local changes" if changed else "")
    except (OSError, subprocess.SubprocessError):
        pass
    text = importlib.metadata.distribution("drake-landing").read_text("direct_url.json")
    info = json.loads(text or "{}").get("vcs_info", {})
    return info.get("commit_id", "not known (no source tree)")


def _output(command: list[str]) -> str:
    done = subprocess.run(
        command, capture_output=True, text=True, check=True, timeout=10
    )
    return done.stdout.strip()


def _host() -> dict[str, str]:
    names = ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS")
    given = [f"{n}={os.environ[n]}" for n in names if os.environ.get(n)]
    return {
        "host class": f"{platform.system()} {platform.machine()}, "
        f"{os.cpu_count()} processors",
        "threads": ", ".join(given) or "not limited",
    }


def _marks(case: Case, aircraft: Aircraft, out: Path) -> Iterator[FileMark]:
    """Marks of all input files, each once."""
    files: list[tuple[str, Path]] = []
    if case.places.file and Path(case.places.file).is_file():
        files.append(("case", Path(case.places.file)))
    matrices = case.airframe.matrices
    if matrices is not None:
        files += [("matrices", path) for path in (*matrices.files, matrices.grids)]
    for k, path in enumerate(aircraft.files):
        files.append(("include" if k else "deck", path))
    for role, path in files:
        yield FileMark(
            role=role,
            path=os.path.relpath(path.resolve(), out.resolve()),
            sha256=_sha256(path.read_bytes()),
        )


def _change(mark: FileMark, folder: Path) -> str:
    path = folder / mark.path
    if not path.is_file():
        return f"{mark.role} {mark.path}: is not there any more"
    if _sha256(path.read_bytes()) != mark.sha256:
        return f"{mark.role} {mark.path}: has changed since the run"
    return ""


def _sha256(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
