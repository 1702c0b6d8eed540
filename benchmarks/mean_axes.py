"""Error of the airframe's formulation, constant inertia in mean axes, as a table.

    python -m benchmarks.mean_axes

Against a chain of eleven rigid bodies that Drake's MultibodyPlant solves exactly, see
`tests.systems.hinged_chain`. About a minute.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from tests.systems.hinged_chain import Chain, difference, make_chain

RATIO = 6.0  # in-plane over flapping stiffness, as of a wing
PEAKS = (5e4, 5e5, 1e6, 3e6)  # N
SPINS = (0.0, 0.1, 0.3, 1.0)  # rad/s
AXES = {"roll": (1, 0, 0), "pitch": (0, 1, 0), "yaw": (0, 0, 1)}


def row(chain: Chain, peak: float, spin: float, axis: str) -> str:
    """One line of the table, in per cent."""
    found = difference(chain, peak, spin * np.array(AXES[axis], dtype=float))
    values = (
        found.amplitude,
        found.deflection,
        found.shortening,
        found.middle,
        found.tip,
    )
    about = f"{spin:g} {axis}" if spin else "0"
    return f"| {about} | " + " | ".join(f"{100 * v:.2f}" for v in values) + " |"


def main() -> None:
    """Prints the table."""
    chain = make_chain(RATIO)
    print("| rad/s | amplitude % | deflection % | shortening % | middle % | tip % |")
    print("|---|---|---|---|---|---|")
    for spin in SPINS:
        for axis in AXES if spin else ("roll",):
            for peak in PEAKS:
                print(row(chain, peak, spin, axis), flush=True)
    print("\nWith equal stiffness in both planes:\n")
    for spin in SPINS[1:3]:
        print(row(make_chain(1.0), PEAKS[1], spin, "roll"), flush=True)


if __name__ == "__main__":
    main()
