"""Tables of the static cases of the rules: SI units."""

import numpy as np
import pandas as pd

from drake_landing.conditions.balance import Holds, RigidBalance
from drake_landing.conditions.ground import STATES
from fem.arrays import Float64


def case_table(balances: list[RigidBalance]) -> pd.DataFrame:
    """Each case: paragraph, state, load factors (1), accelerations (rad/s²)."""
    rows = []
    for number, b in enumerate(balances, 1):
        aft, side, up = np.where(np.abs(b.factors) < 1e-9, 0.0, b.factors)
        rows.append(
            {
                "case": number,
                "paragraph": b.case.paragraph,
                "name": b.case.name,
                "pose": b.case.pose,
                "state": STATES[b.case.pose],
                "lift": b.case.lift,
                "n_aft": aft,
                "n_starboard": side,
                "n_up": up,
                "roll_acceleration": b.acceleration[3],
                "pitch_acceleration": b.acceleration[4],
                "yaw_acceleration": b.acceleration[5],
                "imbalance": b.error,
                "note": b.case.note,
            }
        )
    return pd.DataFrame(rows)


def gear_table(balances: list[RigidBalance]) -> pd.DataFrame:
    """The rules' loads on the gears by case: N and Nm, ground axes G."""
    rows = [
        [number, one.gear, one.at, *one.force, *one.moment]
        for number, b in enumerate(balances, 1)
        for one in b.case.loads
    ]
    columns = ["case", "gear", "at", "drag", "side", "vertical"]
    columns += ["moment_aft", "moment_starboard", "moment_up"]
    return pd.DataFrame(rows, columns=columns)


def attachment_table(held: Holds, split: Float64) -> pd.DataFrame:
    """Loads on the airframe's nodes by case: N and Nm, the deck's axes B."""
    rows = []
    for number, loads in enumerate(
        (held.pattern @ split).T.reshape(-1, len(held.node_id), 6), 1
    ):
        rows += [[number, int(n), *load] for n, load in zip(held.node_id, loads)]
    columns = ["case", "node", "fx", "fy", "fz", "mx", "my", "mz"]
    return pd.DataFrame(rows, columns=columns)
