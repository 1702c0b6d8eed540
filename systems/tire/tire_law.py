"""The force law of a tire: from the motion of a wheel to the force of the ground on it.

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

import numpy as np
import numpy.typing as npt

from systems.runway.runway import Runway
from systems.tire.contact import (
    Constants,
    Tables,
    contact,
    contacts_of_floats,
    elastic_force,
    rolling_radius,
)
from systems.tire.curve_law import CurveLaw
from systems.tire.slip_law import SlipLaw
from systems.tire.tire_parameters import TireParameters
from systems.tools.compiled import COMPILES
from systems.tools.scalar import Scalar
from systems.tools.stops import contact_energy
from systems.tools.table import Table

Float64 = npt.NDArray[np.float64]

# Least relaxation length over the radius, where it follows from the carcass: that of a
# tire that hardly touches would be nothing.
_SHORTEST = 0.5


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
            low_speed=float(p.low_speed),
            ground=float(runway.friction),
        )
        self._numbers = tuple(self._constants)
        self._slip_law = p.magic_formula or self._curve_law()
        along, across = relaxation_lengths(self)
        rolling = p.rolling_radius
        self._tables = Tables(
            elastic=self._elastic,
            damping=self._damping,
            rolling=rolling if isinstance(rolling, Table) else None,
            lag_along=along,
            lag_across=across,
        )
        self._rows = [table and table.rows for table in self._tables]
        self._compiled_slip_law = self._slip_law.compiled_form if COMPILES else None

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
        at = -speed, deflection, load, ground, 0.0
        ft, fl, _ = self._slip_law.wheel_forces(along, across, *at)
        return ft / load, fl / load

    def deflection_under(self, load: float) -> float:
        """Deflection at which the tire carries a load (N) at rest, m; at most half the
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
        return self._slip_law.slopes(self.elastic_force(deflection), deflection)

    def _curve_law(self) -> SlipLaw:
        p = self._p
        return CurveLaw.of_curve(
            p.slip,
            lateral_ratio=float(p.lateral_friction_ratio),
            lateral_scale=float(p.lateral_slip_scale),
            low_speed=float(p.low_speed),
            cornering=p.cornering,
            scale=self._lateral_scale(),
            trail=p.trail,
        )

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
        laws = self._constants, *self._tables, self._slip_law
        return contact(wheel, *ground, slip_state, factors, *laws)

    def contacts(
        self, wheels: npt.NDArray, slips: npt.NDArray | None, factors: npt.NDArray
    ) -> npt.NDArray:
        """(n, 16) of `contact`, of several wheels with this tire.

        Args:
            wheels, slips, factors: (n, 12), (n, 2) or None, (n, 3); of floats, which
                are compiled, or AutoDiffXd.
        """
        listed = [None] * len(wheels) if slips is None else slips.tolist()
        slip_law = self._compiled_slip_law
        if wheels.dtype == object or slip_law is None:
            each = zip(wheels.tolist(), listed, factors.tolist())
            return np.array([self.contact(*given) for given in each])
        grounds = [self._runway.nearest(*wheel) for wheel in wheels[:, :6].tolist()]
        laws = self._numbers, *self._rows, slip_law
        return contacts_of_floats(wheels, np.array(grounds), slips, factors, *laws)
