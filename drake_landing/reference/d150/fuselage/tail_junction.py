"""Fin and tailplane on the tail cone.

The fin's root stands on the crown at six frames, pinned on both sides. The tailplane
turns on two pivots in the frames behind its opening; its screw jack hangs on a beam
across the frame before it.
"""

from collections.abc import Mapping

import numpy as np

from drake_landing.reference.d150 import beams
from drake_landing.reference.d150.beams import BarSection
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.hull import Hull, tailplane_lines
from drake_landing.reference.d150.geometry import surface
from drake_landing.reference.d150.reference_axis import SIDES, Reference
from drake_landing.reference.d150.shell_mesh import BoxMesh

FIN = "fuselage fin joint"
TAILPLANE = "fuselage tailplane joint"


def join_fin(hull: Hull, fin: BoxMesh) -> None:
    """Pins between root rib and the frames' crown; the frames' grids follow the fin."""
    model = hull.halves.model
    for name in facts("fuselage_shell")["fin_frames"]:
        row = hull.rows.at(name)
        k = int(np.argmin(np.abs(fin.p[0, :, 0, 0] - hull.rows.x[row])))
        half = abs(float(fin.p[0, k, -1, 1]))
        line = hull.lines.nearest(row, 1, half, 1, hull.line("window_top"))
        for side, edge in ((0, -1), (1, 0)):
            skin = int(hull.at(row, line)[side])
            model.rigid(FIN, int(fin.ids[0, k, edge]), "123", [skin])
            model.dependent.update((skin, c) for c in (1, 2, 3))


def join_tailplane(
    hull: Hull, meshes: Mapping[str, BoxMesh], reference: Reference
) -> None:
    """Two pivots and the screw jack."""
    _pivots(hull, meshes)
    _jack(hull, reference)


def _pivots(hull: Hull, meshes: Mapping[str, BoxMesh]) -> None:
    model, data = hull.halves.model, facts("fuselage_shell")["tailplane_opening"]
    tail, shape = facts("tails")["tailplane"], surface("tailplane")
    eta, fraction = tail["hinge"]
    hinge = int(np.argmin(np.abs(np.array(tail["ribs"])[:, 0] - eta)))
    point = shape.point(shape.station(eta), fraction)[0]
    feet = hull.halves.grids(TAILPLANE, np.stack([point, point]))
    above, below = tailplane_lines(hull.rows, hull.lines)
    around = [
        hull.at(hull.rows.at(frame), line)
        for frame in data["pivot_frames"]
        for line in range(above, below + 1)
        if hull.at(hull.rows.at(frame), line)[0]
    ]
    pid = model.next_id(TAILPLANE, "property")
    model.section(TAILPLANE).comment(f"property {pid}: tailplane pivot")
    model.section(TAILPLANE).add("PBUSH", pid, "K", *(data["pivot_stiffness"],) * 3)
    for k, (side, _) in enumerate(SIDES):
        mesh = meshes[f"tailplane_{side}"]
        station = int(mesh.ribs[hinge])
        model.average(TAILPLANE, int(feet[0, k]), [int(t[k]) for t in around])
        model.average(
            TAILPLANE, int(feet[1, k]), mesh.spar(-1, station - 1, station + 1)
        )
        pair = (int(feet[0, k]), int(feet[1, k]))
        model.element(TAILPLANE, "CBUSH", pid, *pair, None, None, None, 0)


def _jack(hull: Hull, reference: Reference) -> None:
    """A beam across the frame carries the jack, whose yoke holds the center ribs."""
    halves, tail = hull.halves, facts("tails")["tailplane"]
    row = hull.rows.at(facts("fuselage")["tailplane_jack_frame"])
    right, left = reference["tailplane_right"], reference["tailplane_left"]
    line = hull.lines.nearest(row, 2, right.p[0, 2], 0, hull.line("cargo"))
    edge = hull.p(row, line)
    share = np.array([0.0, 0.33, 0.67])[:, None]
    beam = halves.grids(TAILPLANE, edge * (1.0, 0.0, 1.0) + share * (edge * (0, 1, 0)))
    halves.chain(
        TAILPLANE, halves.profile("jack_beam"), [*beam, hull.at(row, line)], beams.UP
    )
    yoke = tail["trim_yoke_stiffness"]
    section = BarSection(
        area=yoke["area"],
        i1=yoke["ei"] / beams.youngs_modulus(),
        i2=yoke["ei"] / beams.youngs_modulus(),
        j=yoke["gj"] / beams.shear_modulus(),
    )
    model = halves.model
    massless = beams.massless_aluminium(model)
    pid = beams.add_section(model, TAILPLANE, "trim yoke", section, massless)
    for group in (right, left):
        model.element(
            TAILPLANE, "CBAR", pid, int(beam[0, 0]), group.id_of(0), *beams.UP
        )
