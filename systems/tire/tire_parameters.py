"""Parameters of a tire, checked; and a vertical law from its inflation."""

from dataclasses import dataclass, field

from systems.tire.magic_formula import MagicFormula
from systems.tire.slip import SineSlip, SlipCurve
from systems.tools.checks import require
from systems.tools.table import Table


@dataclass(frozen=True, kw_only=True)
class TireParameters:
    """Parameters of a tire.

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
            of the unloaded one: a third for a tire that rolls, 1 is the loaded radius;
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
        magic_formula: forces of slip in place of `slip`, `lateral_friction_ratio`,
            `lateral_slip_scale`, `cornering` and `trail`.
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
