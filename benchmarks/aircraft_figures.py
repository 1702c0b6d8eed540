"""What PRE and FULL are: grids, elements, mass, inertia, shapes of their elements.

    python -m benchmarks.aircraft_figures [--page]

Masses are those of the airframe's deck, computed by this project's solver, with the
landing gears as the multibody model has them, extended.
"""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import numpy.typing as npt
import pandas as pd

from benchmarks.page import DOCS, markdown, put
from drake_landing.reference.d150 import AircraftModel, build
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.masses import gear_mass_center
from fem.deck.reader import read_deck
from fem.elements.quality import quality_table
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]
LEVELS = ("pre", "full")
PAPER = {"pre": (13790, None), "full": (34268, 44535)}  # grids, elements
CARDS = ("CQUAD4", "CTRIA3", "CBAR", "CBUSH")
_MEASURES = {
    "aspect": "aspect ratio",
    "warp": "warp (height of the corners over half the diagonal)",
    "skew": "least angle between midlines, deg",
    "taper": "taper",
    "angle_max": "largest corner angle, deg",
}
_OF_TRIANGLES = {"skew": "least corner angle, deg"}


@dataclass(frozen=True, kw_only=True)
class Aircraft:
    """A level, generated and read again."""

    name: str
    model: AircraftModel
    structure: Structure


def aircraft(level: str) -> Aircraft:
    """Generates a level of topology 2, and reads it as the solver does."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"{level}.bdf"
        model = build(level, "2")
        path.write_text(model.deck, encoding="ascii")
        structure = Structure.from_deck(read_deck(path))
        _ = structure.weight
    return Aircraft(name=level.upper(), model=model, structure=structure)


def size(found: Aircraft) -> pd.DataFrame:
    """Grids and elements beside the paper's."""
    cards = found.structure.deck.cards
    grids = len(found.model.grid_id)
    elements = sum(len(cards[card]) for card in CARDS)
    masses, ties = len(cards["CONM2"]), len(cards["RBE2"]) + len(cards["RBE3"])
    wanted = PAPER[found.name.lower()]
    rows = [
        ("grids", grids, wanted[0]),
        (", ".join(CARDS), elements, wanted[1]),
        ("the same and CONM2", elements + masses, wanted[1]),
        ("RBE2, RBE3", ties, None),
    ]
    return pd.DataFrame(
        [
            (found.name, name, f"{n:,}", *_beside(float(n), paper, "{:,.0f}"))
            for name, n, paper in rows
        ],
        columns=["model", "", "ours", "paper", "away"],
    )


def _beside(ours: float, other: float | None, form: str) -> tuple[str, str]:
    if other is None:
        return "", ""
    away = round(ours / other - 1.0, 6) + 0.0  # no minus zero
    return form.format(other), f"{away:+.2%}"


def mass(found: Aircraft) -> pd.DataFrame:
    """Airframe and gears: mass, center, inertia about it, beside the facts."""
    total, center, inertia = whole(found)
    target = facts("overall")
    wanted = [target["inertia"][name] for name in ("roll", "pitch", "yaw")]
    rows = [
        ("mass, kg", f"{total:,.1f}", *_beside(total, 72500.0, "{:,.0f}")),
        (
            "x of the center, m",
            f"{center[0]:.4f}",
            f"{target['mass']['x_cg']:.3f}",
            f"{1e3 * (center[0] - target['mass']['x_cg']):+.2f} mm",
        ),
    ]
    for axis, own, other in zip("xyz", np.diag(inertia), wanted):
        beside = _beside(own, other, "{:.3e}")
        rows.append((f"I{axis}{axis}, kg m²", f"{own:.3e}", *beside))
    table = pd.DataFrame(rows, columns=["", "ours", "wanted", "away"])
    table.insert(0, "model", found.name)
    return table


def whole(found: Aircraft) -> tuple[float, Float64, Float64]:
    """Mass, center (3,) and inertia about it (3, 3) of deck and extended gears."""
    weight = found.structure.weight
    bodies = [(float(weight.mass[0]), weight.center, weight.inertia)]
    bodies += [(*gear_mass_center(g), np.zeros((3, 3))) for g in found.model.gears]
    total = sum(m for m, _, _ in bodies)
    center = np.sum([m * c for m, c, _ in bodies], axis=0) / total
    inertia = np.zeros((3, 3))
    for m, c, own in bodies:
        arm = c - center
        inertia += own + m * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return total, center, inertia


def quality(found: Aircraft) -> pd.DataFrame:
    """Worst shapes; the least Jacobian of quadrilaterals is of their corners."""
    table = quality_table(found.structure.blocks)
    rows = []
    for row in table.itertuples():
        names = _MEASURES | (_OF_TRIANGLES if row.card == "CTRIA3" else {})
        if row.measure in names:
            rows.append(
                (
                    *(found.name, row.card, names[str(row.measure)]),
                    *(f"{row.worst:.3g}", row.id, f"{row.limit:g}", row.beyond),
                )
            )
    ratio, element = least_jacobian(found.structure)
    rows.append((found.name, "CQUAD4", "Jacobian, least over mean",
                 f"{ratio:.3g}", element, "0", 0))  # fmt: skip
    columns = ["model", "element", "measure", "worst", "id", "limit", "beyond"]
    return pd.DataFrame(rows, columns=columns)


def least_jacobian(structure: Structure) -> tuple[float, int]:
    """Least corner Jacobian of the quadrilaterals over their mean one, and where."""
    worst, element = np.inf, 0
    for ids, corners in _quadrilaterals(structure):
        ahead = np.roll(corners, -1, axis=1) - corners
        back = np.roll(corners, 1, axis=1) - corners
        turned = np.cross(ahead, back)
        normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        jacobian = np.einsum("eci,ei->ec", turned, normal)
        ratio = jacobian.min(axis=1) / jacobian.mean(axis=1)
        k = int(np.argmin(ratio))
        if ratio[k] < worst:
            worst, element = float(ratio[k]), int(ids[k])
    return worst, element


def _quadrilaterals(structure: Structure) -> Iterator[tuple[npt.NDArray, Float64]]:
    for block in structure.blocks:
        corners = getattr(block, "corners", None)
        if corners is not None and corners.shape[1] == 4:
            yield block.id, corners


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--page", action="store_true")
    arguments = parser.parse_args()
    levels = [aircraft(level) for level in LEVELS]
    tables = {
        name: markdown(pd.concat([make(found) for found in levels]))
        for name, make in (
            ("aircraft size", size),
            ("aircraft mass", mass),
            ("element shapes", quality),
        )
    }
    for name, text in tables.items():
        print(f"{name}\n\n{text}\n")
        if arguments.page:
            put(DOCS / "aircraft.md", name, text)


if __name__ == "__main__":
    main()
