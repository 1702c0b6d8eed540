"""What a landing run logs, as tables over time.

Every table has the time in seconds as its index. Signs: tire forces are those of the
runway on the tire (drag aft, side to starboard, vertical up); attachment loads are
those of the gear on the airframe in the axes B of the deck; spin is positive when
rolling.
"""

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.landing.handover import AttachmentLoads

Float64 = npt.NDArray[np.float64]

ATTACHMENT = ("fx", "fy", "fz", "mx", "my", "mz")
TIRE = ("deflection", "vertical", "drag", "side", "slip", "slip_angle", "spin")
BENDING = ("fore_aft", "lateral", "torsion")
STRUT = ("stroke", "rate", "force")
POINT = ("x", "y", "z")

UNITS = {
    **dict.fromkeys(("fx", "fy", "fz", "vertical", "drag", "side", "force"), "N"),
    **dict.fromkeys(("mx", "my", "mz"), "N m"),
    **dict.fromkeys(("deflection", "stroke"), "m"),
    **dict.fromkeys(BENDING, "rad"),
    **{"rate": "m/s", "slip": "1", "slip_angle": "rad", "spin": "rad/s"},
    **dict.fromkeys(POINT, "m/s²"),
}


@dataclass(frozen=True, kw_only=True)
class LandingHistory:
    """One landing.

    Attributes:
        attachment_node: attachment -> grid id. A gear's first attachment has the name
            of the gear, further ones `<gear>_<name>`.
        wheels: gear name -> its wheels.
        attachment: attachment -> table with columns `ATTACHMENT`.
        tire: wheel name -> table with columns `TIRE`.
        strut: gear name -> table with columns `STRUT`.
        bending: gear with an elastic leg -> table with columns `BENDING`: angles about
            the root, lower end aft, to starboard, and about the strut axis up > 0.
        monitoring: point name -> acceleration, columns `POINT`, in B.
        motion: columns qw qx qy qz px py pz: R_WA and p_WG (m) of the airframe.
        bodies: body of the gears -> (t, 7) quaternion and position (m) in W.
        amplitudes: (t, n) modal amplitudes of the modal body.
        energy: J; columns kinetic and strain of the airframe, gears, struts, tires,
            dissipated, and `balance`: their sum less its value at the start.
        lift_change: grid -> (t, 3) force (N, B) that the lift there has gained since
            the start; none where the lift is constant.
        figures: of the run: steps, evaluations, processor seconds, sink energy (J).
    """

    attachment_node: dict[str, int]
    wheels: dict[str, tuple[str, ...]]
    attachment: dict[str, pd.DataFrame]
    tire: dict[str, pd.DataFrame]
    strut: dict[str, pd.DataFrame]
    monitoring: dict[str, pd.DataFrame]
    motion: pd.DataFrame
    bodies: dict[str, Float64]
    amplitudes: Float64
    energy: pd.DataFrame
    bending: dict[str, pd.DataFrame] = field(default_factory=dict)
    lift_change: dict[int, Float64] = field(default_factory=dict)
    figures: dict[str, float] = field(default_factory=dict)

    @property
    def time(self) -> Float64:
        """(t,) s."""
        return self.motion.index.to_numpy()

    def attachment_loads(self) -> AttachmentLoads:
        """Loads of all gears, nodes in ascending id; loads on one node are added.

        They are increments over the loads at the start, which hold the aircraft in its
        flight or at rest; what the lift has lost since is among them.
        """
        nodes = np.unique([*self.attachment_node.values(), *self.lift_change])
        load = np.zeros((len(self.time), len(nodes), 6))
        for attachment, table in self.attachment.items():
            at = np.searchsorted(nodes, self.attachment_node[attachment])
            load[:, at] += table.to_numpy() - table.to_numpy()[0]
        for node, force in self.lift_change.items():
            load[:, np.searchsorted(nodes, node), :3] += force
        return AttachmentLoads(time=self.time, node_id=nodes, load=load)

    def leg(self, gear: str, column: str) -> pd.Series:
        """Sum of a tire quantity over the wheels of a gear."""
        total = pd.Series(0.0, index=self.motion.index)
        for wheel in self.wheels[gear]:
            total = total + self.tire[wheel][column]
        return total


def gear_peaks(run: str, history: LandingHistory) -> pd.DataFrame:
    """Columns run, gear, quantity, peak, time: values of largest magnitude, SI.

    Tire quantities are sums over the wheels of a gear. A gear's further attachments
    have rows of their own.
    """
    rows = []
    for attachment, loads in history.attachment.items():
        series = {f"attachment_{column}": loads[column] for column in ATTACHMENT}
        if attachment in history.strut:
            gear = {
                "tyre_vertical": history.leg(attachment, "vertical"),
                "tyre_drag": history.leg(attachment, "drag"),
                "stroke": history.strut[attachment]["stroke"],
            }
            series = {**gear, **series}
        for quantity, values in series.items():
            at = values.abs().idxmax()
            rows.append([run, attachment, quantity, float(values[at]), float(at)])
    return pd.DataFrame(rows, columns=["run", "gear", "quantity", "peak", "time"])
