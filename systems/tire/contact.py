"""What a tire does at its contact point: formulas for floats and AutoDiffXd.

They are written once: `TireLaw` calls them as they are for AutoDiffXd, and compiled for
floats; tables are `Table` there, and their `rows` here when compiled. The directions
are those of `tire_law`; forces of slip are those of a `slip_law.SlipLaw`.
"""

from typing import Any, NamedTuple

import numpy as np

from systems.tire.slip import reference_speed
from systems.tire.slip_law import SlipLaw, relaxation_share, wheel_forces
from systems.tools.compiled import compiled_law, law
from systems.tools.scalar import Scalar, sqrt
from systems.tools.stops import contact_elastic, never_pulling
from systems.tools.table import Table, look_up

# With a relaxation length: least share of it that is left where the tire slides (the
# deflected length is force over stiffness, far less than at the same slip unsaturated).
_LEAST_RELAXATION = 0.1
# With a relaxation length: near standstill the carcass is a spring; this much of its
# stiffness acts as damping (s), fading out at the given speed (m/s).
_STANDSTILL_DAMPING = 0.01
_STANDSTILL_SPEED = 2.5
# Rate of deflection within which hysteresis changes sides, m/s.
_HYSTERESIS_RATE = 0.02


class Constants(NamedTuple):
    """Numbers of one tire on one runway, see `TireParameters`.

    `kept` is the share of the elastic force that unloading gives back, half the
    hysteresis above it; `rim` the deflection of bottoming; `ground` the runway's factor
    on the friction.
    """

    radius: float
    kept: float
    hysteresis: float
    rim: float
    rim_stiffness: float
    rolling_share: float
    rolling_resistance: float
    low_speed: float
    ground: float


class Tables(NamedTuple):
    """Laws of one tire over deflection (m), see `TireParameters`."""

    elastic: Table
    damping: Table
    rolling: Table | None
    lag_along: Table
    lag_across: Table


@law
def elastic_force(
    deflection: Scalar, factor: Scalar, c: Constants, elastic: Table
) -> Scalar:
    """Radial force at rest, N."""
    if deflection <= 0.0:
        return 0.0 * deflection
    force = factor * c.kept * look_up(elastic, deflection)
    if deflection > c.rim:
        force = force + contact_elastic(deflection - c.rim, c.rim_stiffness)
    return force


@law
def rolling_radius(deflection: Scalar, c: Constants, rolling: Table | None) -> Scalar:
    """Speed over spin of a wheel that rolls freely, m."""
    if rolling is not None:
        return look_up(rolling, deflection)
    return c.radius - c.rolling_share * deflection


@law
def lagged(
    slide_t: Scalar,
    slide_l: Scalar,
    travel: Scalar,
    deflection: Scalar,
    slip: Any,
    lag_along: Table,
    lag_across: Table,
    slip_law: SlipLaw,
) -> tuple[Scalar, Scalar, Scalar, Scalar]:
    """Slips that act, and rates of the lagged ones.

    With a relaxation length L the slips lag: L* κ' + |v| κ = v_slide, L* being the
    law's share of L.
    """
    k_t, k_l = slip[0], slip[1]
    share = relaxation_share(slip_law, k_t, k_l, deflection)
    share = share if share > _LEAST_RELAXATION else _LEAST_RELAXATION
    along = look_up(lag_along, deflection)
    across = look_up(lag_across, deflection)
    magnitude = abs(travel)
    rate_t = (slide_t - magnitude * k_t) / (along * share)
    rate_l = (slide_l - magnitude * k_l) / (across * share)
    if magnitude < _STANDSTILL_SPEED:
        fade = 1.0 - magnitude / _STANDSTILL_SPEED
        damping = _STANDSTILL_DAMPING * fade * fade
        k_t = k_t + damping / along * slide_t
        k_l = k_l + damping / across * slide_l
    return k_t, k_l, rate_t, rate_l


@law
def _hysteresis(
    deflection: Scalar, rate: Scalar, factor: Scalar, c: Constants, elastic: Table
) -> Scalar:
    """What loading takes beyond the stored force, and unloading gives less, N."""
    force = 0.5 * c.hysteresis * factor * look_up(elastic, deflection)
    return force * rate / sqrt(rate * rate + _HYSTERESIS_RATE * _HYSTERESIS_RATE)


@law
def _resistance(spin: Scalar, rolling: Scalar, load: Scalar, c: Constants) -> Scalar:
    """Moment of rolling resistance, in the sense of the spin, N m."""
    slow = c.low_speed / c.radius
    sense = spin / sqrt(spin * spin + slow * slow)
    return c.rolling_resistance * load * rolling * sense


@law
def _airborne(
    vx: Scalar,
    vy: Scalar,
    deflection: Scalar,
    slip: Any,
    lag_along: Table,
    lag_across: Table,
) -> tuple[Scalar, ...]:
    """No force; the carcass springs back within a relaxation length of travel."""
    z = 0.0 * deflection
    rate_t, rate_l = z, z
    if slip is not None:
        # +1: springs back at rest, too, and smooth there.
        speed = sqrt(vx * vx + vy * vy + 1.0)
        rate_t = -speed / look_up(lag_along, 0.0) * slip[0]
        rate_l = -speed / look_up(lag_across, 0.0) * slip[1]
    return (z, z, z, z, z, z, deflection, z, z, z, z, z, z, z, rate_t, rate_l)


@law
def contact(
    wheel: Any,
    r: Scalar,
    nx: Scalar,
    ny: Scalar,
    nz: Scalar,
    slip: Any,
    factors: Any,
    c: Constants,
    elastic: Table,
    damping: Table,
    rolling: Table | None,
    lag_along: Table,
    lag_across: Table,
    slip_law: SlipLaw,
) -> tuple[Scalar, ...]:
    """Everything at the contact point, see `TireLaw.contact`.

    Args:
        wheel: (12) of it.
        r, nx, ny, nz: distance of its center from the ground in its plane, m, and the
            surface normal there.
        slip: (2) lagged slips along t and l, or None for the algebraic law.
        factors: (3) on stiffness, damping, friction.
        c, elastic to lag_across: `Constants` and `Tables`.
        slip_law: forces of slip.
    """
    deflection = c.radius - r
    if deflection <= 0.0:
        return _airborne(wheel[6], wheel[7], deflection, slip, lag_along, lag_across)
    ax, ay, az = wheel[3], wheel[4], wheel[5]
    vx, vy, vz = wheel[6], wheel[7], wheel[8]
    wx, wy, wz = wheel[9], wheel[10], wheel[11]
    # t = a × n / cos, e = t × a, l = n × t
    tilt = nx * ax + ny * ay + nz * az
    cos = sqrt(1.0 - tilt * tilt)
    tx = (ay * nz - az * ny) / cos
    ty = (az * nx - ax * nz) / cos
    tz = (ax * ny - ay * nx) / cos
    lx, ly, lz = ny * tz - nz * ty, nz * tx - nx * tz, nx * ty - ny * tx
    # q = P - C = -r e
    qx = -r * (nx - tilt * ax) / cos
    qy = -r * (ny - tilt * ay) / cos
    qz = -r * (nz - tilt * az) / cos
    ux = vx + wy * qz - wz * qy
    uy = vy + wz * qx - wx * qz
    uz = vz + wx * qy - wy * qx
    rate = -(ux * nx + uy * ny + uz * nz) / cos
    free = rolling_radius(deflection, c, rolling)
    spin = wx * ax + wy * ay + wz * az
    # At P the material slides by v_t - r_r ω · a along the wheel.
    slide_t = ux * tx + uy * ty + uz * tz + (r - free) * spin
    slide_l = ux * lx + uy * ly + uz * lz
    travel = vx * tx + vy * ty + vz * tz

    loss = factors[1] * look_up(damping, deflection) * rate
    if c.hysteresis > 0.0:
        loss = loss + _hysteresis(deflection, rate, factors[0], c, elastic)
    static = elastic_force(deflection, factors[0], c, elastic)
    damped = never_pulling(static, loss)
    fz = (static + damped) / cos

    if slip is None:
        speed = reference_speed(travel, c.low_speed)
        k_t, k_l = slide_t / speed, slide_l / speed
        rate_t, rate_l = 0.0 * k_t, 0.0 * k_t
    else:
        k_t, k_l, rate_t, rate_l = lagged(
            slide_t, slide_l, travel, deflection, slip, lag_along, lag_across, slip_law
        )
    grip = factors[2] * c.ground
    ft, fl, turning = wheel_forces(
        slip_law, k_t, k_l, travel, deflection, fz, grip, tilt
    )

    # About the axle: the arm of F_t is the rolling radius; rolling resistance.
    resisting = 0.0 * spin
    if c.rolling_resistance > 0.0:
        resisting = _resistance(spin, free, fz, c)
    about = (r - free) * ft - resisting
    yawing = wx * nx + wy * ny + wz * nz
    fx = fz * nx + ft * tx + fl * lx
    fy = fz * ny + ft * ty + fl * ly
    fw = fz * nz + ft * tz + fl * lz
    lost = damped * rate - ft * slide_t - fl * slide_l
    return (
        qy * fw - qz * fy + about * ax + turning * nx,
        qz * fx - qx * fw + about * ay + turning * ny,
        qx * fy - qy * fx + about * az + turning * nz,
        fx,
        fy,
        fw,
        deflection,
        fz,
        ft,
        fl,
        k_t,
        slide_l,
        travel,
        lost - turning * yawing + resisting * spin,
        rate_t,
        rate_l,
    )


def contacts(
    wheels: Any,
    grounds: Any,
    slips: Any,
    factors: Any,
    numbers: tuple[float, ...],
    elastic: Table,
    damping: Table,
    rolling: Table | None,
    lag_along: Table,
    lag_across: Table,
    slip_law: SlipLaw,
) -> Any:
    """(n, 16) of `contact` of several tires of one kind.

    Args:
        wheels, slips, factors: (n, 12), (n, 2) or None, (n, 3), see `contact`.
        grounds: (n, 4) distance and surface normal of each.
        numbers: `Constants` of all; a plain tuple passes the border of compiled code
            in a fraction of the time.
        elastic to lag_across: `Tables` of all.
        slip_law: forces of slip, of all.
    """
    c = Constants(*numbers)
    out = np.empty((len(wheels), 16))
    for i in range(len(wheels)):
        slip = None if slips is None else slips[i]
        found = contact(
            wheels[i],
            grounds[i, 0],
            grounds[i, 1],
            grounds[i, 2],
            grounds[i, 3],
            slip,
            factors[i],
            c,
            elastic,
            damping,
            rolling,
            lag_along,
            lag_across,
            slip_law,
        )
        for j in range(16):
            out[i, j] = found[j]
    return out


contacts_of_floats = compiled_law(contacts)
"""The same, compiled: tables by their rows, a slip law by its `compiled_form`."""
