"""The center wing box in the fuselage: skin on its upper cover, walls beside its spars.

The skin ends on the upper cover, the main frames and the walls at C36 and C42 end on
the spars, the keel beam on the lower cover, the floor's struts stand on the upper one.
"""

from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.hull import Hull
from drake_landing.reference.d150.fuselage.passenger_floor import (
    FLOOR,
    PassengerFloor,
    strut_head,
)
from drake_landing.reference.d150.fuselage.walls import add_spar_wall
from drake_landing.reference.d150.fuselage.wing_fit import Fit

JOINT = "fuselage wing joint"


def add_wing_junction(hull: Hull, floor: PassengerFloor, fit: Fit) -> None:
    """Joins skin, main frames, walls and floor to the wing box."""
    front, rear = facts("fuselage")["wing_frames"]
    for frame, face in ((front, "front"), (rear, "rear")):
        fit.to_face(JOINT, hull.at(hull.rows.at(frame), hull.line("wing")), face)
        add_spar_wall(hull, floor, frame, face, fit)
    for row in hull.rows.between(front, rear)[1:-1]:
        fit.to_face(JOINT, hull.at(row, hull.line("wing")), "upper")
    _struts(hull, floor, fit)


def _struts(hull: Hull, floor: PassengerFloor, fit: Fit) -> None:
    halves = hull.halves
    for row in hull.rows.frames(*facts("fuselage")["wing_frames"])[1:-1]:
        head = strut_head(floor, row)
        p = halves.position(head).copy()
        p[2] = fit.height("upper", p[0])
        foot = halves.grids(FLOOR, p[None])[0]
        fit.to_face(FLOOR, foot, "upper")
        halves.strut(FLOOR, head, foot)
