"""RBE2: grids that follow another one as a rigid body."""

from typing import TYPE_CHECKING

import numpy as np

from fem.constraints.equations import Equations
from fem.deck.references import table, where
from fem.errors import InputError
from fem.geometry.points import Points
from fem.geometry.rigid_motion import rigid_motion

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def read_rbe2(deck: "Deck", points: Points) -> list[Equations]:
    """Equations of all RBE2: the components CM of each GM follow GN.

    Raises:
        InputError: undefined grids, a grid that follows itself.
    """
    rows = table(deck, "RBE2")
    if rows.empty:
        return []
    pairs = rows.explode("gms", ignore_index=True)
    own = pairs["gn"] == pairs["gms"]
    if own.any():
        raise InputError(
            f"{where('RBE2', row)}: grid {row['gn']} is both GN and GM"
            for _, row in pairs[own].iterrows()
        )
    master = points.rows(pairs["gn"].to_numpy(np.int64))
    slave = points.rows(pairs["gms"].to_numpy(np.int64))
    motion = rigid_motion(
        points.xyz[slave] - points.xyz[master], points.rotation[slave]
    )
    from_basic = np.zeros_like(motion)
    from_basic[:, :3, :3] = from_basic[:, 3:, 3:] = points.rotation[master]
    motion = motion @ from_basic
    follows = np.array([[d in str(cm) for d in "123456"] for cm in pairs["cm"]])
    pair, component = np.nonzero(follows)
    coefficients = motion[pair, component]
    row, at = np.nonzero(coefficients)
    names = [f"RBE2 {eid}" for eid in pairs["eid"]]
    return [
        Equations(
            dependent=6 * slave[pair] + component,
            row=row.astype(np.int64),
            column=6 * master[pair[row]] + at,
            value=coefficients[row, at],
            source=tuple(names[p] for p in pair),
        )
    ]
