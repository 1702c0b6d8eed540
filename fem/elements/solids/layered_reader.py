"""CHEXA cards with PCOMPS to blocks: stack, axes, plies."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.references import table, where
from fem.elements.solids.element_axes import stress_rotation
from fem.elements.solids.isoparametric import jacobians
from fem.elements.solids.layered import LayeredSolid, Stack, stacked_along
from fem.elements.solids.solid import Shape
from fem.elements.solids.solid_reader import check_jacobian, material_axes
from fem.errors import InputError, Problems
from fem.geometry.points import Points
from fem.properties.elasticity import ElasticityTable

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_PARALLEL = 1e-3  # sine of the least angle between plies' direction and their normal


def read_layered(deck: "Deck", points: Points, shape: Shape) -> list[LayeredSolid]:
    """Blocks of CHEXA with PCOMPS, one for each of these.

    Raises:
        InputError: mid-sides, materials without three dimensions, plies whose direction
            is that of the stack; all of them.
    """
    laminates = table(deck, "PCOMPS")
    rows = table(deck, "CHEXA").sort_values("eid", ignore_index=True)
    rows = rows[rows["pid"].isin(laminates["pid"])]
    if rows.empty:
        return []
    materials = ElasticityTable(deck)
    problems, blocks = Problems(), []
    for pid, own in rows.groupby("pid", sort=True):
        laminate = laminates[laminates["pid"] == pid].iloc[0]
        with problems.gathered():
            stack = _stack(laminate, materials)
            blocks.append(
                _block(points, own.reset_index(drop=True), laminate, stack, shape)
            )
    problems.report()
    return blocks


def _block(
    points: Points, rows: pd.DataFrame, laminate: pd.Series, stack: Stack, shape: Shape
) -> LayeredSolid:
    grids = [np.asarray(nodes, np.int64) for nodes in rows["nodes"]]
    quadratic = [k for k, nodes in enumerate(grids) if len(nodes) != shape.nodes]
    if quadratic:
        raise InputError(
            f"{where('CHEXA', rows.iloc[k])}: PCOMPS with mid-side grids is not "
            "supported; expected eight grids"
            for k in quadratic[:10]
        )
    at = points.rows(np.stack(grids))
    nodes = points.xyz[at]
    check_jacobian(rows, shape, nodes)
    properties = pd.DataFrame([laminate] * len(rows)).reset_index(drop=True)
    axes = material_axes(points, properties, nodes, shape)
    along, across = (int(digit) - 1 for digit in laminate["psdir"])
    natural = jacobians(nodes, shape.derivatives(shape.checked[:1]))[:, 0]
    order = stacked_along(natural, axes[:, across])
    placed = np.take_along_axis(nodes, order[:, :, None], axis=1)
    frame = _frame(rows, placed, axes[:, along], shape)
    return LayeredSolid(
        card="CHEXA",
        id=rows["eid"].to_numpy(np.int64),
        dof=(6 * at[:, :, None] + np.arange(3)).reshape(len(rows), -1),
        pid=rows["pid"].to_numpy(np.int64),
        shape=shape,
        nodes=nodes,
        order=order,
        axes=frame,
        stack=stack,
    )


def _frame(
    rows: pd.DataFrame, placed: Float64, direction: Float64, shape: Shape
) -> Float64:
    """(e, 3, 3) the direction in the plane of the plies, across it, their normal."""
    natural = jacobians(placed, shape.derivatives(shape.checked[:1]))[:, 0]
    normal = np.cross(natural[:, 0], natural[:, 1])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    x = direction - np.einsum("ea,ea->e", direction, normal)[:, None] * normal
    size = np.linalg.norm(x, axis=1, keepdims=True)
    steep = np.flatnonzero(size[:, 0] < _PARALLEL)
    if len(steep):
        raise InputError(
            f"{where('CHEXA', rows.iloc[k])}: the direction of the plies is normal to "
            "them; expected another CORDM or PSDIR on its PCOMPS"
            for k in steep[:10]
        )
    x /= size
    return np.stack([x, np.cross(normal, x), normal], axis=1)


def _stack(laminate: pd.Series, materials: ElasticityTable) -> Stack:
    """The plies of a PCOMPS.

    Raises:
        InputError: materials that are absent or not of solids.
    """
    user = where("PCOMPS", laminate)
    mids = [int(mid) for mid in laminate["mids"]]
    found = (materials.problem(mid, ("MAT1", "MAT9"), user) for mid in set(mids))
    if problems := [problem for problem in found if problem]:
        raise InputError(problems)
    plies = [materials[mid] for mid in mids]
    angle = np.radians(np.asarray(laminate["thetas"], float))
    c, s, none = np.cos(angle), np.sin(angle), np.zeros(len(angle))
    own = np.stack(
        [
            np.stack([c, s, none], axis=1),
            np.stack([-s, c, none], axis=1),
            np.stack([none, none, none + 1.0], axis=1),
        ],
        axis=1,
    )
    turn = stress_rotation(own, strain=True)
    solid = np.stack([ply.solid for ply in plies])
    thickness = np.asarray(laminate["ts"], float)
    return Stack(
        share=thickness / thickness.sum(),
        elasticity=turn.swapaxes(1, 2) @ solid @ turn,
        turn=stress_rotation(own),
        rho=np.array([ply.rho for ply in plies]),
        alpha=np.stack([ply.alpha for ply in plies]),
        ge=float(laminate["ge"]),
        tref=float(laminate["tref"]),
    )
