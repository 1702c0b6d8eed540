"""Reference nodes of the frames, tied to skin and crossbeam."""

from drake_landing.reference.d150.fuselage.hull import Hull
from drake_landing.reference.d150.fuselage.passenger_floor import PassengerFloor
from drake_landing.reference.d150.reference_axis import NodeGroup
from drake_landing.reference.d150.ties import tie

TIES = "ties fuselage"


def tie_frames(hull: Hull, floor: PassengerFloor, group: NodeGroup) -> None:
    """Each reference node moves with the mean of its frame's skin and crossbeam.

    Grids that follow the wing or the fin are left out.
    """
    model = hull.halves.model
    for row, number in enumerate(hull.rows.frame):
        if number < 0:
            continue
        twins = [*hull.ring(row)]
        if row in floor.beams:
            twins += floor.beam(row)[:-1]
        grids = sorted({int(i) for twin in twins for i in twin})
        free = [i for i in grids if (i, 1) not in model.dependent]
        tie(model, TIES, group.ids[int(number)], free)
