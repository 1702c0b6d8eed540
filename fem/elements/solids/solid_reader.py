"""CHEXA, CPENTA, CTETRA and CPYRAM cards to blocks: PSOLID, material axes, shape."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.records import CARDS
from fem.deck.references import refer, table, where
from fem.elements.solids.element_axes import (
    hexa_axes,
    penta_axes,
    stress_rotation,
)
from fem.elements.solids.incomplete import without
from fem.elements.solids.integration import integration_of
from fem.elements.solids.isoparametric import jacobians
from fem.elements.solids.solid import Matrices, Shape, Solid
from fem.errors import InputError, Problems
from fem.geometry.points import Points, grid_freedoms
from fem.properties.elasticity import Elasticity, ElasticityTable

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def read_solids(
    deck: "Deck", points: Points, card: str, shapes: Sequence[Shape]
) -> list[Solid]:
    """Blocks of one card, one for each set of mid-sides and each integration.

    Raises:
        InputError: undefined references, elements turned inside out; all of them.
    """
    rows = table(deck, card).sort_values("eid", ignore_index=True)
    layered = rows["pid"].isin(table(deck, "PCOMPS")["pid"]).to_numpy()
    if layered.any() and card != "CHEXA":
        raise InputError(
            f"{where(card, rows[layered].iloc[0])}: {card} with PCOMPS is not "
            "supported; expected CHEXA with eight grids, or PSOLID"
        )
    rows = rows[~layered].reset_index(drop=True)
    if rows.empty:
        return []
    nodes = [np.asarray(n, dtype=np.int64) for n in rows["nodes"]]
    count = np.array([len(n) for n in nodes])
    problems, blocks = Problems(), []
    for shape in shapes:
        chosen = np.flatnonzero(count == shape.nodes)
        if not len(chosen):
            continue
        with problems.gathered():
            for some, variant in _by_integration(deck, rows.iloc[chosen], shape):
                grids = np.stack([nodes[i] for i in chosen[some]])
                part = rows.iloc[chosen[some]].reset_index(drop=True)
                for own, kind in _by_mid_sides(grids, variant):
                    here = part.iloc[own].reset_index(drop=True)
                    there = grids[own][:, grids[own[0]] > 0]
                    blocks.append(_block(deck, points, here, kind, there))
    problems.report()
    return blocks


def _by_mid_sides(grids: Int64, shape: Shape) -> list[tuple[Int64, Shape]]:
    """Positions of the elements (e, n) by the mid-sides that are there."""
    patterns, which = np.unique(grids > 0, axis=0, return_inverse=True)
    topology = CARDS[shape.card].topology
    edges = topology.edges if topology else ()
    found = []
    for k, there in enumerate(patterns):
        middles = there[shape.corners :]
        kind = shape if middles.all() else without(shape, edges, middles)
        found.append((np.flatnonzero(which.ravel() == k), kind))
    return found


def _by_integration(
    deck: "Deck", rows: pd.DataFrame, shape: Shape
) -> list[tuple[Int64, Shape]]:
    """Positions of the elements by what their PSOLID asks for, and their shape."""
    properties = refer(rows, shape.card, "pid", table(deck, "PSOLID"), "PSOLID")
    asked = list(zip(properties["integ"], properties["isop"]))
    groups: dict[Matrices, list[int]] = {}
    for k, (integ, isop) in enumerate(asked):
        way = integration_of(shape, integ, isop) or shape.matrices
        groups.setdefault(way, []).append(k)
    return [(np.array(at), replace(shape, matrices=way)) for way, at in groups.items()]


def _block(
    deck: "Deck", points: Points, rows: pd.DataFrame, shape: Shape, grids: Int64
) -> Solid:
    at = points.rows(grids)
    nodes = points.xyz[at]
    check_jacobian(rows, shape, nodes)
    properties = refer(rows, shape.card, "pid", table(deck, "PSOLID"), "PSOLID")
    materials = ElasticityTable(deck)
    mids = properties["mid"].to_numpy(np.int64)
    _check_materials(rows, shape, materials, mids)
    axes = material_axes(points, properties, nodes, shape)
    used = {int(m): materials[int(m)] for m in np.unique(mids)}
    own = np.stack([used[int(m)].solid for m in mids])
    turn = stress_rotation(axes, strain=True)
    return Solid(
        card=shape.card,
        id=rows["eid"].to_numpy(np.int64),
        dof=grid_freedoms(at, 3),
        pid=rows["pid"].to_numpy(np.int64),
        shape=shape,
        nodes=nodes,
        elasticity=turn.transpose(0, 2, 1) @ own @ turn,
        axes=axes,
        rho=np.array([used[int(m)].rho for m in mids]),
        ge=np.array([used[int(m)].ge for m in mids]),
        # Strains turn with the transpose of the material axes' own matrix.
        alpha=np.einsum(
            "eij,ej->ei",
            stress_rotation(axes.transpose(0, 2, 1), strain=True),
            np.stack([used[int(m)].alpha for m in mids]),
        ),
        tref=np.array([used[int(m)].tref for m in mids]),
    )


def _check_materials(
    rows: pd.DataFrame, shape: Shape, materials: ElasticityTable, mids: Int64
) -> None:
    problems = Problems()
    for mid in np.unique(mids):
        user = where(shape.card, rows.iloc[int(np.argmax(mids == mid))])
        found = materials.problem(int(mid), ("MAT1", "MAT9"), user)
        if found is None:
            found = _unfit(materials[int(mid)], user)
        if found:
            problems.append(found)
    problems.report()


def _unfit(material: Elasticity, user: str) -> str | None:
    """Why a solid cannot be of this material; None: it can."""
    if material.solid is None:
        return (
            f"{user}: Poisson's ratio of material {material.mid} is 0.5 or more, "
            "expected below 0.5 in a solid"
        )
    if np.linalg.cond(material.solid) > 1e12:
        return f"{user}: material {material.mid} is singular, expected a regular matrix"
    return None


def check_jacobian(rows: pd.DataFrame, shape: Shape, nodes: Float64) -> None:
    """Refuse solids whose Jacobian is not positive.

    Raises:
        InputError: all of them, with the least value relative to the mean.
    """
    slope = shape.derivatives(shape.checked)
    value = np.linalg.det(jacobians(nodes, slope))
    scale = np.abs(value).mean(axis=1)
    least = value.min(axis=1) / np.where(scale == 0.0, 1.0, scale)
    bad = np.flatnonzero(~(least > 1e-9))
    if len(bad):
        raise InputError(
            f"{where(shape.card, rows.iloc[i])}: its Jacobian determinant falls to "
            f"{least[i]:.3g} of the mean, expected positive: the order of its nodes or "
            "its shape is wrong"
            for i in bad
        )


def material_axes(
    points: Points, properties: pd.DataFrame, nodes: Float64, shape: Shape
) -> Float64:
    """(e, 3, 3) rows are the axes of CORDM: 0 basic, -1 the element, else a system.

    The element axes are the orthogonal ones closest to the natural directions at the
    center, or to the sides of a prism (`element_axes.py`); a tetrahedron has x along
    G1-G2 and z normal to G1-G2-G3.
    """
    cordm = properties["cordm"].to_numpy(np.int64)
    axes = np.broadcast_to(np.eye(3), (len(nodes), 3, 3)).copy()
    own = cordm == -1
    if own.any():
        axes[own] = _element_axes(nodes[own], shape)
    given = cordm > 0
    if given.any():
        center = nodes[given].mean(axis=1)
        axes[given] = points.frames.triads(cordm[given], center).transpose(0, 2, 1)
    return axes


def _element_axes(nodes: Float64, shape: Shape) -> Float64:
    if shape.card == "CTETRA":
        x = nodes[:, 1] - nodes[:, 0]
        z = np.cross(x, nodes[:, 2] - nodes[:, 0])
        triad = np.stack([x, np.cross(z, x), z], axis=1)
        return triad / np.linalg.norm(triad, axis=2, keepdims=True)
    center = shape.checked[:1]
    natural = jacobians(nodes, shape.derivatives(center))[:, 0]
    return penta_axes(natural) if shape.card == "CPENTA" else hexa_axes(natural)
