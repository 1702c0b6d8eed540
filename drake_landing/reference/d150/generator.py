"""The generator: a level of detail and a gear topology in, an aircraft out."""

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from drake_landing.landing.threads import single_threaded_blas
from drake_landing.reference.d150 import con, full, pre
from drake_landing.reference.d150.beams import add_materials
from drake_landing.reference.d150.gears import landing_gears
from drake_landing.reference.d150.mass_elements import add_masses
from drake_landing.reference.d150.masses import mass_table, node_masses
from drake_landing.reference.d150.model import AircraftModel, ModelBuilder
from drake_landing.reference.d150.reference_axis import (
    ATTACHMENTS,
    MONITORS,
    Reference,
    reference_nodes,
)
from fem.errors import InputError, nearest
from fem.files.atomic import written_aside


@dataclass(frozen=True, kw_only=True)
class Recipe:
    """How a level is built.

    Attributes:
        build: writes the structure onto the bench; mass items come after it.
        topologies: gear topologies it knows; the first is the default.
        modes: number of modes that its deck asks for.
    """

    build: Callable[[ModelBuilder, Reference, str], None]
    topologies: tuple[str, ...]
    modes: int


RECIPES = {
    "con": Recipe(build=con.build_con, topologies=con.TOPOLOGIES, modes=60),
    "pre": Recipe(build=pre.build_pre, topologies=pre.TOPOLOGIES, modes=80),
    "full": Recipe(build=full.build_full, topologies=full.TOPOLOGIES, modes=80),
}
LEVELS = tuple(RECIPES)


# Sums over many grids depend in their last digits on the threads of BLAS; a deck must
# not: it is the same on every machine.
@single_threaded_blas()
def build(level: str = "con", topology: str | None = None) -> AircraftModel:
    """Generates a reference aircraft.

    Args:
        level: `con`, `pre` or `full`.
        topology: gear attachment, see the level's builder; default: its first.

    Raises:
        InputError: unknown level or topology.
    """
    recipe = _recipe(level)
    topology = recipe.topologies[0] if topology is None else str(topology)
    if topology not in recipe.topologies:
        raise InputError(
            f"topology: found '{topology}', expected one of "
            f"{', '.join(recipe.topologies)} for the {level} aircraft"
        )
    reference, gears = reference_nodes(), landing_gears()
    bench = ModelBuilder()
    add_materials(bench)
    recipe.build(bench, reference, topology)
    lumps = node_masses(reference, gears, bench.structure)
    add_masses(bench, lumps)
    sets = {
        1: list(MONITORS.values()),
        2: interface_nodes(),
        3: list(ATTACHMENTS.values()),
    }
    title = f"DLR-D150-{level.upper()}, gear topology {topology}"
    ids = np.array(sorted(bench.position))
    return AircraftModel(
        level=level,
        topology=topology,
        deck=bench.deck(title, sets, recipe.modes),
        grid_id=ids,
        position=np.array([bench.position[i] for i in ids]),
        monitoring=monitoring_points(),
        attachment=attachment_nodes(),
        interface=interface_nodes(),
        parts={part: tuple(nodes) for part, nodes in bench.parts.items() if nodes},
        masses=mass_table(lumps, reference, bench.structure),
        gears=gears,
    )


def write_model(
    level: str, path: str | os.PathLike[str], topology: str | None = None
) -> AircraftModel:
    """Builds an aircraft and writes its deck.

    Raises:
        InputError: unknown level or topology, or the folder does not exist.
    """
    target = Path(path)
    if not target.parent.is_dir():
        raise InputError(f"{target}: the folder {target.parent} does not exist")
    if target.is_dir():
        raise InputError(f"{target}: is a folder, expected the name of a file")
    model = build(level, topology)
    with written_aside(target) as part:
        part.write_text(model.deck, encoding="ascii")
    return model


def monitoring_points() -> dict[str, int]:
    """Monitoring point -> grid id, the same at every level."""
    return dict(MONITORS)


def attachment_nodes() -> dict[str, int]:
    """Gear name -> grid id of its attachment node, the same at every level."""
    return dict(ATTACHMENTS)


def interface_nodes() -> tuple[int, ...]:
    """The 261 grid ids that a reduction keeps, the same at every level."""
    return tuple(sorted(i for g in reference_nodes().values() for i in g.ids))


def _recipe(level: str) -> Recipe:
    if level not in RECIPES:
        raise InputError(
            f"model: found '{level}', expected one of {', '.join(RECIPES)}"
            + nearest(level, LEVELS)
        )
    return RECIPES[level]
