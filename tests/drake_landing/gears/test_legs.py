"""Elastic legs in a plant: frequencies, stiffness, landings, and bad data."""

from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydantic import ValidationError
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import DiagramBuilder
from scipy.integrate import quad, solve_ivp

from drake_landing.case.axes import gear_in_A
from drake_landing.gears.bodies import AddLandingGear, mass_points
from drake_landing.gears.leg_beam import deflection_per_force, slope_per_force
from drake_landing.gears.leg_laws import elastic_leg, hinge_columns
from drake_landing.gears.legs import Leg, LegBeam
from drake_landing.landing.diagram import MakeLandingDiagram
from drake_landing.landing.equilibrium import set_static_equilibrium
from systems.gear.elastic_legs import ElasticLegs
from tests.drake_landing.landing_gears import (
    aircraft_gears,
    bogie_main,
    changed,
    levered_main,
)
from tests.drake_landing.landing_run import land
from tests.systems.synthetic_body import aircraft_body

P_BA = np.array([17.6, -3.795, -1.05])
LEG = {
    "fore_aft": {"frequency": 16.0},
    "lateral": {"frequency_table": [(0.0, 20.0), (0.3, 24.0)]},
    "torsion": {"stiffness": 1.5e6, "free_play_deg": 0.05},
}
KINDS = {
    "telescopic": lambda: aircraft_gears()[1],
    "levered": levered_main,
    "bogie": bogie_main,
}
BEAM = {
    "cylinder_bending": 1.5e7,
    "piston_bending": 4e6,
    "cylinder_length": 1.8,
    "overhang": 0.8,
    "bearing_distance": 0.4,
}


class Rig:
    """One gear with its fitting clamped to the world, and its elastic law."""

    def __init__(self, gear, **leg):
        self.gear = changed(gear, leg=leg)
        builder = DiagramBuilder()
        self.plant = builder.AddSystem(MultibodyPlant(0.0))
        self.bodies = AddLandingGear(self.plant, self.gear, P_BA)
        self.plant.WeldFrames(
            self.plant.world_frame(), self.bodies.fitting.body_frame()
        )
        self.plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, 0.0])
        self.plant.Finalize()
        self.law = elastic_leg(self.plant, self.gear, self.bodies)
        self.legs = builder.AddSystem(
            ElasticLegs(
                self.plant,
                {"gear": self.law},
                {"gear": hinge_columns(self.bodies)},
            )
        )
        builder.Connect(
            self.plant.GetOutputPort("state"), self.legs.GetInputPort("plant_state")
        )
        self.diagram = builder.Build()
        self.context = self.diagram.CreateDefaultContext()

    def force(self, q=None, v=None):
        """(nv,) of the law."""
        plant = self.plant.GetMyMutableContextFromRoot(self.context)
        if q is not None:
            self.plant.SetPositions(plant, q)
        if v is not None:
            self.plant.SetVelocities(plant, v)
        of_legs = self.legs.GetMyContextFromRoot(self.context)
        return self.legs.GetOutputPort("generalized_force").Eval(of_legs)

    def frequencies(self, stroke=0.0, alone=None):
        """Hz of the linearised motion with the strut locked, wheels and beam free."""
        n = self.plant.num_velocities()
        q = self.plant.GetPositions(self.plant.CreateDefaultContext())
        strut = self.bodies.joints["strut"]
        q[strut.position_start()] = stroke
        rows = [j.velocity_start() for j in self.bodies.spins.values()]
        rows += [self.bodies.pitch.velocity_start()] if self.bodies.pitch else []
        names = [alone] if alone else list(self.bodies.hinges)
        rows += [self.bodies.hinges[name].velocity_start() for name in names]
        h = 1e-4
        K = np.array(
            [
                (self.force(q - h * e) - self.force(q + h * e)) / (2 * h)
                for e in np.eye(n)
            ]
        ).T
        plant = self.plant.GetMyMutableContextFromRoot(self.context)
        self.plant.SetPositions(plant, q)
        M = self.plant.CalcMassMatrix(plant)
        pick = np.ix_(rows, rows)
        values = np.linalg.eigvals(np.linalg.solve(M[pick], K[pick])).real
        return np.sqrt(np.sort(values)[-len(names) :]) / (2 * np.pi)


@pytest.mark.parametrize("kind", KINDS)
def test_legs_have_the_frequencies_of_their_data(kind):
    rig = Rig(KINDS[kind](), **(LEG | {"torsion": {"frequency": 14.0}}))
    for name, hertz in (("fore_aft", 16.0), ("lateral", 20.0), ("torsion", 14.0)):
        assert_allclose(rig.frequencies(alone=name), [hertz], rtol=1e-6)
    if kind != "levered":
        assert_allclose(rig.frequencies(0.3, "lateral"), [24.0], rtol=2e-3)


@pytest.mark.parametrize(("kind", "stroke"), list(product(KINDS, (0.0, 0.25))))
def test_a_force_at_the_axle_meets_the_stiffness_of_the_data(kind, stroke):
    table = [(0.0, 3e6), (0.5, 4e6)]
    gear = KINDS[kind]()
    rig = Rig(gear, fore_aft={"stiffness_table": table}, lateral={"stiffness": 2e6})
    strut = rig.bodies.strut
    q = np.zeros(rig.plant.num_positions())
    joint = rig.bodies.joints["strut"]
    position = stroke if kind != "levered" else strut.geometry.angle(stroke)
    q[joint.position_start()] = position
    plant = rig.plant.GetMyMutableContextFromRoot(rig.context)
    wheels = list(rig.bodies.wheels.values())

    def axle():
        if kind == "bogie":
            beam = rig.bodies.parts["beam"]
            return rig.plant.EvalBodyPoseInWorld(plant, beam).translation()
        poses = [rig.plant.EvalBodyPoseInWorld(plant, w).translation() for w in wheels]
        return np.mean(poses, axis=0)

    rig.plant.SetPositions(plant, q)
    before = axle()
    for name, along, k in (("fore_aft", 0, 3e6 + 2e6 * stroke), ("lateral", 1, 2e6)):
        row = rig.bodies.hinges[name].position_start()
        turned = q.copy()
        turned[row] = 1e-6
        moment = -rig.force(turned)[rig.bodies.hinges[name].velocity_start()]
        moved = axle()[along] - before[along]
        assert moved > 0.0  # aft, to starboard
        # Virtual work: moment over angle is k (deflection over angle)².
        assert_allclose(moment * 1e-6, k * moved**2, rtol=5e-4)


def test_a_raked_leg_bends_across_its_axis():
    rig = Rig(changed(aircraft_gears()[0], rake_deg=9.0), fore_aft={"stiffness": 3e6})
    assert_allclose(
        rig.law.stiffness[0, 0, 0],
        3e6 * ((P_BA - aircraft_gears()[0].axle) @ _axis(9.0)) ** 2,
    )


def _axis(degrees):
    return np.array([np.sin(np.radians(degrees)), 0.0, np.cos(np.radians(degrees))])


@pytest.mark.parametrize("stroke", [0.0, 0.2, 0.4])
def test_beam_leg_is_that_of_the_differential_equation(stroke):
    """Deflection and slope of both beams by quadrature of curvature, not by hand."""
    beam = LegBeam(**BEAM)
    c, bearing = beam.overhang - stroke, beam.bearing_distance + stroke
    lower, upper = c, c + bearing
    end = c + beam.cylinder_length  # x from the axle up

    def bending(x, force, moment):
        """Of the piston and of the cylinder at x."""
        at_lower = force * c + moment
        if x <= lower:
            return force * x + moment, 0.0
        share = (x - lower) / bearing
        if x <= upper:
            whole = force * x + moment
            piston = at_lower * (1 - share)
            return piston, whole - piston
        return 0.0, force * x + moment

    def work(first, second):
        def density(x):
            a, b = bending(x, *first), bending(x, *second)
            stiffness = (beam.piston_bending, beam.cylinder_bending)
            return sum(p * q / k for p, q, k in zip(a, b, stiffness))

        return quad(density, 0.0, end, points=(lower, upper), epsabs=0, epsrel=1e-10)[0]

    force, moment = (1.0, 0.0), (0.0, 1.0)
    assert_allclose(deflection_per_force(beam, stroke, False), work(force, force))
    assert_allclose(slope_per_force(beam, stroke, False), work(force, moment))


def test_beam_with_a_stiff_cylinder_is_a_beam_with_an_overhang():
    beam = LegBeam(**(BEAM | {"cylinder_bending": 1e20}))
    for s in (0.0, 0.3):
        a, b = beam.overhang, beam.bearing_distance
        k = 3 * beam.piston_bending / ((a - s) ** 2 * (a + b))
        assert_allclose(1 / deflection_per_force(beam, s, True), k)


def test_beam_leg_in_a_gear_has_its_stiffness_at_the_axle():
    rig = Rig(aircraft_gears()[1], beam=BEAM)
    stroke = 0.47
    arm = 0.235 + deflection_per_force(LegBeam(**BEAM), 0.235, False) / slope_per_force(
        LegBeam(**BEAM), 0.235, False
    )
    k = 1 / deflection_per_force(LegBeam(**BEAM), 0.0, False)
    assert rig.gear.shock_absorber.stroke == stroke
    assert_allclose(rig.law.stiffness[0], k * arm**2 * np.eye(2), rtol=1e-9)


def cantilever(length, bending, twisting=2e6, stretching=1e9):
    """(6, 6) stiffness at the lower end of an upright cantilever, not round, in B.

    Flexibility along -z: deflection L³/3EI, slope L²/2EI, under a moment L/EI.
    """
    C = np.zeros((6, 6))
    for along, about, sign, EI in ((0, 4, -1, bending[0]), (1, 3, 1, bending[1])):
        C[along, along] = length**3 / (3 * EI)
        C[about, about] = length / EI
        C[along, about] = C[about, along] = sign * length**2 / (2 * EI)
    C[2, 2], C[5, 5] = length / stretching, length / twisting
    return np.linalg.inv(C)


def test_leg_from_a_matrix_deflects_and_slopes_as_itscantilever():
    length, bending = 2.4, (2e7, 3e7)
    K = cantilever(length, bending)
    rig = Rig(aircraft_gears()[1], matrix={"stiffness": K.tolist()})
    # The hinge of a cantilever lies two thirds of it above the end.
    arm = 2 * length / 3
    found = rig.law.stiffness
    expected = [3 * EI / length**3 * arm**2 for EI in bending] + [2e6 / length]
    for K_q in (found[0], found[-1]):
        assert_allclose(K_q, np.diag(expected), rtol=1e-9, atol=1e-3)
    root = rig.bodies.hinges["fore_aft"].frame_on_parent().GetFixedPoseInBodyFrame()
    height = P_BA[2] + root.translation()[2] - rig.gear.axle[2]
    assert_allclose(height, arm)
    # Forces in any direction at the axle move it as the matrix says.
    force = np.array([3e3, -2e3, 0.0])
    moved = np.linalg.solve(K, np.r_[force, np.zeros(3)])
    angles = np.linalg.solve(found[0], [force[0] * arm, force[1] * arm, 0.0])
    assert_allclose(arm * angles[:2], moved[:2], rtol=1e-9)


def test_matrix_of_a_leg_keeps_the_coupling_of_bending_and_torsion():
    K = cantilever(2.4, (2e7, 3e7))
    # An axle ahead of the strut: moved 0.3 m forward, seen from there.
    shift = np.eye(6)
    shift[:3, 3:] = -np.array([[0, 0, 0], [0, 0, 0.3], [0, -0.3, 0]])
    moved = np.linalg.inv(shift @ np.linalg.inv(K) @ shift.T)
    rig = Rig(aircraft_gears()[1], matrix={"stiffness": moved.tolist()})
    K_q = rig.law.stiffness[0]
    assert abs(K_q[1, 2]) > 0.05 * np.sqrt(K_q[1, 1] * K_q[2, 2])
    assert np.linalg.eigvalsh(K_q)[0] > 0.0
    turn = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    back = gear_in_A(gear_in_A(rig.gear, turn), turn.T).leg.matrix.stiffness
    assert_allclose(back, moved, rtol=1e-9, atol=1e-3)


def test_matrices_that_no_clamped_leg_has_are_refused():
    K = cantilever(2.4, (2e7, 3e7))
    uneven, loose = K.copy(), K.copy()
    uneven[0, 4] *= 1.1
    loose[2] = loose[:, 2] = 0.0
    for bad, message in ((uneven, "asymmetric by"), (loose, "without stiffness")):
        with pytest.raises(ValidationError, match=message):
            Leg.model_validate({"matrix": {"stiffness": bad.tolist()}})
    upside_down = K.copy()
    upside_down[:3, 3:] *= -1
    upside_down[3:, :3] *= -1
    with pytest.raises(ValueError, match="turns against its deflection"):
        Rig(aircraft_gears()[1], matrix={"stiffness": upside_down.tolist()})


def pulse_response(rig, period, rise):
    """Root moment over drag at the axle: a quarter sine that ends at its peak."""
    hinge = rig.bodies.hinges["fore_aft"]
    row = hinge.velocity_start()
    inertia = rig.law.stiffness[0, 0, 0] / (2 * np.pi / period) ** 2
    arm = P_BA[2] - rig.gear.axle[2]

    def rates(t, x):
        q = np.zeros(rig.plant.num_positions())
        v = q.copy()
        q[row], v[row] = x
        drag = np.sin(0.5 * np.pi * t / rise) if t <= rise else 0.0
        return [x[1], (drag * arm + rig.force(q, v)[row]) / inertia]

    first = solve_ivp(rates, (0, rise), [0, 0], rtol=1e-8, atol=1e-14, max_step=0.002)
    then = solve_ivp(
        rates, (rise, rise + 1.5 * period), first.y[:, -1], rtol=1e-8, atol=1e-14,
        max_step=0.002,
    )  # fmt: skip
    time = np.concatenate([first.t, then.t[1:]])
    angle = np.concatenate([first.y[0], then.y[0, 1:]])
    return time, angle * rig.law.stiffness[0, 0, 0] / arm


def duhamel(t, omega, zeta, rise):
    """Elastic force per peak drag of a mass on a spring under the quarter sine."""
    free = omega * np.sqrt(1 - zeta**2)
    end = min(t, rise)

    def kernel(tau):
        lag = t - tau
        return (
            np.sin(0.5 * np.pi * tau / rise)
            * np.exp(-zeta * omega * lag)
            * np.sin(free * lag)
        )

    return omega**2 / free * quad(kernel, 0.0, end, epsabs=1e-10, limit=200)[0]


# Peak elastic force aft and forward over peak drag, by rise time over period.
FACTORS = {
    0.0: {0.3: (1.08, 1.08), 0.6: (1.56, 1.56), 1.0: (1.27, 1.10), 2.0: (1.13, 1.02)},
    0.05: {0.3: (1.00, 0.86), 0.6: (1.46, 1.25), 1.0: (1.21, 0.94), 2.0: (1.07, 0.88)},
}


@pytest.mark.parametrize(
    ("zeta", "ratio"), [(z, r) for z in FACTORS for r in FACTORS[z]]
)
def test_spin_up_pulse_gives_the_response_of_a_one_mass_leg(zeta, ratio):
    hertz = 12.0
    law = {"frequency": hertz, "damping_ratio": zeta}
    rig = Rig(aircraft_gears()[1], fore_aft=law)
    rise = ratio / hertz
    time, force = pulse_response(rig, 1 / hertz, rise)
    assert_allclose((force.max(), -force.min()), FACTORS[zeta][ratio], rtol=0.01)
    some = slice(None, None, max(1, len(time) // 25))
    exact = [duhamel(t, 2 * np.pi * hertz, zeta, rise) for t in time[some]]
    assert_allclose(force[some], exact, atol=1e-5)


@pytest.fixture(scope="module", params=KINDS)
def landing(request):
    nose, *mains = aircraft_gears()
    if request.param != "telescopic":
        mains = [KINDS[request.param](f"main_{side}") for side in ("left", "right")]
    gears = [changed(gear, leg=LEG) for gear in (nose, *mains)]
    return MakeLandingDiagram(aircraft_body(8), gears)


def test_landing_on_elastic_legs_keeps_energy_and_symmetry(landing):
    run = land(landing, duration=0.16, accuracy=1e-4)
    mass = landing.body.mass + sum(gear.mass for gear in landing.gears)
    total = run["energy_budget.total"][0]
    assert np.abs(total - total[0]).max() < 1e-5 * 0.5 * mass * 1.83**2
    load = run["attachment.load_in_airframe_axes"].reshape(3, 6, -1)
    mirrored = load[1] * np.array([1, -1, 1, -1, 1, -1])[:, None]
    assert_allclose(load[2], mirrored, atol=1e-9 * np.abs(load).max())
    angles = run["elastic_legs.deflection_main_left"]
    assert angles[0].max() > 2e-3
    sprung_back = angles[0][angles[0].argmax() :].min()
    assert sprung_back < 0.2 * angles[0].max()
    assert run["elastic_legs.energy"].max() > 100.0


def test_an_aircraft_stands_on_elastic_legs():
    gears = [changed(gear, leg=LEG) for gear in aircraft_gears()]
    landing = MakeLandingDiagram(aircraft_body(4), gears, gravity=9.80665)
    context = landing.diagram.CreateDefaultContext()
    set_static_equilibrium(landing, context)
    rates = landing.diagram.EvalTimeDerivatives(context).CopyToVector()
    assert np.abs(rates).max() < 1e-6


def test_a_cylinder_swings_with_the_leg_and_counts_once():
    gear = aircraft_gears()[1]
    whole = gear.fitting.model_dump()
    own = {"mass": 200.0, "inertia": (20.0, 20.0, 5.0), "cg": (17.6, -3.795, -2.0)}
    rest = whole | {"mass": whole["mass"] - 200.0}
    split = changed(gear, leg=LEG, cylinder=own, fitting=rest)
    assert_allclose(split.mass, gear.mass)
    assert_allclose(sum(m for m, _ in mass_points(split)), gear.mass)
    rig = Rig(split, **LEG)
    assert_allclose(rig.frequencies(alone="fore_aft"), [16.0], rtol=1e-6)
    plain = Rig(gear, **LEG)
    arm = P_BA[2] + 2.0
    extra = (rig.law.stiffness - plain.law.stiffness)[0, 0, 0] / (2 * np.pi * 16.0) ** 2
    assert_allclose(extra, 200.0 * arm**2 + 20.0, rtol=1e-6)
    with pytest.raises(ValidationError, match="does not bend"):
        changed(gear, cylinder=own)


def test_root_is_turned_into_the_axes_of_the_model():
    gear = changed(aircraft_gears()[1], leg=LEG | {"root": (1.0, 2.0, 3.0)})
    turn = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    assert gear_in_A(gear, turn).leg.root == (2.0, -1.0, 3.0)


def test_a_root_below_the_axle_is_refused():
    with pytest.raises(ValueError, match=r"leg\.root lies .* below the axle"):
        Rig(aircraft_gears()[1], fore_aft={"frequency": 9.0}, root=(17.6, -3.8, -5.0))


@pytest.mark.parametrize(
    ("leg", "message"),
    [
        ({}, "found nothing that bends, expected fore_aft"),
        ({"fore_aft": {}}, "found none, expected one of stiffness"),
        ({"fore_aft": {"stiffness": 1, "frequency": 1}}, "stiffness and frequency"),
        ({"beam": BEAM, "lateral": {"frequency": 9}}, "found beam and lateral"),
        ({"beam": BEAM | {"bearing_distance": 2.0}}, "less than cylinder_length"),
        ({"lateral": {"stiffness_table": [(0, 1), (0.1, -1)]}}, "expected > 0"),
        ({"lateral": {"frequency": 300}}, "less than or equal to 200"),
        ({"lateral": {"frequency": 3, "damping_ratio": 1.0}}, "less than 1"),
        ({"torsion": {"frequency": 3, "free_play_deg": 9}}, "less than or equal to 5"),
    ],
)
def test_bad_legs_are_refused(leg, message):
    with pytest.raises(ValidationError, match=message):
        Leg.model_validate(leg)


@pytest.mark.parametrize(
    ("kind", "leg", "message"),
    [
        ("levered", {"beam": BEAM}, "leg.beam: a levered gear has no piston"),
        ("telescopic", {"beam": BEAM | {"overhang": 0.4}}, "leg.beam.overhang: found"),
        (
            "telescopic",
            {"beam": BEAM | {"cylinder_length": 0.6}},
            "leg.beam.cylinder_length: found 0.6 m",
        ),
        (
            "bogie",
            {"lateral": {"frequency_table": [(0, 9), (400, 9)]}},
            "leg.lateral.frequency_table: found a stroke of 400 m",
        ),
    ],
)
def test_legs_have_to_fit_their_gear(kind, leg, message):
    with pytest.raises(ValidationError, match=message):
        changed(KINDS[kind](), leg=leg)
