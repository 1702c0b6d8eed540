"""Landing gears of the reference aircraft, in the schema of `gears/landing_gear.py`."""

from typing import Any

from drake_landing.gears.landing_gear import TelescopicGear
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.reference_axis import ATTACHMENTS


def landing_gears(
    paper: bool = False,
) -> tuple[TelescopicGear, TelescopicGear, TelescopicGear]:
    """Nose, port main and starboard main gear.

    Args:
        paper: with the simpler laws of the paper's studies, `d150-paper` in a case.
    """
    data = facts("gears")
    nose, main = data["nose"], data["main"]
    if paper:
        simpler = data.get("paper", {})
        nose, main = (
            _with(gear, simpler.get(name, {}))
            for name, gear in (("nose", nose), ("main", main))
        )
    return (_gear(nose), _gear(_port(main)), _gear(main))


def _with(gear: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """The gear with other values; those of a part are changed one by one."""
    both = {
        name: value
        for name, value in changes.items()
        if isinstance(value, dict) and isinstance(gear.get(name), dict)
    }
    return gear | changes | {name: gear[name] | value for name, value in both.items()}


def _gear(data: dict[str, Any]) -> TelescopicGear:
    return TelescopicGear(attachment_node=ATTACHMENTS[data["name"]], **data)


def _port(starboard: dict[str, Any]) -> dict[str, Any]:
    """The mirror image of a gear with wheels in pairs."""

    def mirror(p: list[float]) -> list[float]:
        return [p[0], -p[1], p[2]]

    port = dict(starboard, name="main_left", axle=mirror(starboard["axle"]))
    for part in ("fitting", "piston"):
        port[part] = dict(starboard[part], cg=mirror(starboard[part]["cg"]))
    return port
