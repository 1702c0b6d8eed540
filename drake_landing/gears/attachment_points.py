"""How the airframe's nodes hold the gears: data of the gears as `AttachmentPoint`s."""

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from drake_landing.gears.bodies import GearBodies
from drake_landing.gears.landing_gear import LandingGear
from systems.airframe.modal_body import ModalBody
from systems.attachment.attachment_points import AttachmentPoint

Float64 = npt.NDArray[np.float64]

# Least elastic compliance of the airframe against a self-balanced load of a gear, over
# the largest one of its nodes.
_LEAST_COMPLIANCE = 1e-9


def attachment_places(
    body: ModalBody, gears: Sequence[LandingGear]
) -> dict[str, Float64]:
    """Name of each attachment -> (3,) its node in B, undeformed, m.

    Raises:
        ValueError: the body does not have a node; the message names the attachment.
    """
    places = {}
    for gear in gears:
        for name, node in gear.attachments.items():
            try:
                places[name] = body.p_BN[body.rows(node)[0]]
            except ValueError as error:
                raise ValueError(
                    f"attachment {name} of gear {gear.name}: {error}; expected one of "
                    f"its {len(body.node_id)} nodes"
                ) from None
    return places


def attachment_points(
    gears: Sequence[LandingGear],
    bodies: Mapping[str, GearBodies],
    places: Mapping[str, Float64],
) -> list[AttachmentPoint]:
    """Attachment points of all gears, in the order of `LandingGear.attachments`.

    Raises:
        ValueError: directions are not independent.
    """
    points = []
    for gear in gears:
        fitting, origin = bodies[gear.name].fitting, places[gear.name]
        points.append(AttachmentPoint(fitting=fitting, hold=gear.attachment))
        points += [
            AttachmentPoint(
                fitting=fitting,
                hold=np.array(hold.directions, dtype=float),
                p_FN=places[f"{gear.name}_{hold.name}"] - origin,
                stiffness=hold.stiffness,
                damping=hold.damping,
            )
            for hold in gear.further_attachments
        ]
    return points


def require_shared_loads(
    body: ModalBody,
    gears: Sequence[LandingGear],
    points: Sequence[AttachmentPoint],
    nodes: Sequence[int],
) -> None:
    """Checks that loads of gears held in more than six directions have one split.

    Such a hold can be loaded by forces that balance each other on the fitting; the
    airframe has to yield to every such set.

    Raises:
        ValueError: the airframe is rigid against one.
    """
    of_node = dict(zip(points, body.rows(nodes)))
    for gear in gears:
        own = [p for p in points if p.fitting.name() == f"{gear.name}_fitting"]
        rows = [(p, row) for p in own for row in _rigid_rows(p)]
        on_fitting = np.array([np.r_[np.cross(p.p_FN, f) + m, f] for p, (m, f) in rows])
        modes = np.array(
            [
                m @ body.rotation[of_node[p]] + f @ body.translation[of_node[p]]
                for p, (m, f) in rows
            ]
        )
        balanced = np.linalg.svd(on_fitting.T)[2][6:]
        if not len(balanced):
            continue
        compliance = (modes / body.modal_mass) @ modes.T
        least = np.linalg.eigvalsh(balanced @ compliance @ balanced.T)[0]
        largest = np.abs(np.diag(compliance)).max(initial=0.0)
        if least <= _LEAST_COMPLIANCE * largest:
            raise ValueError(
                f"gear {gear.name} is held in {len(rows)} directions, and the "
                f"{body.n} modes of the airframe do not tell how its loads are shared: "
                "expected six directions in all, a stiffness on the further ones, or "
                "more modes"
            )


def _rigid_rows(point: AttachmentPoint) -> list[tuple[Float64, Float64]]:
    """Moment and force of a unit load of each rigid condition of a point."""
    none, one = np.zeros(3), np.eye(3)
    if point.along:
        rigid = point.stiffness is None
        return [(none, d) for d in point.directions] if rigid else []
    moments = [(e, none) for e in one] if point.hold == "rigid" else []
    return moments + [(none, e) for e in one]
