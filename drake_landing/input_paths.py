"""Paths that a case or campaign names, relative to the folder of its file."""

from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, ValidationInfo


def _relative(path: Path, info: ValidationInfo) -> Path:
    folder = (info.context or {}).get("folder")
    return Path(folder, path) if folder else path


def _existing(path: Path) -> Path:
    if not path.is_file():
        raise ValueError(f"found {path}, expected a file that is there")
    return path


InputPath = Annotated[Path, AfterValidator(_relative)]
"""Of a file or folder, which may not be there; the context of the validation has the
folder, without which a path stays as it is."""

InputFile = Annotated[InputPath, AfterValidator(_existing)]
"""Of a file that is there."""
