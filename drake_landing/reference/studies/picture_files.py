"""Pictures of a study as files, for pages other than its report."""

import re
from pathlib import Path
from typing import TYPE_CHECKING

from drake_landing.reference.studies import figures
from drake_landing.reference.studies.plan import FULL_MODES
from fem.files.atomic import write_aside

if TYPE_CHECKING:
    from drake_landing.reference.studies.runs import Study, StudyRun


def write_pictures(folder: Path, study: "Study") -> list[Path]:
    """Accelerations by topology and kind of modes, convergence and budget, as SVG.

    Returns:
        The files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    pictures = {
        f"{study.plan.name}_{name}": figures.many_runs(study, runs)
        for name, runs in groups(study).items()
    }
    pictures[f"{study.plan.name}_convergence"] = figures.convergence(study)
    for topology in study.plan.topologies:
        name = f"{study.plan.name}_topology_{topology}_budget"
        pictures[name] = figures.budget_bars(study, topology)
    paths = []
    for name, svg in pictures.items():
        path = folder / f"{name}.svg"
        text = _alone(svg)
        write_aside(path, lambda to, text=text: to.write_text(text) and None)
        paths.append(path)
    return paths


def groups(study: "Study") -> dict[str, list["StudyRun"]]:
    """Runs that belong into one picture: of a topology, by how the modes are chosen."""
    found: dict[str, list[StudyRun]] = {}
    for run in study.runs:
        lowest = run.name.parsed.kind in ("count", "below")
        kind = run.name.basis if lowest else "chosen"
        kind = kind.replace(FULL_MODES, "lowest")
        found.setdefault(f"topology_{run.name.topology}_{kind}", []).append(run)
    return found


def _alone(svg: str) -> str:
    """As a file: its own font, a white ground, short numbers."""
    text = svg.replace("inherit", "Helvetica, Arial, sans-serif")
    text = re.sub(r"(\d+\.\d)\d{4,}", r"\1", text)
    ground = '<rect width="100%" height="100%" fill="#ffffff"/>'
    end = text.index(">", text.index("<svg")) + 1
    return text[:end] + ground + text[end:]
