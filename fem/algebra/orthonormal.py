"""Vectors orthonormal in the inner product of M: xᵀ M y."""

import numpy as np
import scipy.linalg
import scipy.sparse as sp

from fem.arrays import Float64


def orthonormal_block(
    block: Float64, mass: sp.csr_matrix, smallest: float
) -> tuple[Float64, Float64]:
    """M-orthonormal basis Q (n, r) of a block and norms R (r, k): block = Q R.

    Directions with norms below `smallest` are dropped.
    """
    q, norms = _by_gram_matrix(block, mass, smallest)
    # The square of the block's condition is lost in the Gram matrix: once more.
    q, again = _by_gram_matrix(q, mass, 0.1)
    return q, again @ norms


def orthonormal_rest(
    block: Float64, basis: Float64, mass: sp.csr_matrix, smallest: float = 1e-8
) -> Float64:
    """Part of a block beyond an M-orthonormal basis, as M-orthonormal vectors.

    Args:
        block: (n, k) vectors of any length.
        basis: (n, b).
        mass: (n, n) M.
        smallest: share of a vector's length at which what is left of it is round-off;
            such directions, and vectors without mass, are left out.

    Returns:
        (n, up to k).
    """
    size = np.sqrt(np.einsum("fi,fi->i", block, mass @ block))
    block = block[:, size > 0.0] / size[size > 0.0]
    for _ in range(2):  # once is not enough where much is taken away
        block = block - basis @ (basis.T @ (mass @ block))
        block, _ = _by_gram_matrix(block, mass, smallest)
    return block


def nearest_orthonormal(shapes: Float64, mass: sp.csr_matrix) -> Float64:
    """(n, k) M-orthonormal basis nearest to nearly orthonormal shapes (n, k)."""
    if shapes.shape[1] == 0:
        return shapes
    gram = shapes.T @ (mass @ shapes)
    values, vectors = np.linalg.eigh(0.5 * (gram + gram.T))
    return shapes @ (vectors / np.sqrt(values)) @ vectors.T


def gram_schmidt(vectors: Float64, mass: sp.csr_matrix) -> Float64:
    """(n, r) M-orthonormal basis of vectors (n, k), which may be dependent."""
    chosen: list[Float64] = []
    for vector in vectors.T:
        length = np.sqrt(vector @ (mass @ vector))
        rest = vector
        for _ in range(2):
            for other in chosen:
                rest = rest - other * (other @ (mass @ rest))
        norm = np.sqrt(max(rest @ (mass @ rest), 0.0))
        if norm > 1e-8 * length:
            chosen.append(rest / norm)
    return np.stack(chosen, axis=1)


def rank(vectors: Float64, mass: sp.csr_matrix) -> int:
    """How many of the vectors are independent in M."""
    gram = vectors.T @ (mass @ vectors)
    scale = np.sqrt(np.diag(gram))
    scale = np.where(scale > 0.0, scale, 1.0)
    return int(np.sum(np.linalg.eigvalsh(gram / np.outer(scale, scale)) > 1e-12))


def _by_gram_matrix(
    block: Float64, mass: sp.csr_matrix, smallest: float
) -> tuple[Float64, Float64]:
    gram = block.T @ (mass @ block)
    values, vectors = scipy.linalg.eigh(0.5 * (gram + gram.T))
    keep = values > max(smallest**2, float(np.finfo(float).tiny))
    roots = np.sqrt(values[keep])
    inverse = vectors[:, keep] / roots
    return np.asfortranarray(block @ inverse), roots[:, None] * vectors[:, keep].T
