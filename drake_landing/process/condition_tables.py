"""Tables of the static cases of the rules: SI units."""

import numpy as np
import pandas as pd

from drake_landing.conditions.balance import Holds, RigidBalance
from drake_landing.conditions.build import OnGround
from drake_landing.conditions.ground import STATES, GearLoad
from drake_landing.results.units import with_units
from fem.arrays import Float64


def case_table(balances: list[RigidBalance]) -> pd.DataFrame:
    """Each case: paragraph, state, load factors (1), accelerations (rad/s²).

    Accelerations turn right-handed about aft, starboard, up: against the usual body
    axes (forward, starboard, down) roll and yaw have the opposite sign.
    """
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
    Loads of zero are left out.
    """
    rows = [
        [*_label(number, b), *_where(one), *one.force, *one.moment]
        for number, b in enumerate(balances, 1)
        for one in b.case.loads
        if one.force.any() or one.moment.any()
    ]
    columns = [*_LABEL, "gear", "at", "what", "drag", "side", "vertical"]
    columns += ["moment_aft", "moment_starboard", "moment_up"]
    return pd.DataFrame(rows, columns=columns)


def place_table(ground: OnGround, R_AB: Float64) -> pd.DataFrame:
    """Axle and ground point of each gear in each pose, from the center of gravity, G.

    Args:
        ground: the aircraft.
        R_AB: (3, 3).
    """
    rows = []
    for pose, posed in ground.poses.items():
        center = R_AB.T @ posed.whole.center
        own = [pose, STATES[pose], np.degrees(posed.pitch), posed.height, *center]
        for gear in ground.aircraft.gears:
            place = posed.places[gear.name]
            rows.append(
                [*own, gear.name, gear.role, gear.static, *place.axle, *place.ground]
            )
    columns = ["pose", "state", "pitch", "cg_height", "cg_x", "cg_y", "cg_z"]
    columns += ["gear", "role", "load_at_rest"]
    columns += [f"{what}_{way}" for what in ("axle", "ground") for way in _WAYS]
    return pd.DataFrame(rows, columns=columns)


def standing(places: pd.DataFrame) -> list[str]:
    """Lines on the aircraft at rest, from `place_table`, for hand checks."""
    rest = places[places.pose == "static"]
    mains, others = rest[rest.role == "main"], rest[rest.role != "main"]
    first = rest.iloc[0]
    text = f"at rest: center of gravity {first.cg_height:.4f} m above the ground, "
    text += f"pitch {first.pitch:+.3f}°"
    if len(mains) and len(others):
        base = float(mains.ground_aft.mean() - others.ground_aft.iloc[0])
        text += f", wheelbase {abs(base):.4f} m"
    if len(mains) > 1:
        text += f", track {np.ptp(mains.ground_starboard):.4f} m"
    lines = [text, "axles from the center of gravity, ground axes (gear_places.csv):"]
    lines += [
        f"{r.gear:<15} {r.role:<5}{r.axle_aft:+9.4f} m aft {r.axle_starboard:+9.4f} m "
        f"starboard {r.axle_up:+9.4f} m up {r.load_at_rest / 1e3:10.3f} kN"
        for r in rest.itertuples()
    ]
    return lines


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


_WAYS = ("aft", "starboard", "up")
_LABEL = ["case", "paragraph", "name"]
_HEADINGS = {
    **{"drag": "drag [N, aft]", "side": "side [N, starboard]"},
    **{
        "vertical": "vertical [N, up]",
        "moment_aft": "moment_aft [N m, + starboard up]",
    },
    "moment_starboard": "moment_starboard [N m, + nose up]",
    "moment_up": "moment_up [N m, + nose to port]",
    **{f"f{axis}": f"f{axis} [N, deck]" for axis in "xyz"},
    **{f"m{axis}": f"m{axis} [N m, deck]" for axis in "xyz"},
    **{f"n_{way}": f"n_{way} [g]" for way in ("aft", "starboard", "up")},
    "roll_acceleration": "roll_acceleration [rad/s², + starboard up]",
    "pitch_acceleration": "pitch_acceleration [rad/s², + nose up]",
    "yaw_acceleration": "yaw_acceleration [rad/s², + nose to port]",
    "lift": "lift [g]",
    **{"pitch": "pitch [deg, nose up]", "cg_height": "cg_height [m]"},
    **{f"cg_{axis}": f"cg_{axis} [m, deck]" for axis in "xyz"},
    "load_at_rest": "load_at_rest [N]",
    **{
        f"{what}_{way}": f"{what}_{way} [m]"
        for what in ("axle", "ground")
        for way in _WAYS
    },
}


def _where(one: GearLoad) -> list[str]:
    return [one.gear, one.at, one.what or "ground"]


def _label(number: int, b: RigidBalance) -> list[object]:
    return [number, b.case.paragraph, b.case.name]
