"""What an analyst wants to know of a reduced model before trusting it.

Mass, center and inertia against the full model; six rigid-body modes at zero; forces
that a rigid motion meets (grounding); frequencies and shapes against the full model;
how much mass the generalised coordinates carry.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.linalg
import scipy.optimize
import scipy.sparse as sp

from drake_landing.reduced.make import Reduced
from drake_landing.reduced.model import ReducedModel
from drake_landing.show.mesh import drawn_mesh
from drake_landing.show.modes import motions
from fem.algebra.modes import Modes, normal_modes
from fem.model.structure import Structure
from fem.model.weight import rigid_mass_properties

Float64 = npt.NDArray[np.float64]

DIRECTIONS = ("x", "y", "z", "rotation x", "rotation y", "rotation z")
_STILL = 0.01  # Hz, below which a mode of a reduced model is a rigid motion
LIMITS_HZ = (10.0, 25.0, 50.0, 100.0, 150.0)


@dataclass(frozen=True, kw_only=True)
class ReductionChecks:
    """Checks of a reduction.

    Attributes:
        mass: quantity, full, reduced, difference (of the full; center in m).
        rigid: direction, frequency in Hz that K gives the rigid motion, grounding:
            largest force or moment that a unit motion meets over the largest term
            of K of that kind, effective mass of the generalised coordinates over all.
        modes: mode, full_hz, reduced_hz, error, mac, motion: what moves, in words.
        counts: below_hz, and the number of elastic modes of the reduced model.
        rigid_modes: number of modes below 0.01 Hz: round-off of a large condensation
            lifts rigid motions off zero.
    """

    mass: pd.DataFrame
    rigid: pd.DataFrame
    modes: pd.DataFrame
    counts: pd.DataFrame
    rigid_modes: int


def check_reduction(
    structure: Structure,
    reduced: Reduced,
    highest_hz: float = 50.0,
    full: Modes | None = None,
) -> ReductionChecks:
    """Compares a reduced model with the full one.

    Args:
        structure: the full model.
        reduced: its reduction.
        highest_hz: modes of the full model up to here are compared.
        full: these modes, if they are known.
    """
    full = full_modes(structure, highest_hz) if full is None else full
    model = reduced.model
    own = reduced_modes(model, max(LIMITS_HZ[-1], 1.5 * highest_hz))
    free = int(np.sum(own.frequency_hz < _STILL))
    elastic = own.frequency_hz[free:]
    counts = pd.DataFrame(
        {
            "below_hz": LIMITS_HZ,
            "modes": [int(np.sum(elastic < limit)) for limit in LIMITS_HZ],
        }
    )
    return ReductionChecks(
        mass=_mass_table(structure, model),
        rigid=_rigid_table(structure, model),
        modes=_mode_table(structure, reduced, full),
        counts=counts,
        rigid_modes=free,
    )


def full_modes(structure: Structure, highest_hz: float) -> Modes:
    """Normal modes of the full model below a frequency, rigid ones included."""
    return normal_modes(
        structure.stiffness,
        structure.mass,
        band=(0.0, highest_hz),
        rigid_body=structure.rigid_body,
    )


def reduced_modes(model: ReducedModel, highest_hz: float) -> Modes:
    """Normal modes of a reduced model below a frequency, rigid ones included."""
    return normal_modes(
        sp.csr_matrix(model.stiffness),
        sp.csr_matrix(model.mass),
        band=(0.0, highest_hz),
    )


def _mass_table(structure: Structure, model: ReducedModel) -> pd.DataFrame:
    center = structure.rigid_mass.center
    full = structure.rigid_body
    whole = rigid_mass_properties(full.T @ (structure.mass @ full))
    own = model.rigid_body(center)
    small = rigid_mass_properties(own.T @ model.mass @ own)
    rows = [("mass", whole[0], small[0])]
    for k, axis in enumerate("xyz"):
        at = center[k]
        rows.append((f"centre {axis}", at + whole[1][k], at + small[1][k]))
    for i, j in ((0, 0), (1, 1), (2, 2), (0, 2)):
        name = f"inertia {'xyz'[i]}{'xyz'[j]}"
        rows.append((name, whole[2][i, j], small[2][i, j]))
    table = pd.DataFrame(rows, columns=["quantity", "full", "reduced"])
    scale = np.where(table.quantity.str.startswith("centre"), 1.0, table.full.abs())
    table["difference"] = (table.reduced - table.full) / np.maximum(scale, 1e-30)
    return table


def _rigid_table(structure: Structure, model: ReducedModel) -> pd.DataFrame:
    motion = model.rigid_body(structure.rigid_mass.center)
    force = model.stiffness @ motion
    rows = model.labels[:, 1]
    largest = np.abs(np.diag(model.stiffness))
    grounding = np.zeros(6)
    for kind in (rows < 4, rows >= 4):
        if kind.any():
            part = np.abs(force[kind]).max(axis=0) / max(largest[kind].max(), 1e-30)
            grounding = np.maximum(grounding, part)
    heavy = motion.T @ model.mass @ motion
    energy = np.abs(np.einsum("fi,fi->i", motion, force))
    a = model.a_size
    coupling = model.mass[a:, :a] @ motion[:a]
    modal = np.diag(model.mass)[a:, None]
    effective = np.sum(coupling**2 / np.maximum(modal, 1e-30), axis=0)
    return pd.DataFrame(
        {
            "direction": DIRECTIONS,
            "hz": np.sqrt(energy / np.diag(heavy)) / (2.0 * np.pi),
            "grounding": grounding,
            "effective_mass": effective / np.diag(heavy),
        }
    )


def _mode_table(structure: Structure, reduced: Reduced, full: Modes) -> pd.DataFrame:
    """Pairs modes by their shapes; MAC is weighted with the full mass."""
    reduction = reduced.reduction
    own = normal_modes(
        sp.csr_matrix(reduction.stiffness),
        sp.csr_matrix(reduction.mass),
        count=min(full.count + max(20, full.count // 2), reduction.size),
    )
    elastic = full.shape[:, full.rigid :]
    shapes = structure.mass @ elastic
    free = int(np.sum(own.frequency_hz < _STILL))
    expanded = reduction.expand(own.shape[:, free:])
    size = np.einsum("fi,fi->i", expanded, structure.mass @ expanded)
    mac = (shapes.T @ expanded) ** 2 / size
    at, partner = scipy.optimize.linear_sum_assignment(-mac)
    names = motions(structure, drawn_mesh(structure), elastic)
    hertz, found = full.frequency_hz[full.rigid :], own.frequency_hz[free:]
    return pd.DataFrame(
        {
            "mode": at + 1,
            "full_hz": hertz[at],
            "reduced_hz": found[partner],
            "error": found[partner] / hertz[at] - 1.0,
            "mac": mac[at, partner],
            "motion": [names[k] for k in at],
        }
    )
