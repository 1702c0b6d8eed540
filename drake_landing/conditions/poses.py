"""Where wheels, axles and masses of the gears are in the poses of the rules.

The gears' multibody model is put there on a rigid airframe, so that every kind of gear
is where its kinematics put it. The deflections at rest are those of its state of rest,
on the rigid airframe, too: the loads of all cases are those of a rigid aircraft.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from pydrake.multibody.tree import PrismaticJoint

from drake_landing.case.scenario import Scenario
from drake_landing.conditions.ground import GearPlace
from drake_landing.conditions.masses import RigidMass, together
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.landing.diagram import LandingDiagram
from drake_landing.landing.initial_state import attitude, set_initial_state
from drake_landing.landing.run import build_landing, start_state
from drake_landing.transient.practices import rigid
from fem.arrays import Float64
from systems.airframe.modal_body import ModalBody
from systems.tools.rotations import rotation_from_quaternion

_STEP = 1e-4  # m of stroke, for the direction of extension
_LEVEL = 1e-12  # rad, of the attitude on all wheels
_TRIES = 20


@dataclass(frozen=True, kw_only=True, eq=False)
class Deflections:
    """Deflections of a gear's shock absorber and tires.

    Attributes:
        stroke: of the shock absorber, m.
        tire: wheel -> deflection of its tire, m.
    """

    stroke: float
    tire: Mapping[str, float]

    def scaled(self, factor: float) -> "Deflections":
        """A share of them."""
        return Deflections(
            stroke=factor * self.stroke,
            tire={wheel: factor * d for wheel, d in self.tire.items()},
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Posed:
    """The aircraft in a pose.

    Attributes:
        places: of the gears, G, relative to the aircraft's center of gravity.
        R_AG: (3, 3) ground axes in A.
        whole: the aircraft with its gears, A.
        gears: each gear, A.
    """

    places: dict[str, GearPlace]
    R_AG: Float64
    whole: RigidMass
    gears: dict[str, RigidMass]

    @property
    def pitch(self) -> float:
        """Nose up, rad."""
        return float(np.arctan2(-self.R_AG[0, 2], self.R_AG[2, 2]))

    @property
    def height(self) -> float:
        """Height of the center of gravity above the lowest tire's ground, m."""
        return -min(float(place.ground[2]) for place in self.places.values())


class GearStand:
    """The gears on a rigid airframe, to be put into poses.

    Args:
        body: the airframe, A; its modes are not used.
        gears: in B.
        R_AB: (3, 3).
    """

    def __init__(
        self, body: ModalBody, gears: Sequence[LandingGear], R_AB: Float64
    ) -> None:
        # How a gear is held does not move it on a rigid airframe.
        plain = [
            gear.model_copy(update={"further_attachments": (), "attachment": "rigid"})
            for gear in gears
        ]
        self._rolling = Scenario.model_validate(
            {"start": "rolling", "forward_speed": 0.0, "lift": "none"}
        )
        self.landing: LandingDiagram = build_landing(
            rigid(body), plain, {}, R_AB, self._rolling
        )
        self.airframe = RigidMass(
            mass=body.mass, center=np.array(body.p_BG), inertia=body.inertia_G
        )
        self.context = self.landing.diagram.CreateDefaultContext()

    def at_rest(self) -> tuple[Posed, dict[str, float], dict[str, Deflections]]:
        """Standing on its gears: the pose, vertical loads (N) and deflections.

        Raises:
            InputError: it cannot stand.
        """
        start_state(self.landing, self.context, self._rolling, 0.0)
        loads, deflections = {}, {}
        for gear in self.landing.gears:
            contacts = {w: self._contact(w) for w in gear.wheel_names}
            loads[gear.name] = float(sum(c[1] for c in contacts.values()))
            deflections[gear.name] = Deflections(
                stroke=self._stroke(gear.name),
                tire={w: max(float(c[0]), 0.0) for w, c in contacts.items()},
            )
        return self._posed(deflections, self._pose()[0].T), loads, deflections

    def at(self, deflections: Mapping[str, Deflections], pitch: float) -> Posed:
        """Gears deflected, the ground seen from an aircraft that is pitched.

        Args:
            deflections: of each gear.
            pitch: nose up, rad.
        """
        self._put({name: d.stroke for name, d in deflections.items()})
        return self._posed(deflections, attitude(0.0, pitch, 0.0).T)

    def on_all_wheels(self, deflections: Mapping[str, Deflections]) -> Posed:
        """Foremost and aftmost gear on the ground together, deflected as given."""
        pitch = 0.0
        for _ in range(_TRIES):
            posed = self.at(deflections, pitch)
            points = sorted(
                (p.ground for p in posed.places.values()), key=lambda p: p[0]
            )
            rise = points[-1] - points[0]
            change = float(np.arctan2(rise[2], rise[0])) if rise[0] > 0.0 else 0.0
            if abs(change) < _LEVEL:
                break
            pitch += change
        return posed

    def extended(self) -> dict[str, Deflections]:
        """No deflections."""
        return {
            gear.name: Deflections(
                stroke=0.0, tire=dict.fromkeys(gear.wheel_names, 0.0)
            )
            for gear in self.landing.gears
        }

    def unsprung(self, gear: str) -> RigidMass:
        """Parts below the gear's shock absorber, in A, as the gear stands now."""
        bodies = self.landing.bodies[gear]
        moving = [*bodies.parts.values(), *bodies.wheels.values()]
        return self._mass([body.index() for body in moving])

    def _put(self, strokes: Mapping[str, float]) -> None:
        set_initial_state(self.landing, self.context, v_WG=np.zeros(3), clearance=1.0)
        for name, stroke in strokes.items():
            self._set_stroke(name, stroke)
        self.landing.attachment.place_fittings(self.context)

    def _posed(self, deflections: Mapping[str, Deflections], R_AG: Float64) -> Posed:
        gears = {g.name: self._gear_mass(g.name) for g in self.landing.gears}
        whole = together([self.airframe, *gears.values()])
        up = R_AG[:, 2]
        places = {}
        for gear in self.landing.gears:
            wheels = {w: self._wheel(w) for w in gear.wheel_names}
            radius = {w: self.landing.tires[w].parameters.radius for w in wheels}
            flat = deflections[gear.name].tire
            ground = [p - (radius[w] - flat[w]) * up for w, p in wheels.items()]
            axle = np.mean(list(wheels.values()), axis=0)
            places[gear.name] = GearPlace(
                ground=R_AG.T @ (np.mean(ground, axis=0) - whole.center),
                axle=R_AG.T @ (axle - whole.center),
                unsprung=R_AG.T @ (self.unsprung(gear.name).center - whole.center),
                extension=R_AG.T @ self._extension(gear.name),
            )
        return Posed(places=places, R_AG=R_AG, whole=whole, gears=gears)

    def _extension(self, gear: str) -> Float64:
        """(3,) along which the unsprung parts move apart from the fitting, A."""
        stroke, centers = self._stroke(gear), []
        for change in (-_STEP, _STEP):
            self._set_stroke(gear, stroke + change)
            centers.append(self.unsprung(gear).center)
        self._set_stroke(gear, stroke)
        closing = centers[1] - centers[0]
        return -closing / np.linalg.norm(closing)

    def _set_stroke(self, gear: str, stroke: float) -> None:
        plant = self.landing.plant.GetMyMutableContextFromRoot(self.context)
        strut = self.landing.bodies[gear].strut
        if isinstance(strut, PrismaticJoint):
            strut.set_translation(plant, stroke)
        else:
            strut.joint.set_angle(plant, strut.geometry.angle(stroke))

    def _stroke(self, gear: str) -> float:
        kinematics = self.landing.wheel_kinematics
        of_system = kinematics.GetMyContextFromRoot(self.context)
        return float(kinematics.GetOutputPort(f"strut_{gear}").Eval(of_system)[0])

    def _contact(self, wheel: str) -> Float64:
        return self.landing.tires[wheel].contact(self.context)[:]

    def _wheel(self, wheel: str) -> Float64:
        """(3,) center of a wheel, A."""
        kinematics = self.landing.wheel_kinematics
        of_system = kinematics.GetMyContextFromRoot(self.context)
        p_WC = kinematics.GetOutputPort(f"wheel_{wheel}").Eval(of_system)[:3]
        return self._in_A(p_WC)

    def _gear_mass(self, gear: str) -> RigidMass:
        bodies = self.landing.bodies[gear]
        own = [bodies.fitting, *bodies.parts.values(), *bodies.wheels.values()]
        own += [joint.child_body() for joint in bodies.hinges.values()]  # cylinder
        return self._mass([body.index() for body in own])

    def _mass(self, bodies: list) -> RigidMass:
        plant = self.landing.plant
        context = plant.GetMyContextFromRoot(self.context)
        M = plant.CalcSpatialInertia(context, plant.world_frame(), bodies)
        R_WA = self._pose()[0]
        com = M.get_com()
        about = M.Shift(com).CalcRotationalInertia().CopyToFullMatrix3()
        return RigidMass(
            mass=M.get_mass(), center=self._in_A(com), inertia=R_WA.T @ about @ R_WA
        )

    def _pose(self) -> tuple[Float64, Float64]:
        """(3, 3) R_WA and (3,) p_WG of the airframe."""
        airframe = self.landing.airframe
        of_system = airframe.GetMyContextFromRoot(self.context)
        pose = airframe.GetOutputPort("pose").Eval(of_system)
        return rotation_from_quaternion(pose[:4]), pose[4:]

    def _in_A(self, p_W: Float64) -> Float64:
        R_WA, p_WG = self._pose()
        return R_WA.T @ (p_W - p_WG) + self.airframe.center
