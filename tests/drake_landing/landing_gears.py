"""Landing gears for the synthetic aircraft: one nose gear, two main gears, twins."""

from drake_landing.gears.landing_gear import LandingGear, read_gear
from tests.systems.synthetic_body import LEFT_GEAR, NOSE_GEAR, RIGHT_GEAR

_NOSE = {
    "name": "nose",
    "attachment_node": NOSE_GEAR,
    "axle": (5.07, 0.0, -3.919),
    "wheel_offsets": (-0.25, 0.25),
    "fitting": {"mass": 140.0, "cg": (5.07, 0.0, -2.15), "inertia": (28, 28, 4)},
    "piston": {"mass": 100.0, "cg": (5.07, 0.0, -3.35), "inertia": (16, 15, 3)},
    "wheel": {"mass": 40.0, "spin_inertia": 2.5, "transverse_inertia": 1.6},
    "tyre": {"radius": 0.381, "stiffness": 1.05e6, "damping": 1.5e3}
    | {"rolling_radius": "loaded"},
    "shock_absorber": {
        "stroke": 0.43,
        "gas_length": 0.47,
        "precharge_force": 12e3,
        "compression_damping": 15e3,
        "rebound_damping": 60e3,
    },
}


def _main(name: str, node: int, side: float) -> dict:
    y = side * 3.795
    return {
        "name": name,
        "attachment_node": node,
        "axle": (17.71, y, -3.716),
        "wheel_offsets": (-0.465, 0.465),
        "fitting": {"mass": 616.0, "cg": (17.51, y, -1.75), "inertia": (150, 150, 30)},
        "piston": {"mass": 330.0, "cg": (17.71, y, -3.15), "inertia": (75, 68, 18)},
        "wheel": {"mass": 210.0, "spin_inertia": 18.0, "transverse_inertia": 11.0},
        "tyre": {"radius": 0.584, "stiffness": 2.0e6, "damping": 3.0e3}
        | {"rolling_radius": "loaded"},
        "shock_absorber": {
            "stroke": 0.47,
            "gas_length": 0.52,
            "precharge_force": 45e3,
            "compression_damping": 45e3,
            "rebound_damping": 180e3,
        },
    }


def aircraft_gears() -> tuple[LandingGear, ...]:
    """Nose, left main and right main gear."""
    data = (
        _NOSE,
        _main("main_left", LEFT_GEAR, -1.0),
        _main("main_right", RIGHT_GEAR, 1.0),
    )
    return tuple(read_gear(gear) for gear in data)


def changed(gear: LandingGear, **changes) -> LandingGear:
    """The gear with some of its data replaced, validated again."""
    return read_gear(gear.model_dump() | changes)


def levered_main(name: str = "main_left") -> LandingGear:
    """A trailing-arm variant of a main gear: the axle behind the pivot."""
    main = next(gear for gear in aircraft_gears() if gear.name == name)
    data = main.model_dump()
    del data["rake_deg"], data["steering_deg"]
    piston = data.pop("piston")
    x, y, z = data["axle"]
    return read_gear(
        data
        | {
            "kind": "levered",
            "pivot": (x - 0.75, y, z + 0.35),
            "absorber_upper": (x - 0.35, y, z + 1.75),
            "absorber_lower": (x - 0.12, y, z + 0.25),
            "arm": piston | {"cg": (x - 0.3, y, z + 0.15), "inertia": (30, 40, 30)},
        }
    )


def bogie_main(name: str = "main_left", **pitch) -> LandingGear:
    """A four-wheel variant of a main gear, with the tires of the nose gear's size."""
    main = next(gear for gear in aircraft_gears() if gear.name == name)
    data = main.model_dump()
    del data["steering_deg"]
    x, y, z = data.pop("axle")
    tire = data["tyre"] | {"stiffness": 1.0e6, "damping": 1.5e3}
    damper = {"trim_deg": 8.0, "stiffness": 2e5, "damping": 2e4, "stop_deg": 20.0}
    return read_gear(
        data
        | {
            "kind": "bogie",
            "pivot": (x, y, z + 0.1),
            "axle_positions": ((x - 0.68, y, z), (x + 0.68, y, z)),
            "tyre": tire,
            "wheel": data["wheel"]
            | {"mass": 105.0, "spin_inertia": 9.0}
            | {"transverse_inertia": 5.5},
            "piston": data["piston"] | {"mass": 200.0},
            "beam": {"mass": 130.0, "cg": (x, y, z + 0.05), "inertia": (4, 40, 40)},
            "pitch_damper": damper | pitch,
        }
    )
