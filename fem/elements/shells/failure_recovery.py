"""Failure indices of shells as columns of a result table."""

from dataclasses import dataclass, replace

import numpy as np

from fem.arrays import Float64, Int64
from fem.deck.records.shells import PLY_FAILURE, of_plies
from fem.elements.block import Recovery
from fem.elements.shells.shell_recovery import with_heat
from fem.properties.failure import Failure


def failure_names(plies: int) -> tuple[str, ...]:
    """Columns: of ply k from the bottom with the suffix `_p<k>`, then the largest."""
    return (*of_plies(PLY_FAILURE, plies), "max_index")


@dataclass(frozen=True, kw_only=True)
class FailureRecovery(Recovery):
    """Failure indices from the resultants N M Q at the element center.

    Attributes:
        laminate: (e,) which of the laminates.
        maps: per laminate (p, 2, 5, 8): stresses and strains 11 22 12 1z 2z of its
            plies from resultants in material axes; (a tuple: not one per element).
        residual: per laminate (p, 2, 5, 2) what a degree and a gradient leave in free
            plies.
        failures: per laminate; None: NaN for its elements.
    """

    laminate: Int64
    maps: tuple[Float64, ...]
    residual: tuple[Float64, ...]
    failures: tuple[Failure | None, ...]

    def heated(self, relief: Float64, heat: Float64) -> tuple[Recovery, Float64]:
        """Degrees and gradients are two quantities more."""
        maps = tuple(
            np.concatenate(pair, axis=-1) for pair in zip(self.maps, self.residual)
        )
        return (
            replace(self, maps=maps, matrix=with_heat(self.matrix)),
            np.hstack([relief, heat]),
        )

    def derive(self, linear: Float64) -> Float64:
        """(..., e, 2 p + 1) from (..., e, 8) resultants in material axes."""
        values = np.full((*linear.shape[:-1], len(self.columns)), np.nan)
        for k in np.unique(self.laminate):
            failure = self.failures[k]
            if failure is None:
                continue
            own = np.flatnonzero(self.laminate == k)
            ply = np.einsum("pkij,...j->k...pi", self.maps[k], linear[..., own, :])
            bond = failure.bond_index(ply[0, ..., 3:])
            index = failure.ply_index(ply[0, ..., :3], ply[1, ..., :3])
            both = np.stack([index, bond], axis=-1)
            values[..., own, : 2 * len(failure.plies)] = both.reshape(
                *both.shape[:-2], -1
            )
            values[..., own, -1] = np.fmax.reduce(both, axis=(-2, -1))
        return values
