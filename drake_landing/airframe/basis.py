"""Elastic modes of an airframe: of the full model, or of one reduced to an interface.

Reductions keep the interface rows of the free set (f): Guyan condenses everything else
statically, Craig-Bampton adds fixed-interface modes. The eigenmodes of the reduced
model come back as shapes of the whole f-set, so that what follows need not know the
basis.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from drake_landing.airframe.free_flight import check_free_flight
from drake_landing.cache import Arrays, Cache, content_key
from drake_landing.case.airframe import Airframe
from drake_landing.case.mode_selection import Selection
from fem.algebra.linear_solver import SingularMatrixError
from fem.algebra.modes import Modes, ModesError, normal_modes, rigid_energy
from fem.algebra.reduction import Reduction, reduce_craig_bampton
from fem.errors import InputError
from fem.model.structure import Structure
from fem.response.modal import residual_vectors

Float64 = npt.NDArray[np.float64]
Rows = npt.NDArray[np.intp]
Progress = Callable[[int, int], None]

_RIGID = 6
_LARGEST_FOR_ALL = 6000  # freedoms: "all" modes of more are no basis, they are a model
_HELD = 1e-12  # energy of a rigid motion over that of its parts: no rounding any more
_FEW = 6  # rows on which a dependent interface freedom may rest


@dataclass(frozen=True, kw_only=True)
class Basis:
    """Elastic modes, mass-normalised, ascending.

    Attributes:
        frequency_hz: (n,).
        shape: (f, n).
        rigid: (f, 6) unit rigid motions about the center of weight: basic axes.
        freedoms: of the model whose modes these are (f, or of the reduced one).
        notices: what the user should know.
    """

    frequency_hz: Float64
    shape: Float64
    rigid: Float64
    freedoms: int
    notices: tuple[str, ...] = ()

    def chosen(self, modes: Rows, notices: Sequence[str] = ()) -> "Basis":
        """Some of the modes, ascending, with further notices."""
        modes = np.sort(modes)
        return Basis(
            frequency_hz=self.frequency_hz[modes],
            shape=np.ascontiguousarray(self.shape[:, modes]),
            rigid=self.rigid,
            freedoms=self.freedoms,
            notices=(*self.notices, *notices),
        )

    def rigid_modes(self, mass: sp.csr_matrix) -> Float64:
        """(f, 6) mass-normalised rigid-body modes."""
        gram = self.rigid.T @ (mass @ self.rigid)
        return self.rigid @ np.linalg.inv(np.linalg.cholesky(gram)).T


def elastic_basis(
    structure: Structure,
    airframe: Airframe,
    interface: Sequence[int],
    progress: Progress | None = None,
    *,
    cache: Cache | None = None,
) -> Basis:
    """Modes as the case asks for them; all candidates where relevance selects.

    Args:
        structure: free-flying.
        airframe: basis and selection.
        interface: grids that a reduction keeps.
        progress: called with (converged, wanted) modes.
        cache: where modes of the same matrices may be found.

    Raises:
        InputError: the model is supported, has mechanisms, or has no such modes.
    """
    select = airframe.select
    if select.by_relevance:
        select = Selection(kind="below", value=airframe.candidates)
    rows, notices = None, ()
    if airframe.basis != "full-modes":
        rows, notices = interface_rows(structure, interface)
    key = content_key(
        *(structure.stiffness, structure.mass, airframe.basis, str(select), rows),
        str(airframe.fixed_interface_modes) if rows is not None else None,
    )

    def solve() -> Arrays:
        return _elastic(structure, airframe, select, rows, progress)

    found = (cache or Cache(None)).arrays("modes", key, solve)
    return Basis(
        frequency_hz=found["frequency_hz"],
        shape=found["shape"],
        rigid=structure.rigid_body,
        freedoms=int(found["freedoms"]),
        notices=(
            *notices,
            *_missed(select, airframe.basis, len(found["frequency_hz"])),
        ),
    )


def _elastic(
    structure: Structure,
    airframe: Airframe,
    select: Selection,
    rows: Rows | None,
    progress: Progress | None,
) -> Arrays:
    """Frequencies and shapes (f, n) of elastic modes, and the freedoms they are of."""
    if rows is None:
        modes = _solve(structure, select, progress)
        shape, freedoms = modes.shape, structure.size
    else:
        reduction = _reduce(structure, airframe, rows)
        rigid = np.zeros((reduction.size, _RIGID))
        rigid[: len(rows)] = structure.rigid_body[rows]
        modes = normal_modes(
            sp.csr_matrix(_without_rounding(reduction.stiffness, rigid, structure)),
            sp.csr_matrix(reduction.mass),
            **_wanted(select, reduction.size),
            rigid_body=rigid,
        )
        shape, freedoms = reduction.expand(modes.shape), reduction.size
    _check_rigid(structure, modes, shape)
    return {
        "frequency_hz": modes.frequency_hz[_RIGID:],
        "shape": np.ascontiguousarray(shape[:, _RIGID:]),
        "freedoms": np.array(freedoms),
    }


def _missed(select: Selection, basis: str, found: int) -> tuple[str, ...]:
    """What the user asked for and did not get."""
    if select.kind == "count" and found < select.value:
        return (
            f"airframe.select asks for {select.value:g} elastic modes; the "
            f"{basis} basis has {found}",
        )
    if found == 0 and select.kind == "below" and select.value > 0:
        return (f"no elastic mode below {select.value:g} Hz: rigid",)
    return ()


def with_residual_vectors(
    structure: Structure, basis: Basis, nodes: Sequence[int]
) -> Basis:
    """The basis completed by attachment modes.

    Args:
        structure: the full model.
        basis: its modes.
        nodes: grids whose unit forces and moments are to be answered statically right.
    """
    added = residual_basis(structure, basis, nodes)
    if not len(added.frequency_hz):
        return basis
    notice = (
        f"{len(added.frequency_hz)} residual vectors answer at "
        f"{added.frequency_hz.min():.0f} to {added.frequency_hz.max():.0f} Hz"
    )
    return Basis(
        frequency_hz=np.concatenate([basis.frequency_hz, added.frequency_hz]),
        shape=np.hstack([basis.shape, added.shape]),
        rigid=basis.rigid,
        freedoms=basis.freedoms,
        notices=(*basis.notices, notice),
    )


def residual_basis(
    structure: Structure,
    basis: Basis,
    nodes: Sequence[int],
    *,
    cache: Cache | None = None,
) -> Basis:
    """The attachment modes that a basis lacks, orthogonal to it.

    Args:
        structure: the full model.
        basis: its modes.
        nodes: grids with unit forces and moments.
        cache: where those of the same modes may be found.
    """
    grids = sorted(set(nodes))
    patterns = structure.operator(grids, frame="basic").T

    def solve() -> Arrays:
        modes = Modes(
            frequency_hz=np.concatenate([np.zeros(_RIGID), basis.frequency_hz]),
            shape=np.hstack([basis.rigid_modes(structure.mass), basis.shape]),
            rigid=_RIGID,
            sturm=(),
        )
        more = residual_vectors(structure.stiffness, structure.mass, modes, patterns)
        new = slice(modes.count, None)
        return {
            "frequency_hz": more.frequency_hz[new],
            "shape": np.ascontiguousarray(more.shape[:, new]),
        }

    key = content_key(
        *(structure.stiffness, structure.mass, basis.frequency_hz, patterns), "residual"
    )
    found = (cache or Cache(None)).arrays("residual", key, solve)
    return Basis(
        frequency_hz=found["frequency_hz"],
        shape=found["shape"],
        rigid=basis.rigid,
        freedoms=basis.freedoms,
    )


def interface_rows(
    structure: Structure, grids: Sequence[int]
) -> tuple[Rows, tuple[str, ...]]:
    """Rows of the f-set that a reduction keeps, ascending, and what was left out.

    A freedom that depends on few others (a rigid element) is kept through these; one
    that averages many (RBE3) is not, because all of them would have to be kept.
    """
    operator = structure.operator(sorted(set(grids)))
    count = np.diff(operator.indptr)
    rows = np.unique(
        np.concatenate(
            [operator.indices[a:b] for a, b in _spans(operator.indptr, count <= _FEW)]
        )
        if len(count)
        else np.zeros(0)
    )
    asked = structure.analysis_dof
    rows = np.union1d(rows, structure.free_rows(asked, "ASET") if len(asked) else [])
    ids = np.repeat(sorted(set(grids)), 6)
    averaged = sorted(set(ids[count > _FEW].tolist()))
    notices: tuple[str, ...] = ()
    if averaged:
        some = ", ".join(map(str, averaged[:8])) + (" ..." if len(averaged) > 8 else "")
        notices = (
            f"{len(averaged)} interface grids are averages of many others (RBE3) and "
            f"are not kept by the reduction: {some}",
        )
    return rows.astype(np.intp), notices


def _spans(indptr: npt.NDArray, wanted: npt.NDArray) -> list[tuple[int, int]]:
    return [(int(indptr[i]), int(indptr[i + 1])) for i in np.flatnonzero(wanted)]


def _wanted(select: Selection, size: int) -> dict:
    """Arguments of `normal_modes`: the rigid-body modes come on top."""
    if select.kind == "below":
        return {"band": (0.0, max(select.value, 1e-3))}
    count = size if select.kind == "all" else int(select.value) + _RIGID
    return {"count": min(count, size)}


def _solve(structure: Structure, select: Selection, progress: Progress | None) -> Modes:
    if select.kind == "all" and structure.size > _LARGEST_FOR_ALL:
        raise InputError(
            f"airframe.select: 'all' modes of {structure.size} freedoms; expected "
            "'count N' or 'below F Hz', or a reduced basis (guyan, craig-bampton)"
        )

    def solve() -> Modes:
        return normal_modes(
            structure.stiffness,
            structure.mass,
            **_wanted(select, structure.size),
            rigid_body=structure.rigid_body,
            progress=progress,
        )

    return structure.guarded(solve, dynamic=True, error=ModesError)


def _reduce(structure: Structure, airframe: Airframe, kept: Rows) -> Reduction:
    inner = airframe.fixed_interface_modes
    arguments: dict = {"count": 0}
    if airframe.basis == "craig-bampton" and inner.kind == "count":
        arguments = {"count": int(inner.value)}
    elif airframe.basis == "craig-bampton":
        arguments = {"highest_hz": inner.value}

    def reduce() -> Reduction:
        return reduce_craig_bampton(
            structure.stiffness, structure.mass, structure.damping, kept, **arguments
        )

    return structure.guarded(reduce, dynamic=False, error=SingularMatrixError)


def _without_rounding(
    stiffness: Float64, rigid: Float64, structure: Structure
) -> Float64:
    """Reduced stiffness that a free structure's rigid motions do not strain.

    What is condensed may be far stiffer than what remains: the difference keeps the
    rounding of the former, enough to pass for a weak support. A structure that is held
    is left as it is.
    """
    if rigid_energy(structure.stiffness, structure.rigid_body).max() > _HELD:
        return stiffness
    q, _ = np.linalg.qr(rigid)
    force = stiffness @ q
    force -= 0.5 * q @ (q.T @ force)
    return stiffness - force @ q.T - q @ force.T


def _check_rigid(structure: Structure, modes: Modes, shape: Float64) -> None:
    """A free-flying airframe has six rigid-body modes.

    Raises:
        InputError: fewer: what holds it; more: what moves.
    """
    if modes.rigid == _RIGID:
        return
    check_free_flight(structure)
    loose = shape[:, : modes.rigid]
    mass = structure.mass
    rigid = structure.rigid_body
    inside = np.linalg.solve(rigid.T @ (mass @ rigid), rigid.T @ (mass @ loose))
    rest = np.abs(loose - rigid @ inside).max(axis=1)
    rows = np.argsort(-rest)[:6]
    raise InputError(
        f"{structure.deck.path}: {modes.rigid} motions without stiffness, expected the "
        "6 of a free-flying airframe; besides these, freely move "
        + ", ".join(structure.label(int(row)) for row in rows if rest[row] > 0)
    )
