"""The force law of a tyre: from the motion of a wheel to the force of the ground on it.

Directions at the contact point, n the surface normal and a the axle (starboard at
rest): t = a × n along the wheel, aft when a is starboard; l = n × t across it; e, the
normal turned into the plane of the wheel. The contact point P = C - r_r e has the
velocity v_P = v_C + ω × (P - C) of the wheel's material. With a slip velocity
v_P · t = v_C · t - r_r ω · a, free rolling toward -x turns a wheel with a = +y by
ω · y = v_x/r_r < 0.

Radial force F_r = elastic(δ) + damping(δ) δ', δ = r - r_r, not less than zero. F_z
along n is F_r/cos(camber): then ground power and stored energy balance for any tilt,
because δ' = -v_P · n / cos(camber).

The wheel rolls freely where v_C · t = R ω · a: R, the rolling radius, lies between
loaded and unloaded radius. Slip is v_C · t - R ω · a, and the force along the wheel has
the arm R about the axle: the ground does the work F × slip and no other, whatever R
is. R differs from r_r by the load, which moves fore and aft within the footprint.

The side force acts behind the middle of the footprint by the pneumatic trail: a moment
about n that turns the wheel into its direction of travel.

All forces turn with the wheel: nothing depends on heading, nor on position on a flat
runway.
"""

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from systems.runway.runway import Runway
from systems.tire.aircraft_tire import trail_share
from systems.tire.contact import (
    Constants,
    Tables,
    contact,
    contacts_of_floats,
    elastic_force,
    friction,
    rolling_radius,
)
from systems.tire.magic_formula import MagicFormula
from systems.tire.slip import SineSlip, SlipCurve, TabulatedSlip, constants
from systems.tools.checks import require
from systems.tools.scalar import Scalar
from systems.tools.stops import contact_energy
from systems.tools.table import Table

Float64 = npt.NDArray[np.float64]

# Least relaxation length over the radius, where it follows from the carcass: that of a
# tyre that hardly touches would be nothing.
_SHORTEST = 0.5


@dataclass(frozen=True, kw_only=True)
class TireParameters:
    """Parameters of a tyre.

    Attributes:
        radius: m, unloaded.
        stiffness: N/m, or a table of force (N) over deflection (m) from (0, 0).
        nominal_force: N, F_zN in F_z = c_1 δ - F_zN; with a number for stiffness only.
        damping: N s/m, or a table of it over deflection (m) from (0, 0).
        damping_ramp: m, deflection over which a constant damping sets in, so that
            touchdown brings no jump of force.
        bottoming_deflection: m, where the rim adds bottoming_stiffness (N/m).
        slip: friction over slip on the dry surface.
        lateral_friction_ratio: ν, friction across over friction along the wheel.
        lateral_slip_scale: c, slope of the side force over that of the drag.
        relaxation_length: m; 0 is the algebraic law, without states.
        rolling_radius: share of the deflection by which the rolling radius falls short
            of the unloaded one: a third for a tyre that rolls, 1 is the loaded radius;
            or a table of the rolling radius (m) over deflection (m).
        cornering: table of the side force per angle at small angles (N/rad) over
            deflection (m); None: the slope of `slip`.
        trail: table of the pneumatic trail at small angles (m) over deflection (m).
        fore_aft_stiffness, lateral_stiffness: of the carcass, N/m or a table of it over
            deflection (m); both or none. The relaxation lengths follow: slope of the
            force over slip divided by the stiffness.
        hysteresis: work lost in a cycle of slow loading over the work of loading;
            loading follows `stiffness`.
        rolling_resistance: moment about the axle over F_z and rolling radius.
        low_speed: m/s, speed of travel below which slip is regularised.

    Raises:
        ValueError: a value is out of range; the message names it, its unit and range.
    """

    radius: float
    stiffness: float | Table
    nominal_force: float = 0.0
    damping: float | Table = 0.0
    damping_ramp: float = 0.005
    bottoming_deflection: float | None = None
    bottoming_stiffness: float = 2e7
    slip: SlipCurve = field(default_factory=SineSlip)
    lateral_friction_ratio: float = 1.0
    lateral_slip_scale: float = 1.0
    relaxation_length: float = 0.0
    rolling_radius: float | Table = 1.0 / 3.0
    cornering: Table | None = None
    trail: Table | None = None
    fore_aft_stiffness: float | Table | None = None
    lateral_stiffness: float | Table | None = None
    hysteresis: float = 0.0
    rolling_resistance: float = 0.0
    magic_formula: MagicFormula | None = None
    low_speed: float = 0.5

    def __post_init__(self) -> None:
        require("tire", "radius", self.radius, "m", above=0.0)
        if isinstance(self.stiffness, Table):
            _require_force_table(self.stiffness)
            if self.nominal_force != 0.0:
                raise ValueError(
                    f"tire: nominal_force is {self.nominal_force} N, expected 0 where "
                    "stiffness is a table"
                )
        else:
            require("tire", "stiffness", self.stiffness, "N/m", above=0.0)
            require("tire", "nominal_force", self.nominal_force, "N", at_least=0.0)
        if isinstance(self.damping, Table):
            table = self.damping
            if (table.x[0], table.y[0]) != (0.0, 0.0) or min(table.y) < 0.0:
                raise ValueError(
                    "tire: the damping table must start at (0, 0) and have no "
                    "negative value"
                )
        else:
            require("tire", "damping", self.damping, "N s/m", at_least=0.0)
        if self.bottoming_deflection is not None:
            require(
                "tire",
                "bottoming_deflection",
                self.bottoming_deflection,
                "m",
                above=0.0,
                at_most=self.radius,
            )
        for name, unit in (
            ("damping_ramp", "m"),
            ("bottoming_stiffness", "N/m"),
            ("lateral_friction_ratio", ""),
            ("lateral_slip_scale", ""),
            ("low_speed", "m/s"),
        ):
            require("tire", name, getattr(self, name), unit, above=0.0)
        require("tire", "relaxation_length", self.relaxation_length, "m", at_least=0.0)
        for name, bound in (("hysteresis", 0.9), ("rolling_resistance", 0.5)):
            value = getattr(self, name)
            require("tire", name, value, "", at_least=0.0, at_most=bound)
        self._check_tables()

    def _check_tables(self) -> None:
        rolling = self.rolling_radius
        if isinstance(rolling, Table):
            if not 0.0 < min(rolling.y) <= max(rolling.y) <= 1.1 * self.radius:
                raise ValueError(
                    f"tire: rolling_radius goes from {min(rolling.y)} to "
                    f"{max(rolling.y)} m, expected > 0 m and about the radius, "
                    f"{self.radius} m, at most"
                )
        else:
            require("tire", "rolling_radius", rolling, "", at_least=0.0, at_most=1.0)
        for name in ("cornering", "trail"):
            table = getattr(self, name)
            if table is not None and min(table.y) < 0.0:
                raise ValueError(f"tire: {name} has a negative value, expected >= 0")
        carcass = (self.fore_aft_stiffness, self.lateral_stiffness)
        if (carcass[0] is None) != (carcass[1] is None):
            raise ValueError(
                "tire: fore_aft_stiffness and lateral_stiffness: found one, expected "
                "both or none"
            )
        if carcass[0] is not None and self.relaxation_length > 0.0:
            raise ValueError(
                "tire: relaxation_length beside stiffnesses of the carcass, expected "
                "one or the other: the length follows from them"
            )

    @property
    def lagged(self) -> bool:
        """Whether the slips are states."""
        return self.relaxation_length > 0.0 or self.lateral_stiffness is not None


def relaxation_lengths(law: "TireLaw") -> tuple[Table, Table]:
    """Along and across the wheel over deflection, m; 1 where there are no states."""
    p = law.parameters
    if p.fore_aft_stiffness is None or p.lateral_stiffness is None:
        length = p.relaxation_length or 1.0
        fixed = Table((0.0, 1.0), (length, length))
        return fixed, fixed
    x = [p.radius * i / 160 for i in range(81)]
    least = _SHORTEST * p.radius
    tables = []
    for i, stiffness in enumerate((p.fore_aft_stiffness, p.lateral_stiffness)):
        y = []
        for d in x:
            k = stiffness.value(d) if isinstance(stiffness, Table) else stiffness
            y.append(max(law.slopes(d)[i] / k, least) if k > 0.0 else least)
        tables.append(Table(x, y))
    return tables[0], tables[1]


def _require_force_table(table: Table) -> None:
    if (table.x[0], table.y[0]) != (0.0, 0.0):
        raise ValueError(
            f"tire: the stiffness table starts at ({table.x[0]} m, {table.y[0]} N), "
            "expected (0, 0)"
        )
    if not table.ascending:
        raise ValueError("tire: the force in the stiffness table must not decrease")


def inflated_stiffness(
    *,
    c1: float,
    c2: float,
    pressure: float,
    max_deflection: float,
    points: int = 401,
) -> Table:
    """Table of F = x²/(c1 + c2 x/p), soft at first and linear at large deflection.

    Args:
        c1: m²/N.
        c2: m Pa/N.
        pressure: Pa, inflation pressure p.
        max_deflection: m, last point of the table; continued linearly.
        points: number of points.
    """
    require("tire", "c1", c1, "m²/N", above=0.0)
    require("tire", "c2", c2, "m Pa/N", above=0.0)
    require("tire", "pressure", pressure, "Pa", above=0.0)
    require("tire", "max_deflection", max_deflection, "m", above=0.0)
    x = [max_deflection * i / (points - 1) for i in range(points)]
    y = [d * d / (c1 + c2 * d / pressure) for d in x]
    return Table(x, y, extend=True)


class TireLaw:
    """Pure functions of a wheel's motion; floats or AutoDiffXd throughout.

    `factors` multiply stiffness, damping and friction.
    """

    def __init__(self, parameters: TireParameters, runway: Runway) -> None:
        p = parameters
        runway.require_rollable(p.radius)
        self._p, self._runway = p, runway
        if isinstance(p.stiffness, Table):
            self._elastic = Table(p.stiffness.x, p.stiffness.y, extend=True)
        else:
            gap = p.nominal_force / p.stiffness
            x, y = (0.0, gap + 1.0), (0.0, float(p.stiffness))
            if gap > 0.0:
                x, y = (0.0, gap, gap + 1.0), (0.0, 0.0, float(p.stiffness))
            self._elastic = Table(x, y, extend=True)
        if isinstance(p.damping, Table):
            self._damping = p.damping
        else:
            self._damping = Table((0.0, p.damping_ramp), (0.0, p.damping))
        self._rim = (
            p.radius if p.bottoming_deflection is None else (p.bottoming_deflection)
        )
        self._rim_stiffness = (
            0.0 if p.bottoming_deflection is None else p.bottoming_stiffness
        )
        self._constants = Constants(
            radius=float(p.radius),
            kept=1.0 - 0.5 * p.hysteresis,
            hysteresis=float(p.hysteresis),
            rim=float(self._rim),
            rim_stiffness=float(self._rim_stiffness),
            rolling_share=(
                0.0 if isinstance(p.rolling_radius, Table) else float(p.rolling_radius)
            ),
            rolling_resistance=float(p.rolling_resistance),
            lateral_ratio=float(p.lateral_friction_ratio),
            lateral_scale=float(p.lateral_slip_scale),
            low_speed=float(p.low_speed),
            ground=float(runway.friction),
        )
        along, across = relaxation_lengths(self)
        # The trail falls with the slip as it does with the angle.
        per_slip = p.slip.initial_slope / p.slip.peak if p.slip.peak else 1.0
        slips = [4.0 / per_slip * i / 80 for i in range(81)]
        rolling = p.rolling_radius
        self._tables = Tables(
            elastic=self._elastic,
            damping=self._damping,
            rolling=rolling if isinstance(rolling, Table) else None,
            curve=p.slip,
            scale=self._lateral_scale(),
            lag_along=along,
            lag_across=across,
            trail=p.trail,
            trail_share=Table(slips, [trail_share(per_slip * s) for s in slips]),
        )
        self._rows = [
            constants(table)
            if isinstance(table, SineSlip | TabulatedSlip)
            else table and table.rows
            for table in self._tables
        ]

    @property
    def parameters(self) -> TireParameters:
        return self._p

    def rolling_radius(self, deflection: Scalar) -> Scalar:
        """Speed over spin of a wheel that rolls freely, m."""
        rolling = self._p.rolling_radius
        table = rolling if isinstance(rolling, Table) else None
        return rolling_radius(deflection, self._constants, table)

    def ratios(
        self, deflection: Scalar, along: Scalar, across: Scalar
    ) -> tuple[Scalar, Scalar]:
        """F_t and F_l over F_z of a wheel that rolls steadily toward -t.

        Args:
            deflection: m, > 0.
            along, across: sliding velocity along t and l over the speed.
        """
        speed, ground = 10.0 * self._p.low_speed, self._runway.friction
        load = self.elastic_force(deflection)
        if not load > 0.0:
            return 0.0, 0.0
        wheel_slip = along, across
        if self._p.magic_formula is not None:
            forces = self._p.magic_formula.along_wheel(load, *wheel_slip, -speed, 0.0)
            return forces[0] * ground / load, forces[1] * ground / load
        t = self._tables
        scale = self._p.lateral_slip_scale
        if t.scale is not None:
            scale = t.scale.value(deflection)
        common = (ground, scale, self._constants, t.curve, t.trail, t.trail_share)
        forces = friction(*wheel_slip, -speed, deflection, load, *common)
        return forces[0] / load, forces[1] / load

    def deflection_under(self, load: float) -> float:
        """Deflection at which the tyre carries a load (N) at rest, m; at most half the
        radius.
        """
        low, high = 0.0, 0.5 * self._p.radius
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (
                (middle, high) if self.elastic_force(middle) < load else (low, middle)
            )
        return high

    def slopes(self, deflection: float) -> tuple[float, float]:
        """Force per slip at small slip, along and across the wheel at rest, N."""
        p, load = self._p, self.elastic_force(deflection)
        if p.magic_formula is not None:
            return p.magic_formula.slopes(load)
        along = p.slip.initial_slope * load
        if p.cornering is not None:
            return along, p.cornering.value(deflection)
        return along, along * p.lateral_friction_ratio * p.lateral_slip_scale

    def _lateral_scale(self) -> Table | None:
        """c over deflection, where the cornering power is given."""
        p = self._p
        if p.cornering is None or not p.slip.initial_slope > 0.0:
            return None
        slope = p.slip.initial_slope * p.lateral_friction_ratio
        least = 1e-3 * self.elastic_force(0.1 * p.radius)
        x = [p.radius * i / 200 for i in range(1, 101)]
        points = [
            (d, p.cornering.value(d) / (slope * load))
            for d in x
            if (load := self.elastic_force(d)) > least
        ]
        return Table(*zip(*points))

    def elastic_force(self, deflection: Scalar, factor: Scalar = 1.0) -> Scalar:
        """Radial force at rest, N."""
        return elastic_force(deflection, factor, self._constants, self._elastic)

    def energy(self, deflection: Scalar, factor: Scalar = 1.0) -> Scalar:
        """Energy stored in the radial deflection, J."""
        if deflection <= 0.0:
            return 0.0
        stored = factor * self._constants.kept * self._elastic.integral(deflection)
        return stored + contact_energy(deflection - self._rim, self._rim_stiffness)

    def deflection(self, wheel: list[Scalar]) -> Scalar:
        """r - r_r, m; negative is the clearance."""
        return self._p.radius - self._runway.nearest(*wheel[:6])[0]

    def contact(
        self,
        wheel: list[Scalar],
        slip_state: list[Scalar] | None,
        factors: list[Scalar],
    ) -> tuple[Scalar, ...]:
        """Everything at the contact point.

        Args:
            wheel: (12) p_WC, axle direction, v_WC, ω_WH; m, m/s, rad/s, W.
            slip_state: lagged slip along t and l, or None for the algebraic law.
            factors: on stiffness, damping, friction.

        Returns:
            0-5 torque about C (N m) and force (N) on the wheel, W; 6 deflection, m;
            7 F_z; 8 F_t; 9 F_l, N; 10 slip along t; 11 slip velocity across, m/s;
            12 speed of travel along t, m/s; 13 dissipated power, W; 14, 15 rates of
            the lagged slips, 1/s.
        """
        ground = self._runway.nearest(*wheel[:6])
        tables = self._tables, self._p.magic_formula
        return contact(
            wheel, *ground, slip_state, factors, self._constants, *tables[0], tables[1]
        )

    def contacts(
        self, wheels: npt.NDArray, slips: npt.NDArray | None, factors: npt.NDArray
    ) -> npt.NDArray:
        """(n, 16) of `contact`, of several wheels with this tyre.

        Args:
            wheels, slips, factors: (n, 12), (n, 2) or None, (n, 3); of floats, which
                are compiled, or AutoDiffXd.
        """
        listed = [None] * len(wheels) if slips is None else slips.tolist()
        if wheels.dtype == object or self._p.magic_formula is not None:
            each = zip(wheels.tolist(), listed, factors.tolist())
            return np.array([self.contact(*given) for given in each])
        grounds = [self._runway.nearest(*wheel) for wheel in wheels[:, :6].tolist()]
        return contacts_of_floats(
            wheels, np.array(grounds), slips, factors, self._constants, *self._rows
        )
