"""What the first landing on a machine costs beside itself."""

from systems.airframe import modal_kinematics
from systems.gear import joint_tree
from systems.tools.compiled import compiled_before

# Called in every landing, whatever its gears and attachments.
_IN_EVERY_LANDING = (modal_kinematics, joint_tree)


def compilation_remark() -> str:
    """Remark on compiling beside a duration; empty where machine code is kept."""
    if all(compiled_before(str(module.__file__)) for module in _IN_EVERY_LANDING):
        return ""
    return "; the first run compiles, half a minute"
