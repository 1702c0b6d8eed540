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

All forces turn with the wheel: nothing depends on heading, nor on position on a flat
runway.
"""

from dataclasses import dataclass, field

from systems.runway.runway import Runway
from systems.tire.slip import SineSlip, SlipCurve, reference_speed, secant
from systems.tools.checks import require
from systems.tools.scalar import Scalar
from systems.tools.stops import contact_elastic, contact_energy, never_pulling
from systems.tools.table import Table

# With a relaxation length: least share of it that is left where the tyre slides (the
# deflected length is force over stiffness, far less than at the same slip unsaturated).
_LEAST_RELAXATION = 0.1
# With a relaxation length: near standstill the carcass is a spring; this much of its
# stiffness acts as damping (s), fading out at the given speed (m/s).
_STANDSTILL_DAMPING = 0.01
_STANDSTILL_SPEED = 2.5


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

    def elastic_force(self, deflection: Scalar, factor: Scalar = 1.0) -> Scalar:
        """Radial force at rest, N."""
        if deflection <= 0.0:
            return 0.0
        force = factor * self._elastic.value(deflection)
        if deflection > self._rim:
            force = force + contact_elastic(deflection - self._rim, self._rim_stiffness)
        return force

    def energy(self, deflection: Scalar, factor: Scalar = 1.0) -> Scalar:
        """Energy stored in the radial deflection, J."""
        if deflection <= 0.0:
            return 0.0
        return factor * self._elastic.integral(deflection) + contact_energy(
            deflection - self._rim, self._rim_stiffness
        )

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
        px, py, pz, ax, ay, az, vx, vy, vz, wx, wy, wz = wheel
        r, nx, ny, nz = self._runway.nearest(px, py, pz, ax, ay, az)
        deflection = self._p.radius - r
        if deflection <= 0.0:
            return self._airborne(wheel, deflection, slip_state)
        # t = a × n / c, e = t × a, l = n × t
        tilt = nx * ax + ny * ay + nz * az
        c = _cosine(tilt)
        tx = (ay * nz - az * ny) / c
        ty = (az * nx - ax * nz) / c
        tz = (ax * ny - ay * nx) / c
        lx, ly, lz = ny * tz - nz * ty, nz * tx - nx * tz, nx * ty - ny * tx
        # q = P - C = -r e
        qx, qy, qz = (
            -r * (nx - tilt * ax) / c,
            -r * (ny - tilt * ay) / c,
            -r * (nz - tilt * az) / c,
        )
        ux, uy, uz = (
            vx + wy * qz - wz * qy,
            vy + wz * qx - wx * qz,
            vz + wx * qy - wy * qx,
        )
        rate = -(ux * nx + uy * ny + uz * nz) / c
        slide_t = ux * tx + uy * ty + uz * tz
        slide_l = ux * lx + uy * ly + uz * lz
        travel = vx * tx + vy * ty + vz * tz

        elastic = self.elastic_force(deflection, factors[0])
        damping = never_pulling(
            elastic, factors[1] * self._damping.value(deflection) * rate
        )
        fz = (elastic + damping) / c
        slip, ft, fl, rate_t, rate_l = self._friction(
            slide_t, slide_l, travel, fz * factors[2], slip_state
        )
        fx, fy, fz_w = (
            fz * nx + ft * tx + fl * lx,
            fz * ny + ft * ty + fl * ly,
            fz * nz + ft * tz + fl * lz,
        )
        return (
            qy * fz_w - qz * fy,
            qz * fx - qx * fz_w,
            qx * fy - qy * fx,
            fx,
            fy,
            fz_w,
            deflection,
            fz,
            ft,
            fl,
            slip,
            slide_l,
            travel,
            damping * rate - ft * slide_t - fl * slide_l,
            rate_t,
            rate_l,
        )

    def _friction(
        self,
        slide_t: Scalar,
        slide_l: Scalar,
        travel: Scalar,
        normal: Scalar,
        slip_state: list[Scalar] | None,
    ) -> tuple[Scalar, Scalar, Scalar, Scalar, Scalar]:
        """Slip along t, F_t, F_l, rates of the lagged slips.

        With a relaxation length L the slips lag: L* κ' + |v| κ = v_slide, L* falling
        from L with the secant of the friction curve, as the carcass deflects by force
        over stiffness.
        """
        p = self._p
        speed = reference_speed(travel, p.low_speed)
        if slip_state is None:
            k_t, k_l = slide_t / speed, slide_l / speed
            rate_t = rate_l = 0.0
        else:
            k_t, k_l = slip_state
            length = p.relaxation_length
            share = (
                secant(p.slip, k_t, p.lateral_slip_scale * k_l) / p.slip.initial_slope
            )
            lag = length * (share if share > _LEAST_RELAXATION else _LEAST_RELAXATION)
            magnitude = abs(travel)
            rate_t = (slide_t - magnitude * k_t) / lag
            rate_l = (slide_l - magnitude * k_l) / lag
            if magnitude < _STANDSTILL_SPEED:
                fade = 1.0 - magnitude / _STANDSTILL_SPEED
                per_speed = _STANDSTILL_DAMPING / length * fade * fade
                k_t = k_t + per_speed * slide_t
                k_l = k_l + per_speed * slide_l
        across = p.lateral_slip_scale * k_l
        share = normal * self._runway.friction * secant(p.slip, k_t, across)
        return (
            k_t,
            -share * k_t,
            -share * p.lateral_friction_ratio * across,
            rate_t,
            rate_l,
        )

    def _airborne(
        self,
        wheel: list[Scalar],
        deflection: Scalar,
        slip_state: list[Scalar] | None,
    ) -> tuple[Scalar, ...]:
        """No force; the carcass springs back within a relaxation length of travel."""
        rate_t = rate_l = 0.0
        if slip_state is not None:
            vx, vy = wheel[6], wheel[7]
            # +1: springs back at rest, too, and smooth there.
            decay = (vx * vx + vy * vy + 1.0) ** 0.5 / self._p.relaxation_length
            rate_t, rate_l = -decay * slip_state[0], -decay * slip_state[1]
        z = 0.0 * deflection
        return (z, z, z, z, z, z, deflection, *([z] * 7), rate_t, rate_l)


def _cosine(tilt: Scalar) -> Scalar:
    return (1.0 - tilt * tilt) ** 0.5
