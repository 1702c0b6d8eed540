"""The limit manoeuvre of 2.65 g on a reference aircraft: is it sized?

Lift of wing and tailplane comes from the source's limit load case (M 0.82 at 5.7 km,
mass 73.6 t), scaled to 2.65 times the weight of the 72.5 t of this project. The
airframe flies freely and its own inertia balances the loads (inertia relief); the
gears, which are no part of its deck, pull at their attachments. At ultimate load, 1.5
times the limit, no sheet or bar may pass its material's strength.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.parts.stress import stresses
from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.gears import landing_gears
from drake_landing.reference.d150.geometry import MIRROR
from drake_landing.reference.d150.reference_axis import (
    MONITORS,
    NodeGroup,
    reference_nodes,
)
from fem.algebra.statics import inertia_relief
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]

LOAD_FACTOR = 2.65
ULTIMATE = 1.5
GRAVITY = 9.80665
SIDE_OF_BODY = 1.8685  # m
_TAIL = 25.0  # m, behind which no wing is
# Bending moment about x at the side of the body, N m: aerodynamic strips and inertia
# nodes outboard of it, in the source's load case.
SOURCE_ROOT_MOMENT = 3.783e6


@dataclass(frozen=True, kw_only=True)
class LimitLoad:
    """The aircraft at 2.65 g.

    Attributes:
        tip_deflection: of the wing tips, upward, relative to the monitoring point at
            the center of gravity, m.
        acceleration: (6,) of the airframe as a rigid body about its c.g.
        root_moment: bending moment about x at the side of the body, N m; `moments`
            at further stations y (m).
        stress: one row per element: table, id, pid, material, stress (Pa, von Mises or
            largest direct stress), allowed (Pa), margin (of safety at ultimate load);
            empty where a level has no element with a strength.
    """

    tip_deflection: float
    acceleration: Float64
    root_moment: float
    moments: dict[float, float]
    stress: pd.DataFrame

    @property
    def worst(self) -> pd.Series:
        """The element with the least margin."""
        return self.stress.loc[self.stress.margin.idxmin()]


def limit_load(structure: Structure) -> LimitLoad:
    """Solves the limit load case.

    Args:
        structure: of a reference aircraft, any level.
    """
    load_g = applied_loads(structure)
    found = inertia_relief(
        structure.stiffness,
        structure.mass,
        np.asarray(structure.load(load_g[:, None])),
        rigid_body=structure.rigid_body,
    )
    u = structure.shape(found.displacement)[:, 0]
    motion = structure.shape(found.motions @ found.acceleration)[:, 0]
    # What the structure carries: loads less the inertia forces of every mass.
    balanced = load_g - structure.matrices.mass @ motion
    nodes = list(MONITORS.values())
    flight = found.motions @ found.acceleration
    rigid = np.linalg.lstsq(structure.rigid_body, flight, rcond=None)
    at = dict(zip(nodes, structure.points.rows(nodes).tolist()))
    tips = [6 * at[MONITORS[f"wing_tip_{side}"]] + 2 for side in ("left", "right")]
    moments = {y: _moment(structure, balanced, y) for y in (5.0, 6.34, 9.0, 12.0)}
    return LimitLoad(
        tip_deflection=float(u[tips].mean() - u[6 * at[MONITORS["cg"]] + 2]),
        acceleration=rigid[0][:, 0],
        root_moment=_moment(structure, balanced, SIDE_OF_BODY),
        moments=moments,
        stress=_stresses(structure, u),
    )


def applied_loads(structure: Structure) -> Float64:
    """(g,) aerodynamic loads and the pull of the gears; CD is the basic frame."""
    reference, strips = reference_nodes(), table("limit_load")
    load = np.zeros(structure.points.size)
    weight = facts("overall")["mass"]["total"] * GRAVITY * LOAD_FACTOR
    factor = weight / (2.0 * strips.fz.sum())
    for row in strips.itertuples():
        p = np.array([row.x, row.y, row.z])
        force, moment = [np.array(v) * factor for v in ((0, 0, row.fz), (0, row.my, 0))]
        for side, mirror in (("right", np.ones(3)), ("left", MIRROR)):
            group = _with_tip(reference, str(row.part), side)
            _spread(structure, load, group, p * mirror, force, moment)
    for gear in landing_gears():
        pull = -gear.mass * GRAVITY * LOAD_FACTOR
        row = structure.points.rows([gear.attachment_node])[0]
        load[6 * row + 2] += pull
    return load


def _with_tip(reference: dict[str, NodeGroup], part: str, side: str) -> NodeGroup:
    group = reference[f"{part}_{side}"]
    if part != "wing":
        return group
    tip = reference[f"monitor_wing_tip_{side}"]
    ids, p = (*group.ids, *tip.ids), np.concatenate([group.p, tip.p])
    return NodeGroup(name=group.name, ids=ids, p=p)


def _spread(
    structure: Structure,
    load: Float64,
    group: NodeGroup,
    p: Float64,
    force: Float64,
    moment: Float64,
) -> None:
    """A force at a point onto the two nodes beside it, with its moment about them."""
    span = np.abs(group.p[:, 1])
    k = int(np.clip(np.searchsorted(span, abs(p[1])) - 1, 0, len(span) - 2))
    share = np.clip((abs(p[1]) - span[k]) / (span[k + 1] - span[k]), 0.0, 1.0)
    for node, part in ((k, 1.0 - share), (k + 1, share)):
        row = 6 * structure.points.rows([group.ids[node]])[0]
        load[row : row + 3] += part * force
        arm = p - group.p[node]
        load[row + 3 : row + 6] += part * (moment + np.cross(arm, force))


def _moment(structure: Structure, load: Float64, y: float) -> float:
    """Bending moment about x at a station of the starboard wing from all outboard."""
    points = structure.points
    six = load[: 6 * len(points.grid_id)].reshape(-1, 6)
    out = (points.xyz[:, 1] > y) & (points.xyz[:, 0] < _TAIL)
    arm = points.xyz[out, 1] - y
    return float(np.sum(six[out, 2] * arm + six[out, 3]))


def _stresses(structure: Structure, u: Float64) -> pd.DataFrame:
    """Equivalent stress of elements whose material has a strength, and its margin."""
    data = {m["id"]: m for m in facts("materials").values()}
    parts = stresses(structure).parts
    found = pd.DataFrame(
        {
            "id": np.concatenate([part.id for part in parts]),
            "stress": np.concatenate([part.of(u[:, None])[0, :, 0] for part in parts]),
        }
    )
    stress = _materials(structure).merge(found, on="id")
    stress["allowed"] = [data[m]["tension"] for m in stress.material]
    with np.errstate(divide="ignore"):
        stress["margin"] = stress.allowed / (ULTIMATE * stress.stress) - 1.0
    return stress


def _materials(structure: Structure) -> pd.DataFrame:
    """Table, id, pid, material: shells and bars of isotropic materials with a strength.

    Skins with smeared stringers have that of their bending; beams whose mass lies in
    mass items, and laminates, are left out.
    """
    cards = structure.deck.cards
    owner = pd.concat(
        [
            cards["PSHELL"][["pid", "mid2"]].rename(columns={"mid2": "material"}),
            cards["PBAR"][["pid", "mid"]].rename(columns={"mid": "material"}),
        ]
    )
    elements = pd.concat(
        [
            cards[card][["eid", "pid"]].assign(table=card)
            for card in ("CQUAD4", "CTRIA3", "CBAR")
        ]
    )
    known = owner[owner.material.isin([m["id"] for m in facts("materials").values()])]
    return elements.merge(known, on="pid").rename(columns={"eid": "id"})
