"""Draws docs/diagram.svg, the wiring of a three-gear landing (needs Graphviz's dot).

python docs/make_diagram.py
"""

from pathlib import Path

import numpy as np

from drake_landing.landing.diagram import MakeLandingDiagram
from drake_landing.landing.wiring import wiring_svg
from drake_landing.reference.d150.generator import build
from systems.airframe.modal_body import ModalBody


def main() -> None:
    """Wires the D150's gears to a rigid body and draws the diagram."""
    aircraft = build("con")
    node = np.array(sorted(aircraft.attachment.values()))
    body = ModalBody(
        mass=69_448.0,
        p_BG=np.array([16.3, 0.0, -0.7]),
        inertia_G=np.diag([1.4e6, 3.3e6, 4.5e6]),
        frequency=np.zeros(0),
        modal_mass=np.zeros(0),
        modal_damping=np.zeros((0, 0)),
        node_id=node,
        p_BN=aircraft.position[np.searchsorted(aircraft.grid_id, node)],
        translation=np.zeros((len(node), 3, 0)),
        rotation=np.zeros((len(node), 3, 0)),
    )
    landing = MakeLandingDiagram(body, aircraft.gears, energy_budget=False)
    Path(__file__).with_name("diagram.svg").write_text(wiring_svg(landing.diagram))


if __name__ == "__main__":
    main()
