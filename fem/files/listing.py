"""The listing of a run: the summary tables that an engineer searches an F06 for.

Weight generator, resultants of loads and of forces of constraint, epsilon, extremes of
displacements, eigenvalues, load factors, effective masses: in Nastran's headings, so
that programs that look for them find them. The tables of points and elements that case
control asks for follow from the OP2 file (`fem.deck.listing_tables`).
"""

from collections.abc import Iterable, Iterator
from pathlib import Path

import h5py
import numpy as np

from fem.arrays import Float64
from fem.files.reading import Solution, solutions
from fem.model.structure import Structure
from fem.model.weight import Weight

_COMPONENTS = ("T1", "T2", "T3", "R1", "R2", "R3")
_FORCES = ("FX", "FY", "FZ", "MX", "MY", "MZ")
_GRIDS = 1000  # of eigenvalues that are printed


def spaced(words: str) -> str:
    """A heading as Nastran writes it."""
    return "   ".join(" ".join(word) for word in words.split())


def listing(results: Path, structure: Structure) -> str:
    """The summary tables of a result file.

    Args:
        results: HDF5 file of a run.
        structure: the model of the run.
    """
    lines = [f"1{structure.deck.path.name}", *_weight(structure)]
    with h5py.File(results) as source:
        for solution in solutions(source):
            lines += _solution(solution, structure)
    return "\n".join(lines) + "\n"


def _solution(solution: Solution, structure: Structure) -> Iterator[str]:
    case = solution.subcase or structure.deck.case_control[0].id
    group = solution.group
    if solution.analysis == "static":
        yield from _resultants(group, case)
        yield from _extremes(solution, case)
    elif solution.analysis == "modes":
        yield from _eigenvalues(solution, case)
        yield from _effective_mass(group, solution.values)
    elif solution.analysis == "buckling":
        yield from _factors(solution, case)


def _head(text: str, case: int = 0) -> list[str]:
    right = f"SUBCASE {case}" if case else ""
    return ["", f"0{'':<108}{right}", f"{'':<40}{text}"]


def _row(label: str, values: Iterable[float]) -> str:
    return f"   {label:<10}" + "".join(f"  {v:14.6E}" for v in values)


def _weight(structure: Structure) -> Iterator[str]:
    w: Weight = structure.weight
    yield from _head(spaced("OUTPUT FROM GRID POINT WEIGHT GENERATOR"))
    grid = int(structure.deck.number("GRDPNT"))
    yield f"{'':<50}REFERENCE POINT = {max(grid, 0):8d}"
    yield from _matrix("M O", w.MO)
    yield from _matrix("S", w.S)
    yield f"{'':<26}DIRECTION"
    yield (
        f"{'':<20}MASS AXIS SYSTEM (S)     MASS              X-C.G.        Y-C.G."
        "        Z-C.G."
    )
    for name, mass, cg in zip("XYZ", w.mass, w.cg):
        yield f"{'':<32}{name}  {mass:17.6E}" + "".join(f"{c:14.6E}" for c in cg)
    yield from _matrix("I(S)", 2.0 * np.diag(np.diag(w.IS)) - w.IS)
    yield from _matrix("I(Q)", np.diag(w.IQ))
    yield from _matrix("Q", w.Q)


def _matrix(name: str, values: Float64) -> Iterator[str]:
    yield f"{'':<60}{name}"
    for row in values:
        yield f"{'':<22}* " + "".join(f"{v:15.6E}" for v in row) + " *"


def _resultants(group: h5py.Group, case: int) -> Iterator[str]:
    for name, label in (("oload", "OLOAD"), ("spc_force", "SPCFORCE")):
        found = group.get(f"{name}_resultant")
        if not isinstance(found, h5py.Dataset):
            continue
        table = np.asarray(found, float)
        yield from _head(f"{label}    RESULTANT", case)
        yield "   LOAD TYPE " + "".join(f"  {c:>14}" for c in _COMPONENTS)
        for force, row in zip(_FORCES, table):
            yield _row(force, row)
        yield _row("TOTALS", table.sum(axis=0))
    if "epsilon" in group:
        yield from _head("EPSILON  AND  STRAIN ENERGY", case)
        epsilon, work = np.asarray(group["epsilon"], float)
        yield (
            f"   DATA BLOCK KLL    LOAD SEQ. NO. {case:6d}   EPSILON {epsilon:14.7E}   "
            f"EXTERNAL WORK {work:14.7E}"
        )


def _extremes(solution: Solution, case: int) -> Iterator[str]:
    found = solution.point("displacement")
    if found is None or not len(found.grid_id):
        return
    values = solution.state(found.grids, 0)
    yield from _head("MAXIMUM  DISPLACEMENTS (MAXMIN)", case)
    yield "   EXTREME   " + "".join(f"  {c:>14}" for c in _COMPONENTS)
    for label, at in (("MAXIMUM", values.argmax(0)), ("MINIMUM", values.argmin(0))):
        yield _row(label, values[at, range(6)])
        yield "   AT GRID   " + "".join(f"  {found.grid_id[k]:14d}" for k in at)


def _eigenvalues(solution: Solution, case: int) -> Iterator[str]:
    yield from _head(spaced("REAL EIGENVALUES"), case)
    yield (
        "   MODE    EXTRACTION      EIGENVALUE            RADIANS             CYCLES  "
        "          GENERALIZED         GENERALIZED"
    )
    yield f"{'':<4}NO.       ORDER{'':<67}MASS              STIFFNESS"
    hertz = solution.values
    mass = np.asarray(solution.group["modal_mass"], float)
    for k, (f, m) in enumerate(zip(hertz[:_GRIDS], mass), start=1):
        omega = 2.0 * np.pi * f
        square = omega * abs(omega)
        values = (square, omega, f, m, square * m)
        yield f"{k:8d}  {k:8d}  " + "".join(f"{v:20.6E}" for v in values)


def _factors(solution: Solution, case: int) -> Iterator[str]:
    yield from _head(spaced("REAL EIGENVALUES"), case)
    yield f"{'':<40}(LOAD FACTORS OF BUCKLING)"
    yield "   MODE    EXTRACTION      EIGENVALUE"
    yield "    NO.       ORDER      (LOAD FACTOR)"
    for k, factor in enumerate(solution.values, start=1):
        yield f"{k:8d}  {k:8d}  {factor:20.6E}"


def _effective_mass(group: h5py.Group, hertz: Float64) -> Iterator[str]:
    if "effective_mass" not in group:
        return
    effective = np.asarray(group["effective_mass"], float)
    factor = np.asarray(group["participation_factor"], float)
    total = np.diag(np.asarray(group["rigid_mass"], float))
    share = effective / np.where(total > 0.0, total, np.inf)
    yield from _head("MODAL PARTICIPATION FACTORS")
    yield from _by_mode(hertz, factor)
    yield from _head("MODAL EFFECTIVE MASS")
    yield from _by_mode(hertz, effective)
    yield _row("TOTAL", effective.sum(axis=0))
    yield _row("RIGID BODY", total)
    yield from _head("MODAL EFFECTIVE MASS FRACTION")
    yield from _by_mode(hertz, share)
    yield _row("TOTAL", share.sum(axis=0))


def _by_mode(hertz: Float64, values: Float64) -> Iterator[str]:
    yield "   MODE   FREQUENCY    " + "".join(f"{c:>14}" for c in _COMPONENTS)
    for k, (f, row) in enumerate(zip(hertz, values), start=1):
        yield f"{k:7d}  {f:13.6E} " + "".join(f"{v:14.6E}" for v in row)
