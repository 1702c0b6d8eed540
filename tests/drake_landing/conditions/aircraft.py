"""Aircraft on the ground with figures that are easy to check by hand."""

import numpy as np

from drake_landing.conditions.ground import Gear, GearPlace, GroundAircraft

G = 9.80665
POSES = ("static", "largest", "all_wheels", "reduced", "tail_down", "extended")


def place(x: float, y: float, height: float, axle: float = 0.5) -> GearPlace:
    """A gear below and beside the center of gravity."""
    return GearPlace(
        ground=np.array([x, y, -height]),
        axle=np.array([x, y, -height + axle]),
        unsprung=np.array([x, y, -height + axle]),
    )


def transport(**changes) -> GroundAircraft:
    """60 t, A 11 m, B 1 m, E 3 m, gears 3.5 m off the middle; twins."""
    weight = 60e3 * G
    nose, main = weight / 12.0, weight * 11.0 / 24.0

    def leg(name: str) -> Gear:
        return Gear(
            name=name,
            role="main",
            static=main,
            largest=500e3,
            all_wheels=400e3,
            tail_down=550e3,
            time_to_peak=0.12,
            brake_torque=changes.get("torque", 1e6),
            radius=0.5,
            spin_inertia=40.0,
            wheels=2,
            scrub=0.45,
            unsprung=800.0,
        )

    gears = (
        Gear(
            name="nose",
            role="nose",
            static=nose,
            largest=200e3,
            all_wheels=200e3,
            tail_down=0.0,
            wheels=2,
            unsprung=200.0,
        ),
        leg("left"),
        leg("right"),
    )
    places = {
        "nose": place(-11.0, 0.0, 3.0),
        "left": place(1.0, -3.5, 3.0),
        "right": place(1.0, 3.5, 3.0),
    }
    return GroundAircraft(
        mass=60e3,
        design=changes.get("design", "take_off"),
        gears=gears,
        poses=dict.fromkeys(POSES, places),
        steering_torque=5e3,
        pitch_damping=changes.get("damping"),
    )


def commuter() -> GroundAircraft:
    """12 500 lb, A 5 m, B 0.5 m, E 1.5 m."""
    mass = 12500 * 0.45359237
    weight = mass * G

    def leg(name: str) -> Gear:
        return Gear(
            name=name,
            role="main",
            static=weight * 5.0 / 11.0,
            largest=70e3,
            tail_down=70e3,
            time_to_peak=0.1,
            brake_torque=1e6,
            radius=0.3,
            spin_inertia=1.5,
            wheels=2,
            scrub=0.15,
            unsprung=60.0,
        )

    nose = Gear(name="nose", role="nose", static=weight / 11.0, largest=20e3)
    places = {
        "nose": place(-5.0, 0.0, 1.5, 0.0),
        "left": place(0.5, -2.0, 1.5, 0.0),
        "right": place(0.5, 2.0, 1.5, 0.0),
    }
    return GroundAircraft(
        mass=mass,
        design="take_off",
        gears=(nose, leg("left"), leg("right")),
        poses=dict.fromkeys(POSES, places),
        steering_torque=800.0,
        wing_area=28.0,
        stall_speed=40.0,
    )


def taildragger() -> GroundAircraft:
    """1000 kg, main gears 0.5 m ahead of the c.g., the tail wheel 4.5 m aft."""
    weight = 1000.0 * G

    def leg(name: str) -> Gear:
        return Gear(
            name=name,
            role="main",
            static=weight * 4.5 / 10.0,
            largest=14e3,
            tail_down=14e3,
            brake_torque=500.0,
            radius=0.25,
        )

    tail = Gear(name="tail", role="tail", static=weight / 10.0)
    places = {
        "left": place(-0.5, -1.0, 1.0, 0.25),
        "right": place(-0.5, 1.0, 1.0, 0.25),
        "tail": place(4.5, 0.0, 1.0, 0.1),
    }
    return GroundAircraft(
        mass=1000.0,
        design="take_off",
        gears=(leg("left"), leg("right"), tail),
        poses=dict.fromkeys(POSES, places),
        wing_area=16.0,
    )
