"""A reference aircraft with the geometry and materials of a CPACS file.

The generator builds from its facts; those that the file has replace the built-in ones
while it works, and every group of facts that stays is listed.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import scipy.optimize

from drake_landing.reference.d150 import facts as store
from drake_landing.reference.d150 import geometry, reference_axis
from drake_landing.reference.d150.cpacs_reader import CpacsAircraft, Surface, read_cpacs
from drake_landing.reference.d150.generator import write_model
from drake_landing.reference.d150.model import AircraftModel
from fem.errors import InputError

_MATERIALS = {"al2024": "2024", "al7075": "7075"}
# Ribs that other facts name.
_RIBS_WITH_A_ROLE = ("R01", "R04", "R05", "R06", "R07", "R08", "R10", "R11")
_NEAR = 0.06  # of the span: as far as a rib may stand from that whose role it takes
_AXIS = 0.5  # chord fraction of the structural axis
_STAYS = (
    "ribs of tailplane and fin",
    "movables",
    "engines and pylons",
    "landing gears",
    "thicknesses, stringers and box stiffness",
    "airfoil ordinates (scaled to the file's thickness)",
    "masses",
    "mesh density",
)


@dataclass(frozen=True, kw_only=True)
class CpacsModel:
    """An aircraft from a file.

    Attributes:
        model: as generated.
        source: name of the aircraft in the file.
        taken: groups of facts from the file.
        defaults: groups of facts of the built-in aircraft.
    """

    model: AircraftModel
    source: str
    taken: tuple[str, ...]
    defaults: tuple[str, ...]

    def story(self, path: Path) -> str:
        """Lines that say what was written, from where, and what the file lacks."""
        mass = self.model.masses["mass"].sum()
        return "\n".join(
            [
                f"{path}: {self.source}, level {self.model.level}, "
                f"{len(self.model.grid_id)} grids, airframe {mass:,.0f} kg",
                *(f"from the file: {what}" for what in self.taken),
                *(f"default: {what}" for what in self.defaults),
            ]
        )


def write_cpacs_model(
    source: Path, level: str, path: Path, topology: str | None = None
) -> CpacsModel:
    """Reads a file, builds the aircraft and writes its deck.

    Raises:
        InputError: the file, the level or the topology is at fault.
    """
    found = read_cpacs(source)
    facts, tables, taken, defaults = _replacements(found)
    with _replaced(facts, tables), _named(source, taken):
        model = write_model(level, path, topology)
    return CpacsModel(
        model=model,
        source=found.name,
        taken=tuple(taken),
        defaults=(*defaults, *_STAYS),
    )


def _replacements(
    found: CpacsAircraft,
) -> tuple[dict[str, dict[str, Any]], dict[str, Any], list[str], list[str]]:
    facts: dict[str, dict[str, Any]] = {}
    tables: dict[str, Any] = {}
    taken: list[str] = []
    defaults: list[str] = []

    def note(there: bool, what: str) -> bool:
        (taken if there else defaults).append(what)
        return there

    if note(found.wing is not None, "wing planform and incidence"):
        assert found.wing is not None
        facts["wing"] = {**store.facts("wing"), **_wing(found.wing)}
        if note(found.wing.spars is not None, "wing spars"):
            facts["wing"] |= _spars(found.wing)
        ribs, reason = rib_table(found.ribs)
        if note(ribs is not None, f"wing ribs{reason}"):
            tables["wing_ribs"] = ribs
    tails = dict(store.facts("tails"))
    for name, tail in (("tailplane", found.tailplane), ("fin", found.fin)):
        if note(tail is not None, f"{name} planform"):
            assert tail is not None
            tails[name] = {**tails[name], **_tail(tail)}
            if note(tail.spars is not None, f"{name} spars"):
                tails[name] |= _spars(tail)
    facts["tails"] = tails
    if note(found.fuselage is not None, "fuselage sections"):
        columns = ["x", "width", "z_bottom", "z_top"]
        rows = store.table("fuselage_sections").iloc[:0].copy()
        tables["fuselage_sections"] = rows.reindex(range(len(found.fuselage)))
        tables["fuselage_sections"][columns] = found.fuselage
    frames = store.table("fuselage_frames").copy()
    if note(set(frames.frame) <= found.frames.keys(), "fuselage frames"):
        frames["x"] = frames.frame.map(found.frames)
        tables["fuselage_frames"] = frames
    materials = dict(store.facts("materials"))
    for name, number in _MATERIALS.items():
        uid = next((uid for uid in found.materials if number in uid), None)
        if note(uid is not None, f"material {name}"):
            data = {k: v for k, v in found.materials[str(uid)].items() if v == v}
            materials[name] = {**materials[name], **data}
    facts["materials"] = materials
    return facts, tables, taken, defaults


def rib_table(ribs: np.ndarray | None) -> tuple[pd.DataFrame | None, str]:
    """The generator's table for ribs of a file, and what is to be said of them.

    Other facts speak of ribs by name: the side of the body, the engine's, the gear's.
    These names go to the ribs of the file that are nearest, in order.

    Args:
        ribs: (n, 2) share of the span at the front spar, angle in degrees; or None.

    Returns:
        The table, None where the built-in ribs stay; the number of ribs, or the reason.
    """
    ours = store.table("wing_ribs")
    if ribs is None:
        return None, ""
    roles = ours[ours.rib.isin(_RIBS_WITH_A_ROLE)]
    if len(ribs) < len(roles):
        return None, f" (the file has {len(ribs)}, at least {len(roles)} are needed)"
    away = (roles.eta_front_spar.to_numpy()[:, None] - ribs[:, 0]) ** 2
    role, at = scipy.optimize.linear_sum_assignment(away)
    far = int(np.argmax(away[role, at]))
    if away[role, at][far] > _NEAR**2:
        return None, f" (none of the file's is near rib {roles.rib.iloc[role[far]]})"
    names = np.array([f"F{k + 1:02d}" for k in range(len(ribs))], dtype=object)
    names[at] = roles.rib.to_numpy()[role]
    table = pd.DataFrame(
        {
            "rib": names,
            "part": "wing",
            "eta_front_spar": ribs[:, 0],
            "angle_deg": ribs[:, 1],
            "source": "CPACS",
            "estimate": False,
        }
    )
    return table, f" ({len(ribs)})"


def _wing(wing: Surface) -> dict[str, Any]:
    ours = store.table("airfoils")
    thickness = np.ptp(ours[ours.airfoil == "wing"].z_over_c.to_numpy())
    leading = wing.leading + wing.origin
    scale = wing.thickness / wing.chord / thickness
    plan = np.column_stack([leading[:, [1, 0, 2]], wing.chord, scale])
    turn = np.deg2rad(wing.rotation[1])
    arm = wing.leading + np.outer(wing.chord * _AXIS, [1.0, 0.0, 0.0])
    c, s = np.cos(turn), np.sin(turn)
    axis = wing.origin + np.column_stack(
        [c * arm[:, 0] + s * arm[:, 2], arm[:, 1], c * arm[:, 2] - s * arm[:, 0]]
    )
    return {
        "planform": plan.tolist(),
        "incidence": float(wing.rotation[1]),
        "incidence_pivot": wing.origin.tolist(),
        # Straight from the side of the body to the tip, whatever the planform's kinks.
        "reference_axis": axis[
            sorted({0, min(1, len(axis) - 1), len(axis) - 1})
        ].tolist(),
    }


def _tail(tail: Surface) -> dict[str, Any]:
    leading = tail.leading
    if tail.upright:  # the span turns from y to z
        leading = np.column_stack([leading[:, 0], -leading[:, 2], leading[:, 1]])
    leading = leading + tail.origin * ([1.0, 0.0, 1.0] if tail.upright else 1.0)
    ends = leading[[0, -1]]
    chord = tail.chord[[0, -1]]
    ours = store.table("airfoils")
    thickness = np.ptp(ours[ours.airfoil == "tail"].z_over_c.to_numpy())
    return {
        "root_leading_edge": ends[0].tolist(),
        "tip_leading_edge": ends[1].tolist(),
        "root_chord": float(chord[0]),
        "tip_chord": float(chord[1]),
        "thickness_scale": float((tail.thickness / tail.chord)[0] / thickness),
        "reference_axis": (ends + np.outer(chord * _AXIS, [1.0, 0.0, 0.0])).tolist(),
    }


def _spars(surface: Surface) -> dict[str, Any]:
    assert surface.spars is not None
    front, rear = surface.spars
    return {"front_spar": front.tolist(), "rear_spar": rear.tolist()}


@contextmanager
def _named(source: Path, taken: list[str]) -> Iterator[None]:
    """What the generator cannot build is the file's fault: the built-in facts it can.

    Raises:
        InputError: names the file and what was taken from it.
    """
    try:
        with np.errstate(invalid="raise", divide="raise", over="raise"):
            yield
    except (InputError, OSError, MemoryError):
        raise
    except Exception as error:
        found = str(error).strip() or type(error).__name__
        raise InputError(
            f"{source}: no aircraft can be built with its {', '.join(taken)}: {found}; "
            "expected an airliner's proportions"
        ) from None


@contextmanager
def _replaced(
    facts: dict[str, dict[str, Any]], tables: dict[str, Any]
) -> Iterator[None]:
    """The generator sees these facts; what it derived from others is forgotten."""
    derived = (
        *(geometry.wing, geometry.tail),
        reference_axis.reference_nodes,
    )
    try:
        with store.replaced(facts, tables):
            for function in derived:
                function.cache_clear()
            yield
    finally:
        for function in derived:
            function.cache_clear()
