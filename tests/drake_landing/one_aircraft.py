"""One small aircraft in any units and any frame, with masses or with weights."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from drake_landing.case.reading import parse_case
from drake_landing.case.schema import Case

POUND = 0.45359237  # kg
INCH = 0.0254  # m
GRAVITY = 9.80665  # m/s²

# Grids in m: x aft, y to starboard, z up. Fuselage, wing, wing tips, gear nodes.
GRIDS = {
    **{1: (0, 0, 0), 2: (1.8, 0, 0), 3: (3.9, 0, 0.1), 4: (8.1, 0, 0.3)},
    **{11: (3.9, 1.2, 0.1), 12: (4.3, 4.8, 0.4)},
    **{21: (3.9, -1.2, 0.1), 22: (4.3, -4.8, 0.4)},
}
BARS = {1: (1, 2), 2: (2, 3), 3: (3, 4), 4: (3, 11), 5: (11, 12), 6: (3, 21)}
BARS |= {7: (21, 22)}
MASSES = {1: 150.0, 2: 260.0, 3: 420.0, 4: 60.0, 11: 120.0, 21: 120.0}  # kg
MASSES |= {12: 40.0, 22: 40.0}
FRAMES = {  # forward axis -> R_BA, columns are aft, starboard, up in the deck's frame
    "-x": np.eye(3),
    "x": np.diag([-1.0, -1.0, 1.0]),
    "y": np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
}


@dataclass(frozen=True, kw_only=True)
class Written:
    """How a deck is written.

    Attributes:
        units: of the case.
        length: of a unit of length, m.
        mass: of the unit in which masses and densities stand, kg.
        wtmass: times that unit gives the consistent unit of mass.
        forward: axis of flight.
    """

    units: str = "SI"
    length: float = 1.0
    mass: float = 1.0
    wtmass: float = 1.0
    forward: str = "-x"
    more: dict[str, str] = field(default_factory=dict)

    @property
    def R_BA(self) -> np.ndarray:
        """(3, 3)."""
        return FRAMES[self.forward]


SI = Written()
MM_T_N = Written(units="mm-t-N", length=1e-3, mass=1e3)
WEIGHTS = Written(
    units="in-lbf", length=INCH, mass=POUND, wtmass=INCH / GRAVITY
)  # lb weigh lbf; over g in in/s² they are lbf s²/in
SLINCHES = Written(units="in-lbf", length=INCH, mass=POUND * GRAVITY / INCH)


def deck_text(how: Written) -> str:
    """The aircraft as bulk data."""
    to, kg = 1.0 / how.length, 1.0 / how.mass
    pascal = how.length * how.wtmass / how.mass  # of a kg/(m s²)
    R = how.R_BA

    def card(*fields: object) -> str:
        texts = [repr(float(f)) if isinstance(f, float) else str(f) for f in fields]
        rows = [texts[:9], *(texts[i : i + 8] for i in range(9, len(texts), 8))]
        return "\n".join([",".join(rows[0]), *("," + ",".join(r) for r in rows[1:])])

    def turned(p: tuple[float, ...], factor: float = 1.0) -> list[float]:
        return (factor * (R @ np.array(p, float))).tolist()

    up = turned((0, 0, 1))
    lines = ["BEGIN BULK", card("PARAM", "G", 0.03), card("PARAM", "W3", 50.0)]
    lines += [card("PARAM", "WTMASS", how.wtmass)] * (how.wtmass != 1.0)
    lines += [card("MAT1", 1, 7e10 * pascal, "", 0.33, 2700.0 * kg / to**3)]
    area, i = 0.008 * to**2, 6e-5 * to**4
    lines += [card("PBAR", 1, 1, area, i, 1.7 * i, 1.2 * i, "", "", "", 0.1 * to, 0.0)]
    lines += [card("GRID", n, "", *turned(p, to)) for n, p in GRIDS.items()]
    lines += [card("CBAR", n, 1, *ends, *up) for n, ends in BARS.items()]
    for k, (grid, mass) in enumerate(MASSES.items()):
        inertia = R @ np.diag([0.05, 0.08, 0.09]) @ R.T * mass * kg * to**2
        lower = inertia[np.tril_indices(3)].tolist()
        lines += [card("CONM2", 100 + k, grid, "", mass * kg, *[""] * 4, *lower)]
    return "\n".join([*lines, *how.more.values(), "ENDDATA"]) + "\n"


def case_of(folder: Path, how: Written = SI, *changes: tuple[str, str]) -> Case:
    """Its landing on three gears; the deck is written into a folder.

    Args:
        folder: gets `aircraft.bdf`.
        how: it is written.
        changes: text of the case -> another one.
    """
    folder.joinpath("aircraft.bdf").write_text(deck_text(how))
    text = case_text(how)
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return parse_case(text, file="case.yaml", folder=folder)


def case_text(how: Written = SI) -> str:
    """YAML of the case; gears in m and kg, in the frame of the deck."""
    R = how.R_BA

    def at(x: float, y: float, z: float) -> list[float]:
        return (R @ [x, y, z]).tolist()

    def inertia(x: float, y: float, z: float) -> list[float]:
        return (np.abs(R) @ [x, y, z]).tolist()

    def gear(name: str, node: int, x: float, y: float, load: float) -> str:
        return f"""
  - name: {name}
    attachment_node: {node}
    axle: {at(x, y, -1.0)}
    wheel_offsets: [0.0]
    fitting: {{mass: 5, cg: {at(x, y, -0.3)}, inertia: {inertia(0.4, 0.5, 0.2)}}}
    piston: {{mass: 4, cg: {at(x, y, -0.8)}, inertia: {inertia(0.2, 0.2, 0.1)}}}
    wheel: {{mass: 7, spin_inertia: 0.12}}
    tyre: {{radius: 0.24, stiffness: 2.0e+5, damping: 200}}
    shock_absorber: {{stroke: 0.2, gas_length: 0.24, precharge_force: {load},
      compression_damping: 2000, rebound_damping: 6000}}"""

    return f"""name: one
airframe:
  deck: aircraft.bdf
  units: {how.units}
  axes: {{forward: {how.forward}, up: z}}
  select: count 5
  monitoring: {{nose: 1, tip: 12}}
scenario: {{sink_rate: 1.5, forward_speed: 30, pitch: 1, roll: 1}}
simulation: {{duration: 0.08}}
transient: {{step: 5.0e-4}}
gears:{gear("nose", 2, 1.6, 0.0, 400.0)}{gear("right", 11, 3.95, 1.25, 900.0)}\
{gear("left", 21, 3.95, -1.25, 900.0)}
"""
