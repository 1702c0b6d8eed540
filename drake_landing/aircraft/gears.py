"""Landing gears of the reference aircraft, in the schema of `gears/data.py`."""

from typing import Any

from drake_landing.aircraft.facts import facts
from drake_landing.aircraft.reference_axis import ATTACHMENTS
from drake_landing.gears.data import TelescopicGear


def landing_gears() -> tuple[TelescopicGear, TelescopicGear, TelescopicGear]:
    """Nose, port main and starboard main gear."""
    data = facts("gears")
    main = data["main"]
    return (
        _gear(data["nose"]),
        _gear(_port(main)),
        _gear(main),
    )


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
