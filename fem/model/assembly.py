"""Assembly of the g-set matrices from element blocks, without a loop over elements.

Element matrices in basic axes are turned into the displacement frames (CD) here and
nowhere else. Only upper triangles are gathered and then mirrored, so that the result is
symmetric to the last bit; pieces of bounded size keep the memory low.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.arrays import Float64, Int64
from fem.elements.block import ElementBlock
from fem.errors import InputError
from fem.geometry.points import Points
from fem.model.direct_input import LARGEST, NONE, DirectMatrices

# Entries of element matrices turned and sorted at once: about 100 MB of work space.
_PIECE = 2_000_000


@dataclass(frozen=True, kw_only=True)
class Matrices:
    """Matrices of the g-set, csr, exactly symmetric, displacement frames.

    Attributes:
        stiffness: K.
        mass: M, WTMASS applied.
        damping: B, viscous elements and direct input.
        structural_damping: K4 = Σ GE K_e.
    """

    stiffness: sp.csr_matrix
    mass: sp.csr_matrix
    damping: sp.csr_matrix
    structural_damping: sp.csr_matrix


def assemble(
    points: Points,
    blocks: Sequence[ElementBlock],
    *,
    coupled: bool = False,
    wtmass: float = 1.0,
    direct: DirectMatrices = NONE,
    factors: tuple[float, float, float] = (1.0, 1.0, 1.0),
) -> Matrices:
    """All matrices of a model.

    Args:
        points: numbering and displacement frames.
        blocks: the elements.
        coupled: coupled element masses (PARAM COUPMASS).
        wtmass: factor on the mass of elements (PARAM WTMASS); direct input is not
            multiplied, as Nastran has it.
        direct: matrices of DMIG.
        factors: on K, M and B of the elements (PARAM CK1, CM1, CB1); results of
            elements do not know them.
    """
    stiffness, structural = _Sum(points.size), _Sum(points.size)
    mass, damping = _Sum(points.size), _Sum(points.size)
    for block in blocks:
        k = _finite(block, _stiffness(block), "stiffness")
        if k is not None:
            stiffness.add(_triplets(points, block, k))
            ge = block.structural_damping()
            if ge is not None:
                k4 = ge if ge.ndim == 3 else k * ge[:, None, None]
                structural.add(_triplets(points, block, k4))
        del k
        m = _finite(block, block.mass(coupled=coupled), "mass")
        if m is not None:
            mass.add(_triplets(points, block, m * wtmass if wtmass != 1.0 else m))
        b = _finite(block, block.damping(), "damping")
        if b is not None:
            damping.add(_triplets(points, block, b))
    k1, m1, b1 = factors
    return Matrices(
        stiffness=_with(stiffness.symmetric(), k1, direct.stiffness),
        mass=_with(mass.symmetric(), m1, direct.mass),
        damping=_with(damping.symmetric(), b1, direct.damping),
        structural_damping=structural.symmetric(),
    )


def assemble_mass(
    points: Points,
    blocks: Sequence[ElementBlock],
    *,
    coupled: bool = False,
    factor: float = 1.0,
) -> sp.csr_matrix:
    """(g, g) mass of elements times a factor, without other matrices."""
    mass = _Sum(points.size)
    for block in blocks:
        m = _finite(block, block.mass(coupled=coupled), "mass")
        if m is not None:
            mass.add(_triplets(points, block, factor * m))
    return mass.symmetric()


def assemble_one(
    points: Points, parts: Iterable[tuple[ElementBlock, Float64]]
) -> sp.csr_matrix:
    """(g, g) sum of element matrices (e, n, n) of blocks, each in its block's axes."""
    total = _Sum(points.size)
    for block, matrix in parts:
        total.add(_triplets(points, block, matrix))
    return total.symmetric()


def _stiffness(block: ElementBlock) -> Float64 | None:
    """The stiffness of a block.

    Raises:
        InputError: elements whose shape or property allows none.
    """
    try:
        return block.stiffness()
    except np.linalg.LinAlgError:
        raise InputError(
            f"{block.card} {_listed(_singular(block))}: no stiffness can be computed, "
            "its equations are singular; look at its shape, property and material"
        ) from None


def _singular(block: ElementBlock) -> Int64:
    """Ids of elements without stiffness; of all, where the block cannot be divided."""
    take, count = getattr(block, "take", None), len(block.id)
    if take is None or count == 1:
        return block.id
    found = []
    for half in (np.arange(count // 2), np.arange(count // 2, count)):
        part = take(half)
        try:
            part.stiffness()
        except np.linalg.LinAlgError:
            found.append(_singular(part))
    return np.concatenate(found) if found else block.id


def _listed(ids: Int64) -> str:
    more = f", ... ({len(ids)} in all)" if len(ids) > 5 else ""
    return f"{', '.join(map(str, ids[:5]))}{more}"


def _finite(block: ElementBlock, matrix: Float64 | None, what: str) -> Float64 | None:
    """The matrices of a block (e, n, n) as they are.

    Raises:
        InputError: elements whose matrix is not finite, or so large that its square
            would not be.
    """
    if matrix is None:
        return None
    usable = np.abs(matrix) < LARGEST  # neither infinite nor NaN
    if not usable.all():
        bad = block.id[~usable.all(axis=(1, 2))]
        raise InputError(
            f"{block.card} {_listed(bad)}: the {what} is beyond "
            f"what can be computed with ({LARGEST:g}); look at its property, material "
            "and size"
        )
    return matrix


def to_displacement(points: Points, dof: Int64, matrix: Float64) -> Float64:
    """Matrices (e, n, n) of basic frame along the freedoms (e, n) of the g-set.

    The freedoms come in triples of one grid, T1 T2 T3 or R1 R2 R3, or of a scalar point
    and twice ground.
    """
    turn = triples_rotation(points, dof)
    if turn is None:
        return matrix
    half = turn_columns(matrix, turn)
    return turn_columns(half.transpose(0, 2, 1), turn).transpose(0, 2, 1)


def triples_rotation(points: Points, dof: Int64) -> Float64 | None:
    """(e, n/3, 3, 3) R_BD of each triple of freedoms, None if all are the identity."""
    grid = dof[:, ::3] // 6
    grid = np.where(grid < len(points.grid_id), grid, -1)
    turned = np.any(points.rotation != np.eye(3), axis=(1, 2))
    if not np.any(turned[grid[grid >= 0]]):
        return None
    turn = points.rotation[grid]
    turn[grid < 0] = np.eye(3)  # ground, and scalar points
    return turn


def turn_columns(matrix: Float64, turn: Float64) -> Float64:
    """(e, r, n) with its columns turned from basic into displacement axes."""
    e, r, n = matrix.shape
    triples = matrix.reshape(e, r, n // 3, 3)
    return np.einsum("ergk,egkj->ergj", triples, turn).reshape(e, r, n)


def _triplets(
    points: Points, block: ElementBlock, matrix: Float64
) -> Iterator[tuple[Int64, Int64, Float64]]:
    """Rows, columns and values of the upper triangle, in pieces.

    Both triangles differ by rounding, on slender elements by more of it than rigid
    motions may meet: what is symmetric of them meets least.
    """
    n = matrix.shape[1]
    upper_row, upper_column = np.triu_indices(n)
    step = max(1, _PIECE // (n * n))
    for start in range(0, len(matrix), step):
        dof, values = block.dof[start : start + step], matrix[start : start + step]
        if block.frame == "basic":
            values = to_displacement(points, dof, values)
        values = values[:, upper_row, upper_column] + values[:, upper_column, upper_row]
        values *= 0.5
        a, b = dof[:, upper_row], dof[:, upper_column]
        keep = (a >= 0) & (b >= 0) & (values != 0.0)
        a, b, values = a[keep], b[keep], values[keep]
        # Two freedoms of an element at one row: both triangles meet on the diagonal.
        off = np.broadcast_to(upper_row != upper_column, keep.shape)[keep]
        values = np.where(off & (a == b), 2.0 * values, values)
        yield np.minimum(a, b), np.maximum(a, b), values


class _Sum:
    """A sparse matrix that grows by pieces of its upper triangle."""

    def __init__(self, size: int) -> None:
        self._shape = (size, size)
        self._total = sp.csr_matrix(self._shape)
        self._parts: list[tuple[Int64, Int64, Float64]] = []
        self._waiting = 0

    def add(self, pieces: Iterable[tuple[Int64, Int64, Float64]]) -> None:
        for row, column, value in pieces:
            # 32-bit indices halve the work space; the g-set is far below 2^31.
            self._parts.append((row.astype(np.int32), column.astype(np.int32), value))
            self._waiting += len(value)
            if self._waiting >= 2 * _PIECE:
                self._collect()

    def symmetric(self) -> sp.csr_matrix:
        """The whole matrix from its upper triangle."""
        self._collect()
        upper = self._total
        whole = sp.csr_matrix(upper + sp.triu(upper, 1, format="csr").T.tocsr())
        whole.sort_indices()
        return whole

    def _collect(self) -> None:
        if not self._parts:
            return
        row, column, value = (np.concatenate(p) for p in zip(*self._parts))
        new = sp.coo_matrix((value, (row, column)), shape=self._shape).tocsr()
        self._total = self._total + new if self._total.nnz else new
        self._parts, self._waiting = [], 0


def _with(
    matrix: sp.csr_matrix, factor: float, direct: sp.csr_matrix | None
) -> sp.csr_matrix:
    if factor != 1.0:
        matrix = sp.csr_matrix(factor * matrix)
    if direct is None:
        return matrix
    return sp.csr_matrix(matrix + direct)
