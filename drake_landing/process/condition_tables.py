"""Tables of the static cases of the rules: SI units."""

import numpy as np
import pandas as pd

from drake_landing.conditions.balance import Holds, RigidBalance
from drake_landing.conditions.ground import STATES, GearLoad
from drake_landing.results.units import with_units
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
    """The rules' loads on the gears by case: N and Nm, ground axes G.

    Column `what`: ground, tow, jack ...; a gear may have several loads in a case.
    """
    rows = [
        [*_label(number, b), *_where(one), *one.force, *one.moment]
        for number, b in enumerate(balances, 1)
        for one in b.case.loads
    ]
    columns = [*_LABEL, "gear", "at", "what", "drag", "side", "vertical"]
    columns += ["moment_aft", "moment_starboard", "moment_up"]
    return pd.DataFrame(rows, columns=columns)


def attachment_table(
    held: Holds, split: Float64, balances: list[RigidBalance]
) -> pd.DataFrame:
    """Loads on the airframe's nodes by case: N and Nm, the deck's axes B."""
    rows = []
    every = (held.pattern @ split).T.reshape(-1, len(held.node_id), 6)
    for number, (loads, b) in enumerate(zip(every, balances, strict=True), 1):
        label = _label(number, b)
        rows += [[*label, int(n), *load] for n, load in zip(held.node_id, loads)]
    columns = [*_LABEL, "node", "fx", "fy", "fz", "mx", "my", "mz"]
    return pd.DataFrame(rows, columns=columns)


def named_cases(table: pd.DataFrame, balances: list[RigidBalance]) -> pd.DataFrame:
    """A table of extremes with the name of each case beside its number."""
    names = [f"{b.case.paragraph} {b.case.name}" for b in balances]
    table = table.copy()
    for column in ("case", "case_of_min", "case_of_max"):
        if column in table:
            told = [names[int(number) - 1] for number in table[column]]
            name = column.replace("case", "name", 1)
            table.insert(int(table.columns.get_indexer([column])[0]) + 1, name, told)
    return table


def with_headings(table: pd.DataFrame) -> pd.DataFrame:
    """Units and axes in the headings: of the ground (G), or of the deck."""
    return with_units(table.rename(columns=_HEADINGS))


_LABEL = ["case", "paragraph", "name"]
_HEADINGS = {
    **{"drag": "drag [N, aft]", "side": "side [N, starboard]"},
    **{"vertical": "vertical [N, up]", "moment_aft": "moment_aft [N m]"},
    **{f"moment_{axis}": f"moment_{axis} [N m]" for axis in ("starboard", "up")},
    **{f"f{axis}": f"f{axis} [N, deck]" for axis in "xyz"},
    **{f"m{axis}": f"m{axis} [N m, deck]" for axis in "xyz"},
    **{f"n_{way}": f"n_{way} [g]" for way in ("aft", "starboard", "up")},
    **{
        f"{turn}_acceleration": f"{turn}_acceleration [rad/s²]"
        for turn in ("roll", "pitch", "yaw")
    },
    "lift": "lift [g]",
}


def _where(one: GearLoad) -> list[str]:
    return [one.gear, one.at, one.what or "ground"]


def _label(number: int, b: RigidBalance) -> list[object]:
    return [number, b.case.paragraph, b.case.name]
