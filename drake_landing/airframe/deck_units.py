"""Units of a user's deck: noticed where they cannot be right, undone in what he gets.

Inside everything is SI; a deck in other units is converted when it is read
(`fem.deck.units`), and the loads handed over to it are written in its own.
"""

from dataclasses import replace

import numpy as np

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.landing.handover import AttachmentLoads
from fem.deck.units import SYSTEMS, Units, units_of
from fem.errors import InputError
from fem.model.structure import Structure

_SPAN = (0.5, 300.0)  # m, of anything that lands
_REACH = 10.0  # m, farther from its attachment node no axle lies


def check_units(structure: Structure, aircraft: Aircraft) -> None:
    """The deck has the size of an aircraft, and its gears are where it is.

    Args:
        structure: in SI, as the units of the case say.
        aircraft: whose attachment nodes exist.

    Raises:
        InputError: another system of units fits and the one of the case does not.
    """
    points, found = structure.points, aircraft.units
    span = float(np.ptp(points.xyz, axis=0).max())
    nodes = points.xyz[points.rows([g.attachment_node for g in aircraft.gears])]
    axles = np.array([gear.axles[0] for gear in aircraft.gears])

    def fits(factor: float) -> bool:
        away = np.linalg.norm(factor * nodes - axles, axis=1)
        return bool(_SPAN[0] < factor * span < _SPAN[1] and away.max() < _REACH)

    length = units_of(found).length
    others = {n: u.length / length for n, u in SYSTEMS.items() if n != found}
    fitting = [name for name, factor in others.items() if fits(factor)]
    if not fits(1.0) and fitting:
        away = np.linalg.norm(nodes - axles, axis=1).max()
        raise InputError(
            f"airframe.units: found {found}, in which the deck spans {span:,.4g} m and "
            f"gears lie up to {away:,.4g} m from their attachment nodes; expected "
            f"{' or '.join(fitting)}, which fits. Gears are given in SI in any case"
        )


def in_deck_units(loads: AttachmentLoads, units: Units) -> AttachmentLoads:
    """Loads in N and N m, in the units of a deck."""
    six = np.repeat([units.force, units.moment], 3)
    return replace(loads, load=loads.load / six)
