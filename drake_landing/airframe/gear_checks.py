"""Whether landing gears fit the aircraft that they are to carry.

What the data of one gear cannot tell: where it lies from its attachment node, and the
load on it at rest. Wrong units and forgotten signs show there. All in the axes A.
"""

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.gear_places import place_remarks, shell_attachments
from drake_landing.case.axes import gear_in_A
from drake_landing.gears.bodies import mass_points, tip_below_root, wheel_centers
from drake_landing.gears.landing_gear import LandingGear, LeveredGear
from drake_landing.gears.leg_laws import leg_oscillators
from drake_landing.gears.parameters import shock_absorber_parameters, tire_parameters
from drake_landing.landing.lift import STANDARD_GRAVITY
from fem.errors import InputError
from fem.model.structure import Structure
from systems.gear.lever_strut import LeverGeometry
from systems.runway.runway import Runway
from systems.shock_absorber.strut_law import StrutLaw
from systems.tire.tire_law import TireLaw

Float64 = npt.NDArray[np.float64]

_REACH = 10.0  # m, farther from its attachment node no part of a gear lies
_LEAST_PRELOAD = 0.02  # of the static load; usual are 10 to 20 %
_LEG_UNITS = {
    "fore_aft": "is its stiffness in N/m?",
    "lateral": "is its stiffness in N/m?",
    "torsion": "is its stiffness in N m/rad?",
    "beam": "is EI in N m²?",
    "matrix": "are its terms in N, m and rad?",
}
_SLOWEST_LEG = 2.0  # Hz; usual are 10 to 40
_TIRE_FLATTENED = (0.005, 0.5)  # static deflection over radius, usual are 0.03 to 0.3


def check_gears(
    structure: Structure, aircraft: Aircraft, R_AB: Float64
) -> tuple[str, ...]:
    """Problems and remarks of an aircraft's gears.

    Args:
        structure: airframe, in B.
        aircraft: gears in B, whose attachment nodes exist.
        R_AB: (3, 3).

    Returns:
        What is odd, see `gear_remarks`.

    Raises:
        InputError: what cannot be, see `gear_problems`.
    """
    points = structure.points
    gears = [gear_in_A(gear, R_AB) for gear in aircraft.gears]
    places = {
        gear.name: R_AB @ points.xyz[points.rows([gear.attachment_node])[0]]
        for gear in gears
    }
    problems = gear_problems(gears, places)
    problems = problems or leg_problems(gears, places)
    if problems:
        raise InputError(problems)
    weight = structure.rigid_mass
    mass, p_AG = weight.total, R_AB @ weight.center
    fields = {
        node: f"gears.{gear.name}.attachment_node"
        for gear in aircraft.gears
        for node in [gear.attachment_node]
    }
    return (
        *gear_remarks(gears, mass, p_AG),
        *place_remarks(gears, places, mass, p_AG),
        *shell_attachments(structure, fields),
    )


def gear_problems(
    gears: Sequence[LandingGear], places: Mapping[str, Float64]
) -> list[str]:
    """Gear data that cannot be; each text begins with the field, `gears.left.axle: `.

    Args:
        gears: in A.
        places: name of each attachment -> (3,) its node in A, m.
    """
    problems = []
    for gear in gears:
        node = places[gear.name]
        parts = gear.sprung_parts | gear.moving_parts
        points = {f"{name}.cg": np.array(part.cg) for name, part in parts.items()}
        points |= {
            name: np.atleast_2d(getattr(gear, name))[0] for name in gear.positions
        }
        if gear.leg is not None and gear.leg.root is not None:
            points["leg.root"] = np.array(gear.leg.root)
        for name, p in points.items():
            away = float(np.linalg.norm(p - node))
            if away > _REACH:
                problems.append(
                    f"gears.{gear.name}.{name}: found a point {away:.0f} m away from "
                    f"the attachment node {gear.attachment_node}, expected less than "
                    f"{_REACH:g} m; all lengths are in m, in the frame of the deck"
                )
        field = "axle" if "axle" in gear.positions else "axle_positions"
        height = max(axle[2] for axle in gear.axles) - node[2]
        if 0.0 <= height <= _REACH:
            problems.append(
                f"gears.{gear.name}.{field}: found an axle {height:.4g} m above the "
                f"attachment node {gear.attachment_node}, expected it below"
            )
        below = tip_below_root(gear, node)
        if below is not None and below <= 0.0 <= -height:
            problems.append(
                f"gears.{gear.name}.leg.root: found a point {-below:.4g} m below the "
                "axle, expected it above, where the leg is clamped"
            )
    return problems


def leg_problems(
    gears: Sequence[LandingGear], places: Mapping[str, Float64]
) -> list[str]:
    """Legs so soft that their stiffness has another unit.

    Args:
        gears, places: as in `gear_problems`, without problems there.
    """
    problems = []
    for gear in gears:
        leg = gear.leg
        if leg is None:
            continue
        for kind, (rate, _) in leg_oscillators(gear, places[gear.name]).items():
            hertz = rate / (2.0 * np.pi)
            law = getattr(leg, kind)
            told = law is not None and (law.frequency or law.frequency_table)
            if hertz < _SLOWEST_LEG and not told:
                field = kind if law else "beam" if leg.beam else "matrix"
                problems.append(
                    f"gears.{gear.name}.leg.{field}: found a leg that swings at "
                    f"{hertz:.3g} Hz ({kind.replace('_', ' and ')}, extended), "
                    f"expected more than {_SLOWEST_LEG:g} Hz: {_LEG_UNITS[field]}"
                )
                if law is None:  # both bendings have one description
                    break
    return problems


def gear_remarks(
    gears: Sequence[LandingGear], mass: float, p_AG: npt.ArrayLike
) -> tuple[str, ...]:
    """Odd loads at rest against gas and tires; each begins with the field.

    Args:
        gears: in A.
        mass: of the airframe, kg.
        p_AG: (3,) its center of gravity in A, m.
    """
    remarks = _direction_remarks(gears, float(np.asarray(p_AG)[0]))
    remarks += [
        f"gears.{gear.name}: found {gear.mass:,.4g} kg, more than the airframe, "
        f"{mass:,.4g} kg: are its masses in kg?"
        for gear in gears
        if gear.mass > mass
    ]
    loads = static_loads(gears, mass, p_AG)
    if loads is None:
        return tuple(remarks)
    for gear in gears:
        load = loads[gear.name]
        if load <= 0.0:
            remarks.append(
                f"gears.{gear.name}: carries {load / 1e3:.4g} kN at rest: the center "
                "of gravity lies outside the wheels"
            )
            continue
        found = (*_gas_remarks(gear, load), *_tire_remarks(gear, load))
        remarks += [f"gears.{gear.name}.{text}" for text in found]
    return tuple(remarks)


def _direction_remarks(gears: Sequence[LandingGear], center: float) -> list[str]:
    """Nose gears behind the center of gravity: the deck may point the other way."""
    behind = {
        gear.name: np.mean([axle[0] for axle in gear.axles]) - center for gear in gears
    }
    return [
        f"airframe.axes.forward: gear {name} lies {away:.3g} m behind the center of "
        "gravity, seen in the direction of flight: does the deck point that way?"
        for name, away in behind.items()
        if name.startswith("nose") and away > 0.0
    ]


def static_loads(
    gears: Sequence[LandingGear], mass: float, p_AG: npt.ArrayLike
) -> dict[str, float] | None:
    """Vertical load on each gear at rest, by the lever rule, N; None without balance.

    Of more than three gears those of the least sum of squares.
    """
    items = [(mass, np.asarray(p_AG, dtype=float))]
    for gear in gears:
        items += mass_points(gear)
    weight = STANDARD_GRAVITY * np.array([m for m, _ in items])
    arms = np.array([p for _, p in items])
    feet = [np.mean(list(wheel_centers(gear).values()), axis=0) for gear in gears]
    rows = np.array([[1.0, foot[0], foot[1]] for foot in feet]).T
    wanted = np.array([weight.sum(), weight @ arms[:, 0], weight @ arms[:, 1]])
    loads = np.linalg.lstsq(rows, wanted, rcond=1e-9)[0]
    if np.abs(rows @ loads - wanted).max() > 1e-6 * wanted[0]:
        return None
    return {gear.name: float(load) for gear, load in zip(gears, loads)}


def _gas_remarks(gear: LandingGear, load: float) -> list[str]:
    parameters = shock_absorber_parameters(gear.shock_absorber)
    below = gear.unsprung_mass * STANDARD_GRAVITY
    wanted = (load - below) * _strut_share(gear)
    law, stroke = StrutLaw(parameters), parameters.max_stroke
    full = law.gas_force(
        stroke, parameters.tunables, law.settled(stroke, parameters.tunables)
    )
    preload = parameters.gas.precharge
    at_rest = f"the shock absorber carries {wanted / 1e3:.4g} kN at rest"
    if preload >= wanted:
        return [
            f"shock_absorber.precharge_force: found {preload / 1e3:.4g} kN, but "
            f"{at_rest}: it stays extended"
        ]
    if full <= wanted:
        return [
            f"shock_absorber: the gas gives {full / 1e3:.4g} kN at full stroke, but "
            f"{at_rest}: it bottoms"
        ]
    if preload < _LEAST_PRELOAD * wanted:
        return [
            f"shock_absorber.precharge_force: found {preload:.4g} N, but {at_rest}; "
            "usual are 10 to 20 % of that"
        ]
    return []


def _strut_share(gear: LandingGear) -> float:
    """Force of the shock absorber over the load on the axle, extended."""
    if not isinstance(gear, LeveredGear):
        return 1.0
    pivot = np.array(gear.pivot)
    ends = np.array([gear.absorber_upper, gear.absorber_lower]) - pivot
    geometry = LeverGeometry.between(*ends, (0.0, 1.0, 0.0))
    return abs((gear.axle[0] - pivot[0]) / geometry.ratio(0.0))


def _tire_remarks(gear: LandingGear, load: float) -> list[str]:
    """Remarks on the common tire, where it bears its share, and on single tires."""
    each, remarks = load / len(gear.wheel_names), []
    tires = {"tyre": gear.tyre} if len(gear.tyres) < len(gear.wheel_names) else {}
    tires |= {f"tyres.{wheel}": tire for wheel, tire in gear.tyres.items()}
    for name, data in tires.items():
        tire = tire_parameters(data)
        law = TireLaw(tire, Runway())
        low, high = (share * tire.radius for share in _TIRE_FLATTENED)
        if law.elastic_force(low) < each < law.elastic_force(high):
            continue
        field = "load_table" if data.load_table else "stiffness"
        little = each <= law.elastic_force(low)
        side, bound = ("less", low) if little else ("more", high)
        if data.inflation != 1.0 and not little:
            continue  # flat on purpose: others bear its share
        remarks.append(
            f"{name}.{field}: at rest {each / 1e3:.4g} kN flatten the tire by {side} "
            f"than {bound:.3g} m; stiffness is in N/m"
        )
    return remarks
