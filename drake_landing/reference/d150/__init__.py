"""The reference aircraft DLR-D150, generated from public facts (see `data/README.md`).

model = build("con", topology="2")
write_model("con", "d150_con.bdf")
"""

from drake_landing.reference.d150.gears import landing_gears as landing_gears
from drake_landing.reference.d150.generator import (
    LEVELS as LEVELS,
)
from drake_landing.reference.d150.generator import (
    attachment_nodes as attachment_nodes,
)
from drake_landing.reference.d150.generator import (
    build as build,
)
from drake_landing.reference.d150.generator import (
    interface_nodes as interface_nodes,
)
from drake_landing.reference.d150.generator import (
    monitoring_points as monitoring_points,
)
from drake_landing.reference.d150.generator import (
    write_model as write_model,
)
from drake_landing.reference.d150.model import AircraftModel as AircraftModel
